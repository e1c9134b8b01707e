//! The element against differences and turning, the path against closed forms and print.

#![allow(clippy::unwrap_used, clippy::print_stderr)]

mod element;
mod far;
mod paths;
mod stable;

use super::{Options, Outcome, Path, nonlinear, subdivided};
use crate::pose::{Point, Vector};
use crate::structure::{Elastic, Frame, Load, Member, NodeLoad, Section, Support};

/// Equal about y and z, without shear.
fn section(area_m2: f64, i_m4: f64, j_m4: f64) -> Section {
    Section { area_m2, iy_m4: i_m4, iz_m4: i_m4, j_m4, shear_kappa: f64::INFINITY, fibre_m: 1.0 }
}

fn member(ends: [usize; 2], section: Section, e_pa: f64) -> Member {
    Member {
        ends,
        section,
        elastic: Elastic { e_pa, g_pa: 0.5 * e_pa },
        density_kg_m3: 0.0,
        initial_strain: 0.0,
        side: Vector::zeros(),
        strand: 0,
    }
}

/// Members of one kind along the corners, each leg cut into equal parts. Corners keep their numbers.
fn legs(corners: &[[f64; 2]], section: Section, e_pa: f64, parts: usize) -> Frame {
    let nodes = corners.iter().map(|[x, y]| Point::new(*x, *y, 0.0)).collect();
    let members = (1..corners.len()).map(|k| member([k - 1, k], section, e_pa)).collect();
    subdivided(&Frame::new(nodes, members).unwrap(), parts)
}

/// Node `part` of a leg, counted from its first corner.
fn along(corners: usize, parts: usize, leg: usize, part: usize) -> usize {
    if part == 0 {
        leg
    } else if part == parts {
        leg + 1
    } else {
        corners + leg * (parts - 1) + part - 1
    }
}

/// All nodes kept in the x-y plane, and the given freedoms (x, y, turn) held too.
fn in_plane(frame: &Frame, held: &[(usize, [bool; 3])]) -> Vec<Support> {
    let flat = |node| Support { node, fixed: [false, false, true, true, true, false] };
    let more = |&(node, [x, y, turn]): &(usize, [bool; 3])| Support {
        node,
        fixed: [x, y, false, false, false, turn],
    };
    (0..frame.nodes().len()).map(flat).chain(held.iter().map(more)).collect()
}

fn pushed(node: usize, load: [f64; 6]) -> Load {
    Load { at_nodes: vec![NodeLoad { node, load }], ..Load::default() }
}

/// The path of a sound frame, converged.
#[track_caller]
fn path(frame: &Frame, supports: &[Support], load: &Load, options: &Options) -> Path {
    let path = nonlinear(frame, supports, load, &[], options).unwrap();
    assert_eq!(path.outcome, Outcome::Converged, "{:?}", path.points.last());
    assert!(path.residual <= options.tolerance);
    path
}

#[track_caller]
fn limit(frame: &Frame, supports: &[Support], load: &Load, until: f64) -> (f64, Path) {
    let options = Options { until, ..Options::default() };
    let path = nonlinear(frame, supports, load, &[], &options).unwrap();
    let Outcome::LimitPoint { factor } = path.outcome else { panic!("{:?}", path.outcome) };
    (factor, path)
}

#[track_caller]
fn near(got: f64, wanted: f64, relative: f64) {
    assert!((got - wanted).abs() <= relative * wanted.abs(), "{got} is not {wanted}");
}
