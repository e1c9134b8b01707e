//! From a robot's tree of links to the chain between two of them, and where all other links ride.

use slam::urdf::{JointDescription, JointKind as UrdfKind, RobotDescription};

use super::chain::{Chain, ChainFault, ChainJoint, JointKind, Mimic, advance};
use crate::pose::{Pose, Vector, from_xyz_rpy};

/// Where one link of the robot is.
#[derive(Debug, Clone, PartialEq)]
pub struct Attachment {
    /// Name of the link.
    pub link: String,
    /// Index in [`Chain::joints`] of the joint it moves with; `None` where it stands with the base.
    pub carrier: Option<usize>,
    /// The link in the axes of that joint's child link ([`Chain::link_poses`]) or of the base.
    pub carrier_from_link: Pose,
    /// Set where a joint beside the chain follows one inside it: the link is drawn as with its master
    /// at zero, which is wrong once the master moves.
    pub frozen_mimic: bool,
}

/// A chain with the links of the whole robot attached.
#[derive(Debug, Clone, PartialEq)]
pub struct RobotTree {
    /// Moving joints from base to tip.
    pub chain: Chain,
    /// Every link that hangs together with the base, base first, depth first in file order.
    pub links: Vec<Attachment>,
}

/// Chain from link `base` to link `tip`, up and down the tree as needed, with the joints named in
/// `held` fixed, rad or m. Joints beside the chain stand at their held value, else at zero or the limit
/// nearest to it.
pub fn from_urdf(
    robot: &RobotDescription,
    base: &str,
    tip: &str,
    held: &[(&str, f64)],
) -> Result<RobotTree, ChainFault> {
    for link in [base, tip] {
        if !robot.links.iter().any(|known| known.name == link) {
            return Err(ChainFault::UnknownLink { link: link.to_owned() });
        }
    }
    check_held(robot, held)?;
    let path = path(robot, base, tip)
        .ok_or_else(|| ChainFault::NotConnected { base: base.to_owned(), tip: tip.to_owned() })?;
    let mut walk = Walk { robot, held, moving: Vec::new(), joints: Vec::new(), links: Vec::new() };
    walk.moving = path.into_iter().filter(|&joint| !walk.is_still(joint)).collect();
    // The masters of followers must be in the chain; followers of anything else stand still.
    let with_master =
        |&joint: &usize| walk.master(joint).is_some_and(|master| walk.moving.contains(&master));
    walk.moving = walk.moving.iter().copied().filter(with_master).collect();
    walk.visit(base, None, None, Pose::identity(), false);
    let last = walk.links.iter().find(|link| link.link == tip);
    let last_from_tip = last.map_or_else(Pose::identity, |link| link.carrier_from_link);
    Ok(RobotTree { chain: Chain::new(walk.joints, last_from_tip)?, links: walk.links })
}

fn check_held(robot: &RobotDescription, held: &[(&str, f64)]) -> Result<(), ChainFault> {
    for &(name, _) in held {
        let known = robot.joints.iter().find(|joint| joint.name == name);
        let known = known.filter(|joint| !matches!(joint.kind, UrdfKind::Fixed));
        let Some(joint) = known else {
            return Err(ChainFault::UnknownJoint { joint: name.to_owned() });
        };
        if let Some(mimic) = &joint.mimic {
            return Err(ChainFault::MimicHeld {
                joint: name.to_owned(),
                master: mimic.joint.clone(),
            });
        }
    }
    Ok(())
}

/// Joints from `base` up to the common ancestor and down to `tip`.
fn path(robot: &RobotDescription, base: &str, tip: &str) -> Option<Vec<usize>> {
    let (from_base, from_tip) = (to_root(robot, base)?, to_root(robot, tip)?);
    let shared = from_base.iter().rev().zip(from_tip.iter().rev()).take_while(|(a, b)| a == b);
    let shared = shared.count();
    let up = &from_base[..from_base.len() - shared];
    let down = &from_tip[..from_tip.len() - shared];
    let top = |link: &str, joints: &[usize]| {
        joints.last().map_or(link.to_owned(), |&joint| robot.joints[joint].parent.clone())
    };
    (top(base, up) == top(tip, down)).then(|| up.iter().chain(down.iter().rev()).copied().collect())
}

/// Joints from a link up to the root; `None` where they run in a circle.
fn to_root(robot: &RobotDescription, link: &str) -> Option<Vec<usize>> {
    let mut joints = Vec::new();
    let mut at = link;
    while let Some(index) = robot.joints.iter().position(|joint| joint.child == at) {
        if joints.len() >= robot.joints.len() {
            return None;
        }
        joints.push(index);
        at = &robot.joints[index].parent;
    }
    Some(joints)
}

