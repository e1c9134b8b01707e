//! What became of a strand, held against its limits.

use super::making::StrandResult;
use super::rules;
use super::slower::slow_enough;
use crate::cell::Job;
use crate::deposit::Printed;
use crate::finding::{Check, Code, Findings, Site, Words};
use crate::interval::Interval;
use crate::process::history::Corner;
use crate::process::shrinkage::remedy;
use crate::process::strand::shortening_at;
use crate::process::{Ends, Heats, Setting};

struct Judge<'a> {
    job: &'a Job,
    printed: &'a Printed,
    result: &'a StrandResult,
}

pub(super) fn judge(job: &Job, printed: &Printed, result: &StrandResult, findings: &mut Findings) {
    rules::judge(job, printed, result, findings);
    let this = Judge { job, printed, result };
    let (limits, outcome) = (&job.limits, &result.outcome);
    this.start(findings);
    if result.input.ends != Ends::Resting {
        this.hold(Code::P301, outcome.sag_nozzle_m, limits.sag_m, None, findings, |mm| {
            (
                format!("sags {mm} behind the nozzle before it is set"),
                slower(job, result, limits.sag_m),
            )
        });
        this.hold(Code::P303, outcome.sag_set_m, limits.sag_m, None, findings, |mm| {
            (
                format!("sags {mm} under its own weight once set"),
                "shorten the span or thicken the bead".to_owned(),
            )
        });
    }
    // A melt may set far behind the nozzle as long as it does not sag there, but set it must.
    let by_light_or_clock = !matches!(job.material.setting, Setting::Thermoplastic(_));
    let sets = outcome.set_distance_m.nominal.is_finite();
    if !sets || (by_light_or_clock && result.input.ends != Ends::Resting) {
        this.hold(
            Code::P306,
            outcome.set_distance_m,
            limits.set_distance_m,
            None,
            findings,
            |mm| {
                if !sets {
                    let hint = "the air is too hot for a melt, or no light reaches a resin: see `air_c`, and the tool";
                    return ("never sets here".to_owned(), hint.to_owned());
                }
                let share = limits.set_distance_m / outcome.set_distance_m.nominal;
                let speed = result.input.speed_m_s * 1e3 * share;
                (
                    format!("sets {mm} behind the nozzle"),
                    format!("print at {speed:.2} mm/s, or light it harder"),
                )
            },
        );
    }
    if result.input.ends == Ends::StartHeld {
        this.hold(Code::P304, outcome.end_miss_m, limits.node_miss_m, None, findings, |mm| {
            (
                format!("loses {mm} at its free end by shrinkage still to come"),
                wait_or_go_on(job, result),
            )
        });
    }
    if let Some(core_m) = outcome.uncured_core_m {
        let radius_m = outcome.bead_diameter_m.nominal / 2.0;
        let [warn, stop] = limits.uncured_share.map(|share| share * radius_m);
        // A post-cure that goes through leaves nothing to warn of, if the shell holds until then.
        let post = result.lit.as_ref().and_then(|lit| lit.post_cured_m);
        let mended = post.is_some_and(|depth_m| depth_m.low >= radius_m * (1.0 - 1e-6));
        let warn = (!mended).then_some(warn);
        let core_m = if mended { Interval::exact(core_m.nominal) } else { core_m };
        this.hold(Code::P305, core_m, stop, warn, findings, |mm| {
            let words = format!(
                "keeps an uncured core of {mm} in a bead of {:.2} mm radius",
                radius_m * 1e3
            );
            (words, "print slower, add light, or plan a post-cure".to_owned())
        });
    }
}

/// The wait at the end that brings the miss within its limit, and the way to go past the node without it.
fn wait_or_go_on(job: &Job, result: &StrandResult) -> String {
    /// Longer waits are no advice.
    const LONGEST_S: f64 = 120.0;
    let (input, material) = (&result.input, &job.material);
    let heats = Heats::new(input, material);
    // What fails at its high end only is mended for that end.
    let limit_m = job.limits.node_miss_m;
    let corner =
        if result.outcome.end_miss_m.nominal > limit_m { Corner::Nominal } else { Corner::Slow };
    let still_m =
        |wait_s: f64| shortening_at(input, material, &heats, input.dwell_s + wait_s, corner);
    let remedy = remedy(limit_m, LONGEST_S, still_m);
    let further = format!("travel further by {:.2} mm", still_m(0.0) * 1e3);
    match remedy.dwell_s {
        Some(wait_s) => format!(
            "wait {:.1} s at the end before leaving it, or {further}",
            input.dwell_s + wait_s
        ),
        None => format!("{further}: no wait of {LONGEST_S:.0} s or less is enough"),
    }
}

