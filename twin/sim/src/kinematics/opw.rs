//! Six joints: two parallel axes on an upright one, and a wrist whose axes meet (ortho-parallel
//! base with spherical wrist).
//!
//! Canonical arm, as in Brandstötter, Angerer, Hofbaur, *An Analytical Solution of the Inverse
//! Kinematics Problem of Industrial Serial Manipulators with an Ortho-parallel Basis and a
//! Spherical Wrist* (2014):
//! `Rz(θ1) T(a1, b, c1) Ry(θ2) T(0, 0, c2) Ry(θ3) T(a2, 0, 0) Rz(θ4) T(0, 0, c3) Ry(θ5) T(0, 0, c4) Rz(θ6)`.

use nalgebra::Matrix3;

use super::angle::Angle;
use super::branch::Branch;
use super::canonical::{JointMap, axes_pose, seed_theta, sign, turn_y, turn_z};
use super::gate::{Gate, TipError};
use super::lines::{Line, TOLERANCE};
use super::mount::{About, Mount, Step, forward};
use super::planar::{links_meet, swing, swings_meet, two_links};
use super::turns::Turns;
use super::wrist::zyz;
use crate::pose::{Pose, Vector};

/// Lengths of the canonical arm, m. `c1` counts from the foot of the base's origin on axis 1, `c4`
/// to the foot of the tip's origin on axis 6; neither matters to the solution.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct OpwParameters {
    /// Axis 1 to axis 2, forwards.
    pub a1: f64,
    /// Axis 3 to axis 4; negative where axis 4 passes above the elbow of an arm reaching forwards.
    pub a2: f64,
    /// Plane of the arm beside axis 1.
    pub b: f64,
    /// Height of axis 2.
    pub c1: f64,
    /// Axis 2 to axis 3.
    pub c2: f64,
    /// Foot of axis 3 on axis 4 to wrist centre.
    pub c3: f64,
    /// Wrist centre to tip.
    pub c4: f64,
}

/// A recognised arm.
#[derive(Debug, Clone, PartialEq)]
pub struct Opw {
    /// Lengths.
    pub parameters: OpwParameters,
    /// Joint values to canonical angles.
    pub maps: [JointMap; 6],
    mount: Mount,
    /// [`OpwParameters::lead`].
    lead: Angle,
    /// [`OpwParameters::forearm`].
    forearm: f64,
}

impl OpwParameters {
    fn forearm(&self) -> f64 {
        self.a2.hypot(self.c3)
    }

    /// Angle by which the line elbow → wrist centre leads the direction of axis 4.
    fn lead(&self) -> f64 {
        self.a2.atan2(self.c3)
    }

    fn steps(&self) -> [Step; 6] {
        [
            (About::Z, Vector::new(self.a1, self.b, self.c1)),
            (About::Y, Vector::new(0.0, 0.0, self.c2)),
            (About::Y, Vector::new(self.a2, 0.0, 0.0)),
            (About::Z, Vector::new(0.0, 0.0, self.c3)),
            (About::Y, Vector::new(0.0, 0.0, self.c4)),
            (About::Z, Vector::zeros()),
        ]
    }
}

