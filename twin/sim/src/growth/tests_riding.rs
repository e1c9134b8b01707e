use super::tests::{FROM_BED, LAW, Print};
use super::*;
use crate::motion::Ride;
use crate::structure::Section;
use crate::test_job::{job, strand, text};

/// A strand that leans by 45° in the cell whose bed rides, with a long retract.
fn leaning(acceleration_m_s2: f64) -> Print {
    let a = strand("a", &[[0.0, 0.0, 1.0], [40.0, 0.0, 41.0]], FROM_BED);
    let mut job = job(&text("kirkman-sda10d", "", &a));
    job.cell.controller.acceleration_m_s2 = acceleration_m_s2;
    job.cell.controller.jerk_m_s3 = acceleration_m_s2 / 0.025;
    job.cell.extruder.travel_m_s = 0.2;
    job.strands[0].settings.retract_m = 0.03;
    Print::of(job)
}

fn during(print: &Print, phase: Phase) -> Vec<Ride> {
    let motion = &print.motion;
    let of = |ride: &&Ride| motion.legs[ride.leg].phase == phase;
    motion.rides.iter().filter(of).copied().collect()
}

/// The arm leaves it straight along the nozzle: the bed moves without turning, and across the strand
/// acts `a sin 45°`. The tip by `2 ρ a sin 45° L⁴/(E D²)` of bending, `ρ a sin 45° L²/(2 κ G)` of shear.
#[test]
fn a_leaning_strand_is_shaken_as_in_the_books() {
    let mut print = leaning(5.0);
    print.motion.rides = during(&print, Phase::Retract);
    let turns = |ride: &Ride| ride.carried.omega_rad_s.norm() + ride.carried.alpha_rad_s2.norm();
    let most = |of: &dyn Fn(&Ride) -> f64| print.motion.rides.iter().map(of).fold(0.0, f64::max);
    let most_m_s2 = most(&|ride| ride.carried.acceleration_m_s2.norm());
    assert!((4.5..5.2).contains(&most_m_s2), "{most_m_s2}");
    assert!(most(&turns) < 0.05 * most_m_s2, "{}", most(&turns));
    let (growth, _) = print.grown();
    let shaken = growth.stages[0].shaken.expect("it is shaken");
    let (across, length_m) = (most_m_s2 * 0.5f64.sqrt() * LAW.density_kg_m3, 0.04 * 2f64.sqrt());
    let kappa_g = Section::cowper_circle(LAW.poisson) * LAW.e_pa / (2.0 * (1.0 + LAW.poisson));
    let wanted_m = 2.0 * across * length_m.powi(4) / (LAW.e_pa * LAW.diameter_m.powi(2))
        + across * length_m.powi(2) / (2.0 * kappa_g);
    // the strand stretches a little too, and joints that turn evenly between places of the retract turn the bed
    assert!((shaken.translation_m / wanted_m - 1.0).abs() < 0.02, "{shaken:?} {wanted_m:e}");
    assert_eq!((shaken.phase, shaken.node), (Phase::Retract, growth.built.ends[0][1]));
}

/// All moves together are no less, a gentler arm shakes less, and past the limit it is told.
#[test]
fn a_gentler_arm_shakes_less() {
    let [hard, gentle] = [5.0, 0.5].map(|acceleration| {
        let print = leaning(acceleration);
        print.grown().0.stages[0].shaken.expect("it is shaken").translation_m
    });
    assert!(gentle < 0.5 * hard, "{gentle} {hard}");
    let mut print = leaning(5.0);
    print.job.limits.node_miss_m = 0.9 * hard;
    let (growth, findings) = print.grown();
    let found = findings.iter().find(|found| found.code == Code::S409).expect("past the limit");
    assert_eq!(found.measured.nominal, hard);
    assert_eq!(
        (found.site.stage, found.time_s),
        (Some(1), growth.stages[0].shaken.map(|s| s.time_s))
    );
}

/// What moves while a strand is printed shakes the frame as it stood before.
#[test]
fn a_move_shakes_what_stands_then() {
    let a = strand("a", &[[0.0, 0.0, 1.0], [0.0, 0.0, 30.0]], FROM_BED);
    let b = strand("b", &[[20.0, 0.0, 1.0], [20.0, 0.0, 60.0]], FROM_BED);
    let mut print = Print::of(job(&text("kirkman-sda10d", "", &[a, b].join(","))));
    let whole = print.grown().0;
    let node = |strand: usize| whole.built.ends[strand][1];
    print.motion.rides = during(&print, Phase::Print);
    let stages = print.grown().0.stages;
    let shaken = stages[0].shaken.expect("while `b` is printed");
    assert_eq!((shaken.node, shaken.strand), (node(0), Some(1)));
    // nothing is printed after `b`
    assert!(stages[1].shaken.is_none());
    let longer = whole.stages[1].shaken.expect("on the way home");
    assert_eq!((longer.node, longer.phase == Phase::Print), (node(1), false));
}

#[test]
fn a_bed_that_stands_shakes_nothing() {
    let a = strand("a", &[[0.0, 0.0, 5.0], [30.0, 0.0, 5.0]], FROM_BED);
    let print = Print::of(job(&text("kr10-cone", "", &a)));
    assert!(print.motion.rides.is_empty());
    assert!(print.grown().0.stages[0].shaken.is_none());
}
