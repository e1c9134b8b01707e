//! The ageing rod: a strand that grows at the nozzle, sags while it is soft and stays as it set.
//!
//! Small slopes, quasi-static, along the nozzle's path. Every section has its own birth; its curvature
//! follows `κ̇ = M f(a)/I + d/dt(M/(E I)) + κ̇_shrink`, `f = 1/(3 η)`, and `M = M0 + V0 ξ + ∫∫ w`, `ξ` behind the
//! nozzle; `M0`, `V0` come from what holds the ends. Two directions across the strand and one along it.
//! Source: process-physics.md section 3.1, cases VISC-*.

mod ends;
mod run;
mod sections;
mod share;
mod step;
mod table;

#[cfg(test)]
mod tests;
#[cfg(test)]
mod tests_cases;
#[cfg(test)]
mod tests_laws;

use std::f64::consts::PI;

pub use run::print_strand;
pub use table::AgeTable;

use super::sag::inertia_m4;

/// One straight piece of a strand's path, as the nozzle prints it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Element {
    /// Length, m.
    pub length_m: f64,
    /// How long the nozzle takes over it, s; an element of length zero is a wait.
    pub printing_s: f64,
    /// Section, m².
    pub area_m2: f64,
    /// Bending inertia of the section, m⁴; the same both ways.
    pub inertia_m4: f64,
    /// Mass per length, kg/m.
    pub line_mass_kg_m: f64,
    /// Directions of the strand in the axes of the part.
    pub axes: Axes,
    /// Moment below which nothing flows, N m; zero: it always flows.
    pub yield_moment_n_m: f64,
    /// Pull below which nothing flows, N; zero: it always flows.
    pub yield_force_n: f64,
}

impl Element {
    /// A round piece that always flows: length and diameter m, nozzle speed m/s, density kg/m³.
    ///
    /// A speed of zero or less gives a time that [`print_strand`] refuses.
    pub fn round(
        length_m: f64,
        diameter_m: f64,
        speed_m_s: f64,
        density_kg_m3: f64,
        axes: Axes,
    ) -> Self {
        let area_m2 = PI * diameter_m * diameter_m / 4.0;
        Self {
            length_m,
            printing_s: length_m / speed_m_s,
            area_m2,
            inertia_m4: inertia_m4(diameter_m),
            line_mass_kg_m: density_kg_m3 * area_m2,
            axes,
            yield_moment_n_m: 0.0,
            yield_force_n: 0.0,
        }
    }
}

/// Directions of a strand, unit vectors square to one another, in the axes of the part.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Axes {
    /// The way the nozzle goes.
    pub along: [f64; 3],
    /// The two directions in which offsets are given.
    pub across: [[f64; 3]; 2],
}

impl Axes {
    /// Axes of a strand printed along `along`, the first across it as near to `towards` as can be.
    ///
    /// Where `towards` lies along the strand, or nearly, some direction across it is taken. A zero or
    /// non-finite `along` gives non-finite axes.
    pub fn new(along: [f64; 3], towards: [f64; 3]) -> Self {
        let along = unit(along);
        let square = |v: [f64; 3]| -> [f64; 3] {
            let part = dot(v, along);
            std::array::from_fn(|i| v[i] - part * along[i])
        };
        let wanted = square(towards);
        let clear = dot(wanted, wanted) > 1e-18 * dot(towards, towards);
        let first = if clear {
            unit(wanted)
        } else {
            // the axis of the part farthest from the strand
            let mut flat = 0;
            for i in 1..3 {
                if along[i].abs() < along[flat].abs() {
                    flat = i;
                }
            }
            unit(square(std::array::from_fn(|i| if i == flat { 1.0 } else { 0.0 })))
        };
        Self { along, across: [first, cross(along, first)] }
    }
}

/// What holds an end of a strand.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum End {
    /// Held in place and direction: grown onto an earlier strand or the bed; a nozzle that holds the slope.
    Clamped,
    /// Held in place, free to turn: it touches; a nozzle that carries no moment.
    Hinged,
    /// Held by nothing.
    Free,
}

/// What holds a strand for a time.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Hold {
    /// The end printed first.
    pub far: End,
    /// The end at the nozzle.
    pub near: End,
}

/// A time after printing. An end that is held is held where, and as steep as, it is when the phase begins.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Phase {
    /// What holds it: the waiting nozzle, a joint, or nothing.
    pub hold: Hold,
    /// How long, s; no longer than until all of it is rigid, so infinite is until then.
    pub duration_s: f64,
}

