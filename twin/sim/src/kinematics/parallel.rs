//! Six joints with three parallel axes and an offset wrist, as Universal Robots builds them.
//!
//! Canonical arm:
//! `Rz(θ1) T(a1, b, c1) Ry(θ2) T(0, 0, c2) Ry(θ3) T(0, 0, c3) Ry(θ4) Rz(θ5) T(0, 0, c4) Ry(θ6)`.
//! The plane of the arm fixes θ1, the rotation then θ2 + θ3 + θ4, θ5 and θ6, and what is left are
//! two links in a plane (compare Hawkins, *Analytic Inverse Kinematics for the Universal Robots
//! UR-5/UR-10 Arms*, 2013).

use std::f64::consts::FRAC_PI_2;

use nalgebra::Matrix3;

use super::branch::Branch;
use super::canonical::{JointMap, axes_pose, seed_theta, sign, turn_y};
use super::gate::{Gate, TipError};
use super::lines::{Line, TOLERANCE};
use super::mount::{About, Mount, Step, forward};
use super::planar::{links_meet, swing, swings_meet, two_links};
use super::singularity::from_line;
use super::turns::Turns;
use super::wrist::{Zyz, zyz};
use crate::pose::{Pose, Vector};

/// What is left once axes 1, 5 and 6 are set: meeting point of axes 5 and 6 in the plane of the arm, m,
/// sum of the three angles in it, rad, and the errors so far, m and rad.
struct Plane {
    forward: f64,
    z: f64,
    sum: f64,
    off: f64,
    error_rad: f64,
}

/// Lengths of the canonical arm, m.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ParallelParameters {
    /// Axis 1 to axis 2, forwards.
    pub a1: f64,
    /// Meeting point of axes 4 and 5 beside axis 1.
    pub b: f64,
    /// Height of axis 2 over the foot of the base's origin on axis 1.
    pub c1: f64,
    /// Axis 2 to axis 3.
    pub c2: f64,
    /// Axis 3 to axis 4.
    pub c3: f64,
    /// Axis 4 to axis 6, along axis 5.
    pub c4: f64,
}

/// A recognised arm.
#[derive(Debug, Clone, PartialEq)]
pub struct Parallel {
    /// Lengths.
    pub parameters: ParallelParameters,
    /// Joint values to canonical angles.
    pub maps: [JointMap; 6],
    mount: Mount,
}

impl ParallelParameters {
    fn steps(&self) -> [Step; 6] {
        let along = |length: f64| Vector::new(0.0, 0.0, length);
        [
            (About::Z, Vector::new(self.a1, self.b, self.c1)),
            (About::Y, along(self.c2)),
            (About::Y, along(self.c3)),
            (About::Y, Vector::zeros()),
            (About::Z, along(self.c4)),
            (About::Y, Vector::zeros()),
        ]
    }
}

impl Parallel {
    /// Fits the canonical arm to six axes; `None` where they are of another kind.
    pub(super) fn fit(lines: &[Line], tip: &Pose) -> Option<Self> {
        let [l1, l2, l3, l4, l5, l6] = lines else { return None };
        let shaped = l1.perpendicular(l2)
            && l2.parallel(l3)
            && l3.parallel(l4)
            && l4.perpendicular(l5)
            && l5.perpendicular(l6);
        if !shaped {
            return None;
        }
        let (wrist, hand) = (l4.meets(l5)?, l5.meets(l6)?);
        let (across, up) = (l2.direction, l1.direction);
        let foot = l1.foot(&Vector::zeros());
        let base = axes_pose(&foot, &across, &up);
        let local = |v: Vector| base.rotation.inverse() * v;

        let shoulder = local(l2.point - foot);
        let upper = local(l3.point - l2.point);
        let lower = local(wrist - l3.point);
        let sign5 = sign(&l5.direction, &(hand - wrist));
        let along5 = local(l5.direction) * sign5;
        let p = ParallelParameters {
            a1: shoulder.x,
            b: local(wrist - foot).y,
            c1: shoulder.z,
            c2: upper.x.hypot(upper.z),
            c3: lower.x.hypot(lower.z),
            c4: (hand - wrist).norm(),
        };
        if p.c2 < TOLERANCE || p.c3 < TOLERANCE {
            return None;
        }
        let theta2 = upper.x.atan2(upper.z);
        let theta23 = lower.x.atan2(lower.z);
        let theta234 = along5.x.atan2(along5.z);
        let along6 = (turn_y(theta234)).rotation.inverse() * local(l6.direction);
        let theta5 = (-along6.x).atan2(along6.y);
        let signs =
            [1.0, 1.0, sign(&across, &l3.direction), sign(&across, &l4.direction), sign5, 1.0];
        let theta = [0.0, theta2, theta23 - theta2, theta234 - theta23, theta5, 0.0];
        let tool = (base * forward(&p.steps(), &theta)).inverse() * tip;
        let mut maps = [JointMap { sign: 1.0, zero_rad: 0.0 }; 6];
        for (map, (sign, zero_rad)) in maps.iter_mut().zip(signs.into_iter().zip(theta)) {
            *map = JointMap { sign, zero_rad };
        }
        let mount = Mount::new((&base, &tool), &p.steps(), &maps, lines, tip);
        Some(Self { parameters: p, maps, mount })
    }

    /// Whether the closed form is the chain to rounding.
    pub(super) fn exact(&self) -> bool {
        self.mount.exact()
    }

