//! Heavy elasticas and beams from the co-rotational rod.

use std::f64::consts::PI;

use super::super::elastica::heavy_elastica;
use super::super::tests::{close, within};
use super::*;

/// A rod of length one and stiffness one, weight `k`, hardly stretching, in `count` pieces.
fn rod(k: f64, count: usize) -> Vec<HeavyPiece> {
    let length_m = 1.0 / count as f64;
    vec![HeavyPiece { length_m, bending_n_m2: 1.0, axial_n: 1e8, line_mass_kg_m: k }; count]
}

fn cantilever(pieces: &[HeavyPiece], angle_rad: f64, gravity_m_s2: [f64; 2]) -> HeavyRod<'_> {
    let clamp = Support::Clamped { at_m: [0.0; 2], angle_rad };
    HeavyRod { pieces, from_m: [0.0; 2], angle_rad, ends: [clamp, Support::Free], gravity_m_s2 }
}

fn hung(rod: &HeavyRod, cuts: u32) -> Hanging {
    hang(rod, cuts).unwrap_or_else(|error| panic!("{error:?}"))
}

fn hung_fine(rod: &HeavyRod, cuts: u32) -> Hanging {
    hang_fine(rod, cuts).unwrap_or_else(|error| panic!("{error:?}"))
}

/// Drop, shortening and tip angle against the table's digits; the case allows 2e-5.
fn elastica(k: f64, drop: f64, shortening: f64, tip_rad: f64) {
    let pieces = rod(k, 16);
    let out = hung_fine(&cantilever(&pieces, 0.0, [0.0, -1.0]), 1);
    assert!(out.stable);
    within(-out.points_m[16][1], drop, 1e-6);
    within(1.0 - out.points_m[16][0], shortening, 1e-6);
    within(-out.angles_rad[16], tip_rad, 1e-6);
}

#[test]
fn elastica_k0_1() {
    elastica(0.1, 0.012498, 8.9e-05, 0.016665);
}

#[test]
fn elastica_k1() {
    elastica(1.0, 0.123471, 0.008754, 0.165116);
}

#[test]
fn elastica_k2() {
    elastica(2.0, 0.238507, 0.033107, 0.321594);
}

#[test]
fn elastica_k4() {
    elastica(4.0, 0.425159, 0.109889, 0.588592);
}

#[test]
fn elastica_k8() {
    elastica(8.0, 0.640631, 0.275575, 0.940122);
}

#[test]
fn elastica_k16() {
    elastica(16.0, 0.79702, 0.490005, 1.260253);
}

#[test]
fn elastica_k32() {
    elastica(32.0, 0.878457, 0.671507, 1.46136);
}

/// A round strand in pieces: diameter and length m, modulus Pa, density.
fn round(
    diameter_m: f64,
    length_m: f64,
    modulus_pa: f64,
    density: f64,
    count: usize,
) -> Vec<HeavyPiece> {
    let area_m2 = PI * diameter_m * diameter_m / 4.0;
    let piece = HeavyPiece {
        length_m: length_m / count as f64,
        bending_n_m2: modulus_pa * area_m2 * diameter_m * diameter_m / 16.0,
        axial_n: modulus_pa * area_m2,
        line_mass_kg_m: density * area_m2,
    };
    vec![piece; count]
}

const DOWN: [f64; 2] = [0.0, -9.81];

fn clamp(x_m: f64) -> Support {
    Support::Clamped { at_m: [x_m, 0.0], angle_rad: 0.0 }
}

#[test]
fn eb_cant_selfweight() {
    let pieces = round(0.0015, 0.1, 3.457e9, 1210.0, 8);
    let out = hung_fine(&cantilever(&pieces, 0.0, DOWN), 1);
    close(-out.points_m[8][1], 0.000_305_212_612_091_408_8, 0.001);
}

#[test]
fn eb_cc_selfweight() {
    let pieces = round(0.003, 0.15, 3.5e9, 1250.0, 16);
    let ends = [clamp(0.0), clamp(0.15)];
    let out = hung_fine(&HeavyRod { ends, ..cantilever(&pieces, 0.0, DOWN) }, 1);
    close(-out.points_m[8][1], 8.211_495_535_714_286e-6, 0.001);
}

