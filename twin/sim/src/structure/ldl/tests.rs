//! The block factor against dense matrices.

#![allow(clippy::unwrap_used)]

use nalgebra::{DMatrix, DVector};

use super::*;
use crate::pose::Point;
use crate::structure::assembly::PIVOT_RATIO;
use crate::structure::beam::{Beam, beams};
use crate::structure::tests::grows::{Chance, grown};
use crate::structure::{Frame, Support};

/// K of some members with a factor each; what is not free has 1 on the diagonal.
fn dense(frame: &Frame, beams: &[Beam], factors: &[f64], free: &[[bool; 6]]) -> DMatrix<f64> {
    let free = free.concat();
    let mut k = DMatrix::zeros(free.len(), free.len());
    for ((member, beam), factor) in frame.members().iter().zip(beams).zip(factors) {
        let freedom = |row: usize| 6 * member.ends[row / 6] + row % 6;
        for row in 0..12 {
            for column in 0..12 {
                if free[freedom(row)] && free[freedom(column)] {
                    k[(freedom(row), freedom(column))] += factor * beam.stiffness[(row, column)];
                }
            }
        }
    }
    for (at, _) in free.iter().enumerate().filter(|(_, free)| !**free) {
        k[(at, at)] = 1.0;
    }
    k
}

/// `‖K x - f‖/‖f‖` of a random right side.
fn residual(factor: &Factor, k: &DMatrix<f64>, free: &[[bool; 6]], chance: &mut Chance) -> f64 {
    let free = free.concat();
    let f: Vec<f64> =
        free.iter().map(|&free| if free { chance.next() - 0.5 } else { 0.0 }).collect();
    let mut x: Vec<Pair> = f.iter().map(|&f| [f, 2.0 * f]).collect();
    factor.solve(&mut x);
    let (one, two): (Vec<f64>, Vec<f64>) = x.iter().map(|pair| (pair[0], pair[1])).unzip();
    let f = DVector::from_vec(f);
    let gap = |x: Vec<f64>, times: f64| (k * DVector::from_vec(x) / times - &f).norm() / f.norm();
    gap(one, 1.0).max(gap(two, 2.0))
}

fn symbolic(frame: &Frame, supports: &[Support]) -> Symbolic {
    let mut keep = vec![true; frame.nodes().len()];
    supports.iter().for_each(|support| keep[support.node] = false);
    let pairs: Vec<[usize; 2]> = frame.members().iter().map(|member| member.ends).collect();
    Symbolic::new(frame.nodes(), &keep, &pairs)
}

fn part<'a>(frame: &Frame, beams: &'a [Beam], member: usize, factor: f64) -> Part<'a> {
    Part { ends: frame.members()[member].ends, stiffness: &beams[member].stiffness, factor }
}

/// Every pattern holds what elimination fills: the blocks of a dense factorisation outside it are 0.
#[test]
fn nothing_is_filled_outside_the_pattern() {
    for (members, seed) in [(60, 1), (150, 2), (330, 3)] {
        let (frame, supports) = grown(members, seed);
        let symbolic = symbolic(&frame, &supports);
        let n = symbolic.len();
        let mut seen = symbolic.node.clone();
        seen.sort_unstable();
        seen.dedup();
        assert_eq!(seen.len(), frame.nodes().len() - supports.len(), "every node that moves, once");
        let mut filled = vec![vec![false; n]; n];
        let place = |node: usize| symbolic.node.iter().position(|&other| other == node);
        for member in frame.members() {
            if let [Some(a), Some(b)] = member.ends.map(place) {
                filled[a.min(b)][a.max(b)] = true;
            }
        }
        for j in 0..n {
            let below: Vec<usize> = (j + 1..n).filter(|&b| filled[j][b]).collect();
            for &a in &below {
                below.iter().filter(|&&b| b > a).for_each(|&b| filled[a][b] = true);
            }
            assert_eq!(symbolic.below(j), below);
        }
    }
}

#[test]
fn a_fresh_factor_solves() {
    let mut chance = Chance(4);
    for (members, seed) in [(1, 5), (40, 6), (200, 7)] {
        let (frame, supports) = grown(members, seed);
        let beams = beams(&frame);
        let mut free = vec![[true; 6]; frame.nodes().len()];
        supports.iter().for_each(|support| free[support.node] = [false; 6]);
        // one more held in part
        free[frame.nodes().len() - 1] = [true, false, true, true, false, true];
        let factors: Vec<f64> = (0..members).map(|_| 0.5 + chance.next()).collect();
        let mut factor = Factor::new(symbolic(&frame, &supports), PIVOT_RATIO);
        let parts = (0..members).map(|member| part(&frame, &beams, member, factors[member]));
        factor.refactor(parts, &free).unwrap();
        let k = dense(&frame, &beams, &factors, &free);
        let gap = residual(&factor, &k, &free, &mut chance);
        assert!(gap < 1e-11, "{members}: {gap:e}");
    }
}

/// Order of elimination of a grid: a separator cuts it in two.
#[test]
fn dissection_beats_the_order_of_a_band() {
    let side = 24;
    let points: Vec<Point> = (0..side * side)
        .map(|at| Point::new((at % side) as f64, (at / side) as f64, 0.0))
        .collect();
    let mut pairs = Vec::new();
    for at in 0..side * side {
        if at % side + 1 < side {
            pairs.push([at, at + 1]);
        }
        if at / side + 1 < side {
            pairs.push([at, at + side]);
        }
    }
    let symbolic = Symbolic::new(&points, &vec![true; side * side], &pairs);
    // a band of 24 fills 24 n; minimum degree and dissection of a grid 31/4 n log2 n at worst (George)
    assert!(symbolic.blocks() < side * side * side / 2, "{}", symbolic.blocks());
}

/// A node that comes, gets members, loses them and goes leaves the factor as it was.
#[test]
fn a_node_comes_and_goes() {
    let (frame, supports) = grown(90, 8);
    let beams = beams(&frame);
    let last = frame.nodes().len() - 1;
    let at_last: Vec<usize> =
        (0..90).filter(|&member| frame.members()[member].ends.contains(&last)).collect();
    let mut free = vec![[true; 6]; frame.nodes().len()];
    supports.iter().for_each(|support| free[support.node] = [false; 6]);
    free[last] = [false; 6];
    let mut factors = vec![1.0; 90];
    at_last.iter().for_each(|&member| factors[member] = 0.0);
    let mut factor = Factor::new(symbolic(&frame, &supports), PIVOT_RATIO);
    let here = (0..90).filter(|member| !at_last.contains(member));
    factor.refactor(here.map(|member| part(&frame, &beams, member, 1.0)), &free).unwrap();
    let before = dense(&frame, &beams, &factors, &free);
    let mut chance = Chance(9);
    factor.bear(last);
    at_last.iter().for_each(|&m| factor.change(&part(&frame, &beams, m, 1.0)).unwrap());
    let all = vec![1.0; 90];
    free[last] = [true; 6];
    let after = dense(&frame, &beams, &all, &free);
    assert!(residual(&factor, &after, &free, &mut chance) < 1e-11);
    for (left, &member) in at_last.iter().enumerate().rev() {
        if left == 0 {
            factor.bury(last);
        }
        factor.change(&part(&frame, &beams, member, -1.0)).unwrap();
    }
    free[last] = [false; 6];
    let gap = residual(&factor, &before, &free, &mut chance);
    assert!(gap < 1e-10, "{gap:e}");
}