    /// Every posture that puts the tip on the target.
    pub(super) fn candidates(&self, gate: &mut Gate) {
        let p = &self.parameters;
        let hand = self.mount.flange(gate.target);
        let rotation = hand.rotation.to_rotation_matrix().into_inner();
        let at = hand.translation.vector;
        let free = |index| seed_theta(&self.maps, gate.options.seed, index);
        let (free1, free_sum) = (free(0), free(1) + free(2) + free(3));
        let swings = swing(at.x, at.y, p.b, free1, gate.play);
        for (behind, (theta1, forward)) in swings.into_iter().flatten().enumerate() {
            let Some(turns1) = gate.turns(0, &self.maps[0], theta1.rad) else { continue };
            gate.close |= swings_meet(forward);
            let side = theta1.cos * at.y - theta1.sin * at.x - p.b;
            let ahead = theta1.cos * at.x + theta1.sin * at.y - forward;
            let off = side.hypot(ahead);
            let turned = yzy(&theta1.unturn_z(&rotation), free_sum);
            for (flip, [sum, theta5, theta6]) in turned.angles.into_iter().enumerate() {
                let Some(turns5) = gate.turns(4, &self.maps[4], theta5) else { continue };
                let Some(turns6) = gate.turns(5, &self.maps[5], theta6) else { continue };
                let branch = Branch { shoulder: behind == 1, elbow: false, wrist: flip == 1 };
                let plane = Plane { forward, z: at.z, sum, off, error_rad: turned.error_rad };
                self.bend_elbow(gate, [turns1, turns5, turns6], branch, &plane);
            }
        }
    }

    /// The two elbows that bring the end of the forearm where hand and sum of angles ask for it.
    fn bend_elbow(
        &self,
        gate: &mut Gate,
        [turns1, turns5, turns6]: [Turns; 3],
        branch: Branch,
        plane: &Plane,
    ) {
        let p = &self.parameters;
        let (sin, cos) = plane.sum.sin_cos();
        let (x, z) = (plane.forward - p.a1 - p.c4 * sin, plane.z - p.c1 - p.c4 * cos);
        let links = two_links(x, z, p.c2, p.c3, gate.play);
        for (below, (theta2, bend)) in links.into_iter().flatten().enumerate() {
            gate.close |= links_meet(&bend);
            let theta4 = plane.sum - theta2.rad - bend.rad;
            let Some(turns2) = gate.turns(1, &self.maps[1], theta2.rad) else { continue };
            let Some(turns3) = gate.turns(2, &self.maps[2], bend.rad) else { continue };
            let Some(turns4) = gate.turns(3, &self.maps[3], theta4) else { continue };
            let fore = theta2.plus(&bend);
            let miss_x = p.c2 * theta2.sin + p.c3 * fore.sin - x;
            let miss_z = p.c2 * theta2.cos + p.c3 * fore.cos - z;
            let error = TipError {
                m: plane.off
                    + miss_x.hypot(miss_z)
                    + plane.error_rad * self.mount.tool_m
                    + self.mount.misfit_m,
                rad: plane.error_rad + self.mount.misfit_rad,
            };
            let turns = [turns1, turns2, turns3, turns4, turns5, turns6];
            gate.keep(&turns, Branch { elbow: below == 1, ..branch }, error);
        }
    }

    fn thetas(&self, q: &[f64]) -> [f64; 6] {
        std::array::from_fn(|index| self.maps[index].theta(q[index]))
    }

    /// Meeting point of axes 5 and 6 in front of axis 1, in the plane of the arm, m.
    fn forward_m(&self, theta: &[f64; 6]) -> f64 {
        let p = &self.parameters;
        let (two, three) = (theta[1], theta[1] + theta[2]);
        p.a1 + p.c2 * two.sin() + p.c3 * three.sin() + p.c4 * (three + theta[3]).sin()
    }

    /// Branch of a posture.
    pub fn branch(&self, q: &[f64]) -> Branch {
        let theta = self.thetas(q);
        Branch {
            shoulder: self.forward_m(&theta) < 0.0,
            elbow: theta[2].sin() < 0.0,
            wrist: theta[4].sin() < 0.0,
        }
    }

    /// Angles of axis 5 and of the elbow from where the arm is singular, rad, and how far the meeting
    /// point of axes 5 and 6 is from the cylinder about axis 1 that it cannot enter, m.
    pub(super) fn distances(&self, q: &[f64]) -> (f64, f64, f64) {
        let theta = self.thetas(q);
        (from_line(theta[4]), from_line(theta[2]), self.forward_m(&theta).abs())
    }
}

/// Solves `Ry(a) Rz(b) Ry(c) = m`, by renaming the axes y, z, x to z, x, y and
/// `Rx(b) = Rz(−π/2) Ry(b) Rz(π/2)`.
fn yzy(m: &Matrix3<f64>, free: f64) -> Zyz {
    const OLD: [usize; 3] = [2, 0, 1];
    let renamed = Matrix3::from_fn(|row, column| m[(OLD[row], OLD[column])]);
    // The second of two turned solutions is the first with `a + π`: sign of `b` as in `zyz`.
    let turned = zyz(&renamed, free - FRAC_PI_2);
    let angles = turned.angles.map(|[a, b, c]| [a + FRAC_PI_2, b, c - FRAC_PI_2]);
    Zyz { angles, ..turned }
}
