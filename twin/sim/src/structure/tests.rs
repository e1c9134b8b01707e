//! Closed forms, frames solved by other programs, and what must not change.

#![allow(clippy::unwrap_used, clippy::print_stderr)]

mod brute_force;
mod buckles;
mod bundles;
mod changes;
mod closed_forms;
mod collapse;
mod domains;
mod equilibrium;
pub(super) mod grows;
mod lets_go;
mod one_sided;
mod peers;
mod releases;
mod rides;
mod rides_balance;
mod rides_closed;
mod sequence;
mod slender_beams;
mod sound;
mod trials;
mod wireframes;
mod yields;

use super::{Elastic, Frame, Load, Member, NodeLoad, Section, Support};
use crate::pose::{Point, Vector};

/// A member that differs from others only where a test says so.
fn member(ends: [usize; 2], section: Section, elastic: Elastic) -> Member {
    Member {
        ends,
        section,
        elastic,
        density_kg_m3: 0.0,
        initial_strain: 0.0,
        side: Vector::zeros(),
        strand: 0,
    }
}

/// PLA-like, 2 mm.
fn rod(ends: [usize; 2]) -> Member {
    Member {
        density_kg_m3: 1240.0,
        ..member(ends, Section::circle(2e-3), Elastic::isotropic(3.5e9, 0.36))
    }
}

/// A straight chain of equal rods from the origin.
fn chain(direction: Vector, length_m: f64, count: usize) -> Frame {
    let step = direction.normalize() * (length_m / count as f64);
    let nodes = (0..=count).map(|k| Point::from(step * k as f64)).collect();
    Frame::new(nodes, (0..count).map(|k| rod([k, k + 1])).collect()).unwrap()
}

fn pushed(node: usize, load: [f64; 6]) -> Load {
    Load { at_nodes: vec![NodeLoad { node, load }], ..Load::default() }
}

fn falling(gravity_m_s2: [f64; 3]) -> Load {
    Load { gravity_m_s2, ..Load::default() }
}

fn clamped(nodes: impl IntoIterator<Item = usize>) -> Vec<Support> {
    nodes.into_iter().map(Support::clamped).collect()
}

#[track_caller]
fn near(got: f64, wanted: f64, relative: f64) {
    assert!((got - wanted).abs() <= relative * wanted.abs(), "{got:e} is not {wanted:e}");
}

/// Largest difference over the largest wanted number, translations (or forces) and turns (or
/// moments) each as a block of their own; triples alternate between the two.
fn block_gap(got: &[f64], wanted: &[f64]) -> f64 {
    rounded_gap(got, wanted, 0.0)
}

/// [`block_gap`] where the wanted numbers were written with a last digit of `unit`: what half of it
/// explains is no gap.
fn rounded_gap(got: &[f64], wanted: &[f64], unit: f64) -> f64 {
    assert_eq!(got.len(), wanted.len());
    let of_kind = |kind: usize| {
        let pick = |values: &[f64]| -> Vec<f64> {
            (0..values.len()).filter(|at| (at / 3) % 2 == kind).map(|at| values[at]).collect()
        };
        let (got, wanted) = (pick(got), pick(wanted));
        let size = wanted.iter().fold(0.0f64, |most, value| most.max(value.abs()));
        let gap = got.iter().zip(&wanted).fold(0.0f64, |most, (a, b)| most.max((a - b).abs()));
        let gap = (gap - 0.501 * unit).max(0.0);
        if size > 0.0 { gap / size } else { gap }
    };
    of_kind(0).max(of_kind(1))
}
