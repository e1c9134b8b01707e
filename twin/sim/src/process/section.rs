//! Cross-sections as a frame wants them: round, flattened, shell.
//!
//! Axes: `y` across the strand along the bed, `z` up from it; round sections are the same about both.

use std::f64::consts::PI;

/// Properties of a cross-section.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Section {
    /// Area, m².
    pub area_m2: f64,
    /// Second moment of area about the axis `y`, `∫ z² dA`, m⁴: bending up and down.
    pub i_y_m4: f64,
    /// Second moment of area about the axis `z`, `∫ y² dA`, m⁴: bending sideways.
    pub i_z_m4: f64,
    /// Torsion constant (Saint-Venant), m⁴.
    pub j_m4: f64,
    /// Extent along `y`, m.
    pub width_m: f64,
    /// Extent along `z`, m.
    pub height_m: f64,
}

/// Round section: `A = π D²/4`, `I = π D⁴/64`, `J = 2 I`. Exact.
pub fn round(diameter_m: f64) -> Section {
    let area_m2 = 0.25 * PI * diameter_m * diameter_m;
    let i_m4 = area_m2 * diameter_m * diameter_m / 16.0;
    Section {
        area_m2,
        i_y_m4: i_m4,
        i_z_m4: i_m4,
        j_m4: 2.0 * i_m4,
        width_m: diameter_m,
        height_m: diameter_m,
    }
}

/// Section of a bead laid on bed or form: a rectangle with half-round sides of this area and height.
///
/// Straight part `b = A/h − π h/4`, width `w = b + h = A/h + h (1 − π/4)`, `A = Q/v`; round, of the same
/// area, where `h` is the round diameter or more (what is free of the nozzle is not flattened). Exact:
/// `I_y = b h³/12 + π h⁴/64`, `I_z = h b³/12 + π h⁴/64 + π h² b²/16 + b h³/6`. [`stadium_j_m4`] gives `J`.
/// That the sides are half-round is the custom of slicers, not a solution for a spreading melt. Not a number
/// where area or height is not positive (an area of zero is a round of zero). Source of `w ≈ Q/(v h)`: issue
/// 4; process-physics.md section 4.
pub fn flattened(area_m2: f64, height_m: f64) -> Section {
    let diameter_m = (4.0 * area_m2 / PI).sqrt();
    if height_m >= diameter_m {
        return round(diameter_m);
    }
    let h = if area_m2 > 0.0 && height_m > 0.0 { height_m } else { f64::NAN };
    let b = area_m2 / h - 0.25 * PI * h;
    let half_rounds = PI * h.powi(4) / 64.0;
    Section {
        area_m2,
        i_y_m4: b * h.powi(3) / 12.0 + half_rounds,
        i_z_m4: h * b.powi(3) / 12.0
            + half_rounds
            + PI * (h * b).powi(2) / 16.0
            + b * h.powi(3) / 6.0,
        j_m4: stadium_j_m4(b, h),
        width_m: b + h,
        height_m: h,
    }
}

/// Torsion constant of a rectangle of straight part `b` and height `h` with half-round sides, m⁴.
///
/// `J = b h³/3 + h⁴ [c + (π/32 − c) e^(−3 b/h)]`, `c = 0.06996`: exact for a circle; both ends of a long
/// strip take `c h⁴`. Ours, fitted to the numeric Prandtl stress function of this shape (`b/h` from 0 to 6,
/// itself good to 1e-5): within 6e-4 of it everywhere. Range: `b ≥ 0`.
pub fn stadium_j_m4(straight_m: f64, height_m: f64) -> f64 {
    const ENDS: f64 = 0.069_96;
    let joined = (-3.0 * straight_m / height_m).exp();
    height_m.powi(3) * (straight_m / 3.0 + height_m * (ENDS + (PI / 32.0 - ENDS) * joined))
}

/// Shell of a strand cured to a depth from its surface: `A = π (R² − r²)`, `I = π (R⁴ − r⁴)/4`, `J = 2 I`,
/// `r = R − d`.
///
/// The shares of the full section are `1 − (1 − d/R)²` and `1 − (1 − d/R)⁴` (case SHELL-EI). What is inside
/// carries nothing. Exact; the depth is held to 0..R, and not a number makes everything so.
pub fn shell(diameter_m: f64, depth_m: f64) -> Section {
    let whole = round(diameter_m);
    let core = round(diameter_m - 2.0 * clamped(depth_m, 0.5 * diameter_m));
    let i_m4 = whole.i_y_m4 - core.i_y_m4;
    Section {
        area_m2: whole.area_m2 - core.area_m2,
        i_y_m4: i_m4,
        i_z_m4: i_m4,
        j_m4: 2.0 * i_m4,
        ..whole
    }
}

fn clamped(value: f64, high: f64) -> f64 {
    if value < 0.0 {
        0.0
    } else if value > high {
        high
    } else {
        value
    }
}
