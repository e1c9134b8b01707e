//! Times, lengths and mass, and what the answer rests on.

use std::f64::consts::FRAC_PI_4;

use super::StrandResult;
use crate::cell::{Job, Join};
use crate::finding::Phase;
use crate::growth::Growth;
use crate::kinematics::Coverage;
use crate::motion::Motion;
use crate::process::Setting;
use crate::toolpath::Path;

/// Sums over the whole program.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Totals {
    /// Length of the program, s.
    pub time_s: f64,
    /// Of it extruding along strands.
    pub print_s: f64,
    /// Of it resting, priming and waiting.
    pub dwell_s: f64,
    /// Of it moving without extrusion.
    pub transit_s: f64,
    /// Length of all strands, m.
    pub length_m: f64,
    /// Mass of all strands, kg.
    pub mass_kg: f64,
}

pub(super) fn totals(
    job: &Job,
    motion: &Motion,
    paths: &[Path],
    strands: &[StrandResult],
) -> Totals {
    let duration = |phase: fn(Phase) -> bool| -> f64 {
        let legs = motion.legs.iter().filter(|leg| phase(leg.phase));
        legs.filter_map(|leg| Some(leg.moments.last()?.time_s - leg.moments.first()?.time_s)).sum()
    };
    let print_s = duration(|phase| phase == Phase::Print);
    let moving_s = duration(|phase| phase != Phase::Print && phase != Phase::Dwell);
    let mass = |result: &StrandResult| {
        let d = result.outcome.bead_diameter_m.nominal;
        FRAC_PI_4 * d * d * result.input.length_m * job.material.density_kg_m3.nominal
    };
    Totals {
        time_s: motion.total_s,
        print_s,
        dwell_s: (motion.total_s - print_s - moving_s).max(0.0),
        transit_s: moving_s,
        length_m: paths.iter().map(|path| path.length_m).sum(),
        mass_kg: strands.iter().map(mass).sum(),
    }
}

/// Something the answer rests on that the reader should know.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Assumption {
    /// What it concerns: a word for grouping.
    pub about: &'static str,
    /// The assumption, one sentence.
    pub text: String,
}

pub(super) fn assumptions(job: &Job, growth: &Growth) -> Vec<Assumption> {
    let mut list = Vec::new();
    let mut say = |about: &'static str, text: String| list.push(Assumption { about, text });
    let robot = &job.cell.robot;
    say(
        "motion",
        format!(
            "ramps of {:.1} m/s² and {:.0} m/s³ along the path, corners {}; the controller's own blending may differ.",
            job.cell.controller.acceleration_m_s2,
            job.cell.controller.jerk_m_s3,
            if job.cell.controller.blend_m > 0.0 {
                format!("rounded within {:.1} mm", job.cell.controller.blend_m * 1e3)
            } else {
                "stopped at".to_owned()
            }
        ),
    );
    if job.cell.dynamics().is_none() {
        say("motion", format!("no masses are known of {}: torques are not judged.", robot.name));
    }
    if robot.acceleration.iter().all(Option::is_none) {
        let text = format!("no acceleration limits are known of {}'s joints.", robot.name);
        say("motion", text);
    }
    if job.cell.flange_load().is_none() {
        say("payload", "the mass on the flange is not known: payload is not judged.".to_owned());
    } else if robot.payload_kg.is_none() {
        say("payload", format!("the rated payload of {} is not known.", robot.name));
    }
    if robot.arm.coverage() == Coverage::Sampled {
        say(
            "motion",
            format!("postures of {} are searched numerically; some may be missed.", robot.name),
        );
    }
    say(
        "clearance",
        format!(
            "covered over every motion, not sampled: nothing is nearer than told by more than {:.2} mm, or the resolution told with it; joints are taken to turn evenly between moments, and how far the lines of the controller lie off that is added.",
            crate::collision::RESOLUTION_M * 1e3
        ),
    );
    say(
        "clearance",
        format!(
            "the arm's accuracy of ± {:.2} mm is added as an interval; rounding is far below the resolution.",
            robot.accuracy_m * 1e3
        ),
    );
    say(
        "clearance",
        format!(
            "the nozzle may touch a strand within {:.1} mm of a place where the strand being printed touches it.",
            job.limits.touch_zone_m * 1e3
        ),
    );
    if robot.shapes_assumed {
        say(
            "clearance",
            format!(
                "link shapes of {} are drawn without a mesh behind them, a little too big.",
                robot.name
            ),
        );
    }
    process_assumptions(job, &mut say);
    say("structure", "linear frame of set strands; what rests on bed or form is clamped until released; only S410 lets it go where adhesion (a mean stress, no peeling) does not hold it.".to_owned());
    say("structure", "a strand's contacts with itself are not joined.".to_owned());
    say(
        "structure",
        "shrinkage of strands joined at both ends is locked in whole when they are born."
            .to_owned(),
    );
    say("structure", "a strand that is being printed carries nothing yet and hangs on the frame with its weight; from the next stage on it has the modulus of its age.".to_owned());
    say("structure", "patches of contact bear shear by von Mises' share of their strength in tension; none is measured between strands.".to_owned());
    if !job.loads.is_empty() {
        say("structure", match job.material.setting {
            Setting::Thermoplastic(_) => "first yield under loads is told as predicted and times 0.77 (0.52 to 1.09), measured over predicted in six tests of two papers.".to_owned(),
            _ => "first yield under loads of this material is predicted without any test to compare with.".to_owned(),
        });
    }
    let unknown = growth.stages.iter().filter(|stage| stage.buckling_failed).count();
    if unknown > 0 {
        say(
            "structure",
            format!("no buckling factor was found for {unknown} of the stages it was asked of."),
        );
    }
    let refused = |strand: &crate::cell::Strand| matches!(strand.end.join, Some(Join::Free));
    if job.strands.iter().any(refused) {
        say("structure", "ends said to be free are not joined to what is there, even where they touch; later strands may land on them.".to_owned());
    }
    list
}

