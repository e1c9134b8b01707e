//! The plate against closed fields, the lines against closed and reference trajectories.

use field::{Field, Grid, Tensor, plate};
use lines::{Family, Region, distance, trace};

use super::*;

/// Half height c of the closed beams, with P = q = 1.
const C: f64 = 10.0;
const I: f64 = 2.0 * C * C * C / 3.0;

/// Cantilever with an end load: `σx = -P x y/I`, `τ = -P (c² - y²)/2I`.
fn cantilever([x, y]: [f64; 2]) -> Tensor {
    [-x * y / I, 0.0, -(C * C - y * y) / (2.0 * I)]
}

/// Deep beam under even load (Timoshenko and Goodier), half length l = 40.
fn deep_beam([x, y]: [f64; 2]) -> Tensor {
    let (l, q) = (40.0, 1.0 / (2.0 * I));
    let sx = q * ((l * l - x * x) * y + 2.0 * y.powi(3) / 3.0 - 2.0 * C * C * y / 5.0);
    let sy = -q * (y.powi(3) / 3.0 - C * C * y + 2.0 * C.powi(3) / 3.0);
    [sx, sy, -q * (C * C - y * y) * x]
}

/// Hole of radius 1 in a plate pulled along x.
fn kirsch([x, y]: [f64; 2]) -> Tensor {
    let (r2, angle) = (x * x + y * y, y.atan2(x));
    let (a, b) = (1.0 / r2, 1.0 / (r2 * r2));
    let (c2, c4) = ((2.0 * angle).cos(), (4.0 * angle).cos());
    let (s2, s4) = ((2.0 * angle).sin(), (4.0 * angle).sin());
    [
        1.0 - a * (1.5 * c2 + c4) + 1.5 * b * c4,
        -a * (0.5 * c2 - c4) - 1.5 * b * c4,
        -a * (0.5 * s2 + s4) + 1.5 * b * s4,
    ]
}

/// Ring: `σr = A - B/r²`, `σt = A + B/r²`, `τ = T/r²` with A = 0.3, B = 1, T = 0.7.
fn ring([x, y]: [f64; 2]) -> Tensor {
    let r2 = x * x + y * y;
    let (radial, hoop, shear) = (0.3 - 1.0 / r2, 0.3 + 1.0 / r2, 0.7 / r2);
    let (cc, ss, cs) = (x * x / r2, y * y / r2, x * y / r2);
    [
        radial * cc + hoop * ss - 2.0 * shear * cs,
        radial * ss + hoop * cc + 2.0 * shear * cs,
        (radial - hoop) * cs + shear * (cc - ss),
    ]
}

/// A plate from `origin` on, loaded along its edges by the tractions of a closed field.
fn loaded(grid: Grid, origin: [f64; 2], exact: fn([f64; 2]) -> Tensor) -> Field {
    let [w, h] = grid.cell_m();
    let mut forces = vec![0.0; grid.freedoms()];
    let gauss = [(-0.6f64.sqrt(), 5.0 / 9.0), (0.0, 8.0 / 9.0), (0.6f64.sqrt(), 5.0 / 9.0)];
    let mut edge = |from: (usize, usize), to: (usize, usize), normal: [f64; 2]| {
        let place = |(i, j): (usize, usize)| [i as f64 * w, j as f64 * h];
        let (a, b) = (place(from), place(to));
        for (at, weight) in gauss {
            let part = 0.5 * (1.0 + at);
            let here = [0, 1].map(|k| origin[k] + a[k] + part * (b[k] - a[k]));
            let [sx, sy, shear] = exact(here);
            let pull = [sx * normal[0] + shear * normal[1], shear * normal[0] + sy * normal[1]];
            for (node, share) in [(from, 1.0 - part), (to, part)] {
                for k in 0..2 {
                    forces[2 * grid.node(node.0, node.1) + k] +=
                        pull[k] * share * weight * distance(a, b) / 2.0;
                }
            }
        }
    };
    let [nx, ny] = grid.cells;
    for i in 0..nx {
        edge((i, 0), (i + 1, 0), [0.0, -1.0]);
        edge((i, ny), (i + 1, ny), [0.0, 1.0]);
    }
    for j in 0..ny {
        edge((0, j), (0, j + 1), [-1.0, 0.0]);
        edge((nx, j), (nx, j + 1), [1.0, 0.0]);
    }
    let held = [0, 1, 2 * grid.node(0, ny)];
    plate(grid, 0.3, &forces, &held).unwrap()
}