#[test]
fn eb_closed_forms() {
    // Stiff enough that slopes are of 1e-6: the rod's Richardson to 1e-6, the closed forms themselves in `sag`.
    let (diameter_m, length_m, modulus_pa, density) = (0.003, 0.15, 3.5e12, 1250.0);
    let pieces = round(diameter_m, length_m, modulus_pa, density, 16);
    let scale = density * 9.81 * length_m.powi(4) / (modulus_pa * diameter_m * diameter_m);
    let beam = super::super::sag::SetBeam {
        diameter_m,
        density_kg_m3: density,
        across_m_s2: 9.81,
        youngs_modulus_pa: modulus_pa,
    };
    let hinge = |x_m: f64| Support::Hinged { at_m: [x_m, 0.0] };
    for (ends, at, closed, want) in [
        ([clamp(0.0), Support::Free], 16, beam.cantilever_m(length_m), 2.0),
        ([clamp(0.0), clamp(length_m)], 8, beam.clamped_m(length_m), 1.0 / 24.0),
        ([hinge(0.0), hinge(length_m)], 8, beam.simply_supported_m(length_m), 5.0 / 24.0),
    ] {
        close(closed, want * scale, 1e-12);
        let out = hung_fine(&HeavyRod { ends, ..cantilever(&pieces, 0.0, DOWN) }, 1);
        close(-out.points_m[at][1], want * scale, 1e-6);
    }
}

#[test]
fn smay_span() {
    // G = (25/18) w s⁴ D, E = 3 G: a span of 20 diameters, free to turn, sags a twentieth of the diameter
    let (diameter_m, density) = (0.001, 1210.0);
    let shear_pa = 25.0 / 18.0 * density * 9.81 * 20.0_f64.powi(4) * diameter_m;
    let set = super::super::sag::SetBeam {
        diameter_m,
        density_kg_m3: density,
        across_m_s2: 9.81,
        youngs_modulus_pa: 3.0 * shear_pa,
    };
    close(set.simply_supported_m(0.02), 0.05 * diameter_m, 1e-6);
    // The rod between hinges that do not give is pulled taut a little: 1 % less at a twentieth of its diameter.
    // (The small-slope rod, which knows no such pull, is held to the case in `rod`.)
    let pieces = round(diameter_m, 0.02, 3.0 * shear_pa, density, 16);
    let ends = [0.0, 0.02].map(|x_m| Support::Hinged { at_m: [x_m, 0.0] });
    let out = hung_fine(&HeavyRod { ends, ..cantilever(&pieces, 0.0, DOWN) }, 1);
    within(-out.points_m[8][1] / (0.05 * diameter_m), 0.99, 0.002);
}

#[test]
fn second_order_in_elements_and_richardson() {
    let exact = heavy_elastica(8.0, 2000);
    let pieces = rod(8.0, 4);
    let held = cantilever(&pieces, 0.0, [0.0, -1.0]);
    let error = |cuts| (-hung(&held, cuts).points_m[4][1] - exact.drop).abs();
    let fine = |cuts| (-hung_fine(&held, cuts).points_m[4][1] - exact.drop).abs();
    for cuts in [2, 4, 8, 16] {
        let order = (error(cuts) / error(2 * cuts)).log2();
        assert!((1.9..2.1).contains(&order), "{order}");
    }
    // 8, 16 and 32 elements: nothing left but stretching (a part in 1e8) and rounding
    assert!(error(8) > 1e-5 && fine(2) < 1e-7, "{} {}", error(8), fine(2));
}

#[test]
fn turns_with_everything() {
    let pieces = rod(6.0, 16);
    let level = hung(&cantilever(&pieces, 0.3, [0.2, -1.0]), 2);
    for turn in [0.7_f64, 2.5, -1.9] {
        let (sin, cos) = turn.sin_cos();
        let turned = |p: [f64; 2]| [cos * p[0] - sin * p[1], sin * p[0] + cos * p[1]];
        let out = hung(&cantilever(&pieces, 0.3 + turn, turned([0.2, -1.0])), 2);
        for (got, want) in out.points_m.iter().zip(&level.points_m) {
            let want = turned(*want);
            within(got[0], want[0], 1e-8);
            within(got[1], want[1], 1e-8);
        }
    }
    // all lengths twice: the same shape where q L³/EI is the same
    let large: Vec<HeavyPiece> = pieces
        .iter()
        .map(|p| HeavyPiece {
            length_m: 2.0 * p.length_m,
            bending_n_m2: 8.0 * p.bending_n_m2,
            axial_n: 2.0 * p.axial_n,
            ..*p
        })
        .collect();
    let out = hung(&cantilever(&large, 0.3, [0.2, -1.0]), 2);
    within(out.points_m[16][1], 2.0 * level.points_m[16][1], 1e-8);
    // the same rod in space, gravity any way
    let along = [1.0 / 3.0, 2.0 / 3.0, -2.0 / 3.0];
    let points = droop(&pieces, [1.0, 2.0, 3.0], along, [0.0, 0.0, -1.0], 1)
        .unwrap_or_else(|error| panic!("{error:?}"));
    let slope = (-2.0_f64 / 3.0).asin();
    let flat = hung_fine(&cantilever(&pieces, slope, [0.0, -1.0]), 1);
    within(points[16][2] - 3.0, flat.points_m[16][1], 1e-7);
    let out = (points[16][0] - 1.0).hypot(points[16][1] - 2.0);
    within(out, flat.points_m[16][0], 1e-7);
}

