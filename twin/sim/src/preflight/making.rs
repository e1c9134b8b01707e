//! Strand by strand: what holds it, what the process makes of it, what that is held against.

use crate::cell::{Job, Join, On};
use crate::deposit::{self, Contact, Deposit, Printed};
use crate::finding::{Check, Code, Findings, Phase, Site, Words};
use crate::growth::StrandLaw;
use crate::interval::Interval;
use crate::motion::{Leg, Motion};
use crate::pose::{Point, Vector};
use crate::process::{self, Air, Ends, Setting, StrandInput, StrandOutcome};
use crate::toolpath::Path;

/// What became of one strand.
#[derive(Debug, Clone, PartialEq)]
pub struct StrandResult {
    /// Index of the strand in the job.
    pub strand: usize,
    /// What went into the laws.
    pub input: StrandInput,
    /// What came out.
    pub outcome: StrandOutcome,
    /// Direction of gravity in part axes while it was printed, unit.
    pub down: Vector,
    /// Number of earlier strands it touches.
    pub touches: usize,
    /// Whether anything holds its start.
    pub start_held: bool,
}

/// Makes every strand, in printing order, and judges it.
pub(super) fn make(
    job: &Job,
    paths: &[Path],
    motion: &Motion,
    findings: &mut Findings,
) -> Vec<StrandResult> {
    let planned = as_planned(job, paths, motion);
    let contacts = deposit::contacts(&planned);
    let mut by_strand: Vec<Vec<&Contact>> = vec![Vec::new(); planned.strands.len()];
    for contact in &contacts {
        by_strand[contact.orders[0]].push(contact);
    }
    planned
        .strands
        .iter()
        .zip(&by_strand)
        .map(|(printed, contacts)| {
            let result = make_one(job, &paths[printed.strand], printed, contacts, motion);
            judge(job, printed, &result, findings);
            result
        })
        .collect()
}

/// The deposit as planned, with beads by mass balance.
fn as_planned(job: &Job, paths: &[Path], motion: &Motion) -> Deposit {
    let printed = |printing: &crate::motion::Printing| {
        let points = job.strands[printing.strand].points.clone();
        let (speed_m_s, flow_m3_s) = mean_speed_and_flow(&paths[printing.strand]);
        let hot_m = process::bead::drawn_diameter_m(flow_m3_s, speed_m_s);
        let fresh = job.material.fresh_density_kg_m3().nominal;
        let cold_m =
            process::bead::cold_diameter_m(hot_m, fresh, job.material.density_kg_m3.nominal);
        Printed {
            strand: printing.strand,
            at_m: crate::toolpath::stations(&points),
            as_printed: points.clone(),
            as_planned: points,
            radius_m: cold_m / 2.0,
            born_s: printing.start_s,
            done_s: printing.end_s,
        }
    };
    Deposit::new(motion.printings.iter().map(printed).collect())
}

/// The deposit as printed: each strand with its bead, sagged between what holds it.
pub(super) fn as_printed(job: &Job, motion: &Motion, strands: &[StrandResult]) -> Deposit {
    let printed = |(printing, result): (&crate::motion::Printing, &StrandResult)| {
        let as_planned = job.strands[printing.strand].points.clone();
        let at_m = crate::toolpath::stations(&as_planned);
        let sag_m = shown_sag_m(result);
        let (fine_m, fine) =
            if sag_m > 0.0 { refine(&as_planned, &at_m) } else { (at_m, as_planned) };
        Printed {
            strand: printing.strand,
            as_printed: deposit::sagged(&fine, &fine_m, sag_m, result.down),
            as_planned: fine,
            at_m: fine_m,
            radius_m: result.outcome.bead_diameter_m.nominal / 2.0,
            born_s: printing.start_s,
            done_s: printing.end_s,
        }
    };
    Deposit::new(motion.printings.iter().zip(strands).map(printed).collect())
}

/// Sag that bends the printed line, m: the elastic sag is in the frame and not counted here. A
/// sag too small to matter to a clearance leaves the line as planned; one that cannot be trusted
/// (or is endless) is a finding, not a shape.
fn shown_sag_m(result: &StrandResult) -> f64 {
    let sag_m = result.outcome.sag_nozzle_m.nominal;
    let radius_m = result.outcome.bead_diameter_m.nominal / 2.0;
    let matters =
        result.input.ends != Ends::Resting && sag_m.is_finite() && sag_m > 0.02 * radius_m;
    if matters { sag_m.min(result.input.span_m / 4.0) } else { 0.0 }
}

