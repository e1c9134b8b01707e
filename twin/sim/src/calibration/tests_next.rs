//! Which print would help most.

use super::next::candidates;
use super::tests::{blown, gel_strand, hang, measured, of, pla, resin};
use super::*;

#[test]
fn a_parameter_no_print_told_of_is_asked_for() {
    let usual = blown(0.06, 0.006);
    let told = |prints: &[Print]| {
        let prints: Vec<Measured> = prints.iter().map(|it| measured(*it, &pla(), 0.3)).collect();
        let next = fit(&pla(), &prints, Some(&usual)).next.expect("something helps");
        assert!(next.doubt_then < 0.95 * next.doubt_now && next.predicted_m.is_finite());
        next
    };
    // A long cantilever shrinks by a quarter millimetre, read to a tenth of it.
    let first = told(&[hang()]);
    assert_eq!(first.helps, Parameter::Shrinkage);
    assert!(matches!(first.print, Print::Cantilever(strand) if strand.length_m == 0.1));
    let second = told(&[hang(), first.print, first.print]);
    assert_ne!(second.helps, Parameter::Shrinkage);
    // Nothing to print with: nothing but doses, and a thermoplastic wants none.
    assert_eq!(fit(&pla(), &[], None).next, None);
}

#[test]
fn a_resin_asks_for_the_other_end_of_its_working_curve() {
    let one = |times: f64| Print::CuredDepth { dose_j_m2: times };
    let fitted = fit(&resin(), &[measured(one(400.0), &resin(), 0.0)], None);
    let next = fitted.next.expect("a second dose");
    assert!(matches!(next.print, Print::CuredDepth { .. }));
    // Brute force: no other candidate, once measured as expected, leaves less doubt.
    let doubt = |print: Print| {
        let value_m = predicted_m(&print, &fitted.known);
        let then = Measured { print, value_m, deviation_m: (0.03 * value_m).max(2e-5) };
        let after = fit(&resin(), &[measured(one(400.0), &resin(), 0.0), then], None);
        after.parameters.iter().map(|it| it.doubt_left * it.doubt_left).sum::<f64>()
    };
    let chosen = doubt(next.print);
    for print in candidates(&fitted.known, None) {
        assert!(doubt(print) >= chosen * 0.98, "{print:?} {} {chosen}", doubt(print));
    }
}

#[test]
fn another_print_never_widens_by_much_and_agreeing_prints_narrow_by_the_root() {
    let doses = [400.0, 800.0, 1600.0, 3200.0].map(|h| Print::CuredDepth { dose_j_m2: h });
    let prints: Vec<Measured> = doses.iter().map(|it| measured(*it, &resin(), 0.0)).collect();
    let mut last = [1.0; 2];
    for count in 1..=prints.len() {
        let fit = fit(&resin(), &prints[..count], None);
        let now = [Parameter::Penetration, Parameter::CriticalExposure]
            .map(|parameter| of(&fit, parameter).doubt_left);
        assert!(now[0] <= last[0] * 1.001 && now[1] <= last[1] * 1.001, "{now:?} {last:?}");
        last = now;
    }
    // Where prints outweigh the prior, four times the prints halve the interval.
    let many = |times: usize| {
        let prints: Vec<Measured> = prints.iter().copied().cycle().take(4 * times).collect();
        of(&fit(&resin(), &prints, None), Parameter::Penetration).doubt_left
    };
    let halved = many(16) / many(4);
    assert!((halved - 0.5).abs() < 0.02, "{halved}");
}

#[test]
fn candidates_are_prints_of_the_material() {
    let plastic = candidates(&pla(), Some(&blown(0.06, 0.006)));
    assert_eq!(plastic.len(), 9);
    assert!(plastic.iter().all(|print| predicted_m(print, &pla()).is_finite()));
    assert_eq!(candidates(&resin(), Some(&gel_strand(0.06, 0.003))).len(), 12);
    assert_eq!(candidates(&resin(), None).len(), 3);
    // Half the speed, the same bead.
    let Print::Bridge(slow) = plastic[2] else { panic!("a bridge") };
    assert!((slow.flow_m3_s / slow.speed_m_s - 9.503e-7).abs() < 1e-10);
}
