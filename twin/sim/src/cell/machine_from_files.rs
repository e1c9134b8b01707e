//! Cell, tool and robot files in SI.

use slam::cell_file::{CellFile, LimitsFile, Mode as ModeFile, PoseFile};
use slam::robot_file::LinkShapes;
use slam::tool_file::{LampFile, ShapeFile, ToolFile};
use slam::urdf::{LinkDescription, ShapeDescription};

use super::equipment::{AirNozzle, Hose, Lamp};
use super::equipment_from_files;
use super::job::Limits;
use super::machine::{Bed, Cell, Extruder, Mode, Obstacle, Robot, RobotLink, Tool, ToolPart};
use super::resolve::Parts;
use crate::dynamics;
use crate::interval::Interval;
use crate::kinematics::{self, Chain, ChainJoint, JointKind};
use crate::pose::{self, Point, Pose, Vector};
use crate::process::{Jet, LightRing};
use crate::shape::Shape;

/// Accuracy assumed for an arm whose file says nothing: several tenths of a millimetre is usual
/// for an arm that was never calibrated (reference/robots-and-programs.md 1.4).
const ACCURACY_M: f64 = 0.5e-3;

/// The cell of a set of files.
///
/// # Errors
/// One sentence for the author of the cell.
pub fn machine(parts: &Parts<'_>) -> Result<Cell, String> {
    let file = parts.cell;
    let (robot, hoses) = robot(parts)?;
    let joints: Vec<&ChainJoint> = free_joints(&robot.arm.chain);
    if file.home_deg.len() != joints.len() {
        let n_home = file.home_deg.len();
        return Err(format!("home_deg has {n_home} values, the arm has {} joints", joints.len()));
    }
    let home: Vec<f64> =
        file.home_deg.iter().zip(&joints).map(|(q, joint)| q * joint_scale(joint)).collect();
    if let Some((joint, q)) =
        joints.iter().zip(&file.home_deg).zip(&home).find_map(|((&joint, deg), q)| {
            (!(joint.lower..=joint.upper).contains(q)).then_some((joint, deg))
        })
    {
        return Err(format!("home_deg puts joint {} at {q}, outside its limits", joint.name));
    }
    Ok(Cell {
        name: file.name.clone(),
        mode: match file.mode {
            ModeFile::ToolOnFlange => Mode::ToolOnFlange,
            ModeFile::BedOnFlange => Mode::BedOnFlange,
        },
        tool: tool(parts.tool),
        tool_pose: place(&file.tool_pose),
        bed: Bed {
            pose: place(&file.bed.pose),
            size_m: file.bed.size_mm.map(|mm| mm / 1e3),
            albedo: file.bed.albedo.map(triple),
            mass_kg: file.bed.mass_kg,
            adhesion_pa: triple(file.bed.adhesion_mpa).scaled(1e6),
        },
        obstacles: file
            .obstacle
            .iter()
            .map(|obstacle| Obstacle {
                name: obstacle.name.clone(),
                shapes: shapes(&obstacle.shape),
            })
            .collect(),
        hoses,
        lamps: lamps(&file.lamp),
        controller: equipment_from_files::controller(&file.controller),
        calibration: equipment_from_files::calibration(file.calibration.as_ref()),
        home,
        gravity_m_s2: Vector::from(file.gravity_m_s2),
        extruder: extruder(file),
        io: file.io.clone(),
        limits: limits(&file.limits),
        robot,
    })
}

/// The joints of a chain that have a value of their own, in the order of the joint vector.
pub(super) fn free_joints(chain: &Chain) -> Vec<&ChainJoint> {
    chain.axes().iter().map(|axis| &chain.joints()[axis.joint]).collect()
}

/// Radians or metres per unit in which files give this joint (degrees or mm).
pub(super) fn joint_scale(joint: &ChainJoint) -> f64 {
    match joint.kind {
        JointKind::Revolute => 1f64.to_radians(),
        JointKind::Prismatic => 1e-3,
    }
}

