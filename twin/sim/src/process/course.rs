//! How a strand was made: where the nozzle was when, what the extruder was told, when the lights shone.

use crate::pose::{Point, Pose, Vector};

/// One instant of the nozzle on its way along a strand. Part axes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Station {
    /// Arc length from the strand's start, m.
    pub at_m: f64,
    /// Time from the start of the way, s.
    pub time_s: f64,
    /// Place of the strand's axis, m.
    pub point: Point,
    /// Direction of travel, unit.
    pub tangent: Vector,
    /// Gravity, m/s²; it turns where the part rides on the arm.
    pub gravity_m_s2: Vector,
    /// Pose of the tool in part axes.
    pub part_from_tool: Pose,
    /// Pose of the room in part axes.
    pub part_from_room: Pose,
}

/// A change of what a switch or the extruder is told, valid from its time on.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Told<T> {
    /// From when, s on the clock of the stations; may be before zero.
    pub from_s: f64,
    /// What.
    pub value: T,
}

/// The making of one strand.
#[derive(Debug, Clone, PartialEq)]
pub struct Course {
    /// The nozzle's way, by time; at least two.
    pub stations: Vec<Station>,
    /// Flow told to the extruder, m³/s, by time; none before the first.
    pub flow: Vec<Told<f64>>,
    /// Whether the lights are on, by time; dark before the first.
    pub light: Vec<Told<bool>>,
    /// How long the nozzle rests at the end with what is on left on, s.
    pub dwell_s: f64,
}

impl Course {
    /// The same at a share of its speed: all that happens on the way happens where it did.
    #[must_use]
    pub fn slowed(mut self, share: f64) -> Self {
        self.stations.iter_mut().for_each(|station| station.time_s /= share);
        self.flow.iter_mut().for_each(|told| told.from_s /= share);
        self.light.iter_mut().for_each(|told| told.from_s /= share);
        self
    }

    /// Length of the strand's own way, m.
    pub fn length_m(&self) -> f64 {
        self.stations.last().map_or(0.0, |station| station.at_m)
    }

    /// Time at which the nozzle passes an arc length, s; held to the way's ends.
    ///
    /// Linear between stations; O(log n).
    pub fn time_at_s(&self, at_m: f64) -> f64 {
        let k = self.stations.partition_point(|station| station.at_m < at_m);
        match (self.stations.get(k.wrapping_sub(1)), self.stations.get(k)) {
            (Some(a), Some(b)) if b.at_m > a.at_m => {
                a.time_s + (b.time_s - a.time_s) * (at_m - a.at_m) / (b.at_m - a.at_m)
            }
            (_, Some(b)) => b.time_s,
            (Some(a), None) => a.time_s,
            (None, None) => 0.0,
        }
    }

    /// The nozzle at a time: places straight in between, directions those of the station before.
    pub fn station_at(&self, time_s: f64) -> Option<Station> {
        let k = self.stations.partition_point(|station| station.time_s <= time_s);
        let from = *self.stations.get(k.saturating_sub(1))?;
        let Some(to) = self.stations.get(k).filter(|_| k > 0) else { return Some(from) };
        let share = (time_s - from.time_s) / (to.time_s - from.time_s);
        let moved = |a: Pose, b: &Pose| {
            let offset = a.translation.vector.lerp(&b.translation.vector, share);
            Pose::from_parts(offset.into(), a.rotation)
        };
        Some(Station {
            at_m: from.at_m + (to.at_m - from.at_m) * share,
            time_s,
            point: from.point + (to.point - from.point) * share,
            part_from_tool: moved(from.part_from_tool, &to.part_from_tool),
            part_from_room: moved(from.part_from_room, &to.part_from_room),
            ..from
        })
    }

    /// Share of a stretch of time in which the lights are on.
    pub fn lit_share(&self, from_s: f64, to_s: f64) -> f64 {
        let overlap = |on: &[f64; 2]| (on[1].min(to_s) - on[0].max(from_s)).max(0.0);
        let lit_s: f64 = self.lit().iter().map(overlap).sum();
        if to_s > from_s { lit_s / (to_s - from_s) } else { 0.0 }
    }

