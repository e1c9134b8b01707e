//! A rod that bends far under its own weight, co-rotational, in the plane of its path and gravity.
//!
//! Straight elements that turn with their chord, bend and stretch little about it; Newton with the load and
//! the ends brought on in steps. For set strands (stiffness by element, ageing as `E_eff`) whose sag is above
//! 0.3 of their span. Source: process-physics.md section 3.1, cases ELASTICA-*, EB-*.

mod newton;

#[cfg(test)]
mod tests;

use newton::{ALL_ITERATIONS, Newton};

/// A straight piece of a rod, at rest.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct HeavyPiece {
    /// Length, m.
    pub length_m: f64,
    /// Bending stiffness `E I`, N m².
    pub bending_n_m2: f64,
    /// Stiffness along it `E A`, N.
    pub axial_n: f64,
    /// Mass per length, kg/m.
    pub line_mass_kg_m: f64,
}

/// What an end is held by, in the plane.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Support {
    /// In place and direction.
    Clamped {
        /// Place, m.
        at_m: [f64; 2],
        /// Direction of the rod from the first axis to the second, rad.
        angle_rad: f64,
    },
    /// In place.
    Hinged {
        /// Place, m.
        at_m: [f64; 2],
    },
    /// Not at all.
    Free,
}

/// A rod without load: straight, from `from_m` along `angle_rad`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct HeavyRod<'a> {
    /// Its pieces in order.
    pub pieces: &'a [HeavyPiece],
    /// Where it begins, m.
    pub from_m: [f64; 2],
    /// Its direction, rad.
    pub angle_rad: f64,
    /// What holds its beginning and its end; they are brought there from the straight rod as the load comes on.
    pub ends: [Support; 2],
    /// Gravity, m/s².
    pub gravity_m_s2: [f64; 2],
}

/// A rod at rest under its weight, at the boundaries of its pieces.
#[derive(Debug, Clone, PartialEq)]
pub struct Hanging {
    /// Places, m.
    pub points_m: Vec<[f64; 2]>,
    /// Directions, rad.
    pub angles_rad: Vec<f64>,
    /// Greatest bending moment, N m.
    pub moment_n_m: f64,
    /// Whether it stays there when pushed a little.
    pub stable: bool,
    /// Newton iterations taken.
    pub iterations: usize,
}

/// Why a rod has no rest shape.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum HangError {
    /// A number is not finite, or a length or stiffness is not positive.
    Input,
    /// None found within the iterations, or nothing holds it.
    NoEquilibrium,
}

/// Smallest step of load.
const LEAST_STEP: f64 = 1.0 / 8192.0;

/// Rest shape of a rod, `cuts` elements (1 to 256) to a piece.
///
/// Second order in the elements' length (weight in lumps at the nodes); O(n) an iteration, at most 1500 iterations
/// in all. [`hang_fine`] takes the terms in h² and h⁴ out.
///
/// # Errors
/// [`HangError`] where a number means nothing or no equilibrium is found.
pub fn hang(rod: &HeavyRod, cuts: u32) -> Result<Hanging, HangError> {
    let mut newton = Newton::new(rod, cuts.clamp(1, 256))?;
    let (mut done, mut step) = (0.0, 0.25);
    let mut iterations = 0;
    while done < newton.way {
        let to = f64::min(done + step, newton.way);
        let before = newton.state.clone();
        if newton.settle(to, &mut iterations) {
            done = to;
            step *= 1.5;
        } else {
            newton.state = before;
            step *= 0.25;
            if step < LEAST_STEP || iterations >= ALL_ITERATIONS {
                return Err(HangError::NoEquilibrium);
            }
        }
    }
    Ok(newton.hanging(iterations))
}

/// Rest shape from three finenesses, `cuts`, twice and four times that, by Richardson: the terms in h² and h⁴ taken out.
///
/// # Errors
/// As [`hang`].
pub fn hang_fine(rod: &HeavyRod, cuts: u32) -> Result<Hanging, HangError> {
    let coarse = hang(rod, cuts)?;
    let middle = hang(rod, 2 * cuts)?;
    let mut fine = hang(rod, 4 * cuts)?;
    // 1/45, −20/45, 64/45: free of the terms in h² and h⁴
    let best = |c: f64, m: f64, f: f64| f + (19.0 * (f - m) - (m - c)) / 45.0;
    for (i, point) in fine.points_m.iter_mut().enumerate() {
        for (k, x_m) in point.iter_mut().enumerate() {
            *x_m = best(coarse.points_m[i][k], middle.points_m[i][k], *x_m);
        }
        fine.angles_rad[i] = best(coarse.angles_rad[i], middle.angles_rad[i], fine.angles_rad[i]);
    }
    fine.moment_n_m = best(coarse.moment_n_m, middle.moment_n_m, fine.moment_n_m);
    fine.iterations += coarse.iterations + middle.iterations;
    Ok(fine)
}

/// Rest shape in space of a straight rod printed from a point along a direction, clamped where it begins and
/// free at its end; gravity any way, m/s². Points at the boundaries of its pieces, m.
///
/// # Errors
/// As [`hang`].
pub fn droop(
    pieces: &[HeavyPiece],
    from_m: [f64; 3],
    along: [f64; 3],
    gravity_m_s2: [f64; 3],
    cuts: u32,
) -> Result<Vec<[f64; 3]>, HangError> {
    let axes = super::rod::Axes::new(along, gravity_m_s2);
    let part = |axis: [f64; 3]| (0..3).map(|i| axis[i] * gravity_m_s2[i]).sum::<f64>();
    let (along, across) = (axes.along, axes.across[0]);
    let rod = HeavyRod {
        pieces,
        from_m: [0.0; 2],
        angle_rad: 0.0,
        ends: [Support::Clamped { at_m: [0.0; 2], angle_rad: 0.0 }, Support::Free],
        gravity_m_s2: [part(along), part(across)],
    };
    let flat = hang_fine(&rod, cuts)?;
    let place = |p: &[f64; 2]| [0, 1, 2].map(|i| from_m[i] + p[0] * along[i] + p[1] * across[i]);
    Ok(flat.points_m.iter().map(place).collect())
}
