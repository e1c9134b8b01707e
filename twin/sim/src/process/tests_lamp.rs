//! Lamps, shades, the bed's light and depth through the radius.

use std::f64::consts::PI;

use proptest::prelude::*;

use super::bed_light::{Bed, SetBand, SetPlace, Tip, lights_on_after_m, tip_limit_w_m2};
use super::dose::{Run, Strand, strand_dose};
use super::lamp::{Lamp, Lobe, lambert_power, surface_irradiance_w_m2};
use super::shade::Shade;
use super::tests::{close, within};
use super::tests_dose::{lamps, nozzle, on_tool, ring, straight};
use super::through::{Inside, Section};
use super::{cure, light};
use crate::pose::{Point, Vector};

fn lamp(lobe: Lobe) -> Lamp {
    Lamp {
        at: Point::new(0.0, 0.0, 0.0),
        along: Vector::z(),
        peak_w_sr: 0.129,
        full_angle_rad: 15.0_f64.to_radians(),
        lobe,
    }
}

#[test]
fn led_15deg() {
    // 10 mW in a Gaussian lobe of 15° is 129 mW/sr; published 140 ± 15 %.
    let angle = 15.0_f64.to_radians();
    within(light::gaussian_peak_w_sr(0.01, angle) * 1e3, 129.0, 0.5);
    within(light::gaussian_peak_w_sr(0.01, angle) * 1e3, 140.0, 0.15 * 140.0);
    // Section 1.1: on the axis 57/32/21/14/8 mW/cm² at 15/20/25/30/40 mm; half at half the angle.
    for (mm, want) in [(15.0, 57.0), (20.0, 32.0), (25.0, 21.0), (30.0, 14.0), (40.0, 8.0)] {
        let seen = lamp(Lobe::Gaussian).irradiance_w_m2(Point::new(0.0, 0.0, mm * 1e-3));
        within(seen.norm() / 10.0, want, 0.6);
    }
    for lobe in [Lobe::Gaussian, Lobe::Lambert(lambert_power(angle))] {
        close(lamp(lobe).intensity_w_sr((angle / 2.0).cos()), 0.129 / 2.0, 1e-6);
        assert!(lamp(lobe).intensity_w_sr(-0.1) == 0.0);
        // The lobe holds the flux: integral over the half-space.
        let n = 20_000;
        let flux: f64 = (0..n)
            .map(|i| {
                let off = PI / 2.0 * (f64::from(i) + 0.5) / f64::from(n);
                lamp(lobe).intensity_w_sr(off.cos()) * 2.0 * PI * off.sin()
            })
            .sum::<f64>()
            * PI
            / 2.0
            / f64::from(n);
        within(flux * 1e3, 10.0, 0.1);
        let edge = lamp(lobe).cosine_at_share(1e-4);
        close(lamp(lobe).intensity_w_sr(edge), 0.129e-4, 1e-4);
    }
}

#[test]
fn shades_block_what_is_behind_them() {
    let (a, b) = (Point::new(0.0, 0.0, 1.0), Point::new(0.0, 0.0, -1.0));
    let at = |x: f64| Point::new(x, 0.0, 0.0);
    let disc = |x| Shade::Disc { centre: at(x), normal: Vector::z() * 3.0, radius_m: 0.5 };
    assert!(disc(0.4).blocks(a, b) && !disc(0.6).blocks(a, b));
    assert!(!disc(0.0).blocks(a, Point::new(0.0, 0.0, 0.5)));
    let ring = |x| Shade::Ring { centre: at(x), axis: Vector::z(), inner_m: 0.2, outer_m: 0.5 };
    assert!(!ring(0.1).blocks(a, b) && ring(0.3).blocks(a, b) && !ring(0.6).blocks(a, b));
    let ball = |x| Shade::Sphere { centre: at(x), radius_m: 0.5 };
    assert!(ball(0.49).blocks(a, b) && !ball(0.51).blocks(a, b));
    let rod = |x| Shade::Capsule {
        from: Point::new(x, -1.0, 0.0),
        to: Point::new(x, 1.0, 0.0),
        radius_m: 0.5,
    };
    assert!(rod(0.49).blocks(a, b) && !rod(0.51).blocks(a, b));
    let cone = |x: f64| Shade::Cone {
        from: Point::new(x, 0.0, 0.5),
        to: Point::new(x, 0.0, -0.5),
        radius_from_m: 0.5,
        radius_to_m: 0.25,
    };
    assert!(cone(0.49).blocks(a, b) && !cone(0.51).blocks(a, b));
    let level = |z: f64| (Point::new(-1.0, 0.3, z), Point::new(1.0, 0.3, z));
    assert!(cone(0.0).blocks(level(0.0).0, level(0.0).1));
    assert!(!cone(0.0).blocks(level(-0.4).0, level(-0.4).1));
    assert!(!cone(0.0).blocks(level(0.6).0, level(0.6).1));
}

