//! The walk: no critical point is stepped over, no input breaks it, and what it finds agrees with
//! linear buckling.

use std::path::PathBuf;

use proptest::prelude::*;
use serde_json::Value;

use super::*;
use crate::structure::{SolveError, solve};

/// However flat the arch and however large the load against its limit, the limit is found.
#[test]
fn flat_arches_are_not_stepped_over() {
    for rise in [0.003f64, 0.01, 0.03, 0.1, 0.3] {
        // stiff enough not to bow
        let kind = section(1.0, 0.1 * rise * rise, 0.1);
        let frame = legs(&[[-1.0, 0.0], [0.0, rise]], kind, 1.0, 1);
        let supports = in_plane(&frame, &[(0, [true, true, false]), (1, [true, false, false])]);
        let c0 = 1.0 / 1f64.hypot(rise);
        let wanted = (1.0 - c0.powf(2.0 / 3.0)).powf(1.5);
        for times in [1.001, 1.1, 1.5, 2.0, 3.0, 5.0, 10.0, 20.0, 50.0, 100.0, 300.0] {
            let load = pushed(1, [0.0, -wanted * times, 0.0, 0.0, 0.0, 0.0]);
            // what is left out of balance counts against N, which is P over the slope
            let options = Options { tolerance: 1e-12, ..Options::default() };
            let path = nonlinear(&frame, &supports, &load, &[], &options).unwrap();
            let Outcome::LimitPoint { factor } = path.outcome else {
                panic!("rise {rise}, {times} times the limit: {:?}", path.outcome)
            };
            near(factor * times, 1.0, 1e-8);
        }
        let load = pushed(1, [0.0, -wanted * 0.999, 0.0, 0.0, 0.0, 0.0]);
        path(&frame, &supports, &load, &Options::default());
    }
}

/// Cut in steps of another size, the path ends in the same place.
#[test]
fn steps_do_not_matter() {
    let nodes = vec![Point::origin(), Point::new(1.0, 0.3, 0.2), Point::new(1.2, 1.0, -0.3)];
    let kind = section(400.0, 1.0, 1.5);
    let members = vec![member([0, 1], kind, 1.0), member([1, 2], kind, 1.0)];
    let frame = subdivided(&Frame::new(nodes, members).unwrap(), 4);
    let mut load = pushed(2, [0.4, -0.7, 1.1, 0.2, -0.1, 0.3]);
    load.gravity_m_s2 = [0.0, 0.0, -1.0];
    let ends = [0.02, 0.1, 0.3].map(|step_turn_rad| {
        let options = Options { step_turn_rad, tolerance: 1e-12, ..Options::default() };
        let path = nonlinear(&frame, &[Support::clamped(0)], &load, &[], &options).unwrap();
        assert_eq!(path.outcome, Outcome::Converged);
        path.displacement[2]
    });
    assert!(Vector::new(ends[0][0], ends[0][1], ends[0][2]).norm() > 0.4);
    for end in &ends[1..] {
        for (a, b) in end.iter().zip(ends[0]) {
            assert!((a - b).abs() < 1e-9, "{a} {b}");
        }
    }
}

