//! Strand by strand: what holds it, what the process makes of it.

use super::course::{course, gravity_across};
use super::{judging, lighting};
use crate::cell::{Job, Join, On, Tool};
use crate::deposit::{self, Contact, Deposit, Printed};
use crate::finding::{Findings, Phase};
use crate::growth::StrandLaw;
use crate::interval::Interval;
use crate::motion::{Leg, Motion};
use crate::pose::{Point, Vector};
use crate::process::bead::Orifice;
use crate::process::drive::Drive;
use crate::process::fed::{self, BeadAt, Fed};
use crate::process::history::{Corner, History};
use crate::process::jet::{self, JetProfile};
use crate::process::lit::{self, Lit};
use crate::process::lit_cure::Warmth;
use crate::process::sag::LINEAR_LIMIT;
use crate::process::section::round;
use crate::process::soft_rod::{self, Sagged};
use crate::process::stretch::held_sag_m;
use crate::process::threads::Knotted;
use crate::process::{
    self, Air, Blown, Course, Ends, Fidelity, Heats, Setting, StrandInput, StrandOutcome,
};
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
    /// From where to where it hangs free, m.
    pub stretch_m: [f64; 2],
    /// How it was made.
    pub course: Course,
    /// Its beads along its length.
    pub fed: Fed,
    /// What the ageing rod makes of it, where the closed form says more than a tenth of the bead.
    pub sagged: Option<Sagged>,
    /// What the lights made of it; resins only.
    pub lit: Option<Lit>,
}

impl StrandResult {
    /// Beads away from the stretches at both ends where arm and flow are still getting up to speed.
    pub fn steady_beads(&self, job: &Job) -> impl Iterator<Item = &BeadAt> {
        let settings = &job.strands[self.strand].settings;
        let (_, ramp_m) = job.cell.controller.ramp(settings.speed_m_s);
        let end_m = ramp_m + 2.0 * self.outcome.hot_diameter_m;
        self.fed.away_from_ends(self.input.length_m, [end_m, end_m])
    }
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
            judging::judge(job, printed, &result, findings);
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
            as_printed: match &result.sagged {
                Some(sagged) if sag_m > 0.0 => {
                    let share = sag_m / sagged.greatest_m;
                    let offset = |at_m: f64| Vector::from(sagged.offset_at(at_m)) * share;
                    fine.iter().zip(&fine_m).map(|(point, at_m)| point + offset(*at_m)).collect()
                }
                _ => deposit::sagged(&fine, &fine_m, sag_m, result.down),
            },
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
    let Hold { ends, span_m, start_held, stretch_m } = hold(job, printed, contacts);
    let is_print = |leg: &&Leg| leg.phase == Phase::Print && leg.strand == Some(printed.strand);
    let leg = motion.legs.iter().find(is_print);
    let course = course(job, path, leg);
    let (across_m_s2, down) = gravity_across(&course);
    let fed = feed(job, path, &course);
    // A strand whose air goes off on the way is made without: its worst part is.
    let unblown = strand.events.iter().any(|event| event.set == "air" && !event.on);
    let (speed_m_s, _) = mean_speed_and_flow(path);
    let input = StrandInput {
        fidelity: Fidelity::Full,
        length_m: path.length_m,
        span_m,
        speed_m_s,
        flow_m3_s: fed.mean_flow_m3_s,
        nozzle_diameter_m: tool.orifice_m,
        swell: job.cell.extruder.swell,
        gravity_across_m_s2: across_m_s2,
        ends,
        mixer_m3: job.cell.extruder.mixer_m3.unwrap_or(0.0),
        dwell_s: strand.end.dwell_s,
        air: Air {
            temperature_k: job.air.temperature_k,
            room_m_s: job.air.speed_m_s,
            jet: tool.air_jet.filter(|_| !unblown),
            blown: jets(tool, &course).filter(|_| !unblown),
        },
        light: tool.light_ring,
    };
    let heats = Heats::new(&input, &job.material);
    let mut outcome = process::simulate_with(&input, &job.material, &heats);
    let lit = shine(job, &course, &input, &mut outcome, strand);
    let rod = Rod { input: &input, course: &course, job, heats: &heats, stretch_m };
    let sagged = rod.replaces(&mut outcome);
    let touches = contacts.len();
    let strand = printed.strand;
    StrandResult {
        strand,
        input,
        outcome,
        down,
        touches,
        start_held,
        stretch_m,
        course,
        fed,
        sagged,
        lit,
    }
}

