//! A job as written: the values of `job.slam` with their places, in the units of the file.
//!
//! `None` means the author said nothing; defaults are filled in by `sim::cell::resolve`, which
//! knows the cell. The table of keys with units, defaults and ranges is [`crate::schema`].

use crate::diagnostic::{Span, Spanned};

/// Three numbers with the place of the whole triple.
pub type Triple = Spanned<[f64; 3]>;

/// A whole `job.slam`.
#[derive(Debug, Clone, PartialEq)]
pub struct Document {
    /// What the author calls the job.
    pub name: Spanned<String>,
    /// A cell of the library by name, or a path relative to the job's file.
    pub cell: Spanned<String>,
    /// A material of the library by name, or a path relative to the job's file.
    pub material: Spanned<String>,
    /// Part axes in the axes of the cell's bed.
    pub placement: Placement,
    /// The air around the print.
    pub environment: Environment,
    /// Bodies the print is laid on.
    pub forms: Vec<Form>,
    /// Process values for strands that do not say otherwise.
    pub process: Process,
    /// What is extruded, each in one go.
    pub strands: Vec<Strand>,
    /// The order of events; `None`: the strands as listed.
    pub sequence: Option<Vec<Spanned<Step>>>,
    /// Loads of the finished part.
    pub loads: Vec<LoadCase>,
    /// Limits of acceptance that differ from the cell's.
    pub limits: Limits,
    /// Findings that are known and let pass for a while.
    pub allow: Vec<Allowance>,
}

/// A pose in file units: offset in mm, fixed-axes x, y, z rotation in degrees as in URDF.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Placement {
    /// Offset, mm.
    pub xyz_mm: Option<Triple>,
    /// Rotation, degrees.
    pub rpy_deg: Option<Triple>,
}

/// Air temperature and draught.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Environment {
    /// Air temperature, °C.
    pub air_c: Option<Spanned<f64>>,
    /// Speed of the room's air, m/s; the tool's own jets stand in the cell.
    pub air_m_s: Option<Spanned<f64>>,
}

/// A body the print is laid on and released from.
#[derive(Debug, Clone, PartialEq)]
pub struct Form {
    /// Name that strands and releases refer to.
    pub id: Spanned<String>,
    /// Mesh file relative to the job's file, in mm.
    pub mesh: Spanned<String>,
    /// Mesh axes in part axes.
    pub placement: Placement,
    /// Hold of the deposit on the form, MPa.
    pub adhesion_mpa: Option<Spanned<f64>>,
}

/// What the extruder is told.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Flow {
    /// A bead of this diameter at the asked speed, mm.
    DiameterMm(f64),
    /// A volume flow, mm³/s.
    RateMm3S(f64),
    /// One of the cell's flow levels, counted from 1.
    Level(u32),
}

/// Where the nozzle points.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Follow {
    /// Along the strand, within the tilt's limits.
    Tangent,
    /// Straight down on the bed.
    Vertical,
    /// Against the normal of the form below.
    SurfaceNormal,
    /// As the strand's `directions` say.
    Given,
}

/// How the tilt from the vertical is bounded.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Tilt {
    /// One bound on the angle from the vertical.
    Cone,
    /// Kirkman's: the tilts about the bed's x and y apart, each by his curve.
    PerAxis,
}

/// What happens to the rotation about the nozzle's own axis.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Spin {
    /// The twin may choose it.
    Free,
    /// Held at this angle from the bed's x axis, degrees.
    HeldDeg(f64),
}

/// How the nozzle is oriented along a strand.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Orientation {
    /// What the axis follows.
    pub follow: Option<Spanned<Follow>>,
    /// Shape of the tilt bound.
    pub tilt: Option<Spanned<Tilt>>,
    /// Inclination of the strand up to which the nozzle stays vertical, degrees.
    pub tilt_from_deg: Option<Spanned<f64>>,
    /// Largest tilt, degrees.
    pub tilt_max_deg: Option<Spanned<f64>>,
    /// How far the twin may lean the nozzle off the axis it follows, degrees.
    pub tilt_free_deg: Option<Spanned<f64>>,
    /// Rotation about the nozzle's axis.
    pub spin: Option<Spanned<Spin>>,
}

