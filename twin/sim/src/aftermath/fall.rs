//! Rigid pieces under gravity, by rapier3d in millimetres.

use super::pieces::Loose;
use super::{Bit, Failing, Ground, Mesh};
use crate::parry;
use crate::pose::{Point, Pose, Vector};
use rapier3d::math::Vector as RapierVector;
use rapier3d::prelude::{
    ColliderBuilder, GenericJointBuilder, JointAxesMask, PhysicsWorld, RigidBodyBuilder,
    RigidBodyHandle, SharedShape,
};

/// rapier's step, s: at the 2 m/s of a fall from 0.2 m a piece moves 2 mm, about a bead.
pub(super) const STEP_S: f64 = 1e-3;
/// Steps between moments that are told.
const TOLD_STEPS: usize = 20;
/// Moments after the first.
const TOLD: usize = 50;
/// Friction of beads on beads and bed: plastics on plastics are about 0.2 to 0.5.
const FRICTION: f32 = 0.4;
/// Overlap that rapier leaves alone, mm: a hundredth of a bead.
const SLOP_MM: f32 = 0.01;
/// Natural frequency of a contact, Hz: rapier's are springs, and at its own 60 Hz a piece sinks 0.1 mm under
/// its weight; at this one a hundredth of that.
const CONTACT_HZ: f32 = 600.0;
/// A piece that moves less than this between two moments is at rest, m.
const RESTS_M: f64 = 2e-6;
/// Moments that nothing is taken to be at rest before: 0.1 s, half a millimetre of lean.
const AWAKE: usize = 5;
/// How fast rapier may part what overlaps, mm/s: beads that touch as printed then slide apart and
/// do not burst.
const PARTING_MM_S: f32 = 50.0;
/// Contacts are made this far ahead, mm: above what the fastest piece moves in a step.
const AHEAD_MM: f32 = 5.0;
/// Gravity leans by this, rad, so that nothing stands on its tip as only rigid bodies without a
/// draught can; a part in a thousand of the fall goes to the side.
const LEANS_RAD: f64 = 1e-3;
/// Thinnest body of a bead, m: rapier needs some.
const THINNEST_M: f64 = 1e-5;

/// Moments that are told, s.
pub(super) fn times_s() -> Vec<f64> {
    (0..=TOLD).map(|k| (k * TOLD_STEPS) as f64 * STEP_S).collect()
}

/// `now_from_printed` of each piece at each moment.
pub(super) fn fall(
    failing: &Failing,
    ground: &Ground,
    loose: &[Loose],
    rest: &[Bit],
) -> Vec<Vec<Pose>> {
    let mut told: Vec<Vec<Pose>> = loose.iter().map(|_| Vec::with_capacity(TOLD + 1)).collect();
    if loose.is_empty() {
        return told;
    }
    let mut world = still_world(failing.gravity_m_s2, ground, rest);
    let earth = world.insert_body(RigidBodyBuilder::fixed());
    let bodies: Vec<(RigidBodyHandle, Vector)> =
        loose.iter().map(|piece| add_piece(&mut world, piece, ground, failing, earth)).collect();
    for moment in 0..=TOLD {
        for (poses, (body, middle)) in told.iter_mut().zip(&bodies) {
            let now = world.bodies.get(*body).map(|body| parry::from_pose(body.position()));
            let now = now.map(|pose| pose * Pose::translation(-middle.x, -middle.y, -middle.z));
            let sound = now.filter(|pose| pose.to_homogeneous().iter().all(|x| x.is_finite()));
            let last = poses.last().copied().unwrap_or_else(Pose::identity);
            poses.push(if moment == 0 { Pose::identity() } else { sound.unwrap_or(last) });
        }
        if moment > AWAKE && told.iter().zip(loose).all(|(poses, piece)| is_at_rest(poses, piece)) {
            break;
        }
        for _ in 0..if moment < TOLD { TOLD_STEPS } else { 0 } {
            world.step();
        }
    }
    for poses in &mut told {
        let last = poses.last().copied().unwrap_or_else(Pose::identity);
        poses.resize(TOLD + 1, last);
    }
    told
}

/// Whether a piece has not moved between the last two moments.
fn is_at_rest(poses: &[Pose], piece: &Loose) -> bool {
    let [.., before, now] = poses else { return false };
    let mut ends = piece.bits.iter().flat_map(|bit| bit.ends);
    ends.all(|end| (now * end - before * end).norm() < RESTS_M)
}

