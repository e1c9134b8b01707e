//! The job as it goes on: what moves, what is printed when, and the numbers that change with it.
//!
//! A copy of a [`Preflight`] for eyes and recordings, told once so that pictures, the report's 3-D view
//! and recordings show the same thing. [`Film`] is plain data: rigid things with the *mover* each rides on, strands
//! with the time at which every point is laid. A [`Player`] says where the movers are at any time. Nothing here judges.

mod ageing;
mod borne;
mod player;
mod quantity;
mod scene;
mod strands;
#[cfg(test)]
mod tests;
mod traces;

pub use ageing::{Ageing, ageing};
pub use player::{Frame, Player};
pub use quantity::{Painted, Quantity};
pub use scene::Look;
pub use strands::FilmStrand;
pub use traces::{Trace, TraceOf, traces};

use crate::cell::{Job, Mode};
use crate::finding::{self, Bound, Phase, Severity};
use crate::interval::Interval;
use crate::pose::{Point, Pose};
use crate::preflight::Preflight;
use crate::scene::{BedShape, BodyKind, MarkSeverity};
use crate::shape::Shape;

/// A job as it goes on. SI; places of the print are in part axes.
#[derive(Debug, Clone)]
pub struct Film {
    /// Name of the job.
    pub job: String,
    /// Name of the cell.
    pub cell: String,
    /// Names of what moves as one: the room first, then the child link of every joint of the chain from base to tip, then
    /// tool, bed and part.
    pub movers: Vec<String>,
    /// Number of the tool's axes among the movers: origin at the orifice, z along the strand as it leaves.
    pub tool: usize,
    /// Number of the bed.
    pub bed: usize,
    /// Number of the part.
    pub part: usize,
    /// Everything rigid.
    pub bodies: Vec<FilmBody>,
    /// Extent of the bed along its x and y, m.
    pub bed_size_m: [f64; 2],
    /// What was printed, in printing order.
    pub strands: Vec<FilmStrand>,
    /// What the arm does, in order of time; between them it waits.
    pub legs: Vec<FilmLeg>,
    /// Findings in the order of [`Preflight::findings`].
    pub findings: Vec<FilmFinding>,
    /// Joints in the order of a posture.
    pub joints: Vec<FilmJoint>,
    /// What strands can be coloured by, with its scale; the first is the usual one.
    pub painted: Vec<Painted>,
    /// Length of the program, s.
    pub total_s: f64,
}

/// One rigid thing.
#[derive(Debug, Clone)]
pub struct FilmBody {
    /// Name as in the cell or the robot's URDF.
    pub name: String,
    /// What it is.
    pub kind: BodyKind,
    /// What it rides on, an index in [`Film::movers`].
    pub mover: usize,
    /// Its axes in those of the mover.
    pub mover_from_body: Pose,
    /// Its shapes, in its own axes.
    pub shapes: Vec<Shape>,
    /// When it is taken away, s; a form that is released.
    pub gone_s: Option<f64>,
}

/// A stretch of the program.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FilmLeg {
    /// What the arm is doing.
    pub phase: Phase,
    /// The strand, by printing order.
    pub strand: Option<usize>,
    /// From when, s.
    pub from_s: f64,
    /// Until when, s.
    pub to_s: f64,
    /// Least clearance on it, m; `None`: nothing came nearer than twice the limit.
    pub clearance_m: Option<f64>,
}

/// A joint of the arm.
#[derive(Debug, Clone, PartialEq)]
pub struct FilmJoint {
    /// URDF name.
    pub name: String,
    /// In metres rather than radians.
    pub is_linear: bool,
    /// Stops, rad or m.
    pub stops: [f64; 2],
    /// Greatest speed, rad/s or m/s.
    pub speed: f64,
}

/// A finding as a place and a time.
#[derive(Debug, Clone, PartialEq)]
pub struct FilmFinding {
    /// Its code.
    pub code: &'static str,
    /// How bad it is.
    pub severity: MarkSeverity,
    /// When to look, s: its own time, or when its strand or stage is done.
    pub time_s: Option<f64>,
    /// Where, part axes.
    pub at: Option<Point>,
    /// Where that which should be there is instead, part axes.
    pub found: Option<Point>,
    /// How far past its limit, as a share of it; what must not happen at all is past it by more than any other.
    pub excess: f64,
    /// The strand, by printing order.
    pub strand: Option<usize>,
    /// The bodies concerned, by name.
    pub bodies: Vec<String>,
    /// Value against limit in a few words, such as "0.31 mm, limit 1 mm".
    pub words: String,
    /// Whether the place lies on the part: in transit it is the nozzle's, far from what a picture of the part shows.
    pub shown_on_part: bool,
}

impl Film {
    /// The room, among the movers.
    pub const ROOM: usize = 0;

