//! Sections of many beads against closed forms.

use std::f64::consts::PI;

use proptest::prelude::*;

use super::*;
use crate::structure::{Bead, BeadsFault, Bundle, bundle, torsion_ceiling_m4};

fn rectangle(width_m: f64, height_m: f64, at_m: [f64; 2]) -> Bead {
    let section = Section {
        area_m2: width_m * height_m,
        iy_m4: width_m * height_m.powi(3) / 12.0,
        iz_m4: width_m.powi(3) * height_m / 12.0,
        ..Section::ellipse(width_m, height_m)
    };
    Bead { section, half_m: [width_m / 2.0, height_m / 2.0], at_m }
}

/// Two circles of diameter d that touch: `I = 2 (π d⁴/64 + π d²/4 · d²/4) = 5 π d⁴/32` about the
/// line between them, `2 π d⁴/64` about the line through them; outermost fibre d.
#[test]
fn two_circles_touching() {
    let d = 2e-3;
    for angle in [0.0f64, 0.3, PI / 4.0, -0.7] {
        let at = [angle.cos() * d / 2.0, angle.sin() * d / 2.0];
        let circle = |at_m| Bead { section: Section::circle(d), half_m: [d / 2.0; 2], at_m };
        let pair = [circle([at[0] + 1.0, at[1]]), circle([1.0 - at[0], -at[1]])];
        let one = bundle(&pair, 1.0).unwrap();
        near(one.section.area_m2, PI * d * d / 2.0, 1e-14);
        near(one.centroid_m[0], 1.0, 1e-12);
        assert!(one.centroid_m[1].abs() < 1e-18);
        let (small, large) = (PI * d.powi(4) / 32.0, 5.0 * PI * d.powi(4) / 32.0);
        near(one.section.iy_m4.min(one.section.iz_m4), small, 1e-9);
        near(one.section.iy_m4.max(one.section.iz_m4), large, 1e-9);
        assert!((one.roll_rad - angle).abs() < 1e-9, "{} is not {angle}", one.roll_rad);
        near(one.section.fibre_m, d, 1e-9);
        near(one.section.j_m4, PI * d.powi(4) / 16.0, 1e-14);
        // slipping: two rods side by side
        let two = bundle(&pair, 0.0).unwrap();
        near(two.section.iy_m4, small, 1e-14);
        near(two.section.iz_m4, small, 1e-14);
        near(two.section.fibre_m, d / 2.0, 1e-14);
        // half way is the mean of the two, by Steiner's rule
        let half = bundle(&pair, 0.5).unwrap();
        near(half.section.iy_m4.max(half.section.iz_m4), (small + large) / 2.0, 1e-9);
    }
}

/// A wall of n rectangles is one rectangle: `b h³/12` to rounding, and its corner.
#[test]
fn a_stack_of_rectangles_is_a_rectangle() {
    for count in [1usize, 2, 7, 60] {
        let (width, height) = (1.2e-3, 0.3e-3);
        let at = |k: usize| [0.0, (k as f64 + 0.5) * height];
        let wall: Vec<Bead> = (0..count).map(|k| rectangle(width, height, at(k))).collect();
        let got = bundle(&wall, 1.0).unwrap();
        let tall = count as f64 * height;
        near(got.section.iy_m4, width * tall.powi(3) / 12.0, 1e-12);
        near(got.section.iz_m4, width.powi(3) * tall / 12.0, 1e-12);
        near(got.centroid_m[1], tall / 2.0, 1e-13);
        near(got.half_m[0], width / 2.0, 1e-13);
        near(got.half_m[1], tall / 2.0, 1e-12);
        assert!(got.section.fibre_m <= (width / 2.0).hypot(tall / 2.0) * (1.0 + 1e-12));
        assert!(got.section.fibre_m >= tall / 2.0);
        assert_eq!(got.roll_rad, 0.0);
    }
}