/// A point inside a solid shade.
fn inside(shade: &Shade, p: Point) -> bool {
    match *shade {
        Shade::Sphere { centre, radius_m } => (p - centre).norm() < radius_m,
        Shade::Cone { from, to, radius_from_m, radius_to_m } => {
            let axis = to - from;
            let share = (p - from).dot(&axis) / axis.norm_squared();
            let off = (p - from - axis * share).norm();
            (0.0..=1.0).contains(&share)
                && off < radius_from_m + (radius_to_m - radius_from_m) * share
        }
        Shade::Capsule { from, to, radius_m } => {
            let axis = to - from;
            let share = ((p - from).dot(&axis) / axis.norm_squared()).clamp(0.0, 1.0);
            (p - from - axis * share).norm() < radius_m
        }
        _ => false,
    }
}

fn any_point() -> impl Strategy<Value = Point> {
    (-2.0..2.0, -2.0..2.0, -2.0..2.0_f64).prop_map(|(x, y, z)| Point::new(x, y, z))
}

proptest! {
    #[test]
    fn solids_against_points_along_the_line(
        a in any_point(), b in any_point(), p in any_point(), q in any_point(),
        r in 0.05..1.0, s in 0.05..1.0_f64,
    ) {
        let solids = [
            Shade::Sphere { centre: p, radius_m: r },
            Shade::Cone { from: p, to: q, radius_from_m: r, radius_to_m: s },
            Shade::Capsule { from: p, to: q, radius_m: r },
        ];
        for solid in solids {
            let hit = (0..=400).any(|i| inside(&solid, a + (b - a) * (f64::from(i) / 400.0)));
            // A point inside means blocked; no point inside at 400 means blocked by a sliver at most.
            prop_assert!(!hit || solid.blocks(a, b));
            let (centre, size) = solid.ball();
            prop_assert!(!hit || super::shade::to_line_m2(centre, a, b) <= size * size * 1.000_001);
            if solid.blocks(a, b) && !hit {
                let dense = (0..=20_000).any(|i| inside(&solid, a + (b - a) * (f64::from(i) / 2e4)));
                let length = (b - a).norm();
                prop_assert!(dense || length < 1e-3 || grazes(&solid, a, b));
            }
        }
    }

    #[test]
    fn any_input_gives_an_answer(
        values in proptest::collection::vec(
            prop_oneof![any::<f64>(), -1.0..1.0_f64, Just(0.0), Just(f64::NAN)], 24),
        count in 0..5_usize,
    ) {
        let p = |i: usize| Point::new(values[i], values[i + 1], values[i + 2]);
        let shades = vec![
            Shade::Cone { from: p(0), to: p(3), radius_from_m: values[6], radius_to_m: values[7] },
            Shade::Ring { centre: p(8), axis: p(11).coords, inner_m: values[14], outer_m: values[15] },
            Shade::Capsule { from: p(1), to: p(4), radius_m: values[8] },
        ];
        for shade in &shades {
            let _ = (shade.blocks(p(16), p(19)), shade.ball());
        }
        let lamp = Lamp {
            at: p(0), along: p(3).coords, peak_w_sr: values[6],
            full_angle_rad: values[7], lobe: Lobe::Lambert(values[8]),
        };
        let other = Lamp { lobe: Lobe::Gaussian, ..lamp };
        let lights = on_tool(vec![lamp, other], shades);
        let mut stations = straight(values[9], 5, values[10]);
        stations[2].point = p(11);
        stations[3].time_s = values[14];
        stations[4].part_from_tool.translation.vector = p(16).coords;
        let run = Run { stations: &stations[..count], dwell_s: values[20], lights: &lights };
        let strand = Strand { radius_m: values[21], critical_j_m2: values[22], azimuths: count * 40 };
        let doses = strand_dose(&run, &strand);
        prop_assert!(doses.len() == count.saturating_sub(1));
        let section = Section {
            radius_m: values[21], penetration_m: values[22], critical_j_m2: values[23],
            doses_j_m2: &values[..9], inside: Inside::Straight,
        };
        prop_assert!((0.0..=1.0).contains(&section.cured().area_fraction) || values[..9].iter().any(|v| !v.is_finite()));
    }
}

