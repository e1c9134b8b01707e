//! The messages of a recording: those of Foxglove with their published field numbers, and our own.
//!
//! Whole messages are described, also fields that are never written, so that a reader who knows them finds no difference.

use super::descriptor::{Enum, Field, Kind, Label, Message};

/// All of them.
pub(super) const ALL: &[&Message] = &[
    &TIMESTAMP,
    &DURATION,
    &VECTOR3,
    &POINT3,
    &QUATERNION,
    &POSE,
    &COLOR,
    &KEY_VALUE,
    &FRAME_TRANSFORM,
    &FRAME_TRANSFORMS,
    &JOINT_STATE,
    &JOINT_STATES,
    &ARROW,
    &CUBE,
    &SPHERE,
    &CYLINDER,
    &LINE,
    &TRIANGLES,
    &TEXT,
    &MODEL,
    &DELETION,
    &ENTITY,
    &UPDATE,
    &EVENT,
    &LOG,
    &IMAGE,
    &JOINT_SHARE,
    &METRICS,
    &STATE,
];

const STAMP: Kind = Kind::Message("google.protobuf.Timestamp");
const SPAN: Kind = Kind::Message("google.protobuf.Duration");
const PLACE: Kind = Kind::Message("foxglove.Pose");
const SIZE: Kind = Kind::Message("foxglove.Vector3");
const POINT: Kind = Kind::Message("foxglove.Point3");
const TURN: Kind = Kind::Message("foxglove.Quaternion");
const TINT: Kind = Kind::Message("foxglove.Color");
const PAIR: Kind = Kind::Message("foxglove.KeyValuePair");

const fn once(number: u32, name: &'static str, kind: Kind) -> Field {
    Field { name, number, kind, label: Label::Once }
}

const fn many(number: u32, name: &'static str, kind: Kind) -> Field {
    Field { name, number, kind, label: Label::Repeated }
}

const fn maybe(number: u32, name: &'static str) -> Field {
    Field { name, number, kind: Kind::Double, label: Label::Optional }
}

const fn double(number: u32, name: &'static str) -> Field {
    once(number, name, Kind::Double)
}

const fn message(name: &'static str, fields: &'static [Field]) -> Message {
    Message { name, fields, enums: &[] }
}

const fn with_enum(
    name: &'static str,
    fields: &'static [Field],
    enums: &'static [Enum],
) -> Message {
    Message { name, fields, enums }
}

const SECONDS: &[Field] = &[once(1, "seconds", Kind::Int64), once(2, "nanos", Kind::Int32)];
const TIMESTAMP: Message = message("google.protobuf.Timestamp", SECONDS);
const DURATION: Message = message("google.protobuf.Duration", SECONDS);

const XYZ: &[Field] = &[double(1, "x"), double(2, "y"), double(3, "z")];
const VECTOR3: Message = message("foxglove.Vector3", XYZ);
const POINT3: Message = message("foxglove.Point3", XYZ);
const QUATERNION: Message = message(
    "foxglove.Quaternion",
    &[double(1, "x"), double(2, "y"), double(3, "z"), double(4, "w")],
);
const POSE: Message =
    message("foxglove.Pose", &[once(1, "position", SIZE), once(2, "orientation", TURN)]);
const COLOR: Message =
    message("foxglove.Color", &[double(1, "r"), double(2, "g"), double(3, "b"), double(4, "a")]);
const KEY_VALUE: Message =
    message("foxglove.KeyValuePair", &[once(1, "key", Kind::Text), once(2, "value", Kind::Text)]);

const FRAME_TRANSFORM: Message = message(
    "foxglove.FrameTransform",
    &[
        once(1, "timestamp", STAMP),
        once(2, "parent_frame_id", Kind::Text),
        once(3, "child_frame_id", Kind::Text),
        once(4, "translation", SIZE),
        once(5, "rotation", TURN),
    ],
);
const FRAME_TRANSFORMS: Message = message(
    "foxglove.FrameTransforms",
    &[many(1, "transforms", Kind::Message("foxglove.FrameTransform"))],
);
const JOINT_STATE: Message = message(
    "foxglove.JointState",
    &[
        once(1, "name", Kind::Text),
        maybe(2, "position"),
        maybe(3, "velocity"),
        maybe(4, "acceleration"),
        maybe(5, "effort"),
    ],
);
const JOINT_STATES: Message = message(
    "foxglove.JointStates",
    &[once(1, "timestamp", STAMP), many(2, "joints", Kind::Message("foxglove.JointState"))],
);

