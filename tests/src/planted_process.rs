//! A hundred faults of the process planted into jobs, more than half of them within ten percent of
//! a limit: each must be found, on the right strand, with the right cause, at the right place; and
//! the job without it must be free of errors.
//!
//! A fault has one number. What is measured is no straight line in it (sag goes with the fourth
//! power of the speed), so the numbers that miss a limit by little are found by halving between one
//! deep fault and the job without it. All between two faults that are near is near as well.

mod jobs;

use std::fs;
use std::path::Path;

use serde_json::Value;

use crate::tools;

/// A kind of fault; the number it takes is told with it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Kind {
    /// A bridge printed too fast: mm/s.
    TooFast,
    /// The fan that cools a bridge fails: m/s of its air.
    NoAir,
    /// A hot end too cold to weld to a strand that is cold: °C.
    TooCold,
    /// A room so hot that the set bridge is soft: °C.
    TooHot,
    /// The lights go off before the end is cured: s from the start.
    LightOff,
    /// The lights go on late: mm printed before.
    LightLate,
    /// The lamps of the ring turned from the strand: their angle, degrees.
    RingTurned,
    /// The ring aimed past the place where the strand should set: mm below the orifice.
    RingAimed,
    /// A bright bed throws light on the nozzle: its albedo.
    BrightBed,
    /// No time to cool before the nozzle leaves a free end: s of dwell.
    NoDwell,
    /// The nozzle stops before the end is past the lights: mm of overrun.
    NoOverrun,
    /// A long hose and too short a prime: s.
    NoPrime,
    /// The flow cut down: mm³/s.
    Thinned,
    /// The flow turned up in a bridge: mm³/s.
    Slack,
    /// A flow between the levels that the drive has: mm³/s.
    NoLevel,
    /// ABS where PLA was meant, in a free rod: its length, mm.
    WrongMaterial,
    /// Speed and flow told to change at once, faster than the extruder follows: how many times.
    Jumped,
    /// The melt waits in the nozzle: s.
    Idle,
    /// A strand far from the nozzle's axis: degrees.
    Leaning,
}

/// What must be found.
struct Expected {
    code: &'static str,
    strand: &'static str,
    /// The cause, as the message says it.
    says: &'static str,
    /// Range of the arc length, mm.
    at_mm: Option<[f64; 2]>,
}

impl Kind {
    const ALL: [Self; 19] = [
        Self::TooFast,
        Self::NoAir,
        Self::TooCold,
        Self::TooHot,
        Self::LightOff,
        Self::LightLate,
        Self::RingTurned,
        Self::RingAimed,
        Self::BrightBed,
        Self::NoDwell,
        Self::NoOverrun,
        Self::NoPrime,
        Self::Thinned,
        Self::Slack,
        Self::NoLevel,
        Self::WrongMaterial,
        Self::Jumped,
        Self::Idle,
        Self::Leaning,
    ];

    /// The number of a deep fault, and one that is none.
    fn range(self) -> [f64; 2] {
        match self {
            Self::TooFast => [22.0, 12.0],
            Self::NoAir => [0.3, 3.0],
            Self::TooCold => [187.0, 220.0],
            Self::TooHot => [90.0, 65.0],
            Self::LightOff => [8.0, 16.3],
            Self::LightLate => [9.0, 4.0],
            Self::RingTurned => [15.0, 45.0],
            Self::RingAimed => [14.0, 6.0],
            Self::BrightBed => [0.8, 0.05],
            Self::NoDwell => [0.5, 15.0],
            Self::NoOverrun => [0.2, 2.5],
            Self::NoPrime => [0.1, 1.2],
            Self::Thinned => [0.8, 2.0],
            Self::Slack => [6.0, 3.3],
            Self::NoLevel => [7.5, 5.65],
            Self::WrongMaterial => [180.0, 100.0],
            Self::Jumped => [4.0, 1.05],
            Self::Idle => [900.0, 200.0],
            Self::Leaning => [75.0, 40.0],
        }
    }

    fn expected(self, x: f64) -> Expected {
        let of = |code, strand, says, at_mm| Expected { code, strand, says, at_mm };
        let start = Some([0.0, 0.5]);
        match self {
            Self::TooFast | Self::NoAir => {
                of("P301", "bridge", "behind the nozzle", Some([0.0, 20.0]))
            }
            Self::TooCold => of("P310", "second", "holds to `first`", start),
            Self::TooHot => of("P303", "bridge", "under its own weight", Some([59.0, 61.0])),
            // What the nozzle had left a little before is still in the light's way.
            Self::LightOff => of("P305", "rod", "uncured core", Some([2.0 * x - 8.0, 30.0])),
            Self::LightLate => of("P305", "rod", "uncured core", Some([0.0, x])),
            Self::RingTurned => of("P305", "rod", "uncured core", None),
            Self::RingAimed => of("P306", "rod", "sets", None),
            Self::BrightBed => of("P308", "rod", "on the nozzle's tip", Some([0.0, 12.0])),
            Self::NoDwell => of("P304", "rod", "at its free end", Some([179.0, 180.0])),
            Self::NoOverrun => of("P311", "rod", "`overrun_mm`", Some([29.0, 30.0])),
            Self::NoPrime => of("P311", "rod", "`prime_s`", start),
            Self::Thinned => of("P302", "bridge", "is drawn at", None),
            Self::Slack => of("P302", "bridge", "more was fed", Some([9.0, 11.0])),
            Self::NoLevel => of("P307", "rod", "wide as drawn", None),
            Self::WrongMaterial => of("P304", "rod", "at its free end", Some([x - 1.0, x])),
            // Where it was told to change, and what is printed in a lag after that.
            Self::Jumped => of("P307", "rod", "wide as drawn", Some([15.0, 17.0])),
            Self::Idle => of("E511", "second", "waits", start),
            Self::Leaning => of("P309", "rod", "leaves the nozzle", None),
        }
    }
}

