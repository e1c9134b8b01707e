//! Which print would help most.

use nalgebra::{DMatrix, DVector};

use crate::process::bead::{drawn_diameter_m, flow_m3_s};
use crate::process::{Setting, StrandInput};

use super::fit::inverse;
use super::known::{Known, Parameter};
use super::predict::{Print, predicted_m};

/// A proposed print is taken to be measured this well, of what is measured; ours.
const MEASURED_WITHIN: f64 = 0.03;
/// And not better than this, m: a calliper; ours.
const CALLIPER_M: f64 = 2e-5;

/// The print that would help most.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Next {
    /// What to print.
    pub print: Print,
    /// What it is expected to measure, m.
    pub predicted_m: f64,
    /// The parameter it tells most about.
    pub helps: Parameter,
    /// Standard deviation of that parameter over what it was before any print, as it is now.
    pub doubt_now: f64,
    /// The same once this print is measured.
    pub doubt_then: f64,
}

/// The candidate that leaves the least doubt: the sum of the variances, each over its prior's (A-optimal on
/// the linearised posterior). Not the worst interval alone: where two parameters are unknown, no single
/// print narrows the worst. `None` where no candidate takes 5 % off any deviation.
pub(super) fn best(
    known: &Known,
    usual: Option<&StrandInput>,
    parameters: &[Parameter],
    precision: &DMatrix<f64>,
    slopes: impl Fn(&Print) -> DVector<f64>,
) -> Option<Next> {
    let now = deviations(precision);
    let mut best: Option<(f64, Next)> = None;
    for print in candidates(known, usual) {
        let predicted_m = predicted_m(&print, known);
        if !predicted_m.is_finite() {
            continue;
        }
        let row = slopes(&print) / (MEASURED_WITHIN * predicted_m.abs()).max(CALLIPER_M);
        let then = deviations(&(precision + &row * row.transpose()));
        let left: f64 = then.iter().map(|deviation| deviation * deviation).sum();
        let gain = |index: usize| now[index] - then[index];
        let helped = (0..now.len()).max_by(|&a, &b| gain(a).total_cmp(&gain(b)));
        let Some(index) = helped.filter(|&index| then[index] < 0.95 * now[index]) else { continue };
        if best.is_none_or(|(least, _)| left < least) {
            let (doubt_now, doubt_then) = (now[index], then[index]);
            let helps = parameters[index];
            best = Some((left, Next { print, predicted_m, helps, doubt_now, doubt_then }));
        }
    }
    best.map(|(_, next)| next)
}

fn deviations(precision: &DMatrix<f64>) -> Vec<f64> {
    inverse(precision).diagonal().iter().map(|variance| variance.sqrt()).collect()
}

/// Prints anyone can make: a free hang, bridges of 30, 60 and 90 mm with the usual bead at the usual speed and
/// half of it, cantilevers of 50 and 100 mm, doses of 2, 4 and 8 times the critical one (at and below it
/// nothing stays to measure).
pub(super) fn candidates(known: &Known, usual: Option<&StrandInput>) -> Vec<Print> {
    let mut prints = Vec::new();
    if let Some(usual) = usual {
        prints.push(Print::FreeHang { nozzle_diameter_m: usual.nozzle_diameter_m });
        let of = |length_m: f64, speed_m_s: f64, flow_m3_s: f64| StrandInput {
            length_m,
            span_m: length_m,
            speed_m_s,
            flow_m3_s,
            ..*usual
        };
        let (speed_m_s, flow) = (usual.speed_m_s, usual.flow_m3_s);
        let half_flow = flow_m3_s(drawn_diameter_m(flow, speed_m_s), 0.5 * speed_m_s);
        for span_m in [0.03, 0.06, 0.09] {
            prints.push(Print::Bridge(of(span_m, speed_m_s, flow)));
            prints.push(Print::Bridge(of(span_m, 0.5 * speed_m_s, half_flow)));
        }
        prints.extend([0.05, 0.1].map(|length_m| Print::Cantilever(of(length_m, speed_m_s, flow))));
    }
    if let Setting::Photopolymer(resin) = &known.material.setting {
        let critical = resin.critical_exposure_j_m2.nominal;
        prints
            .extend([2.0, 4.0, 8.0].map(|times| Print::CuredDepth { dose_j_m2: times * critical }));
    }
    prints
}