/// The robot, and the hoses on its links.
fn robot(parts: &Parts<'_>) -> Result<(Robot, Vec<Hose>), String> {
    let (file, urdf) = (parts.cell, parts.urdf);
    let held = held_values(parts)?;
    let held: Vec<(&str, f64)> = held.iter().map(|(name, value)| (name.as_str(), *value)).collect();
    let tree = kinematics::from_urdf(urdf, &file.base, &file.tip, &held)
        .map_err(|error| error.to_string())?;
    let mut links = Vec::new();
    for carried in &tree.links {
        let Some(link) = urdf.links.iter().find(|link| link.name == carried.link) else { continue };
        let shapes = link_shapes(link, parts);
        if !shapes.is_empty() {
            links.push(RobotLink {
                name: link.name.clone(),
                carrier: carried.carrier,
                carrier_from_link: carried.carrier_from_link,
                shapes,
            });
        }
    }
    let mut hosts: Vec<String> = links.iter().map(|link| link.name.clone()).collect();
    hosts.extend(file.carried.iter().map(|body| body.link.clone()));
    links.extend(equipment_from_files::carried(file, &tree.links)?);
    let stated = parts.robot.map_or(&[][..], |robot| robot.touching_links.as_slice());
    let noted = |joint: &ChainJoint| parts.robot.and_then(|robot| robot.joints.get(&joint.name));
    let acceleration = |joint: &ChainJoint| noted(joint).and_then(|noted| noted.acceleration);
    let torque =
        |joint: &ChainJoint| noted(joint).and_then(|noted| noted.torque_n_m).or(joint.effort);
    let hoses = equipment_from_files::hoses(file, &tree.links)?;
    let robot = Robot {
        name: parts.robot.map_or_else(|| urdf.name.clone(), |robot| robot.name.clone()),
        touching: touching(&links, &hosts, urdf, stated),
        links,
        acceleration: free_joints(&tree.chain).into_iter().map(acceleration).collect(),
        torque: free_joints(&tree.chain).into_iter().map(torque).collect(),
        rotors: free_joints(&tree.chain)
            .into_iter()
            .map(|joint| noted(joint).and_then(|noted| noted.rotor_inertia_kg_m2).unwrap_or(0.0))
            .collect(),
        masses: dynamics::bodies_from_urdf(urdf, &tree).ok(),
        payload_kg: parts.robot.and_then(|robot| robot.payload_kg),
        payload_centre: parts
            .robot
            .and_then(|robot| robot.payload_centre_mm)
            .map(|mm| Vector::from(mm) / 1e3),
        arm: kinematics::recognise(&tree.chain).map_err(|fault| fault.to_string())?,
        accuracy_m: parts
            .robot
            .and_then(|robot| robot.accuracy_mm)
            .map_or(ACCURACY_M, |accuracy_mm| accuracy_mm / 1e3),
        shapes_assumed: parts.robot.is_some_and(|robot| robot.link_shapes == LinkShapes::Assumed),
    };
    Ok((robot, hoses))
}

fn held_values(parts: &Parts<'_>) -> Result<Vec<(String, f64)>, String> {
    let mut held = Vec::new();
    for (name, value) in &parts.cell.held_deg {
        let joint = parts.urdf.joints.iter().find(|joint| &joint.name == name);
        let joint = joint.ok_or_else(|| format!("held joint `{name}` is not in the URDF"))?;
        let prismatic = joint.kind == slam::urdf::JointKind::Prismatic;
        held.push((name.clone(), if prismatic { value / 1e3 } else { value.to_radians() }));
    }
    Ok(held)
}

/// Pairs of links that may touch: parent and child, links joined through shapeless ones, links
/// of one rigid body, and the stated pairs. A carried body touches what its link (in `hosts`, which
/// has the link itself for a link) may touch.
fn touching(
    links: &[RobotLink],
    hosts: &[String],
    urdf: &slam::urdf::RobotDescription,
    stated: &[[String; 2]],
) -> Vec<[usize; 2]> {
    let parent_of = |name: &str| {
        urdf.joints.iter().find(|joint| joint.child == name).map(|joint| &joint.parent)
    };
    let bodies_of =
        |name: &str| -> Vec<usize> { (0..links.len()).filter(|&j| hosts[j] == name).collect() };
    // Carried bodies ride on links with and without a shape; the walk ends at a shape.
    let has_shape = |name: &str| links.iter().any(|link| link.name == name);
    let mut pairs = Vec::new();
    for (i, link) in links.iter().enumerate() {
        let mut parent = parent_of(&hosts[i]);
        while let Some(name) = parent {
            pairs.extend(bodies_of(name).into_iter().map(|j| [j.min(i), j.max(i)]));
            if has_shape(name) {
                break;
            }
            parent = parent_of(name);
        }
        for (j, other) in links.iter().enumerate().skip(i + 1) {
            if link.carrier == other.carrier {
                pairs.push([i, j]);
            }
        }
    }
    for [a, b] in stated {
        for i in bodies_of(a) {
            pairs.extend(bodies_of(b).into_iter().map(|j| [i.min(j), i.max(j)]));
        }
    }
    pairs.sort_unstable();
    pairs.dedup();
    pairs
}

