//! Times, lengths and mass, and what the answer rests on.

use std::f64::consts::FRAC_PI_4;

use super::StrandResult;
use crate::cell::{Job, Join};
use crate::finding::Phase;
use crate::growth::Growth;
use crate::kinematics::Coverage;
use crate::motion::Motion;
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
            "the arm's accuracy of ± {:.2} mm is added as an interval; parry3d's f32 rounding of 0.002 mm is subtracted.",
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
    say("process", "sag behind the nozzle uses closed forms; its growth with the fourth power of speed has no published measurement behind it.".to_owned());
    say("process", "a strand is made with its mean speed and flow.".to_owned());
    let switched = |strand: &crate::cell::Strand| {
        !strand.events.is_empty() || strand.settings.lights_after_m > 0.0
    };
    if job.strands.iter().any(switched) {
        say("process", "`events` and `lights_after_mm` are carried to the program but not simulated: light and flow are taken as on along every strand.".to_owned());
    }
    say("process", "slack of over-fed strands is told but held against no limit.".to_owned());
    say("structure", "linear frame of set strands; what rests on bed or form is clamped until released, not one-sided.".to_owned());
    say("structure", "a strand's contacts with itself are not joined.".to_owned());
    say(
        "structure",
        "shrinkage of strands joined at both ends is locked in whole when they are born."
            .to_owned(),
    );
    if growth.landing_skipped {
        say(
            "structure",
            "the frame is too large for the landing check (S401), which was left out.".to_owned(),
        );
    }
    let refused = |strand: &crate::cell::Strand| matches!(strand.end.join, Some(Join::Free));
    if job.strands.iter().any(refused) {
        say("structure", "ends said to be free are not joined to what is there, even where they touch; later strands may land on them.".to_owned());
    }
    list
}
