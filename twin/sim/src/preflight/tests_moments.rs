use super::deformed::{Unit, round_factor};
use super::*;
use crate::pose::{Point, Vector};
use crate::scene::Scene;
use crate::structure::displacement_along;
use crate::test_job::{job, strand, text};

fn checked(strands: &[String]) -> Preflight {
    preflight(job(&text("printer-3axis", "", &strands.join(","))), |_| {}).expect("small")
}

/// Two posts and a bar between them, then an arm from the second.
fn gate() -> Vec<String> {
    vec![
        strand("a", &[[0.0, 0.0, 0.6], [0.0, 0.0, 20.0]], ""),
        strand("b", &[[60.0, 0.0, 0.6], [60.0, 0.0, 20.0]], ""),
        strand("c", &[[0.0, 0.0, 20.0], [60.0, 0.0, 20.0]], ""),
        strand("d", &[[60.0, 0.0, 20.0], [60.0, 40.0, 20.0]], ""),
    ]
}

#[test]
fn factors_are_round_and_not_above() {
    for (most, wanted) in
        [(0.3, 1), (1.0, 1), (1.99, 1), (4.9, 2), (5.0, 5), (73.0, 50), (1e5, 100_000)]
    {
        assert_eq!(round_factor(most), wanted, "{most}");
    }
    assert_eq!(round_factor(f64::NAN), 1);
    assert!(round_factor(f64::INFINITY) > 1_000_000);
}

#[test]
fn lengths_are_told_with_three_digits() {
    for (most_m, length_m, wanted) in [
        (1e-3, 1.234e-4, "0.123 mm"),
        (1e-3, 2e-3, "2.00 mm"),
        (4e-5, 1.234e-5, "12.3 µm"),
        (1e-3, 0.0, "0 mm"),
    ] {
        assert_eq!(Unit::of(most_m).text(length_m), wanted);
    }
}

/// A cantilever under a force at its tip: `u = F x² (3 L - x)/(6 E I)`, turn `F x (2 L - x)/(2 E I)`; the cubic is
/// exact, and an axial part is straight.
#[test]
fn a_member_is_drawn_as_an_unloaded_beam_bends() {
    let (length_m, f) = (0.08, 0.02);
    let down = |x: f64| -f * x * x * (3.0 * length_m - x) / 6.0;
    let turn = |x: f64| f * x * (2.0 * length_m - x) / 2.0;
    let (from, to) = (0.02, 0.08);
    let moved = [from, to].map(|x| [1e-3 * x, 0.0, down(x), 0.0, turn(x), 0.0]);
    let ends = [from, to].map(|x| Point::new(x, 0.3, 0.1));
    for share in [0.0, 0.25, 0.5, 0.9, 1.0] {
        let x = from + (to - from) * share;
        let wanted = Vector::new(1e-3 * x, 0.0, down(x));
        let found = displacement_along(ends, moved, share);
        assert!((found - wanted).norm() < 1e-15, "{found} {wanted}");
    }
}

fn coloured(scene: &Scene) -> impl Iterator<Item = &crate::scene::StrandShape> {
    scene.strands.iter().filter(|strand| strand.value.is_some())
}

#[test]
fn three_stages_are_drawn_with_one_factor_and_one_scale() {
    let preflight = checked(&gate());
    let row = deformed(&preflight).expect("it sags");
    assert_eq!(row.scenes.len(), 3);
    assert!(
        row.scenes[2].title.starts_with("after 4 of 4 strands\nnodes "),
        "{}",
        row.scenes[2].title
    );
    let high = row.scenes[0].colour.as_ref().expect("a scale").high;
    let mut largest = 0.0f64;
    for scene in &row.scenes {
        assert_eq!(scene.colour, row.scenes[0].colour);
        assert_eq!(scene.part_bounds, row.scenes[0].part_bounds);
        assert_eq!(scene.marks.len(), 1);
        largest = coloured(scene).filter_map(|strand| strand.value).fold(largest, f64::max);
    }
    assert!(largest <= high && largest > 0.5 * high, "{largest} {high}");
    assert!(row.title.contains("displacement × "));
    // the largest shift is 2 to 5 % of the part
    let is_fine = row.scenes[0].colour.as_ref().is_some_and(|colour| colour.unit == "µm");
    let most_m = high * if is_fine { 1e-6 } else { 1e-3 };
    let staged = preflight.growth.stages.iter().filter_map(|stage| stage.staged_m);
    assert!(most_m >= staged.fold(0.0, f64::max) * (1.0 - 1e-12));
    let factor: f64 = row
        .title
        .rsplit('×')
        .next()
        .and_then(|text| text.replace(char::is_whitespace, "").parse().ok())
        .expect("a factor");
    assert!((0.02..=0.0501).contains(&(factor * most_m / 0.06)), "{factor} {most_m}");
    assert!(fallen(&preflight).is_none());
}

#[test]
fn what_hangs_on_nothing_falls_and_is_called_an_illustration() {
    let strands = [
        strand("bar", &[[-40.0, 0.0, 0.6], [40.0, 0.0, 0.6]], ", \"on\": \"bed\""),
        strand("leaf", &[[0.0, 5.0, 12.0], [30.0, 5.0, 15.0]], ""),
    ];
    let preflight = checked(&strands);
    let row = fallen(&preflight).expect("the leaf falls");
    assert_eq!(row.stamp.as_deref(), Some("illustration"));
    assert!(
        row.title.contains("illustration") && row.notes[0] == "strand `leaf` hangs on nothing",
        "{row:?}"
    );
    assert_eq!(row.scenes.len(), 3);
    let height_mm = |scene: &Scene| {
        let all = coloured(scene).flat_map(|strand| &strand.points).map(|point| point.z * 1e3);
        all.fold(f64::NEG_INFINITY, f64::max)
    };
    assert!(height_mm(&row.scenes[0]) > 10.0 && height_mm(&row.scenes[2]) < 3.0);
    assert_eq!(row.scenes[0].marks.len(), 1);
}

/// Nothing moves that lies on the bed.
#[test]
fn there_is_no_picture_of_nothing() {
    let preflight =
        checked(&[strand("bar", &[[-40.0, 0.0, 0.6], [40.0, 0.0, 0.6]], ", \"on\": \"bed\"")]);
    assert!(deformed(&preflight).is_none() && fallen(&preflight).is_none());
}
