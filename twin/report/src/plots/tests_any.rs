//! Whatever numbers a report holds: a page, and only finite coordinates in it.

use proptest::prelude::*;

use super::axis::Axis;
use super::strands_page;
use super::tests::{bridge, drawings, well_formed};
use crate::results::{Bond, Range, Strand};
use crate::sample;

fn wild() -> impl Strategy<Value = f64> {
    let odd = [
        0.0,
        -0.0,
        1.0,
        -1.0,
        1e3,
        999.999,
        1e-3,
        1e300,
        -1e300,
        1e-300,
        5e-324,
        1e9,
        1e15,
        f64::MAX,
        f64::NAN,
        f64::INFINITY,
        f64::NEG_INFINITY,
    ];
    prop_oneof![prop::sample::select(odd.to_vec()), -10.0..10.0, any::<f64>(), 1e-9..1e-3]
}

fn maybe() -> impl Strategy<Value = Option<f64>> {
    prop::option::weighted(0.85, wild())
}

fn range() -> impl Strategy<Value = Range> {
    [maybe(), maybe(), maybe()].prop_map(|[value, low, high]| Range { value, low, high })
}

prop_compose! {
    fn strand()(
        ranges in prop::collection::vec(range(), 12),
        ages in prop::collection::vec(wild(), 0..6),
        series in prop::array::uniform4(prop::collection::vec(maybe(), 0..8)),
        line in prop::collection::vec(prop::array::uniform3(wild()), 0..6),
        id in "\\PC{0,8}",
        has in any::<[bool; 2]>(),
    ) -> Strand {
        let mut strand = bridge();
        strand.id = id;
        [strand.sag_nozzle_m, strand.sag_slack_m, strand.sag_set_m, strand.end_miss_m] =
            [ranges[0], ranges[1], ranges[2], ranges[3]];
        [strand.bead_m, strand.draw_ratio, strand.set_distance_m, strand.set_time_s] =
            [ranges[4], ranges[5], ranges[6], ranges[7]];
        strand.cured_depth_m = has[0].then_some(ranges[8]);
        let at = ranges[9];
        strand.bond = has[1].then(|| Bond {
            value: at.value, low: at.low, high: at.high, strength_n: ranges[10],
            to: String::new(), at_m: 0.0, by_law: false,
        });
        strand.span_m = ranges[11].value;
        strand.ageing.age_s = ages;
        [strand.ageing.temperature_k, strand.ageing.core_k, strand.ageing.cure, strand.ageing.modulus_pa] = series;
        strand.centreline_m = line;
        strand
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 400, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn any_report_is_a_page(strands in prop::collection::vec(strand(), 0..4), limit in maybe()) {
        let mut report = sample::report();
        for (finding, strand) in report.findings.iter_mut().zip(&strands) {
            finding.site.strand = Some(strand.id.clone());
            (finding.code, finding.limit) = ("P301".to_owned(), limit);
        }
        report.strands = strands;
        let page = strands_page(&report);
        prop_assert!(!page.contains("NaN") && !page.contains(">inf<") && !page.contains("inf mm"));
        for drawing in drawings(&page) {
            prop_assert_eq!(well_formed(&format!("<svg {drawing}</svg>")), Ok(()));
            for number in coordinates(drawing) {
                let value: f64 = number.parse().expect("a number");
                prop_assert!((-999.0..=9999.0).contains(&value), "{}", number);
            }
        }
    }

    #[test]
    fn any_axis_covers_what_is_on_it(values in prop::collection::vec(-1e9..1e9, 1..5), small in 1e-9..1.0) {
        let values: Vec<f64> = values.into_iter().map(|value: f64| value * small).collect();
        let axis = Axis::round(values.iter().copied(), 4);
        let size = axis.low.abs().max(axis.high.abs());
        for value in values {
            prop_assert!(axis.low - 1e-9 * size <= value && value <= axis.high + 1e-9 * size);
        }
        prop_assert!((2..=14).contains(&axis.ticks.len()), "{:?}", axis);
    }

    #[test]
    fn any_axis_is_finite(values in prop::collection::vec(wild(), 0..5), n in 0_usize..9) {
        for axis in [
            Axis::round(values.iter().copied(), n),
            Axis::from_zero(values.iter().copied(), n),
            Axis::within(values.first().copied().unwrap_or(0.0), values.last().copied().unwrap_or(0.0), n),
        ] {
            prop_assert!(axis.ticks.len() <= 41);
            for &value in values.iter().chain(&axis.ticks) {
                prop_assert!((0.0..=1.0).contains(&axis.share(value)));
            }
        }
    }
}

/// Every number in a path or at a place.
fn coordinates(drawing: &str) -> Vec<&str> {
    let attributes = drawing
        .split(" d=\"")
        .skip(1)
        .chain(drawing.split(" x=\"").skip(1))
        .chain(drawing.split(" y=\"").skip(1));
    let values = attributes.filter_map(|part| part.split('"').next());
    let apart = |c: char| !matches!(c, '0'..='9' | '-' | '.');
    values.flat_map(|value| value.split(apart)).filter(|number| !number.is_empty()).collect()
}
