//! What the extruder made of a strand along its length: beads by the flow that came and the way it was
//! laid over.

use super::bead::{self, Bead, Orifice, beads};
use super::course::Course;
use super::drive::Drive;
use super::feed::{Blobs, Delivered, Feed, Told};

/// An extruder with the nozzle it feeds.
#[derive(Debug, Clone, PartialEq)]
pub struct Extruder {
    /// Time in which the flow comes within 1/e of what is told, s.
    pub lag_s: f64,
    /// What flows it can give.
    pub drive: Drive,
    /// The nozzle and the material in it.
    pub orifice: Orifice,
}

/// The bead of a stretch of strand about as long as it is wide.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BeadAt {
    /// Middle of the stretch, m.
    pub at_m: f64,
    /// The bead.
    pub bead: Bead,
    /// Diameter asked for, as drawn, m.
    pub asked_m: f64,
}

/// A strand as fed.
#[derive(Debug, Clone, PartialEq)]
pub struct Fed {
    /// Its beads from start to end.
    pub beads: Vec<BeadAt>,
    /// Mean flow while the nozzle was on its way along it, m³/s.
    pub mean_flow_m3_s: f64,
    /// What came out at rest, before, at the end and after.
    pub blobs: Blobs,
    /// Share of the flow's lag that stays at the ends: beads nearer to an end than this are its ramp, m.
    pub ramp_m: f64,
}

/// Feeds a strand of `length_m` along its course; `asked` gives flow m³/s and speed m/s told at an arc length.
///
/// Mass balance on stretches of one bead's length, on the nozzle's true times and the lagged flow. O(n) in stretches and stations.
pub fn feed(
    course: &Course,
    length_m: f64,
    extruder: &Extruder,
    asked: impl Fn(f64) -> (f64, f64),
) -> Fed {
    let told = Told::new(course.flow.iter().map(|told| (told.from_s, told.value)).collect());
    let answers = Feed { lag_s: extruder.lag_s, drive: extruder.drive.clone() };
    let delivered = answers.deliver(&told);
    let (begin_s, end_s) = (course.time_at_s(0.0), course.time_at_s(length_m));
    let primes_s = course.flow.first().map_or(begin_s, |told| told.from_s.min(begin_s));
    let left_s = end_s + course.dwell_s;
    let (_, speed_m_s) = asked(f64::NEG_INFINITY);
    Fed {
        beads: laid(course, length_m, &delivered, &extruder.orifice, &asked),
        mean_flow_m3_s: delivered.volume_m3(begin_s, end_s) / (end_s - begin_s),
        blobs: delivered.blobs(primes_s, begin_s, end_s, left_s, f64::INFINITY),
        ramp_m: 3.0 * extruder.lag_s * speed_m_s,
    }
}

/// Most stretches a strand is cut into.
const MOST: f64 = 2000.0;

fn laid(
    course: &Course,
    length_m: f64,
    delivered: &Delivered,
    orifice: &Orifice,
    asked: impl Fn(f64) -> (f64, f64),
) -> Vec<BeadAt> {
    let (flow_m3_s, speed_m_s) = asked(f64::NEG_INFINITY);
    let width_m = bead::drawn_diameter_m(flow_m3_s, speed_m_s);
    let pieces = (length_m / width_m).floor().clamp(1.0, MOST);
    let pieces = if pieces.is_finite() { pieces as usize } else { 1 };
    let station = |k: usize| {
        let arc_m = length_m * k as f64 / pieces as f64;
        bead::Station { time_s: course.time_at_s(arc_m), arc_m }
    };
    let stations: Vec<bead::Station> = (0..=pieces).map(station).collect();
    let times: Vec<f64> = stations.iter().map(|station| station.time_s).collect();
    let made = beads(&stations, &delivered.volumes_m3(&times), orifice);
    made.into_iter()
        .zip(stations.windows(2))
        .map(|(bead, ends)| {
            let at_m = 0.5 * (ends[0].arc_m + ends[1].arc_m);
            let (flow_m3_s, speed_m_s) = asked(at_m);
            BeadAt { at_m, bead, asked_m: bead::drawn_diameter_m(flow_m3_s, speed_m_s) }
        })
        .collect()
}