/// Whether a solid a per mille larger has a point of the line inside: touched, then.
fn grazes(solid: &Shade, a: Point, b: Point) -> bool {
    let larger = match *solid {
        Shade::Sphere { centre, radius_m } => Shade::Sphere { centre, radius_m: radius_m * 1.001 },
        Shade::Capsule { from, to, radius_m } => {
            Shade::Capsule { from, to, radius_m: radius_m * 1.001 }
        }
        Shade::Cone { from, to, radius_from_m, radius_to_m } => Shade::Cone {
            from: from + (from - to) * 1e-3,
            to: to + (to - from) * 1e-3,
            radius_from_m: radius_from_m * 1.001,
            radius_to_m: radius_to_m * 1.001,
        },
        other => other,
    };
    (0..=2000).any(|i| inside(&larger, a + (b - a) * (f64::from(i) / 2000.0)))
}

#[test]
fn shadow_lies_where_it_is_asked_for() {
    let place = ring(2e-3);
    let shade = place.shadow(0.8e-3, 1.5e-3, 4e-3);
    let side = |mm: f64| {
        let lamp = lamps(place)[0];
        surface_irradiance_w_m2(&[lamp], &[shade], Point::new(1.5e-3, 0.0, mm * 1e-3), Vector::x())
    };
    assert!(side(0.79) == 0.0 && side(0.81) > 0.0);
    // The nozzle of the tool file does not reach into that light.
    let free = |mm: f64| nozzle().blocks(lamps(place)[0].at, Point::new(1.5e-3, 0.0, mm * 1e-3));
    assert!(!free(0.81));
}

#[test]
fn bed_throws_back_what_falls_on_it() {
    // A tilted lamp high above the bed and a place: brute force over the plane.
    let lamp = Lamp { at: Point::new(0.01, 0.0, -0.02), ..lamp(Lobe::Lambert(8.0)) };
    let bed = Bed { point: Point::new(0.0, 0.0, 0.01), normal: -Vector::z(), albedo: 0.4 };
    let mut worst: f64 = 0.0;
    for (x, z, facing) in [
        (0.0, 0.0, Vector::z()),
        (0.02, 0.0, Vector::z()),
        (0.0, 0.009, Vector::z()),
        (0.0, 0.0, Vector::new(0.6, 0.0, 0.8)),
    ] {
        let place = Point::new(x, 0.0, z);
        let (cells, size) = (900, 0.2);
        let mut want = 0.0;
        for i in 0..cells {
            for j in 0..cells {
                let at = |k: i32| size * ((f64::from(k) + 0.5) / f64::from(cells) - 0.5);
                let lit = Point::new(at(i), at(j), 0.01);
                let glow = 0.4 / PI * -lamp.irradiance_w_m2(lit).dot(&bed.normal);
                let ray = place - lit;
                let cosines = ray.dot(&bed.normal) * (-ray.dot(&facing)).max(0.0);
                want +=
                    glow * cosines / ray.norm_squared().powi(2) * (size / f64::from(cells)).powi(2);
            }
        }
        let got = bed.reflected_w_m2(&[lamp], &[], place, facing);
        worst = worst.max((got / want - 1.0).abs());
    }
    assert!(worst < 0.02, "{worst}");
    // Close to the bed it is the albedo times what falls there; black and behind the bed, nothing.
    let near = Point::new(0.005, 0.0, 0.01 - 1e-7);
    let falls = lamp.irradiance_w_m2(near).z;
    close(bed.reflected_w_m2(&[lamp], &[], near, Vector::z()), 0.4 * falls, 1e-3);
    assert!(bed.reflected_w_m2(&[lamp], &[], Point::new(0.0, 0.0, 0.02), Vector::z()) == 0.0);
    let black = Bed { albedo: 0.0, ..bed };
    assert!(black.reflected_w_m2(&[lamp], &[], Point::origin(), Vector::z()) == 0.0);
}

