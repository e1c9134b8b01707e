//! Seven joints: three axes that meet at the shoulder, one at the elbow, three that meet at the wrist.
//!
//! Canonical arm, shoulder at the origin:
//! `Rz(θ1) Ry(θ2) Rz(θ3) T(0, 0, upper) Ry(θ4) T(0, 0, lower) Rz(θ5) Ry(θ6) Rz(θ7)`. Shoulder, elbow and wrist
//! form a triangle with given sides; its turn about the line shoulder → wrist is the elbow angle.

use nalgebra::Matrix3;

use super::angle::{half_turn, unit};
use super::branch::Branch;
use super::canonical::{JointMap, axes_pose, seed_theta, sign, turn_y, turn_z};
use super::gate::{Gate, TipError};
use super::lines::{Line, TOLERANCE};
use super::mount::{About, Mount, Step, forward};
use super::planar::bend;
use super::singularity::from_line;
use super::wrist::zyz;
use crate::pose::{Pose, Vector};

/// Lengths of the canonical arm, m.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SrsParameters {
    /// Shoulder to elbow.
    pub upper: f64,
    /// Elbow to wrist.
    pub lower: f64,
}

/// A recognised arm.
#[derive(Debug, Clone, PartialEq)]
pub struct Srs {
    /// Lengths.
    pub parameters: SrsParameters,
    /// Joint values to canonical angles.
    pub maps: [JointMap; 7],
    mount: Mount,
}

/// Lengths below this have no direction, m.
const SLACK_M: f64 = 1e-9;

impl SrsParameters {
    fn steps(&self) -> [Step; 7] {
        let along = |length: f64| Vector::new(0.0, 0.0, length);
        [
            (About::Z, Vector::zeros()),
            (About::Y, Vector::zeros()),
            (About::Z, along(self.upper)),
            (About::Y, along(self.lower)),
            (About::Z, Vector::zeros()),
            (About::Y, Vector::zeros()),
            (About::Z, Vector::zeros()),
        ]
    }
}

impl Srs {
    /// Fits the canonical arm to seven axes; `None` where they are of another kind.
    pub(super) fn fit(lines: &[Line], tip: &Pose) -> Option<Self> {
        let [l1, l2, l3, l4, l5, l6, l7] = lines else { return None };
        if !lines.windows(2).all(|pair| pair[0].perpendicular(&pair[1])) {
            return None;
        }
        let shoulder = same(l1.meets(l2)?, l2.meets(l3)?)?;
        let elbow = same(l3.meets(l4)?, l4.meets(l5)?)?;
        let wrist = same(l5.meets(l6)?, l6.meets(l7)?)?;
        let parameters =
            SrsParameters { upper: (elbow - shoulder).norm(), lower: (wrist - elbow).norm() };
        if parameters.upper < TOLERANCE || parameters.lower < TOLERANCE {
            return None;
        }
        let base = axes_pose(&shoulder, &l2.direction, &l1.direction);
        let sign3 = sign(&l3.direction, &(elbow - shoulder));
        let sign5 = sign(&l5.direction, &(wrist - elbow));
        // Each axis seen in the axes that the joints before it have turned to.
        let mut turned = base.rotation;
        let mut theta = [0.0; 7];
        let mut signs = [1.0; 7];
        (signs[2], signs[4]) = (sign3, sign5);
        for (index, line) in lines.iter().enumerate().skip(2) {
            let axis = turned.inverse() * line.direction * signs[index];
            if index % 2 == 0 {
                theta[index - 1] = axis.x.atan2(axis.z);
                turned *= turn_y(theta[index - 1]).rotation;
            } else {
                theta[index - 1] = (-axis.x).atan2(axis.y);
                turned *= turn_z(theta[index - 1]).rotation;
            }
        }
        let tool = (base * forward(&parameters.steps(), &theta)).inverse() * tip;
        let mut maps = [JointMap { sign: 1.0, zero_rad: 0.0 }; 7];
        for (map, (sign, zero_rad)) in maps.iter_mut().zip(signs.into_iter().zip(theta)) {
            *map = JointMap { sign, zero_rad };
        }
        let mount = Mount::new((&base, &tool), &parameters.steps(), &maps, lines, tip);
        Some(Self { parameters, maps, mount })
    }

    /// Whether the closed form is the chain to rounding.
    pub(super) fn exact(&self) -> bool {
        self.mount.exact()
    }

    /// Every posture that puts the tip on the target with the elbow at the angle asked for.
    ///
    /// The arm with its elbow bent the other way is the same with joints 3 and 5 half a turn further,
    /// so shoulder and wrist are solved once.
    pub(super) fn candidates(&self, gate: &mut Gate) {
        let SrsParameters { upper, lower } = self.parameters;
        let play = gate.play;
        let wrist = self.mount.flange(gate.target);
        let rotation = wrist.rotation.to_rotation_matrix().into_inner();
        let at = wrist.translation.vector;
        let reach = at.norm();
        if !play.reaches(reach, upper, lower) {
            return;
        }
        let (line, zero, side) = elbow_axes(&at);
        let (sin, cos) = gate.options.elbow_rad.sin_cos();
        let out = zero * cos + side * sin;
        let bend = bend(reach, upper, lower, play);
        // Angle between upper arm and the line to the wrist, always within [0, π].
        let (sin, cos) = unit(lower * bend.sin, upper + lower * bend.cos);
        let along = line * cos + out * sin;
        let normal = out.cross(&line);
        let arm = Matrix3::from_columns(&[normal.cross(&along), normal, along]);
        let fore = bend.unturn_y(&arm.transpose());
        let off = along * upper + fore.row(2).transpose() * lower - at;
        let free = |index| seed_theta(&self.maps, gate.options.seed, index);
        let shoulder = zyz(&arm, free(0));
        let hand = zyz(&(fore * rotation), free(4));
        let rad = shoulder.error_rad + hand.error_rad;
        let error = TipError {
            m: off.norm() + rad * (upper + lower + self.mount.tool_m) + self.mount.misfit_m,
            rad: rad + self.mount.misfit_rad,
        };
        self.combine(gate, shoulder.angles, bend.rad, hand.angles, error);
    }

