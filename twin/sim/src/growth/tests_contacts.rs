//! Links where beads touch, what they carry, and what a landing's sum is made of.

use super::tests::{FROM_BED, LAW, Print, RADIUS_M};
use super::*;
use crate::structure::{At, Load, Support, solve};
use crate::test_job::strand;

/// Two strands side by side: a row of links, two diameters apart, across both; the later strand's weight goes through
/// them and out at the feet of the earlier one.
#[test]
fn a_strand_laid_along_another_is_linked_in_a_row() {
    let a = strand("a", &[[0.0, 0.0, 1.0], [40.0, 0.0, 1.0]], r#", "on": "bed""#);
    let b = strand("b", &[[0.0, 0.0, 3.0], [40.0, 0.0, 3.0]], "");
    let print = Print::new("", &[a, b]);
    let built = print.built();
    let links: Vec<usize> = (0..built.is_link.len()).filter(|&k| built.is_link[k]).collect();
    // 40 mm, a link every 4 mm, both ends among them
    assert_eq!(links.len(), 11);
    assert_eq!(built.welds.len(), 11);
    for (weld, &link) in built.welds.iter().zip(&links) {
        assert_eq!(weld.through, [(link, At::Middle)]);
        assert!((weld.normal - Vector::z()).norm() < 1e-9, "{}", weld.normal);
        let [from, to] = built.frame.members()[link].ends.map(|node| built.frame.nodes()[node]);
        assert!(((from - to).norm() - 2.0 * RADIUS_M).abs() < 1e-9);
    }
    let supports: Vec<Support> = built.supports(2, &[]);
    let gravity = [0.0, 0.0, -9.80665];
    let load = Load { gravity_m_s2: gravity, ..Load::default() };
    let solution = solve(&built.frame, &supports, &load).expect("it stands");
    let through: f64 = links.iter().map(|&link| solution.end_forces[link][8]).sum();
    let line = LAW.density_kg_m3 * std::f64::consts::PI * RADIUS_M * RADIUS_M * 9.80665;
    assert!((through / (line * 0.04) - 1.0).abs() < 1e-9, "{through}");
    let held: f64 = solution.reactions.iter().map(|reaction| reaction[2]).sum();
    assert!((held / (2.0 * line * 0.04) - 1.0).abs() < 1e-9, "{held}");
}

/// What a strand between two rigid ends locks in: `E A ε` in it, through both of its welds.
#[test]
fn shrinkage_pulls_at_both_welds() {
    // two stubs on the bed, a bridge between their tops so short that the stubs hardly bend
    let a = strand("a", &[[0.0, -20.0, 1.0], [0.0, 20.0, 1.0]], r#", "on": "bed""#);
    let b = strand("b", &[[30.0, -20.0, 1.0], [30.0, 20.0, 1.0]], r#", "on": "bed""#);
    let bridge = strand("bridge", &[[0.0, 0.0, 3.0], [30.0, 0.0, 3.0]], "");
    let mut print = Print::new("", &[a, b, bridge]);
    print.laws[2].strain = -1e-4;
    let (growth, _) = print.grown();
    let last = growth.stages.last().expect("stages");
    let used = last.weld.expect("welds are asked").share.nominal;
    // the links lean in: less than full restraint, but most of it; shear alone would use this much
    let section = std::f64::consts::PI * RADIUS_M * RADIUS_M;
    let full_n = LAW.e_pa * section * 1e-4;
    let shear = full_n / 1e-6 / (40e6 / 3f64.sqrt());
    assert!(used > 0.3 * shear, "{used} {shear}");
    assert!(last.states_m[0] > last.staged_m, "{last:?}");
    print.laws[2].strain = 0.0;
    let (slack, _) = print.grown();
    let slack = slack.stages.last().and_then(|stage| stage.weld).expect("welds are asked");
    assert!(slack.share.nominal < 0.01 * used);
}

/// The sum of a landing is that of its parts as vectors, and what would mend it leaves what it says.
#[test]
fn a_landing_is_the_sum_of_its_parts() {
    let a = strand("a", &[[0.0, 0.0, 1.0], [15.0, 0.0, 31.0]], FROM_BED);
    let b = strand("b", &[[15.0, 0.0, 31.0], [40.0, 0.0, 31.0]], "");
    let c = strand("c", &[[15.0, 20.0, 1.0], [15.0, 0.0, 31.0]], FROM_BED);
    let print = Print::new("", &[a, b, c]);
    let (growth, findings) = print.grown();
    let landing = &growth.landings[0];
    let sum =
        landing.frame_m + landing.shrinkage_m + landing.sag_m + landing.weight_m + landing.push_m;
    assert!((sum.norm() - landing.sum_m).abs() < 1e-15);
    assert_eq!((landing.strand, landing.at_end), (1, false));
    let found =
        findings.iter().find(|it| it.code == Code::S401).expect("a lone strut is pushed over");
    assert!(found.hint.contains("print it after `c`"), "{}", found.hint);
    let left = |change: &Change| {
        let remedy = landing.remedies.iter().find(|remedy| remedy.change == *change);
        remedy.unwrap_or_else(|| panic!("{:?}", landing.remedies)).left_m
    };
    // after `c` the node is braced: the same as the print in that order says
    let swapped = Print::new(
        r#""sequence": ["a", "c", "b"], "#,
        &[
            strand("a", &[[0.0, 0.0, 1.0], [15.0, 0.0, 31.0]], FROM_BED),
            strand("b", &[[15.0, 0.0, 31.0], [40.0, 0.0, 31.0]], ""),
            strand("c", &[[15.0, 20.0, 1.0], [15.0, 0.0, 31.0]], FROM_BED),
        ],
    );
    let (braced, _) = swapped.grown();
    let then = braced.landings.iter().find(|it| it.strand == 1).expect("`b` lands");
    let after = left(&Change::After(2));
    assert!((after / then.sum_m - 1.0).abs() < 0.01, "{after} {}", then.sum_m);
    assert!(left(&Change::Prop) < 0.1 * landing.sum_m);
}

/// A cantilever under a force across its tip: stiffness, weight, and the three yields of a strand without a node.
#[test]
fn a_load_case_tells_stiffness_and_weight() {
    let rod = strand("rod", &[[0.0, 0.0, 0.0], [0.0, 0.0, 40.0]], FROM_BED);
    let loads = r#""loads": [{"name": "push", "supports": [{"at_mm": [0, 0, 0], "fix": "xyzr"}],
        "forces": [{"at_mm": [0, 0, 40], "force_n": [0.1, 0, 0]}]}], "#;
    let (growth, _) = Print::new(loads, &[rod]).grown();
    let load = &growth.loads[0];
    let (length_m, area_m2) = (0.04, std::f64::consts::PI * RADIUS_M * RADIUS_M);
    let ei = LAW.e_pa * area_m2 * RADIUS_M * RADIUS_M / 4.0;
    let kappa = 6.0 * (1.0 + LAW.poisson) / (7.0 + 6.0 * LAW.poisson);
    let g_pa = LAW.e_pa / (2.0 * (1.0 + LAW.poisson));
    let gives = length_m * length_m * length_m / (3.0 * ei) + length_m / (kappa * g_pa * area_m2);
    assert!((load.load_n - 0.1).abs() < 1e-15);
    assert!((load.travel_m / (0.1 * gives) - 1.0).abs() < 1e-9, "{}", load.travel_m);
    let weight_n = LAW.density_kg_m3 * area_m2 * length_m * 9.80665;
    assert!((load.weight_n / weight_n - 1.0).abs() < 1e-9, "{}", load.weight_n);
    // 4 M/(π r³) reaches the strength, less what the weight presses
    let moment = std::f64::consts::PI * RADIUS_M * RADIUS_M * RADIUS_M / 4.0
        * (LAW.strength_pa - weight_n / area_m2);
    let first = load.first_yield().expect("it yields");
    assert!((first.factor / (moment / (0.1 * length_m)) - 1.0).abs() < 1e-9, "{first:?}");
    assert_eq!((first.strand, first.node), (Some(0), None));
    assert!((first.expected.nominal / first.factor - 0.77).abs() < 1e-12);
    // a circle's plastic moment is 16/(3 π) of the elastic one
    let plastic = load.plastic.expect("PLA is a thermoplastic") / first.factor;
    assert!(plastic > 1.65 && plastic < 1.7, "{plastic}");
}
