use super::*;
use crate::pose::Pose;
use std::f64::consts::{FRAC_PI_2, PI};

/// A job in the cell of the KR 6 with one hose from link 3 to above the tool.
fn with_hose(length_m: f64, twist_rad: f64) -> Job {
    let mut job = job(&text("kr6-hot-end", "", &strand("a", &LYING, "")));
    let link = job.cell.robot.links.iter().find(|link| link.name == "link_3").unwrap().clone();
    job.cell.hoses.push(Hose {
        name: "feed".to_owned(),
        link: link.name,
        carrier: link.carrier,
        carrier_from_link: link.carrier_from_link,
        from: Point::new(0.0, 0.0, 0.1),
        to: Point::new(0.0, 0.03, -0.12),
        length_m,
        radius_m: 4e-3,
        twist_rad,
    });
    job
}

/// One transit through these postures.
fn through(postures: &[[f64; 6]]) -> Motion {
    let moment =
        |(k, q): (usize, &[f64; 6])| Moment { time_s: k as f64, at_m: 0.0, q: Posture::new(q) };
    let moments = postures.iter().enumerate().map(moment).collect();
    motion_of(vec![leg(Phase::Transit, Some(0), moments)])
}

fn home(job: &Job) -> [f64; 6] {
    job.cell.home.as_slice().try_into().unwrap()
}

fn turned(q: [f64; 6], joint: usize, angle_rad: f64) -> [f64; 6] {
    let mut q = q;
    q[joint] += angle_rad;
    q
}

/// The last joint turns about the tool's own axis, against its z: every turn of it counts, also where it jumps by
/// more than half a turn from one moment to the next, and going back unwinds.
#[test]
fn turns_of_the_last_joint_add_up() {
    let job = with_hose(1.5, 2.0 * PI);
    let home = home(&job);
    for steps in [&[1.0, 2.5, 5.0, 9.5, 3.0][..], &[9.5, 3.0], &[-4.0, 9.5]] {
        let way: Vec<_> = steps.iter().map(|&angle| turned(home, 5, angle)).collect();
        let used = hoses(&job, &through(&way));
        assert_eq!(used.len(), 1);
        assert!((used[0].twist.value + 9.5).abs() < 1e-9, "{steps:?}: {}", used[0].twist.value);
    }
    let used = hoses(&job, &through(&[turned(home, 5, -7.0), turned(home, 5, 3.0)]));
    assert!((used[0].twist.value - 7.0).abs() < 1e-9);
    let told = found(|findings| judge_hoses(&job, &used, findings));
    assert_eq!((told.len(), told[0].code, told[0].severity), (1, Code::E502, Severity::Error));
    assert!((told[0].measured.nominal - 7.0 / (2.0 * PI)).abs() < 1e-9);
    assert_eq!(told[0].site.bodies, ["feed"]);
    assert!(told[0].message.contains("by 401°"), "{}", told[0].message);
    assert!(told[0].hint.contains("back by 42°"), "{}", told[0].hint);
}

/// With the forearm across the tool a turn of joint 4 or 5 swings the hose's end and twists nothing;
/// joints before the hose's link do not matter at all.
#[test]
fn swinging_is_not_twisting() {
    let job = with_hose(1.5, PI);
    let home = home(&job);
    assert!((home[4] - FRAC_PI_2).abs() < 1e-12, "A5 is square at home");
    for (joint, angle) in [(0, 2.5), (1, 0.6), (2, -0.7), (3, 2.0), (3, -2.0), (4, -1.4)] {
        let used = hoses(&job, &through(&[turned(home, joint, angle)]));
        assert!(used[0].twist.value.abs() < 1e-9, "joint {joint}: {}", used[0].twist.value);
    }
    // In line with the forearm, joint 4 does twist it, and joint 6 undoes that.
    let mut job = job;
    job.cell.home[4] = 0.0;
    let line = [home[0], home[1], home[2], home[3], 0.0, home[5]];
    let used = hoses(&job, &through(&[turned(line, 3, 1.2)]));
    assert!((used[0].twist.value.abs() - 1.2).abs() < 1e-9);
    let back = turned(turned(line, 3, 1.2), 5, -1.2);
    let used = hoses(&job, &through(&[back]));
    assert!(used[0].twist.value.abs() < 1e-6, "{}", used[0].twist.value);
}