/// Frame, loads and supports turned as a whole: the answer turns with them.
#[test]
fn a_turned_frame_gives_turned_forces() {
    let turn = nalgebra::Rotation3::from_scaled_axis(Vector::new(0.7, -1.1, 2.0));
    let answer = |turn: &nalgebra::Rotation3<f64>| {
        let nodes = [[0.0, 0.0, 0.0], [1.0, 0.3, 0.2], [1.2, 1.0, -0.3]];
        let nodes = nodes.map(|x| Point::from(turn * Vector::from(x))).to_vec();
        let kind = Section { iy_m4: 0.5, ..section(400.0, 1.0, 1.5) };
        let one = |ends| Member {
            side: turn * Vector::new(0.1, 0.2, 1.0),
            density_kg_m3: 1e-3,
            initial_strain: 1e-3,
            ..member(ends, kind, 1.0)
        };
        let frame = subdivided(&Frame::new(nodes, vec![one([0, 1]), one([1, 2])]).unwrap(), 3);
        let (push, moment) =
            (turn * Vector::new(0.4, -0.7, 1.1), turn * Vector::new(0.2, 0.1, 0.3));
        let load = Load {
            gravity_m_s2: (turn * Vector::new(0.0, 0.0, -1.0)).into(),
            with_initial_strain: true,
            ..pushed(2, [push.x, push.y, push.z, moment.x, moment.y, moment.z])
        };
        let bow: Vec<[f64; 3]> = (0..frame.nodes().len())
            .map(|node| (turn * Vector::new(0.0, 0.01 * node as f64, 0.0)).into())
            .collect();
        let options = Options { tolerance: 1e-13, ..Options::default() };
        let path = nonlinear(&frame, &[Support::clamped(0)], &load, &bow, &options).unwrap();
        assert_eq!(path.outcome, Outcome::Converged);
        path
    };
    let (straight, turned) = (answer(&nalgebra::Rotation3::identity()), answer(&turn));
    let three = |six: &[f64], at: usize| Vector::new(six[at], six[at + 1], six[at + 2]);
    for (a, b) in straight.displacement.iter().zip(&turned.displacement) {
        assert!((turn * three(a, 0) - three(b, 0)).norm() < 1e-10);
        assert!((turn * three(a, 3) - three(b, 3)).norm() < 1e-10);
    }
    for (a, b) in straight.end_forces.iter().zip(&turned.end_forces) {
        for at in [0, 3, 6, 9] {
            assert!((turn * three(a, at) - three(b, at)).norm() < 1e-9);
        }
    }
    for (a, b) in straight.local_end_forces.iter().zip(&turned.local_end_forces) {
        for (a, b) in a.iter().zip(b) {
            assert!((a - b).abs() < 1e-9);
        }
    }
}

/// A frame of the shared data in m and N, its loads, and its linear buckling factors.
fn shared(name: &str) -> Option<(Frame, Vec<Support>, Load, Value)> {
    let root = std::env::var("TWIN_SHARED")
        .unwrap_or_else(|_| concat!(env!("CARGO_MANIFEST_DIR"), "/../../../shared").to_owned());
    let path = PathBuf::from(root).join(format!("data/frames/{name}.json"));
    let Ok(bytes) = std::fs::read(&path) else {
        eprintln!("skipped: {}", path.display());
        return None;
    };
    let file: Value = serde_json::from_slice(&bytes).ok()?;
    let list = |value: &Value| -> Vec<f64> {
        value.as_array().unwrap().iter().map(|x| x.as_f64().unwrap()).collect()
    };
    let nodes = file["nodes"].as_array()?.iter().map(|node| {
        let xyz = list(node);
        Point::new(xyz[0] * 1e-3, xyz[1] * 1e-3, xyz[2] * 1e-3)
    });
    let elastic = Elastic { e_pa: file["E"].as_f64()? * 1e6, g_pa: file["G"].as_f64()? * 1e6 };
    let members = file["members"].as_array()?.iter().zip(list(&file["radius"])).map(|(ends, r)| {
        let ends = list(ends);
        Member {
            elastic,
            density_kg_m3: file["density"].as_f64().unwrap() * 1e9,
            ..member([ends[0] as usize, ends[1] as usize], Section::circle(2e-3 * r), 1.0)
        }
    });
    let frame = Frame::new(nodes.collect(), members.collect()).unwrap();
    let supports = list(&file["fixed"]).into_iter().map(|node| Support::clamped(node as usize));
    let at_nodes = file["nodal_loads"].as_array()?.iter().map(|one| {
        let six = list(&one["load"]);
        let load = std::array::from_fn(|at| if at < 3 { six[at] } else { six[at] * 1e-3 });
        NodeLoad { node: one["node"].as_u64().unwrap() as usize, load }
    });
    let load = Load {
        gravity_m_s2: [0.0, 0.0, -9.80665],
        at_nodes: at_nodes.collect(),
        with_initial_strain: false,
    };
    Some((frame, supports.collect(), load, file["buckling"].clone()))
}

/// A strut of f150 bows as its load nears the linear buckling factor (two cubic elements a strut,
/// from another program): what it moves beyond the linear answer, over the load squared, grows as
/// `1/(1 - λ/λ_cr)` (Southwell). The frame survives it: others take over.
#[test]
fn f150_bows_at_its_linear_buckling_factor() {
    let Some((frame, supports, mut load, buckling)) = shared("f150") else { return };
    let frame = subdivided(&frame, 2);
    load.gravity_m_s2 = [0.0; 3];
    let linear = solve(&frame, &supports, &load).unwrap();
    let flexibility = [2.0, 3.0].map(|until| {
        let options = Options { until, ..Options::default() };
        let path = path(&frame, &supports, &load, &options);
        let beyond =
            path.displacement.iter().zip(&linear.displacement).map(|(far, near)| {
                Vector::from_fn(|axis, _| far[axis] - until * near[axis]).norm()
            });
        until * until / beyond.fold(0.0, f64::max)
    });
    let critical = 2.0 + flexibility[0] / (flexibility[0] - flexibility[1]);
    let wanted = buckling["nodal_loads_only_2_el_per_strut"][0].as_f64().unwrap();
    eprintln!("f150: {critical:.4} ({wanted:.4})");
    near(critical, wanted, 0.01);
}