/// The lights as they stand and shine, in the place of the closed form of a ring.
fn shine(
    job: &Job,
    course: &Course,
    input: &StrandInput,
    outcome: &mut StrandOutcome,
    strand: &crate::cell::Strand,
) -> Option<Lit> {
    let Setting::Photopolymer(resin) = &job.material.setting else { return None };
    if !lighting::any(job) {
        return None;
    }
    let radius_m = outcome.bead_diameter_m.nominal / 2.0;
    let exposure = lit::Exposure {
        lights: &|corner| lighting::lights(job, radius_m, corner),
        radius_m,
        length_m: input.length_m,
        second_pass_m_s: strand.settings.second_pass_m_s,
        post_cure_j_m2: strand.settings.post_cure_j_m2,
        resting: strand.on != On::Air,
        temperature_k: job.air.temperature_k,
        warmth: Some(Warmth {
            material: &job.material,
            air: &input.air,
            speed_m_s: input.speed_m_s,
        }),
    };
    let lit = lit::shine(course, resin, &exposure);
    let (_, depth_m) = lit.least()?;
    outcome.uncured_core_m = Some(depth_m.map(|depth_m| (radius_m - depth_m).max(0.0)));
    outcome.cured_depth_m = Some(depth_m);
    outcome.area_fraction = lit.area_fraction;
    outcome.stiffness_fraction = lit.stiffness_fraction;
    outcome.set_time_s = lit.median_gel_s();
    let length_m = input.length_m;
    let speed_m_s = length_m / course.time_at_s(length_m).max(f64::MIN_POSITIVE);
    outcome.set_distance_m = outcome.set_time_s.map(|time_s| time_s * speed_m_s);
    outcome.laws.extend(["lamps as geometry", "dose on the surface", "dose through the section"]);
    if lit.warmest_k.is_some() {
        outcome.laws.push("heat of cure through the section");
    }
    if resin.oxygen.is_some() && resin.tacky_skin_m.is_some() && exposure.second_pass_m_s.is_some()
    {
        outcome.laws.push("oxygen back before the second pass");
    }
    Some(lit)
}

/// The ageing rod in the place of the closed form.
pub(super) struct Rod<'a> {
    pub(super) input: &'a StrandInput,
    pub(super) course: &'a Course,
    pub(super) job: &'a Job,
    pub(super) heats: &'a Heats,
    pub(super) stretch_m: [f64; 2],
}

/// Share of the bead's diameter from which the rod is asked.
const ROD_FROM: f64 = 0.1;

