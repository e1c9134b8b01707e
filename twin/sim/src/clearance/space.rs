//! The cell with its deposit as planners and the judge see it: what is measured against what, in
//! one posture and over a whole move.

use super::beads::Beads;
use super::bodies::Bodies;
use super::body::Body;
use super::track::{Rider, Track};
use crate::cell::{Job, Mode};
use crate::deposit::Deposit;
use crate::kinematics::Posture;
use crate::pose::{Point, Pose};

/// What a body is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Kind {
    /// The part of the tool the strand leaves.
    Nozzle,
    /// Another part of the tool.
    Tool,
    /// A link of the arm, or beside it.
    Link,
    /// The bed.
    Bed,
    /// The form of this index.
    Form(usize),
    /// What stands around.
    Obstacle,
}

/// A body and what carries it.
pub(crate) struct Thing<'a> {
    pub(crate) kind: Kind,
    pub(crate) body: &'a Body,
    pub(crate) carrier_from_body: Pose,
    pub(crate) rider: Rider,
}

/// The other side of a measured pair.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Named {
    /// A body, by its index in [`Space::things`].
    Thing(usize),
    /// A strand, by its printing order.
    Strand(usize),
}

/// Cell and deposit.
pub(crate) struct Space<'a> {
    pub(crate) job: &'a Job,
    pub(crate) deposit: &'a Deposit,
    /// Its segments in a tree.
    pub(crate) beads: Beads,
    /// All bodies.
    pub(crate) things: Vec<Thing<'a>>,
    /// Pairs of bodies that move against each other and may not touch.
    pub(crate) pairs: Vec<[usize; 2]>,
    /// Bodies that the deposit moves against.
    pub(crate) against_deposit: Vec<usize>,
    /// What carries the part, and the part in its axes.
    pub(crate) part_carrier: Option<usize>,
    pub(crate) carrier_from_part: Pose,
    /// What carries the tool, and the tool in its axes.
    pub(crate) tool_carrier: Option<usize>,
    pub(crate) carrier_from_tool: Pose,
}

impl<'a> Space<'a> {
    /// Lists bodies and pairs of a job.
    pub(crate) fn new(job: &'a Job, bodies: &'a Bodies, deposit: &'a Deposit) -> Self {
        let cell = &job.cell;
        let chain = &cell.robot.arm.chain;
        let tip = chain.joints().len().checked_sub(1);
        let bed_rides = cell.mode == Mode::BedOnFlange;
        let flange = *chain.last_from_tip();
        let still = (None, Pose::identity());
        let (tool, bed) = match cell.mode {
            Mode::ToolOnFlange => ((tip, flange * cell.tool_pose), (None, cell.bed.pose)),
            Mode::BedOnFlange => ((None, cell.tool_pose), (tip, flange * cell.bed.pose)),
        };
        let part = (bed.0, bed.1 * job.bed_from_part);
        let mut things = Vec::new();
        let mut add = |kind: Kind, body: &'a Body, (carrier, pose): (Option<usize>, Pose)| {
            let rider = Rider { carrier, centre: pose * body.centre, radius_m: body.radius_m };
            things.push(Thing { kind, body, carrier_from_body: pose, rider });
        };
        for part in &bodies.tool {
            add(if part.nozzle { Kind::Nozzle } else { Kind::Tool }, &part.body, tool);
        }
        add(Kind::Bed, &bodies.bed, bed);
        for (index, form) in bodies.forms.iter().enumerate() {
            add(Kind::Form(index), form, part);
        }
        for obstacle in &bodies.obstacles {
            add(Kind::Obstacle, obstacle, still);
        }
        for link in &bodies.links {
            add(Kind::Link, &link.body, (link.carrier, link.carrier_from_link));
        }
        let mut space = Self {
            job,
            deposit,
            beads: Beads::new(deposit),
            things,
            pairs: Vec::new(),
            against_deposit: Vec::new(),
            part_carrier: part.0,
            carrier_from_part: part.1,
            tool_carrier: tool.0,
            carrier_from_tool: tool.1,
        };
        space.pairs = space.all_pairs(bodies);
        let meets_part = |thing: &Thing<'_>| match thing.kind {
            Kind::Nozzle | Kind::Tool | Kind::Link => true,
            Kind::Obstacle => bed_rides,
            Kind::Bed | Kind::Form(_) => false,
        };
        let n_things = space.things.len();
        space.against_deposit =
            (0..n_things).filter(|&index| meets_part(&space.things[index])).collect();
        space
    }

    /// Pairs that move against each other and may not touch, tool first, then the arm.
    fn all_pairs(&self, bodies: &Bodies) -> Vec<[usize; 2]> {
        let bed_rides = self.job.cell.mode == Mode::BedOnFlange;
        let of = |wanted: &dyn Fn(Kind) -> bool| -> Vec<usize> {
            (0..self.things.len()).filter(|&index| wanted(self.things[index].kind)).collect()
        };
        let tool = of(&|kind| matches!(kind, Kind::Nozzle | Kind::Tool));
        let ground = of(&|kind| matches!(kind, Kind::Bed | Kind::Form(_)));
        let obstacles = of(&|kind| kind == Kind::Obstacle);
        let links = of(&|kind| kind == Kind::Link);
        let off_flange: Vec<usize> =
            bodies.links_off_flange.iter().map(|&link| links[link]).collect();
        let every = |ones: &[usize], others: &[usize]| -> Vec<[usize; 2]> {
            ones.iter().flat_map(|&a| others.iter().map(move |&b| [a, b])).collect()
        };
        let mut pairs = every(&tool, &ground);
        pairs.extend(every(&tool, &obstacles));
        pairs.extend(every(&tool, if bed_rides { &links } else { &off_flange }));
        pairs.extend(every(&ground, &obstacles));
        pairs.extend(if bed_rides { every(&ground, &off_flange) } else { every(&links, &ground) });
        pairs.extend(every(&links, &obstacles));
        pairs.extend(bodies.link_pairs.iter().map(|&[i, j]| [links[i], links[j]]));
        // What one thing carries does not move against itself; a bed that stands, not against what
        // stands around it.
        pairs.retain(|&[a, b]| self.things[a].rider.carrier != self.things[b].rider.carrier);
        pairs
    }

    /// A joint path of this cell's arm.
    pub(crate) fn track(&self, q: Vec<Posture>, at_m: Vec<f64>) -> Track<'a> {
        Track::new(&self.job.cell.robot.arm.chain, q, at_m)
    }

    /// Name of the other side of a pair.
    pub(crate) fn name(&self, named: Named) -> &str {
        match named {
            Named::Thing(index) => &self.things[index].body.name,
            Named::Strand(order) => &self.job.strands[self.deposit.strands[order].strand].id,
        }
    }

    /// A sphere about all that is printed in the whole job, and what carries it.
    pub(crate) fn deposit_rider(&self) -> Option<Rider> {
        let (low, high) = self.deposit.bounds()?;
        let centre = self.carrier_from_part * nalgebra::center(&low, &high);
        Some(Rider { carrier: self.part_carrier, centre, radius_m: (high - low).norm() / 2.0 })
    }

    /// The orifice, and what carries it.
    pub(crate) fn orifice(&self) -> Rider {
        let centre = self.carrier_from_tool * Point::origin();
        Rider { carrier: self.tool_carrier, centre, radius_m: 0.0 }
    }
}