#[test]
fn what_is_wrong_is_named() {
    let frame = legs(&[[0.0, 0.0], [1.0, 0.0], [1.0, 1.0]], section(1.0, 1.0, 1.0), 1.0, 1);
    let load = pushed(1, [0.0, 1.0, 0.0, 0.0, 0.0, 0.0]);
    let ask = |supports: &[Support], load: &Load, bow: &[[f64; 3]], options: &Options| {
        nonlinear(&frame, supports, load, bow, options).map(|path| path.outcome)
    };
    let held = [Support::clamped(0)];
    let usual = Options::default();
    assert_eq!(ask(&held, &load, &[], &usual), Ok(Outcome::Converged));
    assert_eq!(ask(&[], &load, &[], &usual), Err(SolveError::Floats { node: 0 }));
    let pin = [Support::pinned(0)];
    assert!(matches!(ask(&pin, &load, &[], &usual), Err(SolveError::Mechanism { .. })));
    let bow = [[0.0; 3]; 2];
    assert_eq!(ask(&held, &load, &bow, &usual), Err(SolveError::BadNode { node: 2 }));
    let shut = [[0.0; 3], [-1.0, 0.0, 0.0], [0.0; 3]];
    assert_eq!(ask(&held, &load, &shut, &usual), Err(SolveError::BadMember { member: 0 }));
    let watch = Options { watch: vec![3], ..Options::default() };
    assert_eq!(ask(&held, &load, &[], &watch), Err(SolveError::BadNode { node: 3 }));
    let none = Options { steps: 0, ..Options::default() };
    assert_eq!(ask(&held, &load, &[], &none), Ok(Outcome::NotConverged { factor: 0.0 }));
    assert_eq!(ask(&held, &Load::default(), &[], &usual), Ok(Outcome::Converged));
    let all = [0, 1, 2].map(Support::clamped);
    assert_eq!(ask(&all, &load, &[], &usual), Ok(Outcome::Converged));
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    /// Whatever the load, the bow and the options: an end, and finite numbers.
    #[test]
    fn every_load_comes_to_an_end(
        push in prop::array::uniform6(-1.0..1.0f64),
        scale in -6.0..6.0f64,
        bow in prop::array::uniform3(-0.3..0.3f64),
        strain in -0.9..2.0f64,
        until in prop::sample::select(vec![1.0, 0.0, -1.0, 1e300, f64::INFINITY, f64::NAN]),
        step_turn_rad in prop::sample::select(vec![0.1, 0.0, -1.0, 1e-300, 1e300, f64::NAN]),
        tolerance in prop::sample::select(vec![1e-9, 0.0, 1.0, f64::NAN]),
        past_critical in any::<bool>(),
    ) {
        let nodes = vec![Point::origin(), Point::new(1.0, 0.2, 0.1), Point::new(1.3, 1.0, 0.0)];
        let kind = section(100.0, 1.0, 1.5);
        let one = |ends| Member { initial_strain: strain, ..member(ends, kind, 1.0) };
        let frame = subdivided(&Frame::new(nodes, vec![one([0, 1]), one([1, 2])]).unwrap(), 2);
        let load = Load {
            with_initial_strain: true,
            ..pushed(2, push.map(|x| x * 10f64.powf(scale)))
        };
        let mut offsets = vec![[0.0; 3]; frame.nodes().len()];
        offsets[3] = bow;
        let options =
            Options { until, step_turn_rad, tolerance, steps: 30, past_critical, watch: vec![2] };
        let path = nonlinear(&frame, &[Support::clamped(0)], &load, &offsets, &options).unwrap();
        prop_assert!(path.factor.is_finite());
        prop_assert!(path.displacement.as_flattened().iter().all(|x| x.is_finite()));
        prop_assert!(path.end_forces.as_flattened().iter().all(|x| x.is_finite()));
        prop_assert!(path.points.len() <= 34);
    }
}
