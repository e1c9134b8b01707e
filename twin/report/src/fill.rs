//! From a preflight to a report.

use sim::cell::Job;
use sim::finding as found;
use sim::interval::Interval;
use sim::kinematics;
use sim::motion::{Printing, Spot, StrandMotion};
use sim::pose::Vector;
use sim::preflight::{Preflight, StrandResult};
use sim::process;

use crate::parts::{
    Assumption, Finding, Phase, Provenance, Report, Scores, Severity, Site, Timing, Totals, Verdict,
};
use crate::results::{self, Coverage, Ends, Motion, Nearest, Range, Strand};
use crate::strands;
use crate::{frame, program};

impl Report {
    /// Everything a preflight found; `source` is the text of the job, for line numbers.
    ///
    /// Numbers that are not finite become null: JSON has no others.
    pub fn new(
        preflight: &Preflight,
        source: &slam::Source,
        provenance: Provenance,
        timing: Timing,
    ) -> Self {
        let fill = Fill { preflight, job: preflight.job(), source };
        let grown = &preflight.growth;
        let scores = preflight.scores();
        let family = |family| scores.family(family).and_then(number);
        Self {
            schema: crate::SCHEMA.to_owned(),
            name: fill.job.name.clone(),
            verdict: match preflight.verdict() {
                found::Verdict::Feasible => Verdict::Feasible,
                found::Verdict::Infeasible => Verdict::Infeasible,
            },
            score: scores.total().and_then(number),
            scores: Scores {
                reach: family(found::Family::Reach),
                clearance: family(found::Family::Clearance),
                process: family(found::Family::Process),
                structure: family(found::Family::Structure),
                program: family(found::Family::Program),
            },
            findings: preflight.findings().iter().map(|each| fill.finding(each)).collect(),
            strands: fill.strands(),
            stages: grown
                .stages
                .iter()
                .map(|each| frame::stage(fill.job, &grown.built, each))
                .collect(),
            landings: grown.landings.iter().map(|each| frame::landing(fill.job, each)).collect(),
            motion: fill.motion(),
            loads: grown.loads.iter().map(|each| frame::load(fill.job, each)).collect(),
            totals: totals(&preflight.totals),
            assumptions: preflight.assumptions.iter().map(assumption).collect(),
            provenance,
            timing: finite_times(timing),
        }
    }
}

struct Fill<'a> {
    preflight: &'a Preflight,
    job: &'a Job,
    source: &'a slam::Source,
}