#[test]
fn lights_go_on_when_the_bed_is_far_enough() {
    let place = ring(2e-3);
    let (all, shades) = (lamps(place), [place.shadow(0.8e-3, 1.5e-3, 4e-3), nozzle()]);
    let tip = Tip { rim_m: 2.2e-3, lamps: &all, shades: &shades };
    // In the shadow nothing comes straight; without it the rim's outside is lit.
    assert!(tip.light(0.01, 0.3).direct_w_m2 == 0.0);
    let bare = Tip { shades: &[], ..tip };
    assert!(bare.light(0.01, 0.3).direct_w_m2 > 100.0);
    // Fades with the bed's distance beyond the aim, in proportion to the albedo.
    let at = |mm: f64| tip.light(mm * 1e-3, 0.3).reflected_w_m2;
    assert!(at(3.0) > at(5.0) && at(5.0) > at(8.0) && at(8.0) > at(20.0));
    close(tip.light(5e-3, 0.6).reflected_w_m2, 2.0 * at(5.0), 1e-12);
    // A limit is met exactly at the distance found, and a stricter one is farther.
    let mut last_m = 0.0;
    for limit in [60.0, 15.0] {
        let clear_m = tip.clear_m(limit, 0.3, 0.05);
        assert!(clear_m > last_m);
        close(tip.light(clear_m, 0.3).reflected_w_m2, limit, 2e-2);
        last_m = clear_m;
    }
    assert!(tip.clear_m(1e9, 0.3, 0.05) == 0.0 && tip.clear_m(1e-9, 0.3, 0.05).is_infinite());
    close(tip_limit_w_m2(0.5, 126.0, 1.5), 42.0, 1e-12);
    // Nearer the bed, longer in the dark; slanting, longer still.
    within(lights_on_after_m(3e-3, 0.0, 1.0), 3e-3, 1e-12);
    within(lights_on_after_m(3e-3, 1e-3, 0.5), 4e-3, 1e-12);
    assert!(lights_on_after_m(3e-3, 3e-3, 0.0) == 0.0);
    assert!(lights_on_after_m(3e-3, 1e-3, 0.0).is_infinite());
    let lengths: Vec<f64> =
        (0..50).map(|i| lights_on_after_m(3e-3, 1e-4 * f64::from(i), 0.8)).collect();
    assert!(lengths.windows(2).all(|w| w[1] <= w[0]));
}

#[test]
fn set_distance_has_a_band() {
    let band = SetBand { near_m: 1e-3, far_m: 3.5e-3 };
    assert_eq!(band.place(0.9e-3), SetPlace::TooNear);
    assert_eq!(band.place(1.5e-3), SetPlace::Inside);
    assert_eq!(band.place(f64::INFINITY), SetPlace::TooFar);
    assert_eq!(band.place(f64::NAN), SetPlace::TooFar);
    let [slow, fast] = band.speeds_m_s(0.8e-3, 0.34);
    within(cure::set_distance_m(0.8e-3, slow, 0.34), 1e-3, 1e-12);
    within(cure::set_distance_m(0.8e-3, fast, 0.34), 3.5e-3, 1e-12);
}
