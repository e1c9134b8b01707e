//! The job as it goes on: what moves, what is printed when, and the numbers that change with it.
//!
//! A copy of a [`Preflight`] for eyes and recordings, told once so that pictures, the report's 3-D view
//! and recordings show the same thing. [`Film`] is plain data: rigid things with the *mover* each rides on, strands
//! with the time at which every point is laid. A [`Player`] says where the movers are at any time. Nothing here judges.

mod ageing;
mod borne;
mod findings;
mod player;
mod quantity;
mod scene;
mod strands;
#[cfg(test)]
mod tests;
mod traces;

pub use ageing::{Ageing, ageing};
pub use findings::FilmFinding;
pub use player::{Frame, Player};
pub use quantity::{Painted, Quantity};
pub use scene::Look;
pub use strands::FilmStrand;
pub use traces::{Trace, TraceOf, traces};

use crate::cell::{Job, Mode};
use crate::finding::Phase;
use crate::pose::Pose;
use crate::preflight::Preflight;
use crate::scene::{BedShape, BodyKind};
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
            .map(|finding| findings::film_finding(preflight, &film, &order_of, finding))
            .collect();
        film
    }

    /// The scale of a quantity, where the film has it.
    pub fn painted_by(&self, quantity: Option<Quantity>) -> Option<&Painted> {
        self.painted.iter().find(|painted| Some(painted.quantity) == quantity)
    }

    /// The quantity that comes nearest to its limit or goes furthest past it: what a picture of the whole had best be
    /// coloured by. Sag where none has a limit.
    pub fn most_telling(&self) -> Quantity {
        let share = |painted: &Painted| {
            let limit = painted.scale.limit.filter(|limit| *limit > 0.0)?;
            let values = self.strands.iter().enumerate().flat_map(|(order, strand)| {
                let value = move |k| strand.value(order, k, painted.quantity, self.total_s);
                (0..strand.segments()).filter_map(value)
            });
            let shares = values.map(|value| {
                let share = painted.quantity.on_screen(value) / limit;
                // of a clearance little is bad
                if painted.quantity == Quantity::Clearance { 2.0 - share } else { share }
            });
            Some((painted.quantity, shares.fold(f64::NEG_INFINITY, f64::max)))
        };
        let all = self.painted.iter().filter_map(share);
        let most = all.reduce(|most, next| if next.1 > most.1 { next } else { most });
        most.map_or(Quantity::Sag, |(quantity, _)| quantity)
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
