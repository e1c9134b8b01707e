//! The spin map of a strand: path position against spin (or tilt, or elbow angle), and what fails
//! where. A programmer picks an orientation from it: a way from left to right that stays clear.
//!
//! Every place of the map is judged on its own, in the branch the chosen path has: a print cannot
//! change its branch on the way. What is not varied stays as in the chosen path.
//!
//! O(columns · rows) inverse solutions and clearance queries, columns in parallel.

use std::collections::BTreeMap;
use std::f64::consts::{PI, TAU};

use nalgebra::{Unit, UnitQuaternion};
use rayon::prelude::*;

use super::{Leg, Motion, between, solve};
use crate::cell::Job;
use crate::clearance::{Bodies, Space, Touch};
use crate::deposit::{Contact, Deposit};
use crate::finding::Phase;
use crate::kinematics::{Arm, Branch, Posture, Solution, limit_margins, nearness};
use crate::pose::Vector;
use crate::toolpath::{Path, Sample};

/// What is varied across the path.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Across {
    /// Rotation about the nozzle's axis, from the bed's x.
    Spin,
    /// Lean of the nozzle against the direction of travel, from where it is planned; positive trails.
    Tilt,
    /// Turn of the elbow about the line shoulder to wrist, of a seven-joint arm.
    Elbow,
}

/// What a place of the map comes to; the first that fails, cheapest question first.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum MapState {
    /// Nothing fails.
    Clear,
    /// Nothing fails, but the condition number is past the one that warns.
    NearSingular,
    /// No posture of this branch puts the nozzle there.
    Unreached,
    /// A joint past its stop, or nearer to it than the limit.
    Stop,
    /// The condition number is past the one that stops.
    Singular,
    /// A joint turns faster than it may between this place and the next of its row.
    Fast,
    /// Two bodies nearer than the limit: the pair of this index.
    Hits(usize),
}

/// The map of one strand.
#[derive(Debug, Clone, PartialEq)]
pub struct SpinMap {
    /// The strand, as index in the job.
    pub strand: usize,
    /// What its rows are.
    pub across: Across,
    /// Arc length of the columns, m.
    pub at_m: Vec<f64>,
    /// Angle of the rows, rad, ascending.
    pub angles_rad: Vec<f64>,
    /// State of row `r`, column `c` at `r · columns + c`.
    pub states: Vec<MapState>,
    /// The chosen path: arc length, m, and angle, rad.
    pub chosen: Vec<(f64, f64)>,
    /// Pairs of bodies that come too near, by [`MapState::Hits`].
    pub pairs: Vec<[String; 2]>,
    /// The branch of the chosen path.
    pub branch: Branch,
}

/// Largest number of columns.
const COLUMNS: usize = 120;
/// Rows of a full turn; of a tilt, from −[`TILT_RAD`] to it.
const ROWS: usize = 72;
const TILT_ROWS: usize = 49;
const TILT_RAD: f64 = PI / 3.0;

/// What a map is drawn from.
#[derive(Clone, Copy)]
pub struct MapOf<'a> {
    /// The job.
    pub job: &'a Job,
    /// Its strands by arc length.
    pub paths: &'a [Path],
    /// The motion, with the chosen path.
    pub motion: &'a Motion,
    /// What is printed.
    pub deposit: &'a Deposit,
    /// Where beads touch.
    pub contacts: &'a [Contact],
}

/// The map of a strand of the job; `None` where no posture along it is known, or the arm has no
/// such freedom.
pub fn spin_map(of: &MapOf<'_>, strand: usize, across: Across) -> Option<SpinMap> {
    let MapOf { job, paths, motion, deposit, contacts } = *of;
    let arm = &job.cell.robot.arm;
    let is_print = |leg: &&Leg| leg.phase == Phase::Print && leg.strand == Some(strand);
    let leg = motion.legs.iter().find(is_print)?;
    let first = leg.moments.first()?;
    if across == Across::Elbow && arm.elbow_angle(&first.q).is_none() {
        return None;
    }
    let order = deposit.strands.iter().position(|printed| printed.strand == strand)?;
    let bodies = Bodies::new(job);
    let mapper = Mapper {
        job,
        path: paths.get(strand)?,
        leg,
        across,
        angles_rad: rows(across),
        open: arm.without_limits(),
        branch: arm.branch(&first.q),
        space: Space::new(job, &bodies, deposit),
        touch: Touch::strand(job, deposit, order, contacts, true),
    };
    let columns = mapper.columns();
    let found: Vec<Vec<Place>> = columns.par_iter().map(|&k| mapper.column(k)).collect();
    let chosen = leg.moments.iter().map(|moment| mapper.chosen(moment.at_m, &moment.q)).collect();
    let (states, pairs) = mapper.states(&columns, &found);
    Some(SpinMap {
        strand,
        across,
        at_m: columns.iter().map(|&k| mapper.path.samples[k].at_m).collect(),
        states,
        chosen,
        pairs,
        branch: mapper.branch,
        angles_rad: mapper.angles_rad,
    })
}

