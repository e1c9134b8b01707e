//! Buckling factors: columns and portals in closed form, frames of two other programs, brute force.

use std::f64::consts::PI;

use super::peers::{numbers, reference};
use super::*;
use crate::structure::{BucklingAsk, BucklingError, Mode, SolveError, buckling, slender, solve};

const DOWN: [f64; 3] = [0.0, 0.0, -9.80665];

pub(super) fn parts(parts: usize) -> BucklingAsk<'static> {
    BucklingAsk { parts, ..BucklingAsk::default() }
}

/// A strand of 1 m upright, its E I.
fn column() -> (Frame, f64) {
    let frame = chain(Vector::z(), 1.0, 1);
    let rod = frame.members()[0];
    (frame, rod.elastic.e_pa * rod.section.iy_m4)
}

/// Top of a column: held sideways, or in its turns, or both, or free; it may always sink.
fn top(sideways: bool, turns: bool) -> Support {
    Support { node: 1, fixed: [sideways, sideways, false, turns, turns, false] }
}

/// `P L²/(E I)` of a column of 1 m under 1 N on its top.
fn euler(ends: [Support; 2], count: usize) -> f64 {
    let (frame, ei) = column();
    let load = pushed(1, [0.0, 0.0, -1.0, 0.0, 0.0, 0.0]);
    let modes = buckling(&frame, &ends, &load, parts(count)).unwrap();
    modes[0].factor / ei
}

/// Turns about z are held so that a pinned column does not spin about itself.
fn pinned_foot() -> Support {
    Support { node: 0, fixed: [true, true, true, false, false, true] }
}

#[test]
fn b10_euler_columns() {
    let foot = Support::clamped(0);
    // printed for two and four parts
    near(euler([foot, top(true, true)], 2), 40.0, 1e-9);
    near(euler([foot, top(true, true)], 4), 39.78, 1e-3);
    near(euler([pinned_foot(), top(true, false)], 2), 9.943_8, 1e-4);
    // exact, K = 1, 0.5, 0.6992, 2
    let propped = 4.493_409_457_909_064f64.powi(2);
    for (name, ends, wanted) in [
        ("K=1", [pinned_foot(), top(true, false)], PI * PI),
        ("K=0.5", [foot, top(true, true)], 4.0 * PI * PI),
        ("K=0.6992", [foot, top(true, false)], propped),
        ("K=2", [foot, top(false, false)], PI * PI / 4.0),
    ] {
        let gaps = [4, 8, 16].map(|count| euler(ends, count) / wanted - 1.0);
        eprintln!("B10 {name}: {gaps:.6?} too high with 4, 8, 16 parts");
        // never too low, and of the fourth order
        assert!(gaps.iter().all(|gap| *gap > 0.0) && gaps[1] < 1e-3);
        assert!((12.0..20.0).contains(&(gaps[0] / gaps[1])));
        assert!((12.0..20.0).contains(&(gaps[1] / gaps[2])));
    }
    near((PI * PI / propped).sqrt(), 0.6992, 1e-4);
}

/// Engesser: shear gives way too, `1/P = 1/P_E + 1/(κ G A)`; a stocky column, pinned.
#[test]
fn shear_lowers_the_factor() {
    let (nodes, section) = (vec![Point::origin(), Point::new(0.0, 0.0, 1.0)], Section::circle(0.4));
    let rod = Member { section: section.sheared(0.9), ..rod([0, 1]) };
    let frame = Frame::new(nodes, vec![rod]).unwrap();
    let load = pushed(1, [0.0, 0.0, -1.0, 0.0, 0.0, 0.0]);
    let ends = [pinned_foot(), top(true, false)];
    let euler = PI * PI * rod.elastic.e_pa * section.iy_m4;
    let wanted = 1.0 / (1.0 / euler + 1.0 / (0.9 * rod.elastic.g_pa * section.area_m2));
    assert!(wanted < 0.8 * euler);
    let of = |count| buckling(&frame, &ends, &load, parts(count)).unwrap()[0].factor / wanted - 1.0;
    let [coarse, fine] = [of(16), of(64)];
    assert!(fine > 0.0 && fine < 1e-4, "{fine:e}");
    assert!((15.0..17.0).contains(&(coarse / fine)), "second order");
}

