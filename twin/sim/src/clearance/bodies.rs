//! The rigid bodies of a cell.

use super::body::Body;
use crate::cell::Job;
use crate::pose::Pose;
use crate::shape::Shape;

/// A part of the tool.
pub(crate) struct ToolBody {
    pub(crate) nozzle: bool,
    pub(crate) body: Body,
}

/// A link of the arm.
pub(crate) struct LinkBody {
    pub(crate) carrier: Option<usize>,
    pub(crate) carrier_from_link: Pose,
    pub(crate) body: Body,
}

/// All bodies of a cell.
pub struct Bodies {
    pub(crate) tool: Vec<ToolBody>,
    pub(crate) links: Vec<LinkBody>,
    /// Pairs of links that are measured against each other.
    pub(crate) link_pairs: Vec<[usize; 2]>,
    /// Links the tool (or the bed, if that rides) is measured against: all but those that carry it.
    pub(crate) links_off_flange: Vec<usize>,
    pub(crate) bed: Body,
    /// World axes.
    pub(crate) obstacles: Vec<Body>,
    /// Part axes.
    pub(crate) forms: Vec<Body>,
}

impl Bodies {
    /// Of the cell and the forms of a job.
    pub fn new(job: &Job) -> Self {
        let cell = &job.cell;
        let tool = cell
            .tool
            .parts
            .iter()
            .map(|part| ToolBody { nozzle: part.nozzle, body: Body::new(&part.name, &part.shapes) })
            .collect();
        let links: Vec<LinkBody> = cell
            .robot
            .links
            .iter()
            .map(|link| LinkBody {
                carrier: link.carrier,
                carrier_from_link: link.carrier_from_link,
                body: Body::new(&link.name, &link.shapes),
            })
            .collect();
        let n_joints = cell.robot.arm.chain.joints().len();
        // The tool is bolted to the last link and may touch it and the one before.
        let carries_tool =
            |link: &LinkBody| link.carrier.is_some_and(|joint| joint + 2 >= n_joints);
        Self {
            link_pairs: pairs(links.len(), &cell.robot.touching),
            links_off_flange: (0..links.len()).filter(|&k| !carries_tool(&links[k])).collect(),
            tool,
            links,
            bed: Body::new("bed", &[cell.bed.shape()]),
            obstacles: cell.obstacles.iter().map(|o| Body::new(&o.name, &o.shapes)).collect(),
            forms: job
                .forms
                .iter()
                .map(|form| {
                    let mesh = Shape::Mesh {
                        vertices: form.vertices.clone(),
                        triangles: form.triangles.clone(),
                    };
                    Body::new(&form.id, &[mesh])
                })
                .collect(),
        }
    }
}

impl Bodies {
    /// Tool, links and obstacles in one posture, with their poses in part axes.
    pub fn in_part(&self, job: &Job, q: &[f64]) -> Vec<(&Body, Pose)> {
        let (cell, chain) = (&job.cell, &job.cell.robot.arm.chain);
        let mut carriers = Vec::new();
        chain.link_poses(q, &mut carriers);
        let world_from_tip = chain.forward(q);
        let part_from_world = (cell.world_from_bed(&world_from_tip) * job.bed_from_part).inverse();
        let part_from_tool = part_from_world * cell.world_from_tool(&world_from_tip);
        let tool = self.tool.iter().map(|part| (&part.body, part_from_tool));
        let links = self.links.iter().map(|link| {
            let carrier = link.carrier.map_or(part_from_world, |k| part_from_world * carriers[k]);
            (&link.body, carrier * link.carrier_from_link)
        });
        let obstacles = self.obstacles.iter().map(|obstacle| (obstacle, part_from_world));
        tool.chain(links).chain(obstacles).collect()
    }
}

fn pairs(n_links: usize, touching: &[[usize; 2]]) -> Vec<[usize; 2]> {
    (0..n_links)
        .flat_map(|i| (i + 1..n_links).map(move |j| [i, j]))
        .filter(|pair| touching.binary_search(pair).is_err())
        .collect()
}
