//! Several threads: a thick one with thin ones around it that meet it in knots (Yu et al., first stage).
//!
//! The paper gives the arrangement (one fat straight thread, three thin ones that undulate and meet it
//! periodically, like spindle knots) and no size, stiffness or strength. So everything below is **ours**,
//! derived from these assumptions:
//!
//! - the core is straight and round; the thin threads are round, evenly spaced around it, all in phase, each
//!   in a plane with the core's axis: `r(x) = r_k + a (1 − cos 2πx/p)/2`, `r_k` at a knot, `a` the sweep, `p` the
//!   pitch;
//! - a knot is rigid and has no length; between knots nothing touches;
//! - threads bend, twist and stretch as slender elastic rods of one material (Euler and Bernoulli); their
//!   material's own shear is left out: of the core's flexibility when sheared it would add `2.3 (D/p)²`, a tenth
//!   at a pitch of five core diameters.
//!
//! Within them the stiffness of one pitch is exact (energy of the rods, integrals over the curve), not
//! fitted. A pitch answers to four motions of its two knots: apart, twisted, bent, sheared; the chain of
//! pitches follows in closed form. A real knot is a contact and gives way, which takes these numbers towards
//! the core alone. Strength and toughness, which the paper is after, are not here.

use std::f64::consts::PI;

/// A core with thin threads around it, knotted at a pitch.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Knotted {
    /// Diameter of the core, m.
    pub core_m: f64,
    /// Diameter of each thin thread, m.
    pub thread_m: f64,
    /// How many thin threads; three in the paper. None, or three and more: with one or two the strand would
    /// not be the same in all directions, and stiffnesses come out not a number.
    pub count: u32,
    /// Distance from the core's axis to a thread's axis at a knot, m: `(D + d)/2` where they just touch.
    pub knot_offset_m: f64,
    /// How much farther out a thread is midway between knots, m.
    pub sweep_m: f64,
    /// Distance from knot to knot, m.
    pub pitch_m: f64,
}

/// Stiffness of a knotted strand, and its bounds.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Stiffness {
    /// Force per strain, N.
    pub axial_n: f64,
    /// Torque per twist per length, N m².
    pub torsion_n_m2: f64,
    /// Moment per curvature where the moment is the same all along, N m².
    pub bending_n_m2: f64,
    /// What the parts resist when knots shift sideways without turning, as a bending stiffness, N m²: the sum
    /// of the parts' own where threads are straight.
    pub parts_n_m2: f64,
    /// Shear force per shear strain, N: `12 B_parts/p²` (a Vierendeel panel between rigid knots).
    pub shear_n: f64,
    /// From knot to knot, m.
    pub pitch_m: f64,
}

/// Flexibility of one thin thread between its knots, per Young's modulus: an arch clamped at both ends.
///
/// Each is an integral over the curve of the squares of what a unit load makes at each place (Castigliano),
/// loads taken where by symmetry they do not mix. Slope `ψ`, `s` along the thread, `GJ = EI/(1 + ν)` of a
/// round rod.
struct Arch {
    /// Length of the thread, m.
    length_m: f64,
    /// Its elastic centre: mean distance from the core's axis, m.
    centre_m: f64,
    /// Knots apart by a force along the elastic centre: `∫ cos²ψ/A + (r − r̄)²/I ds`.
    apart: f64,
    /// Knots turned against each other in the thread's plane: `S/I`.
    bent_in: f64,
    /// The same across its plane: `∫ (cos²ψ + (1 + ν) sin²ψ)/I ds`.
    bent_out: f64,
    /// Knots shifted sideways in the thread's plane: `∫ x²/I + sin²ψ/A ds`.
    sheared_in: f64,
    /// The same across its plane, knots kept from twisting.
    sheared_out: f64,
    /// Knots twisted about the core's axis, kept from shifting.
    twisted: f64,
}

fn second_moment_m4(diameter_m: f64) -> f64 {
    PI * diameter_m.powi(4) / 64.0
}

