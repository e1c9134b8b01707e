//! The rules of the process: what a strand was told, held against what its material and its extruder ask for.

use super::lighting;
use super::making::StrandResult;
use crate::cell::{Job, Join, On};
use crate::deposit::Printed;
use crate::finding::{Check, Code, Findings, Site, Words};
use crate::interval::Interval;
use crate::process::angle::nozzle_angle_rad;
use crate::process::coiling::{Folding, folding};
use crate::process::feed::prime_time_s;
use crate::process::{Ends, Setting};

/// A draw ratio this near to one may or may not coil: case SEWING-ONSET.
const ONSET_DOUBT: f64 = 0.15;
/// Slope up to which a strand on a bed lies level.
const LEVEL: f64 = 0.18;

pub(super) fn judge(job: &Job, printed: &Printed, result: &StrandResult, findings: &mut Findings) {
    let this = Rules { job, printed, result };
    this.draw_ratio(findings);
    this.slack(findings);
    this.bead(findings);
    this.prime(findings);
    this.end(findings);
    this.laid_in_light(findings);
    this.nozzle_angle(findings);
    this.tip_light(findings);
}

struct Rules<'a> {
    job: &'a Job,
    printed: &'a Printed,
    result: &'a StrandResult,
}

impl Rules<'_> {
    /// Checks one thing at an arc length; the words begin after the strand's name.
    fn check(
        &self,
        code: Code,
        at_m: f64,
        (measured, limit): (Interval, f64),
        findings: &mut Findings,
        words: impl FnOnce() -> (String, String),
    ) {
        let site = Site::strand(self.result.strand, at_m).at(self.printed.planned_at(at_m));
        let time_s = Some(self.printed.born_s + self.result.course.time_at_s(at_m));
        findings.check(Check { code, measured, limit, warn_limit: None, site, time_s }, || {
            let id = &self.job.strands[self.result.strand].id;
            let (message, hint) = words();
            Words { message: format!("strand `{id}` {message}"), hint }
        });
    }

    fn length_m(&self) -> f64 {
        self.result.input.length_m
    }

    /// P302: draw ratio outside its band; the worst bead speaks. Measured as the share of the nearer limit.
    fn draw_ratio(&self, findings: &mut Findings) {
        let [low, high] = self.job.limits.draw_ratio;
        let past = |ratio: f64| (ratio / high).max(low / ratio);
        let beads = self.result.steady_beads(self.job);
        let worst =
            beads.max_by(|a, b| past(a.bead.draw_ratio).total_cmp(&past(b.bead.draw_ratio)));
        let Some(worst) = worst else { return };
        let swell = self.job.cell.extruder.swell;
        let ratio = swell.map(|swell| worst.bead.draw_ratio * (swell / swell_of(self.job)).powi(2));
        // The doubt about the swell is as wide as the band: told in the words, not held against every strand.
        let measured = Interval::exact(past(ratio.nominal));
        self.check(Code::P302, worst.at_m, (measured, 1.0), findings, || {
            let told = format!(
                "is drawn at {:.2} times the speed of a free strand ({:.2} to {:.2}); {low} to {high} is safe",
                ratio.nominal, ratio.low, ratio.high
            );
            let fix = if ratio.nominal < low {
                let how = match folding(ratio.nominal, 1.0, ONSET_DOUBT) {
                    Folding::Folds => "it coils",
                    Folding::MayFold => "it may coil",
                    Folding::Straight => "it is slack",
                };
                format!("{how}: {:.0} % of this flow, or faster", 100.0 * ratio.nominal / low)
            } else {
                format!("it thins and may break: {:.0} % of this speed, or more flow", 100.0 * high / ratio.nominal)
            };
            (told, fix)
        });
    }

    /// P302: sag of what is longer than its chord, as a share of the limit on sag.
    fn slack(&self, findings: &mut Findings) {
        if self.result.input.ends != Ends::BothHeld {
            return;
        }
        let slack_m = self.result.outcome.sag_slack_m;
        // What is nominally taut may hang if the swell is greater than told: so may every strand, and an
        // assumption says it.
        let slack_m = if slack_m.nominal > 0.0 { slack_m } else { Interval::exact(0.0) };
        let measured = slack_m.map(|sag_m| sag_m / self.job.limits.sag_m);
        let at_m = 0.5 * self.length_m();
        self.check(Code::P302, at_m, (measured, 1.0), findings, || {
            (
                format!(
                    "hangs {:.2} mm ({:.2} to {:.2} mm) because more was fed than its length",
                    slack_m.nominal * 1e3,
                    slack_m.low * 1e3,
                    slack_m.high * 1e3
                ),
                "calibrate swell and flow with one bridge, feed less, or travel faster".to_owned(),
            )
        });
    }

    /// P307: bead wider or narrower than asked, away from the ends.
    fn bead(&self, findings: &mut Findings) {
        let off = |at: &crate::process::fed::BeadAt| (at.bead.hot_m / at.asked_m - 1.0).abs();
        let beads = self.result.steady_beads(self.job);
        let Some(worst) = beads.max_by(|a, b| off(a).total_cmp(&off(b))) else { return };
        let measured = Interval::exact(off(worst));
        self.check(Code::P307, worst.at_m, (measured, self.job.limits.bead_band), findings, || {
            (
                format!(
                    "is {:.2} mm wide as drawn where {:.2} mm was asked",
                    worst.bead.hot_m * 1e3,
                    worst.asked_m * 1e3
                ),
                "let speed and flow change together, and no faster than the extruder follows"
                    .to_owned(),
            )
        });
    }

    /// P311: priming at the start of what begins on something. Measured as the share of what is needed.
    fn prime(&self, findings: &mut Findings) {
        let Some(lag_s) = self.job.cell.extruder.lag_s else { return };
        let strand = &self.job.strands[self.result.strand];
        let told_m3_s = strand.asked(f64::NEG_INFINITY).1;
        let share = (1.0 - self.job.limits.bead_band).powi(2);
        let needed_s = lag_s.map(|lag_s| prime_time_s(lag_s, 0.0, told_m3_s, share));
        // What a start lacks over three widths of a bead is lost in the node it starts from; ours.
        let start_s = 3.0 * self.result.outcome.hot_diameter_m / strand.settings.speed_m_s;
        let needed_s = needed_s.map(|needed_s| (needed_s - start_s).max(0.0));
        self.needs("prime_s", "s", 0.0, strand.settings.prime_s, needed_s, findings);
    }

    /// P311: what sets by light must be past its lights at a free end, and hard where it is joined.
    fn end(&self, findings: &mut Findings) {
        if !matches!(self.job.material.setting, Setting::Photopolymer(_)) {
            return;
        }
        let strand = &self.job.strands[self.result.strand];
        if self.result.course.light.is_empty() || self.result.input.ends == Ends::Resting {
            return;
        }
        let length_m = self.length_m();
        let distance_m = self.result.outcome.set_distance_m;
        if !distance_m.nominal.is_finite() {
            return;
        }
        let free = self.result.input.ends == Ends::StartHeld && strand.end.join != Some(Join::Bed);
        if free {
            let over_m = strand.settings.overrun_m;
            let needed = distance_m.map(|m| m * 1e3);
            self.needs("overrun_mm", "mm", length_m, over_m * 1e3, needed, findings);
        } else {
            let needed_s = self.result.outcome.set_time_s;
            self.needs("dwell_s", "s", length_m, strand.end.dwell_s, needed_s, findings);
        }
    }

    fn needs(
        &self,
        key: &str,
        unit: &str,
        at_m: f64,
        has: f64,
        needed: Interval,
        findings: &mut Findings,
    ) {
        if !(needed.high > 0.0) {
            return;
        }
        let share = |needed: f64| if needed > 0.0 { (has / needed).min(2.0) } else { 2.0 };
        let measured = Interval::new(share(needed.nominal), share(needed.low), share(needed.high));
        self.check(Code::P311, at_m, (measured, 1.0), findings, || {
            let high = if needed.high.is_finite() {
                format!("{:.2}", needed.high)
            } else {
                "without end".to_owned()
            };
            (
                format!(
                    "has `{key}` {has:.2} {unit} where {:.2} {unit} ({:.2} to {high}) is needed",
                    needed.nominal, needed.low
                ),
                format!("say `\"{key}\": {:.1}`", needed.nominal.max(0.1)),
            )
        });
    }

    /// P309: a resin laid level on bed or form while the lights are on, without a second pass.
    fn laid_in_light(&self, findings: &mut Findings) {
        let strand = &self.job.strands[self.result.strand];
        let resin = matches!(self.job.material.setting, Setting::Photopolymer(_));
        if !resin || strand.on == On::Air {
            return;
        }
        let course = &self.result.course;
        let up = -course.gravity_at(0.0).normalize();
        let (mut level_m, mut lit_m) = (0.0, 0.0);
        for pair in course.stations.windows(2) {
            let step_m = pair[1].at_m - pair[0].at_m;
            if pair[0].tangent.dot(&up).abs() < LEVEL {
                level_m += step_m;
                lit_m += step_m * course.lit_share(pair[0].time_s, pair[1].time_s);
            }
        }
        if level_m <= 0.0 {
            return;
        }
        let measured = Interval::exact(lit_m / level_m);
        self.check(Code::P309, 0.5 * self.length_m(), (measured, 0.5), findings, || {
            (
                format!("is lit over {:.0} % of what it lays level on the bed: light thrown back blocks the nozzle", 100.0 * lit_m / level_m),
                "lay it in the dark and light it on a second pass: `second_pass_mm_s`".to_owned(),
            )
        });
    }

    /// P308: light on the nozzle's tip, straight and off the bed.
    fn tip_light(&self, findings: &mut Findings) {
        let Setting::Photopolymer(resin) = &self.job.material.setting else { return };
        let speed_m_s = self.job.strands[self.result.strand].settings.speed_m_s;
        let bead = (self.result.outcome.hot_diameter_m, speed_m_s);
        let Some(tip) = lighting::tip_dose(self.job, &self.result.course, resin, bead) else {
            return;
        };
        let limit = self.job.limits.tip_dose_share;
        let at_m = tip.at_m.min(self.length_m());
        self.check(Code::P308, at_m, (tip.share, limit), findings, || {
            let told = format!(
                "puts {:.2} of a critical exposure ({:.2} to {:.2}) on the nozzle's tip while a bead passes",
                tip.share.nominal, tip.share.low, tip.share.high
            );
            let fix = if tip.share.nominal <= limit {
                "only the bad ends of lamp, resin and bed fail: measure the critical exposure and what the bed throws back".to_owned()
            } else if tip.clear_after_m.is_finite() {
                format!("switch the lights on later: `\"lights_after_mm\": {:.1}`", (tip.clear_after_m * 1e3).max(0.1))
            } else {
                "shade the tip, aim the lamps lower, or darken the bed".to_owned()
            };
            (told, fix)
        });
    }

    /// P309: the angle between nozzle and strand (Yu's θ), where the cell bounds it. As a share of the limit.
    fn nozzle_angle(&self, findings: &mut Findings) {
        let Some(limit_rad) = self.job.limits.nozzle_angle_rad else { return };
        // What is laid on bed or form is pressed on: no such rule there.
        if self.job.strands[self.result.strand].on != On::Air {
            return;
        }
        let angle = |station: &crate::process::Station| {
            let axis = station.part_from_tool.rotation * crate::pose::Vector::z();
            nozzle_angle_rad(axis.into(), station.tangent.into())
        };
        let worst = self.result.course.stations.iter().max_by(|a, b| angle(a).total_cmp(&angle(b)));
        let Some(worst) = worst else { return };
        let measured = Interval::exact(angle(worst) / limit_rad);
        let at_m = worst.at_m.min(self.length_m());
        self.check(Code::P309, at_m, (measured, 1.0), findings, || {
            (
                format!(
                    "leaves the nozzle at {:.0}° to its axis where {:.0}° is the limit",
                    angle(worst).to_degrees(),
                    limit_rad.to_degrees()
                ),
                "let the nozzle follow the strand: `\"follow\": \"tangent\"`, or a greater `tilt_max_deg`".to_owned(),
            )
        });
    }
}