    /// The film of a checked job. O(n) in strands' points and legs.
    pub fn new(preflight: &Preflight) -> Film {
        let job = preflight.job();
        let (movers, [tool, bed, part]) = movers(job);
        let order_of = preflight.deposit.order_of(job.strands.len());
        let strands = strands::strands(preflight);
        let painted = quantity::painted(job, &strands, preflight.motion.total_s);
        let mut film = Film {
            job: job.name.clone(),
            cell: job.cell.name.clone(),
            bodies: bodies(preflight, [tool, part]),
            movers,
            tool,
            bed,
            part,
            bed_size_m: [job.cell.bed.size_m[0], job.cell.bed.size_m[1]],
            strands,
            legs: legs(preflight, &order_of),
            findings: Vec::new(),
            joints: joints(job),
            painted,
            total_s: preflight.motion.total_s,
        };
        film.findings = preflight
            .findings()
            .iter()
            .map(|finding| film_finding(preflight, &film, &order_of, finding))
            .collect();
        film
    }

    /// The scale of a quantity, where the film has it.
    pub fn painted_by(&self, quantity: Option<Quantity>) -> Option<&Painted> {
        self.painted.iter().find(|painted| Some(painted.quantity) == quantity)
    }

    /// The plate that is printed on as a body; `None` where the cell has none.
    pub fn plate(&self) -> Option<FilmBody> {
        if !self.bed_size_m.iter().all(|side_m| *side_m > 0.0) {
            return None;
        }
        let plate = BedShape { pose: Pose::identity(), size_m: self.bed_size_m }.body();
        Some(FilmBody {
            name: plate.name,
            kind: plate.kind,
            mover: self.bed,
            mover_from_body: plate.pose,
            shapes: vec![plate.shape],
            gone_s: None,
        })
    }

    /// Findings that can be shown, by their places in the list, the worst first, errors before warnings; the worst of each
    /// code before a second of any, which says more than six of one.
    pub fn one_of_each_code_first(
        &self,
        can_be_shown: impl Fn(&FilmFinding) -> bool,
    ) -> impl Iterator<Item = usize> {
        let mut codes: Vec<&str> = Vec::new();
        let all = 0..self.findings.len();
        let mut shown: Vec<usize> = all.filter(|&at| can_be_shown(&self.findings[at])).collect();
        let of = |at: usize| &self.findings[at];
        shown.sort_by(|&a, &b| {
            let by_severity = of(b).severity.cmp(&of(a).severity);
            by_severity.then(of(b).excess.total_cmp(&of(a).excess)).then(a.cmp(&b))
        });
        let (first, more): (Vec<usize>, Vec<usize>) = shown.into_iter().partition(|&index| {
            let code = self.findings[index].code;
            let is_new = !codes.contains(&code);
            codes.extend(is_new.then_some(code));
            is_new
        });
        first.into_iter().chain(more)
    }
}

/// Names of the movers, and which are tool, bed and part.
fn movers(job: &Job) -> (Vec<String>, [usize; 3]) {
    let chain = &job.cell.robot.arm.chain;
    let mut names = vec!["world".to_owned()];
    names.extend(chain.joints().iter().map(|joint| joint.name.clone()));
    let tool = names.len();
    names.extend(["tool", "bed", "part"].map(str::to_owned));
    (names, [tool, tool + 1, tool + 2])
}

fn bodies(preflight: &Preflight, [tool, part]: [usize; 2]) -> Vec<FilmBody> {
    let job = preflight.job();
    let cell = &job.cell;
    let still = |name: &str, kind, mover, shapes: &[Shape]| FilmBody {
        name: name.to_owned(),
        kind,
        mover,
        mover_from_body: Pose::identity(),
        shapes: shapes.to_vec(),
        gone_s: None,
    };
    let mut bodies: Vec<FilmBody> = Vec::new();
    for link in &cell.robot.links {
        let prints = link.carrier.is_some() || cell.mode == Mode::ToolOnFlange;
        let kind = if prints { BodyKind::Arm } else { BodyKind::OtherArm };
        let mover = link.carrier.map_or(Film::ROOM, |joint| joint + 1);
        let body = still(&link.name, kind, mover, &link.shapes);
        bodies.push(FilmBody { mover_from_body: link.carrier_from_link, ..body });
    }
    for piece in &cell.tool.parts {
        let kind = if piece.nozzle { BodyKind::Nozzle } else { BodyKind::Tool };
        bodies.push(still(&piece.name, kind, tool, &piece.shapes));
    }
    for obstacle in &cell.obstacles {
        bodies.push(still(&obstacle.name, BodyKind::Obstacle, Film::ROOM, &obstacle.shapes));
    }
    for (index, form) in job.forms.iter().enumerate() {
        let mesh =
            Shape::Mesh { vertices: form.vertices.clone(), triangles: form.triangles.clone() };
        let released = preflight.motion.releases.iter().find(|(form, ..)| *form == index);
        let gone_s = released.map(|(_, _, time_s)| *time_s);
        bodies.push(FilmBody { gone_s, ..still(&form.id, BodyKind::Form, part, &[mesh]) });
    }
    bodies
}

