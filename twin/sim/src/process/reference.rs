//! Radial cooling of a cylinder by Bessel series: what the lumped law of `heat` is held against.

/// Bessel function of the first kind, order 0 or 1: `(1/π) ∫₀^π cos(nθ − x sin θ) dθ`, trapezoid.
fn bessel(order: f64, x: f64) -> f64 {
    const POINTS: usize = 200;
    let value = |i: usize| {
        let angle = std::f64::consts::PI * i as f64 / POINTS as f64;
        (order * angle - x * angle.sin()).cos()
    };
    let inner: f64 = (1..POINTS).map(value).sum();
    (inner + 0.5 * (value(0) + value(POINTS))) / POINTS as f64
}

/// Roots of `ζ J1(ζ) = Bi J0(ζ)` below 60, with their amplitudes at the centre.
pub(super) fn eigenvalues(biot: f64) -> Vec<(f64, f64)> {
    let residual = |z: f64| z * bessel(1.0, z) - biot * bessel(0.0, z);
    let mut roots = Vec::new();
    for i in 0..600 {
        let (mut low, mut high) = (0.1 * f64::from(i) + 1e-9, 0.1 * f64::from(i + 1) + 1e-9);
        if residual(low) * residual(high) > 0.0 {
            continue;
        }
        for _ in 0..60 {
            let middle = 0.5 * (low + high);
            if residual(low) * residual(middle) <= 0.0 { high = middle } else { low = middle }
        }
        let (j0, j1) = (bessel(0.0, low), bessel(1.0, low));
        roots.push((low, 2.0 * j1 / (low * (j0 * j0 + j1 * j1))));
    }
    roots
}

/// Fourier number at which the mean (or the centre) has fallen to a share of the excess temperature.
pub(super) fn fourier_to(biot: f64, share: f64, centre: bool) -> f64 {
    let roots = eigenvalues(biot);
    let excess = |fourier: f64| -> f64 {
        roots
            .iter()
            .map(|&(z, c)| {
                let mean = 4.0 * biot * biot / (z * z * (z * z + biot * biot));
                (if centre { c } else { mean }) * (-z * z * fourier).exp()
            })
            .sum()
    };
    let (mut low, mut high) = (1e-4, 100.0);
    for _ in 0..80 {
        let middle = 0.5 * (low + high);
        if excess(middle) > share { low = middle } else { high = middle }
    }
    low
}
