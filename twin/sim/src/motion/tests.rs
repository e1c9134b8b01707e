use super::*;
use crate::cell::{Job, LinearMove, Mode};
use crate::finding::{Code, Findings};
use crate::kinematics::Posture;
use crate::test_job::{CELLS, job, strand, text};
use crate::toolpath;

/// Print speed in all tests, and a bead so that nothing depends on the cell's own.
pub(super) const PROCESS: &str = r#""process": { "speed_mm_s": 2, "flow": { "diameter_mm": 2 } },"#;
/// A strand that lies, one that rises and turns.
const LYING: [[f64; 3]; 3] = [[-20.0, -10.0, 1.0], [20.0, -10.0, 1.0], [20.0, 15.0, 1.0]];
const RISING: [[f64; 3]; 4] =
    [[-20.0, 10.0, 1.0], [0.0, 12.0, 15.0], [10.0, 20.0, 25.0], [20.0, 5.0, 25.0]];

pub(super) fn planned(job: &Job) -> (Vec<Path>, Motion) {
    let paths = toolpath::paths(job);
    let motion = plan(job, &paths);
    (paths, motion)
}

/// Place and axis of the nozzle in part axes.
pub(super) fn nozzle(job: &Job, q: &Posture) -> (Point, Vector) {
    let tip = job.cell.robot.arm.chain.forward(q);
    let part_from_world = (job.cell.world_from_bed(&tip) * job.bed_from_part).inverse();
    let part_from_tool = part_from_world * job.cell.world_from_tool(&tip);
    (part_from_tool * Point::origin(), part_from_tool * Vector::z())
}

pub(super) fn prints(motion: &Motion) -> impl Iterator<Item = &Leg> {
    motion.legs.iter().filter(|leg| leg.phase == Phase::Print)
}

