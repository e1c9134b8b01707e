use super::*;
use crate::interval::Interval;
use crate::{motion, toolpath};

fn two_strands(more: &str) -> (Job, Motion) {
    let strands = [strand("a", &LYING, ", \"dwell_s\": 2"), strand("b", &RISING, "")].join(",");
    let sequence = format!(r#""sequence": ["a", {{ "wait_s": 7 }}, "b"], {more}"#);
    let job = job(&text("kr6-hot-end", &sequence, &strands));
    let motion = motion::plan(&job, &toolpath::paths(&job));
    (job, motion)
}

#[test]
fn the_times_of_a_cycle_add_up() {
    let (job, motion) = two_strands("");
    let times = cycle(&job, &motion);
    let sum = times.print_s + times.dwell_s + times.approach_s + times.transit_s + times.wait_s;
    assert!((sum - motion.total_s).abs() < 1e-9 && times.total_s == motion.total_s);
    assert_eq!(times.wait_s, 7.0);
    assert!((times.dwell_s - 2.0).abs() < 1e-9, "{times:?}");
    assert!(times.print_s > 0.0 && times.approach_s > 0.0 && times.transit_s > 0.0);
    // Without a limit nothing is judged, not even in the score.
    let mut findings = Findings::default();
    judge_cycle(&job, &times, &mut findings);
    assert_eq!(findings.scores().total(), None);
}

#[test]
fn a_cycle_too_long_says_what_would_be_enough() {
    let (mut job, motion) = two_strands("");
    let times = cycle(&job, &motion);
    job.limits.cycle_time_s = Some(times.total_s - 3.0);
    let told = found(|findings| judge_cycle(&job, &times, findings));
    assert_eq!((told.len(), told[0].code, told[0].severity), (1, Code::E504, Severity::Error));
    assert!(told[0].message.contains("3.0 s more than asked"), "{}", told[0].message);
    let factor: f64 =
        told[0].hint.split_whitespace().find_map(|word| word.parse().ok()).expect("a number");
    let saved_s = times.print_s - times.print_s / factor;
    assert!((saved_s - 3.0).abs() < 0.2, "{}: saves {saved_s}", told[0].hint);
    job.limits.cycle_time_s = Some(times.total_s + 1.0);
    assert!(found(|findings| judge_cycle(&job, &times, findings)).is_empty());
    job.limits.cycle_time_s = Some(times.total_s / 100.0);
    let told = found(|findings| judge_cycle(&job, &times, findings));
    assert!(told[0].hint.contains("100.00 times"), "{}", told[0].hint);
}

/// The job's own limit goes before the cell's.
#[test]
fn a_job_may_ask_for_time_and_speed_band() {
    let (job, _) = two_strands(r#""limits": { "cycle_time_s": 90, "speed_band_percent": 4 },"#);
    assert_eq!((job.limits.cycle_time_s, job.limits.speed_band), (Some(90.0), 0.04));
    let (job, _) = two_strands("");
    assert_eq!((job.limits.cycle_time_s, job.limits.speed_band), (None, 0.1));
}

fn peak(load: DriveLoad, share: Interval) -> DrivePeak {
    DrivePeak {
        strand: Some(0),
        phase: Phase::Print,
        at_m: 0.012,
        point: None,
        time_s: 4.0,
        joint: "joint_a2".to_owned(),
        load,
        share,
    }
}

/// Acceleration goes with v²; of a torque only what is beyond gravity's.
#[test]
fn a_weak_drive_says_how_slow_is_slow_enough() {
    let (mut job, _) = two_strands("");
    let told = |job: &Job, load, share| {
        found(|findings| judge_drives(job, &[peak(load, share)], findings)).pop()
    };
    let exact = Interval::exact;
    assert!(told(&job, DriveLoad::Acceleration, exact(0.99)).is_none());
    let finding = told(&job, DriveLoad::Acceleration, exact(1.5)).unwrap();
    assert_eq!((finding.code, finding.severity), (Code::R106, Severity::Error));
    assert_eq!(finding.site.bodies, ["joint_a2"]);
    assert!(finding.hint.contains("at 81 %"), "{}", finding.hint); // √(1/1.5) = 0.816
    assert!(finding.message.contains("150 % of its acceleration"), "{}", finding.message);
    let torque = DriveLoad::Torque { resting: 0.6 };
    let finding = told(&job, torque, exact(1.2)).unwrap();
    assert!(finding.hint.contains("at 81 %"), "{}", finding.hint); // √(0.4/0.6)
    let heavy = DriveLoad::Torque { resting: 1.1 };
    let finding = told(&job, heavy, exact(1.2)).unwrap();
    assert!(finding.hint.contains("gravity alone takes 110 %"), "{}", finding.hint);
    let doubtful = told(&job, torque, Interval::new(0.9, 0.8, 1.1)).unwrap();
    assert_eq!(doubtful.severity, Severity::Warning);
    job.limits.torque_share = 0.8;
    assert_eq!(told(&job, torque, exact(0.9)).unwrap().limit, 0.8);
    assert!(told(&job, DriveLoad::Acceleration, exact(0.9)).is_none());
}

#[test]
fn payload_is_held_against_rating_and_moment() {
    let told = |mass_kg: Interval, rated_kg: Option<f64>, share: Option<f64>| {
        let moments = share.map(|share| {
            vec![("joint_a5".to_owned(), share), ("joint_a6".to_owned(), share / 3.0)]
        });
        let payload =
            Payload { mass_kg, rated_kg, moments: moments.unwrap_or_default(), time_s: None };
        found(|findings| judge_payload(&payload, findings)).pop()
    };
    let exact = Interval::exact;
    assert!(told(exact(5.9), Some(6.0), None).is_none());
    assert!(told(exact(5.9), None, None).is_none());
    let finding = told(exact(6.5), Some(6.0), Some(0.9)).unwrap();
    assert_eq!((finding.code, finding.severity, finding.limit), (Code::E501, Severity::Error, 6.0));
    assert!(finding.hint.contains("take 0.50 kg off"), "{}", finding.hint);
    assert!(finding.site.bodies.is_empty());
    // 4 kg within the rating, but at a lever of 125 % of the allowed moment: 3.2 kg are allowed there.
    let finding = told(exact(4.0), Some(6.0), Some(1.25)).unwrap();
    assert!((finding.limit - 3.2).abs() < 1e-12);
    assert_eq!(finding.site.bodies, ["joint_a5"]);
    assert!(finding.message.contains("joint joint_a5 holds 3.20 kg"), "{}", finding.message);
    assert!(told(exact(4.0), Some(6.0), Some(0.99)).is_none());
    let finding = told(Interval::new(5.8, 5.5, 6.1), Some(6.0), None).unwrap();
    assert_eq!(finding.severity, Severity::Warning);
    assert!(finding.hint.contains("take 0.10 kg off"), "{}", finding.hint);
}