/// Worst gap of the stress between the centres, over the largest σx, away from the edges by a tenth.
fn gap(origin: [f64; 2], size: [f64; 2], rows: usize, exact: fn([f64; 2]) -> Tensor) -> f64 {
    let columns = (rows as f64 * size[0] / size[1]).round() as usize;
    let field = loaded(Grid { size_m: size, cells: [columns, rows] }, origin, exact);
    let (mut worst, mut most) = (0.0f64, 0.0f64);
    for a in 0..=40 {
        for b in 0..=40 {
            let at = [0.1 + 0.02 * f64::from(a), 0.1 + 0.02 * f64::from(b)];
            let at = [at[0] * size[0], at[1] * size[1]];
            let wanted = exact([origin[0] + at[0], origin[1] + at[1]]);
            let got = field.stress(at);
            for k in 0..3 {
                worst = worst.max((got[k] - wanted[k]).abs());
                most = most.max(wanted[k].abs());
            }
        }
    }
    worst / most
}

/// E25, E26: second order in the cell.
#[test]
fn the_plate_meets_closed_fields() {
    type Case = ([f64; 2], [f64; 2], fn([f64; 2]) -> Tensor);
    let cases: [Case; 2] =
        [([20.0, -C], [60.0, 20.0], cantilever), ([-40.0, -C], [80.0, 20.0], deep_beam)];
    for (origin, size, exact) in cases {
        let gaps = [8, 16, 32].map(|rows| gap(origin, size, rows, exact));
        println!("gaps at 8, 16, 32 rows: {gaps:?}");
        assert!(gaps[0] / gaps[1] > 3.4 && gaps[1] / gaps[2] > 3.4, "{gaps:?}");
        assert!(gaps[2] < 1e-3, "{gaps:?}");
    }
}

#[test]
fn loads_are_spread_whole_and_where_they_belong() {
    let grid = Grid { size_m: [0.15, 0.03], cells: [50, 10] };
    for over in [0.0..0.006, 0.069..0.081, 0.0712..0.0713, 0.144..0.15] {
        let loads = grid.spread(10, over.clone());
        let total: f64 = loads.iter().map(|(_, load)| load).sum();
        let first: f64 = loads.iter().map(|(node, load)| load * (node / 11) as f64 * 0.003).sum();
        assert!((total - 1.0).abs() < 1e-12);
        assert!((first - 0.5 * (over.start + over.end)).abs() < 1e-12);
        assert!(loads.iter().all(|(node, _)| node % 11 == 10));
    }
}

#[test]
fn a_plate_held_too_little_has_no_answer() {
    let grid = Grid { size_m: [1.0, 1.0], cells: [3, 3] };
    assert_eq!(plate(grid, 0.3, &[1.0], &[0, 1]), None);
    assert_eq!(plate(grid, 0.3, &[f64::NAN], &[0, 1, 7]), None);
    // one cell, and pushed alone: still an even stress
    let one = Grid { size_m: [2.0, 1.0], cells: [1, 1] };
    let pull = [0.0, 0.0, 0.0, 0.0, 0.5, 0.0, 0.5, 0.0];
    let field = plate(one, 0.3, &pull, &[0, 1, 2]).unwrap();
    let [sx, sy, shear] = field.stress([0.3, 0.9]);
    assert!((sx - 1.0).abs() < 1e-12 && sy.abs() < 1e-12 && shear.abs() < 1e-12);
}

/// E27: log spirals, `angle - tan β ln r` stays what it is, `tan 2β = -T/B`; fourth order in the step.
#[test]
fn spirals_of_a_ring() {
    let region = Region { low_m: [1.0, -9.0], high_m: [9.0; 2] };
    for (family, slope) in [(Family::Larger, 3.172_365_088), (Family::Smaller, -0.315_222_231)] {
        let worst = |step: f64| {
            let line = trace(&ring, &region, [2.0, 0.0], family, step);
            let off = |[x, y]: &[f64; 2]| (y.atan2(*x) - slope * (x.hypot(*y) / 2.0).ln()).abs();
            line.iter().map(off).fold(0.0, f64::max)
        };
        let (coarse, fine) = (worst(0.1), worst(0.05));
        println!("{family:?}: {coarse:e} {fine:e}");
        assert!(coarse / fine > 12.0 && fine < 1e-5);
    }
}

