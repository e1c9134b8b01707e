use proptest::prelude::*;

use super::*;

fn printed(strand: usize, points: &[[f64; 3]]) -> Printed {
    let as_planned: Vec<Point> = points.iter().map(|&p| Point::from(p)).collect();
    let at_m = crate::toolpath::stations(&as_planned);
    Printed {
        strand,
        as_printed: as_planned.clone(),
        as_planned,
        at_m,
        radius_m: 1e-3,
        born_s: 0.0,
        done_s: 1.0,
    }
}

/// The grid never misses what a look at every segment finds.
#[test]
fn index_agrees_with_looking_at_everything() {
    let strands = (0..40)
        .map(|k| {
            let t = f64::from(k);
            printed(k as usize, &[[0.01 * t, 0.0, 0.0], [0.0, 0.02 * (t * 0.7).sin(), 0.01 * t]])
        })
        .collect();
    let deposit = Deposit::new(strands);
    let mut found = Vec::new();
    for k in 0..50 {
        let centre =
            Point::new(0.008 * f64::from(k), 0.001 * f64::from(k % 7), 0.004 * f64::from(k));
        let (low, high) = (centre - Vector::repeat(0.01), centre + Vector::repeat(0.01));
        deposit.near(low, high, &mut found);
        for (index, segment) in deposit.segments.iter().enumerate() {
            let [a, b] = segment.ends;
            let bead = Vector::repeat(segment.radius_m);
            let (l, h) = (low - bead, high + bead);
            let touches = (0..=500)
                .map(|k| a + (b - a) * (f64::from(k) / 500.0))
                .any(|point| (0..3).all(|axis| point[axis] >= l[axis] && point[axis] <= h[axis]));
            assert!(!touches || found.contains(&(index as u32)), "segment {index} missed at {k}");
        }
    }
}

#[test]
fn a_held_strand_sags_most_at_mid_span() {
    let points: Vec<Point> = (0..=4).map(|k| Point::new(f64::from(k) * 0.01, 0.0, 0.0)).collect();
    let at_m = crate::toolpath::stations(&points);
    let shape = sagged(&points, &at_m, 2e-3, -Vector::z());
    assert_eq!(shape[0], points[0]);
    assert!((shape[2].z + 2e-3).abs() < 1e-15, "mid-span {}", shape[2].z);
    assert!((shape[4].z).abs() < 1e-15, "far end {}", shape[4].z);
}

fn touching(strands: &[&[[f64; 3]]]) -> Vec<Contact> {
    let strands = strands.iter().enumerate().map(|(k, points)| printed(k, points)).collect();
    contacts(&Deposit::new(strands))
}

/// One contact, in the middle of both, with the axes as far apart as they are.
#[test]
fn a_crossing_touches_once() {
    let found = touching(&[
        &[[-0.02, 0.0, 0.0], [0.03, 0.0, 0.0]],
        &[[0.0, -0.01, 2e-3], [0.0, 0.004, 2e-3], [0.0, 0.05, 2e-3]],
    ]);
    assert_eq!(found.len(), 1, "{found:?}");
    assert_eq!(found[0].orders, [1, 0]);
    assert!((found[0].axes_m() - 2e-3).abs() < 1e-15);
    assert!((found[0].at_m[0] - 0.01).abs() < 1e-15 && (found[0].at_m[1] - 0.02).abs() < 1e-15);
    assert!((found[0].middle() - Point::new(0.0, 0.0, 1e-3)).norm() < 1e-15);
    // a tenth above two radii still touches, more does not
    for (height_m, n_contacts) in [(2.19e-3, 1), (2.21e-3, 0)] {
        let over = [[0.0, -0.01, height_m], [0.0, 0.01, height_m]];
        assert_eq!(touching(&[&[[-0.02, 0.0, 0.0], [0.03, 0.0, 0.0]], &over]).len(), n_contacts);
    }
}

#[test]
fn ends_that_meet_touch_once() {
    let corner = [0.03, 0.01, 0.02];
    let found = touching(&[
        &[[0.0; 3], corner],
        &[corner, [0.05, -0.02, 0.0]],
        &[[0.03, 0.04, 0.0], corner],
    ]);
    assert_eq!(found.iter().map(|c| c.orders).collect::<Vec<_>>(), [[1, 0], [2, 0], [2, 1]]);
    for contact in &found {
        assert!(
            contact.axes_m() < 1e-15 && (contact.middle() - Point::from(corner)).norm() < 1e-15
        );
    }
    assert!(
        found[0].at_m[0].abs() < 1e-15 && (found[0].at_m[1] - 14f64.sqrt() * 0.01).abs() < 1e-15
    );
}

/// Side by side: a row of contacts, no two nearer than two diameters, none missing for twice that.
#[test]
fn strands_alongside_touch_in_a_row() {
    let fine =
        |y: f64| -> Vec<[f64; 3]> { (0..=50).map(|k| [1e-3 * f64::from(k), y, 0.0]).collect() };
    let found = touching(&[&fine(0.0), &fine(2e-3)]);
    let at_m: Vec<f64> = found.iter().map(|contact| contact.at_m[0]).collect();
    assert!(at_m[0] <= 4e-3 && at_m[at_m.len() - 1] >= 0.05 - 4e-3, "{at_m:?}");
    for pair in at_m.windows(2) {
        assert!(pair[1] - pair[0] >= 4e-3 - 1e-12 && pair[1] - pair[0] <= 8e-3 + 1e-12, "{at_m:?}");
    }
    for contact in &found {
        assert!(
            (contact.at_m[0] - contact.at_m[1]).abs() < 1e-12
                && (contact.axes_m() - 2e-3).abs() < 1e-12
        );
    }
}

proptest! {
    /// Nearest points against a fine search over both pieces.
    #[test]
    fn closest_points_are_the_closest(
        [a, b, c, d] in prop::array::uniform4([-1.0..1.0f64, -1.0..1.0, -1.0..1.0]),
        // some pieces alike, parallel or of no length
        kind in 0usize..5,
    ) {
        let (a, b, c, d) = (Point::from(a), Point::from(b), Point::from(c), Point::from(d));
        let (first, second) = match kind {
            0 => ([a, b], [c, c + (b - a) * 0.7]),
            1 => ([a, a], [c, d]),
            2 => ([a, b], [c, c]),
            _ => ([a, b], [c, d]),
        };
        let at = |piece: &[Point; 2], share: f64| piece[0] + (piece[1] - piece[0]) * share;
        let [s, t] = closest(&first, &second);
        prop_assert!((0.0..=1.0).contains(&s) && (0.0..=1.0).contains(&t));
        let found = (at(&first, s) - at(&second, t)).norm();
        let mut least = f64::INFINITY;
        for k in 0..=200 {
            // for a place on one piece the nearest on the other is a projection
            for (one, other) in [(&first, &second), (&second, &first)] {
                let place = at(one, f64::from(k) / 200.0);
                let along = other[1] - other[0];
                let share = (place - other[0]).dot(&along) / along.norm_squared().max(1e-300);
                least = least.min((place - at(other, share.clamp(0.0, 1.0))).norm());
            }
        }
        prop_assert!(found <= least + 1e-12, "{found} is not {least}");
        prop_assert!(least - found < 0.02, "{found} is nearer than {least}");
    }
}
