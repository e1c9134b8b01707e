//! Members that move far: structures.md, section 2, C.

use std::f64::consts::PI;

use super::super::utilisation;
use super::*;
use crate::structure::{Strength, solve};

/// A cantilever along x of length 1 and `E I = 1`, as good as without stretch.
fn cantilever(parts: usize) -> (Frame, Vec<Support>) {
    let frame = legs(&[[0.0, 0.0], [1.0, 0.0]], section(1e6, 1.0, 1.0), 1.0, parts);
    let supports = in_plane(&frame, &[(0, [true; 3])]);
    (frame, supports)
}

/// `P L²/E I`, then tip across and back over L, by elliptic integrals (Mattiasson 1981).
const ELASTICA: [(f64, f64, f64); 5] = [
    (0.5, 0.162144, 0.015919),
    (1.0, 0.301721, 0.056433),
    (2.0, 0.493457, 0.160642),
    (5.0, 0.713792, 0.387628),
    (10.0, 0.810609, 0.554996),
];

fn tip_across(parts: usize, push: f64) -> (f64, f64, Path) {
    let (frame, supports) = cantilever(parts);
    let load = pushed(1, [0.0, push, 0.0, 0.0, 0.0, 0.0]);
    let path = path(&frame, &supports, &load, &Options::default());
    (path.displacement[1][1], -path.displacement[1][0], path)
}

#[test]
fn c17_elastica() {
    for (push, across, back) in ELASTICA {
        let (v, u, path) = tip_across(64, push);
        eprintln!("C17 {push}: {v:.6} ({across}) {u:.6} ({back}), {} iterations", path.iterations);
        near(v, across, 1e-4);
        near(u, back, 1e-4 * across / back);
    }
}

/// Halving the elements divides the error by sixteen: the axis bows within them.
#[test]
fn c17_order_of_convergence() {
    let tip = |parts| {
        let (v, u, _) = tip_across(parts, 5.0);
        Vector::new(v, u, 0.0)
    };
    let fine = tip(64);
    let errors = [4, 8, 16].map(|parts| (tip(parts) - fine).norm());
    eprintln!("C17 errors {errors:?}");
    for pair in errors.windows(2) {
        let order = (pair[0] / pair[1]).log2();
        assert!((order - 4.0).abs() < 0.3, "{order}");
    }
}

/// An end moment of `2 π E I/L` rolls a cantilever up.
#[test]
fn c18_closed_circle() {
    for parts in [8, 20] {
        let (frame, supports) = cantilever(parts);
        let load = pushed(1, [0.0, 0.0, 0.0, 0.0, 0.0, 2.0 * PI]);
        let path = path(&frame, &supports, &load, &Options::default());
        let [u, v, ..] = path.displacement[1];
        eprintln!("C18 {parts}: {:e} {v:e}, {} iterations", u + 1.0, path.iterations);
        // the chords of equal elements close whatever their number
        assert!((u + 1.0).hypot(v) < 1e-6);
    }
}

/// The same circle in a plane askew, with nothing to keep it there: the moment, fixed in space,
/// leaves the tangent without symmetry.
#[test]
fn c18_closed_circle_in_space() {
    let direction = Vector::new(1.0, 2.0, -0.5).normalize();
    let about = direction.cross(&Vector::new(0.0, 0.3, 1.0)).normalize() * (2.0 * PI);
    let nodes = vec![Point::origin(), Point::from(direction)];
    let bar = member([0, 1], section(1e4, 1.0, 1.0), 1.0);
    let frame = subdivided(&Frame::new(nodes, vec![bar]).unwrap(), 10);
    let load = pushed(1, [0.0, 0.0, 0.0, about.x, about.y, about.z]);
    let options = Options { past_critical: true, ..Options::default() };
    let path = nonlinear(&frame, &[Support::clamped(0)], &load, &[], &options).unwrap();
    let tip = Vector::from_column_slice(&path.displacement[1][..3]);
    let gap = (tip + direction).norm();
    eprintln!(
        "C18 space: {:?}, at {} {gap:e}, {} iterations, {} points",
        path.outcome,
        path.factor,
        path.iterations,
        path.points.len()
    );
    assert_eq!(path.factor, 1.0);
    assert!(gap < 1e-6);
}

