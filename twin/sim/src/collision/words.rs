//! Sentences of clearance findings.

use crate::cell::Job;
use crate::finding::{Code, Phase, Words};

/// What was measured, for a sentence.
pub(super) struct Measured<'a> {
    pub(super) code: Code,
    pub(super) clearance_m: f64,
    /// What it must be at least; negative: how deep the two may press.
    pub(super) limit_m: f64,
    pub(super) names: [&'a str; 2],
    pub(super) phase: Phase,
    pub(super) strand: Option<usize>,
}

pub(super) fn clearance(job: &Job, measured: &Measured<'_>) -> Words {
    let Measured { code, clearance_m, limit_m, names: [body, other], phase, strand } = *measured;
    let of = strand
        .map_or_else(String::new, |strand| format!(" of strand `{}`", job.strands[strand].id));
    let how = if clearance_m < 0.0 {
        format!("{body} overlaps {other} by {:.2} mm", -clearance_m * 1e3)
    } else {
        format!("{body} comes within {:.2} mm of {other}", clearance_m * 1e3)
    };
    // A warning lacks what the arm may be off; an error lacks that too.
    let missing_mm = (limit_m + job.cell.robot.accuracy_m - clearance_m) * 1e3;
    let own = strand.is_some_and(|strand| job.strands[strand].id == other);
    let hint = match code {
        _ if phase == Phase::Transit => {
            "lead the arm round it with a `move` step before the strand, or lengthen approach and retract"
                .to_owned()
        }
        Code::C201 | Code::C202 if own => {
            "tilt the nozzle away from the strand it leaves, or print that in the other direction".to_owned()
        }
        Code::C201 | Code::C202 => format!(
            "print `{other}` after this strand, tilt the nozzle away, or move one of them by {missing_mm:.1} mm"
        ),
        Code::C204 => {
            "tilt the nozzle to trail the strand, or print it in the other direction".to_owned()
        }
        Code::C203 | Code::C206 => {
            "turn the spin, or give the strand another posture".to_owned()
        }
        _ => format!("move the part by {missing_mm:.1} mm, or tilt the nozzle away"),
    };
    Words { message: format!("{how} in the {}{of}", phase.word()), hint }
}