fn rows(across: Across) -> Vec<f64> {
    match across {
        Across::Tilt => {
            let step = 2.0 * TILT_RAD / (TILT_ROWS - 1) as f64;
            (0..TILT_ROWS).map(|k| step * k as f64 - TILT_RAD).collect()
        }
        Across::Spin | Across::Elbow => {
            (0..ROWS).map(|k| TAU * k as f64 / ROWS as f64 - PI).collect()
        }
    }
}

/// A place of the map before its row is known.
#[derive(Debug, Clone)]
struct Place {
    q: Option<Posture>,
    found: Found,
}

#[derive(Debug, Clone)]
enum Found {
    Clear,
    NearSingular,
    Unreached,
    Stop,
    Singular,
    Hits([String; 2]),
}

struct Mapper<'a> {
    job: &'a Job,
    path: &'a Path,
    leg: &'a Leg,
    across: Across,
    angles_rad: Vec<f64>,
    open: Arm,
    branch: Branch,
    space: Space<'a>,
    touch: Touch,
}

impl Mapper<'_> {
    /// Samples that become columns: all, or evenly many of them.
    fn columns(&self) -> Vec<usize> {
        let samples = &self.path.samples;
        let n = samples.iter().take_while(|s| s.at_m <= self.path.length_m + 1e-12).count().max(1);
        let n_columns = n.min(COLUMNS);
        (0..n_columns).map(|c| c * (n - 1) / n_columns.saturating_sub(1).max(1)).collect()
    }

    /// The chosen posture nearest to a sample.
    fn posture_at(&self, at_m: f64) -> Posture {
        let moments = &self.leg.moments;
        let k = moments.partition_point(|moment| moment.at_m < at_m - 1e-12);
        moments[k.min(moments.len() - 1)].q
    }

    fn column(&self, sample: usize) -> Vec<Place> {
        let sample = &self.path.samples[sample];
        let chosen = self.posture_at(sample.at_m);
        let (spin_rad, elbow_rad) = self.freedoms(sample, &chosen);
        let mut solutions = Vec::new();
        self.angles_rad
            .iter()
            .map(|&angle| {
                let (nozzle, spin_rad, elbow_rad) = match self.across {
                    Across::Spin => (sample.nozzle, angle, elbow_rad),
                    Across::Elbow => (sample.nozzle, spin_rad, angle),
                    Across::Tilt => (self.leant(sample, angle), spin_rad, elbow_rad),
                };
                self.place(sample, nozzle, [spin_rad, elbow_rad], &chosen, &mut solutions)
            })
            .collect()
    }

    /// Spin and elbow angle of the chosen posture.
    fn freedoms(&self, sample: &Sample, q: &Posture) -> (f64, f64) {
        let spin_rad = between::spin_of(self.job, sample.point, sample.nozzle, q);
        (spin_rad, self.job.cell.robot.arm.elbow_angle(q).unwrap_or(0.0))
    }

    /// The nozzle's axis leant by an angle in the plane of travel.
    fn leant(&self, sample: &Sample, angle_rad: f64) -> Vector {
        let across = sample.nozzle.cross(&sample.tangent);
        let across = if across.norm() > 1e-6 {
            across
        } else {
            // The nozzle looks along the strand: lean about the bed's x.
            self.job.bed_from_part.inverse_transform_vector(&Vector::x())
        };
        UnitQuaternion::from_axis_angle(&Unit::new_normalize(across), angle_rad) * sample.nozzle
    }

    fn place(
        &self,
        sample: &Sample,
        nozzle: Vector,
        [spin_rad, elbow_rad]: [f64; 2],
        chosen: &Posture,
        solutions: &mut Vec<Solution>,
    ) -> Place {
        let arm = &self.job.cell.robot.arm;
        let nearest = |solutions: &[Solution]| {
            let of_branch = solutions.iter().filter(|s| s.branch == self.branch);
            of_branch
                .map(|solution| solution.q)
                .min_by(|a, b| a.distance(chosen).total_cmp(&b.distance(chosen)))
        };
        solutions.clear();
        solve(self.job, sample.point, nozzle, spin_rad, elbow_rad, Some(chosen), solutions);
        let Some(q) = nearest(solutions) else {
            solutions.clear();
            super::solve_with(
                &self.open,
                self.job,
                sample.point,
                nozzle,
                [spin_rad, elbow_rad],
                Some(chosen),
                solutions,
            );
            let found = if nearest(solutions).is_some() { Found::Stop } else { Found::Unreached };
            return Place { q: None, found };
        };
        let limits = &self.job.limits;
        let margin = limit_margins(&arm.chain, &q).iter().fold(f64::INFINITY, |a, &b| a.min(b));
        let condition = nearness(arm, &q).condition;
        let [warns, stops] = limits.condition_number;
        let found = if margin < limits.joint_margin_rad {
            Found::Stop
        } else if condition > stops {
            Found::Singular
        } else {
            self.hit(&q).map_or(
                if condition > warns { Found::NearSingular } else { Found::Clear },
                Found::Hits,
            )
        };
        Place { q: Some(q), found }
    }

    /// The pair of bodies nearer than the limit in a posture.
    fn hit(&self, q: &Posture) -> Option<[String; 2]> {
        let limit_m = self.job.limits.clearance_m;
        let nearest = self.space.posture(q, self.leg.printed, &self.touch, limit_m);
        let (thing, other) = nearest.pair.filter(|_| nearest.clearance_m < limit_m)?;
        let body = &self.space.things[thing].body.name;
        Some([body.clone(), self.space.name(other).to_owned()])
    }

    fn chosen(&self, at_m: f64, q: &Posture) -> (f64, f64) {
        let samples = &self.path.samples;
        let k = samples.partition_point(|sample| sample.at_m < at_m - 1e-12);
        let sample = &samples[k.min(samples.len() - 1)];
        let (spin_rad, elbow_rad) = self.freedoms(sample, q);
        let angle = match self.across {
            Across::Spin => spin_rad,
            Across::Elbow => elbow_rad,
            Across::Tilt => {
                let (_, nozzle) = between::nozzle_at(self.job, q);
                let across = sample.nozzle.cross(&sample.tangent);
                let turn = sample.nozzle.cross(&nozzle).dot(&across.normalize());
                if across.norm() > 1e-6 { turn.clamp(-1.0, 1.0).asin() } else { 0.0 }
            }
        };
        (at_m, (angle + PI).rem_euclid(TAU) - PI)
    }

    /// States by row and column, with joint speeds along the rows.
    fn states(&self, columns: &[usize], found: &[Vec<Place>]) -> (Vec<MapState>, Vec<[String; 2]>) {
        let mut index_of: BTreeMap<[String; 2], usize> = BTreeMap::new();
        let mut states = Vec::with_capacity(self.angles_rad.len() * columns.len());
        for row in 0..self.angles_rad.len() {
            for (column, places) in found.iter().enumerate() {
                let here = &places[row];
                let next = found.get(column + 1).map(|places| &places[row]);
                let fast = next.is_some_and(|next| {
                    let ends = [column, column + 1].map(|c| &self.path.samples[columns[c]]);
                    here.q.zip(next.q).is_some_and(|(a, b)| self.too_fast(ends, &a, &b))
                });
                states.push(match &here.found {
                    Found::Unreached => MapState::Unreached,
                    Found::Stop => MapState::Stop,
                    Found::Singular => MapState::Singular,
                    Found::Hits(pair) => {
                        let n_pairs = index_of.len();
                        MapState::Hits(*index_of.entry(pair.clone()).or_insert(n_pairs))
                    }
                    Found::Clear | Found::NearSingular if fast => MapState::Fast,
                    Found::NearSingular => MapState::NearSingular,
                    Found::Clear => MapState::Clear,
                });
            }
        }
        let mut pairs: Vec<_> = index_of.into_iter().collect();
        pairs.sort_by_key(|(_, index)| *index);
        (states, pairs.into_iter().map(|(pair, _)| pair).collect())
    }

    fn too_fast(&self, [from, to]: [&Sample; 2], a: &Posture, b: &Posture) -> bool {
        let dt_s = (to.at_m - from.at_m) / from.speed_m_s;
        let axes = self.job.cell.robot.arm.chain.axes();
        let share = |(axis, (a, b)): (&crate::kinematics::ChainAxis, (&f64, &f64))| {
            (b - a).abs() / dt_s / axis.velocity
        };
        let shares = axes.iter().zip(a.iter().zip(b.iter())).map(share);
        dt_s > 0.0 && shares.fold(0.0, f64::max) > self.job.limits.joint_speed_share
    }
}
