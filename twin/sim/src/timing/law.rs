//! The law of a whole path, put together from rest to rest.

use crate::kinematics::Posture;

use super::course::{Course, Rounding, Section};
use super::grid::Grid;
use super::limits::{Bounds, Limits};
use super::measure::{self, Bound, Loads, Peaks};
use super::profile::Profile;
use super::smooth::{self, Shares};
use super::{Fault, Station};

/// Rounds of slowing single cells before the rest is scaled.
const ROUNDS: usize = 6;
/// Excess that is left to scaling.
const EXCESS: f64 = 1e-5;
/// Excess that is rounding.
const ROUNDING: f64 = 1e-10;

/// When the arm passes a station, and what limits it from there to the next.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Passing {
    /// Time from the start, s; where it rests, of its arrival.
    pub time_s: f64,
    /// ds/dt there, m/s.
    pub speed: f64,
    /// The bound that comes nearest to its limit until the next station.
    pub bound: Bound,
    /// How near: the largest share of that limit.
    pub share: f64,
}

/// The motion at one instant.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct State {
    /// Path parameter, m, and its derivatives by time, m/s, m/s², m/s³.
    pub path: [f64; 4],
    /// Joint values, rad or m.
    pub q: Posture,
    /// Joint speeds.
    pub speed: Posture,
    /// Joint accelerations.
    pub acceleration: Posture,
    /// Joint jerks, inside the steps of the law; at its joints there may be a jump.
    pub jerk: Posture,
}

/// A time law along a path.
#[derive(Debug, Clone)]
pub struct Law {
    /// One per station.
    pub passings: Vec<Passing>,
    /// Length of the motion, s.
    pub duration_s: f64,
    /// Largest values.
    pub peaks: Peaks,
    /// Joints whose acceleration limit is not known.
    pub acceleration_unknown: Vec<usize>,
    /// Joints whose jerk limit is not known.
    pub jerk_unknown: Vec<usize>,
    /// Corners that are rounded, in order.
    pub roundings: Vec<Rounding>,
    pub(super) course: Course,
    pub(super) profile: Profile,
}

/// The fastest law found that starts and ends at rest and keeps all limits.
///
/// Without jerk limits it is time-optimal but for the cells it is computed in; with them, the
/// shortest of its family of S-curves. Checked along the whole law: no limit is exceeded.
pub fn time_law(stations: &[Station], limits: &Limits) -> Result<Law, Fault> {
    let bounds = Bounds::new(limits, true)?;
    let course = Course::new(stations, bounds.dof, limits.blend_m)?;
    let mut profile = Profile::rest(course.ends().0);
    for section in &course.sections {
        profile.append(&from_rest_to_rest(&course, *section, &bounds)?);
    }
    Ok(Law::new(stations, course, profile, &bounds))
}

fn from_rest_to_rest(course: &Course, section: Section, bounds: &Bounds) -> Result<Profile, Fault> {
    let pieces = &course.pieces[section.first..section.end];
    let Some(first) = pieces.first() else { return Ok(Profile::rest(course.ends().0)) };
    let stuck = Fault::Stuck { s: first.from };
    let mut grid = Grid::new(course, section, bounds, &[])?;
    let mut shares = Shares::all(grid.cells.len());
    let mut window_s = 0.0;
    let idle = vec![0.0; grid.cells.len()];
    let free = smooth::base(&grid, bounds, &shares, 0.0, &idle);
    let free = Profile::from_phase(&free).ok_or(stuck)?;
    let mut speeds = smooth::speeds(&grid, &free);
    if bounds.jerk_known() {
        window_s = smooth::window(&grid, bounds, &shares, &speeds);
        let cuts = smooth::cuts(pieces, window_s);
        if !cuts.is_empty() {
            grid = Grid::new(course, section, bounds, &cuts)?;
            shares = Shares::all(grid.cells.len());
            speeds = smooth::speeds(&grid, &free);
        }
    }
    let mut best: Option<Profile> = None;
    for _ in 0..ROUNDS {
        let points = smooth::base(&grid, bounds, &shares, window_s, &speeds);
        let base = Profile::from_phase(&points).ok_or(stuck)?;
        let places = grid.nodes.iter().map(|node| node.s);
        let mut law =
            if window_s > 0.0 { base.smoothed(window_s).cut_at(places) } else { base.clone() };
        let stretch = ease(course, bounds, &grid, &base, &law, window_s, &mut shares);
        law.slow_down(stretch.max(1.0));
        speeds = smooth::speeds(&grid, &law);
        if best.as_ref().is_none_or(|best| law.duration() < best.duration()) {
            best = Some(law);
        }
        if stretch < 1.0 + EXCESS {
            break;
        }
    }
    let mut best = best.ok_or(stuck)?;
    let stretch = |(step, dt)| {
        let (loads, ceiling) = measure::within::<{ measure::CERTAIN }>(course, bounds, &step, dt);
        loads.stretch(ceiling, bounds)
    };
    let worst = measure::steps(&best).map(stretch).fold(0.0, f64::max);
    if worst > 1.0 + ROUNDING {
        best.slow_down(worst);
    }
    Ok(best)
}

