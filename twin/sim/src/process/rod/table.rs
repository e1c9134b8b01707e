//! Compliance against age, integrated once.

/// Nodes and weights of three-point Gauss–Legendre quadrature on 0..1.
const GAUSS: [(f64, f64); 3] = [
    (0.112_701_665_379_258_31, 0.277_777_777_777_777_8),
    (0.5, 0.444_444_444_444_444_4),
    (0.887_298_334_620_741_7, 0.277_777_777_777_777_8),
];

/// Compliance flowed through, `J(a) = ∫₀ᵃ f da`, 1/Pa, at ages that crowd where the strand is young.
#[derive(Debug, Clone, PartialEq)]
pub struct AgeTable {
    rigid_s: f64,
    /// J and dJ/du at u = 0..=1, where `a = rigid_s u²`.
    rows: Vec<[f64; 2]>,
}

impl AgeTable {
    /// Integrates a fluidity `1/(3 η)`, 1/(Pa s) of age s, up to an age from which it is rigid.
    ///
    /// `pieces` equal steps in `u = (a/rigid_s)^½`, three Gauss points to each (sixth order where the fluidity
    /// is smooth); between them a cubic on values and slopes, fourth order. 200 pieces over 33 e-foldings give 1e-7
    /// of the whole. At least one piece, at most 100 000; `rigid_s` not positive: nothing ever flows.
    pub fn new(fluidity: impl Fn(f64) -> f64, rigid_s: f64, pieces: u32) -> Self {
        let count = pieces.clamp(1, 100_000);
        let width = 1.0 / f64::from(count);
        let rate = |u: f64| 2.0 * rigid_s * u * fluidity(rigid_s * u * u);
        let mut rows = Vec::with_capacity(count as usize + 1);
        let mut sum = 0.0;
        for i in 0..=count {
            let u = f64::from(i) * width;
            rows.push([sum, rate(u)]);
            sum += GAUSS.iter().map(|(x, w)| w * width * rate(u + x * width)).sum::<f64>();
        }
        Self { rigid_s, rows }
    }

    /// Compliance flowed through up to an age, 1/Pa; constant from the rigid age on.
    pub fn compliance_per_pa(&self, age_s: f64) -> f64 {
        let pieces = (self.rows.len() - 1) as f64;
        if !(age_s > 0.0) || !(self.rigid_s > 0.0) {
            return 0.0;
        }
        let place = (age_s / self.rigid_s).sqrt().min(1.0) * pieces;
        let at = (place as usize).min(self.rows.len() - 2);
        let x = place - at as f64;
        let ([from, from_rate], [to, to_rate]) = (self.rows[at], self.rows[at + 1]);
        let (a, b) = (from_rate / pieces, to_rate / pieces);
        let rise = to - from;
        from + x * (a + x * (3.0 * rise - 2.0 * a - b + x * (a + b - 2.0 * rise)))
    }

    /// The whole compliance, 1/Pa: `1/E_eff`, case EEFF-FROZEN.
    pub fn frozen_per_pa(&self) -> f64 {
        self.compliance_per_pa(f64::INFINITY)
    }

    /// Age from which it is rigid, s.
    pub fn rigid_s(&self) -> f64 {
        self.rigid_s
    }
}