impl Rod<'_> {
    /// Speed of the fastest twelfth of the stretch that hangs free, m/s; at least the mean.
    fn fastest_m_s(&self) -> f64 {
        const PARTS: usize = 12;
        let [from_m, to_m] = self.stretch_m;
        let step_m = (to_m - from_m) / PARTS as f64;
        let time_s = |k: usize| self.course.time_at_s(from_m + step_m * k as f64);
        let speeds = (0..PARTS).map(|k| step_m / (time_s(k + 1) - time_s(k)));
        speeds.filter(|speed| speed.is_finite()).fold(self.input.speed_m_s, f64::max)
    }

    /// Sag A by the rod at all corners, where the closed form's nominal value is past a tenth of the bead, or would be at
    /// the speed of the fastest stretch: it knows the mean speed alone.
    pub(super) fn replaces(&self, outcome: &mut StrandOutcome) -> Option<Sagged> {
        let diameter_m = outcome.hot_diameter_m;
        let faster = self.fastest_m_s() / self.input.speed_m_s;
        if !(outcome.sag_nozzle_m.nominal * faster.powi(4) > ROD_FROM * diameter_m) {
            return None;
        }
        let at = |corner| {
            let (input, material) = (self.input, &self.job.material);
            soft_rod::sag(input, self.course, material, self.heats, self.stretch_m, corner)
        };
        let (nominal, low, high) = (at(Corner::Nominal)?, at(Corner::Fast)?, at(Corner::Slow)?);
        let held = self.input.ends == Ends::BothHeld;
        let sag_m = |sagged: &Sagged| {
            if held { held_sag_m(sagged.greatest_m, diameter_m) } else { sagged.greatest_m }
        };
        let linear = sag_m(&nominal) <= LINEAR_LIMIT * diameter_m;
        // The rod knows no gel that is still getting its yield stress back; the closed form does.
        let high_m = sag_m(&high).max(match self.job.material.setting {
            Setting::Photopolymer(_) => outcome.sag_nozzle_m.high,
            Setting::Thermoplastic(_) | Setting::TwoPart(_) => 0.0,
        });
        outcome.sag_nozzle_m = Interval::new(sag_m(&nominal), sag_m(&low), high_m);
        outcome.sag_linear = linear;
        outcome.laws.push("ageing rod");
        Some(nominal)
    }
}

/// The strand's beads by the extruder's lag and levels and the arm's true speed.
fn feed(job: &Job, path: &Path, course: &Course) -> Fed {
    let extruder = &job.cell.extruder;
    let drive = if extruder.levels_m3_s.is_empty() {
        Drive::Any
    } else {
        Drive::Levels(extruder.levels_m3_s.clone())
    };
    let orifice = Orifice {
        nozzle_m: job.cell.tool.orifice_m,
        swell: extruder.swell.nominal,
        hot_kg_m3: job.material.fresh_density_kg_m3().nominal,
        cold_kg_m3: job.material.density_kg_m3.nominal,
    };
    let lag_s = extruder.lag_s.map_or(0.0, |lag| lag.nominal);
    let strand = &job.strands[path.strand];
    let asked = |at_m: f64| {
        let (speed_m_s, flow_m3_s) = strand.asked(at_m);
        (flow_m3_s, speed_m_s)
    };
    let extruder = fed::Extruder { lag_s, drive, orifice };
    fed::feed(course, path.length_m, &extruder, asked)
}

/// Length of strand behind the nozzle along which jets told one by one are looked for, m.
const JET_REACH_M: f64 = 0.08;

/// Air nozzles told one by one: their air across the strand as it leaves the nozzle half way along.
fn jets(tool: &Tool, course: &Course) -> Option<Blown> {
    let first = tool.air_nozzles.first()?;
    let nozzles: Vec<jet::AirNozzle> = tool
        .air_nozzles
        .iter()
        .map(|nozzle| jet::AirNozzle {
            at: nozzle.at,
            along: nozzle.along,
            bore_m: nozzle.bore_m,
            exit_speed_m_s: nozzle.exit_m_s.nominal,
        })
        .collect();
    let middle = &course.stations[course.stations.len() / 2];
    let leaving = middle.part_from_tool.inverse_transform_vector(&-middle.tangent);
    let profile = JetProfile::new(&nozzles, &Point::origin(), &leaving, JET_REACH_M, 160);
    let exit = first.exit_m_s;
    let share =
        if exit.nominal > 0.0 { exit.map(|v| v / exit.nominal) } else { Interval::exact(1.0) };
    let place = |k: usize| profile.at_distance_m_s(JET_REACH_M * k as f64 / 39.0);
    Some(Blown { reach_m: JET_REACH_M, speeds_m_s: std::array::from_fn(place), share })
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
    /// Where that span lies, arc lengths, m.
    stretch_m: [f64; 2],
}

