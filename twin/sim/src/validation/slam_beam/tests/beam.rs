//! Nets, sections and frames of the two beams; what they must respect whatever they come to.

use super::*;
use case::MICHELL_M;
use chosen::Pair;
use lines::{Family, Region};
use loaded::{Loaded, Made};
use net::{Line, Part, net};
use printed::{MASS_KG, SPAN_M, axes, enclosure_m, layers, road_m, stress, wall};

/// ABS, nominal, as in the library.
const MADE: Made = Made {
    density_kg_m3: 1040.0,
    e_pa: 2.3e9,
    poisson: 0.36,
    yield_pa: 42.66e6,
    bond_fraction: 0.56,
};

#[test]
fn lines_crossed_in_a_box() {
    let enclosure = Region { low_m: [0.0; 2], high_m: [4.0, 2.0] };
    let corners = [[0.0, 0.0], [4.0, 0.0], [0.0, 2.0], [4.0, 2.0]];
    let of = |family, points: &[[f64; 2]]| Line { family, points: points.to_vec() };
    let lines = [
        // ends a little inside: led to the sides
        of(Family::Larger, &[[0.1, 1.0], [2.0, 1.0], [3.9, 1.0]]),
        of(Family::Smaller, &[[1.0, 0.1], [1.0, 1.9]]),
        // through the first line's inner corner: one crossing, not two
        of(Family::Smaller, &[[2.0, 0.1], [2.0, 1.9]]),
        // ends in the open beyond its crossing: cut there
        of(Family::Smaller, &[[3.0, 0.1], [3.0, 1.4]]),
        // lies along a side
        of(Family::Larger, &[[0.5, 0.05], [3.5, 0.05]]),
    ];
    let got = net(&lines, &enclosure, &corners, 0.1, 0.06);
    let inner = |family| got.bars.iter().filter(|bar| bar.part == Part::Inner(family)).count();
    // 4 pieces across; 2 + 2 + 1 upright, each crossed again 0.05 above the foot: the same joint
    assert_eq!((inner(Family::Larger), inner(Family::Smaller)), (4, 5));
    assert!((got.total_m(|part| part == Part::Enclosure) - 12.0).abs() < 1e-12);
    assert!((got.total_m(|part| part == Part::Inner(Family::Larger)) - 4.0).abs() < 1e-12);
    assert!((got.total_m(|part| part == Part::Inner(Family::Smaller)) - 5.0).abs() < 1e-12);
    // by hand: 4 corners, 2 + 5 feet, 2 feet of the line along the side, 3 crossings
    assert_eq!(got.nodes_m.len(), 16);
    // a box alone, and nothing
    assert_eq!(net(&[], &enclosure, &corners, 0.1, 0.06).bars.len(), 4);
    assert_eq!(net(&[], &enclosure, &[], 0.1, 0.06).bars.len(), 0);
}

/// A wall of roads and layers is nearly the rectangle around it: what is missing are the corners.
#[test]
fn a_wall_is_nearly_a_rectangle() {
    let (roads, layers) = (4, layers());
    let got = wall(roads, layers, road_m(), 1.0).unwrap();
    let rectangle = enclosure_m() * 0.0305;
    assert!((0.85..0.92).contains(&(got.section.area_m2 / rectangle)));
    assert!((got.half_m[0] / (enclosure_m() / 2.0) - 1.0).abs() < 1e-9);
    assert!((got.half_m[1] / 0.01525 - 1.0).abs() < 2e-3);
    let slipping = wall(roads, layers, road_m(), 0.0).unwrap();
    // four roads that slip are softer across by about their number squared
    let softer = got.section.iz_m4 / slipping.section.iz_m4;
    assert!((16.0..20.0).contains(&softer), "{softer}");
}

/// The field of the box mirrors: σ the same, τ with its sign turned.
#[test]
fn the_field_is_symmetric() {
    let field = stress(0.36).unwrap();
    for at in [[0.01, 0.01], [0.05, 0.03], [0.07, 0.018]] {
        let (a, b) = (field.stress(at), field.stress([SPAN_M - at[0], at[1]]));
        let size = a.iter().fold(0.0f64, |most, part| most.max(part.abs()));
        for (k, sign) in [1.0, 1.0, -1.0].into_iter().enumerate() {
            assert!((a[k] - sign * b[k]).abs() < 1e-8 * size, "{at:?}: {a:?} {b:?}");
        }
    }
    // beam theory far from loads: σx at mid-depth is nothing, shear carries half the load
    let deep_m = axes().high_m[1];
    let n = 200;
    let shear: f64 = (0..n)
        .map(|k| field.stress([0.04, (f64::from(k) + 0.5) / f64::from(n) * deep_m])[2])
        .sum::<f64>()
        * deep_m
        / f64::from(n);
    assert!((shear.abs() - 0.5).abs() < 2e-3, "{shear}");
}