/// Bathe and Bolourchi's bend: an eighth of a circle of 100, square 1, pushed out of its plane.
/// The scatter of the literature is the torsion constant; it is given.
#[test]
fn c19_bend_of_45_degrees() {
    let parts = 32;
    let at = |k: usize| {
        let turn = PI / 4.0 * k as f64 / parts as f64;
        Point::new(100.0 * turn.sin(), 100.0 * (1.0 - turn.cos()), 0.0)
    };
    let bend = |j_m4: f64| {
        let one = |k: usize| Member {
            elastic: Elastic { e_pa: 1e7, g_pa: 5e6 },
            ..member([k, k + 1], section(1.0, 1.0 / 12.0, j_m4), 1e7)
        };
        Frame::new((0..=parts).map(at).collect(), (0..parts).map(one).collect()).unwrap()
    };
    let printed = [
        (1.0 / 6.0, 300.0, [58.781, 22.246, 40.191]),
        (1.0 / 6.0, 450.0, [52.241, 18.510, 48.503]),
        (1.0 / 6.0, 600.0, [47.152, 15.686, 53.476]),
        (0.1406, 600.0, [46.893, 15.559, 53.609]),
    ];
    for (j_m4, push, place) in printed {
        let frame = bend(j_m4);
        let load = pushed(parts, [0.0, 0.0, push, 0.0, 0.0, 0.0]);
        let path = path(&frame, &[Support::clamped(0)], &load, &Options::default());
        let tip = at(parts) + Vector::from_column_slice(&path.displacement[parts][..3]);
        let got = [tip.x, tip.y, tip.z];
        eprintln!("C19 J {j_m4:.4} P {push}: {got:?} {place:?}, {} iterations", path.iterations);
        let gap = Vector::from(got) - Vector::from(place);
        assert!(gap.norm() < 3e-3 * Vector::from(place).norm());
        for axis in 0..3 {
            near(got[axis], place[axis], 3e-3);
        }
    }
}

/// A light load of every kind gives the linear answer: displacements, end forces, reactions,
/// utilisation.
#[test]
fn light_loads_are_linear() {
    let rod = Member {
        section: Section::ellipse(3e-3, 2e-3).sheared(0.9),
        elastic: Elastic { e_pa: 3.5e9, g_pa: 1.3e9 },
        density_kg_m3: 1240.0,
        initial_strain: -1e-9,
        side: Vector::new(0.1, 0.2, 1.0),
        ..member([0, 1], Section::circle(2e-3), 3.5e9)
    };
    let nodes = vec![
        Point::origin(),
        Point::new(0.05, 0.01, 0.04),
        Point::new(0.02, 0.06, 0.05),
        Point::new(0.07, 0.05, 0.0),
    ];
    let ends = [[0, 1], [1, 2], [2, 3], [1, 3]];
    let members: Vec<Member> = ends.iter().map(|&ends| Member { ends, ..rod }).collect();
    let frame = Frame::new(nodes, members).unwrap();
    let supports = [Support::clamped(0), Support::pinned(3)];
    let load = Load {
        gravity_m_s2: [1e-6, 2e-6, -1e-5],
        with_initial_strain: true,
        ..pushed(2, [1e-7, -2e-7, 3e-7, 1e-9, 1e-9, -2e-9])
    };
    let wanted = solve(&frame, &supports, &load).unwrap();
    let got = nonlinear(&frame, &supports, &load, &[], &Options::default()).unwrap();
    assert_eq!(got.outcome, Outcome::Converged);
    let gap = |got: &[f64], wanted: &[f64]| {
        let most = wanted.iter().fold(0.0f64, |most, x| most.max(x.abs()));
        got.iter().zip(wanted).fold(0.0f64, |gap, (a, b)| gap.max((a - b).abs())) / most
    };
    assert!(gap(got.displacement.as_flattened(), wanted.displacement.as_flattened()) < 1e-6);
    assert!(gap(got.end_forces.as_flattened(), wanted.end_forces.as_flattened()) < 1e-6);
    assert!(gap(got.reactions.as_flattened(), wanted.reactions.as_flattened()) < 1e-6);
    let strength = Strength { tension_pa: 1.0, compression_pa: 1.0 };
    let strengths = [strength; 4];
    let linear =
        crate::structure::utilisation(&frame, &strengths, &wanted, load.gravity_m_s2).unwrap();
    let far = utilisation(&frame, 1, &strengths, &got).unwrap();
    let (linear, far) = (linear.unwrap(), far.unwrap());
    assert_eq!((linear.member, linear.governs), (far.member, far.governs));
    near(far.value, linear.value, 1e-6);
    // cut in two, the same: what joins the parts is no bond
    let halves = subdivided(&frame, 2);
    let got = nonlinear(&halves, &supports, &load, &[], &Options::default()).unwrap();
    let cut = utilisation(&halves, 2, &[strength; 4], &got).unwrap().unwrap();
    assert_eq!((cut.member, cut.governs), (far.member, far.governs));
    near(cut.value, far.value, 1e-6);
    assert!((cut.station_m - far.station_m).abs() < 1e-9);
}

