//! Numbers against the time of the program.

use super::{Film, Player};
use crate::motion::Moment;
use crate::pose::Point;
use crate::preflight::Preflight;

/// What a trace tells.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum TraceOf {
    /// Speed of the orifice over the part, m/s.
    Speed,
    /// Speed of a joint (an index in [`Film::joints`]) over its limit.
    Joint(usize),
    /// Least clearance of the leg, m; held at twice the limit where nothing came nearer.
    Clearance,
    /// Mean temperature where the newest strand begins, K.
    Temperature,
    /// Degree of cure where the newest strand begins.
    Cure,
    /// Sag behind the nozzle of each strand, m.
    Sag,
    /// Largest displacement of the frame by its weight, staged, m.
    Displacement,
    /// Factor on the weight at which the frame would buckle.
    Buckling,
}

impl TraceOf {
    /// A value in SI as it stands on a screen.
    pub fn on_screen(self, value: f64) -> f64 {
        match self {
            Self::Speed | Self::Clearance | Self::Sag | Self::Displacement => value * 1e3,
            Self::Joint(_) | Self::Cure => value * 100.0,
            Self::Temperature => value - 273.15,
            Self::Buckling => value,
        }
    }

    /// Unit on a screen; empty for a ratio.
    pub fn unit(self) -> &'static str {
        match self {
            Self::Speed => "mm/s",
            Self::Clearance | Self::Sag | Self::Displacement => "mm",
            Self::Joint(_) | Self::Cure => "%",
            Self::Temperature => "°C",
            Self::Buckling => "",
        }
    }
}

/// A number against time.
#[derive(Debug, Clone, PartialEq)]
pub struct Trace {
    /// What it is.
    pub of: TraceOf,
    /// Times, s, ascending, and values, SI; a value that is not finite is a gap.
    pub points: Vec<[f64; 2]>,
    /// Each value holds until the next.
    pub steps: bool,
    /// Its limit, SI.
    pub limit: Option<f64>,
}

/// Ages at which temperature and cure of a strand are told.
const AGES: usize = 12;

/// All traces of which anything is known. O(n) in moments, strands and stages.
pub fn traces(preflight: &Preflight, film: &Film) -> Vec<Trace> {
    let limits = &preflight.job().limits;
    let trace = |of, points: Vec<[f64; 2]>, steps, limit| Trace { of, points, steps, limit };
    let mut all = moving(preflight, film);
    let clearance = film.legs.iter().map(|leg| {
        [
            leg.from_s,
            leg.clearance_m.unwrap_or(2.0 * limits.clearance_m).min(2.0 * limits.clearance_m),
        ]
    });
    all.push(trace(TraceOf::Clearance, clearance.collect(), true, Some(limits.clearance_m)));
    for (of, pick) in [
        (TraceOf::Temperature, (|a| &a.temperature_k) as fn(&super::Ageing) -> &Vec<f64>),
        (TraceOf::Cure, |a| &a.cure),
    ] {
        all.push(trace(of, newest(film, pick), false, None));
    }
    let sag = film.strands.iter().filter_map(|strand| Some([strand.done_s()?, strand.sag_m]));
    all.push(trace(TraceOf::Sag, sag.collect(), true, Some(limits.sag_m)));
    let staged = |value: fn(&crate::growth::StageResult) -> Option<f64>| {
        let stages = preflight.growth.stages.iter().filter_map(move |stage| {
            let done_s = film.strands.get(stage.printed.checked_sub(1)?)?.done_s()?;
            Some([done_s, value(stage)?])
        });
        stages.collect::<Vec<_>>()
    };
    let moved = staged(|stage| stage.staged_m);
    all.push(trace(TraceOf::Displacement, moved, true, Some(limits.deflection_m)));
    let buckling = staged(|stage| stage.buckling.map(|buckled| buckled.factor));
    all.push(trace(TraceOf::Buckling, buckling, true, Some(limits.buckling_factor)));
    all.retain(|trace| trace.points.iter().any(|point| point[1].is_finite()));
    for trace in &mut all {
        trace.points.retain(|point| point[0].is_finite());
        trace.points.sort_by(|a, b| a[0].total_cmp(&b[0]));
    }
    all
}

/// Speeds of orifice and joints, as differences between moments.
fn moving(preflight: &Preflight, film: &Film) -> Vec<Trace> {
    let player = Player::new(preflight);
    let mut speed = Vec::new();
    let mut joints: Vec<Vec<[f64; 2]>> = vec![Vec::new(); film.joints.len()];
    for leg in preflight.motion.legs.iter() {
        // still before it, where the arm may have waited since the last one
        if let Some(first) = leg.moments.first() {
            speed.push([first.time_s, 0.0]);
            joints.iter_mut().for_each(|joint| joint.push([first.time_s, 0.0]));
        }
        let orifice = |m: &Moment| Player::orifice(&player.frame_of(m.time_s, m.q.to_vec()));
        let places: Vec<Point> = leg.moments.iter().map(orifice).collect();
        for (k, pair) in leg.moments.windows(2).enumerate() {
            let dt_s = pair[1].time_s - pair[0].time_s;
            if !(dt_s > 0.0) {
                continue;
            }
            let [from, to] = [places[k], places[k + 1]];
            let middle_s = 0.5 * (pair[0].time_s + pair[1].time_s);
            speed.push([middle_s, (to - from).norm() / dt_s]);
            for (index, joint) in film.joints.iter().enumerate() {
                let turned = (pair[1].q[index] - pair[0].q[index]).abs();
                joints[index].push([middle_s, turned / dt_s / joint.speed]);
            }
        }
        if let Some(last) = leg.moments.last() {
            speed.push([last.time_s, 0.0]);
            joints.iter_mut().for_each(|joint| joint.push([last.time_s, 0.0]));
        }
    }
    let limit = preflight.job().limits.joint_speed_share;
    let joints = joints.into_iter().enumerate().map(|(index, points)| Trace {
        of: TraceOf::Joint(index),
        points,
        steps: false,
        limit: Some(limit),
    });
    let speed = Trace { of: TraceOf::Speed, points: speed, steps: false, limit: None };
    std::iter::once(speed).chain(joints).collect()
}

/// A column of ageing where the newest strand begins, until the next one begins.
fn newest(film: &Film, pick: fn(&super::Ageing) -> &Vec<f64>) -> Vec<[f64; 2]> {
    let mut points = Vec::new();
    for (order, strand) in film.strands.iter().enumerate() {
        let Some(born_s) = strand.born_s() else { continue };
        let next = film.strands.get(order + 1).and_then(super::FilmStrand::born_s);
        let until_s = next.unwrap_or(film.total_s).max(born_s);
        for k in 0..AGES {
            let age_s = (until_s - born_s) * (k as f64 / AGES as f64).powi(2);
            if let Some(value) = strand.ageing.at(pick(&strand.ageing), age_s) {
                points.push([born_s + age_s, value]);
            }
        }
    }
    points
}
