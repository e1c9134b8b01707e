//! A print, stage by stage: one factor updated strut by strut, beside the naive way of a dense
//! Cholesky from nothing at every stage, and beside faer's sparse factorisation at every strut with
//! one order and one symbolic part for all of them.
//!
//! The frames are made here: lattice towers with as many members and nodes as the bunny (384/130)
//! and the duck (909/305) of the literature, printed from the ground up; and points at random in a
//! cube, each tied to the three nearest below it.

#![allow(missing_docs)]

use std::hint::black_box;

use criterion::{BenchmarkId, Criterion, criterion_group, criterion_main};
use faer::dyn_stack::{MemBuffer, MemStack};
use faer::sparse::linalg::SupernodalThreshold;
use faer::sparse::linalg::cholesky::{
    CholeskySymbolicParams, SymmetricOrdering, factorize_symbolic_cholesky,
};
use faer::sparse::{SparseColMat, Triplet};
use faer::{Conj, Mat, Par, Side};
use nalgebra::{DMatrix, DVector};
use sim::pose::{Point, Vector};
use sim::structure::{
    Ask, Elastic, Frame, Member, Section, Stage, Strength, Support, solve_stages,
};

const DOWN: [f64; 3] = [0.0, 0.0, -9.80665];

/// Rings of seven nodes; each ring hangs on the one below by uprights, diagonals and itself.
fn tower(node_count: usize, member_count: usize) -> Frame {
    let ring = 7;
    let nodes = (0..node_count)
        .map(|node| {
            let angle = std::f64::consts::TAU * (node % ring) as f64 / ring as f64;
            let radius_m = 0.05 + 0.01 * ((node / ring) as f64 * 0.7).sin();
            let height_m = 0.02 * (node / ring) as f64 + 0.001 * (node % ring) as f64;
            Point::new(radius_m * angle.cos(), radius_m * angle.sin(), height_m)
        })
        .collect();
    let mut members = Vec::new();
    for node in ring..node_count {
        let below = node - ring;
        let diagonal = below - below % ring + (below + 1) % ring;
        let mut ends = vec![below, diagonal];
        if node % ring > 0 {
            ends.push(node - 1);
        }
        if members.len() + ends.len() + 2 * (node_count - 1 - node) < member_count {
            ends.push(below - below % ring + (below + 3) % ring);
        }
        members.extend(ends.into_iter().map(|below| member([below, node])));
    }
    members.truncate(member_count);
    Frame::new(nodes, members).expect("the tower is made of sound members")
}

fn member(ends: [usize; 2]) -> Member {
    Member {
        ends,
        section: Section::circle(3e-3),
        elastic: Elastic::isotropic(3.5e9, 0.36),
        density_kg_m3: 1240.0,
        initial_strain: 0.0,
        side: Vector::zeros(),
        strand: 0,
    }
}

/// Random points in a cube with some 20 mm between them, the lowest clamped (their number comes with
/// the frame), each of the others tied to the three nearest below it.
fn grown(member_count: usize) -> (Frame, usize) {
    let (risen, ground) = (member_count.div_ceil(3), (member_count / 40).max(4));
    let side_m = 0.02 * ((risen + ground) as f64).cbrt();
    let mut seed = 7u64;
    let mut chance = move || {
        seed = seed.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        side_m * (seed >> 11) as f64 / (1u64 << 53) as f64
    };
    let mut nodes: Vec<Point> =
        (0..risen + ground).map(|_| Point::new(chance(), chance(), chance())).collect();
    nodes.sort_by(|a, b| a.z.total_cmp(&b.z));
    let mut members = Vec::new();
    for node in ground..nodes.len() {
        let mut below: Vec<usize> = (0..node).collect();
        let far = |other: usize| (nodes[other] - nodes[node]).norm();
        below.sort_by(|&a, &b| far(a).total_cmp(&far(b)));
        let left = member_count - members.len();
        members.extend(below.into_iter().take(left.min(3)).map(|other| member([other, node])));
    }
    (Frame::new(nodes, members).expect("random points are apart"), ground)
}

fn stages(frame: &Frame, ground: usize) -> Vec<Stage> {
    let stage = |born| Stage {
        born,
        supports: (0..ground).map(Support::clamped).collect(),
        gravity_m_s2: DOWN,
        at_nodes: Vec::new(),
        ..Stage::default()
    };
    (1..=frame.members().len()).map(stage).collect()
}

