//! Times of the program: how long every stretch takes.

use super::{Act, Leg, Moment, Motion, Printing, Station, Way, between, strand};
use crate::cell::Job;
use crate::finding::Phase;
use crate::toolpath::Path;

/// Gives the program its times.
pub(super) fn timed(job: &Job, paths: &[Path], acts: Vec<Act>) -> Motion {
    let mut clock = Clock {
        job,
        paths,
        motion: Motion {
            legs: Vec::new(),
            printings: Vec::new(),
            releases: Vec::new(),
            total_s: 0.0,
        },
    };
    for act in acts {
        match act {
            Act::Wait(wait_s) => clock.motion.total_s += wait_s,
            Act::Release(form) => {
                let printed = clock.motion.printings.len();
                clock.motion.releases.push((form, printed, clock.motion.total_s));
            }
            Act::Go(way) => match (way.phase, way.strand) {
                (Phase::Print, Some(strand)) => clock.print(way, strand),
                _ => clock.travel(way),
            },
        }
    }
    clock.motion
}

struct Clock<'a> {
    job: &'a Job,
    paths: &'a [Path],
    motion: Motion,
}

impl Clock<'_> {
    fn print(&mut self, way: Way, strand: usize) {
        let (path, law) = (&self.paths[strand], &self.job.strands[strand]);
        if way.stations.is_empty() {
            let now = self.motion.total_s;
            self.motion.printings.push(Printing { strand, start_s: now, end_s: now });
            self.leg(way, Vec::new());
            return;
        }
        self.motion.total_s += law.settings.prime_s + law.start.dwell_s;
        let start_s = self.motion.total_s;
        let times = strand::times(law, path);
        let at = |station: &Station| {
            let k = path.samples.partition_point(|sample| sample.at_m < station.at_m - 1e-12);
            let time_s = start_s + times[k.min(times.len() - 1)];
            Moment { time_s, at_m: station.at_m, q: station.q }
        };
        let moments = way.stations.iter().map(at).collect();
        self.leg(way, moments);
        self.motion.total_s = start_s + times.last().copied().unwrap_or(0.0);
        let end_s = self.motion.total_s;
        self.motion.total_s += law.end.dwell_s;
        self.motion.printings.push(Printing { strand, start_s, end_s });
    }

    /// As fast as travel speed of the TCP and the joints' speeds allow.
    fn travel(&mut self, way: Way) {
        let axes = self.job.cell.robot.arm.chain.axes();
        let travel_m_s = self.job.cell.extruder.travel_m_s;
        let mut moments: Vec<Moment> = Vec::with_capacity(way.stations.len());
        let mut place = None;
        for station in &way.stations {
            let (point, _) = between::nozzle_at(self.job, &station.q);
            if let (Some(last), Some(from)) = (moments.last(), place) {
                let straight_s = nalgebra::distance(&point, &from) / travel_m_s;
                let joints = axes.iter().zip(last.q.iter().zip(station.q.iter()));
                let joint_s = joints.map(|(axis, (a, b))| (a - b).abs() / axis.velocity);
                self.motion.total_s += joint_s.fold(straight_s, f64::max);
            }
            place = Some(point);
            moments.push(Moment { time_s: self.motion.total_s, at_m: 0.0, q: station.q });
        }
        self.leg(way, moments);
    }

    fn leg(&mut self, way: Way, moments: Vec<Moment>) {
        let Way { phase, strand, printed, unreached, .. } = way;
        self.motion.legs.push(Leg { phase, strand, printed, moments, unreached });
    }
}