/// Every point of the reference trajectories (10 digits, rtol 1e-12) lies on our line.
#[test]
fn reference_trajectories() {
    let Some(reference) = reference("stress_lines/analytic_trajectories.json") else { return };
    type Known = (&'static str, fn([f64; 2]) -> Tensor, [[f64; 2]; 2]);
    let fields: [Known; 4] = [
        ("cantilever_parabolic_shear", cantilever, [[0.1, -C], [101.0, C]]),
        ("ss_beam_udl", deep_beam, [[-41.0, -C], [41.0, C]]),
        ("kirsch_hole", kirsch, [[-7.0; 2], [7.0; 2]]),
        ("annulus_pressure_torsion", ring, [[-5.0; 2], [5.0; 2]]),
    ];
    let mut seen = 0;
    for (name, stress, [low_m, high_m]) in fields {
        for line in reference[name]["lines"].as_array().unwrap() {
            let pair = |value: &serde_json::Value| [0, 1].map(|k| value[k].as_f64().unwrap());
            let family = if line["family"] == 1 { Family::Larger } else { Family::Smaller };
            let region = Region { low_m, high_m };
            let step = 0.01;
            let ours = trace(&stress, &region, pair(&line["seed"]), family, step);
            let mut worst = 0.0f64;
            for point in line["points"].as_array().unwrap() {
                worst = worst.max(off_line(&ours, pair(point)));
            }
            assert!(worst < 1e-5, "{name} {}: {worst:e}", line["seed"]);
            seen += 1;
        }
    }
    assert_eq!(seen, 32);
}

/// Distance of a point from the nearest piece of a line.
fn off_line(line: &[[f64; 2]], at: [f64; 2]) -> f64 {
    let piece = |pair: &[[f64; 2]]| {
        let (a, b) = (pair[0], pair[1]);
        let along = [b[0] - a[0], b[1] - a[1]];
        let length2 = along[0] * along[0] + along[1] * along[1];
        let part = ((at[0] - a[0]) * along[0] + (at[1] - a[1]) * along[1]) / length2.max(1e-300);
        let part = part.clamp(0.0, 1.0);
        distance(at, [a[0] + part * along[0], a[1] + part * along[1]])
    };
    line.windows(2).map(piece).fold(f64::INFINITY, f64::min)
}

#[test]
fn a_line_ends_on_the_edge_or_at_once() {
    let region = Region { low_m: [0.5, -C], high_m: [60.0, C] };
    let line = trace(&cantilever, &region, [30.0, 0.0], Family::Larger, 0.5);
    for end in [line[0], line[line.len() - 1]] {
        let off = (end[0] - 60.0).abs().min((end[1].abs() - C).abs());
        assert!(off < 1e-9 && region.holds(end), "{end:?}");
    }
    let even = |_: [f64; 2]| [3.0, 3.0, 0.0];
    assert!(trace(&even, &region, [30.0, 0.0], Family::Larger, 0.5).is_empty());
    let nothing = |_: [f64; 2]| [f64::NAN; 3];
    assert!(trace(&nothing, &region, [30.0, 0.0], Family::Larger, 0.5).is_empty());
    assert!(trace(&cantilever, &region, [90.0, 0.0], Family::Larger, 0.5).is_empty());
    for step in [0.0, f64::NAN, f64::INFINITY, -1.0] {
        assert!(trace(&cantilever, &region, [30.0, 0.0], Family::Larger, step).len() < 4);
    }
    // a circle closes
    let circle = |[x, y]: [f64; 2]| [y * y, x * x, -x * y];
    let wide = Region { low_m: [-3.0; 2], high_m: [3.0; 2] };
    let line = trace(&circle, &wide, [1.0, 0.0], Family::Larger, 0.01);
    assert!((600..650).contains(&line.len()), "{}", line.len());
}
