//! E504: where the time of the program goes.

use crate::cell::{Job, Step};
use crate::finding::{Check, Code, Findings, Phase, Site, Words};
use crate::interval::Interval;
use crate::motion::Motion;

/// Time of the program by what it is spent on, s. The parts add up to the total.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct CycleTimes {
    /// Extruding along strands.
    pub print_s: f64,
    /// Priming and resting at nodes.
    pub dwell_s: f64,
    /// Straight ways to and from strands.
    pub approach_s: f64,
    /// Between strands, and moves the job gives.
    pub transit_s: f64,
    /// Waits that the job asks for.
    pub wait_s: f64,
    /// All of it.
    pub total_s: f64,
}

/// Adds up the legs; what is neither motion nor an asked wait is rest.
pub fn cycle(job: &Job, motion: &Motion) -> CycleTimes {
    let spent = |phases: &[Phase]| -> f64 {
        let legs = motion.legs.iter().filter(|leg| phases.contains(&leg.phase));
        legs.filter_map(|leg| Some(leg.moments.last()?.time_s - leg.moments.first()?.time_s)).sum()
    };
    let wait = |step: &Step| if let Step::Wait(wait_s) = step { *wait_s } else { 0.0 };
    let wait_s: f64 = job.steps.iter().map(wait).sum();
    let print_s = spent(&[Phase::Print]);
    let approach_s = spent(&[Phase::Approach, Phase::Retract]);
    let transit_s = spent(&[Phase::Transit]);
    let dwell_s = motion.total_s - print_s - approach_s - transit_s - wait_s;
    CycleTimes {
        print_s,
        dwell_s: dwell_s.max(0.0),
        approach_s,
        transit_s,
        wait_s,
        total_s: motion.total_s,
    }
}

/// Holds the total against the asked cycle time, if there is one.
pub fn judge_cycle(job: &Job, times: &CycleTimes, findings: &mut Findings) {
    let Some(limit) = job.limits.cycle_time_s else { return };
    let check = Check {
        code: Code::E504,
        measured: Interval::exact(times.total_s),
        limit,
        warn_limit: None,
        site: Site::default(),
        time_s: Some(limit),
    };
    findings.check(check, || Words {
        message: format!(
            "the program takes {:.1} s, {:.1} s more than asked: print {:.1}, rest {:.1}, approach and retract {:.1}, transit {:.1}, wait {:.1} s",
            times.total_s,
            times.total_s - limit,
            times.print_s,
            times.dwell_s,
            times.approach_s,
            times.transit_s,
            times.wait_s
        ),
        hint: faster(times, limit),
    });
}

/// What would have to be how much faster for the program to be as long as asked.
fn faster(times: &CycleTimes, limit: f64) -> String {
    let too_long_s = times.total_s - limit;
    let moving_s = times.approach_s + times.transit_s;
    let resting_s = times.dwell_s + times.wait_s;
    let times_faster = |spent_s: f64| spent_s / (spent_s - too_long_s);
    let mut ways = Vec::new();
    if times.print_s > too_long_s {
        ways.push(format!("print {:.2} times as fast", times_faster(times.print_s)));
    }
    if moving_s > too_long_s {
        ways.push(format!("travel {:.2} times as fast", times_faster(moving_s)));
    }
    if resting_s > too_long_s {
        let share = 100.0 * (1.0 - too_long_s / resting_s);
        ways.push(format!("rest and wait {share:.0} % as long"));
    }
    if ways.is_empty() {
        let factor = times.total_s / limit;
        return format!("nothing alone is long enough: all of it {factor:.2} times as fast");
    }
    format!("{}: any of these alone is enough", ways.join(", or "))
}