fn link_shapes(link: &LinkDescription, parts: &Parts<'_>) -> Vec<Shape> {
    let mut shapes = Vec::new();
    for collision in &link.collisions {
        let axes = pose::from_xyz_rpy(collision.xyz_m, collision.rpy_rad);
        shapes.push(match &collision.shape {
            ShapeDescription::Box { size_m } => {
                Shape::Box { pose: axes, half_m: Vector::from(*size_m) / 2.0 }
            }
            ShapeDescription::Cylinder { radius_m, length_m } => {
                let end = |z_m: f64| axes * Point::new(0.0, 0.0, z_m);
                Shape::cylinder(end(-length_m / 2.0), end(length_m / 2.0), *radius_m)
            }
            ShapeDescription::Sphere { radius_m } => {
                Shape::sphere(axes * Point::origin(), *radius_m)
            }
            ShapeDescription::Capsule { radius_m, length_m } => Shape::Capsule {
                a: axes * Point::new(0.0, 0.0, -length_m / 2.0),
                b: axes * Point::new(0.0, 0.0, length_m / 2.0),
                radius_m: *radius_m,
            },
            // A mesh that could not be read was named in a warning by whoever read the files.
            ShapeDescription::Mesh { path, scale } => match parts.link_meshes.get(path) {
                None => continue,
                Some(mesh) => Shape::Hull {
                    points: mesh
                        .vertices
                        .iter()
                        .map(|v| {
                            axes * Point::new(v[0] * scale[0], v[1] * scale[1], v[2] * scale[2])
                        })
                        .collect(),
                },
            },
        });
    }
    shapes
}

fn tool(file: &ToolFile) -> Tool {
    Tool {
        name: file.name.clone(),
        orifice_m: file.orifice_diameter_mm / 1e3,
        mass_kg: file.mass_kg,
        centre: file.centre_mm.map(|mm| Vector::from(mm) / 1e3),
        parts: file
            .part
            .iter()
            .map(|part| ToolPart {
                name: part.name.clone(),
                nozzle: part.nozzle,
                shapes: shapes(&part.shape),
            })
            .collect(),
        air_jet: file
            .air_jet
            .as_ref()
            .map(|jet| Jet { speed_m_s: triple(jet.speed_m_s), reach_m: jet.reach_mm / 1e3 }),
        air_nozzles: file
            .air_nozzle
            .iter()
            .map(|nozzle| AirNozzle {
                at: Point::from(nozzle.at_mm.map(|mm| mm / 1e3)),
                along: Vector::from(nozzle.along).normalize(),
                bore_m: nozzle.bore_mm / 1e3,
                exit_m_s: triple(nozzle.exit_m_s),
            })
            .collect(),
        lamps: lamps(&file.lamp),
        light_ring: file.light_ring.as_ref().map(|ring| LightRing {
            leds: ring.leds,
            distance_m: ring.distance_mm / 1e3,
            angle_rad: ring.angle_deg.to_radians(),
            intensity_w_sr: triple(ring.intensity_w_sr),
            full_angle_rad: ring.full_angle_deg.to_radians(),
            shadow_m: ring.shadow_mm / 1e3,
            aim_m: ring.aim_mm.unwrap_or(ring.shadow_mm) / 1e3,
        }),
    }
}

fn lamps(files: &[LampFile]) -> Vec<Lamp> {
    let lamp = |file: &LampFile| Lamp {
        at: Point::from(file.at_mm.map(|mm| mm / 1e3)),
        along: Vector::from(file.along).normalize(),
        peak_w_sr: triple(file.intensity_w_sr),
        full_angle_rad: file.full_angle_deg.to_radians(),
    };
    files.iter().map(lamp).collect()
}

