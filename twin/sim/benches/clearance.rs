//! Clearance of one posture (KR 6 with the small hot end) to a lattice of 900 strands: by the tree,
//! and beside it every pair.
//!
//! The lattice has struts of 20 to 52 mm, printed from the ground up; the postures print a strand each
//! with all before it standing.

// criterion_group! makes a public function without documentation.
#![allow(missing_docs)]

use std::collections::BTreeMap;
use std::fs::read_to_string;
use std::hint::black_box;

use criterion::{Criterion, criterion_group, criterion_main};
use sim::cell::{Job, Parts, resolve};
use sim::clearance::{Beads, Bodies, Body};
use sim::deposit::{Deposit, Printed};
use sim::kinematics::IkOptions;
use sim::pose::{Point, Pose, from_xyz_rpy};
use slam::Source;

const N_STRANDS: usize = 900;
/// Radius of a bead, m.
const BEAD_M: f64 = 0.65e-3;

fn file(path: &str) -> Source {
    let path = format!("{}/../../{path}", env!("CARGO_MANIFEST_DIR"));
    let text = read_to_string(&path).unwrap_or_else(|error| panic!("{path}: {error}"));
    Source::new(path, text)
}

fn job() -> Job {
    let text = r#"{ "slam": 1, "name": "bench", "cell": "kr6-hot-end", "material": "pla",
        "strands": [{ "id": "a", "points_mm": [[0, 0, 0], [9, 0, 0]] }] }"#;
    let (document, _) = slam::job::parse(&Source::new("job", text)).expect("a sound job");
    let robot = "kuka/kr6_r900_sixx";
    let cell = slam::cell_file::parse(&file("robots/cells/kr6-hot-end.toml")).expect("a cell");
    let parts = Parts {
        robot: Some(
            &slam::robot_file::parse(&file(&format!("robots/{robot}/robot.toml"))).expect("data"),
        ),
        urdf: &slam::urdf::parse(&file(&format!("robots/{robot}/robot.urdf"))).expect("an arm"),
        link_meshes: &BTreeMap::new(),
        tool: &slam::tool_file::parse(&file("robots/tools/small-hot-end.toml")).expect("a tool"),
        material: &slam::material_file::parse(&file("materials/pla.toml")).expect("a material"),
        form_meshes: &[],
        cell: &cell,
    };
    resolve(&document, &parts).unwrap_or_else(|problems| panic!("{problems:?}"))
}

/// Struts between the nodes of a lattice that leans a little, layer by layer: uprights, two
/// diagonals to a node, then the beams of the next layer.
fn lattice() -> Vec<[Point; 2]> {
    let n = 7;
    let node = |i: usize, j: usize, k: usize| {
        let (x, y, z) = (i as f64, j as f64, k as f64);
        let lean = 2.0 * (x * 1.3 + y * 0.7 + z).sin();
        Point::new(34.0 * x - 102.0 + lean, 34.0 * y - 102.0 - lean, 28.0 * z + 0.5 * lean) / 1e3
    };
    let mut struts = Vec::new();
    for k in 0.. {
        for i in 0..n {
            for j in 0..n {
                struts.push([node(i, j, k), node(i, j, k + 1)]);
                if i + 1 < n {
                    struts.push([node(i + 1, j, k), node(i, j, k + 1)]);
                }
            }
        }
        for i in 0..n {
            for j in 0..n {
                if i + 1 < n {
                    struts.push([node(i, j, k + 1), node(i + 1, j, k + 1)]);
                }
                if j + 1 < n {
                    struts.push([node(i, j, k + 1), node(i, j + 1, k + 1)]);
                }
            }
        }
        if struts.len() >= N_STRANDS {
            struts.truncate(N_STRANDS);
            return struts;
        }
    }
    unreachable!()
}

fn deposit(struts: &[[Point; 2]]) -> Deposit {
    let printed = |(strand, ends): (usize, &[Point; 2])| Printed {
        strand,
        as_planned: ends.to_vec(),
        as_printed: ends.to_vec(),
        at_m: vec![0.0, (ends[1] - ends[0]).norm()],
        radius_m: BEAD_M,
        born_s: 0.0,
        done_s: 1.0,
    };
    Deposit::new(struts.iter().enumerate().map(printed).collect())
}