impl Opw {
    /// Fits the canonical arm to six axes; `None` where they are of another kind.
    pub(super) fn fit(lines: &[Line], tip: &Pose) -> Option<Self> {
        let [l1, l2, l3, l4, l5, l6] = lines else { return None };
        let shaped = l1.perpendicular(l2)
            && l2.parallel(l3)
            && l3.perpendicular(l4)
            && l4.perpendicular(l5)
            && l5.perpendicular(l6);
        if !shaped {
            return None;
        }
        let (centre, other) = (l4.meets(l5)?, l5.meets(l6)?);
        if (centre - other).norm() > TOLERANCE {
            return None;
        }
        let foot = l1.foot(&Vector::zeros());
        let (across, up) = directions(lines, &centre, &foot);
        let base = axes_pose(&foot, &across, &up);
        let local = |v: Vector| base.rotation.inverse() * v;

        let shoulder = local(l2.point - foot);
        let upper = local(l3.point - l2.point);
        let lower = local(centre - l3.point);
        let along4 = local(l4.direction * sign(&l4.direction, &(centre - l3.foot(&centre))));
        let (theta2, theta23) = (upper.x.atan2(upper.z), along4.x.atan2(along4.z));
        let (sin, cos) = theta23.sin_cos();
        let forearm_x = Vector::new(cos, 0.0, -sin);
        let mut p = OpwParameters {
            a1: shoulder.x,
            a2: lower.dot(&forearm_x),
            b: local(centre - foot).y,
            c1: shoulder.z,
            c2: upper.x.hypot(upper.z),
            c3: lower.x * sin + lower.z * cos,
            c4: 0.0,
        };
        if p.c2 < TOLERANCE || p.forearm() < TOLERANCE {
            return None;
        }
        let y5 = local(l5.direction);
        let sign5 = if y5.y < -TOLERANCE { -1.0 } else { 1.0 };
        let theta4 = (-sign5 * y5.dot(&forearm_x)).atan2(sign5 * y5.y);
        let wrist = turn_y(theta23) * turn_z(theta4);
        let along6 = wrist.rotation.inverse() * local(l6.direction);
        let reach = l6.direction.dot(&(tip.translation.vector - centre));
        let outwards = if along6.z.abs() > TOLERANCE { along6.z } else { reach };
        let sign6 = if outwards < 0.0 { -1.0 } else { 1.0 };
        p.c4 = sign6 * reach;
        let theta5 = (sign6 * along6.x).atan2(sign6 * along6.z);

        let signs = [
            sign(&up, &l1.direction),
            sign(&across, &l2.direction),
            sign(&across, &l3.direction),
            sign(&along4, &local(l4.direction)),
            sign5,
            sign6,
        ];
        let mut theta = [0.0, theta2, theta23 - theta2, theta4, theta5, 0.0];
        let mut tool = (base * forward(&p.steps(), &theta)).inverse() * tip;
        // A tip that is only turned about axis 6 is the flange itself.
        let turn = tool.rotation.to_rotation_matrix();
        if tool.translation.vector.norm() < TOLERANCE && turn[(2, 2)] > 1.0 - TOLERANCE * TOLERANCE
        {
            theta[5] = turn[(1, 0)].atan2(turn[(0, 0)]);
            tool = turn_z(-theta[5]) * tool;
        }
        let mut maps = [JointMap { sign: 1.0, zero_rad: 0.0 }; 6];
        for (map, (sign, zero_rad)) in maps.iter_mut().zip(signs.into_iter().zip(theta)) {
            *map = JointMap { sign, zero_rad };
        }
        let mount = Mount::new((&base, &tool), &p.steps(), &maps, lines, tip);
        Some(Self { parameters: p, maps, mount, lead: Angle::of(p.lead()), forearm: p.forearm() })
    }

    /// Whether the closed form is the chain to rounding.
    pub(super) fn exact(&self) -> bool {
        self.mount.exact()
    }

    /// Every posture that puts the tip on the target.
    pub(super) fn candidates(&self, gate: &mut Gate) {
        let (p, play) = (&self.parameters, gate.play);
        let flange = self.mount.flange(gate.target);
        let rotation = flange.rotation.to_rotation_matrix().into_inner();
        let centre = flange.translation.vector - rotation.column(2) * p.c4;
        let free = seed_theta(&self.maps, gate.options.seed, 0);
        let Some(swings) = swing(centre.x, centre.y, p.b, free, play) else { return };
        for (behind, (theta1, forward)) in swings.into_iter().enumerate() {
            let Some(turns1) = gate.turns(0, &self.maps[0], theta1.rad) else { continue };
            gate.close |= swings_meet(forward);
            let links = two_links(forward - p.a1, centre.z - p.c1, p.c2, self.forearm, play);
            let seen = theta1.unturn_z(&rotation);
            for (below, (theta2, bend)) in links.into_iter().flatten().enumerate() {
                gate.close |= links_meet(&bend);
                let theta3 = bend.rad - self.lead.rad;
                let Some(turns2) = gate.turns(1, &self.maps[1], theta2.rad) else { continue };
                let Some(turns3) = gate.turns(2, &self.maps[2], theta3) else { continue };
                let reached = self.wrist_centre(&theta1, &theta2, &bend);
                let along4 = theta2.plus(&bend).plus(&self.lead.opposite());
                let wrist = along4.unturn_y(&seen);
                let branch = Branch { shoulder: behind == 1, elbow: below == 1, wrist: false };
                self.turn_wrist(
                    gate,
                    [turns1, turns2, turns3],
                    branch,
                    &wrist,
                    &(reached - centre),
                );
            }
        }
    }

