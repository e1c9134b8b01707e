//! What single sections carry when they yield through.

use super::collapse::{EQUAL, YIELD_PA};
use super::*;
use crate::structure::{Strength, plastic_bound};

/// One bar from a wall, its end pushed and turned: a factor of 1 is the edge of its plastic domain.
fn at_the_edge(section: Section, strength: Strength, load: [f64; 6]) -> f64 {
    let mut bar = member([0, 1], section, Elastic::isotropic(2e9, 0.36));
    bar.side = Vector::y();
    let nodes = vec![Point::origin(), Point::new(0.05, 0.0, 0.0)];
    let frame = Frame::new(nodes, vec![bar]).unwrap();
    let none = Load::default();
    plastic_bound(&frame, &clamped([0]), &[strength], &none, &pushed(1, load)).unwrap().bound
}

/// Ellipse: the circle's curve, stretched; rectangle: `m = 1 - n²`; any other: no further than its
/// fibre. Torque: `τ = √(1 - s²) f/√3` leaves s of the rest.
#[test]
fn domains_of_sections() {
    let (half_width, half_height) = (1.5e-3, 0.6e-3);
    let ellipse = Section::ellipse(2.0 * half_width, 2.0 * half_height);
    let full = 4.0 / 3.0 * half_width * half_height * YIELD_PA;
    let (full_y, full_z) = (full * half_height, full * half_width);
    for (turn, theta) in [(0.0f64, 0.3f64), (0.9, 0.8), (std::f64::consts::FRAC_PI_2, 0.1)] {
        let n = 2.0 / std::f64::consts::PI * (theta + theta.sin() * theta.cos());
        let m = theta.cos().powi(3);
        let moments = [m * turn.cos() * full_y, m * turn.sin() * full_z];
        let axial = -n * ellipse.area_m2 * YIELD_PA;
        let got = at_the_edge(ellipse, EQUAL, [axial, 0.0, 0.0, 0.0, moments[0], moments[1]]);
        near(got, 1.0, 1e-5);
        assert!(got <= 1.0 + 1e-9);
    }
    let (wide, high) = (3e-3, 1e-3);
    let rectangle = Section {
        area_m2: wide * high,
        iy_m4: wide * high.powi(3) / 12.0,
        iz_m4: wide.powi(3) * high / 12.0,
        j_m4: 1e-13,
        shear_kappa: f64::INFINITY,
        fibre_m: wide.hypot(high) / 2.0,
    };
    let (full_n, full_m) = (wide * high * YIELD_PA, wide * high * high / 4.0 * YIELD_PA);
    for n in [0.0, 0.3, 0.8] {
        let load = [n * full_n, 0.0, 0.0, 0.0, (1.0 - n * n) * full_m, 0.0];
        near(at_the_edge(rectangle, EQUAL, load), 1.0, 1e-9);
    }
    // b² (3 h - b)/6 of the heap of sand, and half of the yield left for pulling
    let heap = high * high * (3.0 * wide - high) / 6.0 * YIELD_PA / 3f64.sqrt();
    near(at_the_edge(rectangle, EQUAL, [0.0, 0.0, 0.0, heap, 0.0, 0.0]), 1.0, 1e-9);
    let load = [0.5 * full_n, 0.0, 0.0, 0.75f64.sqrt() * heap, 0.0, 0.0];
    near(at_the_edge(rectangle, EQUAL, load), 1.0, 1e-9);
    // neither: elastic to its fibre
    let other = Section { fibre_m: 2e-3, ..rectangle };
    let elastic = other.iy_m4 / other.fibre_m * YIELD_PA;
    near(at_the_edge(other, EQUAL, [0.0, 0.0, 0.0, 0.0, elastic, 0.0]), 1.0, 1e-9);
    // half the strength in tension halves that, not the compression
    let weak = Strength { tension_pa: 0.5 * YIELD_PA, ..EQUAL };
    near(at_the_edge(rectangle, weak, [0.5 * full_n, 0.0, 0.0, 0.0, 0.0, 0.0]), 1.0, 1e-9);
    near(at_the_edge(rectangle, weak, [-full_n, 0.0, 0.0, 0.0, 0.0, 0.0]), 1.0, 1e-9);
}