/// Postures with the orifice on a late strand and the nozzle down, with the strands that then stand.
fn postures(job: &Job, struts: &[[Point; 2]]) -> Vec<(Vec<f64>, usize)> {
    let mut out = Vec::new();
    let mut found = Vec::new();
    for strand in (N_STRANDS - 200..N_STRANDS).step_by(4) {
        let [a, b] = struts[strand];
        let at = a + (b - a) * 0.1;
        let part_from_tool =
            from_xyz_rpy([at.x, at.y, at.z + BEAD_M], [std::f64::consts::PI, 0.0, 0.3]);
        let world_from_tip = job.cell.world_from_tip(&(job.bed_from_part * part_from_tool));
        let options = IkOptions { seed: None, elbow_rad: 0.0 };
        job.cell.robot.arm.inverse(&world_from_tip, &options, &mut out);
        if let Some(solution) = out.first() {
            found.push((solution.q.to_vec(), strand));
        }
    }
    assert!(found.len() > 20, "{} postures", found.len());
    found
}

/// Every solid of every body against every bead in full, nothing known of the others.
fn all_pairs(placed: &[(&Body, Pose)], deposit: &Deposit, n_segments: usize) -> f64 {
    let mut least_m = f64::INFINITY;
    for segment in &deposit.segments[..n_segments] {
        for (body, pose) in placed {
            let clearance_m = body.to_bead(pose, &segment.ends, segment.radius_m, f64::INFINITY);
            least_m = least_m.min(clearance_m);
        }
    }
    least_m
}

/// The same, each pair left out by its bounding spheres where they are further than the best.
fn all_pairs_by_spheres(placed: &[(&Body, Pose)], deposit: &Deposit, n_segments: usize) -> f64 {
    let mut least_m = f64::INFINITY;
    for segment in &deposit.segments[..n_segments] {
        for (body, pose) in placed {
            let clearance_m = body.to_bead(pose, &segment.ends, segment.radius_m, least_m);
            least_m = least_m.min(clearance_m);
        }
    }
    least_m
}

fn clearance(criterion: &mut Criterion) {
    let job = job();
    let struts = lattice();
    let deposit = deposit(&struts);
    let (bodies, beads) = (Bodies::new(&job), Beads::new(&deposit));
    let postures = postures(&job, &struts);
    let placed: Vec<(Vec<(&Body, Pose)>, usize)> =
        postures.iter().map(|(q, n)| (bodies.in_part(&job, q), *n)).collect();
    for (placed, n) in &placed {
        let found = beads.nearest_of(placed, *n, f64::INFINITY).expect("strands stand");
        let wanted_m = all_pairs(placed, &deposit, *n);
        assert!((found.clearance_m - wanted_m).abs() < 3e-9, "{found:?} for {wanted_m}");
    }
    let mut group = criterion.benchmark_group(format!("{} postures, 900 strands", placed.len()));
    group.sample_size(20);
    group.bench_function("nearest bead, poses given", |bencher| {
        bencher.iter(|| {
            let least = |(placed, n): &(Vec<_>, usize)| {
                beads
                    .nearest_of(black_box(placed), *n, f64::INFINITY)
                    .map_or(0.0, |n| n.clearance_m)
            };
            placed.iter().map(least).sum::<f64>()
        });
    });
    group.bench_function("nearest bead, from joint values", |bencher| {
        bencher.iter(|| {
            let least = |(q, n): &(Vec<f64>, usize)| {
                let placed = bodies.in_part(&job, black_box(q));
                beads.nearest_of(&placed, *n, f64::INFINITY).map_or(0.0, |n| n.clearance_m)
            };
            postures.iter().map(least).sum::<f64>()
        });
    });
    group.bench_function("nearest bead within 2 mm", |bencher| {
        bencher.iter(|| {
            let near = |(placed, n): &(Vec<_>, usize)| beads.nearest_of(placed, *n, 2e-3).is_some();
            placed.iter().filter(|posture| near(posture)).count()
        });
    });
    group.sample_size(10);
    group.bench_function("all pairs, spheres first", |bencher| {
        bencher.iter(|| {
            let least = |(placed, n): &(Vec<_>, usize)| all_pairs_by_spheres(placed, &deposit, *n);
            placed.iter().map(least).sum::<f64>()
        });
    });
    group.bench_function("all pairs", |bencher| {
        bencher.iter(|| {
            let least = |(placed, n): &(Vec<_>, usize)| all_pairs(placed, &deposit, *n);
            placed.iter().map(least).sum::<f64>()
        });
    });
    group.bench_function("build the tree", |bencher| bencher.iter(|| Beads::new(&deposit)));
    group.finish();
}

criterion_group!(benches, clearance);
criterion_main!(benches);
