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
        aim_m: 0.002,
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
    // Dense while the nozzle is near, less so after.
    let start_s = span_s[0].max(segment.born_s);
    let near_s = span_s[1].min(start_s + 8.0);
    let instants = [(start_s, near_s, 2000), (near_s, span_s[1], 500)].into_iter().flat_map(
        |(from_s, until_s, steps)| {
            let dt = (until_s - from_s) / f64::from(steps);
            (0..steps).map(move |i| (from_s + dt * (f64::from(i) + 0.5), dt))
        },
    );
    let mut doses = vec![0.0; normals.len()];
    let shades: Vec<Shade> = lights.shades.iter().map(|s| s.1).collect();
    for (time_s, dt) in instants {
        let tool_from_part = pose_at(time_s).inverse();
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
    let whole = doses.iter().map(SegmentDose::mean_j_m2).fold(0.0, f64::max);
    for &pick in picks {
        let segment = &segments[pick];
        let same = around(segment, CLEAR.azimuths);
        let want = brute_force(segment, CLEAR.radius_m, &same, span_s, &pose_at, lights);
        let scale = mean(&want).max(0.05 * whole);
        for (got, want) in doses[pick].surface_j_m2.iter().zip(&want) {
            worst = worst.max((got - want).abs() / scale);
        }
        let dense = around(segment, 25);
        let want = brute_force(segment, CLEAR.radius_m, &dense, span_s, &pose_at, lights);
        worst_mean = worst_mean
            .max((doses[pick].mean_j_m2() - mean(&want)).abs() / mean(&want).max(0.05 * whole));
    }
    (worst, worst_mean)
}

fn kirkman() -> Lights {
    let place = ring(2e-3);
    on_tool(lamps(place), vec![place.shadow(0.8e-3, 1.5e-3, 4e-3), nozzle()])
}

#[test]
fn dose_on_straight_strand_against_brute_force() {
    // Row 5 of the issue, within 1 %, in the mean and on each azimuth; stations 0.33, 1 and 3.3 mm apart.
    // 0.3 % seen in the mean. The last segments see a sliver of light at the edge of the shadow: below a twentieth
    // of a whole pass, 1 % of that twentieth.
    for count in [31, 101, 301] {
        let stations = straight(0.1, count, 2e-3);
        let got = misses(&stations, &[0, count / 3, count / 2, count - 12], &kirkman());
        assert!(got.0 < 0.01 && got.1 < 0.01, "{count} {got:?}");
        let last: Vec<usize> = (2..12).map(|back| count - back).collect();
        let got = misses(&stations, &last, &kirkman());
        assert!(got.0 < 0.01 && got.1 < 0.01, "{count} {got:?}");
    }
}

#[test]
fn dose_on_curved_strand_against_brute_force() {
    // A helix with the nozzle held upright, so that the strand leaves the light sideways and turns.
    let stations = path(161, |share| {
        let (sin, cos) = (3.0 * PI * share).sin_cos();
        let point = Point::new(0.015 * cos, 0.015 * sin, 0.08 * share);
        (point, Vector::new(0.3 * cos, 0.0, 1.0), 60.0 * share)
    });
    for lights in [kirkman(), on_tool(lamps(ring(2e-3)), vec![])] {
        let got = misses(&stations, &[20, 77, 120], &lights);
        assert!(got.0 < 0.01 && got.1 < 0.01, "{got:?}");
    }
}

/// World poses of a moving flange at a time.
fn flange(time_s: f64) -> Pose {
    let t = time_s / 40.0;
    from_xyz_rpy(
        [0.8 + 0.1 * t, 0.2 * (2.0 * t).sin(), 0.5 - 0.2 * t],
        [t.sin(), 0.7 * t, -1.3 * t],
    )
}

