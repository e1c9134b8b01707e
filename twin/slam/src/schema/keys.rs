//! The keys themselves.

use super::{Key, Kind, Range, Rule, Table};

const LENGTH_MM: Range = Range::within(-1e5, 1e5);
const ANGLE_DEG: Range = Range::within(-360.0, 360.0);
/// A micrometre a second is slower than anything prints.
const SPEED: Range = Range::within(1e-3, 1e4);
const LIMIT: Range = Range::positive(1e5);
const JOINT_ROW: Kind = Kind::List(&Kind::Number(LENGTH_MM), 1);
const JOINT_ROWS: Kind = Kind::List(&JOINT_ROW, 1);
const POINT: Kind = Kind::Triple(LENGTH_MM);

const fn required(name: &'static str, kind: Kind, unit: &'static str, doc: &'static str) -> Key {
    Key { name, kind, unit, required: true, default: "", doc }
}

const fn optional(
    name: &'static str,
    kind: Kind,
    unit: &'static str,
    default: &'static str,
    doc: &'static str,
) -> Key {
    Key { name, kind, unit, required: false, default, doc }
}

const fn table(name: &'static str, groups: &'static [&'static [Key]], rule: Rule) -> Table {
    Table { name, groups, rule }
}

/// The whole file.
pub static JOB: Table = table("a job", &[JOB_KEYS], Rule::Free);

const JOB_KEYS: &[Key] = &[
    optional("$schema", Kind::Text, "", "none", "Schema for editors; the twin ignores it."),
    required("slam", Kind::Integer(Range::within(1.0, 1.0)), "", "Version of the format."),
    required("name", Kind::Text, "", "What the job is called."),
    required(
        "cell",
        Kind::Text,
        "",
        "Cell of the library by name, or a path relative to this file.",
    ),
    required("material", Kind::Text, "", "Material of the library by name, or a path."),
    optional(
        "placement",
        Kind::Object(&PLACEMENT),
        "",
        "no offset",
        "Part axes on the cell's bed.",
    ),
    optional(
        "environment",
        Kind::Object(&ENVIRONMENT),
        "",
        "still air at 23 °C",
        "The room's air.",
    ),
    optional("forms", Kind::List(&Kind::Object(&FORM), 0), "", "none", "Bodies to print on."),
    optional("process", Kind::Object(&PROCESS), "", "the cell's", "Process values of all strands."),
    required("strands", Kind::List(&Kind::Object(&STRAND), 1), "", "What is extruded."),
    optional("sequence", Kind::List(&Kind::TextOr(&STEP), 0), "", "strands as listed", "Order."),
    optional("loads", Kind::List(&Kind::Object(&LOAD), 0), "", "none", "Load cases of the part."),
    optional("limits", Kind::Object(&LIMITS), "", "the cell's", "Limits of acceptance."),
    optional(
        "allow",
        Kind::List(&Kind::Object(&ALLOWANCE), 0),
        "",
        "none",
        "Findings that do not make the check fail, though verdict and score count them.",
    ),
];

const PLACEMENT: Table = table("a placement", &[POSE_KEYS], Rule::Free);

const POSE_KEYS: &[Key] = &[
    optional("xyz_mm", POINT, "mm", "[0, 0, 0]", "Offset."),
    optional("rpy_deg", Kind::Triple(ANGLE_DEG), "°", "[0, 0, 0]", "Rotation, fixed axes x, y, z."),
];

const ENVIRONMENT: Table = table(
    "an environment",
    &[&[
        optional(
            "air_c",
            Kind::Number(Range::within(-60.0, 400.0)),
            "°C",
            "23",
            "Air temperature.",
        ),
        optional("air_m_s", Kind::Number(Range::within(0.0, 100.0)), "m/s", "0", "Draught."),
    ]],
    Rule::Free,
);

const FORM: Table = table(
    "a form",
    &[
        &[
            required("id", Kind::Text, "", "Name that strands and releases refer to."),
            required("mesh", Kind::Text, "", "STL or OBJ file in mm, relative to this file."),
        ],
        POSE_KEYS,
        &[optional(
            "adhesion_mpa",
            Kind::Number(Range::within(0.0, 1e3)),
            "MPa",
            "the bed's",
            "Hold of the deposit on the form.",
        )],
    ],
    Rule::Free,
);

const PROCESS: Table = table("a process", &[PROCESS_KEYS], Rule::Free);

const PROCESS_KEYS: &[Key] = &[
    optional("speed_mm_s", Kind::Number(SPEED), "mm/s", "the cell's", "Asked TCP speed."),
    optional("flow", Kind::Object(&FLOW), "", "the cell's bead", "What the extruder is told."),
    optional("prime_s", SECONDS, "s", "0", "Extrusion at rest before the strand starts."),
    optional("lights_after_mm", SPAN_MM, "mm", "0", "Length printed before the lights go on."),
    optional("overrun_mm", SPAN_MM, "mm", "0", "Length travelled past the end of the strand."),
    optional("dwell_s", SECONDS, "s", "0", "Rest at the end of the strand."),
    optional(
        "second_pass_mm_s",
        Kind::Number(SPEED),
        "mm/s",
        "no second pass",
        "Speed of a second pass with the lights on and no extrusion.",
    ),
    optional(
        "post_cure_j_cm2",
        Kind::Number(Range::positive(1e6)),
        "J/cm²",
        "no post-cure",
        "Dose of a post-cure from all around, once all is printed.",
    ),
    optional("threads", Kind::Object(&THREADS), "", "none", "Thin threads knotted to the strand."),
    optional("approach_mm", SPAN_MM, "mm", "the cell's", "Length of the straight approach."),
    optional("retract_mm", SPAN_MM, "mm", "the cell's", "Length of the straight retract."),
    optional("orientation", Kind::Object(&ORIENTATION), "", "vertical", "Nozzle orientation."),
    optional(
        "interpolation",
        Kind::Choice(&["linear", "joint"]),
        "",
        "linear",
        "How the controller moves between points.",
    ),
];

const SECONDS: Kind = Kind::Number(Range::within(0.0, 86_400.0));
const SPAN_MM: Kind = Kind::Number(Range::within(0.0, 1e5));
const FLOW_KEYS: &[&str] = &["diameter_mm", "rate_mm3_s", "level"];

const FLOW: Table = table(
    "a flow",
    &[&[
        optional("diameter_mm", Kind::Number(Range::positive(200.0)), "mm", "none", "Bead."),
        optional("rate_mm3_s", Kind::Number(Range::positive(1e7)), "mm³/s", "none", "Volume flow."),
        optional(
            "level",
            Kind::Integer(Range::within(1.0, 1000.0)),
            "",
            "none",
            "One of the cell's flow levels, counted from 1.",
        ),
    ]],
    Rule::OneOf(FLOW_KEYS),
);

const THREADS: Table = table(
    "threads",
    &[&[
        required("count", Kind::Integer(Range::within(3.0, 12.0)), "", "How many threads."),
        required("diameter_mm", Kind::Number(Range::positive(200.0)), "mm", "Diameter of one."),
        required("pitch_mm", Kind::Number(Range::positive(1e4)), "mm", "From knot to knot."),
        required(
            "sweep_mm",
            Kind::Number(Range::within(0.0, 1e3)),
            "mm",
            "Farthest from the strand's axis to theirs, between knots.",
        ),
    ]],
    Rule::Free,
);

const ORIENTATION: Table = table(
    "an orientation",
    &[&[
        optional(
            "follow",
            Kind::Choice(&["tangent", "vertical", "surface_normal", "given"]),
            "",
            "given where the strand has directions, else vertical",
            "What the nozzle's axis follows.",
        ),
        optional("tilt", Kind::Choice(&["cone", "per-axis"]), "", "cone", "How tilt is bounded."),
        optional(
            "tilt_from_deg",
            Kind::Number(Range::within(0.0, 90.0)),
            "°",
            "20",
            "Inclination of the strand up to which the nozzle stays vertical.",
        ),
        optional(
            "tilt_max_deg",
            Kind::Number(Range::within(0.0, 180.0)),
            "°",
            "40",
            "Largest tilt from the vertical.",
        ),
        optional(
            "tilt_free_deg",
            Kind::Number(Range::within(0.0, 90.0)),
            "°",
            "0",
            "How far the twin may lean the nozzle off the axis it follows, within the tilt's bound.",
        ),
        optional(
            "spin",
            Kind::WordOrNumber("free", ANGLE_DEG),
            "°",
            "free",
            "Rotation about the nozzle's axis: free, or held at an angle.",
        ),
    ]],
    Rule::Free,
);

const STRAND: Table = table("a strand", &[STRAND_KEYS, PROCESS_KEYS], Rule::Free);

const STRAND_KEYS: &[Key] = &[
    required("id", Kind::Text, "", "Name, unique in the job."),
    required("points_mm", Kind::List(&POINT, 2), "mm", "Polyline in part axes."),
    optional(
        "directions",
        Kind::List(&Kind::Triple(Range::within(-1e6, 1e6)), 2),
        "",
        "from orientation",
        "Nozzle axis at each point, pointing out of the nozzle.",
    ),
    optional("joints", JOINT_ROWS, "° or mm", "found by the twin", "Joint path, a row per point."),
    optional(
        "times_s",
        Kind::List(&Kind::Number(Range::within(0.0, 1e7)), 2),
        "s",
        "from speed",
        "Given time law, one time per point.",
    ),
    optional("on", Kind::Text, "", "air", "What it rests on: air, bed or the id of a form."),
    optional("start", Kind::Object(&END), "", "found from geometry", "Its first end."),
    optional("end", Kind::Object(&END), "", "found from geometry", "Its last end."),
    optional("profile", Kind::List(&Kind::Object(&PROFILE), 0), "", "none", "Changes along it."),
    optional("events", Kind::List(&Kind::Object(&EVENT), 0), "", "none", "Switches along it."),
];

const END: Table = table(
    "an end",
    &[&[
        optional(
            "join",
            Kind::Text,
            "",
            "found from geometry",
            "What it is joined to: bed, free, or the id of a form or strand.",
        ),
        optional("dwell_s", SECONDS, "s", "start 0, end the strand's", "Rest at this end."),
    ]],
    Rule::Free,
);

const PROFILE: Table = table(
    "a profile point",
    &[&[
        required("at_mm", SPAN_MM, "mm", "Arc length from the start."),
        optional("speed_mm_s", Kind::Number(SPEED), "mm/s", "unchanged", "TCP speed from here on."),
        optional(
            "flow_mm3_s",
            Kind::Number(Range::within(0.0, 1e7)),
            "mm³/s",
            "unchanged",
            "Volume flow from here on.",
        ),
    ]],
    Rule::AnyOf(&["speed_mm_s", "flow_mm3_s"]),
);

const EVENT: Table = table(
    "an event",
    &[&[
        optional("at_mm", Kind::Number(LENGTH_MM), "mm", "none", "Arc length where it happens."),
        optional("at_s", Kind::Number(Range::within(-1e6, 1e6)), "s", "none", "Time it happens."),
        optional(
            "from",
            Kind::Choice(&["start", "end"]),
            "",
            "start",
            "Where at_mm and at_s count from; before the end is negative.",
        ),
        required("set", Kind::Text, "", "flow, light, air, heater or an I/O name of the cell."),
        required("to", Kind::Choice(&["on", "off"]), "", "New state."),
    ]],
    Rule::OneOf(&["at_mm", "at_s"]),
);

const STEP: Table = table(
    "a step",
    &[&[
        optional("move", Kind::Object(&MOVE), "", "none", "Follow a joint path."),
        optional("wait_s", Kind::Number(Range::within(0.0, 1e6)), "s", "none", "Wait."),
        optional("release", Kind::Text, "", "none", "Take the part off the form of this id."),
        optional("checkpoint", Kind::Text, "", "none", "A place where printing may be resumed."),
    ]],
    Rule::OneOf(&["move", "wait_s", "release", "checkpoint"]),
);

const MOVE: Table = table(
    "a move",
    &[&[required("joints", JOINT_ROWS, "° or mm", "Joint path, base to tip.")]],
    Rule::Free,
);

const LOAD: Table = table(
    "a load case",
    &[&[
        required("name", Kind::Text, "", "What it is called."),
        required("supports", Kind::List(&Kind::Object(&SUPPORT), 1), "", "Held points."),
        optional(
            "forces",
            Kind::List(&Kind::Object(&FORCE), 0),
            "",
            "self-weight alone",
            "Forces.",
        ),
    ]],
    Rule::Free,
);

const SUPPORT: Table = table(
    "a support",
    &[&[
        required("at_mm", POINT, "mm", "Place; the nearest node or member is taken."),
        required("fix", Kind::Letters("xyzr"), "", "Held translations x, y, z and rotations r."),
    ]],
    Rule::Free,
);

const FORCE: Table = table(
    "a force",
    &[&[
        required("at_mm", POINT, "mm", "Place; the nearest node or member is taken."),
        required("force_n", Kind::Triple(Range::within(-1e9, 1e9)), "N", "Force in part axes."),
    ]],
    Rule::Free,
);

const LIMITS: Table = table(
    "a limits object",
    &[&[
        optional("clearance_mm", Kind::Number(LIMIT), "mm", "the cell's", "Least clearance."),
        optional("node_miss_mm", Kind::Number(LIMIT), "mm", "the cell's", "Largest node miss."),
        optional("sag_mm", Kind::Number(LIMIT), "mm", "the cell's", "Largest sag of a strand."),
        optional(
            "deflection_mm",
            Kind::Number(LIMIT),
            "mm",
            "the cell's",
            "Largest deflection of the finished part under its loads.",
        ),
        optional(
            "strength_percent",
            Kind::Number(Range::positive(100.0)),
            "%",
            "the cell's",
            "Largest share of the strength of a member or node while printing.",
        ),
        optional(
            "buckling_factor",
            Kind::Number(LIMIT),
            "",
            "the cell's",
            "Least factor on what the growing frame carries at which it buckles.",
        ),
        optional(
            "load_factor",
            Kind::Number(LIMIT),
            "",
            "the cell's",
            "Least factor on the loads at which the finished part yields or collapses.",
        ),
        optional(
            "speed_band_percent",
            Kind::Number(Range::positive(100.0)),
            "%",
            "the cell's",
            "Largest difference of the TCP's speed from the asked one.",
        ),
        optional(
            "cycle_time_s",
            Kind::Number(Range::positive(1e7)),
            "s",
            "the cell's, if it has one",
            "Longest the program may take.",
        ),
    ]],
    Rule::Free,
);

const ALLOWANCE: Table = table(
    "an allowance",
    &[&[
        required("code", Kind::Text, "", "Code of the finding, such as C201."),
        optional("strand", Kind::Text, "", "any place", "Id of the strand it must be on."),
        required("reason", Kind::Text, "", "Why it is let pass."),
        required("until", Kind::Date, "", "Last day it is let pass, as 2027-01-31."),
    ]],
    Rule::Free,
);

/// Objects below the top one, to tell an author where a key belongs.
pub(crate) static NAMED_OBJECTS: &[(&str, &Table)] = &[
    ("placement", &PLACEMENT),
    ("environment", &ENVIRONMENT),
    ("process", &PROCESS),
    ("flow", &FLOW),
    ("orientation", &ORIENTATION),
    ("limits", &LIMITS),
    ("strands", &STRAND),
    ("start", &END),
    ("events", &EVENT),
    ("profile", &PROFILE),
    ("loads", &LOAD),
    ("forms", &FORM),
    ("allow", &ALLOWANCE),
];

/// Unit suffixes of keys: suffix, dimension, unit as people write it. Longest match wins.
pub(crate) static SUFFIXES: &[(&str, &str, &str)] = &[
    ("_mm3_s", "flow", "mm³/s"),
    ("_cm3_s", "flow", "cm³/s"),
    ("_ml_min", "flow", "ml/min"),
    ("_mm_min", "speed", "mm/min"),
    ("_m_min", "speed", "m/min"),
    ("_mm_s", "speed", "mm/s"),
    ("_m_s", "speed", "m/s"),
    ("_um", "length", "µm"),
    ("_mm", "length", "mm"),
    ("_cm", "length", "cm"),
    ("_m", "length", "m"),
    ("_in", "length", "in"),
    ("_ms", "time", "ms"),
    ("_min", "time", "min"),
    ("_s", "time", "s"),
    ("_h", "time", "h"),
    ("_deg", "angle", "degrees"),
    ("_rad", "angle", "radians"),
    ("_c", "temperature", "°C"),
    ("_k", "temperature", "K"),
    ("_f", "temperature", "°F"),
    ("_gpa", "pressure", "GPa"),
    ("_mpa", "pressure", "MPa"),
    ("_kpa", "pressure", "kPa"),
    ("_pa", "pressure", "Pa"),
    ("_kn", "force", "kN"),
    ("_n", "force", "N"),
];
