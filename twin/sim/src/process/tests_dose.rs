//! Dose on strands against brute force, moving axes and the figures of the reference.

use std::f64::consts::PI;

use super::dose::{Run, Segment, SegmentDose, Strand, add_run, segments, strand_dose};
use super::lamp::{Lamp, Lobe, RingPlace};
use super::lights::{ALWAYS, Carrier, LampSet, Lights, Station};
use super::shade::{Shade, is_blocked};
use super::tests::{close, within};
use crate::interval::Interval;
use crate::pose::{Point, Pose, Vector, from_xyz_rpy, from_z_axis};

/// Formlabs Clear on the strand of 3 mm of Kirkman.
pub(super) const CLEAR: Strand = Strand { radius_m: 1.5e-3, critical_j_m2: 126.0, azimuths: 9 };

/// The ring of robots/tools/kirkman-nozzle.toml with a lamp of 0.129 W/sr, aimed below the orifice.
pub(super) fn ring(aim_m: f64) -> RingPlace {
    let ring = super::LightRing {
        leds: 8,
        distance_m: 0.025,
        angle_rad: PI / 4.0,
        intensity_w_sr: Interval::new(0.129, 0.129, 0.14),
        full_angle_rad: 15.0_f64.to_radians(),
        shadow_m: 0.8e-3,
    };
    RingPlace::of(&ring, aim_m)
}

pub(super) fn lamps(place: RingPlace) -> Vec<Lamp> {
    place.lamps(0.129, 15.0_f64.to_radians(), Lobe::Gaussian)
}

pub(super) fn on_tool(lamps: Vec<Lamp>, shades: Vec<Shade>) -> Lights {
    Lights {
        sets: vec![LampSet { carrier: Carrier::Tool, lamps, on_s: vec![ALWAYS] }],
        shades: shades.into_iter().map(|shade| (Carrier::Tool, shade)).collect(),
    }
}

/// The nozzle of the tool file, without its last tenth of a millimetre.
pub(super) fn nozzle() -> Shade {
    Shade::Cone {
        from: Point::new(0.0, 0.0, -0.035),
        to: Point::new(0.0, 0.0, -1e-4),
        radius_from_m: 6e-3,
        radius_to_m: 2.2e-3,
    }
}

/// Nozzle pulled straight away from its strand.
pub(super) fn straight(length_m: f64, count: usize, speed_m_s: f64) -> Vec<Station> {
    path(count, |share| {
        let point = Point::new(0.0, 0.0, length_m * share);
        (point, Vector::z(), length_m * share / speed_m_s)
    })
}

/// Stations along a path: point, which way the strand grows, time.
pub(super) fn path(count: usize, at: impl Fn(f64) -> (Point, Vector, f64)) -> Vec<Station> {
    (0..count)
        .map(|i| {
            let (point, growth, time_s) = at(i as f64 / (count - 1) as f64);
            Station {
                time_s,
                point,
                part_from_tool: from_z_axis(point, -growth, Vector::x()),
                part_from_room: Pose::identity(),
            }
        })
        .collect()
}

/// Dose on a segment summed over dense times, azimuths and all lamps: mean and the dose at given normals.
///
/// Written apart from the library: world points, acos, no pruning, no steps of its own.
fn brute_force(
    segment: &Segment,
    radius_m: f64,
    normals: &[Vector],
    span_s: [f64; 2],
    pose_at: &dyn Fn(f64) -> Pose,
    lights: &Lights,
) -> Vec<f64> {
    let steps = 6000;
    let mut doses = vec![0.0; normals.len()];
    let start_s = span_s[0].max(segment.born_s);
    let dt = (span_s[1] - start_s) / f64::from(steps);
    let shades: Vec<Shade> = lights.shades.iter().map(|s| s.1).collect();
    for step in 0..steps {
        let tool_from_part = pose_at(start_s + dt * (f64::from(step) + 0.5)).inverse();
        for (dose, normal) in doses.iter_mut().zip(normals) {
            let point = tool_from_part * (segment.middle + normal * radius_m);
            let normal = tool_from_part * normal;
            for lamp in &lights.sets[0].lamps {
                let to = lamp.at - point;
                let cosine = to.dot(&normal) / to.norm();
                let off = (-lamp.along).angle(&to);
                if cosine > 0.0 && off < PI / 2.0 && !is_blocked(&shades, lamp.at, point) {
                    let half = lamp.full_angle_rad / 2.0;
                    let intensity = lamp.peak_w_sr * 0.5_f64.powf((off / half).powi(2));
                    *dose += intensity / to.norm_squared() * cosine * dt;
                }
            }
        }
    }
    doses
}

fn around(segment: &Segment, count: usize) -> Vec<Vector> {
    let other = segment.tangent.cross(&segment.across);
    (0..count)
        .map(|i| {
            let angle = 2.0 * PI * i as f64 / count as f64;
            segment.across * angle.cos() + other * angle.sin()
        })
        .collect()
}

fn mean(values: &[f64]) -> f64 {
    values.iter().sum::<f64>() / values.len() as f64
}

/// Greatest relative miss against brute force over some segments, of each azimuth and of the mean.
fn misses(stations: &[Station], picks: &[usize], lights: &Lights) -> (f64, f64) {
    let run = Run { stations, dwell_s: 0.0, lights };
    let doses = strand_dose(&run, &CLEAR);
    let segments = segments(stations);
    let span_s = [stations[0].time_s, stations[stations.len() - 1].time_s];
    let pose_at = |time_s: f64| {
        let next = stations.partition_point(|s| s.time_s < time_s).clamp(1, stations.len() - 1);
        let (a, b) = (&stations[next - 1], &stations[next]);
        let share = (time_s - a.time_s) / (b.time_s - a.time_s);
        a.part_from_tool.lerp_slerp(&b.part_from_tool, share)
    };
    let (mut worst, mut worst_mean): (f64, f64) = (0.0, 0.0);
    for &pick in picks {
        let segment = &segments[pick];
        let same = around(segment, CLEAR.azimuths);
        let want = brute_force(segment, CLEAR.radius_m, &same, span_s, &pose_at, lights);
        let scale = mean(&want);
        for (got, want) in doses[pick].surface_j_m2.iter().zip(&want) {
            worst = worst.max((got - want).abs() / scale);
        }
        let dense = around(segment, 48);
        let want = brute_force(segment, CLEAR.radius_m, &dense, span_s, &pose_at, lights);
        worst_mean = worst_mean.max((doses[pick].mean_j_m2() / mean(&want) - 1.0).abs());
        println!(
            "{pick} {:?} {} {}",
            doses[pick].surface_j_m2,
            doses[pick].mean_j_m2(),
            mean(&want)
        );
    }
    (worst, worst_mean)
}

#[test]
fn straight_strand_against_brute_force() {
    let place = ring(2e-3);
    let shades = vec![place.shadow(0.8e-3, 1.5e-3, 4e-3), nozzle()];
    let lights = on_tool(lamps(place), shades);
    for count in [101, 31, 301] {
        let picks = [count / 3, count / 2];
        let got = misses(&straight(0.1, count, 2e-3), &picks, &lights);
        println!("{count} {got:?}");
        assert!(got.0 < 0.01 && got.1 < 0.01, "{got:?}");
    }
}
