use super::*;
use crate::cell::{Hose, Mode};
use crate::finding::{Code, Finding, Findings, Severity};
use crate::kinematics::Posture;
use crate::motion::{Leg, Moment, Motion};
use crate::test_job::{job, strand, text};

mod budgets;
mod hoses;
mod speeds;
mod values;

/// A strand that lies on the bed, one that rises from its end.
const LYING: [[f64; 3]; 2] = [[-20.0, -10.0, 1.0], [20.0, -10.0, 1.0]];
const RISING: [[f64; 3]; 3] = [[20.0, -10.0, 1.0], [10.0, 0.0, 25.0], [-20.0, 10.0, 40.0]];

fn motion_of(legs: Vec<Leg>) -> Motion {
    let total_s = legs.iter().filter_map(|leg| leg.moments.last()).map(|m| m.time_s).next_back();
    Motion {
        legs,
        printings: Vec::new(),
        releases: Vec::new(),
        needs: Vec::new(),
        rides: Vec::new(),
        speeds_m_s: Vec::new(),
        total_s: total_s.unwrap_or_default(),
        lost: Vec::new(),
    }
}

fn leg(phase: Phase, strand: Option<usize>, moments: Vec<Moment>) -> Leg {
    Leg { phase, strand, printed: 0, moments, unreached: Vec::new() }
}

fn found(judge: impl FnOnce(&mut Findings)) -> Vec<Finding> {
    let mut findings = Findings::default();
    judge(&mut findings);
    findings.sorted()
}