    /// Two shoulders, two elbows, two wrists.
    fn combine(
        &self,
        gate: &mut Gate,
        shoulder: [[f64; 3]; 2],
        bend: f64,
        hand: [[f64; 3]; 2],
        error: TipError,
    ) {
        let three = |gate: &Gate, first: usize, [a, b, c]: [f64; 3]| {
            let turns = |index: usize, theta| gate.turns(index, &self.maps[index], theta);
            Some([turns(first, a)?, turns(first + 1, b)?, turns(first + 2, c)?])
        };
        for (bent, theta4) in [bend, -bend].into_iter().enumerate() {
            let Some(turns4) = gate.turns(3, &self.maps[3], theta4) else { continue };
            let turned = |angle: f64| if bent == 0 { angle } else { half_turn(angle) };
            let wrists = hand.map(|[a, b, c]| three(gate, 4, [turned(a), b, c]));
            for (back, [a, b, c]) in shoulder.into_iter().enumerate() {
                let Some([turns1, turns2, turns3]) = three(gate, 0, [a, b, turned(c)]) else {
                    continue;
                };
                for (flip, wrist) in wrists.iter().enumerate() {
                    let Some([turns5, turns6, turns7]) = *wrist else { continue };
                    let turns = [turns1, turns2, turns3, turns4, turns5, turns6, turns7];
                    let branch = Branch { shoulder: back == 1, elbow: bent == 1, wrist: flip == 1 };
                    gate.keep(&turns, branch, error);
                }
            }
        }
    }

    fn thetas(&self, q: &[f64]) -> [f64; 7] {
        std::array::from_fn(|index| self.maps[index].theta(q[index]))
    }

    /// Elbow angle of a posture, rad in [−π, π]: right-handed about the line shoulder → wrist, 0 where
    /// the elbow lies in the half-plane of that line and the first joint's positive axis.
    ///
    /// Where that axis runs along the line, the half-plane of the line and the canonical x axis
    /// (second axis × first axis, all joints at zero) stands in. The plane of the stretched arm is that of
    /// its elbow joint.
    pub fn elbow_angle(&self, q: &[f64]) -> f64 {
        let theta = self.thetas(q);
        let arm = (turn_z(theta[0]) * turn_y(theta[1]) * turn_z(theta[2])).rotation;
        let hand = arm * turn_y(theta[3]).rotation;
        let wrist =
            arm * Vector::z() * self.parameters.upper + hand * Vector::z() * self.parameters.lower;
        let (line, zero, side) = elbow_axes(&wrist);
        let normal = arm * Vector::y();
        let out = if theta[3].sin() >= 0.0 { line.cross(&normal) } else { normal.cross(&line) };
        out.dot(&side).atan2(out.dot(&zero))
    }

    /// Branch of a posture.
    pub fn branch(&self, q: &[f64]) -> Branch {
        let theta = self.thetas(q);
        Branch {
            shoulder: theta[1].sin() < 0.0,
            elbow: theta[3].sin() < 0.0,
            wrist: theta[5].sin() < 0.0,
        }
    }

    /// Angles of wrist, elbow and shoulder joint (6, 4, 2) from where their neighbours line up,
    /// rad, and the distance of the wrist from axis 1, m.
    pub(super) fn distances(&self, q: &[f64]) -> (f64, f64, f64, f64) {
        let theta = self.thetas(q);
        let SrsParameters { upper, lower } = self.parameters;
        let [(s2, c2), (s3, c3), (s4, c4)] = [theta[1], theta[2], theta[3]].map(f64::sin_cos);
        // Wrist in the axes that turn with joint 1.
        let x = upper * s2 + lower * (c2 * c3 * s4 + s2 * c4);
        let y = lower * s3 * s4;
        (from_line(theta[5]), from_line(theta[3]), from_line(theta[1]), x.hypot(y))
    }
}

/// Line to the wrist, direction of elbow angle zero, and direction of a quarter turn.
fn elbow_axes(wrist: &Vector) -> (Vector, Vector, Vector) {
    let reach = wrist.norm();
    let line = if reach > SLACK_M { wrist / reach } else { Vector::z() };
    let across = |hint: Vector| hint - line * line.dot(&hint);
    let mut zero = across(Vector::z());
    if zero.norm() < SLACK_M {
        zero = across(Vector::x());
    }
    let zero = zero.normalize();
    (line, zero, line.cross(&zero))
}

fn same(one: Vector, other: Vector) -> Option<Vector> {
    ((one - other).norm() < TOLERANCE).then_some(0.5 * (one + other))
}