/// How a modulus that grows acts on what is bent already.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Elastic {
    /// `κ̇ = d/dt(M/(E I))`, as the reference has it: a strand that stiffens under load straightens.
    Total,
    /// `κ̇ = Ṁ/(E I)`: what stiffens does so in the shape it has, as where a resin cures under load. Ours.
    Rate,
}

/// What becomes of the material with age, by element.
#[derive(Clone, Copy)]
pub struct Ageing<'a> {
    /// Compliance flowed through since birth, `J(a) = ∫₀ᵃ da/(3 η)`, 1/Pa, of element and age s; never
    /// falling. [`AgeTable`] makes one of a fluidity.
    pub compliance_per_pa: &'a dyn Fn(usize, f64) -> f64,
    /// Young's modulus, Pa, of element and age s; without one, or where it is not positive or not finite,
    /// nothing springs.
    pub modulus_pa: Option<&'a dyn Fn(usize, f64) -> f64>,
    /// How the modulus acts.
    pub elastic: Elastic,
    /// Curvature across that the material takes on unloaded, 1/m, of element and age s.
    pub free_curvature_per_m: Option<&'a dyn Fn(usize, f64) -> [f64; 2]>,
    /// Age from which nothing flows and the modulus no longer changes, s.
    pub rigid_s: f64,
}

/// How fine the solver is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Fineness {
    /// Pieces, each a step in time, to an element; 1 to 64.
    pub cuts: u32,
    /// Steps to a phase after printing; 1 to 4096.
    pub steps: u32,
}

impl Fineness {
    /// Pieces of a third of the length in which fluidity falls by e (`v τ`), 32 steps to a phase.
    ///
    /// Sag A so comes out within 0.1 % where the nozzle clamps, 0.4 % where it is a hinge (seen on VISC-SS-EXP-*); one
    /// piece to that length gives 2 and 3 %. A material that sets at once wants 20 pieces to its soft zone for 0.3 %.
    /// Not finite or not positive: 64 pieces.
    pub fn resolving(segment_m: f64, fading_m: f64) -> Self {
        let pieces = (3.0 * segment_m / fading_m).ceil();
        let cuts = if pieces >= 1.0 { pieces.min(64.0) as u32 } else { 64 };
        Self { cuts: if segment_m == 0.0 { 1 } else { cuts }, steps: 32 }
    }
}

/// A strand to be printed.
#[derive(Clone, Copy)]
pub struct Strand<'a> {
    /// Its elements in the order of printing.
    pub elements: &'a [Element],
    /// Its material.
    pub ageing: Ageing<'a>,
    /// Gravity in the axes of the part, m/s², of the time s since printing began; turns with a bed on a flange.
    pub gravity_m_s2: &'a dyn Fn(f64) -> [f64; 3],
    /// What holds it while it is printed.
    pub printing: Hold,
    /// What holds it afterwards.
    pub after: &'a [Phase],
    /// How fine.
    pub fineness: Fineness,
}

/// Why a strand has no outcome.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum RodError {
    /// A number is not finite, or a length, time or section is not what it must be.
    Input,
    /// What is said to hold it holds it not: it turns about its hinge, or falls.
    Falls,
}

/// What becomes of it. Offsets are from the nozzle's path, in the two directions across, m.
#[derive(Debug, Clone, PartialEq)]
pub struct RodOutcome {
    /// Offset at the end at every boundary of elements, from the far end to the nozzle.
    pub offset_m: Vec<[f64; 2]>,
    /// Slope there.
    pub slope: Vec<[f64; 2]>,
    /// Greatest offset there at any time, m.
    pub greatest_m: Vec<f64>,
    /// Greatest offset of any material at any time, m: sag A.
    pub sag_nozzle_m: f64,
    /// Greatest offset while it was printed, m.
    pub sag_printing_m: f64,
    /// How far boundaries have moved along the strand, m.
    pub along_m: Vec<f64>,
    /// Diameter of each element over that it was printed with: `(1 + ε)^(−1/2)`.
    pub thinning: Vec<f64>,
    /// Moment at the near end at the last, N m, the mean of the last step.
    pub moment_n_m: [f64; 2],
    /// Steps in time.
    pub steps: usize,
    /// Updates of a section: two to a piece and step.
    pub updates: usize,
}

impl RodOutcome {
    /// Final offset of the near end, m.
    pub fn end_drop_m(&self) -> f64 {
        self.offset_m.last().map_or(0.0, |o| o[0].hypot(o[1]))
    }

    /// Final offset of the far end, m.
    pub fn tip_drop_m(&self) -> f64 {
        self.offset_m.first().map_or(0.0, |o| o[0].hypot(o[1]))
    }
}

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

fn unit(a: [f64; 3]) -> [f64; 3] {
    let length = dot(a, a).sqrt();
    a.map(|x| x / length)
}
