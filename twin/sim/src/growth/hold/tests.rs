use super::area::{Feet, contact_width_m};
use super::*;
use crate::finding::{Finding, Severity};
use crate::growth::tests::{Print, RADIUS_M};
use crate::test_job::strand;

const ON_BED: &str = ", \"on\": \"bed\"";

/// The flat of a bead pressed to a height: none for one that is not pressed, the bead's section kept.
#[test]
fn a_bead_pressed_flatter_touches_more() {
    let d = 2e-3;
    assert_eq!(contact_width_m(d, d), 0.0);
    assert_eq!(contact_width_m(d, 1.5 * d), 0.0);
    for h in [0.5 * d, 0.6 * d, 0.9 * d] {
        let flat = contact_width_m(d, h);
        let section = flat * h + std::f64::consts::PI * h * h / 4.0;
        assert!((section / (std::f64::consts::PI * d * d / 4.0) - 1.0).abs() < 1e-12);
    }
    assert_eq!([0.0, 1e-9, f64::NAN].map(|h| contact_width_m(d, h)), [2.0 * d; 3]);
}

/// A strand that lies on the bed touches over half its members; one that stands there with its section.
#[test]
fn feet_are_as_large_as_what_touches() {
    let lying = strand("a", &[[0.0, 0.0, 1.0], [20.0, 0.0, 1.0], [20.0, 30.0, 1.0]], ON_BED);
    let upright = strand("b", &[[60.0, 0.0, 0.0], [60.0, 0.0, 20.0]], "");
    let leaning = strand("c", &[[90.0, 0.0, 0.0], [100.0, 0.0, 10.0]], "");
    let print = Print::new("", &[lying, upright, leaning]);
    let built = print.built();
    let printed = print.printed();
    let feet = Feet::new(&print.job, &printed, &built);
    let section = std::f64::consts::PI * RADIUS_M * RADIUS_M;
    let width = contact_width_m(2.0 * RADIUS_M, 1e-3);
    let wanted = [
        (built.ends[0][0], 0, 10e-3 * width),
        (built.ends[0][0] + 1, 0, 25e-3 * width),
        (built.ends[0][1], 0, 15e-3 * width),
        (built.ends[1][0], 1, section),
        (built.ends[2][0], 2, section * 2f64.sqrt()),
    ];
    for (node, order, area_m2) in wanted {
        let foot = feet.foot(node, order, None);
        assert!((foot.normal - Vector::z()).norm() < 1e-12);
        assert!((foot.area_m2 / area_m2 - 1.0).abs() < 1e-9, "{node}: {:e}", foot.area_m2);
    }
}

/// A post with a stay on each side. The second stay shrinks: as a truss with pins its tension is
/// `T = -ε E A/(2 + 4 sin³ α)` in both stays, and each foot is pulled up with `T sin α`.
#[test]
fn stays_that_shrink_are_pulled_off() {
    let (height, reach): (f64, f64) = (30.0, 40.0);
    let top = [0.0, 0.0, height];
    let strands = [
        strand("post", &[[0.0, 0.0, 0.0], top], ""),
        strand("left", &[[-reach, 0.0, 0.0], top], ""),
        strand("right", &[[reach, 0.0, 0.0], top], ""),
    ];
    let mut print = Print::new("", &strands);
    print.laws[2].strain = -0.002;
    print.laws.iter_mut().for_each(|law| law.density_kg_m3 = 1e-9);
    let (growth, findings) = print.grown();
    let law = print.laws[2].clone();
    let section = std::f64::consts::PI * RADIUS_M * RADIUS_M;
    let sine = height / height.hypot(reach);
    let tension_n = 0.002 * law.e_pa * section / (2.0 + 4.0 * sine.powi(3));
    let held_n = print.job.cell.bed.adhesion_pa.nominal * section / sine;
    let wanted = tension_n * sine / held_n;
    let found: Vec<&Finding> = findings.iter().filter(|found| found.code == Code::S410).collect();
    assert_eq!(found.len(), 1);
    let found = found[0];
    eprintln!("{} for {wanted}: {}", found.measured.nominal, found.message);
    // stiff nodes carry some of it by bending
    assert!((found.measured.nominal / wanted - 1.0).abs() < 0.1);
    assert_eq!((found.severity, found.site.stage), (Severity::Error, Some(3)));
    assert!([Some(1), Some(2)].contains(&found.site.strand));
    assert!(found.site.at_m.expect("told") < 1e-9);
    let adhesion = print.job.cell.bed.adhesion_pa;
    let high = found.measured.nominal * adhesion.nominal / adhesion.low;
    assert!((found.measured.high / high - 1.0).abs() < 1e-9);
    assert_eq!(growth.stages[2].hold, Some(found.measured.nominal));
    assert_eq!(growth.stages[2].released_m, None);
    // held twice as well as that it does not let go
    let per_share = wanted.max(found.measured.nominal) * 2.0;
    print.job.cell.bed.adhesion_pa = Interval::exact(adhesion.nominal * per_share);
    let (growth, findings) = print.grown();
    assert!(findings.iter().all(|found| found.code != Code::S410));
    assert!(
        (growth.stages[2].hold.expect("held") - found.measured.nominal / per_share).abs() < 1e-9
    );
}

/// Strands that shrink where they lie pull along the bed, not off it.
#[test]
fn a_strand_that_lies_flat_is_not_pulled_off() {
    let flat = strand("a", &[[0.0, 0.0, 0.9], [40.0, 0.0, 0.9]], ON_BED);
    let mut print = Print::new("", &[flat]);
    print.laws[0].strain = -0.004;
    let (growth, findings) = print.grown();
    assert!(findings.is_empty());
    assert_eq!(growth.stages[0].hold, Some(0.0));
}

/// No adhesion at all, and no contact, are told as numbers.
#[test]
fn nothing_holds_nothing() {
    let strands = [
        strand("post", &[[0.0, 0.0, 0.0], [0.0, 0.0, 30.0]], ""),
        strand("left", &[[-40.0, 0.0, 0.0], [0.0, 0.0, 30.0]], ""),
        strand("right", &[[40.0, 0.0, 0.0], [0.0, 0.0, 30.0]], ""),
    ];
    let mut print = Print::new("", &strands);
    print.laws[2].strain = -0.002;
    print.job.cell.bed.adhesion_pa = Interval::exact(0.0);
    let (growth, findings) = print.grown();
    assert!(findings.iter().any(|found| found.code == Code::S410));
    let worst = growth.stages.iter().filter_map(|stage| stage.hold).fold(0.0, f64::max);
    assert_eq!(worst, HELD_BY_NOTHING);
    assert!(findings.iter().all(|found| found.measured.high.is_finite()));
}

#[test]
fn the_nearest_place_of_a_polyline() {
    let points =
        [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 2.0, 0.0]].map(|p: [f64; 3]| Point::from(p));
    let at_m = [0.0, 1.0, 3.0];
    for (point, wanted) in [([0.4, 0.1, 0.0], 0.4), ([1.2, 1.5, 1.0], 2.5), ([-3.0, 0.0, 0.0], 0.0)]
    {
        assert!((nearest_m(&points, &at_m, Point::from(point)) - wanted).abs() < 1e-12);
    }
    assert_eq!(nearest_m(&points[..1], &at_m[..1], points[2]), 0.0);
}