/// Swell the beads were made with.
fn swell_of(job: &Job) -> f64 {
    job.cell.extruder.swell.nominal
}

/// E511: the longest the material waits in mixer or nozzle between strands, where its life is known.
pub(super) fn idle(job: &Job, printings: &[crate::motion::Printing], findings: &mut Findings) {
    let life_s = match &job.material.setting {
        Setting::Thermoplastic(plastic) => plastic.melt_life_s,
        Setting::TwoPart(mix) => mix.pot_life_s,
        Setting::Photopolymer(_) => None,
    };
    let Some(life_s) = life_s else { return };
    let pause = |pair: &[crate::motion::Printing]| pair[1].start_s - pair[0].end_s;
    let longest = printings.windows(2).max_by(|a, b| pause(a).total_cmp(&pause(b)));
    let Some(pair) = longest else { return };
    let strand = &job.strands[pair[1].strand];
    // What stands in the mixer has come a part of the way already.
    let flow_m3_s = job.strands[pair[0].strand].asked(f64::INFINITY).1;
    let residence_s = job.cell.extruder.mixer_m3.map_or(0.0, |volume| volume / flow_m3_s);
    let idle_s = pause(pair) + residence_s;
    // The life is what is not known: told as an interval of the idle time, scaled to the nominal life.
    let measured = Interval::new(
        idle_s,
        idle_s * life_s.nominal / life_s.high,
        idle_s * life_s.nominal / life_s.low,
    );
    let site = Site::strand(pair[1].strand, 0.0).at(strand.points[0]);
    let check = Check {
        code: Code::E511,
        measured,
        limit: life_s.nominal,
        warn_limit: None,
        site,
        time_s: Some(pair[1].start_s),
    };
    findings.check(check, || Words {
        message: format!(
            "the material waits {idle_s:.0} s before strand `{}`; it lasts {:.0} s ({:.0} to {:.0})",
            strand.id, life_s.nominal, life_s.low, life_s.high
        ),
        hint: "print in an order with shorter ways, or purge in between".to_owned(),
    });
}
