//! A cantilever that bends far under its own weight.

/// Weight number from which the drop is within a tenth of the length; past it curled-up equilibria
/// appear, and shooting finds those.
const HEAVIEST: f64 = 50.0;

/// Where a heavy cantilever, clamped level, comes to rest; lengths over its length.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Elastica {
    /// Drop of the tip over length.
    pub drop: f64,
    /// How much nearer the clamp the tip is, over length.
    pub shortening: f64,
    /// Angle of the tip below level, rad.
    pub tip_rad: f64,
}

/// Rest shape of a heavy elastica: `θ'' = −k t cos θ`, `θ'(0) = 0` at the tip, `θ(1) = 0` at the clamp.
///
/// `k = q L³/(E I) = 16 ρ g L³/(E D²)`, `t` arc length from the tip over length. Shooting on the tip's angle by
/// bisection, Runge–Kutta of fourth order in `steps`; 100 steps give 1e-6 up to `k = 32`. Heavier than 50
/// is taken as 50. Source: cases ELASTICA-*.
pub fn heavy_elastica(weight_number: f64, steps: u32) -> Elastica {
    let k = if weight_number >= 0.0 { weight_number.min(HEAVIEST) } else { 0.0 };
    let (mut low, mut high) = (0.0, std::f64::consts::FRAC_PI_2);
    for _ in 0..45 {
        let middle = 0.5 * (low + high);
        if shoot(k, middle, steps)[0] < 0.0 { low = middle } else { high = middle }
    }
    let [_, _, drop, reach] = shoot(k, low, steps);
    Elastica { drop, shortening: 1.0 - reach, tip_rad: low }
}

/// Angle, curvature, drop and reach at the clamp for an angle at the tip.
fn shoot(k: f64, tip_rad: f64, steps: u32) -> [f64; 4] {
    let slope = |t: f64, y: [f64; 4]| [y[1], -k * t * y[0].cos(), y[0].sin(), y[0].cos()];
    let step = 1.0 / f64::from(steps.max(1));
    let along = |y: [f64; 4], k: [f64; 4], h: f64| std::array::from_fn(|i| y[i] + h * k[i]);
    let mut y = [tip_rad, 0.0, 0.0, 0.0];
    for i in 0..steps.max(1) {
        let t = f64::from(i) * step;
        let a = slope(t, y);
        let b = slope(t + 0.5 * step, along(y, a, 0.5 * step));
        let c = slope(t + 0.5 * step, along(y, b, 0.5 * step));
        let d = slope(t + step, along(y, c, step));
        y = std::array::from_fn(|i| y[i] + step / 6.0 * (a[i] + 2.0 * (b[i] + c[i]) + d[i]));
    }
    y
}