/// A straight strand needs points between its ends to sag; its corners stay.
fn refine(points: &[Point], at_m: &[f64]) -> (Vec<f64>, Vec<Point>) {
    const PIECES: usize = 8;
    let total_m = at_m[at_m.len() - 1];
    let (mut fine_m, mut fine) = (vec![at_m[0]], vec![points[0]]);
    for k in 1..points.len() {
        let length_m = at_m[k] - at_m[k - 1];
        let n_pieces = (length_m / total_m * PIECES as f64).ceil().max(1.0) as usize;
        for piece in 1..=n_pieces {
            let share = piece as f64 / n_pieces as f64;
            fine_m.push(at_m[k - 1] + length_m * share);
            fine.push(points[k - 1] + (points[k] - points[k - 1]) * share);
        }
    }
    (fine_m, fine)
}

fn make_one(
    job: &Job,
    path: &Path,
    printed: &Printed,
    contacts: &[&Contact],
    motion: &Motion,
) -> StrandResult {
    let strand = &job.strands[printed.strand];
    let tool = &job.cell.tool;
    let Hold { ends, span_m, start_held } = hold(job, printed, contacts);
    let is_print = |leg: &&Leg| leg.phase == Phase::Print && leg.strand == Some(printed.strand);
    let leg = motion.legs.iter().find(is_print);
    let (across_m_s2, down) = gravity(job, path, leg);
    let (speed_m_s, flow_m3_s) = mean_speed_and_flow(path);
    let input = StrandInput {
        length_m: path.length_m,
        span_m,
        speed_m_s,
        flow_m3_s,
        nozzle_diameter_m: tool.orifice_m,
        swell: job.cell.extruder.swell,
        gravity_across_m_s2: across_m_s2,
        ends,
        dwell_s: strand.end.dwell_s,
        air: Air {
            temperature_k: job.air.temperature_k,
            room_m_s: job.air.speed_m_s,
            jet: tool.air_jet,
        },
        light: tool.light_ring,
    };
    let outcome = process::simulate(&input, &job.material);
    let touches = contacts.len();
    StrandResult { strand: printed.strand, input, outcome, down, touches, start_held }
}

/// Mean asked speed over the length, and the flow told, of what is extruded.
fn mean_speed_and_flow(path: &Path) -> (f64, f64) {
    let (mut time_s, mut volume_m3) = (0.0, 0.0);
    for pair in path.samples.windows(2).filter(|pair| pair[1].at_m <= path.length_m + 1e-12) {
        let dt_s = (pair[1].at_m - pair[0].at_m) / pair[0].speed_m_s;
        time_s += dt_s;
        volume_m3 += pair[0].flow_m3_s * dt_s;
    }
    (path.length_m / time_s, volume_m3 / time_s)
}

/// What holds a strand while it is printed.
struct Hold {
    ends: Ends,
    /// Its longest unsupported span, m.
    span_m: f64,
    start_held: bool,
}

fn hold(job: &Job, printed: &Printed, contacts: &[&Contact]) -> Hold {
    let strand = &job.strands[printed.strand];
    let length_m = printed.at_m[printed.at_m.len() - 1];
    if strand.on != On::Air {
        return Hold { ends: Ends::Resting, span_m: length_m, start_held: true };
    }
    let near_m = 2.0 * printed.radius_m;
    let touches =
        |at_m: f64| contacts.iter().any(|contact| (contact.at_m[0] - at_m).abs() <= near_m);
    let grounded = |join: Option<Join>, point: &Point, at_m: f64| match join {
        Some(Join::Free) => false,
        Some(Join::Bed | Join::Form(_)) => true,
        Some(Join::Strand(_)) => touches(at_m),
        None => (job.bed_from_part * point).z <= 1.1 * printed.radius_m || touches(at_m),
    };
    let first = &printed.as_planned[0];
    let last = &printed.as_planned[printed.as_planned.len() - 1];
    let start_held = grounded(strand.start.join, first, 0.0);
    let end_held = grounded(strand.end.join, last, length_m);
    let mut holds: Vec<f64> = contacts.iter().map(|contact| contact.at_m[0]).collect();
    holds.extend(start_held.then_some(0.0));
    holds.extend(end_held.then_some(length_m));
    holds.sort_by(f64::total_cmp);
    let overhang_m = length_m - holds.last().copied().unwrap_or(0.0);
    // A strand that begins in the air hangs on its first contact like one that ends there.
    let lead_m = holds.first().copied().unwrap_or(length_m);
    let trailing_m = if end_held { 0.0 } else { overhang_m };
    let leading_m = if start_held { 0.0 } else { lead_m };
    let overhang_m = f64::max(trailing_m, leading_m);
    if overhang_m > near_m {
        return Hold { ends: Ends::StartHeld, span_m: overhang_m, start_held };
    }
    let widest_m = holds.windows(2).map(|pair| pair[1] - pair[0]).fold(0.0, f64::max);
    let span_m = if widest_m > 0.0 { widest_m } else { length_m };
    Hold { ends: Ends::BothHeld, span_m, start_held }
}