/// A bar that twists easily twists first, at `G J A/(I_y + I_z)` whatever its length.
#[test]
fn twist_lowers_the_factor() {
    let round = Section::circle(0.02);
    let section = Section { j_m4: 1e-3 * round.j_m4, ..round };
    let rod = Member { section, ..rod([0, 1]) };
    let nodes = vec![Point::origin(), Point::new(0.0, 0.0, 0.1)];
    let frame = Frame::new(nodes, vec![rod]).unwrap();
    let load = pushed(1, [0.0, 0.0, -1.0, 0.0, 0.0, 0.0]);
    let wanted = rod.elastic.g_pa * section.j_m4 * section.area_m2 / (2.0 * section.iy_m4);
    for count in [1, 3] {
        let ask = BucklingAsk { with_twist: true, ..parts(count) };
        let mode = &buckling(&frame, &clamped([0]), &load, ask).unwrap()[0];
        near(mode.factor, wanted, 1e-9);
        let without = buckling(&frame, &clamped([0]), &load, parts(count)).unwrap()[0].factor;
        assert!(without > 10.0 * wanted);
    }
}

/// Ten elements, whether they are parts of one member or members of their own. The mean force of
/// each part makes the factor a little low here, in the second order of its length.
#[test]
fn b11_column_under_its_own_weight() {
    let (frame, ei) = column();
    let q = frame.members()[0].density_kg_m3 * frame.members()[0].section.area_m2 * 9.80665;
    let held = clamped([0]);
    let of = |frame: &Frame, count: usize| {
        buckling(frame, &held, &falling(DOWN), parts(count)).unwrap()[0].factor * q / ei
    };
    let [two, ten, twenty, forty] = [2, 10, 20, 40].map(|count| of(&frame, count));
    let cut = of(&chain(Vector::z(), 1.0, 10), 1);
    eprintln!(
        "B11: {ten:.6}, as ten members {cut:.6} (7.8051); with 2, 20, 40 parts {two:.6} \
         {twenty:.6} {forty:.6} (7.8373)"
    );
    near(ten, 7.8051, 1e-3);
    near(cut, ten, 1e-9);
    near(forty, 7.8373, 1e-3);
    let order = (7.837_347 - ten) / (7.837_347 - twenty);
    assert!((3.5..4.5).contains(&order), "{order}");
}

/// Two columns and a beam of one length and section, 1 m, hardly stretching, held in their plane.
fn portal(foot: Support) -> (Frame, Vec<Support>, f64) {
    let round = Section::circle(2e-2);
    let section = Section { area_m2: 1e3 * round.area_m2, ..round };
    let nodes = [[0.0, 0.0], [0.0, 1.0], [1.0, 1.0], [1.0, 0.0]];
    let nodes = nodes.map(|[x, z]| Point::new(x, 0.0, z)).to_vec();
    let members = [[0, 1], [1, 2], [3, 2]].map(|ends| Member { section, ..rod(ends) });
    let ei = members[0].elastic.e_pa * section.iy_m4;
    let in_plane = |node| Support { node, fixed: [false, true, false, true, false, true] };
    let frame = Frame::new(nodes, members.to_vec()).unwrap();
    (frame, vec![foot, Support { node: 3, ..foot }, in_plane(1), in_plane(2)], ei)
}

#[test]
fn b12_portal_sways() {
    let pinned = Support { node: 0, fixed: [true, true, true, true, false, true] };
    for (name, foot, wanted) in
        [("pinned", pinned, 1.82129), ("fixed", Support::clamped(0), 7.37915)]
    {
        let (frame, supports, ei) = portal(foot);
        let push = |node| NodeLoad { node, load: [0.0, 0.0, -1.0, 0.0, 0.0, 0.0] };
        let load = Load { at_nodes: vec![push(1), push(2)], ..Load::default() };
        let mode = &buckling(&frame, &supports, &load, parts(4)).unwrap()[0];
        eprintln!("B12 {name}: {:.6} ({wanted})", mode.factor / ei);
        near(mode.factor / ei, wanted, 1e-3);
        // both corners go the same way
        near(mode.displacement[1][0], mode.displacement[2][0], 1e-3);
    }
}

