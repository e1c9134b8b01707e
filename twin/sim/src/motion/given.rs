//! A strand's own joint rows: followed as they stand, never replanned.
//!
//! Rows belong to vertices. What the arm does between two of them the controller decides: joints turn
//! evenly, or the TCP runs in a line (of the part's next point, where the cell sets a tool per point).

use super::place::{Course, Turn};
use super::set_tool;
use crate::cell::{Interpolation, Job, LinearMove};
use crate::kinematics::Posture;
use crate::pose::Pose;
use crate::toolpath::stations;

/// Rows with their places along the strand.
pub(super) struct Rows<'a> {
    job: &'a Job,
    rows: Vec<Posture>,
    stations: Vec<f64>,
    /// Nozzle in bed axes at each row.
    poses: Vec<Pose>,
}

impl<'a> Rows<'a> {
    /// `None` where there is not a row per vertex.
    pub(super) fn new(job: &'a Job, strand: usize, rows: &[Vec<f64>]) -> Option<Self> {
        let stations = stations(&job.strands[strand].points);
        let rows: Vec<Posture> = rows.iter().map(|row| Posture::new(row)).collect();
        let poses = rows.iter().map(|row| job.cell.bed_from_tool(row)).collect();
        (rows.len() == stations.len() && rows.len() > 1).then_some(Self {
            job,
            rows,
            stations,
            poses,
        })
    }

    /// The row after a place, and the share of the way to it; past the end 1.
    fn leg(&self, at_m: f64) -> (usize, f64) {
        let k = self.stations.partition_point(|&x| x < at_m).clamp(1, self.stations.len() - 1);
        let (from, to) = (self.stations[k - 1], self.stations[k]);
        (k, ((at_m - from) / (to - from)).clamp(0.0, 1.0))
    }

    /// Posture with all joints turning evenly.
    pub(super) fn joint(&self, at_m: f64) -> Posture {
        let (k, share) = self.leg(at_m);
        self.rows[k - 1].toward(&self.rows[k], share)
    }

    /// Nozzle in bed axes with the controller moving in lines.
    pub(super) fn linear(&self, at_m: f64) -> Pose {
        let (k, share) = self.leg(at_m);
        let (from, to) = (&self.poses[k - 1], &self.poses[k]);
        match self.job.cell.controller.linear {
            LinearMove::Tcp => set_tool::straight(from, to, share),
            LinearMove::SetTool => set_tool::nozzle_at(from, to, share),
        }
    }

    /// Pairs of neighbouring rows between which a joint turns by more than half a turn: second row,
    /// axis, and by how much, rad.
    pub(super) fn wraps(&self) -> impl Iterator<Item = (usize, usize, f64)> + '_ {
        let axes = self.job.cell.robot.arm.chain.axes();
        (1..self.rows.len()).flat_map(move |k| {
            let (from, to) = (&self.rows[k - 1], &self.rows[k]);
            let turns = from.iter().zip(to.iter()).map(|(a, b)| b - a).enumerate();
            turns
                .filter(|(axis, turn)| {
                    axes[*axis].periodic && turn.abs() > std::f64::consts::PI + 1e-9
                })
                .map(move |(axis, turn)| (k, axis, turn))
        })
    }

    /// Whether a motion of all joints from the row before has the nozzle further off the middle of the two
    /// than half their distance: the arm turns over on the way.
    pub(super) fn turns_over(&self, row: usize) -> Option<f64> {
        let (from, to) = (&self.rows[row - 1], &self.rows[row]);
        let [a, b, middle] = [
            &self.poses[row - 1],
            &self.poses[row],
            &self.job.cell.bed_from_tool(&from.toward(to, 0.5)),
        ]
        .map(|pose| pose.translation.vector);
        let off_m = (middle - a.lerp(&b, 0.5)).norm();
        let flips = from.distance(to) > super::check::EVEN_RAD
            && off_m > super::check::FLIP_SHARE * (b - a).norm() + 1e-6;
        flips.then_some(off_m)
    }

    /// Number of rows.
    pub(super) fn len(&self) -> usize {
        self.rows.len()
    }

    /// Arc length of a row, m.
    pub(super) fn at_m(&self, row: usize) -> f64 {
        self.stations[row]
    }
}

/// Postures at the samples; those in the overrun stay at the last row.
///
/// A line between two rows is followed on the branch of the first. Where it has no posture the joints
/// are taken to turn evenly.
pub(super) fn postures(course: &Course<'_>, rows: &[Vec<f64>]) -> Vec<Option<Posture>> {
    let (job, strand) = (course.job, course.path.strand);
    let samples = &course.path.samples;
    let Some(rows) = Rows::new(job, strand, rows) else { return vec![None; samples.len()] };
    let joint = job.strands[strand].settings.interpolation == Interpolation::Joint;
    let elbow = |row: &Posture| job.cell.robot.arm.elbow_angle(row).unwrap_or(0.0);
    let mut before = rows.rows[0];
    let mut solutions = Vec::new();
    let mut at = |at_m: f64| {
        let (k, share) = rows.leg(at_m);
        before = match share {
            _ if joint => rows.joint(at_m),
            0.0 => rows.rows[k - 1],
            1.0 => rows.rows[k],
            _ => {
                let [from, to] = [&rows.rows[k - 1], &rows.rows[k]]
                    .map(|row| Turn::new(0.0, [0.0; 2], elbow(row)));
                let turn = from.mix(&to, share);
                let solution = course.near(&rows.linear(at_m), &turn, &before, &mut solutions);
                solution.map_or_else(|| rows.joint(at_m), |solution| solution.q)
            }
        };
        Some(before)
    };
    samples.iter().map(|sample| at(sample.at_m)).collect()
}
