//! Cross-sections against sums over their area and a numeric Prandtl stress function.

use std::f64::consts::PI;

use proptest::prelude::*;

use super::section::{Section, flattened, round, shell, stadium_j_m4};
use super::tests::{close, within};

/// A quarter of a section symmetric both ways: half its width, and its half-height at each distance from the
/// middle.
struct Quarter<'a> {
    half_width: f64,
    half_height: &'a dyn Fn(f64) -> f64,
    /// The same boundary the other way: half-width at each height.
    half_width_at: &'a dyn Fn(f64) -> f64,
}

/// Torsion constant by the Prandtl stress function, `∇²φ = −2`, `φ = 0` outside, `J = 2 ∫ φ`.
///
/// Five-point differences with cut arms at the boundary (Shortley and Weller), successive over-relaxation, the
/// integral by columns; second order in the spacing.
fn prandtl_j(shape: &Quarter, spacing: f64) -> f64 {
    let columns = (shape.half_width / spacing - 1e-9).floor() as usize + 1;
    let rows: Vec<usize> = (0..columns)
        .map(|i| ((shape.half_height)(i as f64 * spacing) / spacing - 1e-9).floor() as usize + 1)
        .collect();
    let mut phi: Vec<Vec<f64>> = rows.iter().map(|&count| vec![0.0; count]).collect();
    let largest = columns.max(rows[0]) as f64;
    let omega = 2.0 / (1.0 + PI / (2.0 * rows[0] as f64).min(2.0 * largest));
    for _ in 0..20_000 {
        let mut change = 0.0_f64;
        for i in 0..columns {
            let y = i as f64 * spacing;
            for k in 0..rows[i] {
                let z = k as f64 * spacing;
                let up = (shape.half_height)(y) - z;
                let right = (shape.half_width_at)(z) - y;
                let (up, up_phi) =
                    if k + 1 < rows[i] { (spacing, phi[i][k + 1]) } else { (up.min(spacing), 0.0) };
                let (right, right_phi) = if i + 1 < columns && k < rows[i + 1] {
                    (spacing, phi[i + 1][k])
                } else {
                    (right.min(spacing), 0.0)
                };
                let (down, down_phi) = if k > 0 { (spacing, phi[i][k - 1]) } else { (up, up_phi) };
                let (left, left_phi) =
                    if i > 0 { (spacing, phi[i - 1][k]) } else { (right, right_phi) };
                let sum = up_phi / (up * (up + down))
                    + down_phi / (down * (up + down))
                    + right_phi / (right * (right + left))
                    + left_phi / (left * (right + left));
                let new = (1.0 + sum) / (1.0 / (up * down) + 1.0 / (right * left));
                let step = omega * (new - phi[i][k]);
                phi[i][k] += step;
                change = change.max(step.abs());
            }
        }
        if change < 1e-13 {
            break;
        }
    }
    let column = |i: usize| {
        let last = rows[i] - 1;
        let end = (shape.half_height)(i as f64 * spacing) - last as f64 * spacing;
        let inner: f64 = (0..last).map(|k| 0.5 * spacing * (phi[i][k] + phi[i][k + 1])).sum();
        inner + 0.5 * end * phi[i][last]
    };
    let last = columns - 1;
    let end = shape.half_width - last as f64 * spacing;
    let inner: f64 = (0..last).map(|i| 0.5 * spacing * (column(i) + column(i + 1))).sum();
    8.0 * (inner + 0.5 * end * column(last))
}

/// Torsion constant of a stadium of height 2 by differences, extrapolated from two spacings.
fn stadium_j(straight: f64, spacing: f64) -> f64 {
    let half = 0.5 * straight;
    let height = |y: f64| (1.0 - (y - half).max(0.0).powi(2)).max(0.0).sqrt();
    let width = |z: f64| half + (1.0 - z * z).max(0.0).sqrt();
    let shape = Quarter { half_width: half + 1.0, half_height: &height, half_width_at: &width };
    let (coarse, fine) = (prandtl_j(&shape, spacing), prandtl_j(&shape, 0.5 * spacing));
    fine + (fine - coarse) / 3.0
}

