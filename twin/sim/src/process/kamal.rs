//! Autocatalytic cure: the Kamal–Sourour law and its solution as a table.

/// Nodes and weights of five-point Gauss–Legendre quadrature on 0..1.
pub(super) const GAUSS_UNIT: [(f64, f64); 5] = [
    (0.046_910_077_030_668, 0.118_463_442_528_094_55),
    (0.230_765_344_947_158_45, 0.239_314_335_249_683_25),
    (0.5, 0.284_444_444_444_444_45),
    (0.769_234_655_052_841_6, 0.239_314_335_249_683_25),
    (0.953_089_922_969_332, 0.118_463_442_528_094_55),
];

/// Cells of a table; the degree of cure is then within 2e-7 of the law for the reference's orders, within
/// 3e-6 for a start a thousand times slower than the rest (tested).
const CELLS: usize = 160;
/// Cells of a single time.
const TIME_CELLS: usize = 48;
/// Ends of the table in `z = ln[α/(α_max − α)]`: degrees of 1e-7 and 1 − 6e-6 of the greatest.
const Z_ENDS: (f64, f64) = (-16.0, 12.0);

/// Rate of cure at constant light and temperature: `dα/dt = (k1 + k2 αᵐ)(α_max − α)ⁿ`.
///
/// Degree of cure `α` without unit, rates 1/s. Kamal–Sourour; fits the photo-DSC of acrylates with R² above 0.99
/// (process-physics.md 1.2). Kamal parameters of no resin here are published: `m`, `n`, `α_gel`, `α_max` are from
/// memory, `k2/k1` is nobody's, and the level of both is fixed by [`Self::gelling_in`]. `k1` not positive never
/// starts. `α_max` does not depend on temperature here, which it does in truth.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Kamal {
    /// Order of the autocatalysis.
    pub m: f64,
    /// Order of what is left to react.
    pub n: f64,
    /// Rate of the start, 1/s.
    pub k1_per_s: f64,
    /// Rate of the autocatalysis, 1/s.
    pub k2_per_s: f64,
    /// Degree of cure at the gel point.
    pub gel: f64,
    /// Degree at which cure stops.
    pub max: f64,
}

impl Kamal {
    /// `dα/dt`, 1/s; `α` is held to 0..`α_max`.
    pub fn rate_per_s(&self, degree: f64) -> f64 {
        let held = degree.max(0.0).min(self.max);
        (self.k1_per_s + self.k2_per_s * held.powf(self.m)) * (self.max - held).powf(self.n)
    }

    /// Time to a degree of cure, s: `t(α) = ∫₀^α dα / [(k1 + k2 αᵐ)(α_max − α)ⁿ]`, by quadrature.
    ///
    /// Infinite from `α_max` on and for a law that cannot start; zero at zero. Relative error below 1e-9 (tested
    /// against closed forms).
    pub fn time_to_s(&self, degree: f64) -> f64 {
        if !self.cures() || degree >= self.max {
            return f64::INFINITY;
        }
        if !(degree > 0.0) {
            return 0.0;
        }
        let end = (degree / (self.max - degree)).ln();
        if end <= Z_ENDS.0 {
            return self.start_s(degree);
        }
        let step = (end - Z_ENDS.0) / TIME_CELLS as f64;
        let cells = (0..TIME_CELLS).map(|i| self.cell_s(Z_ENDS.0 + i as f64 * step, step));
        self.start_s(self.max * logistic(Z_ENDS.0)) + cells.sum::<f64>()
    }

    /// The same law as fast as to gel in a time, s; only `k2/k1` of this one is kept.
    ///
    /// Both rates are divided by what `t(α_gel)` is over what it shall be: the law is linear in them, no search
    /// is needed. With a gel point not between zero and `α_max`, or a time not positive, it never cures.
    #[must_use]
    pub fn gelling_in(self, gel_s: f64) -> Self {
        let factor = self.time_to_s(self.gel) / gel_s;
        let usable = factor.is_finite() && factor > 0.0;
        let factor = if usable { factor } else { 0.0 };
        Self { k1_per_s: self.k1_per_s * factor, k2_per_s: self.k2_per_s * factor, ..self }
    }

    /// The solution from nothing on, as a table: 0.2 ms, once to a material and corner.
    pub fn curve(&self) -> CureCurve {
        self.curve_with(CELLS)
    }

