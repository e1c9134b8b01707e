//! What an over-fed strand does with its excess: meanders, coils.
//!
//! Known: a viscous thread that leaves faster than its carrier moves folds from `v/v_free < 1` on (case
//! SEWING-ONSET, ±15 %), and at onset meanders with the frequency at which it would coil on a carrier at rest
//! (Brun, Ribe and others, Symmetry 2022 14(4):772, abstract). The excess length is mass balance. Not
//! established: the coil's frequency or radius for a strand in free air, the draw ratio at which meander
//! turns to coil, the amplitude (published models miss it, arXiv 2410.21503, abstract). So the frequency or
//! the wavelength is an argument, and the amplitude here is the geometry of a curve of that wavelength that
//! holds the excess.

use std::f64::consts::PI;

use super::bead::overfeed_strain;

/// Whether an over-fed strand folds.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Folding {
    /// Draw ratio above the doubt about the onset: laid straight.
    Straight,
    /// Within the doubt about the onset.
    MayFold,
    /// Below it: meanders or coils. Which of the two is not established.
    Folds,
}

/// Judges a draw ratio against an onset known to a relative doubt (one and 0.15: case SEWING-ONSET).
///
/// Not a number is `MayFold`.
pub fn folding(draw_ratio: f64, onset: f64, doubt: f64) -> Folding {
    if draw_ratio < onset * (1.0 - doubt) {
        Folding::Folds
    } else if draw_ratio > onset * (1.0 + doubt) {
        Folding::Straight
    } else {
        Folding::MayFold
    }
}

/// What an over-fed strand holds.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Overfeed {
    /// Length over the path's length, less one: `1/DR − 1`.
    pub strain: f64,
    /// Diameter of the thread itself, m: undrawn, `B D_n`, while the mean of the path is `D`.
    pub thread_m: f64,
    /// Length folded into a length of path, m.
    pub excess_m: f64,
}

/// Excess of a strand laid with a draw ratio along a path; `mean_m` is its diameter by mass balance.
///
/// `D_thread = D √DR` below a draw ratio of one: the thread that leaves is not drawn, so its length is `L/DR`
/// and its volume that of the mean strand. At one and above no excess. Source: process-physics.md section 4.
pub fn overfeed(draw_ratio: f64, mean_m: f64, length_m: f64) -> Overfeed {
    let strain = overfeed_strain(draw_ratio);
    Overfeed {
        strain,
        thread_m: mean_m * draw_ratio.clamp(0.0, 1.0).sqrt(),
        excess_m: strain * length_m,
    }
}

/// Wavelength of the meander at onset, m: `2 π v/Ω`, carrier speed `v` and frequency of steady coiling `Ω`,
/// rad/s.
///
/// Holds at onset only; for a free strand `Ω` has to be measured.
pub fn onset_wavelength_m(speed_m_s: f64, coiling_rad_s: f64) -> f64 {
    2.0 * PI * speed_m_s / coiling_rad_s
}

/// Amplitude of a sine of a wavelength that holds an excess strain, m; middle to crest.
///
/// Solves `(1/2π) ∫ √(1 + (k a)² cos² u) du = 1 + e`, `k = 2π/λ`, over a period: `a ≈ (λ/π) √e` where `e` is
/// small. To 1e-8 up to `e = 2`, 64 steps of bisection at most, sums of 64 points (more excess than the
/// reference's rules ever let pass makes a loop, not a sine: above `e` about 0.5 the number is a size, not a
/// shape). That the curve is a sine is ours. Zero where there is no excess, infinite where it is infinite.
pub fn sine_amplitude_m(strain: f64, wavelength_m: f64) -> f64 {
    if !(strain > 0.0) {
        return 0.0;
    }
    if strain.is_infinite() {
        return f64::INFINITY;
    }
    // The mean of √(1 + q² cos²) lies between 2q/π and 1 + q²/4, and below 1 + 2q/π.
    let (mut low, mut high) = (0.5 * PI * strain, 0.5 * PI * (1.0 + strain));
    low = low.max(0.0);
    for _ in 0..64 {
        let slope = 0.5 * (low + high);
        if sine_excess(slope) < strain {
            low = slope;
        } else {
            high = slope;
        }
    }
    0.5 * (low + high) * wavelength_m / (2.0 * PI)
}

/// Mean of `√(1 + q² cos² u) − 1` over a quarter, by the midpoint rule, which converges geometrically for a
/// periodic function; written so that a small slope keeps its digits.
fn sine_excess(slope: f64) -> f64 {
    const POINTS: u32 = 64;
    let square =
        |i: u32| (slope * (0.5 * PI * (f64::from(i) + 0.5) / f64::from(POINTS)).cos()).powi(2);
    (0..POINTS).map(|i| square(i) / (1.0 + (1.0 + square(i)).sqrt())).sum::<f64>()
        / f64::from(POINTS)
}

/// The farthest any curve can lie from its path that crosses it twice per wavelength and holds the excess, m.
///
/// `(λ/4) √((1 + e)² − 1)`: the thread between two crossings is an ellipse's string at full stretch. No shape
/// is assumed; a bound, not an estimate.
pub fn farthest_m(strain: f64, wavelength_m: f64) -> f64 {
    let strain = strain.max(0.0);
    0.25 * wavelength_m * (strain * (2.0 + strain)).sqrt()
}
