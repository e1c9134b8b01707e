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
        let centre = Point::new(0.008 * f64::from(k), 0.001 * f64::from(k % 7), 0.004 * f64::from(k));
        let (low, high) = (centre - Vector::repeat(0.01), centre + Vector::repeat(0.01));
        deposit.near(low, high, &mut found);
        for (index, segment) in deposit.segments.iter().enumerate() {
            let (l, h) = segment.bounds();
            let touches = (0..3).all(|axis| l[axis] <= high[axis] && h[axis] >= low[axis]);
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