fn extruder(file: &CellFile) -> Extruder {
    let file = &file.extruder;
    Extruder {
        speed_m_s: file.speed_mm_s / 1e3,
        diameter_m: file.diameter_mm / 1e3,
        swell: triple(file.swell),
        levels_m3_s: file.levels_mm3_s.iter().map(|level| level / 1e9).collect(),
        approach_m: file.approach_mm / 1e3,
        travel_m_s: file.travel_mm_s / 1e3,
        lag_s: file.lag_s.map(triple),
        mixer_m3: file.mixer_mm3.map(|volume| volume / 1e9),
        nozzle_force_n: triple(file.nozzle_force_n),
    }
}

fn limits(file: &LimitsFile) -> Limits {
    Limits {
        clearance_m: file.clearance_mm / 1e3,
        touch_zone_m: file.touch_zone_mm / 1e3,
        node_miss_m: file.node_miss_mm / 1e3,
        sag_m: file.sag_mm / 1e3,
        joint_margin_rad: file.joint_margin_deg.to_radians(),
        joint_speed_share: file.joint_speed_percent / 100.0,
        condition_number: file.condition_number,
        wrist_rad: file.wrist_deg.to_radians(),
        set_distance_m: file.set_distance_mm / 1e3,
        deflection_m: file.deflection_mm / 1e3,
        strength_share: file.strength_percent / 100.0,
        buckling_factor: file.buckling_factor,
        load_factor: file.load_factor,
        uncured_share: file.uncured_share,
        speed_band: file.speed_band_percent / 100.0,
        torque_share: file.torque_percent / 100.0,
        acceleration_share: file.acceleration_percent / 100.0,
        bead_band: file.bead_band_percent / 100.0,
        draw_ratio: file.draw_ratio,
        tip_dose_share: file.tip_dose_share,
        nozzle_angle_rad: file.nozzle_angle_deg.map(f64::to_radians),
        cycle_time_s: file.cycle_time_s,
    }
}

/// The convex shapes of one shape in a file.
pub(super) fn shapes(file: &ShapeFile) -> Vec<Shape> {
    let point = |mm: &[f64; 3]| Point::from(mm.map(|value| value / 1e3));
    match file {
        ShapeFile::Cone { from_mm, to_mm, radius_from_mm, radius_to_mm } => vec![Shape::Cone {
            from: point(from_mm),
            to: point(to_mm),
            radius_from_m: radius_from_mm / 1e3,
            radius_to_m: radius_to_mm / 1e3,
        }],
        ShapeFile::Capsule { from_mm, to_mm, radius_mm } => {
            vec![Shape::Capsule { a: point(from_mm), b: point(to_mm), radius_m: radius_mm / 1e3 }]
        }
        ShapeFile::Box { size_mm, xyz_mm, rpy_deg } => vec![Shape::Box {
            pose: place(&PoseFile { xyz_mm: *xyz_mm, rpy_deg: *rpy_deg }),
            half_m: Vector::from(*size_mm) / 2e3,
        }],
        ShapeFile::Hull { points_mm } => {
            vec![Shape::Hull { points: points_mm.iter().map(point).collect() }]
        }
        ShapeFile::Ring { radius_mm, tube_radius_mm, z_mm } => {
            ring(radius_mm / 1e3, tube_radius_mm / 1e3, z_mm / 1e3)
        }
    }
}

/// A ring about z as capsules on the sides of a polygon around its centre line.
fn ring(radius_m: f64, tube_radius_m: f64, z_m: f64) -> Vec<Shape> {
    const SIDES: usize = 16;
    let corner = |k: usize| {
        let angle = std::f64::consts::TAU * k as f64 / SIDES as f64;
        Point::new(radius_m * angle.cos(), radius_m * angle.sin(), z_m)
    };
    (0..SIDES)
        .map(|k| Shape::Capsule { a: corner(k), b: corner(k + 1), radius_m: tube_radius_m })
        .collect()
}

fn place(file: &PoseFile) -> Pose {
    pose::from_xyz_rpy(file.xyz_mm.map(|mm| mm / 1e3), file.rpy_deg.map(f64::to_radians))
}

fn triple([nominal, low, high]: [f64; 3]) -> Interval {
    Interval::new(nominal, low, high)
}
