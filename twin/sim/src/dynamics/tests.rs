//! Arms for the tests; these stand in the files below.

use std::path::Path;

use nalgebra::Matrix3;

use super::*;
use crate::kinematics::{Chain, ChainJoint, JointKind, RobotTree, from_urdf};
use crate::pose::{Pose, Vector};

mod bodies;
mod followed;
mod lagrange;
mod laws;
mod loads;

const EARTH: Vector = Vector::new(0.0, 0.0, -9.806_65);

/// Xorshift64*, seeded.
struct Random(u64);

impl Random {
    /// In [−1, 1).
    fn next(&mut self) -> f64 {
        self.0 ^= self.0 >> 12;
        self.0 ^= self.0 << 25;
        self.0 ^= self.0 >> 27;
        let bits = self.0.wrapping_mul(0x2545_f491_4f6c_dd1d) >> 11;
        2.0 * (bits as f64 / (1_u64 << 53) as f64) - 1.0
    }

    fn vector(&mut self) -> Vector {
        Vector::new(self.next(), self.next(), self.next())
    }

    fn pose(&mut self) -> Pose {
        Pose::new(self.vector(), self.vector() * 3.0)
    }
}

fn read(path: &str) -> (slam::urdf::RobotDescription, RobotTree) {
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../robots").join(path);
    let text = std::fs::read_to_string(&file).unwrap();
    let robot = slam::urdf::parse(&slam::Source::new(path, text)).unwrap();
    let tree = from_urdf(&robot, "base_link", "tool0", &[]).unwrap();
    (robot, tree)
}

/// An arm of the library with a tool of 2 kg off its axis, under Earth's gravity, and its chain.
fn arm(path: &str) -> (Chain, Model) {
    let (robot, tree) = read(path);
    let bodies = bodies_from_urdf(&robot, &tree).unwrap();
    let model = Model::new(&tree.chain, &bodies, EARTH).unwrap();
    (tree.chain, model)
}

const KR6: &str = "kuka/kr6_r900_2/robot.urdf";
const UR10E: &str = "ur/ur10e/robot.urdf";

fn joint(kind: JointKind, place: Pose, axis: Vector) -> ChainJoint {
    ChainJoint {
        name: "j".to_owned(),
        kind,
        parent_from_joint: place,
        axis,
        lower: -10.0,
        upper: 10.0,
        velocity: 10.0,
        effort: None,
        mimic: None,
    }
}

/// A body with an inertia that some mass could have.
fn lump(random: &mut Random) -> Body {
    let size = random.vector().map(|x| 0.3 + 0.2 * x);
    Body::cuboid(2.0 + random.next(), size, &random.pose())
}

/// A chain of random joints and bodies.
fn random_arm(kinds: &[JointKind], random: &mut Random) -> (Chain, Vec<Body>) {
    let joints = kinds.iter().map(|&kind| joint(kind, random.pose(), random.vector())).collect();
    let chain = Chain::new(joints, random.pose()).unwrap();
    let bodies = kinds.iter().map(|_| lump(random)).collect();
    (chain, bodies)
}

fn random_vector(dof: usize, scale: f64, random: &mut Random) -> JointVector {
    let values: Vec<f64> = (0..dof).map(|_| scale * random.next()).collect();
    JointVector::new(&values)
}

/// `n` equal links of length `length`, each a point at its end, turning about y in the plane of x
/// and z; hanging down at zero.
fn pendulum(n: usize, mass_kg: f64, length_m: f64, inertia: f64) -> (Chain, Model) {
    let place = |index: usize| {
        if index == 0 { Pose::identity() } else { Pose::translation(0.0, 0.0, -length_m) }
    };
    let joints =
        (0..n).map(|index| joint(JointKind::Revolute, place(index), Vector::y())).collect();
    let chain = Chain::new(joints, Pose::translation(0.0, 0.0, -length_m)).unwrap();
    let body = Body {
        mass_kg,
        centre: Vector::new(0.0, 0.0, -length_m),
        inertia: Matrix3::from_diagonal_element(inertia),
    };
    let model = Model::new(&chain, &vec![body; n], EARTH).unwrap();
    (chain, model)
}