fn legs(preflight: &Preflight, order_of: &[Option<usize>]) -> Vec<FilmLeg> {
    let clearances = preflight.clearance_by_leg_m.iter();
    let legs = preflight.motion.legs.iter().zip(clearances).filter_map(|(leg, clearance_m)| {
        Some(FilmLeg {
            phase: leg.phase,
            strand: leg.strand.and_then(|strand| order_of[strand]),
            from_s: leg.moments.first()?.time_s,
            to_s: leg.moments.last()?.time_s,
            clearance_m: *clearance_m,
        })
    });
    legs.collect()
}

fn joints(job: &Job) -> Vec<FilmJoint> {
    let chain = &job.cell.robot.arm.chain;
    let joint = |(index, axis): (usize, &crate::kinematics::ChainAxis)| FilmJoint {
        name: chain.axis_name(index).to_owned(),
        is_linear: chain.joints()[axis.joint].kind == crate::kinematics::JointKind::Prismatic,
        stops: [axis.lower, axis.upper],
        speed: axis.velocity,
    };
    chain.axes().iter().enumerate().map(joint).collect()
}

fn film_finding(
    preflight: &Preflight,
    film: &Film,
    order_of: &[Option<usize>],
    finding: &finding::Finding,
) -> FilmFinding {
    let site = &finding.site;
    let order = site.strand.and_then(|strand| order_of[strand]);
    let strand = order.map(|order| &preflight.deposit.strands[order]);
    let built = &preflight.growth.built.frame;
    let node =
        site.node.or_else(|| site.member.and_then(|m| Some(built.members().get(m)?.ends[0])));
    let at = site
        .point
        .or_else(|| {
            strand.filter(|s| s.at_m.len() > 1).zip(site.at_m).map(|(s, at_m)| s.printed_at(at_m))
        })
        .or_else(|| built.nodes().get(node?).copied())
        .or_else(|| {
            film.strands.get(order?).and_then(|s| s.points.get(s.points.len() / 2).copied())
        });
    let of_stage =
        |printed: usize| film.strands.get(printed.checked_sub(1)?).and_then(FilmStrand::done_s);
    let time_s = finding
        .time_s
        .or_else(|| of_stage(site.stage?))
        .or_else(|| film.strands.get(order?)?.done_s())
        .filter(|time_s| time_s.is_finite());
    FilmFinding {
        code: finding.code.as_str(),
        severity: match finding.severity {
            Severity::Error => MarkSeverity::Error,
            Severity::Warning => MarkSeverity::Warning,
        },
        time_s,
        at,
        found: site.found,
        excess: excess(finding),
        strand: order,
        bodies: site.bodies.clone(),
        words: words(finding),
        shown_on_part: site.phase != Some(Phase::Transit),
    }
}

fn excess(finding: &finding::Finding) -> f64 {
    let Interval { nominal, low, high } = finding.measured;
    let past = |value: f64| match finding.code.bound() {
        Bound::Upper => value - finding.limit,
        Bound::Lower => finding.limit - value,
        Bound::Forbidden => f64::INFINITY,
    };
    let past = match finding.severity {
        Severity::Error => past(nominal),
        Severity::Warning => past(low).max(past(high)),
    };
    let share = past / finding.limit.abs();
    if share.is_nan() { 0.0 } else { share }
}

/// Value against limit, on a screen's units; what must not happen in its own words.
fn words(finding: &finding::Finding) -> String {
    if finding.code.bound() == Bound::Forbidden {
        return finding.code.title().to_owned();
    }
    let (factor, unit) = match finding.unit {
        "m" => (1e3, " mm"),
        "rad" => (180.0 / std::f64::consts::PI, "°"),
        _ => (1.0, ""),
    };
    let told = |value: f64| {
        let value = value * factor;
        let digits =
            if value == 0.0 { 0.0 } else { (2.0 - value.abs().log10().floor()).clamp(0.0, 4.0) };
        let text = format!("{value:.*}", digits as usize);
        match text.contains('.') {
            true => text.trim_end_matches('0').trim_end_matches('.').to_owned(),
            false => text,
        }
    };
    let limit = told(finding.limit);
    match finding.measured.nominal.is_finite() {
        true => format!("{}{unit}, limit {limit}{unit}", told(finding.measured.nominal)),
        false => format!("limit {limit}{unit}"),
    }
}