/// Runs a job; its errors.
fn errors(files: jobs::Files, folder: &Path) -> Result<Vec<Value>, String> {
    for (name, text) in files {
        fs::write(folder.join(name), text).expect("the temporary folder can be written");
    }
    let (ran, report) = tools::check(&folder.join("job.slam"), &folder.join("out"));
    let report = report.ok_or_else(|| format!("no report: {}", ran.err))?;
    let findings = report["findings"].as_array().cloned().unwrap_or_default();
    Ok(findings.into_iter().filter(|finding| finding["severity"] == "error").collect())
}

fn told(findings: &[Value]) -> Vec<String> {
    findings.iter().map(|f| format!("{} {} {}", f["code"], f["site"], f["message"])).collect()
}

/// By how much the limit is missed, one and more, by the finding that is expected.
fn missed(kind: Kind, x: f64, folder: &Path) -> Result<f64, String> {
    let errors =
        errors(jobs::files(kind, x), folder).map_err(|why| format!("{kind:?} {x}: {why}"))?;
    let expected = kind.expected(x);
    let fits = |finding: &&Value| {
        let at_m = finding.pointer("/site/at_m").and_then(Value::as_f64);
        let within = |[low, high]: [f64; 2]| {
            at_m.is_some_and(|at_m| (low - 1e-6..=high + 1e-6).contains(&(at_m * 1e3)))
        };
        finding["code"] == expected.code
            && finding["site"]["strand"] == expected.strand
            && finding["message"].as_str().is_some_and(|text| text.contains(expected.says))
            && expected.at_mm.is_none_or(within)
    };
    let share = errors
        .iter()
        .find(fits)
        .and_then(|finding| Some(finding["measured"].as_f64()? / finding["limit"].as_f64()?));
    share
        .map(|share| share.max(1.0 / share))
        .ok_or_else(|| format!("{kind:?} {x}: not found; told were {:#?}", told(&errors)))
}

/// The number whose fault misses the limit by a share within `aim`, between a fault that misses it
/// by more and a number that misses it by less or not at all: by halving its logarithm.
fn aim(kind: Kind, from: [f64; 2], aim: [f64; 2], folder: &Path) -> Result<f64, String> {
    const STEPS: usize = 14;
    let [mut worse, mut better] = from;
    for _ in 0..STEPS {
        let x = (worse * better).sqrt();
        match missed(kind, x, folder) {
            Ok(share) if share > aim[1] => worse = x,
            Ok(share) if share >= aim[0] => return Ok(x),
            _ => better = x,
        }
    }
    Err(format!("{kind:?}: none misses by {aim:?} between {worse} and {better}"))
}

/// Faults of a kind: the first ones deep, the others within ten percent of the limit.
const DEEP: usize = 2;
const NEAR: usize = 4;

/// The faults of a kind that were found: by how much each misses its limit.
fn plant(kind: Kind, folder: &Path) -> Result<Vec<f64>, String> {
    fs::create_dir_all(folder).expect("the temporary folder can be written");
    let sound = errors(jobs::sound(kind), folder)?;
    if !sound.is_empty() {
        return Err(format!("{kind:?}: errors without the fault: {:#?}", told(&sound)));
    }
    let [deep, none] = kind.range();
    let far = aim(kind, [deep, none], [1.05, 1.098], folder)?;
    let near = aim(kind, [far, none], [1.002, 1.035], folder)?;
    let between = |from: f64, to: f64, share: f64| from * (to / from).powf(share);
    let deep = (0..DEEP).map(|k| between(deep, far, k as f64 / DEEP as f64));
    let near = (0..NEAR).map(|k| between(far, near, k as f64 / (NEAR - 1) as f64));
    deep.chain(near).map(|x| missed(kind, x, folder)).collect()
}

#[test]
fn a_hundred_planted_faults_of_the_process_are_found() {
    let folder = tools::scratch("planted-process");
    let planted: Vec<Result<Vec<f64>, String>> = std::thread::scope(|scope| {
        let start = |kind: Kind| {
            let folder = folder.join(format!("{kind:?}"));
            scope.spawn(move || plant(kind, &folder))
        };
        let running: Vec<_> = Kind::ALL.into_iter().map(start).collect();
        running.into_iter().map(|thread| thread.join().expect("no panic")).collect()
    });
    let problems: Vec<&String> = planted.iter().filter_map(|kind| kind.as_ref().err()).collect();
    assert!(problems.is_empty(), "{problems:#?}");
    let found: Vec<f64> = planted.into_iter().flatten().flatten().collect();
    assert_eq!(found.len(), Kind::ALL.len() * (DEEP + NEAR));
    assert!(found.len() >= 100, "{} planted", found.len());
    let n_near = found.iter().filter(|share| **share < 1.1).count();
    assert!(2 * n_near >= found.len() && n_near >= 50, "{n_near} within ten percent of a limit");
}