#[test]
fn ends_and_slack() {
    // A slack rod between clamps: 3 % longer than its chord, hangs as an arch upside down.
    let pieces = rod(20.0, 32);
    let ends = [clamp(0.0), clamp(0.97)];
    let out = hung(&HeavyRod { ends, ..cantilever(&pieces, 0.0, [0.0, -1.0]) }, 1);
    let drop = -out.points_m[16][1];
    within(out.points_m[16][0], 0.485, 1e-6);
    // as far as a cosine of that length, 2 L e^½/π: the weight deepens it little
    close(drop, 2.0 / PI * 0.03_f64.sqrt(), 0.01);
    within(out.points_m[32][0], 0.97, 1e-12);
    assert!(out.stable);
    // Hinged and very heavy: a catenary of length one over a chord of 0.8.
    let heavy = rod(1e4, 64);
    let ends = [0.0, 0.8].map(|x| Support::Hinged { at_m: [x, 0.0] });
    let out = hung(&HeavyRod { ends, ..cantilever(&heavy, 0.0, [0.0, -1.0]) }, 2);
    let (mut low, mut high): (f64, f64) = (0.05, 10.0);
    for _ in 0..100 {
        let a = 0.5 * (low + high);
        if 2.0 * a * (0.4 / a).sinh() > 1.0 { low = a } else { high = a }
    }
    within(-out.points_m[32][1], low * ((0.4 / low).cosh() - 1.0), 1e-4);
}

#[test]
fn upright_until_it_buckles() {
    // A pole of its own weight buckles at k = 7.8373 (Greenhill).
    for (k, stands) in [(7.7, true), (7.95, false)] {
        let pieces = rod(k, 32);
        let out = hung(&cantilever(&pieces, PI / 2.0, [0.0, -1.0]), 1);
        within(out.points_m[32][0], 0.0, 1e-9);
        assert_eq!(out.stable, stands, "{k}");
    }
}

#[test]
fn says_where_there_is_none() {
    let pieces = rod(1.0, 4);
    let loose = HeavyRod { ends: [Support::Free; 2], ..cantilever(&pieces, 0.0, [0.0, -1.0]) };
    assert_eq!(hang(&loose, 1), Err(HangError::NoEquilibrium));
    let bad = [HeavyPiece { bending_n_m2: f64::NAN, ..pieces[0] }];
    assert_eq!(hang(&cantilever(&bad, 0.0, [0.0, -1.0]), 1), Err(HangError::Input));
    assert_eq!(hang(&cantilever(&[], 0.0, [0.0, -1.0]), 1), Err(HangError::Input));
}

proptest::proptest! {
    #![proptest_config(proptest::test_runner::Config::with_cases(48))]
    #[test]
    fn any_rod_rests_or_says_so(
        k in proptest::num::f64::ANY,
        angle in -7.0..7.0_f64,
        (gx, gy) in (-50.0..50.0_f64, -50.0..50.0_f64),
        (x, y) in (-2.0..2.0_f64, -2.0..2.0_f64),
        kind in 0..3_u8,
    ) {
        let pieces = rod(k, 4);
        let end = match kind {
            0 => Support::Free,
            1 => Support::Hinged { at_m: [x, y] },
            _ => Support::Clamped { at_m: [x, y], angle_rad: angle },
        };
        let held = cantilever(&pieces, angle, [gx, gy]);
        if let Ok(out) = hang(&HeavyRod { ends: [held.ends[0], end], ..held }, 1) {
            proptest::prop_assert!(out.iterations <= ALL_ITERATIONS);
            proptest::prop_assert!(out.points_m.iter().flatten().all(|x| x.is_finite()));
        }
    }
}