impl Fill<'_> {
    fn id(&self, strand: usize) -> String {
        self.job.strands[strand].id.clone()
    }

    fn line(&self, strand: usize) -> usize {
        self.source.line_column(self.job.strands[strand].span.start).0
    }

    fn finding(&self, finding: &found::Finding) -> Finding {
        Finding {
            code: finding.code.as_str().to_owned(),
            severity: match finding.severity {
                found::Severity::Error => Severity::Error,
                found::Severity::Warning => Severity::Warning,
            },
            title: finding.code.title().to_owned(),
            message: finding.message.clone(),
            hint: finding.hint.clone(),
            site: self.site(&finding.site),
            line: finding.site.strand.map(|strand| self.line(strand)),
            time_s: finding.time_s.and_then(number),
            measured: number(finding.measured.nominal),
            low: number(finding.measured.low),
            high: number(finding.measured.high),
            limit: number(finding.limit),
            unit: finding.unit.to_owned(),
            count: finding.count,
            allowed: None,
        }
    }

    fn site(&self, site: &found::Site) -> Site {
        Site {
            strand: site.strand.map(|strand| self.id(strand)),
            at_m: site.at_m.and_then(number),
            stage: site.stage,
            node: site.node,
            member: site.member,
            phase: site.phase.map(phase),
            bodies: site.bodies.clone(),
        }
    }

    fn strands(&self) -> Vec<Strand> {
        let printings = &self.preflight.motion.printings;
        printings
            .iter()
            .zip(&self.preflight.strands)
            .enumerate()
            .map(|(order, (printing, result))| self.strand(order, printing, result))
            .collect()
    }

    fn strand(&self, order: usize, printing: &Printing, result: &StrandResult) -> Strand {
        let StrandResult { strand, input, outcome, .. } = result;
        Strand {
            id: self.id(*strand),
            line: Some(self.line(*strand)),
            start_s: number(printing.start_s),
            end_s: number(printing.end_s),
            length_m: number(input.length_m),
            speed_m_s: number(input.speed_m_s),
            flow_m3_s: number(input.flow_m3_s),
            ends: match input.ends {
                process::Ends::BothHeld => Ends::BothHeld,
                process::Ends::StartHeld => Ends::StartHeld,
                process::Ends::Resting => Ends::Resting,
            },
            span_m: number(input.span_m),
            bead_m: range(outcome.bead_diameter_m),
            draw_ratio: range(outcome.draw_ratio),
            set_time_s: range(outcome.set_time_s),
            set_distance_m: range(outcome.set_distance_m),
            sag_nozzle_m: range(outcome.sag_nozzle_m),
            sag_linear: outcome.sag_linear,
            sag_slack_m: range(outcome.sag_slack_m),
            sag_set_m: range(outcome.sag_set_m),
            end_miss_m: range(outcome.end_miss_m),
            shortening_m: range(outcome.shortening_m),
            cured_depth_m: outcome.cured_depth_m.map(range),
            bond: self.bond(order),
            reheated: self.reheated(order),
            bead_share: strands::bead_share(self.job, result),
            blobs_m: strands::blobs_m(result),
            ageing: strands::ageing(self.job, result),
            centreline_m: strands::centreline_m(&self.preflight.deposit.strands[order]),
            uncured_core_m: outcome.uncured_core_m.map(range),
            warmest_k: result.lit.as_ref().and_then(|lit| lit.warmest_k).map(range),
            area_fraction: range(outcome.area_fraction),
            stiffness_fraction: range(outcome.stiffness_fraction),
            free_strain: range(outcome.free_strain),
            laws: outcome.laws.iter().map(|&law| law.to_owned()).collect(),
            motion: self
                .preflight
                .strand_motion
                .get(*strand)
                .copied()
                .flatten()
                .map(|motion| self.strand_motion(motion)),
            tcp_speed: program::tcp_speed(&self.preflight.program, *strand),
            error_budget: program::budget(&self.preflight.program, *strand),
        }
    }

    fn bond(&self, order: usize) -> Option<results::Bond> {
        let bond = self.preflight.bonds[order]?;
        Some(results::Bond {
            value: number(bond.degree.nominal),
            low: number(bond.degree.low),
            high: number(bond.degree.high),
            strength_n: range(bond.strength_n),
            to: self.id(bond.other),
            at_m: bond.at_m,
            by_law: bond.by_law,
        })
    }

    fn reheated(&self, order: usize) -> Option<results::Reheated> {
        let warmed = self.preflight.reheats[order]?;
        Some(results::Reheated {
            peak_k: range(warmed.peak_k),
            above_glass_s: range(warmed.above_glass_s),
            softened_m: range(warmed.softened_m),
            by: self.id(warmed.by),
            at_m: warmed.at_m,
        })
    }

    fn strand_motion(&self, motion: StrandMotion) -> results::StrandMotion {
        let chain = &self.job.cell.robot.arm.chain;
        let joint = |spot: Spot| spot.axis.map(|axis| chain.axis_name(axis).to_owned());
        results::StrandMotion {
            joint_speed_share: number(motion.joint_speed_share),
            joint_margin_rad: number(motion.joint_margin_rad),
            condition_number: number(motion.condition_number),
            deviation_m: number(motion.deviation_m),
            deviation_linear_m: number(motion.deviation_linear_m),
            deviation_joint_m: number(motion.deviation_joint_m),
            wrist_rad: motion.wrist_rad.and_then(number),
            elbow_rad: motion.elbow_rad.and_then(number),
            shoulder_m: motion.shoulder_m.and_then(number),
            worst_at: results::WorstAt {
                joint_speed_m: motion.joint_speed_at.at_m,
                joint_speed: joint(motion.joint_speed_at),
                joint_margin_m: motion.joint_margin_at.at_m,
                joint_margin: joint(motion.joint_margin_at),
                condition_m: motion.condition_at.at_m,
                wrist_m: motion.wrist_at.at_m,
                elbow_m: motion.elbow_at.at_m,
                shoulder_m: motion.shoulder_at.at_m,
            },
        }
    }

    fn motion(&self) -> Motion {
        let nearest = self.preflight.nearest.as_ref();
        Motion {
            total_s: number(self.preflight.motion.total_s),
            smallest_clearance: nearest.map(|nearest| Nearest {
                clearance_m: number(nearest.clearance_m),
                resolution_m: number(nearest.resolution_m),
                accuracy_m: number(nearest.accuracy_m),
                bodies: nearest.bodies.clone(),
                phase: phase(nearest.phase),
                strand: nearest.strand.map(|strand| self.id(strand)),
                at_m: number(nearest.at_m),
                point_m: [nearest.point.x, nearest.point.y, nearest.point.z].map(number),
                time_s: number(nearest.time_s),
            }),
            ik_coverage: match self.job.cell.robot.arm.coverage() {
                kinematics::Coverage::Complete => Coverage::Complete,
                kinematics::Coverage::Sampled => Coverage::Sampled,
            },
            cycle: program::cycle(&self.preflight.program),
            payload: program::payload(&self.preflight.program),
            hoses: program::hoses(self.job, &self.preflight.program),
            tracking: program::tracking(&self.preflight.program),
        }
    }
}

fn totals(totals: &sim::preflight::Totals) -> Totals {
    Totals {
        time_s: number(totals.time_s),
        print_s: number(totals.print_s),
        dwell_s: number(totals.dwell_s),
        transit_s: number(totals.transit_s),
        length_m: number(totals.length_m),
        mass_kg: number(totals.mass_kg),
    }
}

fn assumption(assumption: &sim::preflight::Assumption) -> Assumption {
    Assumption { about: assumption.about.to_owned(), text: assumption.text.clone() }
}

fn phase(phase: found::Phase) -> Phase {
    match phase {
        found::Phase::Approach => Phase::Approach,
        found::Phase::Print => Phase::Print,
        found::Phase::Dwell => Phase::Dwell,
        found::Phase::Retract => Phase::Retract,
        found::Phase::Transit => Phase::Transit,
    }
}

fn finite_times(mut timing: Timing) -> Timing {
    let finite = |time_s: f64| number(time_s).unwrap_or(0.0);
    timing.total_s = finite(timing.total_s);
    for step in &mut timing.steps {
        step.time_s = finite(step.time_s);
    }
    timing
}

/// The number if JSON has it.
pub(crate) fn number(value: f64) -> Option<f64> {
    value.is_finite().then_some(value)
}

pub(crate) fn range(interval: Interval) -> Range {
    Range {
        value: number(interval.nominal),
        low: number(interval.low),
        high: number(interval.high),
    }
}

pub(crate) fn vector(vector: &Vector) -> Option<[f64; 3]> {
    vector.iter().all(|value| value.is_finite()).then(|| [vector.x, vector.y, vector.z])
}