    /// Direction of travel at an arc length.
    pub fn tangent_at(&self, at_m: f64) -> Vector {
        let k = self.stations.partition_point(|station| station.at_m <= at_m);
        self.stations[k.clamp(1, self.stations.len()) - 1].tangent
    }

    /// Gravity at a time, part axes, m/s²: straight between stations, held before and after.
    pub fn gravity_at(&self, time_s: f64) -> Vector {
        let k = self.stations.partition_point(|station| station.time_s <= time_s);
        match (self.stations.get(k.wrapping_sub(1)), self.stations.get(k)) {
            (Some(a), Some(b)) => {
                let share = (time_s - a.time_s) / (b.time_s - a.time_s);
                a.gravity_m_s2 + (b.gravity_m_s2 - a.gravity_m_s2) * share
            }
            (Some(at), None) | (None, Some(at)) => at.gravity_m_s2,
            (None, None) => Vector::zeros(),
        }
    }

    /// Whether the lights are on at a time.
    pub fn lit_at(&self, time_s: f64) -> bool {
        let k = self.light.partition_point(|told| told.from_s <= time_s);
        k > 0 && self.light[k - 1].value
    }

    /// Stretches of time with the lights on, s, until the dwell's end.
    pub fn lit(&self) -> Vec<[f64; 2]> {
        let end_s = self.stations.last().map_or(0.0, |last| last.time_s) + self.dwell_s;
        let mut lit: Vec<[f64; 2]> = Vec::new();
        for (k, told) in self.light.iter().enumerate().filter(|(_, told)| told.value) {
            let to_s = self.light.get(k + 1).map_or(end_s, |next| next.from_s).min(end_s);
            match lit.last_mut() {
                Some(last) if last[1] >= told.from_s => last[1] = to_s.max(last[1]),
                _ if to_s > told.from_s => lit.push([told.from_s, to_s]),
                _ => {}
            }
        }
        lit
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn course() -> Course {
        let station = |k: usize| Station {
            at_m: k as f64 * 0.01,
            time_s: k as f64 * 2.0,
            point: Point::new(k as f64 * 0.01, 0.0, 0.0),
            tangent: Vector::x(),
            gravity_m_s2: Vector::new(0.0, 0.0, -9.8),
            part_from_tool: Pose::identity(),
            part_from_room: Pose::identity(),
        };
        let on = |from_s: f64, value: bool| Told { from_s, value };
        Course {
            stations: (0..4).map(station).collect(),
            flow: vec![Told { from_s: 0.0, value: 1e-8 }],
            light: vec![on(1.0, true), on(3.0, false), on(5.0, true)],
            dwell_s: 2.0,
        }
    }

    #[test]
    fn times_are_found_by_arc_length() {
        let course = course();
        for (at_m, time_s) in [(-1.0, 0.0), (0.0, 0.0), (0.015, 3.0), (0.03, 6.0), (1.0, 6.0)] {
            assert!((course.time_at_s(at_m) - time_s).abs() < 1e-12, "{at_m}");
        }
        assert_eq!(course.length_m(), 0.03);
    }

    #[test]
    fn the_nozzle_is_found_at_a_time() {
        let course = course();
        for (time_s, at_m) in [(-1.0, 0.0), (0.0, 0.0), (3.0, 0.015), (6.0, 0.03), (9.0, 0.03)] {
            let station = course.station_at(time_s).expect("stations");
            assert!((station.at_m - at_m).abs() < 1e-12, "{time_s}");
            assert!((station.point.x - at_m).abs() < 1e-12, "{time_s}");
        }
        assert!((course.lit_share(0.0, 4.0) - 0.5).abs() < 1e-12);
    }

    #[test]
    fn lights_shine_between_on_and_off_and_through_the_dwell() {
        let course = course();
        assert_eq!(course.lit(), [[1.0, 3.0], [5.0, 8.0]]);
        assert!(!course.lit_at(0.5) && course.lit_at(1.0) && !course.lit_at(3.0));
        assert!(course.lit_at(7.0));
    }
}