/// Largest component of gravity across the strand while it is printed, and its direction at that
/// place, in part axes: the bed may turn.
fn gravity(job: &Job, path: &Path, leg: Option<&Leg>) -> (f64, Vector) {
    let chain = &job.cell.robot.arm.chain;
    let at_rest = job.gravity_in_part(&chain.forward(&job.cell.home));
    let mut worst = (0.0, at_rest);
    for sample in &path.samples {
        let moment = leg.and_then(|leg| {
            let k = leg.moments.partition_point(|moment| moment.at_m < sample.at_m - 1e-12);
            leg.moments.get(k)
        });
        let g = moment.map_or(at_rest, |moment| job.gravity_in_part(&chain.forward(&moment.q)));
        let across_m_s2 = (g - sample.tangent * g.dot(&sample.tangent)).norm();
        if across_m_s2 > worst.0 {
            worst = (across_m_s2, g);
        }
    }
    let length = worst.1.norm();
    (worst.0, if length > 0.0 { worst.1 / length } else { Vector::zeros() })
}

/// What the structure needs to know. The strain of a strand whose end is free is its end-point
/// error (P304) and loads nothing; that of a strand on a form or between joints is locked in.
pub(super) fn law(job: &Job, result: &StrandResult) -> StrandLaw {
    let (outcome, material) = (&result.outcome, &job.material);
    StrandLaw {
        diameter_m: outcome.bead_diameter_m.nominal,
        area_fraction: outcome.area_fraction.nominal.max(1e-6),
        stiffness_fraction: outcome.stiffness_fraction.nominal.max(1e-6),
        e_pa: outcome.youngs_modulus_pa.nominal,
        poisson: material.poisson.nominal,
        density_kg_m3: material.density_kg_m3.nominal,
        strain: if result.input.ends == Ends::StartHeld {
            0.0
        } else {
            -outcome.free_strain.nominal
        },
        strength_pa: material.strength_pa.nominal,
        bond_fraction: material.bond_fraction.nominal,
    }
}

struct Judge<'a> {
    job: &'a Job,
    printed: &'a Printed,
    result: &'a StrandResult,
}

fn judge(job: &Job, printed: &Printed, result: &StrandResult, findings: &mut Findings) {
    let this = Judge { job, printed, result };
    let (limits, outcome) = (&job.limits, &result.outcome);
    this.start(findings);
    if result.input.ends != Ends::Resting {
        this.hold(Code::P301, outcome.sag_nozzle_m, limits.sag_m, None, findings, |mm| {
            (
                format!("sags {mm} behind the nozzle before it is set"),
                slower(job, limits.sag_m, outcome),
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
                "wait at the end before leaving it, or travel further by that much".to_owned(),
            )
        });
    }
    if let Some(core_m) = outcome.uncured_core_m {
        let radius_m = outcome.bead_diameter_m.nominal / 2.0;
        let [warn, stop] = limits.uncured_share.map(|share| share * radius_m);
        this.hold(Code::P305, core_m, stop, Some(warn), findings, |mm| {
            let words = format!(
                "keeps an uncured core of {mm} in a bead of {:.2} mm radius",
                radius_m * 1e3
            );
            (words, "print slower, add light, or plan a post-cure".to_owned())
        });
    }
}

/// The speed at which the sag behind the nozzle (its high end, if only that is past the limit)
/// would be at its limit: it grows as v⁴.
fn slower(job: &Job, limit_m: f64, outcome: &StrandOutcome) -> String {
    let Interval { nominal, high, .. } = outcome.sag_nozzle_m;
    let past_m = if nominal > limit_m { nominal } else { high };
    let ratio = (limit_m / past_m).powf(0.25);
    let jet = if job.cell.tool.air_jet.is_some() { "more air" } else { "an air jet" };
    format!(
        "print at {:.0} % of this speed or slower (sag goes with its fourth power), or with {jet}",
        ratio * 100.0
    )
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
        let length_m = self.printed.at_m[self.printed.at_m.len() - 1];
        let (at_m, point) = match code {
            Code::P304 => (length_m, self.printed.as_planned[self.printed.as_planned.len() - 1]),
            _ => (length_m / 2.0, along(self.printed, length_m / 2.0)),
        };
        let site = Site::strand(self.result.strand, at_m).at(point);
        let time_s = Some(self.printed.born_s);
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

fn along(printed: &Printed, at_m: f64) -> Point {
    let k = printed.at_m.partition_point(|&x| x < at_m).clamp(1, printed.at_m.len() - 1);
    let share = (at_m - printed.at_m[k - 1]) / (printed.at_m[k] - printed.at_m[k - 1]);
    printed.as_planned[k - 1] + (printed.as_planned[k] - printed.as_planned[k - 1]) * share
}