fn area_m2(diameter_m: f64) -> f64 {
    0.25 * PI * diameter_m * diameter_m
}

impl Knotted {
    /// A thread's position and slope at a share of the pitch: distance along from the middle, out, `dr/dx`.
    fn curve(&self, share: f64) -> (f64, f64, f64) {
        let angle = 2.0 * PI * share;
        (
            self.pitch_m * (share - 0.5),
            self.knot_offset_m + 0.5 * self.sweep_m * (1.0 - angle.cos()),
            PI * self.sweep_m / self.pitch_m * angle.sin(),
        )
    }

    /// Integral over the thread's length of a law of (along from the middle, out, cos, sin of the slope).
    ///
    /// The law must be even about the middle. Gauss–Legendre, three points to each of 32 panels on half the
    /// pitch: sixth order, 1e-9 for sweeps up to half the pitch.
    fn along<const N: usize>(&self, law: impl Fn([f64; 4]) -> [f64; N]) -> [f64; N] {
        const PANELS: u32 = 32;
        let mut sums = [0.0; N];
        for panel in 0..PANELS {
            for (node, weight) in [(-0.6_f64.sqrt(), 5.0), (0.0, 8.0), (0.6_f64.sqrt(), 5.0)] {
                let share = 0.5 * (f64::from(panel) + 0.5 + 0.5 * node) / f64::from(PANELS);
                let (x, r, slope) = self.curve(share);
                let secant = slope.hypot(1.0);
                let length_m = self.pitch_m * secant * weight / (18.0 * f64::from(PANELS));
                for (sum, term) in sums.iter_mut().zip(law([x, r, 1.0 / secant, slope / secant])) {
                    *sum += length_m * term;
                }
            }
        }
        sums
    }

    fn arch(&self, poisson: f64) -> Arch {
        let (area, i) = (area_m2(self.thread_m), second_moment_m4(self.thread_m));
        let soft = 1.0 + poisson;
        let [length_m, out] = self.along(|[_, r, _, _]| [1.0, r]);
        let centre_m = out / length_m;
        let [apart, bent_out, sheared_in] = self.along(|[x, r, cos, sin]| {
            [
                cos * cos / area + (r - centre_m).powi(2) / i,
                (cos * cos + soft * sin * sin) / i,
                x * x / i + sin * sin / area,
            ]
        });
        // Across the plane, torque T and force V at the middle of the core's axis: twist M_s and bending M_n are
        // T (cos, −sin) + V (x sin − r cos, x cos + r sin).
        let [torque, mixed, force] = self.along(|[x, r, cos, sin]| {
            let (twist, bend) = (x * sin - r * cos, x * cos + r * sin);
            [
                (soft * cos * cos + sin * sin) / i,
                (soft * cos * twist - sin * bend) / i,
                (soft * twist * twist + bend * bend) / i,
            ]
        });
        Arch {
            length_m,
            centre_m,
            apart,
            bent_in: length_m / i,
            bent_out,
            sheared_in,
            sheared_out: force - mixed * mixed / torque,
            twisted: torque - mixed * mixed / force,
        }
    }

    /// Length of a thin thread over the pitch: what its nozzle has to feed faster than the arm moves.
    pub fn thread_length_ratio(&self) -> f64 {
        self.arch(0.0).length_m / self.pitch_m
    }

    /// Volume per length of strand, m³/m: core and threads, knots not counted twice.
    pub fn volume_per_length_m2(&self) -> f64 {
        area_m2(self.core_m)
            + f64::from(self.count) * area_m2(self.thread_m) * self.thread_length_ratio()
    }

    /// Bending stiffness if nothing carried shear between the threads and they were straight, N m²:
    /// `E (I_D + n I_d)`.
    ///
    /// A lower bound while threads are straight; a swept one is longer, so it resists less than its `E I_d`.
    pub fn loose_bending_n_m2(&self, youngs_pa: f64) -> f64 {
        let thread = second_moment_m4(self.thread_m);
        youngs_pa * (second_moment_m4(self.core_m) + f64::from(self.count) * thread)
    }