/// The speed at which the sag behind the nozzle keeps its limit, if there is one.
fn slower(job: &Job, result: &StrandResult, limit_m: f64) -> String {
    let jet = if job.cell.tool.air_jet.is_some() { "more air" } else { "an air jet" };
    let strand = &job.strands[result.strand];
    // rounded down: the advice must do
    let down = |value: f64, step: f64| (value / step).floor() * step;
    match slow_enough(job, result, limit_m) {
        None => {
            format!("shorten the span, thicken the bead or add {jet}: speed alone does not mend it")
        }
        Some(share) if strand.profile.is_empty() => {
            let speed_mm_s = strand.settings.speed_m_s * share * 1e3;
            let step = 10f64.powf(speed_mm_s.log10().floor() - 2.0);
            let digits = (-step.log10()).clamp(0.0, 9.0).round() as usize;
            format!("print at {:.digits$} mm/s or slower, or with {jet}", down(speed_mm_s, step))
        }
        Some(share) => {
            format!(
                "print at {:.1} % of these speeds or slower, or with {jet}",
                down(share * 100.0, 0.1)
            )
        }
    }
}

impl Judge<'_> {
    /// S402: a strand that begins where nothing holds it.
    fn start(&self, findings: &mut Findings) {
        let (strand, time_s) = (self.result.strand, Some(self.printed.born_s));
        let site = Site::strand(strand, 0.0).at(self.printed.as_planned[0]);
        findings.forbid(Code::S402, !self.result.start_held, site, time_s, || Words {
            message: format!("strand `{}` begins in free air", self.job.strands[strand].id),
            hint:
                "start it on the bed or on a strand that is there, or print it the other way round"
                    .to_owned(),
        });
    }

    fn hold(
        &self,
        code: Code,
        measured: Interval,
        limit: f64,
        warn_limit: Option<f64>,
        findings: &mut Findings,
        words: impl FnOnce(String) -> (String, String),
    ) {
        let length_m = self.printed.length_m();
        let (at_m, point) = match code {
            Code::P305 if self.result.lit.is_some() => {
                let least = self.result.lit.as_ref().and_then(crate::process::lit::Lit::least);
                let at_m = least.map_or(length_m / 2.0, |(at_m, _)| at_m.min(length_m));
                (at_m, self.printed.planned_at(at_m))
            }
            Code::P304 => (length_m, self.printed.as_planned[self.printed.as_planned.len() - 1]),
            _ => (length_m / 2.0, self.printed.planned_at(length_m / 2.0)),
        };
        let site = Site::strand(self.result.strand, at_m).at(point);
        let time_s = Some(self.printed.even_time_s(at_m));
        findings.check(
            Check { code, measured: finite(measured), limit, warn_limit, site, time_s },
            || {
                let id = &self.job.strands[self.result.strand].id;
                let Interval { nominal, low, high } = measured;
                let range = format!(
                    "{} ({} to {})",
                    millimetres(nominal),
                    millimetres(low),
                    millimetres(high)
                );
                let (message, hint) = words(range);
                Words { message: format!("strand `{id}` {message}"), hint }
            },
        );
    }
}

fn millimetres(length_m: f64) -> String {
    if length_m < ENDLESS_M { format!("{:.2} mm", length_m * 1e3) } else { "no end".to_owned() }
}

/// A length past any limit in use, that stands for one without end.
const ENDLESS_M: f64 = 1e3;

/// Reports hold finite numbers: an endless value becomes one kilometre, past any limit in use.
fn finite(measured: Interval) -> Interval {
    let cap = |value: f64| if value.is_nan() { ENDLESS_M } else { value.min(ENDLESS_M) };
    Interval { nominal: cap(measured.nominal), low: cap(measured.low), high: cap(measured.high) }
}