/// Factors of f050 and f150 that a numpy program and beamfeapy agree on.
#[test]
fn random_frames_buckle_as_elsewhere() {
    for name in ["f050.json", "f150.json"] {
        let reference = reference(name);
        let nodal = Load { at_nodes: reference.nodal(), ..Load::default() };
        for (key, load) in [("nodal_loads_only", nodal), ("selfweight_only", falling(DOWN))] {
            let mut show = String::new();
            for count in [1, 2, 4, 8, 16] {
                let ask = BucklingAsk { modes: 3, ..parts(count) };
                let modes = buckling(&reference.frame, &reference.supports, &load, ask).unwrap();
                let wanted = &reference.file["buckling"][format!("{key}_{count}_el_per_strut")];
                let wanted = numbers(wanted);
                assert_eq!(modes.len(), wanted.len());
                let gap = |(mode, wanted): (&Mode, &f64)| (mode.factor / wanted - 1.0).abs();
                let worst = modes.iter().zip(&wanted).map(gap).fold(0.0, f64::max);
                let solves: Vec<usize> = modes.iter().map(|mode| mode.solves).collect();
                show += &format!(" {count}: {worst:.1e} {solves:?}");
                assert!(worst < 1e-6, "{name} {key} {count}: {worst:e}");
            }
            eprintln!("{name} {key}, parts: gap [solves]:{show}");
        }
    }
}

/// A round column buckles to either side: the same factor twice, in shapes that are not the same.
#[test]
fn equal_factors_come_as_often_as_they_are() {
    let (frame, _) = column();
    let load = pushed(1, [0.0, 0.0, -1.0, 0.0, 0.0, 0.0]);
    let ask = BucklingAsk { modes: 4, ..parts(4) };
    let modes = buckling(&frame, &clamped([0]), &load, ask).unwrap();
    near(modes[1].factor, modes[0].factor, 1e-9);
    near(modes[3].factor, modes[2].factor, 1e-9);
    near(modes[2].factor, 9.0 * modes[0].factor, 1e-2);
    let [a, b] = [0, 1].map(|at: usize| Vector::from_column_slice(&modes[at].displacement[1][..3]));
    near(a.norm(), 1.0, 1e-9);
    assert!(a.cross(&b).norm() > 0.9 && modes[0].member == 0 && modes[0].station == 1.0);
}

#[test]
fn tension_never_buckles() {
    let (frame, _) = column();
    let pulled = pushed(1, [0.0, 0.0, 1.0, 0.0, 0.0, 0.0]);
    assert_eq!(buckling(&frame, &clamped([0]), &pulled, parts(2)), Ok(Vec::new()));
    assert_eq!(buckling(&frame, &clamped([0]), &Load::default(), parts(2)), Ok(Vec::new()));
}

/// Half pulled, half pressed: only the pressed half matters, whichever way.
#[test]
fn pushed_in_the_middle() {
    let frame = chain(Vector::z(), 1.0, 2);
    let [up, down] = [1.0, -1.0].map(|push| {
        let load = pushed(1, [0.0, 0.0, push, 0.0, 0.0, 0.0]);
        buckling(&frame, &clamped([0, 2]), &load, parts(4)).unwrap().remove(0)
    });
    near(up.factor, down.factor, 1e-9);
    assert_eq!((up.member, down.member), (1, 0));
    assert_eq!(up.region, [1]);
}

/// A strut between stiff ones buckles on its own: one part does not see it, two do.
#[test]
fn a_strut_of_its_own() {
    let reference = reference("f150.json");
    let load = Load { at_nodes: reference.nodal(), ..Load::default() };
    let of = |count| buckling(&reference.frame, &reference.supports, &load, parts(count)).unwrap();
    let (blind, seen) = (of(1).remove(0), of(2).remove(0));
    assert!(blind.factor > 6.0 * seen.factor);
    assert!(seen.region.len() <= 2 && seen.station == 0.5, "{:?}", seen.region);
    let solution = solve(&reference.frame, &reference.supports, &load).unwrap();
    let flagged = slender(&reference.frame, &solution, [0.0; 3], 0.0).unwrap();
    assert_eq!(flagged[0].member, seen.member);
    // held nearly as firmly as between clamps, where it would be four times the Euler load
    let of_euler = flagged[0].ratio * seen.factor;
    assert!((1.0..4.0).contains(&of_euler), "{of_euler}");
}

