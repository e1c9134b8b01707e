//! Radial cooling against the Bessel series and against itself.

use super::*;
use crate::process::reference::fourier_to;
use crate::process::tests::{close, within};

#[test]
fn scratch() {
    for cells in [6, 12, 24] {
        for (name, [rho, cp, k, start, flow, glass, d_mm, h], want) in RADIAL {
            let strand = RoundStrand {
                diameter_m: d_mm * 1e-3,
                density_kg_m3: rho,
                conductivity_w_mk: Linear::constant(k),
                cp_j_kgk: Linear::constant(cp),
            };
            let c = 273.15;
            let around = Surroundings { air_k: 22.0 + c, h_w_m2k: &|_, _| h, source_w_m3: &|_| 0.0 };
            let span = Span { from_s: 0.0, until_s: 1e3, stop_k: 40.0 + c, tolerance_k: 0.05, longest_step_s: 1e9 };
            let t0 = std::time::Instant::now();
            let mut got = cool(&strand, &uniform_profile_k(start + c, cells), &around, &span);
            for _ in 0..99 { got = cool(&strand, &uniform_profile_k(start + c, cells), &around, &span); }
            let us = t0.elapsed().as_secs_f64() * 1e4;
            let biot = h * d_mm * 0.5e-3 / k;
            let per = d_mm * d_mm * 0.25e-6 * rho * cp / k;
            let exact = |t: f64, centre| per * fourier_to(biot, (t - 22.0) / (start - 22.0), centre);
            println!("{name} {cells} steps {} {us:.1} us  {:.4} {:.4} {:.4} {:.4}  {want:?} bal {:e}", got.ages_s.len(),
              got.time_to_s(flow+c)-exact(flow,false), got.core_time_to_s(flow+c)-exact(flow,true),
              got.time_to_s(glass+c)-exact(glass,false), got.core_time_to_s(glass+c)-exact(glass,true),
              got.balance.lost_j_m/ got.balance.content_lost_j_m-1.0);
        }
    }
    close(1.0,1.0,1.0); within(1.0,1.0,1.0);
}
const RADIAL: [(&str, [f64; 8], [f64; 4]); 5] = [
    (
        "ABS-1.27-100",
        [1040.0, 1950.0, 0.19, 240.0, 150.0, 105.0, 1.27, 100.0],
        [3.71, 4.25, 6.74, 7.28],
    ),
    (
        "ABS-3-200",
        [1040.0, 1950.0, 0.19, 240.0, 150.0, 105.0, 3.0, 200.0],
        [5.46, 8.59, 10.19, 13.34],
    ),
    (
        "PLA-1.27-200",
        [1240.0, 1800.0, 0.18, 210.0, 155.0, 60.0, 1.27, 200.0],
        [1.42, 2.06, 6.68, 7.32],
    ),
    (
        "PLA-3-100",
        [1240.0, 1800.0, 0.18, 210.0, 155.0, 60.0, 3.0, 100.0],
        [6.84, 10.42, 32.45, 36.04],
    ),
    (
        "PLA-3-400",
        [1240.0, 1800.0, 0.18, 210.0, 155.0, 60.0, 3.0, 400.0],
        [2.27, 5.77, 12.5, 16.28],
    ),
];
