//! What the program asks of the arm beyond its path.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use sim::cell::Job;
use sim::preflight::Program;
use sim::program as found;

use crate::fill::number;

/// Time of the program by what it is spent on, s.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Cycle {
    /// Extruding along strands.
    pub print_s: Option<f64>,
    /// Priming and resting at nodes.
    pub dwell_s: Option<f64>,
    /// Straight ways to and from strands.
    pub approach_s: Option<f64>,
    /// Between strands, and moves the job gives.
    pub transit_s: Option<f64>,
    /// Waits that the job asks for.
    pub wait_s: Option<f64>,
}

/// What hangs on the flange.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Payload {
    /// Its mass, kg.
    pub mass_kg: Option<f64>,
    /// Rated payload of the arm, kg; null: not known.
    pub rated_kg: Option<f64>,
    /// Static moments of the wrist as shares of what is allowed, by joint.
    pub moments: Vec<Share>,
}

/// A share of a limit by joint.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Share {
    /// Name of the joint.
    pub joint: String,
    /// Share of its limit.
    pub share: Option<f64>,
}

/// What the program does to one hose.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Hose {
    /// Its name.
    pub name: String,
    /// Greatest distance of its ends, m.
    pub stretch_m: Option<f64>,
    /// Greatest twist of its ends against each other, rad.
    pub twist_rad: Option<f64>,
}

/// How the drives follow a stop.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Tracking {
    /// When the arm stops, s.
    pub stop_s: Option<f64>,
    /// Greatest distance of the orifice from the plan, m.
    pub greatest_m: Option<f64>,
    /// Root mean square of it, m.
    pub rms_m: Option<f64>,
    /// Time after the stop until the orifice stays within 0.1 mm, s; null: longer than looked at.
    pub settling_s: Option<f64>,
    /// Natural frequency of the drives that is assumed, Hz.
    pub frequency_hz: Option<f64>,
}

/// True TCP speed along a strand.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct TcpSpeed {
    /// Slowest over asked, mean over one bead, beyond the ramps at its ends.
    pub slowest_share: Option<f64>,
    /// Fastest over asked.
    pub fastest_share: Option<f64>,
    /// Diameter of the bead there over that at the asked speed: thinnest.
    pub thinnest_share: Option<f64>,
    /// Thickest.
    pub thickest_share: Option<f64>,
    /// Length of the ramps at start and end, m.
    pub ramps_m: [Option<f64>; 2],
}

/// Error budget of a strand: how far errors of calibration move it against what it meets.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Budget {
    /// Against bed or form, the root of all squares, m.
    pub displacement_m: Option<f64>,
    /// Against the strands it meets, m.
    pub between_m: Option<f64>,
}

pub(crate) fn cycle(program: &Program) -> Cycle {
    let cycle = &program.cycle;
    Cycle {
        print_s: number(cycle.print_s),
        dwell_s: number(cycle.dwell_s),
        approach_s: number(cycle.approach_s),
        transit_s: number(cycle.transit_s),
        wait_s: number(cycle.wait_s),
    }
}

pub(crate) fn payload(program: &Program) -> Option<Payload> {
    program.payload.as_ref().map(|payload| Payload {
        mass_kg: number(payload.mass_kg.nominal),
        rated_kg: payload.rated_kg.and_then(number),
        moments: payload
            .moments
            .iter()
            .map(|(joint, share)| Share { joint: joint.clone(), share: number(*share) })
            .collect(),
    })
}

pub(crate) fn hoses(job: &Job, program: &Program) -> Vec<Hose> {
    let hose = |used: &found::HoseUse| Hose {
        name: job.cell.hoses[used.hose].name.clone(),
        stretch_m: number(used.stretch.value),
        twist_rad: number(used.twist.value),
    };
    program.hoses.iter().map(hose).collect()
}

pub(crate) fn tracking(program: &Program) -> Option<Tracking> {
    program.tracking.map(|tracking| Tracking {
        stop_s: number(tracking.stop_s),
        greatest_m: number(tracking.greatest_m),
        rms_m: number(tracking.rms_m),
        settling_s: tracking.settling_s.and_then(number),
        frequency_hz: number(tracking.frequency_hz),
    })
}

pub(crate) fn tcp_speed(program: &Program, strand: usize) -> Option<TcpSpeed> {
    let speed = program.speeds.iter().find(|speed| speed.strand == strand)?;
    let [slow, fast] = &speed.beyond;
    Some(TcpSpeed {
        slowest_share: number(slow.ratio),
        fastest_share: number(fast.ratio),
        thinnest_share: number(fast.bead_factor()),
        thickest_share: number(slow.bead_factor()),
        ramps_m: speed.ramps_m.map(number),
    })
}

pub(crate) fn budget(program: &Program, strand: usize) -> Option<Budget> {
    let budget = program.budgets.iter().find(|budget| budget.strand == strand)?;
    Some(Budget {
        displacement_m: number(budget.displacement_m),
        between_m: number(budget.between_m),
    })
}
