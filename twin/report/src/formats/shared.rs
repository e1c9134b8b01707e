//! What the formats share: order, names that outlive an edit, and paths.

use std::cmp::Ordering;
use std::collections::BTreeMap;

use sha2::{Digest as _, Sha256};
use sim::finding::{Bound, Code};

use crate::parts::{Finding, Report, Severity};

/// Places of the findings in the report, worst first: errors before warnings, then by how far past
/// the limit, then by time.
pub(crate) fn worst_first(report: &Report) -> Vec<usize> {
    let mut order: Vec<(Badness, usize)> =
        report.findings.iter().enumerate().map(|(at, finding)| (badness(finding), at)).collect();
    order.sort_by(|a, b| worse_before(&a.0, &b.0));
    order.into_iter().map(|(_, at)| at).collect()
}

/// Worse comes first.
pub(crate) fn by_badness(a: &Finding, b: &Finding) -> Ordering {
    worse_before(&badness(a), &badness(b))
}

/// Whether it is a warning, how far past its limit, and when.
type Badness = (bool, f64, f64);

fn badness(finding: &Finding) -> Badness {
    let is_warning = finding.severity == Severity::Warning;
    (is_warning, excess(finding), finding.time_s.unwrap_or(f64::INFINITY))
}

fn worse_before(a: &Badness, b: &Badness) -> Ordering {
    a.0.cmp(&b.0).then(b.1.total_cmp(&a.1)).then(a.2.total_cmp(&b.2))
}

/// How far past its limit, as a share of it: an error's nominal value, a warning's bad end.
pub(crate) fn excess(finding: &Finding) -> f64 {
    let is_lower = Code::from_name(&finding.code).map(Code::bound) == Some(Bound::Lower);
    let bad_end = if is_lower { finding.low } else { finding.high };
    let past = |value: Option<f64>| match (value, finding.limit) {
        (Some(value), Some(limit)) => {
            let over = if is_lower { limit - value } else { value - limit };
            over / limit.abs()
        }
        // what is not finite has no end
        _ => f64::INFINITY,
    };
    let share = match finding.severity {
        Severity::Error => past(finding.measured),
        Severity::Warning => past(finding.measured).max(past(bad_end)),
    };
    if share.is_nan() { 0.0 } else { share }
}

/// What a finding is about, whatever its numbers, its line and its severity: one report has it once.
pub(crate) fn identity(finding: &Finding) -> String {
    let site = &finding.site;
    let phase = site.phase.map(crate::Phase::word);
    serde_json::json!([finding.code, site.strand, phase, site.bodies]).to_string()
}

/// One name per finding, in the report's order: 32 hexadecimal digits from the job's path and what
/// the finding is about. No two are the same, also in a report that was tampered with.
pub(crate) fn fingerprints(report: &Report, root: &str) -> Vec<String> {
    let path = job_path(report, root);
    let mut seen: BTreeMap<String, usize> = BTreeMap::new();
    let print = |finding: &Finding| {
        let identity = identity(finding);
        let nth = seen.entry(identity.clone()).or_insert(0);
        *nth += 1;
        let text = serde_json::json!([path, identity, *nth]).to_string();
        Sha256::digest(text).iter().take(16).map(|byte| format!("{byte:02x}")).collect()
    };
    report.findings.iter().map(print).collect()
}

/// Path of the job's file from `root`, or `job.slam` where the report names none.
pub(crate) fn job_path(report: &Report, root: &str) -> String {
    let job = report.provenance.inputs.iter().find(|input| input.what == "job");
    match job.map(|input| relative(&input.name, root)) {
        Some(path) if !path.is_empty() => path,
        _ => "job.slam".to_owned(),
    }
}

/// A path from a folder, with `/` between its parts, by its text alone; a path outside the folder
/// stays what it is.
pub(crate) fn relative(path: &str, root: &str) -> String {
    let (path_is_absolute, path) = parts(path);
    let (root_is_absolute, root) = parts(root);
    match path.strip_prefix(root.as_slice()) {
        Some(inside) if path_is_absolute == root_is_absolute => inside.join("/"),
        _ if path_is_absolute => format!("/{}", path.join("/")),
        _ => path.join("/"),
    }
}

/// Whether the path is absolute, and its parts without `.` and what `..` takes back.
fn parts(path: &str) -> (bool, Vec<String>) {
    let path = if cfg!(windows) { path.replace('\\', "/") } else { path.to_owned() };
    let drive = cfg!(windows) && path.as_bytes().get(1) == Some(&b':');
    let is_absolute = path.starts_with('/') || drive;
    let mut parts: Vec<String> = Vec::new();
    for part in path.split('/') {
        match part {
            "" | "." => {}
            ".." if parts.last().is_some_and(|last| last != "..") => {
                parts.pop();
            }
            ".." if is_absolute => {}
            _ => parts.push(part.to_owned()),
        }
    }
    (is_absolute, parts)
}

/// The path as a URI reference: relative, or `file://` where it is absolute.
pub(crate) fn uri(path: &str) -> String {
    let mut uri = String::from(if path.starts_with('/') { "file://" } else { "" });
    for byte in path.bytes() {
        match byte {
            b'A'..=b'Z' | b'a'..=b'z' | b'0'..=b'9' | b'-' | b'.' | b'_' | b'~' | b'/' => {
                uri.push(char::from(byte));
            }
            _ => uri.push_str(&format!("%{byte:02X}")),
        }
    }
    uri
}

/// How many findings are errors, warnings, and let pass.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub(crate) struct Tally {
    /// Errors that are not let pass.
    pub(crate) errors: usize,
    /// Warnings that are not let pass.
    pub(crate) warnings: usize,
    /// Both, let pass.
    pub(crate) allowed: usize,
}

impl Tally {
    pub(crate) fn of<'a>(findings: impl Iterator<Item = &'a Finding>) -> Self {
        let mut tally = Self::default();
        for finding in findings {
            let count = match (&finding.allowed, finding.severity) {
                (Some(_), _) => &mut tally.allowed,
                (None, Severity::Error) => &mut tally.errors,
                (None, Severity::Warning) => &mut tally.warnings,
            };
            *count += 1;
        }
        tally
    }

    /// `3 errors, 1 warning, 2 allowed`.
    pub(crate) fn words(self) -> String {
        let counted = crate::quantity::counted;
        let mut words =
            format!("{}, {}", counted(self.errors, "error"), counted(self.warnings, "warning"));
        if self.allowed > 0 {
            words.push_str(&format!(", {} allowed", self.allowed));
        }
        words
    }
}