#[test]
fn bed_on_flange_gives_the_same_as_tool_on_flange() {
    let tool_moves = path(81, |share| {
        let point = Point::new(0.02 * (3.0 * share).sin(), 0.01 * share, 0.07 * share);
        (point, Vector::new(0.2, 0.1, 1.0), 35.0 * share)
    });
    // The same relative motion, from world poses of a bed that a flange waves about.
    let bed_moves: Vec<Station> = tool_moves
        .iter()
        .map(|station| {
            let world_from_part = flange(station.time_s);
            let world_from_tool = world_from_part * station.part_from_tool;
            let part_from_tool = world_from_part.inverse() * world_from_tool;
            Station { part_from_tool, part_from_room: world_from_part.inverse(), ..*station }
        })
        .collect();
    let lights = kirkman();
    let dose = |stations: &[Station], lights: &Lights| {
        strand_dose(&Run { stations, dwell_s: 0.5, lights }, &CLEAR)
    };
    let (a, b) = (dose(&tool_moves, &lights), dose(&bed_moves, &lights));
    for (a, b) in a.iter().zip(&b) {
        for (x, y) in a.surface_j_m2.iter().zip(&b.surface_j_m2) {
            assert!((x - y).abs() <= 1e-9 * a.mean_j_m2(), "{x} {y}");
        }
        assert!(a.gel_s == b.gel_s || (a.gel_s - b.gel_s).abs() < 1e-9);
    }
    // A lamp that stands in the room tells the two apart.
    let mut room = lights;
    room.sets[0].carrier = Carrier::Room;
    let (a, b) = (dose(&tool_moves, &room), dose(&bed_moves, &room));
    assert!((a[20].mean_j_m2() - b[20].mean_j_m2()).abs() > 0.01 * a[20].mean_j_m2());
    // The same axes for all: part and everything with it moved elsewhere in the part's file.
    let shift = from_xyz_rpy([0.1, -0.2, 0.3], [0.4, 1.1, -2.0]);
    let moved: Vec<Station> = tool_moves
        .iter()
        .map(|s| Station {
            point: shift * s.point,
            part_from_tool: shift * s.part_from_tool,
            part_from_room: shift * s.part_from_room,
            ..*s
        })
        .collect();
    let (a, b) = (dose(&tool_moves, &kirkman()), dose(&moved, &kirkman()));
    for (a, b) in a.iter().zip(&b) {
        assert!((a.mean_j_m2() - b.mean_j_m2()).abs() <= 1e-9 * a.mean_j_m2());
    }
}

#[test]
fn no_light_no_dose_and_dose_is_inverse_to_speed() {
    let dose = |stations: &[Station], lights: &Lights| {
        strand_dose(&Run { stations, dwell_s: 0.0, lights }, &CLEAR)[30].clone()
    };
    // Ring rotated away: every lamp points out, and the ring behind the nozzle pointing back.
    let away: Vec<Lamp> =
        lamps(ring(2e-3)).iter().map(|lamp| Lamp { along: -lamp.along, ..*lamp }).collect();
    let dark = dose(&straight(0.1, 101, 2e-3), &on_tool(away, vec![]));
    assert!(dark.mean_j_m2() == 0.0 && dark.gel_s.is_infinite() && dark.lit_s() == 0.0);
    let lit = dose(&straight(0.1, 101, 1e-3), &kirkman());
    for factor in [2.0, 5.0, 30.0] {
        let fast = dose(&straight(0.1, 101, factor * 1e-3), &kirkman());
        // The surface gels elsewhere, so time is cut elsewhere.
        close(fast.mean_j_m2() * factor, lit.mean_j_m2(), 1e-5);
        close(fast.lit_s() * factor, lit.lit_s(), 1e-5);
    }
    // Switched off for good before the segment is born, or for one stretch of its passage.
    let mut lights = kirkman();
    lights.sets[0].on_s = vec![[0.0, 20.0]];
    assert!(dose(&straight(0.1, 101, 1e-3), &lights).mean_j_m2() == 0.0);
    lights.sets[0].on_s = vec![[0.0, 33.3], [35.7, 1e9]];
    let mut gap = kirkman();
    gap.sets[0].on_s = vec![[33.3, 35.7]];
    let sum = dose(&straight(0.1, 101, 1e-3), &lights).mean_j_m2()
        + dose(&straight(0.1, 101, 1e-3), &gap).mean_j_m2();
    close(sum, lit.mean_j_m2(), 5e-3);
}