    /// Bending stiffness if the threads were bonded to the core all along, N m²: an upper bound.
    ///
    /// `E [I_D + n I_d + (n/2) A_d ⟨r²⟩]`, parallel axes, plane sections; `⟨r²⟩ = (r_k + a/2)² + a²/8` over
    /// the pitch. The `n/2` is `Σ cos²` of even angles: the same in every direction from three threads on.
    pub fn bonded_bending_n_m2(&self, youngs_pa: f64) -> f64 {
        let mean = self.knot_offset_m + 0.5 * self.sweep_m;
        let square = mean * mean + 0.125 * self.sweep_m * self.sweep_m;
        let steiner = 0.5 * f64::from(self.count) * area_m2(self.thread_m) * square;
        self.loose_bending_n_m2(youngs_pa) + youngs_pa * steiner
    }

    /// Stiffness of a chain of pitches between rigid knots. Constant cost.
    ///
    /// With each thread's flexibilities `C` over a pitch, averaged over the directions of even angles: axial
    /// `E A_D + n p/C_apart`; bending `E I_D + (n/2) p [1/C_in + r̄²/C_apart + 1/C_out]`; parts
    /// `E I_D + (n/2)(p³/12)[1/C_in + 1/C_out]` of the shear motions; torsion `G J_D + n p/C_twisted`.
    /// Straight threads (`a = 0`) give the bonded bending at any pitch; swept ones give way as arches, and
    /// where shallow keep `1/(1 + 2 (a/d)²)` of their `E A`, so bending is stiffest at a sweep of
    /// `d²/(4 r_k)`. Range: the module's assumptions, a sweep up to the pitch. Not a number where a diameter
    /// or the pitch is not positive or a sweep below zero, or with one or two threads.
    pub fn stiffness(&self, youngs_pa: f64, poisson: f64) -> Stiffness {
        let sound = self.core_m > 0.0
            && self.thread_m > 0.0
            && self.pitch_m > 0.0
            && self.sweep_m >= 0.0
            && !(1..=2).contains(&self.count);
        let e = if sound { youngs_pa } else { f64::NAN };
        let (arch, count, p) = (self.arch(poisson), f64::from(self.count), self.pitch_m);
        let core = second_moment_m4(self.core_m);
        let turned = 1.0 / arch.bent_in + arch.centre_m.powi(2) / arch.apart + 1.0 / arch.bent_out;
        let shifted = 1.0 / arch.sheared_in + 1.0 / arch.sheared_out;
        let parts = core + 0.5 * count * p.powi(3) / 12.0 * shifted;
        Stiffness {
            axial_n: e * (area_m2(self.core_m) + count * p / arch.apart),
            torsion_n_m2: e * (core / (1.0 + poisson) + count * p / arch.twisted),
            bending_n_m2: e * (core + 0.5 * count * p * turned),
            parts_n_m2: e * parts,
            shear_n: 12.0 * e * parts / (p * p),
            pitch_m: p,
        }
    }
}

impl Stiffness {
    /// Bending stiffness of a uniform beam that bends as much over a span, N m².
    ///
    /// `1/B_span = (1 − g)/B + g/B_parts`, `g = (1 − cos q)/(4 + 2 cos q)`, `q = π p/L` held to π. Exact for
    /// pinned ends, a whole number of pitches and a load at the knots that goes as half a sine wave (both
    /// beams under the same loads, deflection at the knots): solution of the chain's difference equation. A
    /// short pitch gives `B`; a pitch of the span or more gives the parts alone. For a cantilever take twice
    /// its length. Span not positive: the parts.
    pub fn bending_over_span_n_m2(&self, span_m: f64) -> f64 {
        let q = if span_m > self.pitch_m { PI * self.pitch_m / span_m } else { PI };
        let loose = (1.0 - q.cos()) / (4.0 + 2.0 * q.cos());
        1.0 / ((1.0 - loose) / self.bending_n_m2 + loose / self.parts_n_m2)
    }
}