/// Flattened beads lose their corners: the stack tends to `b h³/12` as its beads get thinner, with
/// the part `(1 - π/4) h/w` that the corners leave out.
#[test]
fn a_stack_of_flattened_beads_tends_to_a_rectangle() {
    let (width, tall) = (1.0e-3, 4.0e-3);
    let gap = |count: usize| {
        let height = tall / count as f64;
        let at = |k: usize| [0.0, (k as f64 + 0.5) * height];
        let wall: Vec<Bead> = (0..count).map(|k| Bead::flattened(width, height, at(k))).collect();
        1.0 - bundle(&wall, 1.0).unwrap().section.iy_m4 / (width * tall.powi(3) / 12.0)
    };
    for count in [8, 32, 128] {
        let lost = (1.0 - PI / 4.0) * tall / (count as f64 * width);
        near(gap(count), lost, 0.03);
    }
    // a bead as high as wide is a circle
    let round = Bead::flattened(2e-3, 2e-3, [0.0; 2]).section;
    let circle = Section::circle(2e-3);
    near(round.area_m2, circle.area_m2, 1e-14);
    near(round.iy_m4, circle.iy_m4, 1e-14);
    near(round.iz_m4, circle.iz_m4, 1e-14);
    // Iz by brute force: strips along z
    let (width, height) = (1.3e-3, 0.4e-3);
    let (n, mut area, mut iz) = (400_000, 0.0, 0.0);
    for k in 0..n {
        let y = (k as f64 + 0.5) / n as f64 * width - width / 2.0;
        let past = (y.abs() - (width - height) / 2.0).max(0.0);
        let strip = 2.0 * ((height / 2.0).powi(2) - past * past).sqrt() * width / n as f64;
        area += strip;
        iz += strip * y * y;
    }
    let got = Bead::flattened(width, height, [0.0; 2]).section;
    near(got.area_m2, area, 1e-7);
    near(got.iz_m4, iz, 1e-7);
}

#[test]
fn nonsense_is_refused() {
    let bead = Bead::flattened(1e-3, 0.5e-3, [0.0; 2]);
    assert_eq!(bundle(&[], 1.0), Err(BeadsFault::Empty));
    assert_eq!(bundle(&[bead], 1.1), Err(BeadsFault::BadBond { bond: 1.1 }));
    assert!(bundle(&[bead], f64::NAN).is_err());
    let lost = Bead { at_m: [f64::NAN, 0.0], ..bead };
    assert_eq!(bundle(&[bead, lost], 1.0), Err(BeadsFault::BadBead { bead: 1 }));
    let inside_out = Bead::flattened(0.1e-3, 0.5e-3, [0.0; 2]);
    assert_eq!(bundle(&[inside_out], 1.0), Err(BeadsFault::BadBead { bead: 0 }));
}

fn any_bead() -> impl Strategy<Value = Bead> {
    (1e-4..3e-3, 0.1..1.0f64, -5e-3..5e-3, -5e-3..5e-3)
        .prop_map(|(w, flat, y, z)| Bead::flattened(w, w * flat, [y, z]))
}

proptest! {
    /// Bonded is never softer than slipping, J never above its ceiling, the trace does not turn, and
    /// a bundle put together in another place or order is the same.
    #[test]
    fn what_must_hold(beads in prop::collection::vec(any_bead(), 1..12), bond in 0.0..1.0f64) {
        let [slip, part, one] = [0.0, bond, 1.0].map(|bond| bundle(&beads, bond).unwrap());
        for (soft, stiff) in [(slip, part), (part, one)] {
            let low = |b: &Bundle| b.section.iy_m4.min(b.section.iz_m4);
            prop_assert!(low(&soft) <= low(&stiff) * (1.0 + 1e-9));
            prop_assert!(soft.section.fibre_m <= stiff.section.fibre_m * (1.0 + 1e-12));
        }
        prop_assert!(one.section.j_m4 <= torsion_ceiling_m4(&one.section) * (1.0 + 1e-9));
        let moved: Vec<Bead> = beads
            .iter()
            .rev()
            .map(|bead| Bead { at_m: [bead.at_m[0] + 0.01, bead.at_m[1] - 0.02], ..*bead })
            .collect();
        let other = bundle(&moved, bond).unwrap();
        let trace = |b: &Bundle| b.section.iy_m4 + b.section.iz_m4;
        prop_assert!((trace(&other) / trace(&part) - 1.0).abs() < 1e-9);
        prop_assert!((other.section.fibre_m / part.section.fibre_m - 1.0).abs() < 1e-9);
    }

    #[test]
    fn any_input_is_answered(numbers in prop::array::uniform6(any::<f64>()), bond in any::<f64>()) {
        let [width, height, y, z, ..] = numbers;
        let beads = [Bead::flattened(width, height, [y, z]), Bead::flattened(1e-3, 1e-3, [0.0; 2])];
        let _ = bundle(&beads, bond);
    }
}
