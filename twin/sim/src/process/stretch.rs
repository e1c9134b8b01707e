//! A hot strand between two holds, not ageing, past small sag: it bends, then it stretches.

#[cfg(test)]
mod tests;

/// Sag of a strand held at both ends with its stretching taken in, m, from that by bending alone.
///
/// One amplitude: what resists is bending, `72 η D² δ̇/L⁴`, and stretching, `128 η δ² δ̇/L⁴`, against `ρ g`; so
/// `δ + (16/27) δ³/D² = δ_bending`, whose ends are the laws of Teichman & Mahadevan, `ρ g L⁴ t/(72 η D²)` and
/// `(3 ρ g L⁴ t/(128 η))^⅓`, and which passes below both where they meet, at 1.299 D (there 0.68 of it). Against
/// [`filament_sag`] 4 % or better (tested). Sum of the two resistances is ours. Not positive: returned as it is.
/// Source: process-physics.md 3.2, cases VISC-CATENARY-*.
pub fn held_sag_m(bending_sag_m: f64, diameter_m: f64) -> f64 {
    let wanted = bending_sag_m / diameter_m;
    if !(wanted > 0.0) || !wanted.is_finite() || !(diameter_m > 0.0) {
        return bending_sag_m;
    }
    // Cardano's u − v of x³ + (27/16) x = (27/16) y as (u³ − v³)/(u² + uv + v²): nothing cancels
    let (product, half) = (27.0_f64 / 48.0, 27.0 / 32.0 * wanted);
    let u = (half + half.hypot(product * product.sqrt())).cbrt();
    let v = product / u;
    let held_m = diameter_m * wanted * (27.0 / 16.0) / (u * u + product + v * v);
    held_m.min(bending_sag_m) // where numbers run out
}

/// Steps of [`filament_sag`] in all.
const STEPS: usize = 200_000;

/// Sag over diameter of a strand clamped at both ends against `ρ g L⁴ t/(η D³)`, at each of `loads` (ascending).
///
/// The beam of moderate sag: `3 η I ẏ'''' − T y'' = w`, `T = (3 η A/L) ∫ y' ẏ' dx`, viscosity constant, slopes small
/// (sag below a fifth of the span; in this limit span over diameter plays no part), no shear. Turned about by
/// `∫ y' ẏ' = −∫ y'' ẏ`, `ẏ = a − T b` with `a`, `b` the beam's answers to the load and to `y''`: sums over `cells`
/// (4 to 4096) of half the span, no matrix. Second order in cells; Runge–Kutta of fourth order, `steps` to a
/// factor of e in load while the sag is below 4 diameters, as its square more beyond. O(cells) a step, at most
/// 200 000 steps, past which it is not a number (40 diameters are in reach at 40 steps).
pub fn filament_sag(loads: &[f64], cells: usize, steps: u32) -> Vec<f64> {
    let beam = HalfBeam::new(cells.clamp(4, 4096));
    let mut shape = vec![0.0; beam.bend.len()];
    let mut out = Vec::with_capacity(loads.len());
    let (mut load, mut left) = (0.0, STEPS);
    for &to in loads {
        if !to.is_finite() || to <= load {
            out.push(if to.is_nan() { f64::NAN } else { shape[shape.len() - 1] });
            continue;
        }
        // the bending law holds to 1e-4 up to a hundredth of a diameter
        if load == 0.0 {
            let first = to.min(0.7);
            for (y, bend) in shape.iter_mut().zip(&beam.bend) {
                *y = first * bend;
            }
            load = first;
        }
        while load < to && left > 0 {
            // what is not a parabola dies at a rate that grows with the square of the sag
            let sag = shape[shape.len() - 1];
            let step = load / (f64::from(steps.max(1)) * (1.0 + sag * sag / 16.0));
            let step = step.min(to - load);
            beam.step(&mut shape, step);
            load = if step < to - load { load + step } else { to };
            left -= 1;
        }
        if left == 0 {
            out.push(f64::NAN);
            continue;
        }
        out.push(shape[shape.len() - 1]);
    }
    out
}

/// Half of a clamped beam, from its end to its middle, over its span; sag over diameter.
struct HalfBeam {
    /// Sag by bending to a load of one, `(2/9) x² (1 − x)²`: 1/72 in the middle.
    bend: Vec<f64>,
}

impl HalfBeam {
    fn new(cells: usize) -> Self {
        let at = |i: usize| 0.5 * i as f64 / cells as f64;
        let bend = |i: usize| 2.0 / 9.0 * (at(i) * (1.0 - at(i))).powi(2);
        Self { bend: (0..=cells).map(bend).collect() }
    }

    /// How the shape changes with load.
    fn rate(&self, shape: &[f64]) -> Vec<f64> {
        let width = 0.5 / (shape.len() - 1) as f64;
        let mean = 2.0 * width * inner(shape, |i| shape[i]);
        // b'' = y − mean, b' and b from the clamp on; slopes live between the points
        let mut give = vec![0.0; shape.len()];
        let (mut slope, mut bent) = (0.0, shape[0] - mean);
        for i in 1..shape.len() {
            slope += if i == 1 { 0.5 * width * bent } else { width * bent };
            bent = shape[i] - mean;
            give[i] = give[i - 1] + width * slope;
        }
        // ∫ y' z' over the whole span
        let pull = |other: &[f64]| -> f64 {
            let pairs = shape.windows(2).zip(other.windows(2));
            pairs.map(|(y, z)| (y[1] - y[0]) * (z[1] - z[0])).sum::<f64>() * 2.0 / width
        };
        // T/(3 η A): sixteen by the inertia of a circle
        let tension = pull(&self.bend) / (1.0 - 16.0 * pull(&give));
        self.bend.iter().zip(&give).map(|(bend, give)| bend + 16.0 * tension * give).collect()
    }

    fn step(&self, shape: &mut [f64], step: f64) {
        let along = |shape: &[f64], rate: &[f64], by: f64| -> Vec<f64> {
            shape.iter().zip(rate).map(|(y, r)| y + by * r).collect()
        };
        let a = self.rate(shape);
        let b = self.rate(&along(shape, &a, 0.5 * step));
        let c = self.rate(&along(shape, &b, 0.5 * step));
        let d = self.rate(&along(shape, &c, step));
        for (i, y) in shape.iter_mut().enumerate() {
            *y += step / 6.0 * (a[i] + 2.0 * (b[i] + c[i]) + d[i]);
        }
    }
}

/// Sum by the trapezoid rule, over the points of a shape.
fn inner(shape: &[f64], value: impl Fn(usize) -> f64) -> f64 {
    let last = shape.len() - 1;
    (1..last).map(&value).sum::<f64>() + 0.5 * (value(0) + value(last))
}