/// Euler-Bernoulli by triple product, dense assembly of the born nodes, dense Cholesky.
fn naive(frame: &Frame) -> f64 {
    let mut most_m = 0.0f64;
    for born in 1..=frame.members().len() {
        let members = &frame.members()[..born];
        let mut place = vec![usize::MAX; frame.nodes().len()];
        let mut count = 0;
        for node in members.iter().flat_map(|member| member.ends) {
            if node >= 7 && place[node] == usize::MAX {
                place[node] = count;
                count += 1;
            }
        }
        let mut k = DMatrix::zeros(6 * count, 6 * count);
        let mut f = DVector::zeros(6 * count);
        for member in members {
            add(frame, member, &place, &mut k, &mut f);
        }
        let Some(factor) = k.cholesky() else { continue };
        let u = factor.solve(&f);
        for node in 0..count {
            most_m = most_m.max(u.fixed_rows::<3>(6 * node).norm());
        }
    }
    most_m
}

fn add(
    frame: &Frame,
    member: &Member,
    place: &[usize],
    k: &mut DMatrix<f64>,
    f: &mut DVector<f64>,
) {
    let [from, to] = member.ends.map(|node| frame.nodes()[node]);
    let l = (to - from).norm();
    let x = (to - from) / l;
    let (e, g, s) = (member.elastic.e_pa, member.elastic.g_pa, member.section);
    let along = x * x.transpose();
    let across = nalgebra::Matrix3::identity() - along;
    let turn = x.cross_matrix();
    let (ea, gj, ei) = (e * s.area_m2 / l, g * s.j_m4 / l, e * s.iy_m4 / l);
    // closed form of the round beam in global axes: no member axes at all
    let shift = along * ea + across * (12.0 * ei / (l * l));
    let cross = turn * (-6.0 * ei / l);
    let blocks = [
        [shift, cross, -shift, cross],
        [-cross, along * gj + across * (4.0 * ei), cross, across * (2.0 * ei) - along * gj],
        [-shift, -cross, shift, -cross],
        [-cross, across * (2.0 * ei) - along * gj, cross, along * gj + across * (4.0 * ei)],
    ];
    let w = Vector::from(DOWN) * (member.density_kg_m3 * s.area_m2);
    let moment = x.cross(&w) * (l * l / 12.0);
    let loads = [w * (l / 2.0), moment, w * (l / 2.0), -moment];
    for row in 0..4 {
        let a = place[member.ends[row / 2]];
        if a == usize::MAX {
            continue;
        }
        let at = 6 * a + 3 * (row % 2);
        let mut part = f.fixed_rows_mut::<3>(at);
        part += loads[row];
        for column in 0..4 {
            let b = place[member.ends[column / 2]];
            if b != usize::MAX {
                let mut part = k.fixed_view_mut::<3, 3>(at, 6 * b + 3 * (column % 2));
                part += blocks[row][column];
            }
        }
    }
}

/// What faer takes to factor (supernodal, which is its fastest here at every size) and to solve for two right sides at every
/// `step`th strut on one core, unborn freedoms uncoupled; the numbers of K are added strut by strut, at no cost worth
/// naming.
fn refactored(frame: &Frame, ground: usize, step: usize) -> f64 {
    let n = 6 * (frame.nodes().len() - ground);
    let place = |node: usize| node.checked_sub(ground).map(|at| 6 * at);
    let entries = |each: &Member| -> Vec<Triplet<usize, usize, f64>> {
        let mut local = vec![usize::MAX; frame.nodes().len()];
        (local[each.ends[0]], local[each.ends[1]]) = (0, 1);
        let (mut k, mut f) = (DMatrix::zeros(12, 12), DVector::zeros(12));
        add(frame, each, &local, &mut k, &mut f);
        let freedom = |at: usize| place(each.ends[at / 6]).map(|start| start + at % 6);
        let all = (0..12).flat_map(|row| (0..12).map(move |column| (row, column)));
        all.filter_map(|(row, column)| Some((freedom(row)?, freedom(column)?, k[(row, column)])))
            .filter(|(row, column, _)| row >= column)
            .map(|(row, column, value)| Triplet::new(row, column, value))
            .collect()
    };
    let parts: Vec<_> = frame.members().iter().map(entries).collect();
    let mut all = parts.concat();
    all.extend((0..n).map(|at| Triplet::new(at, at, 0.0)));
    let mut k = SparseColMat::try_new_from_triplets(n, n, &all).expect("a pattern");
    let params = CholeskySymbolicParams {
        supernodal_flop_ratio_threshold: SupernodalThreshold::FORCE_SUPERNODAL,
        ..Default::default()
    };
    let order = SymmetricOrdering::Amd;
    let symbolic =
        factorize_symbolic_cholesky(k.symbolic(), Side::Lower, order, params).expect("memory");
    let request = symbolic.factorize_numeric_llt_scratch::<f64>(Par::Seq, Default::default());
    let mut memory =
        MemBuffer::new(request.or(symbolic.solve_in_place_scratch::<f64>(2, Par::Seq)));
    let mut values = vec![0.0; symbolic.len_val()];
    k.val_mut().fill(0.0);
    let position = |k: &SparseColMat<usize, f64>, row: usize, column: usize| {
        let rows = k.symbolic().row_idx_of_col_raw(column);
        k.symbolic().col_range(column).start + rows.binary_search(&row).expect("in the pattern")
    };
    for at in 0..n {
        let at = position(&k, at, at);
        k.val_mut()[at] = 1.0;
    }
    let mut born = vec![false; n];
    let mut sum = 0.0;
    for (at, part) in parts.iter().enumerate() {
        for entry in part {
            let to = position(&k, entry.row, entry.col);
            let first = entry.row == entry.col && !std::mem::replace(&mut born[entry.row], true);
            k.val_mut()[to] += entry.val - if first { 1.0 } else { 0.0 };
        }
        if at % step == 0 {
            let factor = symbolic.factorize_numeric_llt(
                &mut values,
                k.as_ref(),
                Side::Lower,
                Default::default(),
                Par::Seq,
                MemStack::new(&mut memory),
                Default::default(),
            );
            let mut x = Mat::<f64>::full(n, 2, 1.0);
            factor.expect("no stage floats").solve_in_place_with_conj(
                Conj::No,
                x.as_mut(),
                Par::Seq,
                MemStack::new(&mut memory),
            );
            sum += x[(0, 0)];
        }
    }
    sum
}