/// Gravity, bed, forms and what stands.
fn still_world(gravity_m_s2: Vector, ground: &Ground, rest: &[Bit]) -> PhysicsWorld {
    let mut world = PhysicsWorld::new();
    let strength_m_s2 = gravity_m_s2.norm();
    // along no axis, so that a plane frame leans out of its plane
    let aside = match gravity_m_s2.z.abs() > 0.5 * strength_m_s2 {
        true => Vector::new(0.6, 0.8, 0.0),
        false => Vector::z(),
    };
    world.gravity = parry::vector(&(gravity_m_s2 + aside * (strength_m_s2 * LEANS_RAD)));
    let parameters = &mut world.integration_parameters;
    parameters.dt = STEP_S as f32;
    parameters.contact_softness.natural_frequency = CONTACT_HZ;
    parameters.static_contact_softness.natural_frequency = CONTACT_HZ;
    parameters.normalized_allowed_linear_error = SLOP_MM;
    parameters.normalized_prediction_distance = 10.0 * SLOP_MM;
    parameters.normalized_max_corrective_velocity = PARTING_MM_S;
    parameters.normalized_max_linear_velocity = f32::MAX;
    let up = ground.part_from_bed * Vector::z();
    let bed = SharedShape::halfspace(
        RapierVector::new(up.x as f32, up.y as f32, up.z as f32).normalize(),
    );
    let at = parry::vector(&ground.part_from_bed.translation.vector);
    world.insert_collider(ColliderBuilder::new(bed).translation(at).friction(FRICTION), None);
    for form in ground.forms {
        if let Some(form) = body_of(form) {
            world.insert_collider(form.friction(FRICTION), None);
        }
    }
    if !rest.is_empty() {
        let shapes = rest.iter().map(|bit| capsule(bit, bit.radius_m, &Vector::zeros()));
        world.insert_collider(ColliderBuilder::compound(shapes.collect()).friction(FRICTION), None);
    }
    world
}

/// A form as triangles; none where rapier cannot use it.
fn body_of(form: &Mesh) -> Option<ColliderBuilder> {
    let vertices: Vec<RapierVector> = form.vertices.iter().map(parry::point).collect();
    if vertices.is_empty() || form.triangles.is_empty() {
        return None;
    }
    ColliderBuilder::trimesh(vertices, form.triangles.to_vec()).ok()
}

/// A piece about its middle, and that middle; supports that only guide it become joints.
fn add_piece(
    world: &mut PhysicsWorld,
    piece: &Loose,
    ground: &Ground,
    failing: &Failing,
    earth: RigidBodyHandle,
) -> (RigidBodyHandle, Vector) {
    let ends = piece.bits.iter().flat_map(|bit| bit.ends);
    let middle = ends.fold(Vector::zeros(), |sum, end| sum + end.coords);
    let middle = middle / (2.0 * piece.bits.len() as f64);
    let shapes = piece.bits.iter().map(|bit| capsule(bit, room_m(bit, ground), &middle));
    let body = RigidBodyBuilder::dynamic()
        .translation(parry::vector(&middle))
        .can_sleep(false)
        .soft_ccd_prediction(AHEAD_MM);
    let collider = ColliderBuilder::compound(shapes.collect()).friction(FRICTION);
    let (body, _) = world.insert(body, collider);
    for guide in &piece.guides {
        let node = failing.frame.nodes()[guide.node].coords;
        let joint = GenericJointBuilder::new(mask(guide.fixed))
            .local_anchor1(parry::vector(&node))
            .local_anchor2(parry::vector(&(node - middle)));
        world.insert_impulse_joint(earth, body, joint);
    }
    (body, middle)
}

/// Radius of a bead, no larger than its height over the bed: one that was pressed flat is not thrown up.
fn room_m(bit: &Bit, ground: &Ground) -> f64 {
    let height_m = |end: &Point| ground.part_from_bed.inverse_transform_point(end).z;
    let least_m = height_m(&bit.ends[0]).min(height_m(&bit.ends[1]));
    bit.radius_m.min(least_m).max(THINNEST_M)
}

fn capsule(bit: &Bit, radius_m: f64, middle: &Vector) -> (rapier3d::math::Pose, SharedShape) {
    let [a, b] = bit.ends.map(|end| parry::vector(&(end.coords - middle)));
    let shape = SharedShape::capsule(a, b, parry::length(radius_m.max(THINNEST_M)));
    (rapier3d::math::Pose::IDENTITY, shape)
}

fn mask(fixed: [bool; 6]) -> JointAxesMask {
    let axes = [
        JointAxesMask::LIN_X,
        JointAxesMask::LIN_Y,
        JointAxesMask::LIN_Z,
        JointAxesMask::ANG_X,
        JointAxesMask::ANG_Y,
        JointAxesMask::ANG_Z,
    ];
    let chosen = axes.into_iter().zip(fixed).filter(|(_, fixed)| *fixed);
    chosen.fold(JointAxesMask::empty(), |all, (axis, _)| all | axis)
}
