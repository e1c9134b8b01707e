//! URDF: text to [`RobotDescription`]. Lengths in m, angles in rad, masses in kg, as URDF has it.
//!
//! `xml` finds the elements and their places, `check` refuses what urdf-rs would pass over in
//! silence (it drops vector entries that are not numbers), `inertial` masses that no body has,
//! urdf-rs reads, `tree` checks the whole.

mod check;
mod inertial;
mod mesh_path;
#[cfg(test)]
mod tests;
mod tree;
mod xml;

pub use mesh_path::{MeshPathError, mesh_location};

use crate::{Diagnostic, Source, Span};

/// Largest file that is read, bytes.
pub const MAX_BYTES: usize = 16 << 20;

/// A robot: links and the joints between them, a tree.
#[derive(Debug, Clone, PartialEq)]
pub struct RobotDescription {
    /// Its name.
    pub name: String,
    /// Bodies, in the order of the file.
    pub links: Vec<LinkDescription>,
    /// Joints, in the order of the file.
    pub joints: Vec<JointDescription>,
}

/// A body of the robot.
#[derive(Debug, Clone, PartialEq)]
pub struct LinkDescription {
    /// Its name.
    pub name: String,
    /// Mass, kg; `None` where the file states none.
    pub mass_kg: Option<f64>,
    /// Centre of mass in link axes, m.
    pub com_m: [f64; 3],
    /// Axes of the inertia in link axes, rad.
    pub inertial_rpy_rad: [f64; 3],
    /// Inertia about the centre of mass, in the inertial axes, kg m²: ixx, ixy, ixz, iyy, iyz, izz.
    pub inertia: [f64; 6],
    /// Shapes for collision.
    pub collisions: Vec<CollisionDescription>,
    /// Shapes for pictures.
    pub visuals: Vec<CollisionDescription>,
}

/// A shape and where it sits on its link.
#[derive(Debug, Clone, PartialEq)]
pub struct CollisionDescription {
    /// Offset in link axes, m.
    pub xyz_m: [f64; 3],
    /// Rotation, fixed axes, rad.
    pub rpy_rad: [f64; 3],
    /// The shape.
    pub shape: ShapeDescription,
}

/// A shape about its own origin; the long axis of round ones is z.
#[derive(Debug, Clone, PartialEq)]
pub enum ShapeDescription {
    /// Edge lengths, m.
    Box {
        /// Along x, y, z, m.
        size_m: [f64; 3],
    },
    /// A cylinder.
    Cylinder {
        /// Radius, m.
        radius_m: f64,
        /// Length, m.
        length_m: f64,
    },
    /// A ball.
    Sphere {
        /// Radius, m.
        radius_m: f64,
    },
    /// A cylinder with half balls on both ends.
    Capsule {
        /// Radius, m.
        radius_m: f64,
        /// Length of the cylinder between the half balls, m.
        length_m: f64,
    },
    /// A file; [`mesh_location`] says where.
    Mesh {
        /// As written.
        path: String,
        /// Factors along x, y, z from file units to m.
        scale: [f64; 3],
    },
}

/// How a joint moves.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum JointKind {
    /// Turns between stops.
    Revolute,
    /// Turns without stops.
    Continuous,
    /// Slides between stops.
    Prismatic,
    /// Does not move.
    Fixed,
}

/// A joint between two links.
#[derive(Debug, Clone, PartialEq)]
pub struct JointDescription {
    /// Its name.
    pub name: String,
    /// How it moves.
    pub kind: JointKind,
    /// Link on the base's side.
    pub parent: String,
    /// Link on the tip's side.
    pub child: String,
    /// Offset of the child in parent axes, m.
    pub xyz_m: [f64; 3],
    /// Rotation of the child, fixed axes, rad.
    pub rpy_rad: [f64; 3],
    /// Axis in joint axes, of length one.
    pub axis: [f64; 3],
    /// Lower stop, rad or m; `None` for continuous and fixed joints.
    pub lower: Option<f64>,
    /// Upper stop, rad or m; `None` for continuous and fixed joints.
    pub upper: Option<f64>,
    /// Largest speed, rad/s or m/s; `Some` for every joint that moves.
    pub velocity: Option<f64>,
    /// Largest torque or force, N m or N; `None` where the file says 0 or nothing.
    pub effort: Option<f64>,
    /// The joint it follows.
    pub mimic: Option<MimicDescription>,
}

/// `value = multiplier × other + offset`.
#[derive(Debug, Clone, PartialEq)]
pub struct MimicDescription {
    /// Name of the other joint.
    pub joint: String,
    /// Factor.
    pub multiplier: f64,
    /// Offset, rad or m.
    pub offset: f64,
}

/// Reads a URDF. Opens no file: meshes are named, not read.
pub fn parse(source: &Source) -> Result<RobotDescription, Vec<Diagnostic>> {
    let advised = |problems: Vec<Diagnostic>| {
        problems.into_iter().map(|problem| problem.or_hint(PLAIN_URDF)).collect()
    };
    read(source).map_err(advised)
}

