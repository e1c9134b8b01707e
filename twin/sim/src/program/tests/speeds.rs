use super::*;
use crate::cell::{Controller, LinearMove};
use crate::{motion, toolpath};
use nalgebra::DVector;

/// Between moments 4 mm apart joints that turn evenly bow the way by a few millionths of it.
const BOW: f64 = 1e-5;

const PROCESS: &str = r#""process": { "speed_mm_s": 5, "flow": { "diameter_mm": 2 } },"#;

/// The job of one strand with its way, and the leg that prints it.
fn printed(points: &[[f64; 3]], more: &str) -> (Job, Vec<crate::toolpath::Path>, Motion) {
    let job = job(&text("kr6-hot-end", PROCESS, &strand("a", points, more)));
    let paths = toolpath::paths(&job);
    let motion = motion::plan(&job, &paths);
    (job, paths, motion)
}

fn print_of(motion: &mut Motion) -> &mut Leg {
    motion.legs.iter_mut().find(|leg| leg.phase == Phase::Print).unwrap()
}

/// Gives the moments of the print times by a law of the arc length.
fn timed(motion: &mut Motion, time: impl Fn(f64) -> f64) {
    for moment in &mut print_of(motion).moments {
        moment.time_s = time(moment.at_m);
    }
}

#[test]
fn a_speed_kept_is_told_as_one() {
    let (job, paths, mut motion) = printed(&LYING, "");
    timed(&mut motion, |at_m| 3.0 + at_m / 5e-3);
    let speeds = speeds(&job, &paths, &motion);
    assert_eq!(speeds.len(), 1);
    for extreme in speeds[0].beyond.iter().chain(&speeds[0].overall) {
        assert!((extreme.ratio - 1.0).abs() < BOW, "{extreme:?}");
    }
    assert!((speeds[0].window_m - 2e-3).abs() < 1e-12);
    assert!(found(|findings| judge_speeds(&job, &speeds, findings)).is_empty());
}

/// Twice as fast on a stretch: told there, with a bead of 1/√2.
#[test]
fn a_faster_stretch_narrows_the_bead() {
    let (job, paths, mut motion) = printed(&LYING, "");
    let fast = |at_m: f64| {
        let quick_m = (at_m - 0.016_f64).clamp(0.0, 0.008);
        (at_m - quick_m) / 5e-3 + quick_m / 10e-3
    };
    timed(&mut motion, fast);
    let speeds = speeds(&job, &paths, &motion);
    let [slow, fast] = speeds[0].beyond;
    assert!((slow.ratio - 1.0).abs() < BOW && (fast.ratio - 2.0).abs() < BOW, "{fast:?}");
    assert!((fast.bead_factor() - 0.5_f64.sqrt()).abs() < BOW);
    assert!((0.016..0.024).contains(&fast.at_m));
    let told = found(|findings| judge_speeds(&job, &speeds, findings));
    assert_eq!((told.len(), told[0].code, told[0].severity), (1, Code::R108, Severity::Error));
    assert!((told[0].measured.nominal - 1.0).abs() < BOW && told[0].limit == 0.1);
    assert!(told[0].message.contains("100.0 % faster"), "{}", told[0].message);
    assert!(told[0].message.contains("71 % as thick"), "{}", told[0].message);
    assert!(told[0].hint.contains("2.00 times the flow"), "{}", told[0].hint);
}

/// A ramp from rest and to rest is expected, a stop half way is not; both are in the numbers.
#[test]
fn ramps_are_not_held_against_the_strand_but_stops_are() {
    let (mut job, paths, mut motion) = printed(&LYING, "");
    job.cell.controller =
        Controller { acceleration_m_s2: 5e-3, jerk_m_s3: 1e9, ..job.cell.controller };
    let (a, v, length_m) = (5e-3, 5e-3, paths[0].length_m);
    let ramp_m = v * v / (2.0 * a);
    assert!((job.cell.controller.ramp(v).1 - ramp_m).abs() < 1e-6);
    // s = a t²/2 on the ramps, in fine steps, v in between.
    let law = |at_m: f64| {
        let rest_s = v / a;
        if at_m < ramp_m {
            (2.0 * at_m / a).sqrt()
        } else if at_m > length_m - ramp_m {
            let left_s = (2.0 * (length_m - at_m).max(0.0) / a).sqrt();
            2.0 * rest_s + (length_m - 2.0 * ramp_m) / v - left_s
        } else {
            rest_s + (at_m - ramp_m) / v
        }
    };
    refine(&mut motion, 40);
    timed(&mut motion, law);
    let ramped = speeds(&job, &paths, &motion);
    let [slow, fast] = ramped[0].beyond;
    assert!((slow.ratio - 1.0).abs() < 0.01 && (fast.ratio - 1.0).abs() < 0.01, "{slow:?}");
    assert!(ramped[0].overall[0].ratio < 0.7, "{:?}", ramped[0].overall);
    assert!((ramped[0].ramps_m[0] - ramp_m).abs() < 1e-6);
    assert!(found(|findings| judge_speeds(&job, &ramped, findings)).is_empty());
    // A second of rest in the middle of a 2 mm bead of 0.4 s.
    timed(&mut motion, |at_m| at_m / v + if at_m > length_m / 2.0 { 1.0 } else { 0.0 });
    let stopped = speeds(&job, &paths, &motion);
    let told = found(|findings| judge_speeds(&job, &stopped, findings));
    assert_eq!(told.len(), 1);
    // Even joints between samples 4 mm apart are not quite even along the line.
    let ratio = 0.4 / 1.4;
    assert!(
        (told[0].measured.nominal - (1.0 - ratio)).abs() < 1e-3,
        "{}",
        told[0].measured.nominal
    );
}