#[test]
fn torsion_of_known_shapes() {
    // Ellipse of half-axes 2 and 1: J = π a³ b³/(a² + b²); the error falls with the square of the spacing.
    let height = |y: f64| (1.0 - y * y / 4.0).max(0.0).sqrt();
    let width = |z: f64| 2.0 * (1.0 - z * z).max(0.0).sqrt();
    let ellipse = Quarter { half_width: 2.0, half_height: &height, half_width_at: &width };
    let errors: Vec<f64> = [8.0, 16.0, 32.0]
        .iter()
        .map(|count| 1.0 - prandtl_j(&ellipse, 1.0 / count) / (PI * 8.0 / 5.0))
        .collect();
    assert!(errors[2] < 4e-4);
    assert!(errors.windows(2).all(|pair| (3.5..4.5).contains(&(pair[0] / pair[1]))), "{errors:?}");
    // Rectangle 4 by 2: Saint-Venant's series
    let series: f64 =
        (0..50).map(|i| f64::from(2 * i + 1)).map(|n| (n * PI).tanh() / n.powi(5)).sum();
    let exact = 32.0 / 3.0 * (1.0 - 96.0 / PI.powi(5) * series);
    let rectangle = Quarter { half_width: 2.0, half_height: &|_| 1.0, half_width_at: &|_| 2.0 };
    let (coarse, fine) = (prandtl_j(&rectangle, 0.1), prandtl_j(&rectangle, 0.05));
    close(fine + (fine - coarse) / 3.0, exact, 1e-4);
}

#[test]
fn torsion_of_a_stadium() {
    for ratio in [0.0, 0.1, 0.3, 0.5, 0.75, 1.0, 2.0, 4.0] {
        let numeric = stadium_j(2.0 * ratio, 1.0 / 12.0);
        close(stadium_j_m4(2.0 * ratio, 2.0), numeric, 6e-4);
    }
    // Limits: round, and a thin strip
    close(stadium_j_m4(0.0, 0.001), round(0.001).j_m4, 1e-12);
    close(stadium_j_m4(1.0, 0.001), 1e-9 / 3.0, 3e-4);
}

/// Area and second moments of a stadium by the midpoint rule in strips along its height.
fn summed(section: &Section) -> (f64, f64, f64) {
    let strips = 20_000;
    let (h, b) = (section.height_m, section.width_m - section.height_m);
    (0..strips).fold((0.0, 0.0, 0.0), |(area, i_y, i_z), i| {
        let z = h * ((f64::from(i) + 0.5) / f64::from(strips) - 0.5);
        let width = b + 2.0 * (0.25 * h * h - z * z).sqrt();
        let strip = h / f64::from(strips);
        (area + width * strip, i_y + z * z * width * strip, i_z + width.powi(3) / 12.0 * strip)
    })
}

#[test]
fn flattened_bead() {
    let (flow, speed) = (6.33e-9, 0.005);
    let area = flow / speed;
    let diameter = (4.0 * area / PI).sqrt();
    for height in [0.1e-3, 0.4e-3, 0.8e-3, 1.2e-3] {
        let section = flattened(area, height);
        let (by_area, i_y, i_z) = summed(&section);
        close(by_area, area, 1e-5);
        close(section.i_y_m4, i_y, 1e-5);
        close(section.i_z_m4, i_z, 1e-5);
        close(section.width_m, flow / (speed * height) + height * (1.0 - PI / 4.0), 1e-12);
        assert!(section.width_m > diameter && section.i_z_m4 > section.i_y_m4);
        assert!(section.j_m4 < section.i_y_m4 + section.i_z_m4);
    }
    // w → Q/(v h) as the height falls
    let thin = flattened(area, 0.01e-3);
    close(thin.width_m, flow / (speed * 0.01e-3), 3e-5);
    close(thin.i_y_m4, thin.width_m * 0.01e-3_f64.powi(3) / 12.0, 1e-4);
    // Round where the height is the diameter or more, and continuous there
    assert_eq!(flattened(area, diameter), round(diameter));
    assert_eq!(flattened(area, 1.0), round(diameter));
    let below = flattened(area, diameter * (1.0 - 1e-9));
    close(below.width_m, diameter, 1e-8);
    close(below.i_z_m4, round(diameter).i_z_m4, 1e-8);
    close(below.j_m4, round(diameter).j_m4, 1e-8);
}