    /// The two flips of a wrist that is to turn by `wrist` and whose centre is `off` its place.
    fn turn_wrist(
        &self,
        gate: &mut Gate,
        [turns1, turns2, turns3]: [Turns; 3],
        branch: Branch,
        wrist: &Matrix3<f64>,
        off: &Vector,
    ) {
        let turned = zyz(wrist, seed_theta(&self.maps, gate.options.seed, 3));
        let rad = turned.error_rad + self.mount.misfit_rad;
        let lever = self.parameters.c4.abs() + self.mount.tool_m;
        let m = off.norm() + turned.error_rad * lever + self.mount.misfit_m;
        for (flip, [theta4, theta5, theta6]) in turned.angles.into_iter().enumerate() {
            let Some(turns4) = gate.turns(3, &self.maps[3], theta4) else { continue };
            let Some(turns5) = gate.turns(4, &self.maps[4], theta5) else { continue };
            let Some(turns6) = gate.turns(5, &self.maps[5], theta6) else { continue };
            let turns = [turns1, turns2, turns3, turns4, turns5, turns6];
            gate.keep(&turns, Branch { wrist: flip == 1, ..branch }, TipError { m, rad });
        }
    }

    /// Wrist centre by the first three joints, in canonical axes; `bend` is that of the line elbow → wrist.
    fn wrist_centre(&self, theta1: &Angle, theta2: &Angle, bend: &Angle) -> Vector {
        let (p, fore) = (&self.parameters, theta2.plus(bend));
        let forward = p.a1 + p.c2 * theta2.sin + self.forearm * fore.sin;
        Vector::new(
            theta1.cos * forward - theta1.sin * p.b,
            theta1.sin * forward + theta1.cos * p.b,
            p.c1 + p.c2 * theta2.cos + self.forearm * fore.cos,
        )
    }

    fn thetas(&self, q: &[f64]) -> [f64; 6] {
        std::array::from_fn(|index| self.maps[index].theta(q[index]))
    }

    /// Wrist centre in front of axis 1 (negative: behind), in the plane of the arm, m.
    fn forward_m(&self, theta: &[f64; 6]) -> f64 {
        let p = &self.parameters;
        let forearm = theta[1] + theta[2] + p.lead();
        p.a1 + p.c2 * theta[1].sin() + self.forearm * forearm.sin()
    }

    /// Branch of a posture.
    pub fn branch(&self, q: &[f64]) -> Branch {
        let theta = self.thetas(q);
        Branch {
            shoulder: self.forward_m(&theta) < 0.0,
            elbow: (theta[2] + self.parameters.lead()).sin() < 0.0,
            wrist: theta[4].sin() < 0.0,
        }
    }

    /// Angle of axis 5, angle of the elbow, each from where the arm is singular in rad, and the
    /// distance of the wrist centre from axis 1 in m.
    pub(super) fn distances(&self, q: &[f64]) -> (f64, f64, f64) {
        let theta = self.thetas(q);
        (
            super::singularity::from_line(theta[4]),
            super::singularity::from_line(theta[2] + self.parameters.lead()),
            self.forward_m(&theta).hypot(self.parameters.b),
        )
    }
}

/// Directions of the canonical y and z axes. Four choices describe the same arm; `a2 ≤ 0` and `a1 ≥ 0`
/// pick the makers' one (axis 1 upwards) without asking which way the base is mounted.
fn directions(lines: &[Line], centre: &Vector, foot: &Vector) -> (Vector, Vector) {
    let [l1, l2, l3, l4] = [0, 1, 2, 3].map(|index| &lines[index]);
    let lower = centre - l3.foot(centre);
    let along4 = l4.direction * sign(&l4.direction, &lower);
    let a2 = lower.dot(&l2.direction.cross(&along4));
    let across = if a2 > TOLERANCE { -l2.direction } else { l2.direction };
    let a1 = (l2.point - foot).dot(&across.cross(&l1.direction));
    let up = if a1 < -TOLERANCE { -l1.direction } else { l1.direction };
    (across, up)
}
