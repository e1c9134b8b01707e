//! Planting faults: jobs that are sound but for one number.
//!
//! A fault has one number. What is measured is no straight line in it (sag goes with the fourth power of the speed), so the
//! numbers that miss a limit by little are found by halving between one deep fault and the job without it. All between
//! two faults that are near is near as well.

use std::fs;
use std::path::Path;

use serde_json::Value;

use crate::tools;

/// Names and texts of what a job is made of; `job.slam` among them.
pub(crate) type Files = Vec<(&'static str, String)>;

/// Looks at a report and the finding in it; an error says what is wrong.
pub(crate) type Also = fn(&Value, &Value) -> Result<(), String>;

/// What must be found.
pub(crate) struct Expected {
    pub(crate) code: &'static str,
    /// Empty: of no strand.
    pub(crate) strand: &'static str,
    /// The cause, as the message says it.
    pub(crate) says: &'static str,
    /// Range of the arc length, mm.
    pub(crate) at_mm: Option<[f64; 2]>,
    /// What the report must show beside it.
    pub(crate) also: Option<Also>,
}

/// A kind of fault.
pub(crate) struct Fault {
    pub(crate) name: String,
    /// The number of a deep fault, and one that is none.
    pub(crate) range: [f64; 2],
    /// The job without it.
    pub(crate) sound: Files,
    /// The job with the fault of a number.
    pub(crate) files: Box<dyn Fn(f64) -> Files + Sync>,
    /// What must be found then.
    pub(crate) expected: Box<dyn Fn(f64) -> Expected + Sync>,
}

/// Faults of a kind: the first ones deep, the others within ten percent of the limit.
const DEEP: usize = 2;
const NEAR: usize = 4;

/// Plants every fault, several of each kind; each must be found, and the jobs without free of errors. At least a hundred, half of
/// them and more within ten percent of a limit.
pub(crate) fn all_are_found(folder: &str, faults: &[Fault]) {
    let folder = tools::scratch(folder);
    let planted: Vec<Result<Vec<f64>, String>> = std::thread::scope(|scope| {
        let folder = &folder;
        let running: Vec<_> = faults
            .iter()
            .map(|fault| scope.spawn(move || plant(fault, &folder.join(&fault.name))))
            .collect();
        running.into_iter().map(|thread| thread.join().expect("no panic")).collect()
    });
    let problems: Vec<&String> = planted.iter().filter_map(|kind| kind.as_ref().err()).collect();
    assert!(problems.is_empty(), "{problems:#?}");
    let found: Vec<f64> = planted.into_iter().flatten().flatten().collect();
    assert_eq!(found.len(), faults.len() * (DEEP + NEAR));
    assert!(found.len() >= 100, "{} planted", found.len());
    let n_near = found.iter().filter(|share| **share < 1.1).count();
    assert!(2 * n_near >= found.len() && n_near >= 50, "{n_near} within ten percent of a limit");
}

/// Runs a job; its report.
fn report(files: Files, folder: &Path) -> Result<Value, String> {
    for (name, text) in files {
        fs::write(folder.join(name), text).expect("the temporary folder can be written");
    }
    let (ran, report) = tools::check(&folder.join("job.slam"), &folder.join("out"));
    report.ok_or_else(|| format!("no report: {}", ran.err))
}

fn errors(report: &Value) -> Vec<Value> {
    let findings = report["findings"].as_array().cloned().unwrap_or_default();
    findings.into_iter().filter(|finding| finding["severity"] == "error").collect()
}

fn told(findings: &[Value]) -> Vec<String> {
    findings.iter().map(|f| format!("{} {} {}", f["code"], f["site"], f["message"])).collect()
}

/// By how much the limit is missed, one and more, by the finding that is expected.
fn missed(fault: &Fault, x: f64, folder: &Path) -> Result<f64, String> {
    let name = &fault.name;
    let report = report((fault.files)(x), folder).map_err(|why| format!("{name} {x}: {why}"))?;
    let errors = errors(&report);
    let expected = (fault.expected)(x);
    let fits = |finding: &&Value| {
        let at_m = finding.pointer("/site/at_m").and_then(Value::as_f64);
        let within = |[low, high]: [f64; 2]| {
            at_m.is_some_and(|at_m| (low - 1e-6..=high + 1e-6).contains(&(at_m * 1e3)))
        };
        finding["code"] == expected.code
            && finding["site"]["strand"].as_str().unwrap_or("") == expected.strand
            && finding["message"].as_str().is_some_and(|text| text.contains(expected.says))
            && expected.at_mm.is_none_or(within)
    };
    let Some(finding) = errors.iter().find(fits) else {
        return Err(format!("{name} {x}: not found; told were {:#?}", told(&errors)));
    };
    if let Some(also) = expected.also {
        also(&report, finding).map_err(|why| format!("{name} {x}: {why}"))?;
    }
    let share = finding["measured"].as_f64().zip(finding["limit"].as_f64());
    let share = share.map(|(measured, limit)| measured / limit);
    share.map(|share| share.max(1.0 / share)).ok_or_else(|| format!("{name} {x}: no numbers"))
}

/// The number whose fault misses the limit by a share within `aim`, between a fault that misses it
/// by more and a number that misses it by less or not at all: by halving its logarithm.
fn aim(fault: &Fault, from: [f64; 2], aim: [f64; 2], folder: &Path) -> Result<f64, String> {
    const STEPS: usize = 14;
    let [mut worse, mut better] = from;
    let mut last = String::new();
    for _ in 0..STEPS {
        let x = (worse * better).sqrt();
        match missed(fault, x, folder) {
            Ok(share) if share > aim[1] => worse = x,
            Ok(share) if share >= aim[0] => return Ok(x),
            Ok(_) => better = x,
            Err(why) => {
                last = why;
                better = x;
            }
        }
    }
    let name = &fault.name;
    Err(format!("{name}: none misses by {aim:?} between {worse} and {better}; {last}"))
}

/// The faults of a kind that were found: by how much each misses its limit.
fn plant(fault: &Fault, folder: &Path) -> Result<Vec<f64>, String> {
    fs::create_dir_all(folder).expect("the temporary folder can be written");
    let sound = errors(&report(fault.sound.clone(), folder)?);
    if !sound.is_empty() {
        return Err(format!("{}: errors without the fault: {:#?}", fault.name, told(&sound)));
    }
    let [deep, none] = fault.range;
    let far = aim(fault, [deep, none], [1.05, 1.098], folder)?;
    let near = aim(fault, [far, none], [1.002, 1.035], folder)?;
    let between = |from: f64, to: f64, share: f64| from * (to / from).powf(share);
    let deep = (0..DEEP).map(|k| between(deep, far, k as f64 / DEEP as f64));
    let near = (0..NEAR).map(|k| between(far, near, k as f64 / (NEAR - 1) as f64));
    deep.chain(near).map(|x| missed(fault, x, folder)).collect()
}