#[test]
fn dwell_and_second_pass_add() {
    let stations = straight(0.05, 51, 2e-3);
    let lights = kirkman();
    let dose =
        |dwell_s| strand_dose(&Run { stations: &stations, dwell_s, lights: &lights }, &CLEAR);
    let (none, one, two) = (dose(0.0), dose(1.0), dose(2.0));
    // At rest the irradiance is constant.
    for i in 45..50 {
        let step = one[i].mean_j_m2() - none[i].mean_j_m2();
        close(two[i].mean_j_m2() - one[i].mean_j_m2(), step, 1e-6);
    }
    assert!(two[47].mean_j_m2() > 1.5 * none[47].mean_j_m2());
    // The same run again, later, doubles the dose of what is lit by all of it, from below as from above.
    let all = segments(&stations);
    let later: Vec<Station> =
        stations.iter().map(|s| Station { time_s: s.time_s + 100.0, ..*s }).collect();
    let mut twice = none.clone();
    let run = Run { stations: &later, dwell_s: 0.0, lights: &lights };
    add_run(&all, &mut twice, &run, &CLEAR);
    assert!(twice[20].mean_j_m2() > 2.0 * none[20].mean_j_m2() * 0.99);
    assert!(twice[20].gel_s == none[20].gel_s);
    // Doses that do not fit are left alone.
    let mut short = vec![SegmentDose::dark(9); 3];
    assert!(add_run(&all, &mut short, &run, &CLEAR) == 0 && short[0].mean_j_m2() == 0.0);
}

#[test]
fn cost_goes_with_the_length_not_its_square() {
    // Pairs of segment and instant looked at, counted.
    let looks = |count: usize| {
        let stations = straight(1e-3 * (count - 1) as f64, count, 2e-3);
        let all = segments(&stations);
        let mut doses = vec![SegmentDose::dark(9); all.len()];
        let lights = on_tool(lamps(ring(2e-3)), vec![]);
        add_run(
            &all,
            &mut doses,
            &Run { stations: &stations, dwell_s: 0.0, lights: &lights },
            &CLEAR,
        )
    };
    let (one, two, eight) = (looks(201), looks(401), looks(1601));
    close((eight - two) as f64, 6.0 * (two - one) as f64, 1e-9);
    // 82 looks a segment, and the last few, which are finer, 1400 more.
    assert!(two - one < 200 * 83 && one < 220 * 83, "{one} {two}");
}

#[test]
fn ring_against_the_figures_of_the_reference() {
    // Section 1.1: 37 mW/cm² mean on the side, about 9 mm lit, 345/v mJ/cm²; spots taken as uniform and whole.
    // Without shades, aimed 40 mm below the orifice so that the whole spot falls on the strand.
    let lights = on_tool(lamps(ring(40e-3)), vec![]);
    let stations = straight(0.2, 201, 1e-3);
    let run = Run { stations: &stations, dwell_s: 0.0, lights: &lights };
    let dose = &strand_dose(&run, &CLEAR)[60];
    // Where the axes meet: 371 W/m²; the strand is thick and the spot Gaussian.
    within(dose.peak_w_m2 / 10.0, 37.0, 3.0);
    within(dose.lit_s(), 9.0, 2.0);
    close(dose.mean_j_m2() / 10.0, 345.0, 0.15);
    // With the tool file's aim and shadow only part of the spot is left.
    let lights = kirkman();
    let part = &strand_dose(&Run { lights: &lights, ..run }, &CLEAR)[60];
    let share = part.mean_j_m2() / dose.mean_j_m2();
    assert!(share > 0.3 && share < 0.6, "{share}");
}

#[test]
fn kirkman_set() {
    // Set point 1.5 ± 0.5 mm behind the nozzle of 3 mm, shadow 0.8 mm, 2 mm/s, Formlabs Clear: 0.8 + 0.68 mm.
    let stations = straight(0.1, 401, 2e-3);
    let lights = kirkman();
    let run = Run { stations: &stations, dwell_s: 0.0, lights: &lights };
    let dose = &strand_dose(&run, &CLEAR)[150];
    within(dose.gel_s * 2.0, 1.5, 0.5);
    within(dose.mean_gel_s * 2.0, 1.5, 0.5);
    within(super::cure::set_distance_m(0.8, 2.0, 0.34), 1.5, 0.5);
    // At once on the mean azimuth of a thin strand: 0.68 mm behind the shadow's edge.
    let thin = Strand { radius_m: 0.1e-3, ..CLEAR };
    let place = ring(2e-3);
    let thin_shadow = on_tool(lamps(place), vec![place.shadow(0.8e-3, 0.1e-3, 4e-3)]);
    let dose = &strand_dose(&Run { lights: &thin_shadow, ..run }, &thin)[150];
    close(dose.mean_gel_s * 2.0 - 0.8, 0.68, 0.1);
}