const ARROW: Message = message(
    "foxglove.ArrowPrimitive",
    &[
        once(1, "pose", PLACE),
        double(2, "shaft_length"),
        double(3, "shaft_diameter"),
        double(4, "head_length"),
        double(5, "head_diameter"),
        once(6, "color", TINT),
    ],
);
const SIZED: &[Field] = &[once(1, "pose", PLACE), once(2, "size", SIZE), once(3, "color", TINT)];
const CUBE: Message = message("foxglove.CubePrimitive", SIZED);
const SPHERE: Message = message("foxglove.SpherePrimitive", SIZED);
const CYLINDER: Message = message(
    "foxglove.CylinderPrimitive",
    &[
        once(1, "pose", PLACE),
        once(2, "size", SIZE),
        double(3, "bottom_scale"),
        double(4, "top_scale"),
        once(5, "color", TINT),
    ],
);
const LINE: Message = with_enum(
    "foxglove.LinePrimitive",
    &[
        once(1, "type", Kind::Enum("Type")),
        once(2, "pose", PLACE),
        double(3, "thickness"),
        once(4, "scale_invariant", Kind::Bool),
        many(5, "points", POINT),
        once(6, "color", TINT),
        many(7, "colors", TINT),
        many(8, "indices", Kind::Fixed32),
    ],
    &[("Type", &[("LINE_STRIP", 0), ("LINE_LOOP", 1), ("LINE_LIST", 2)])],
);
const TRIANGLES: Message = message(
    "foxglove.TriangleListPrimitive",
    &[
        once(1, "pose", PLACE),
        many(2, "points", POINT),
        once(3, "color", TINT),
        many(4, "colors", TINT),
        many(5, "indices", Kind::Fixed32),
    ],
);
const TEXT: Message = message(
    "foxglove.TextPrimitive",
    &[
        once(1, "pose", PLACE),
        once(2, "billboard", Kind::Bool),
        double(3, "font_size"),
        once(4, "scale_invariant", Kind::Bool),
        once(5, "color", TINT),
        once(6, "text", Kind::Text),
    ],
);
const MODEL: Message = message(
    "foxglove.ModelPrimitive",
    &[
        once(1, "pose", PLACE),
        once(2, "scale", SIZE),
        once(3, "color", TINT),
        once(4, "override_color", Kind::Bool),
        once(5, "url", Kind::Text),
        once(6, "media_type", Kind::Text),
        once(7, "data", Kind::Bytes),
    ],
);
const DELETION: Message = with_enum(
    "foxglove.SceneEntityDeletion",
    &[once(1, "timestamp", STAMP), once(2, "type", Kind::Enum("Type")), once(3, "id", Kind::Text)],
    &[("Type", &[("MATCHING_ID", 0), ("ALL", 1)])],
);
const ENTITY: Message = message(
    "foxglove.SceneEntity",
    &[
        once(1, "timestamp", STAMP),
        once(2, "frame_id", Kind::Text),
        once(3, "id", Kind::Text),
        once(4, "lifetime", SPAN),
        once(5, "frame_locked", Kind::Bool),
        many(6, "metadata", PAIR),
        many(7, "arrows", Kind::Message("foxglove.ArrowPrimitive")),
        many(8, "cubes", Kind::Message("foxglove.CubePrimitive")),
        many(9, "spheres", Kind::Message("foxglove.SpherePrimitive")),
        many(10, "cylinders", Kind::Message("foxglove.CylinderPrimitive")),
        many(11, "lines", Kind::Message("foxglove.LinePrimitive")),
        many(12, "triangles", Kind::Message("foxglove.TriangleListPrimitive")),
        many(13, "texts", Kind::Message("foxglove.TextPrimitive")),
        many(14, "models", Kind::Message("foxglove.ModelPrimitive")),
    ],
);
const UPDATE: Message = message(
    "foxglove.SceneUpdate",
    &[
        many(1, "deletions", Kind::Message("foxglove.SceneEntityDeletion")),
        many(2, "entities", Kind::Message("foxglove.SceneEntity")),
    ],
);

const EVENT: Message = message(
    "foxglove.Event",
    &[once(1, "start_time", STAMP), once(2, "end_time", STAMP), many(3, "metadata", PAIR)],
);
const LOG: Message = with_enum(
    "foxglove.Log",
    &[
        once(1, "timestamp", STAMP),
        once(2, "level", Kind::Enum("Level")),
        once(3, "message", Kind::Text),
        once(4, "name", Kind::Text),
        once(5, "file", Kind::Text),
        once(6, "line", Kind::Fixed32),
    ],
    &[(
        "Level",
        &[("UNKNOWN", 0), ("DEBUG", 1), ("INFO", 2), ("WARNING", 3), ("ERROR", 4), ("FATAL", 5)],
    )],
);
const IMAGE: Message = message(
    "foxglove.CompressedImage",
    &[
        once(1, "timestamp", STAMP),
        once(4, "frame_id", Kind::Text),
        once(2, "data", Kind::Bytes),
        once(3, "format", Kind::Text),
    ],
);

const JOINT_SHARE: Message =
    message("twin.JointShare", &[once(1, "name", Kind::Text), maybe(2, "share_of_limit")]);
const METRICS: Message = message(
    "twin.Metrics",
    &[
        once(1, "timestamp", STAMP),
        maybe(2, "speed_m_s"),
        maybe(3, "clearance_m"),
        maybe(4, "temperature_k"),
        maybe(5, "cure"),
        maybe(6, "sag_m"),
        maybe(7, "displacement_m"),
        maybe(8, "buckling_factor"),
        many(9, "joints", Kind::Message("twin.JointShare")),
    ],
);
const STATE: Message = message(
    "twin.State",
    &[
        once(1, "timestamp", STAMP),
        once(2, "phase", Kind::Text),
        once(3, "strand", Kind::Text),
        once(4, "order", Kind::Uint32),
    ],
);
