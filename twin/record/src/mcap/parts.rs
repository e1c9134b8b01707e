//! The small messages that Foxglove's larger ones are made of.

use sim::pose::{Point, Pose, Vector};

use super::story::rgb;
use super::wire::Proto;

/// `google.protobuf.Timestamp` or `Duration`, of nanoseconds.
pub(super) fn stamp(ns: u64) -> Proto {
    Proto::default().uint(1, ns / 1_000_000_000).uint(2, ns % 1_000_000_000)
}

/// `foxglove.Vector3`.
pub(super) fn vector(v: &Vector) -> Proto {
    Proto::default().double(1, v.x).double(2, v.y).double(3, v.z)
}

/// `foxglove.Point3`.
pub(super) fn point(p: &Point) -> Proto {
    vector(&p.coords)
}

/// `foxglove.Quaternion`.
pub(super) fn turn(pose: &Pose) -> Proto {
    let q = pose.rotation.coords;
    Proto::default().double(1, q.x).double(2, q.y).double(3, q.z).double(4, q.w)
}

/// `foxglove.Pose`.
pub(super) fn pose(pose: &Pose) -> Proto {
    Proto::default().message(1, vector(&pose.translation.vector)).message(2, turn(pose))
}

/// `foxglove.Color` of sRGB.
pub(super) fn colour(colour: u32, alpha: f64) -> Proto {
    let [r, g, b] = rgb(colour);
    Proto::default().double(1, r).double(2, g).double(3, b).double(4, alpha)
}

/// `foxglove.KeyValuePair`.
pub(super) fn pair(key: &str, value: &str) -> Proto {
    Proto::default().text(1, key).text(2, value)
}

/// `foxglove.SceneEntity` without its primitives, fixed to its frame.
pub(super) fn entity(ns: u64, frame: &str, id: &str) -> Proto {
    Proto::default()
        .message(1, stamp(ns))
        .text(2, frame)
        .text(3, id)
        .message(4, stamp(0))
        .uint(5, 1)
}

/// `foxglove.SceneUpdate` of entities.
pub(super) fn update(entities: impl IntoIterator<Item = Proto>) -> Vec<u8> {
    Proto::default().messages(2, entities).into_bytes()
}