fn hold(job: &Job, printed: &Printed, contacts: &[&Contact]) -> Hold {
    let strand = &job.strands[printed.strand];
    let length_m = printed.at_m[printed.at_m.len() - 1];
    if strand.on != On::Air {
        return Hold {
            ends: Ends::Resting,
            span_m: length_m,
            start_held: true,
            stretch_m: [0.0, length_m],
        };
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
        let stretch_m = if trailing_m >= leading_m {
            [length_m - trailing_m, length_m]
        } else {
            [0.0, leading_m]
        };
        return Hold { ends: Ends::StartHeld, span_m: overhang_m, start_held, stretch_m };
    }
    let longest = |a: [f64; 2], b: &[f64]| if b[1] - b[0] > a[1] - a[0] { [b[0], b[1]] } else { a };
    let mut stretch_m = holds.windows(2).fold([0.0, 0.0], longest);
    if stretch_m[1] <= stretch_m[0] {
        stretch_m = [0.0, length_m];
    }
    let span_m = stretch_m[1] - stretch_m[0];
    Hold { ends: Ends::BothHeld, span_m, start_held, stretch_m }
}

/// Axial and bending stiffness with knotted threads over those of the core alone, over its longest span.
fn threads_share(job: &Job, result: &StrandResult) -> [f64; 2] {
    let Some(threads) = job.strands[result.strand].settings.threads else { return [1.0, 1.0] };
    let core_m = result.outcome.bead_diameter_m.nominal;
    let knotted = Knotted {
        core_m,
        thread_m: threads.diameter_m,
        count: threads.count,
        knot_offset_m: 0.5 * (core_m + threads.diameter_m),
        sweep_m: threads.sweep_m,
        pitch_m: threads.pitch_m,
    };
    let e_pa = result.outcome.youngs_modulus_pa.nominal;
    let stiffness = knotted.stiffness(e_pa, job.material.poisson.nominal);
    let core = round(core_m);
    let axial = stiffness.axial_n / (e_pa * core.area_m2);
    let bending = stiffness.bending_over_span_n_m2(result.input.span_m) / (e_pa * core.i_y_m4);
    [axial, bending].map(|share| if share.is_finite() { share.max(1.0) } else { 1.0 })
}

/// What the structure needs to know. The strain of a strand whose end is free is its end-point
/// error (P304) and loads nothing; that of a strand on a form or between joints is locked in.
pub(super) fn law(job: &Job, result: &StrandResult) -> StrandLaw {
    let (outcome, material) = (&result.outcome, &job.material);
    let [axial, bending] = threads_share(job, result);
    StrandLaw {
        diameter_m: outcome.bead_diameter_m.nominal,
        area_fraction: outcome.area_fraction.nominal.max(1e-6) * axial,
        stiffness_fraction: outcome.stiffness_fraction.nominal.max(1e-6) * bending,
        e_pa: outcome.youngs_modulus_pa.nominal,
        poisson: material.poisson.nominal,
        density_kg_m3: material.density_kg_m3.nominal,
        strain: match result.input.ends {
            Ends::StartHeld => 0.0,
            // What shrank before the far end was joined was fed from the nozzle.
            Ends::BothHeld => -outcome.shortening_m.nominal / result.input.length_m,
            // Held where it lies, section by section.
            Ends::Resting => -outcome.free_strain.nominal,
        },
        strength_pa: material.strength_pa.nominal,
        ageing: ageing(job, result),
    }
}

/// Ages at which the modulus of a strand is sampled, s; between them it is taken as linear.
const AGES_S: [f64; 12] =
    [0.5, 1.0, 2.0, 4.0, 8.0, 16.0, 32.0, 64.0, 128.0, 300.0, 900.0, LAST_AGE_S];
/// By then a strand is what it will be, s.
const LAST_AGE_S: f64 = 3600.0;

/// The modulus at ages as a share of the last, until it is all there.
fn ageing(job: &Job, result: &StrandResult) -> Vec<[f64; 2]> {
    let history = History::new(&result.input, &job.material);
    let last_pa = history.modulus_pa(LAST_AGE_S);
    if !(last_pa > 0.0 && last_pa.is_finite()) {
        return Vec::new();
    }
    let ages =
        AGES_S.iter().map(|&age_s| [age_s, (history.modulus_pa(age_s) / last_pa).clamp(0.0, 1.0)]);
    ages.collect()
}