/// What to do about a problem that says no better.
const PLAIN_URDF: &str = "URDF is XML in metres and radians; expand xacro before";

fn read(source: &Source) -> Result<RobotDescription, Vec<Diagnostic>> {
    let elements = xml::elements(&source.text).map_err(|problem| vec![*problem])?;
    let mut problems = check::values(&elements);
    if !problems.is_empty() {
        return Err(problems);
    }
    let robot = urdf_rs::read_from_string(&source.text).map_err(|error| {
        let span = elements.first().map_or(Span::default(), |root| root.span);
        vec![Diagnostic::error(span, format!("not a URDF: {}", one_line(&error.to_string())))]
    })?;
    let robot = description(&robot);
    problems.extend(inertial::check(&elements));
    problems.extend(tree::check(&robot, &elements));
    problems.sort_by_key(|problem| problem.span);
    if problems.is_empty() { Ok(robot) } else { Err(problems) }
}

fn one_line(text: &str) -> String {
    text.split_whitespace().take(60).collect::<Vec<_>>().join(" ")
}

fn description(robot: &urdf_rs::Robot) -> RobotDescription {
    RobotDescription {
        name: robot.name.clone(),
        links: robot.links.iter().map(link).collect(),
        joints: robot.joints.iter().map(joint).collect(),
    }
}

fn link(link: &urdf_rs::Link) -> LinkDescription {
    let inertia = &link.inertial.inertia;
    let mass_kg = link.inertial.mass.value;
    LinkDescription {
        name: link.name.clone(),
        mass_kg: (mass_kg > 0.0).then_some(mass_kg),
        com_m: link.inertial.origin.xyz.0,
        inertial_rpy_rad: link.inertial.origin.rpy.0,
        inertia: [inertia.ixx, inertia.ixy, inertia.ixz, inertia.iyy, inertia.iyz, inertia.izz],
        collisions: link.collision.iter().map(|each| body(&each.origin, &each.geometry)).collect(),
        visuals: link.visual.iter().map(|each| body(&each.origin, &each.geometry)).collect(),
    }
}

fn body(origin: &urdf_rs::Pose, geometry: &urdf_rs::Geometry) -> CollisionDescription {
    let shape = match geometry {
        urdf_rs::Geometry::Box { size } => ShapeDescription::Box { size_m: size.0 },
        &urdf_rs::Geometry::Cylinder { radius, length } => {
            ShapeDescription::Cylinder { radius_m: radius, length_m: length }
        }
        &urdf_rs::Geometry::Capsule { radius, length } => {
            ShapeDescription::Capsule { radius_m: radius, length_m: length }
        }
        &urdf_rs::Geometry::Sphere { radius } => ShapeDescription::Sphere { radius_m: radius },
        urdf_rs::Geometry::Mesh { filename, scale } => ShapeDescription::Mesh {
            path: filename.clone(),
            scale: scale.map_or([1.0; 3], |scale| scale.0),
        },
    };
    CollisionDescription { xyz_m: origin.xyz.0, rpy_rad: origin.rpy.0, shape }
}

/// [`check::values`] has refused the kinds that are no [`JointKind`].
fn joint(joint: &urdf_rs::Joint) -> JointDescription {
    let kind = match joint.joint_type {
        urdf_rs::JointType::Revolute => JointKind::Revolute,
        urdf_rs::JointType::Continuous => JointKind::Continuous,
        urdf_rs::JointType::Prismatic => JointKind::Prismatic,
        _ => JointKind::Fixed,
    };
    let stops = matches!(kind, JointKind::Revolute | JointKind::Prismatic);
    let axis = joint.axis.xyz.0;
    let length = axis.iter().map(|part| part * part).sum::<f64>().sqrt();
    let positive = |value: f64| (value > 0.0 && value.is_finite()).then_some(value);
    JointDescription {
        name: joint.name.clone(),
        kind,
        parent: joint.parent.link.clone(),
        child: joint.child.link.clone(),
        xyz_m: joint.origin.xyz.0,
        rpy_rad: joint.origin.rpy.0,
        axis: if length > 0.0 { axis.map(|part| part / length) } else { axis },
        lower: stops.then_some(joint.limit.lower),
        upper: stops.then_some(joint.limit.upper),
        velocity: positive(joint.limit.velocity).filter(|_| kind != JointKind::Fixed),
        effort: positive(joint.limit.effort).filter(|_| kind != JointKind::Fixed),
        mimic: joint.mimic.as_ref().map(|mimic| MimicDescription {
            joint: mimic.joint.clone(),
            multiplier: mimic.multiplier.unwrap_or(1.0),
            offset: mimic.offset.unwrap_or(0.0),
        }),
    }
}