/// How the controller moves between points.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Interpolation {
    /// Straight lines of the TCP.
    Linear,
    /// Straight lines in joint space.
    Joint,
}

/// Thin threads that leave the strand and come back to it in knots.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Threads {
    /// How many.
    pub count: u32,
    /// Diameter of one, mm.
    pub diameter_mm: f64,
    /// From one knot to the next, mm.
    pub pitch_mm: f64,
    /// Farthest from the strand's axis to theirs, mm.
    pub sweep_mm: f64,
}

/// Process values; a strand may override any of them.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Process {
    /// Asked TCP speed, mm/s.
    pub speed_mm_s: Option<Spanned<f64>>,
    /// What the extruder is told.
    pub flow: Option<Spanned<Flow>>,
    /// Extrusion at rest before the strand starts, s.
    pub prime_s: Option<Spanned<f64>>,
    /// Length printed before the lights go on, mm.
    pub lights_after_mm: Option<Spanned<f64>>,
    /// Length travelled past the end of the strand, mm.
    pub overrun_mm: Option<Spanned<f64>>,
    /// Rest at the end of the strand, s.
    pub dwell_s: Option<Spanned<f64>>,
    /// Speed of a second pass with the lights on and no extrusion, mm/s.
    pub second_pass_mm_s: Option<Spanned<f64>>,
    /// Dose of a post-cure from all around, once all is printed, J/cm².
    pub post_cure_j_cm2: Option<Spanned<f64>>,
    /// Thin threads laid around the strand.
    pub threads: Option<Threads>,
    /// Length of the straight approach, mm.
    pub approach_mm: Option<Spanned<f64>>,
    /// Length of the straight retract, mm.
    pub retract_mm: Option<Spanned<f64>>,
    /// Nozzle orientation.
    pub orientation: Orientation,
    /// Motion between points.
    pub interpolation: Option<Spanned<Interpolation>>,
}

/// What a strand rests on while it is printed.
#[derive(Debug, Clone, PartialEq)]
pub enum On {
    /// Nothing but its ends.
    Air,
    /// The bed.
    Bed,
    /// The form of this id.
    Form(String),
}

/// What an end of a strand is joined to.
#[derive(Debug, Clone, PartialEq)]
pub enum Join {
    /// The bed.
    Bed,
    /// Nothing.
    Free,
    /// The form or strand of this id.
    Id(String),
}

/// One end of a strand.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct End {
    /// What it is joined to; `None`: found from the geometry.
    pub join: Option<Spanned<Join>>,
    /// Rest at this end, s.
    pub dwell_s: Option<Spanned<f64>>,
}

/// A change of speed or flow along a strand, valid from `at_mm` on.
#[derive(Debug, Clone, PartialEq)]
pub struct ProfilePoint {
    /// Arc length from the start, mm.
    pub at_mm: Spanned<f64>,
    /// TCP speed, mm/s.
    pub speed_mm_s: Option<Spanned<f64>>,
    /// Volume flow, mm³/s.
    pub flow_mm3_s: Option<Spanned<f64>>,
}

/// Where along a strand an event happens.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum At {
    /// Arc length, mm.
    Mm(f64),
    /// Time, s.
    S(f64),
}

/// A switch during a strand.
#[derive(Debug, Clone, PartialEq)]
pub struct Event {
    /// Counted from the end of the strand rather than its start.
    pub from_end: bool,
    /// Where; negative from the end means before it.
    pub at: Spanned<At>,
    /// `flow`, `light`, `air`, `heater` or an I/O name of the cell.
    pub set: Spanned<String>,
    /// New state.
    pub on: Spanned<bool>,
}