fn most_one_shot(frame: &Frame, stages: &[Stage], ask: Ask) -> f64 {
    let records = solve_stages(frame, stages, ask).expect("the tower stands");
    let state = |record: &sim::structure::StageRecord| {
        record.one_shot.as_ref().map_or(0.0, |state| state.max_translation_m)
    };
    records.iter().map(state).fold(0.0, f64::max)
}

fn bench(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("stages");
    group.sample_size(10);
    for (nodes, members) in [(130, 384), (305, 909)] {
        let frame = tower(nodes, members);
        assert_eq!(frame.members().len(), members);
        let stages = stages(&frame, 7);
        let strength = Strength { tension_pa: 4e7, compression_pa: 6e7 };
        let strengths = vec![strength; members];
        let one_shot = Ask::default();
        let all = Ask { staged: true, strengths: &strengths, ..Ask::default() };
        if nodes < 200 {
            let (ours, theirs) = (most_one_shot(&frame, &stages, one_shot), naive(&frame));
            assert!((ours / theirs - 1.0).abs() < 1e-6, "{ours} {theirs}: not the same answer");
            group.bench_function(BenchmarkId::new("naive dense", members), |bencher| {
                bencher.iter(|| naive(black_box(&frame)));
            });
        }
        for (name, ask) in [("one-shot", one_shot), ("one-shot, staged, strength", all)] {
            group.bench_function(BenchmarkId::new(name, members), |bencher| {
                bencher.iter(|| most_one_shot(black_box(&frame), black_box(&stages), ask));
            });
        }
    }
    group.finish();
}

/// The same print by updates and by factoring; at 2500 the latter at every tenth strut only.
fn bench_growth(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("growth");
    group.sample_size(10);
    for (members, step) in [(400, 1), (900, 1), (2500, 10)] {
        let (frame, ground) = grown(members);
        let stages = stages(&frame, ground);
        let ask = Ask { staged: true, ..Ask::default() };
        group.bench_function(BenchmarkId::new("one-shot, staged", members), |bencher| {
            bencher.iter(|| most_one_shot(black_box(&frame), black_box(&stages), ask));
        });
        let name = format!("refactored at 1 strut of {step}");
        group.bench_function(BenchmarkId::new(name, members), |bencher| {
            bencher.iter(|| refactored(black_box(&frame), ground, step));
        });
    }
    let (frame, ground) = grown(5000);
    let stages = stages(&frame, ground);
    let ask = Ask { staged: true, ..Ask::default() };
    group.bench_function(BenchmarkId::new("one-shot, staged", 5000), |bencher| {
        bencher.iter(|| most_one_shot(black_box(&frame), black_box(&stages), ask));
    });
    group.finish();
}

criterion_group!(benches, bench, bench_growth);
criterion_main!(benches);