/// Both modes, all cells: at every sample the nozzle stands on the strand and points as it should.
#[test]
fn print_moments_lie_on_the_strand_in_every_cell() {
    let mut modes = Vec::new();
    for cell in CELLS {
        let follow = if cell == "printer-3axis" { "vertical" } else { "tangent" };
        let tilt = format!(r#", "orientation": {{ "follow": "{follow}" }}, "overrun_mm": 2"#);
        let strands =
            [strand("a", &LYING, ", \"overrun_mm\": 2"), strand("b", &RISING, &tilt)].join(",");
        let mut job = job(&text(cell, PROCESS, &strands));
        // Tools set per point leave the strand; that has tests of its own.
        job.cell.controller.linear = LinearMove::Tcp;
        modes.push(job.cell.mode);
        let (paths, motion) = planned(&job);
        assert_eq!(prints(&motion).count(), 2);
        for leg in prints(&motion) {
            let path = &paths[leg.strand.expect("a print has a strand")];
            assert!(leg.unreached.is_empty(), "{cell}: {:?}", leg.unreached);
            for sample in &path.samples {
                assert!(leg.moments.iter().any(|moment| moment.at_m == sample.at_m));
            }
            for moment in &leg.moments {
                let (k, sample) = place::sample_at(&path.samples, moment.at_m);
                let (point, axis) = nozzle(&job, &moment.q);
                assert_eq!(moment.at_m, sample.at_m);
                // Halving the way between two axes twice is not quartering it.
                let added = path.samples[k].at_m != moment.at_m;
                let even_rad = if added { 1e-2 } else { 1e-9 };
                let off_m = (point - sample.point).norm();
                assert!(off_m < 1e-9, "{cell}: {off_m:e} m off at {} m", sample.at_m);
                assert!(
                    (axis - sample.nozzle).norm() < even_rad,
                    "{cell}: {axis} for {}",
                    sample.nozzle
                );
            }
        }
    }
    assert!(modes.contains(&Mode::ToolOnFlange) && modes.contains(&Mode::BedOnFlange));
}

/// `t = ∫ ds/v`: 40 mm at 2 mm/s until 10.5 mm, at 5 mm/s until 25 mm, then at 1 mm/s.
#[test]
fn times_are_the_integral_of_the_inverse_speed() {
    let profile =
        r#", "profile": [{ "at_mm": 10.5, "speed_mm_s": 5 }, { "at_mm": 25, "speed_mm_s": 1 }]"#;
    let points_mm = [[0.0, 0.0, 1.0], [40.0, 0.0, 1.0]];
    let job = job(&text("kr10-cone", PROCESS, &strand("a", &points_mm, profile)));
    let path = &toolpath::paths(&job)[0];
    let times = strand::times(&job.strands[0], path);
    for (sample, time_s) in path.samples.iter().zip(&times) {
        let s = sample.at_m * 1e3;
        let wanted = s.min(10.5) / 2.0 + (s.clamp(10.5, 25.0) - 10.5) / 5.0 + (s.max(25.0) - 25.0);
        assert!((time_s - wanted).abs() < 1e-12, "{time_s} is not {wanted} at {s} mm");
    }
    assert!((times[times.len() - 1] - (5.25 + 2.9 + 15.0)).abs() < 1e-12);
}

#[test]
fn a_given_time_law_is_kept() {
    let points_mm = [[0.0, 0.0, 1.0], [10.0, 0.0, 1.0], [10.0, 30.0, 1.0]];
    let job =
        job(&text("kr10-cone", PROCESS, &strand("a", &points_mm, ", \"times_s\": [1, 2, 8]")));
    let path = &toolpath::paths(&job)[0];
    for (sample, time_s) in path.samples.iter().zip(strand::times(&job.strands[0], path)) {
        let s = sample.at_m * 1e3;
        let wanted = if s <= 10.0 { 1.0 + s / 10.0 } else { 2.0 + (s - 10.0) / 5.0 };
        assert!((time_s - wanted).abs() < 1e-12, "{time_s} at {s} mm");
    }
}

/// Phases in order, time never runs back, joints never faster than they can between prints.
#[test]
fn legs_follow_each_other_in_time() {
    for cell in ["kr10-cone", "kirkman-sda10d"] {
        let more = format!("{PROCESS} \"sequence\": [\"b\", {{ \"wait_s\": 7 }}, \"a\"],");
        let of_a = ", \"prime_s\": 0.5, \"dwell_s\": 2, \"start\": { \"dwell_s\": 1 }";
        let strands = [strand("a", &LYING, of_a), strand("b", &RISING, "")].join(",");
        let job = job(&text(cell, &more, &strands));
        let (paths, motion) = planned(&job);
        let phases: Vec<_> =
            motion.legs.iter().map(|leg| (leg.phase, leg.strand, leg.printed)).collect();
        let of = |strand: usize, printed: usize| {
            [(Phase::Transit, 0usize), (Phase::Approach, 0), (Phase::Print, 0), (Phase::Retract, 1)]
                .map(|(phase, more)| (phase, Some(strand), printed + more))
        };
        let home = [(Phase::Transit, None, 2)];
        assert_eq!(phases, [&of(1, 0)[..], &of(0, 1), &home].concat());
        let last = motion.legs[motion.legs.len() - 1].moments.last().expect("it moves");
        assert_eq!(*last.q, job.cell.home[..]);
        let order: Vec<usize> = motion.printings.iter().map(|printing| printing.strand).collect();
        assert_eq!(order, [1, 0]);
        let moments: Vec<(&Leg, &Moment)> = motion
            .legs
            .iter()
            .flat_map(|leg| leg.moments.iter().map(move |moment| (leg, moment)))
            .collect();
        let axes = job.cell.robot.arm.chain.axes();
        for pair in moments.windows(2) {
            let dt_s = pair[1].1.time_s - pair[0].1.time_s;
            assert!(dt_s >= 0.0, "{cell}: time runs back");
            let travels = pair[0].0.phase == pair[1].0.phase && pair[1].0.phase != Phase::Print;
            for (k, axis) in axes.iter().enumerate().filter(|_| travels) {
                let needed_s = (pair[1].1.q[k] - pair[0].1.q[k]).abs() / axis.velocity;
                assert!(
                    dt_s >= needed_s - 1e-12,
                    "{cell}: joint {k} needs {needed_s} s, has {dt_s}"
                );
            }
        }
        let [b, a] = [&motion.printings[0], &motion.printings[1]];
        // Rests at both ends and, unless corners are rounded, at the one in between: a ramp loses half
        // its time.
        let (ramp_s, _) = job.cell.controller.ramp(2e-3);
        let n_ramps = if job.cell.controller.blend_m > 0.0 { 2.0 } else { 4.0 };
        let lost_s = a.end_s - a.start_s - paths[0].length_m / 2e-3;
        assert!((lost_s - n_ramps * ramp_s / 2.0).abs() < 5e-3 * ramp_s, "{cell}: {lost_s} s");
        // the wait, priming and the dwell at the start all pass before it
        assert!(a.start_s >= b.end_s + 7.0 + 0.5 + 1.0);
        assert!(motion.total_s >= a.end_s + 2.0);
    }
}

/// Approach and retract: from `approach_mm` straight above the ends, along the nozzle.
#[test]
fn approach_and_retract_are_straight() {
    let job = job(&text("kr10-cone", PROCESS, &strand("a", &LYING, ", \"retract_mm\": 12")));
    let (paths, motion) = planned(&job);
    let samples = &paths[0].samples;
    let ends =
        [(Phase::Approach, samples[0], 20e-3), (Phase::Retract, samples[samples.len() - 1], 12e-3)];
    for (phase, sample, length_m) in ends {
        let leg = motion.legs.iter().find(|leg| leg.phase == phase).expect("there is one");
        let mut furthest_m = 0.0f64;
        for moment in &leg.moments {
            let (point, axis) = nozzle(&job, &moment.q);
            let back_m = -(point - sample.point).dot(&sample.nozzle);
            furthest_m = furthest_m.max(back_m);
            assert!((point + sample.nozzle * back_m - sample.point).norm() < 1e-9);
            assert!((axis - sample.nozzle).norm() < 1e-9);
        }
        assert!((furthest_m - length_m).abs() < 1e-9, "{phase:?}: {furthest_m}");
    }
}

/// Out of reach is a finding with its place; the rest of the strand and the next are printed.
#[test]
fn what_is_out_of_reach_is_told() {
    let far = strand("far", &[[0.0, 0.0, 1.0], [2500.0, 0.0, 1.0]], "");
    let further = strand("further", &[[3000.0, 0.0, 1.0], [3100.0, 0.0, 1.0]], "");
    let job = job(&text("kr10-cone", PROCESS, &[far, further, strand("a", &LYING, "")].join(",")));
    let (paths, motion) = planned(&job);
    let mut findings = Findings::default();
    let strands = check(&job, &paths, &motion, &mut findings);
    let out = findings.sorted();
    let out: Vec<_> = out.iter().filter(|finding| finding.code == Code::R101).collect();
    assert_eq!(
        out.iter().map(|finding| finding.site.strand).collect::<Vec<_>>(),
        [Some(0), Some(1)]
    );
    let at_m = out[0].site.at_m.expect("a place");
    assert!(at_m > 0.1 && at_m < 1.2, "{at_m}");
    assert!(strands[0].is_some() && strands[1].is_none() && strands[2].is_some());
    assert_eq!(motion.printings.len(), 3);
    let legs: Vec<&Leg> = prints(&motion).collect();
    assert!(legs[0].moments.len() + legs[0].unreached.len() >= paths[0].samples.len());
}