#[test]
fn both_beams_of_one_mass() {
    let field = stress(MADE.poisson).unwrap();
    for roads in [2, 3, 4] {
        let pair = Pair::new(&field, MADE, roads).unwrap();
        println!(
            "{roads} roads: {} lines, {} bars, {} nodes; grid {} rows, {} bars of {:.3} mm",
            pair.lines.count,
            pair.lines.net.bars.len(),
            pair.lines.net.nodes_m.len(),
            pair.grid.count,
            pair.grid.net.bars.len(),
            pair.grid.inner_m * 1e3
        );
        println!("  lines {:?}\n  grid  {:?}", pair.of_lines, pair.of_grid);
        // a beam that mirrors
        for at in &pair.lines.net.nodes_m {
            let mirrored = [SPAN_M - at[0], at[1]];
            let near = |to: &[f64; 2]| lines::distance(*to, mirrored) < 0.1 * pair.lines.inner_m;
            assert!(pair.lines.net.nodes_m.iter().any(near), "{at:?} has no mirror");
        }
        let (lines_m3, grid_m3) = (pair.lines.volume_m3(), pair.grid.volume_m3());
        assert!((grid_m3 / lines_m3 - 1.0).abs() < 1e-9);
        // as near as a pair of lines more or less comes
        let step = if roads == 2 { 0.01 } else { 0.1 };
        assert!((lines_m3 * MADE.density_kg_m3 / MASS_KG - 1.0).abs() < step);
        assert!((pair.grid.inner_m / pair.lines.inner_m - 1.0).abs() < 0.1);
        assert!(pair.stiffer() > 1.0, "{}", pair.stiffer());
        for told in [&pair.of_lines, &pair.of_grid] {
            // a bar that is bent besides yields no later
            assert!(told.fibre_n < told.axial_n);
            // Michell: stress at most the yield everywhere, strain energy at least the truss's
            assert!(told.fibre_n <= MADE.yield_pa * lines_m3 / MICHELL_M);
            assert!(told.stiffness_n_per_m <= MADE.e_pa * lines_m3 / MICHELL_M.powi(2));
        }
        // lines carry by axial force like a truss, the grid does not
        assert!(pair.of_lines.force_path_m > MICHELL_M && pair.of_grid.force_path_m < MICHELL_M);
    }
}

/// The frame is in balance and its plastic bound is between first yield and Michell's.
#[test]
fn balance_and_plastic_bound() {
    let field = stress(MADE.poisson).unwrap();
    let pair = Pair::new(&field, MADE, 4).unwrap();
    let loaded = Loaded::new(&pair.lines, MADE).unwrap();
    let solution = loaded.solved().unwrap();
    let carried: f64 = solution.reactions.iter().map(|reaction| reaction[1]).sum();
    assert!((carried - 1.0).abs() < 1e-9, "{carried}");
    let most = solution.reactions.iter().map(|reaction| reaction[1]).fold(0.0, f64::max);
    assert!((most - 0.5).abs() < 0.01, "{most}");
    let plastic_n = loaded.plastic_n().unwrap();
    println!("plastic {plastic_n} fibre {}", pair.of_lines.fibre_n);
    assert!(plastic_n >= pair.of_lines.fibre_n);
    assert!(plastic_n <= MADE.yield_pa * pair.lines.volume_m3() / MICHELL_M);
}

/// E drops out of the loads, fy out of the stiffness; both are linear in theirs.
#[test]
fn loads_go_with_strength_and_stiffness_with_modulus() {
    let field = stress(MADE.poisson).unwrap();
    let one = Pair::new(&field, MADE, 4).unwrap().of_lines;
    let other = Made { e_pa: 3.0 * MADE.e_pa, yield_pa: 2.0 * MADE.yield_pa, ..MADE };
    let two = Pair::new(&field, other, 4).unwrap().of_lines;
    let ratios = [
        two.axial_n / one.axial_n / 2.0,
        two.fibre_n / one.fibre_n / 2.0,
        two.joint_n / one.joint_n / 2.0,
        two.stiffness_n_per_m / one.stiffness_n_per_m / 3.0,
    ];
    assert!(ratios.iter().all(|ratio| (ratio - 1.0).abs() < 1e-9), "{ratios:?}");
}