struct Walk<'a> {
    robot: &'a RobotDescription,
    held: &'a [(&'a str, f64)],
    /// Joints of the robot that move in the chain, base to tip.
    moving: Vec<usize>,
    joints: Vec<ChainJoint>,
    links: Vec<Attachment>,
}

impl Walk<'_> {
    /// The joint that a joint follows in the end, itself if none; `None` where it follows nothing.
    fn master(&self, mut joint: usize) -> Option<usize> {
        for _ in 0..=self.robot.joints.len() {
            let Some(mimic) = &self.robot.joints[joint].mimic else { return Some(joint) };
            joint = self.robot.joints.iter().position(|known| known.name == mimic.joint)?;
        }
        None
    }

    /// Whether a joint is fixed, held, or follows one that is.
    fn is_still(&self, joint: usize) -> bool {
        let Some(master) = self.master(joint) else { return true };
        let fixed = |index: usize| matches!(self.robot.joints[index].kind, UrdfKind::Fixed);
        fixed(joint) || fixed(master) || self.held_value(master).is_some()
    }

    fn held_value(&self, joint: usize) -> Option<f64> {
        let name = &self.robot.joints[joint].name;
        self.held.iter().rev().find(|(held, _)| held == name).map(|&(_, value)| value)
    }

    /// Value of a joint that does not move in the chain.
    fn still_value(&self, joint: usize) -> f64 {
        let (mut at, mut multiplier, mut offset) = (joint, 1.0, 0.0);
        for _ in 0..=self.robot.joints.len() {
            let Some(mimic) = &self.robot.joints[at].mimic else { break };
            offset += multiplier * mimic.offset;
            multiplier *= mimic.multiplier;
            let master = self.robot.joints.iter().position(|known| known.name == mimic.joint);
            let Some(master) = master else { break };
            at = master;
        }
        let description = &self.robot.joints[at];
        let lower = description.lower.unwrap_or(f64::NEG_INFINITY);
        let rest = 0.0_f64.max(lower).min(description.upper.unwrap_or(f64::INFINITY));
        multiplier * self.held_value(at).unwrap_or(rest) + offset
    }

    /// Attaches `link` and all that hangs on it but for the joint it was reached by.
    fn visit(
        &mut self,
        link: &str,
        by: Option<usize>,
        carrier: Option<usize>,
        pose: Pose,
        frozen: bool,
    ) {
        self.links.push(Attachment {
            link: link.to_owned(),
            carrier,
            carrier_from_link: pose,
            frozen_mimic: frozen,
        });
        let robot = self.robot;
        for (index, joint) in robot.joints.iter().enumerate() {
            let (down, up) = (joint.parent == link, joint.child == link);
            // A tree has one way to each link; anything else was visited already.
            let next = if down { &joint.child } else { &joint.parent };
            let seen = self.links.iter().any(|known| known.link == *next);
            if Some(index) == by || !(down || up) || seen {
                continue;
            }
            let (fixed, axis) =
                (from_xyz_rpy(joint.xyz_m, joint.rpy_rad), Vector::from(joint.axis));
            if self.moving.contains(&index) {
                let (before, axis, after) = if down {
                    (pose * fixed, axis, Pose::identity())
                } else {
                    (pose, -axis, fixed.inverse())
                };
                self.joints.push(self.chain_joint(joint, before, axis));
                self.visit(next, Some(index), Some(self.joints.len() - 1), after, false);
            } else {
                let mut step = fixed;
                if !matches!(joint.kind, UrdfKind::Fixed) {
                    let still = self.chain_joint(joint, fixed, axis);
                    advance(&mut step, &still, self.still_value(index));
                }
                let step = if down { step } else { step.inverse() };
                let follows = joint.mimic.is_some()
                    && self.master(index).is_some_and(|master| self.moving.contains(&master));
                self.visit(next, Some(index), carrier, pose * step, frozen || follows);
            }
        }
    }

    fn chain_joint(&self, joint: &JointDescription, before: Pose, axis: Vector) -> ChainJoint {
        let slides = matches!(joint.kind, UrdfKind::Prismatic);
        let mimic = joint.mimic.as_ref().and_then(|mimic| {
            let master = |&index: &usize| self.robot.joints[index].name == mimic.joint;
            let master = self.moving.iter().position(master)?;
            Some(Mimic { master, multiplier: mimic.multiplier, offset: mimic.offset })
        });
        ChainJoint {
            name: joint.name.clone(),
            kind: if slides { JointKind::Prismatic } else { JointKind::Revolute },
            parent_from_joint: before,
            axis,
            lower: joint.lower.unwrap_or(f64::NEG_INFINITY),
            upper: joint.upper.unwrap_or(f64::INFINITY),
            velocity: joint.velocity.unwrap_or(f64::INFINITY),
            effort: joint.effort,
            mimic,
        }
    }
}