impl Fed {
    /// Beads that are not in the ramps of the flow or of the arm, which are `ends_m` long.
    pub fn away_from_ends(&self, length_m: f64, ends_m: [f64; 2]) -> impl Iterator<Item = &BeadAt> {
        let from_m = self.ramp_m.max(ends_m[0]);
        let to_m = length_m - ends_m[1];
        self.beads.iter().filter(move |bead| bead.at_m > from_m && bead.at_m < to_m)
    }
}

#[cfg(test)]
mod tests {
    use super::super::course::Station;
    use super::super::course::Told as Switch;
    use super::super::feed::prime_time_s;
    use super::*;
    use crate::pose::{Point, Pose, Vector};

    /// 100 mm at 10 mm/s, then 100 mm at 20 mm/s.
    fn course(flow: Vec<Switch<f64>>) -> Course {
        let station = |at_m: f64, time_s: f64| Station {
            at_m,
            time_s,
            point: Point::new(at_m, 0.0, 0.0),
            tangent: Vector::x(),
            gravity_m_s2: Vector::new(0.0, 0.0, -9.8),
            part_from_tool: Pose::identity(),
            part_from_room: Pose::identity(),
        };
        let stations = vec![station(0.0, 0.0), station(0.1, 10.0), station(0.2, 15.0)];
        Course { stations, flow, light: Vec::new(), dwell_s: 1.0 }
    }

    fn extruder(lag_s: f64) -> Extruder {
        let orifice = Orifice { nozzle_m: 2e-3, swell: 1.0, hot_kg_m3: 1000.0, cold_kg_m3: 1000.0 };
        Extruder { lag_s, drive: Drive::Any, orifice }
    }

    const FLOW: f64 = 3e-8;

    #[test]
    fn where_the_arm_is_twice_as_fast_the_bead_has_half_the_area() {
        let told = vec![Switch { from_s: 0.0, value: FLOW }, Switch { from_s: 15.0, value: 0.0 }];
        let fed = feed(&course(told), 0.2, &extruder(0.0), |_| (FLOW, 0.01));
        let slow = fed.beads[3].bead.hot_m;
        let fast = fed.beads[fed.beads.len() - 3].bead.hot_m;
        assert!((slow / fed.beads[3].asked_m - 1.0).abs() < 1e-12);
        assert!((fast / slow - 0.5_f64.sqrt()).abs() < 1e-12);
        assert!((fed.mean_flow_m3_s / FLOW - 1.0).abs() < 1e-12);
        assert_eq!(fed.blobs.end_m3, 0.0);
    }

    #[test]
    fn all_that_comes_is_bead_or_blob() {
        let told = vec![Switch { from_s: -2.0, value: FLOW }, Switch { from_s: 15.0, value: 0.0 }];
        let fed = feed(&course(told), 0.2, &extruder(1.5), |_| (FLOW, 0.01));
        let beads: f64 = fed.beads.iter().map(|at| at.bead.volume_m3).sum();
        let blobs = fed.blobs.start_m3 + fed.blobs.end_m3 + fed.blobs.ooze_m3;
        assert!((beads + blobs - FLOW * 17.0).abs() < 1e-18, "{}", beads + blobs);
    }

    #[test]
    fn primed_as_told_the_first_bead_is_as_wide_as_asked_for() {
        for lag_s in [0.1, 2.0] {
            let thinnest = 0.9;
            let needed_s = prime_time_s(lag_s, 0.0, FLOW, thinnest * thinnest);
            let at_first = |prime_s: f64| {
                let told = [Switch { from_s: -prime_s, value: FLOW }];
                let answers = Feed { lag_s, drive: Drive::Any };
                let steps = told.iter().map(|told| (told.from_s, told.value)).collect();
                let flow = answers.deliver(&Told::new(steps)).flow_m3_s(0.0);
                (flow / FLOW).sqrt()
            };
            assert!((at_first(needed_s) - thinnest).abs() < 1e-9, "{lag_s}");
            assert!(at_first(0.9 * needed_s) < thinnest);
        }
    }
}
