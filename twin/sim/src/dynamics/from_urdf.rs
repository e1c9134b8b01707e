//! What every joint of a chain carries, from the inertials of a URDF.

use nalgebra::Matrix3;
use slam::urdf::{LinkDescription, RobotDescription};
use thiserror::Error;

use super::body::Body;
use crate::kinematics::RobotTree;
use crate::pose::from_xyz_rpy;

/// Why there are no masses.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
pub enum MassFault {
    /// A joint that carries only links of which the URDF states no mass.
    #[error("the URDF states no mass for anything that joint `{joint}` carries")]
    NoMass {
        /// Its name.
        joint: String,
    },
}

/// One body per entry of [`crate::kinematics::Chain::joints`], in the axes of the joint's child
/// link: all links that move with it, those beside the chain included, merged. What stands with the
/// base is left out.
///
/// # Errors
/// The first joint without a mass: such an arm has no dynamics.
pub fn bodies_from_urdf(
    robot: &RobotDescription,
    tree: &RobotTree,
) -> Result<Vec<Body>, MassFault> {
    let joints = tree.chain.joints();
    let mut bodies = vec![Body::none(); joints.len()];
    for attachment in &tree.links {
        let link = robot.links.iter().find(|link| link.name == attachment.link);
        if let (Some(carrier), Some(body)) = (attachment.carrier, link.and_then(body)) {
            bodies[carrier] = bodies[carrier].with(&body.seen_from(&attachment.carrier_from_link));
        }
    }
    match bodies.iter().position(|body| !(body.mass_kg > 0.0)) {
        Some(joint) => Err(MassFault::NoMass { joint: joints[joint].name.clone() }),
        None => Ok(bodies),
    }
}

/// The body of one link in link axes; `None` where no mass is stated.
fn body(link: &LinkDescription) -> Option<Body> {
    let [xx, xy, xz, yy, yz, zz] = link.inertia;
    let inertia = Matrix3::new(xx, xy, xz, xy, yy, yz, xz, yz, zz);
    let own = Body { mass_kg: link.mass_kg?, centre: crate::pose::Vector::zeros(), inertia };
    Some(own.seen_from(&from_xyz_rpy(link.com_m, link.inertial_rpy_rad)))
}