#[test]
fn shell_ei() {
    let (diameter, whole) = (0.003, round(0.003));
    close(whole.area_m2, PI * 0.0015 * 0.0015, 1e-12);
    close(whole.i_y_m4, PI * 0.0015_f64.powi(4) / 4.0, 1e-12);
    for share in [0.0, 0.05, 1.0 / 3.0, 0.7, 1.0] {
        let section = shell(diameter, share * 0.0015);
        let close = |got: f64, want: f64| within(got, want, 1e-9);
        close(section.i_y_m4 / whole.i_y_m4, 1.0 - (1.0 - share).powi(4));
        close(section.j_m4 / whole.j_m4, 1.0 - (1.0 - share).powi(4));
        close(section.area_m2 / whole.area_m2, 1.0 - (1.0 - share).powi(2));
    }
    // d/R = 1/3: 0.80 of EI, 0.56 of the area
    within(shell(diameter, 0.0005).i_z_m4 / whole.i_z_m4, 0.80, 0.005);
    within(shell(diameter, 0.0005).area_m2 / whole.area_m2, 0.56, 0.005);
    assert_eq!(shell(diameter, 1.0), whole);
    assert!(shell(diameter, -1.0).area_m2 == 0.0 && shell(diameter, f64::NAN).i_y_m4.is_nan());
}

#[test]
fn sections_scale() {
    // Twice the size: area fourfold, second moments sixteenfold
    let (one, two) = (flattened(1e-6, 5e-4), flattened(4e-6, 1e-3));
    close(two.area_m2, 4.0 * one.area_m2, 1e-12);
    close(two.width_m, 2.0 * one.width_m, 1e-12);
    for law in [|s: &Section| s.i_y_m4, |s: &Section| s.i_z_m4, |s: &Section| s.j_m4] {
        close(law(&two), 16.0 * law(&one), 1e-12);
    }
}

proptest! {
    #[test]
    fn any_section(area in any::<f64>(), height in any::<f64>()) {
        let section = flattened(area, height);
        let sizes = [section.area_m2, section.i_y_m4, section.i_z_m4, section.j_m4, section.width_m];
        if (1e-12..1e-2).contains(&area) && (1e-6..1.0).contains(&height) {
            prop_assert!(sizes.iter().all(|size| size.is_finite() && *size > 0.0));
        }
        if !(area > 0.0 && height > 0.0) && area != 0.0 {
            prop_assert!(section.width_m.is_nan() && section.i_z_m4.is_nan() && section.j_m4.is_nan());
        }
        prop_assert!(area != 0.0 || height < 0.0 || height.is_nan() || section == round(0.0));
        let shell = shell(area.abs(), height);
        prop_assert!(shell.area_m2.is_nan() || shell.area_m2 >= 0.0);
    }

    #[test]
    fn pressed_flatter_is_wider(area in 1e-8..1e-4_f64, height in 0.05..0.99_f64, flatter in 0.5..0.99_f64) {
        let diameter = (4.0 * area / PI).sqrt();
        let (high, low) = (flattened(area, height * diameter), flattened(area, height * flatter * diameter));
        prop_assert!(low.width_m > high.width_m && low.i_y_m4 < high.i_y_m4 && low.i_z_m4 > high.i_z_m4);
        prop_assert!(low.j_m4 < high.j_m4);
    }
}