/// Splits every step of the print into `n` even ones of the joints.
fn refine(motion: &mut Motion, n: usize) {
    let leg = print_of(motion);
    let mut fine = vec![leg.moments[0]];
    for pair in leg.moments.windows(2) {
        for k in 1..=n {
            let share = k as f64 / n as f64;
            let mut moment = pair[1];
            moment.at_m = pair[0].at_m + (pair[1].at_m - pair[0].at_m) * share;
            for (value, (a, b)) in moment.q.iter_mut().zip(pair[0].q.iter().zip(pair[1].q.iter())) {
                *value = a + (b - a) * share;
            }
            fine.push(moment);
        }
    }
    leg.moments = fine;
}

/// Joints that turn evenly between two far rows: the speed along the way is the Jacobian's.
#[test]
fn even_joints_go_as_the_jacobian_says() {
    let (mut job, paths, motion) = printed(&[[-60.0, 0.0, 1.0], [60.0, 0.0, 1.0]], "");
    let moments = &motion.legs.iter().find(|leg| leg.phase == Phase::Print).unwrap().moments;
    let (first, last) = (moments[0].q, moments[moments.len() - 1].q);
    let rate: Vec<f64> = last.iter().zip(first.iter()).map(|(b, a)| (b - a) / 24.0).collect();
    let at = |time_s: f64| {
        let mut q = first;
        for (value, rate) in q.iter_mut().zip(&rate) {
            *value += rate * time_s;
        }
        q
    };
    let even = |k: u32| {
        let time_s = f64::from(k) * 0.2;
        Moment { time_s, at_m: 0.12 * time_s / 24.0, q: at(time_s) }
    };
    let motion = motion_of(vec![leg(Phase::Print, Some(0), (0..=120).map(even).collect())]);
    job.cell.controller.acceleration_m_s2 = 1e3;
    job.cell.controller.jerk_m_s3 = 1e9;
    let speeds = speeds(&job, &paths, &motion);
    let tcp_chain = job.cell.robot.arm.chain.with_tip(&job.cell.tool_pose);
    let by_jacobian = |time_s: f64| {
        let twist = tcp_chain.jacobian(&at(time_s)) * DVector::from_column_slice(&rate);
        twist.fixed_rows::<3>(0).norm() / 5e-3
    };
    let all: Vec<f64> = (0..=240).map(|k| by_jacobian(f64::from(k) * 0.1)).collect();
    let (slow, fast) =
        (all.iter().fold(f64::MAX, |a, b| a.min(*b)), all.iter().fold(0.0_f64, |a, b| a.max(*b)));
    assert!(fast - slow > 0.003, "the speed varies: {slow} to {fast}");
    let [found_slow, found_fast] = speeds[0].overall;
    assert!((found_slow.ratio - slow).abs() < 2e-3 * slow, "{} for {slow}", found_slow.ratio);
    assert!((found_fast.ratio - fast).abs() < 2e-3 * fast, "{} for {fast}", found_fast.ratio);
}

/// Given times that disagree with the asked speed: 40 mm in 5 s where 5 mm/s are asked.
#[test]
fn given_times_are_held_against_the_asked_speed() {
    let (job, paths, mut motion) = printed(&LYING, r#", "times_s": [0, 5]"#);
    timed(&mut motion, |at_m| at_m / 8e-3);
    let speeds = speeds(&job, &paths, &motion);
    assert!((speeds[0].beyond[1].ratio - 1.6).abs() < BOW, "{:?}", speeds[0].beyond);
}

/// A strand shorter than its ramps is judged in its middle; one moment is nothing to judge.
#[test]
fn short_strands_are_judged_in_the_middle() {
    let (mut job, paths, mut motion) = printed(&LYING, "");
    job.cell.controller.acceleration_m_s2 = 1e-4;
    timed(&mut motion, |at_m| at_m / 2.5e-3);
    let judged = speeds(&job, &paths, &motion);
    assert!((judged[0].beyond[0].ratio - 0.5).abs() < BOW);
    assert!((judged[0].beyond[0].at_m - 0.02).abs() < 1e-6);
    print_of(&mut motion).moments.truncate(1);
    assert!(speeds(&job, &paths, &motion).is_empty());
    print_of(&mut motion).moments.clear();
    assert!(speeds(&job, &paths, &motion).is_empty());
}

/// `s = v²/2a` without jerk; with it the time to build up acceleration is added.
#[test]
fn ramps_follow_their_law() {
    let controller = |a: f64, j: f64| Controller {
        linear: LinearMove::Tcp,
        acceleration_m_s2: a,
        jerk_m_s3: j,
        joint_acceleration_share: 1.0,
        blend_m: 0.0,
        joint_move_share: 1.0,
    };
    let (time_s, length_m) = controller(2.0, 1e12).ramp(0.1);
    assert!((time_s - 0.05).abs() < 1e-9 && (length_m - 0.1_f64.powi(2) / 4.0).abs() < 1e-9);
    let (time_s, _) = controller(2.0, 100.0).ramp(0.1);
    assert!((time_s - 0.07).abs() < 1e-12);
    // Too slow to reach full acceleration: j t²/4 = v.
    let (time_s, length_m) = controller(2.0, 100.0).ramp(0.01);
    assert!((100.0 * time_s * time_s / 4.0 - 0.01).abs() < 1e-15);
    assert!((length_m - 0.01 * time_s / 2.0).abs() < 1e-15);
}