/// One continuous extrusion. Equality leaves `span` out, as it does for [`Spanned`].
#[derive(Debug, Clone)]
pub struct Strand {
    /// Name, unique in the job.
    pub id: Spanned<String>,
    /// Place of the whole strand in the text.
    pub span: Span,
    /// Polyline, mm, part axes; straight between points; two points or more.
    pub points_mm: Vec<Triple>,
    /// Nozzle axis at each point, pointing out of the nozzle.
    pub directions: Option<Vec<Triple>>,
    /// Joint path to check as it stands, degrees or mm, one row per point.
    pub joints: Option<Spanned<Vec<Vec<f64>>>>,
    /// Given time law, one time per point, s.
    pub times_s: Option<Spanned<Vec<f64>>>,
    /// What it rests on.
    pub on: Option<Spanned<On>>,
    /// Its first end.
    pub start: End,
    /// Its last end.
    pub end: End,
    /// Changes along the strand, in order of arc length.
    pub profile: Vec<ProfilePoint>,
    /// Switches along the strand.
    pub events: Vec<Event>,
    /// Values that differ from the job's.
    pub process: Process,
}

impl PartialEq for Strand {
    fn eq(&self, other: &Self) -> bool {
        // taken apart, so that a new field cannot be forgotten here
        let Self {
            id,
            span: _,
            points_mm,
            directions,
            joints,
            times_s,
            on,
            start,
            end,
            profile,
            events,
            process,
        } = self;
        *id == other.id
            && *points_mm == other.points_mm
            && *directions == other.directions
            && *joints == other.joints
            && *times_s == other.times_s
            && *on == other.on
            && *start == other.start
            && *end == other.end
            && *profile == other.profile
            && *events == other.events
            && *process == other.process
    }
}

/// One step of the sequence.
#[derive(Debug, Clone, PartialEq)]
pub enum Step {
    /// Print the strand of this id.
    Strand(String),
    /// Follow a joint path, degrees or mm.
    Move(Vec<Vec<f64>>),
    /// Wait, s.
    Wait(f64),
    /// Take the part off the form of this id.
    Release(String),
    /// A place where the print may be resumed.
    Checkpoint(String),
}

/// Which freedoms of a point are held.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Fix {
    /// Translations along x, y, z.
    pub xyz: [bool; 3],
    /// All three rotations.
    pub rotations: bool,
}

/// A held point.
#[derive(Debug, Clone, PartialEq)]
pub struct SupportPoint {
    /// Place, mm; the nearest node or member is taken.
    pub at_mm: Triple,
    /// What is held.
    pub fix: Spanned<Fix>,
}

/// A point force.
#[derive(Debug, Clone, PartialEq)]
pub struct PointForce {
    /// Place, mm.
    pub at_mm: Triple,
    /// Force, N, part axes.
    pub force_n: Triple,
}

/// A load case of the finished part.
#[derive(Debug, Clone, PartialEq)]
pub struct LoadCase {
    /// What the author calls it.
    pub name: Spanned<String>,
    /// Held points; the bed no longer holds.
    pub supports: Vec<SupportPoint>,
    /// Forces.
    pub forces: Vec<PointForce>,
}

/// Limits of acceptance of the job.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Limits {
    /// Least clearance, mm.
    pub clearance_mm: Option<Spanned<f64>>,
    /// Largest miss of a node at landing, mm.
    pub node_miss_mm: Option<Spanned<f64>>,
    /// Largest sag of a strand, mm.
    pub sag_mm: Option<Spanned<f64>>,
    /// Largest deflection of the finished part under its loads, mm.
    pub deflection_mm: Option<Spanned<f64>>,
    /// Largest share of the strength of a member or node while printing, percent.
    pub strength_percent: Option<Spanned<f64>>,
    /// Least factor on what the growing frame carries at which it buckles.
    pub buckling_factor: Option<Spanned<f64>>,
    /// Least factor on the loads at which the finished part yields or collapses.
    pub load_factor: Option<Spanned<f64>>,
    /// Largest difference of the TCP's speed from the asked one, percent.
    pub speed_band_percent: Option<Spanned<f64>>,
    /// Longest the program may take, s.
    pub cycle_time_s: Option<Spanned<f64>>,
}

/// A kind of finding that is let pass until a day, and why.
#[derive(Debug, Clone, PartialEq)]
pub struct Allowance {
    /// The finding's code; which codes there are is known in `sim`.
    pub code: Spanned<String>,
    /// The strand it must be on; `None`: any place.
    pub strand: Option<Spanned<String>>,
    /// Why it is let pass.
    pub reason: Spanned<String>,
    /// Last day on which it is, `YYYY-MM-DD`.
    pub until: Spanned<String>,
}