    /// The same with a number of cells; the error falls with its fourth power.
    pub fn curve_with(&self, cells: usize) -> CureCurve {
        let gel_s = self.time_to_s(self.gel);
        let mut curve = CureCurve { gel_s, nodes: Vec::new(), n: self.n, max: self.max };
        if !self.cures() {
            return curve;
        }
        let step = (Z_ENDS.1 - Z_ENDS.0) / cells.max(1) as f64;
        curve.nodes.push(Node { time_s: 0.0, left: 0.0, slope: self.slope(0.0) });
        let mut time_s = self.start_s(self.max * logistic(Z_ENDS.0));
        for i in 0..=cells.max(1) {
            let z = Z_ENDS.0 + i as f64 * step;
            let left = left_from_log(-logistic(-z).ln(), self.n);
            let node = Node { time_s, left, slope: self.slope(self.max * logistic(z)) };
            if !(node.time_s.is_finite() && node.left.is_finite() && node.slope.is_finite()) {
                break;
            }
            curve.nodes.push(node);
            time_s += self.cell_s(z, step);
        }
        curve
    }

    /// Whether the law describes a cure at all.
    fn cures(&self) -> bool {
        let Self { m, n, k1_per_s, k2_per_s, max, .. } = *self;
        let finite = [m, n, k1_per_s, k2_per_s, max].iter().all(|v| v.is_finite());
        finite && m >= 0.0 && n >= 0.0 && k1_per_s > 0.0 && k2_per_s >= 0.0 && max > 0.0
    }

    /// Time from `z` to `z + step`, s; in `z` the integrand is smooth for every `m` and `n`.
    fn cell_s(&self, z: f64, step: f64) -> f64 {
        let term = |(node, weight): (f64, f64)| {
            let at = z + node * step;
            let (share, left) = (logistic(at), logistic(-at));
            let start = self.k1_per_s + self.k2_per_s * (self.max * share).powf(self.m);
            weight * share * left.powf(1.0 - self.n) / start
        };
        step * self.max.powf(1.0 - self.n) * GAUSS_UNIT.into_iter().map(term).sum::<f64>()
    }

    /// Time to a degree so small that nothing is used up, s; points crowd at zero.
    fn start_s(&self, degree: f64) -> f64 {
        let term = |(u, weight): (f64, f64)| {
            let at = degree * u.powi(4);
            4.0 * u.powi(3) * weight * degree / self.rate_per_s(at)
        };
        GAUSS_UNIT.into_iter().map(term).sum()
    }

    /// `dy/dt` of [`CureCurve`], 1/s: `α_maxⁿ⁻¹ (k1 + k2 αᵐ)`.
    fn slope(&self, degree: f64) -> f64 {
        self.max.powf(self.n - 1.0) * (self.k1_per_s + self.k2_per_s * degree.powf(self.m))
    }
}

/// Degree of cure against time, from [`Kamal::curve`].
///
/// Kept as `y(t)` with `y = [(1 − α/α_max)¹⁻ⁿ − 1]/(n − 1)`, the variable in which cure of order `n` without
/// autocatalysis is a straight line: cubic Hermite between nodes, straight on past the last one.
#[derive(Debug, Clone, PartialEq)]
pub struct CureCurve {
    /// Time to the gel point, s; infinite if it is never reached.
    pub gel_s: f64,
    nodes: Vec<Node>,
    n: f64,
    max: f64,
}

#[derive(Debug, Clone, Copy, PartialEq)]
struct Node {
    time_s: f64,
    left: f64,
    slope: f64,
}

impl CureCurve {
    /// Degree of cure after a time, in 0..`α_max`; zero before it, for a law that cannot cure and for a time
    /// that is no number. Grows with time to the rounding. 0.2 µs.
    pub fn degree(&self, time_s: f64) -> f64 {
        let Some(last) = self.nodes.last() else { return 0.0 };
        if !(time_s > 0.0) {
            return 0.0;
        }
        let left = if time_s >= last.time_s {
            last.left + last.slope * (time_s - last.time_s)
        } else {
            let after = self.nodes.partition_point(|node| node.time_s <= time_s);
            let (a, b) = (self.nodes[after - 1], self.nodes[after]);
            let length_s = b.time_s - a.time_s;
            let x = (time_s - a.time_s) / length_s;
            let y = 1.0 - x;
            a.left * y * y * (1.0 + 2.0 * x)
                + b.left * x * x * (1.0 + 2.0 * y)
                + length_s * x * y * (a.slope * y - b.slope * x)
        };
        let degree = -self.max * (-log_from_left(left, self.n)).exp_m1();
        if degree.is_nan() { 0.0 } else { degree.clamp(0.0, self.max) }
    }
}

/// `y` from `−ln(1 − α/α_max)`; stable at order one.
fn left_from_log(log: f64, n: f64) -> f64 {
    let order = n - 1.0;
    if order.abs() < 1e-9 { log } else { (order * log).exp_m1() / order }
}

/// `−ln(1 − α/α_max)` from `y`; infinite where an order below one has used everything up.
fn log_from_left(left: f64, n: f64) -> f64 {
    let order = n - 1.0;
    if order.abs() < 1e-9 {
        return left;
    }
    if order * left <= -1.0 { f64::INFINITY } else { (order * left).ln_1p() / order }
}

fn logistic(z: f64) -> f64 {
    1.0 / (1.0 + (-z).exp())
}