/// Lowers the shares of the cells that make `smoothed` exceed a limit; returns by how much it would
/// have to be slowed down as it is.
fn ease(
    course: &Course,
    bounds: &Bounds,
    grid: &Grid,
    base: &Profile,
    smoothed: &Profile,
    window_s: f64,
    shares: &mut Shares,
) -> f64 {
    let n = grid.cells.len();
    let mut excess = Shares::all(n);
    let mut worst = 0.0_f64;
    for (step, dt) in measure::steps(smoothed) {
        let (loads, ceiling) = measure::within::<3>(course, bounds, &step, dt);
        let stretch = loads.stretch(ceiling, bounds);
        worst = worst.max(stretch);
        if stretch < 1.0 + EXCESS {
            continue;
        }
        let (from, to) = if window_s > 0.0 {
            (base.at(step.t - window_s).s, base.at(step.t + dt).s)
        } else {
            (step.s, step.later(dt).s)
        };
        let first = grid.nodes.partition_point(|node| node.s <= from).max(1) - 1;
        let end = grid.nodes.partition_point(|node| node.s < to).clamp(first + 1, n);
        for (_, power, share) in loads.shares(ceiling, bounds).filter(|(_, _, share)| *share > 1.0)
        {
            let rows = match power {
                1 => &mut excess.slow,
                2 => &mut excess.soft,
                _ => &mut excess.gentle,
            };
            for cell in &mut rows[first.min(n - 1)..end] {
                *cell = cell.max(share);
            }
        }
    }
    let divide = |own: &mut [f64], by: &[f64]| {
        own.iter_mut().zip(by).for_each(|(own, by)| *own /= by.min(2.0));
    };
    divide(&mut shares.slow, &excess.slow);
    divide(&mut shares.soft, &excess.soft);
    divide(&mut shares.gentle, &excess.gentle);
    worst
}

impl Law {
    pub(super) fn new(
        stations: &[Station],
        course: Course,
        profile: Profile,
        bounds: &Bounds,
    ) -> Self {
        let times: Vec<f64> = stations.iter().map(|station| profile.time_of(station.s)).collect();
        Self::with_times(&times, course, profile, bounds)
    }

    /// `times` of the stations, s, that do not fall.
    pub(super) fn with_times(
        times: &[f64],
        course: Course,
        profile: Profile,
        bounds: &Bounds,
    ) -> Self {
        let mut all = Loads::NONE;
        let mut tightest = vec![(Bound::Ceiling, 0.0); times.len()];
        let mut station = 0;
        for (step, dt) in measure::steps(&profile).filter(|_| !course.pieces.is_empty()) {
            let (loads, ceiling) = measure::within::<5>(&course, bounds, &step, dt);
            all.raise(&loads);
            let middle = step.t + dt / 2.0;
            while times.get(station + 1).is_some_and(|time| *time <= middle) {
                station += 1;
            }
            let own = loads.tightest(ceiling, bounds);
            if own.1 > tightest[station].1 {
                tightest[station] = own;
            }
        }
        let passing = |(&time_s, &(bound, share)): (&f64, &(Bound, f64))| Passing {
            time_s,
            speed: profile.at(time_s).v,
            bound,
            share,
        };
        let unknown = |row: &[f64]| {
            (0..bounds.dof).filter(|joint| row[*joint].is_infinite()).collect::<Vec<usize>>()
        };
        Self {
            passings: times.iter().zip(&tightest).map(passing).collect(),
            duration_s: profile.duration(),
            peaks: all.peaks(bounds),
            acceleration_unknown: unknown(&bounds.acceleration),
            jerk_unknown: unknown(&bounds.jerk),
            roundings: course.roundings.clone(),
            course,
            profile,
        }
    }

    /// The motion at `time_s` after the start; at rest before it and after the end.
    pub fn at(&self, time_s: f64) -> State {
        let step = self.profile.at(time_s);
        let jet = self.course.at(step.s);
        let (v, a, j) = (step.v, step.a, step.j);
        let (mut q, mut speed) = (Posture::zeros(self.course.dof), Posture::zeros(self.course.dof));
        let (mut acceleration, mut jerk) = (q, q);
        for joint in 0..self.course.dof {
            let (d1, d2, d3) = (jet.d1[joint], jet.d2[joint], jet.d3[joint]);
            q[joint] = jet.q[joint];
            speed[joint] = d1 * v;
            acceleration[joint] = d1 * a + d2 * v * v;
            jerk[joint] = d1 * j + 3.0 * d2 * v * a + d3 * v * v * v;
        }
        State { path: [step.s, v, a, j], q, speed, acceleration, jerk }
    }

    /// When the place `s` of the path is reached first, s.
    pub fn time_at(&self, s: f64) -> f64 {
        self.profile.time_of(s)
    }

    /// Instants at which the motion changes: between two of them ds/dt is a polynomial of time, s.
    pub fn instants(&self) -> impl Iterator<Item = f64> {
        self.profile.steps.iter().map(|step| step.t)
    }
}
