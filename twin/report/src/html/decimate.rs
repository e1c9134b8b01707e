//! Many points as few, so that no peak is lost.

/// Stretches of a line of which the least and the greatest value stay: at most twice as many points, and gaps.
const BUCKETS: usize = 400;

/// A point of a line; `None` is a gap.
pub(super) type Points = Vec<(f64, Option<f64>)>;

/// Least and greatest of each of 400 even stretches of time from 0 to `total`, in order of time. O(n).
///
/// A gap inside a stretch stays a gap. Points must be in order of time.
pub(super) fn decimated(points: &[(f64, Option<f64>)], total: f64) -> Points {
    if points.len() <= 2 * BUCKETS || !(total > 0.0) {
        return points.to_vec();
    }
    let bucket = |time: f64| ((time / total * BUCKETS as f64).max(0.0) as usize).min(BUCKETS - 1);
    let mut few = Points::new();
    let mut from = 0;
    while from < points.len() {
        let of = bucket(points[from].0);
        let n = points[from..].iter().take_while(|point| bucket(point.0) == of).count();
        few.extend(ends(&points[from..from + n]));
        from += n;
    }
    few
}

/// Least and greatest of a stretch, in order of time, then its gap if it has one.
fn ends(points: &[(f64, Option<f64>)]) -> Points {
    let known = || points.iter().filter_map(|&(time, value)| Some((time, value?)));
    let least = known().reduce(|best, next| if next.1 < best.1 { next } else { best });
    let most = known().reduce(|best, next| if next.1 > best.1 { next } else { best });
    let mut kept: Points =
        [least, most].into_iter().flatten().map(|(time, value)| (time, Some(value))).collect();
    kept.sort_by(|a, b| a.0.total_cmp(&b.0));
    kept.dedup();
    kept.extend(points.iter().find(|point| point.1.is_none()));
    kept
}

/// A line of values that hold until the next, until `total`.
pub(super) fn stepped(points: &[(f64, Option<f64>)], total: f64) -> Points {
    let mut line = Points::with_capacity(2 * points.len() + 1);
    for (k, &(time, value)) in points.iter().enumerate() {
        line.push((time, value));
        let next = points.get(k + 1).map_or(total.max(time), |next| next.0);
        line.push((next, value));
    }
    line
}