/// From the mode of nearly the same load it takes fewer solves, and comes to the same.
#[test]
fn a_known_mode_is_a_start() {
    let reference = reference("f150.json");
    let load = |scale: f64| {
        let mut at_nodes = reference.nodal();
        at_nodes[0].load.iter_mut().for_each(|value| *value *= scale);
        Load { at_nodes, ..falling(DOWN) }
    };
    let run = |load: &Load, near| {
        let ask = BucklingAsk { near, ..parts(2) };
        buckling(&reference.frame, &reference.supports, load, ask).unwrap().remove(0)
    };
    let before = run(&load(1.0), None);
    let (cold, warm) = (run(&load(1.02), None), run(&load(1.02), Some(&before)));
    eprintln!("solves: cold {}, warm {}", cold.solves, warm.solves);
    near(warm.factor, cold.factor, 1e-9);
    assert!(warm.solves <= cold.solves);
    // the second mode given as a start does not hide the first
    let ask = BucklingAsk { modes: 2, ..parts(2) };
    let two = buckling(&reference.frame, &reference.supports, &load(1.0), ask).unwrap();
    near(run(&load(1.0), Some(&two[1])).factor, before.factor, 1e-9);
    assert_eq!(run(&load(1.0), None), before);
}

/// Turned as a whole, in other units of load, and cut into members: the same.
#[test]
fn factors_do_not_depend_on_how_it_is_put() {
    let reference = reference("f050.json");
    let (frame, supports) = (&reference.frame, &reference.supports);
    let straight = buckling(frame, supports, &falling(DOWN), parts(2)).unwrap().remove(0);
    let pose = crate::pose::from_xyz_rpy([0.3, -2.0, 0.7], [1.1, -0.4, 2.0]);
    let nodes = frame.nodes().iter().map(|node| pose * node).collect();
    let turned = Frame::new(nodes, frame.members().to_vec()).unwrap();
    let gravity = pose.rotation * Vector::from(DOWN) * 10.0;
    let load = falling([gravity.x, gravity.y, gravity.z]);
    let other = buckling(&turned, supports, &load, parts(2)).unwrap().remove(0);
    near(other.factor * 10.0, straight.factor, 1e-9);
    assert_eq!((other.member, other.region), (straight.member, straight.region));
}

#[test]
fn what_cannot_be_asked() {
    let (frame, _) = column();
    let load = pushed(1, [0.0, 0.0, -1.0, 0.0, 0.0, 0.0]);
    for count in [0, 65] {
        let error = buckling(&frame, &clamped([0]), &load, parts(count));
        assert_eq!(error, Err(BucklingError::Parts { parts: count }));
    }
    let floats = Err(BucklingError::Stands(SolveError::Floats { node: 0 }));
    assert_eq!(buckling(&frame, &[], &load, parts(2)), floats);
    let swings = buckling(&frame, &[Support::pinned(0)], &load, parts(2));
    assert!(matches!(swings, Err(BucklingError::Stands(SolveError::Mechanism { .. }))));
    // forces beyond what a double holds are no answer, and not "never"
    let huge = pushed(1, [0.0, 1e300, -1e308, 0.0, 0.0, 0.0]);
    let lost =
        buckling(&chain(Vector::new(0.0, 1e-3, 1.0), 1.0, 3), &clamped([0]), &huge, parts(2));
    assert!(matches!(lost, Err(BucklingError::NotFinite | BucklingError::NotConverged { .. })));
    let none = BucklingAsk { modes: 0, ..parts(2) };
    assert_eq!(buckling(&frame, &clamped([0]), &load, none), Ok(Vec::new()));
    // more than there are: a column without inner nodes has two shapes to each side
    let many = BucklingAsk { modes: 9, ..parts(1) };
    assert_eq!(buckling(&frame, &clamped([0]), &load, many).unwrap().len(), 4);
}