/// Stretch is the distance of the two ends, told at the place where it is largest, also between
/// two moments.
#[test]
fn a_short_hose_is_told_where_it_is_shortest() {
    let job = with_hose(0.5, 10.0);
    let home = home(&job);
    let hose = &job.cell.hoses[0];
    let apart = |q: &[f64; 6]| {
        let chain = &job.cell.robot.arm.chain;
        let mut poses = Vec::new();
        chain.link_poses(q, &mut poses);
        let link = poses[hose.carrier.unwrap()] * hose.carrier_from_link;
        let tool = job.cell.world_from_tool(&chain.forward(q));
        (tool * hose.to - link * hose.from).norm()
    };
    // Joint 5 from one side to the other passes the stretched posture in between.
    let (from, to) = (turned(home, 4, -2.4), turned(home, 4, 0.2));
    let used = hoses(&job, &through(&[from, to]));
    let longest = (0..=2000)
        .map(|k| apart(&turned(home, 4, -2.4 + 2.6 * f64::from(k) / 2000.0)))
        .fold(0.0, f64::max);
    assert!(longest > apart(&from) + 1e-3 && longest > apart(&to) + 1e-3);
    assert!((used[0].stretch.value - longest).abs() < 3e-4, "{}", used[0].stretch.value);
    let told = |length_m: f64| {
        let mut job = job.clone();
        job.cell.hoses[0].length_m = length_m;
        found(|findings| judge_hoses(&job, &used, findings))
    };
    assert!(told(used[0].stretch.value * 1.001).is_empty());
    let told = told(used[0].stretch.value * 0.95);
    assert_eq!((told.len(), told[0].severity), (1, Severity::Error));
    assert!((told[0].measured.nominal - 1.0 / 0.95).abs() < 1e-9);
    assert_eq!(told[0].site.bodies, ["feed", "link_3"]);
    assert_eq!((told[0].site.phase, told[0].site.strand), (Some(Phase::Transit), Some(0)));
    assert!(told[0].time_s.is_some_and(|time_s| time_s > 0.0 && time_s < 1.0));
}

/// With the bed on the flange the hose leads to the bed; a cell without hoses asks nothing.
#[test]
fn a_hose_to_a_bed_that_rides_is_followed() {
    let mut job = job(&text("kirkman-sda10d", "", &strand("a", &LYING, "")));
    assert_eq!(job.cell.mode, Mode::BedOnFlange);
    let mut q = Posture::new(&job.cell.home);
    let last = q.len() - 1;
    q[last] += 1.0;
    let moments = vec![Moment { time_s: 1.0, at_m: 0.0, q }];
    let motion = motion_of(vec![leg(Phase::Transit, None, moments)]);
    assert!(hoses(&job, &motion).is_empty());
    job.cell.hoses.push(Hose {
        name: "heater".to_owned(),
        link: "base_link".to_owned(),
        carrier: None,
        carrier_from_link: Pose::identity(),
        from: Point::origin(),
        to: Point::origin(),
        length_m: 3.0,
        radius_m: 4e-3,
        twist_rad: 0.5,
    });
    let used = hoses(&job, &motion);
    assert!((used[0].twist.value.abs() - 1.0).abs() < 1e-9, "{}", used[0].twist.value);
    // The bed hangs off the axis of the last joint, which swings it.
    let reach = |share: f64| {
        let mut q = q;
        q[last] -= 1.0 - share;
        let bed = job.cell.world_from_bed(&job.cell.robot.arm.chain.forward(&q));
        bed.translation.vector.norm()
    };
    let furthest = (0..=20).map(|k| reach(f64::from(k) / 20.0)).fold(0.0, f64::max);
    assert!((used[0].stretch.value - furthest).abs() < 1e-9, "{}", used[0].stretch.value);
    let told = found(|findings| judge_hoses(&job, &used, findings));
    assert!(told[0].message.contains("in a given move"), "{}", told[0].message);
}