/// What the process rests on, and which laws nobody has the constants for.
fn process_assumptions(job: &Job, say: &mut impl FnMut(&'static str, String)) {
    let mut law = |text: &str| say("process", text.to_owned());
    if job.strands.iter().any(|strand| strand.events.iter().any(|event| event.set == "heater")) {
        law("`heater` events are carried to the program but not simulated.");
    }
    law(
        "sag behind the nozzle by closed forms up to a tenth of the bead, past it by the ageing rod; its growth with the fourth power of speed has no published measurement behind it.",
    );
    law(
        "sag, heat and shrinkage of a strand take its mean speed and bead; the beads along it are told beside them.",
    );
    law("intervals are corners: all adverse ends of the inputs together, no probability is meant.");
    let swell = job.cell.extruder.swell;
    if swell.low < swell.high {
        law(
            "a strand nominally taut may hang if its swell is greater than told: one bridge, and `twin calibrate`, tell.",
        );
    }
    if job.cell.extruder.lag_s.is_none() {
        law("the extruder's lag is not known: flow is taken to follow at once.");
    }
    match &job.material.setting {
        Setting::Thermoplastic(plastic) => {
            if plastic.weld.is_none() {
                law(
                    "no weld time is known of this melt: bonds take the bond fraction measured on other prints.",
                );
            } else {
                law(
                    "welds heal by a law whose constants are from memory; in free air it gives a fifth of what dense coupons have.",
                );
            }
            if plastic.heat.is_none() {
                law("specific heat and conductivity are taken as constant in temperature.");
            }
            if plastic.melt_life_s.is_none() {
                law(
                    "how long this melt may wait in the nozzle is not known: idle time is not judged.",
                );
            }
            law(
                "neighbours reheated by the passing nozzle and its jet are not taken back into the frame.",
            );
        }
        Setting::Photopolymer(resin) => {
            if resin.kinetics.is_none() {
                law(
                    "no cure kinetics are known of this resin: cure is told as depth by dose alone.",
                );
            } else {
                law(
                    "cure kinetics are fitted to the critical exposure; nobody has published rates for this resin.",
                );
            }
            if resin.kinetics.is_some() && resin.reaction_heat_j_kg.is_some() {
                law(
                    "heat of cure warms the middle of a strand and with it its gel age and degree of cure, not its cured depth, sag or shrinkage.",
                );
            } else {
                law(
                    "no heat of reaction or kinetics are known of this resin: it stays as warm as the air.",
                );
            }
            if resin.tacky_skin_m.is_none() {
                law("how thick a skin air keeps tacky is not known: all that is cured carries.");
            }
            law(
                "bleaching, refraction and light thrown back by the bed into the strand are left out of its dose.",
            );
            if job.cell.bed.albedo.is_none() {
                law("how much light the bed throws back is not known: it can only warn (P308).");
            }
            if job.strands.iter().any(|strand| strand.settings.second_pass_m_s.is_some()) {
                law(
                    "a second pass is credited with its dose; its motion and time are not planned.",
                );
                if resin.oxygen.is_none() || resin.tacky_skin_m.is_none() {
                    law(
                        "the oxygen of this resin is not known: what comes back before the second pass is left out.",
                    );
                }
            }
        }
        Setting::TwoPart(mix) => {
            if mix.activation_j_mol.is_none() || mix.reference_k.is_none() {
                law(
                    "how this mix's clock goes with temperature is not known: its set time is that behind the nozzle, in any air and mixer.",
                );
            }
            if mix.pot_life_s.is_none() {
                law("the pot life of this mix is not known: idle time is not judged.");
            }
        }
    }
    if job.strands.iter().any(|strand| strand.settings.threads.is_some()) {
        law("knotted threads stiffen the strand; their weight, heat and clearance are left out.");
    }
}
