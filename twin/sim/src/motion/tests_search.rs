//! The search over branch, spin, lean and elbow angle.

use std::sync::atomic::{AtomicUsize, Ordering};

use super::cost::{Costs, Step};
use super::place::{self, Course, Turn};
use super::tests::{PROCESS, nozzle, planned, prints};
use super::*;
use crate::cell::Job;
use crate::finding::{Code, Findings, Severity};
use crate::kinematics::nearness;
use crate::test_job::{CELLS, job, strand, text};
use crate::toolpath;

const SHORT: [[f64; 3]; 2] = [[-9.0, 5.0, 20.0], [9.0, 9.0, 20.0]];

fn orientation(cell: &str, points_mm: &[[f64; 3]], keys: &str) -> Job {
    let more = format!(r#", "orientation": {{ {keys} }}"#);
    job(&text(cell, PROCESS, &strand("a", points_mm, &more)))
}

#[test]
fn leans_keep_to_the_cone_and_to_the_two_axes() {
    let cone = orientation("kr10-cone", &SHORT, r#""tilt_free_deg": 30, "tilt_max_deg": 40"#);
    let cone = cone.strands[0].settings.orientation;
    let axis = Vector::new(0.5, 0.0, -0.75f64.sqrt());
    for k in 0..36 {
        let (sin, cos) = (f64::from(k) * 10f64.to_radians()).sin_cos();
        for lean_deg in [1.0f64, 9.9, 10.1, 29.9, 30.1] {
            let lean = lean_deg.to_radians();
            let leaned = tilt::leaned(&axis, [lean * cos, lean * sin], &cone);
            if let Some(leaned) = leaned {
                assert!((leaned.angle(&axis) - lean).abs() < 1e-9);
                assert!(leaned.angle(&-Vector::z()) <= 40.001f64.to_radians());
            }
            // 30° of tilt already: 9.9° more is always within 40°, 30.1° never within the cone.
            assert!(lean_deg > 9.9 || leaned.is_some());
            assert!(lean_deg < 30.1 || leaned.is_none());
        }
    }
    let mut axes = cone;
    axes.tilt = crate::cell::Tilt::PerAxis;
    let leaned = |a_deg: f64, b_deg: f64| {
        let lean = tilt::leaned(&-Vector::z(), [a_deg.to_radians(), b_deg.to_radians()], &axes)?;
        Some([(lean.x / lean.z).atan().to_degrees(), (lean.y / lean.z).atan().to_degrees()])
    };
    let both = leaned(30.0, -29.0).expect("each within its bound");
    assert!((both[0] - 30.0).abs() < 1e-9 && (both[1] + 29.0).abs() < 1e-9);
    assert!(leaned(31.0, 0.0).is_none() && leaned(0.0, -31.0).is_none());
}

/// A lean reaches further than a nozzle that stands: less of a strand is out of reach, within the bounds.
#[test]
fn a_lean_reaches_further() {
    let far = [[0.0, 0.0, 1.0], [700.0, 0.0, 1.0]];
    let unreached = |keys: &str| {
        let job = orientation("kr10-cone", &far, keys);
        let (_, motion) = planned(&job);
        let leg = prints(&motion).next().expect("one print").clone();
        for moment in &leg.moments {
            let (_, axis) = nozzle(&job, &moment.q);
            assert!(axis.angle(&-Vector::z()) <= 25.01f64.to_radians(), "{axis}");
        }
        leg.unreached.first().map_or(f64::INFINITY, |(at_m, _)| *at_m)
    };
    let stands = unreached(r#""tilt_max_deg": 25"#);
    let leans = unreached(r#""tilt_max_deg": 25, "tilt_free_deg": 60"#);
    assert!(leans > stands + 0.02, "{leans} against {stands}");
}

/// Free spin about the nozzle's own axis, in every cell, a fixed nozzle included: never worse than any
/// held spin of the fan.
#[test]
fn a_free_spin_is_no_worse_than_a_held_one() {
    for cell in CELLS.into_iter().filter(|cell| *cell != "printer-3axis") {
        let weigh = |keys: &str| {
            let job = orientation(cell, &SHORT, keys);
            let (paths, motion) = planned(&job);
            let leg = prints(&motion).next().expect("one print");
            if !leg.unreached.is_empty() {
                return f64::INFINITY;
            }
            let costs = Costs::new(&job);
            let [first, last] = [&leg.moments[0].q, &leg.moments[leg.moments.len() - 1].q];
            let step = Step { dt_s: paths[0].length_m / 2e-3, bow_m_per_rad: 0.0 };
            costs.travel(&job.cell.home, first)
                + costs.posture(first)
                + costs.posture(last)
                + costs.step(first, last, 0.0, &step)
        };
        let free = weigh("");
        assert!(free.is_finite(), "{cell}");
        for k in 0..12 {
            let held = weigh(&format!(r#""spin": {}"#, 30 * k));
            // an elbow angle on the fan may be refined from either
            let slack = if cell == "kirkman-sda10d" { 0.3 } else { 1e-6 };
            assert!(free <= held + slack, "{cell}: {free} free, {held} held at {}°", 30 * k);
        }
    }
}

/// The refinement only ever makes the strand cheaper, keeps its branch, and leaves the fan.
#[test]
fn refined_turns_are_cheaper_and_off_the_fan() {
    let points_mm = [[-60.0, 30.0, 10.0], [60.0, -10.0, 10.0]];
    let job = orientation("kr10-cone", &points_mm, r#""tilt_free_deg": 10"#);
    let paths = toolpath::paths(&job);
    let course = Course::new(&job, &paths[0]);
    let ladder = &ladder::rungs_of(&job, &paths, &[0])[0];
    let home = Posture::new(&job.cell.home);
    let coarse = strand::posts(ladder, &climb::climb(&course, ladder, &home));
    let mut fine = coarse.clone();
    refine::refine(&course, &mut fine, &home, None);
    let weigh = |posts: &[walk::Post]| {
        let step = |pair: &[walk::Post]| {
            let step = ladder::step(&course, pair[0].sample, pair[1].sample);
            course.costs.step(&pair[0].q, &pair[1].q, 0.0, &step)
        };
        posts.iter().map(|post| course.costs.posture(&post.q)).sum::<f64>()
            + posts.windows(2).map(step).sum::<f64>()
            + course.costs.travel(&home, &posts[0].q)
    };
    assert!(weigh(&fine) < weigh(&coarse) - 0.01, "{} of {}", weigh(&fine), weigh(&coarse));
    assert!(fine.iter().zip(&coarse).all(|(a, b)| a.branch == b.branch));
    for post in &fine {
        let pose = course.pose(&paths[0].samples[post.sample], &post.turn).expect("within");
        let got = job.cell.bed_from_tool(&post.q);
        assert!((got.translation.vector - pose.translation.vector).norm() < 1e-9);
    }
}

/// Every full-turn copy within the stops is a candidate.
#[test]
fn joints_with_more_than_a_turn_keep_their_wraps() {
    let job = orientation("kr10-cone", &SHORT, "");
    let paths = toolpath::paths(&job);
    let ladder = &ladder::rungs_of(&job, &paths, &[0])[0];
    let axis = job.cell.robot.arm.chain.axes()[5];
    let candidates = &ladder.rungs[0].candidates;
    let mut copies = 0;
    for candidate in candidates {
        for turn in [-std::f64::consts::TAU, std::f64::consts::TAU] {
            let mut copy = candidate.q;
            copy[5] += turn;
            if copy[5] > axis.lower && copy[5] < axis.upper {
                copies += 1;
                assert!(candidates.iter().any(|other| other.q.distance(&copy) < 1e-9));
            }
        }
    }
    assert!(copies > candidates.len() / 2, "{copies} of {}", candidates.len());
}

/// What comes too near is shunned, by looking at a few postures only.
#[test]
fn what_comes_too_near_is_shunned() {
    let job = orientation("kr10-cone", &SHORT, "");
    let paths = toolpath::paths(&job);
    let ladder = &ladder::rungs_of(&job, &paths, &[0])[0];
    let home = Posture::new(&job.cell.home);
    let side = |q: &Posture| (job.cell.bed_from_tool(q) * Vector::x()).normalize();
    let plain = strand::postures(&job, &paths[0], ladder, &home);
    let bad = side(&plain.q[0].expect("reached"));
    let looks = AtomicUsize::new(0);
    // Everything within 50° of the spin that would be taken hits.
    let clearance = |_: &toolpath::Sample, q: &Posture| {
        looks.fetch_add(1, Ordering::Relaxed);
        if side(q).angle(&bad) < 50f64.to_radians() { -1e-3 } else { 20e-3 }
    };
    let clear = strand::postures_clear(&job, &paths[0], ladder, &home, Some(&clearance));
    for q in clear.q.iter().flatten() {
        assert!(side(q).angle(&bad) > 49f64.to_radians());
    }
    let n_candidates: usize = ladder.rungs.iter().map(|rung| rung.candidates.len()).sum();
    assert!(
        looks.load(Ordering::Relaxed) < n_candidates,
        "{} looks at {n_candidates}",
        looks.load(Ordering::Relaxed)
    );
    // Where everything hits there is still a way, for the findings to tell.
    let hits = |_: &toolpath::Sample, _: &Posture| -5e-3;
    let any = strand::postures_clear(&job, &paths[0], ladder, &home, Some(&hits));
    assert!(any.q.iter().all(Option::is_some));
}

/// A nozzle that swings by 80° within 12 mm: the way between rungs stays even, by samples of its own
/// where joints turn fast, or it is told.
#[test]
fn fast_turns_are_followed_closely_or_told() {
    let points_mm: Vec<[f64; 3]> = (0..=4).map(|k| [4.0 * f64::from(k), 0.0, 30.0]).collect();
    let direction = |k: i32| {
        let tilt = (f64::from(k) * 20.0 - 40.0).to_radians();
        [0.0, tilt.sin(), -tilt.cos()]
    };
    let directions: Vec<[f64; 3]> = (0..=4).map(direction).collect();
    let more = format!(r#", "directions": {directions:?}, "speed_mm_s": 0.5"#);
    for cell in ["kr10-cone", "kr6-hot-end"] {
        let job = job(&text(cell, PROCESS, &strand("a", &points_mm, &more)));
        let (paths, motion) = planned(&job);
        let leg = prints(&motion).next().expect("one print");
        let mut findings = Findings::default();
        check(&job, &paths, &motion, &mut findings);
        let told = findings.sorted().iter().any(|f| matches!(f.code, Code::R101 | Code::R104));
        assert!(told || leg.moments.len() > paths[0].samples.len(), "{cell}");
        for pair in leg.moments.windows(2) {
            let middle = pair[0].q.toward(&pair[1].q, 0.5);
            let at_m = (pair[0].at_m + pair[1].at_m) / 2.0;
            let (_, sample) = place::sample_at(&paths[0].samples, at_m);
            let off_m = (nozzle(&job, &middle).0 - sample.point).norm();
            assert!(told || off_m < 0.3e-3, "{cell}: {off_m} at {at_m}");
        }
        let times: Vec<f64> = leg.moments.iter().map(|moment| moment.time_s).collect();
        assert!(times.is_sorted());
    }
}

/// The numbers of a strand are those of its worst moment, with the place; a wrist nearer than the cell
/// allows warns.
#[test]
fn strand_numbers_are_those_of_the_worst_moment() {
    let points_mm = [[-60.0, 30.0, 10.0], [60.0, -10.0, 10.0]];
    for cell in ["kr10-cone", "kirkman-sda10d"] {
        let mut job = orientation(cell, &points_mm, "");
        let (paths, motion) = planned(&job);
        let along = check(&job, &paths, &motion, &mut Findings::default())[0].expect("reached");
        let leg = prints(&motion).next().expect("one print");
        let arm = &job.cell.robot.arm;
        let least = |of: &dyn Fn(&crate::kinematics::Nearness) -> Option<f64>| {
            let all = leg.moments.iter().map(|moment| (of(&nearness(arm, &moment.q)), moment.at_m));
            all.filter_map(|(value, at_m)| Some((value?, at_m)))
                .min_by(|a, b| a.0.total_cmp(&b.0))
                .expect("known arms")
        };
        let wrist = least(&|near| near.wrist_rad);
        assert_eq!((along.wrist_rad.expect("known"), along.wrist_at.at_m), wrist, "{cell}");
        let elbow = least(&|near| near.elbow_rad);
        assert_eq!((along.elbow_rad.expect("known"), along.elbow_at.at_m), elbow);
        let shoulder = least(&|near| near.shoulder_m);
        assert_eq!((along.shoulder_m.expect("known"), along.shoulder_at.at_m), shoulder);
        let condition = least(&|near| Some(-near.condition));
        assert_eq!((-along.condition_number, along.condition_at.at_m), condition);
        assert!(along.joint_margin_at.axis.is_some() && along.joint_speed_at.axis.is_some());

        job.limits.wrist_rad = wrist.0 * 1.1;
        let mut findings = Findings::default();
        check(&job, &paths, &motion, &mut findings);
        let found = findings.sorted();
        let near = found.iter().find(|f| f.code == Code::R103).expect("a warning");
        assert!(
            near.severity == Severity::Warning && near.message.starts_with("wrist"),
            "{near:?}"
        );
    }
}

#[test]
fn turns_mix_on_the_shorter_way() {
    let (from, to) = (Turn::new(6.2, [0.0, 0.1], 3.0), Turn::new(0.1, [0.2, 0.1], -3.0));
    let half = from.mix(&to, 0.5).0;
    let tau = std::f64::consts::TAU;
    let back = half[Turn::SPIN] - 6.2;
    assert!((back - (0.1 + tau - 6.2) / 2.0).abs() < 1e-12);
    assert!((half[Turn::LEAN] - 0.1).abs() < 1e-12 && (half[Turn::LEAN + 1] - 0.1).abs() < 1e-12);
    assert!((half[Turn::ELBOW] - (3.0 + (tau - 6.0) / 2.0)).abs() < 1e-12);
}