/// What holds a bent frame balances what acts on it, about any point of the moved frame.
#[test]
fn forces_balance_on_the_moved_frame() {
    let rod = Member { density_kg_m3: 1240.0, ..member([0, 1], Section::circle(2e-3), 3.5e9) };
    let nodes = vec![
        Point::origin(),
        Point::new(0.1, 0.0, 0.05),
        Point::new(0.1, 0.1, 0.08),
        Point::new(0.0, 0.1, 0.0),
    ];
    let members = [[0, 1], [1, 2], [2, 3]].map(|ends| Member { ends, ..rod }).to_vec();
    let frame = subdivided(&Frame::new(nodes, members).unwrap(), 4);
    let load =
        Load { gravity_m_s2: [0.0, 0.0, -9.80665], ..pushed(2, [0.5, -0.3, -1.0, 0.0, 0.0, 0.0]) };
    let supports = [Support::clamped(0), Support::clamped(3)];
    let path = path(&frame, &supports, &load, &Options::default());
    let place = |node: usize| {
        frame.nodes()[node].coords + Vector::from_column_slice(&path.displacement[node][..3])
    };
    let moved = Vector::from_column_slice(&path.displacement[2][..3]).norm();
    assert!(moved > 0.01, "{moved}");
    let mut force = Vector::new(0.5, -0.3, -1.0);
    let mut moment = place(2).cross(&force);
    for member in frame.members() {
        let [a, b] = member.ends;
        let length = (frame.nodes()[b] - frame.nodes()[a]).norm();
        let weight = Vector::new(0.0, 0.0, -9.80665) * (1240.0 * rod.section.area_m2 * length);
        force += weight;
        moment += ((place(a) + place(b)) * 0.5).cross(&weight);
    }
    for (support, reaction) in supports.iter().zip(&path.reactions) {
        let by = Vector::from_column_slice(&reaction[..3]);
        force += by;
        moment += place(support.node).cross(&by) + Vector::from_column_slice(&reaction[3..]);
    }
    assert!(force.norm() < 1e-8, "{force}");
    assert!(moment.norm() < 1e-9, "{moment}");
}

/// A generated frame of 150 struts with two parts each, under its weight and a push: a light one
/// costs a few factorisations. The time is printed.
#[test]
fn a_frame_of_150_struts() {
    let side = 5usize;
    let node = |i: usize, j: usize, k: usize| (k * side + j) * side + i;
    let mut random = 12345u64;
    let mut shake = || {
        random =
            random.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        ((random >> 40) as f64 / 16_777_216.0 - 0.5) * 4e-3
    };
    let (mut nodes, mut members) = (Vec::new(), Vec::new());
    for k in 0..4 {
        for j in 0..side {
            for i in 0..side {
                nodes.push(Point::new(
                    0.015 * i as f64 + shake(),
                    0.015 * j as f64 + shake(),
                    0.015 * k as f64 + if k > 0 { shake() } else { 0.0 },
                ));
                let mut add = |other: usize| {
                    members.push(Member {
                        density_kg_m3: 1240.0,
                        elastic: Elastic::isotropic(2.4e9, 0.35),
                        ..member([other, node(i, j, k)], Section::circle(1.5e-3), 1.0)
                    });
                };
                if k > 0 {
                    add(node(i, j, k - 1));
                    if i > 0 {
                        add(node(i - 1, j, k));
                    }
                    if j > 0 && (i + j) % 2 == 0 {
                        add(node(i, j - 1, k));
                    }
                }
            }
        }
    }
    members.truncate(150);
    let used = members.iter().flat_map(|m| m.ends).max().unwrap() + 1;
    nodes.truncate(used);
    let frame = subdivided(&Frame::new(nodes, members).unwrap(), 2);
    let supports: Vec<Support> = (0..side * side).map(Support::clamped).collect();
    let mut load = pushed(used - 1, [5.0, 3.0, -20.0, 0.0, 0.0, 0.0]);
    load.gravity_m_s2 = [0.0, 0.0, -9.80665];
    for (push, iterations) in [(0.1, 4), (1.0, 100)] {
        load.at_nodes[0].load = [5.0 * push, 3.0 * push, -20.0 * push, 0.0, 0.0, 0.0];
        let start = std::time::Instant::now();
        let path = path(&frame, &supports, &load, &Options::default());
        let took = start.elapsed();
        let moved = path.displacement.iter().map(|six| Vector::new(six[0], six[1], six[2]).norm());
        eprintln!(
            "{} members, push {push}: {} points, {} iterations, {took:?}, moved {:e}, residual {:e}",
            frame.members().len(),
            path.points.len(),
            path.iterations,
            moved.fold(0.0, f64::max),
            path.residual,
        );
        assert!(path.iterations <= iterations);
    }
}
