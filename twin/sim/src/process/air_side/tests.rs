//! The table against the laws it stands for.

use proptest::prelude::*;

use super::*;
use crate::process::heat::total_h_w_m2k;
use crate::process::tests::close;

#[test]
fn same_as_the_laws() {
    let mut worst: f64 = 0.0;
    for diameter_m in [0.3e-3, 1.27e-3, 4e-3] {
        for (air_k, hottest_k) in [(295.15, 513.15), (283.15, 333.15), (323.15, 640.0)] {
            let side = AirSide::new(diameter_m, air_k, hottest_k, 0.92);
            for i in 0..=50 {
                let surface_k = air_k + (hottest_k - air_k) * f64::from(i) / 50.0;
                for air_m_s in [0.0, 0.05, 0.3, 1.0, 4.0, 20.0, 80.0] {
                    let want = total_h_w_m2k(diameter_m, surface_k, air_k, air_m_s, 0.92);
                    worst = worst.max((side.h_w_m2k(surface_k, air_m_s) / want - 1.0).abs());
                }
            }
        }
    }
    assert!(worst < 1.5e-3, "{worst}");
    // At a node it is the law itself.
    let side = AirSide::new(1.27e-3, 295.15, 513.15, 0.9);
    let want = total_h_w_m2k(1.27e-3, 513.15, 295.15, 7.0, 0.9);
    close(side.h_w_m2k(513.15, 7.0), want, 1e-12);
    let want = total_h_w_m2k(1.27e-3, 404.15, 295.15, 0.0, 0.9);
    close(side.h_w_m2k(404.15, 0.0), want, 1e-12);
}

proptest! {
    #[test]
    fn never_panics(
        diameter_m in prop::num::f64::ANY,
        air_k in prop::num::f64::ANY,
        hottest_k in prop::num::f64::ANY,
        surface_k in prop::num::f64::ANY,
        air_m_s in prop::num::f64::ANY,
    ) {
        let side = AirSide::new(diameter_m, air_k, hottest_k, 0.9);
        let _ = side.h_w_m2k(surface_k, air_m_s);
    }
}
