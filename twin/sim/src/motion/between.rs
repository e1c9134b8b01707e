//! Moves without extrusion: straight approach and retract, transit over the deposit.

use super::{Moment, Planner, bed_from_tool, strand};
use crate::finding::Phase;
use crate::kinematics::Posture;
use crate::pose::{Point, Vector};
use crate::toolpath::Sample;

/// Room kept above the deposit in transit, m.
const LIFT_M: f64 = 20e-3;

/// Largest step of a straight move, m, and of a joint move, rad.
const STRAIGHT_STEP_M: f64 = 5e-3;
const JOINT_STEP_RAD: f64 = 0.05;

impl Planner<'_> {
    /// Postures backwards along the nozzle's axis from `at`, nearest first, without `at` itself.
    /// Ends where reach ends.
    pub(super) fn straight(&self, at: &Sample, q: &Posture, length_m: f64) -> Vec<Posture> {
        self.line(at.point, at.nozzle, -at.nozzle, q, length_m)
    }

    /// Postures along a straight line of the nozzle, orientation kept.
    fn line(
        &self,
        from: Point,
        nozzle: Vector,
        along: Vector,
        q: &Posture,
        length_m: f64,
    ) -> Vec<Posture> {
        let n_steps = (length_m / STRAIGHT_STEP_M).ceil() as usize;
        let spin_rad = self.spin_of(from, nozzle, q);
        let elbow_rad = self.arm.elbow_angle(q).unwrap_or(0.0);
        let mut before = *q;
        let mut postures = Vec::with_capacity(n_steps);
        let mut solutions = Vec::new();
        for k in 1..=n_steps {
            let point = from + along * (length_m * k as f64 / n_steps as f64);
            solutions.clear();
            super::solve(
                self.job,
                point,
                nozzle,
                spin_rad,
                elbow_rad,
                Some(&before),
                &mut solutions,
            );
            match strand::nearest(&solutions, &before) {
                Some(next) if next.distance(&before) < 0.5 => before = next,
                _ => break,
            }
            postures.push(before);
        }
        postures
    }

    /// Spin of the tool about its axis in posture `q`.
    fn spin_of(&self, point: Point, nozzle: Vector, q: &Posture) -> f64 {
        let world_from_tip = self.arm.chain.forward(q);
        let cell = &self.job.cell;
        let actual =
            cell.world_from_bed(&world_from_tip).inverse() * cell.world_from_tool(&world_from_tip);
        let turned =
            bed_from_tool(self.job, point, nozzle, 0.0).rotation.inverse() * actual.rotation;
        2.0 * turned.k.atan2(turned.w)
    }

    /// Nozzle place and axis in part axes in posture `q`.
    fn nozzle_at(&self, q: &Posture) -> (Point, Vector) {
        let cell = &self.job.cell;
        let world_from_tip = self.arm.chain.forward(q);
        let bed_from_tool =
            cell.world_from_bed(&world_from_tip).inverse() * cell.world_from_tool(&world_from_tip);
        let part_from_tool = self.job.bed_from_part.inverse() * bed_from_tool;
        (part_from_tool * Point::origin(), part_from_tool * Vector::z())
    }

    /// From where the arm is to `target`: up over all that is printed, across, down.
    ///
    /// Where the lift is out of reach the arm goes as far up as it can; `collision` judges what
    /// comes of it.
    pub(super) fn transit(&mut self, strand: usize, target: &Posture) {
        let from = self.at;
        let up_here = self.lift(&from);
        let up_there = self.lift(target);
        let mut way = vec![from];
        way.extend(&up_here);
        let across_to = up_there.last().copied().unwrap_or(*target);
        way.extend(joint_steps(way.last().copied().unwrap_or(from), across_to));
        way.extend(up_there.iter().rev().skip(1));
        if !up_there.is_empty() {
            way.push(*target);
        }
        self.timed(Phase::Transit, Some(strand), way);
    }

    fn lift(&self, q: &Posture) -> Vec<Posture> {
        let (point, nozzle) = self.nozzle_at(q);
        let height_m = (self.job.bed_from_part * point).z;
        let up = self.job.bed_from_part.inverse_transform_vector(&Vector::z());
        let lift_m = self.top_m + LIFT_M - height_m;
        if self.motion.printings.is_empty() || lift_m <= 0.0 {
            return Vec::new();
        }
        self.line(point, nozzle, up, q, lift_m)
    }

    /// A straight move through `postures` at travel speed.
    pub(super) fn cartesian(
        &mut self,
        phase: Phase,
        strand: usize,
        postures: impl IntoIterator<Item = Posture>,
    ) {
        self.timed(phase, Some(strand), postures.into_iter().collect());
    }

    /// A joint path of the job's own.
    pub(super) fn follow(&mut self, rows: &[Vec<f64>]) {
        let mut way = vec![self.at];
        for row in rows {
            let from = way[way.len() - 1];
            way.extend(joint_steps(from, Posture::new(row)));
        }
        self.timed(Phase::Transit, None, way);
    }

    /// Moves through `way` as fast as travel speed of the TCP and the joints' speeds allow.
    fn timed(&mut self, phase: Phase, strand: Option<usize>, way: Vec<Posture>) {
        let axes = self.arm.chain.axes();
        let travel_m_s = self.job.cell.extruder.travel_m_s;
        let mut moments: Vec<Moment> = Vec::with_capacity(way.len());
        let mut place = None;
        for q in way {
            let (point, _) = self.nozzle_at(&q);
            if let (Some(last), Some(last_point)) = (moments.last(), place) {
                let straight: f64 = (point - Point::from(last_point)).norm() / travel_m_s;
                let joints = axes.iter().zip(last.q.iter().zip(q.iter()));
                let joint_s = joints.map(|(axis, (a, b))| (a - b).abs() / axis.velocity);
                self.motion.total_s += joint_s.fold(straight, f64::max);
            }
            place = Some(point.coords);
            moments.push(Moment { time_s: self.motion.total_s, at_m: 0.0, q });
        }
        self.leg(phase, strand, moments, Vec::new());
    }
}

/// Steps of a straight move in joint space, without its start.
fn joint_steps(from: Posture, to: Posture) -> impl Iterator<Item = Posture> {
    let n_steps = (from.distance(&to) / JOINT_STEP_RAD).ceil().max(1.0) as usize;
    (1..=n_steps).map(move |k| {
        let share = k as f64 / n_steps as f64;
        let mut q = from;
        for (value, target) in q.iter_mut().zip(to.iter()) {
            *value += (target - *value) * share;
        }
        q
    })
}
