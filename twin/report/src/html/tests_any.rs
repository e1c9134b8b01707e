//! Whatever text and numbers a report holds: the same markup as with harmless text, and nothing else of it.

use std::sync::LazyLock;

use proptest::prelude::*;
use sim::film::{Trace, TraceOf};

use super::tests::extras;
use super::{EmbeddedPicture, Extras, PictureKind, page};
use crate::parts::Report;
use crate::sample;

/// Text that would like to be more than text.
fn hostile() -> impl Strategy<Value = String> {
    let known = [
        "</script><script>alert(1)</script>",
        "<!--<script>",
        "\"><img src=x onerror=alert(1)>",
        "' onfocus='alert(1)",
        "&lt;b&gt;&amp;",
        "\u{202e}desrever\u{2066}",
        "\u{0}\u{7}\u{1b}[31m\r\n\t",
        "]]>--></style></title>",
        "\\u003c/script>\u{2028}",
        "javascript:alert(1)",
        "https://example.org/",
    ];
    prop_oneof![
        prop::sample::select(known.to_vec()).prop_map(str::to_owned),
        "\\PC{0,40}",
        any::<String>()
    ]
}

/// Puts text into every place of a report that takes some.
fn filled(mut report: Report, text: &str) -> Report {
    let own = || text.to_owned();
    report.name = own();
    for finding in &mut report.findings {
        (finding.title, finding.message, finding.hint) = (own(), own(), own());
        (finding.site.strand, finding.site.bodies) = (Some(own()), vec![own(), own()]);
        finding.unit = own();
    }
    report.strands.iter_mut().for_each(|strand| strand.id = own());
    report
        .stages
        .iter_mut()
        .for_each(|stage| (stage.strand, stage.released) = (Some(own()), Some(own())));
    report.landings.iter_mut().for_each(|landing| {
        landing.strand = own();
        landing.remedies = vec![crate::Remedy { change: own(), left_m: None }];
    });
    report.loads.iter_mut().for_each(|load| (load.name, load.fault) = (own(), Some(own())));
    if let Some(nearest) = &mut report.motion.smallest_clearance {
        nearest.bodies = [own(), own()];
    }
    report
        .assumptions
        .iter_mut()
        .for_each(|assumption| (assumption.about, assumption.text) = (own(), own()));
    report
        .provenance
        .inputs
        .iter_mut()
        .for_each(|input| (input.what, input.name, input.sha256) = (own(), own(), own()));
    report.provenance.drawn_by = Some(own());
    report.timing.steps.iter_mut().for_each(|step| step.step = own());
    report
}

fn with_text(text: &str) -> String {
    let source = slam::Source::new(
        text,
        format!("a\n{}", format!("{}\n", text.replace(['\n', '\r'], " ")).repeat(20)),
    );
    let report = filled(sample::report(), text);
    let kinds = [
        PictureKind::Hero,
        PictureKind::Finding { index: 0 },
        PictureKind::SpinMap { strand: text.to_owned() },
    ];
    let picture = |kind| EmbeddedPicture {
        kind,
        alt: text.to_owned(),
        mime: "image/png",
        bytes: vec![1, 2, 3],
    };
    page(&report, &Extras { pictures: kinds.into_iter().map(picture).collect(), ..extras(&source) })
}

/// The tags of a page with the names of their attributes: all its structure, none of its text.
fn skeleton(page: &str) -> Vec<String> {
    let mut tags = Vec::new();
    let mut rest = page;
    while let Some(start) = rest.find('<') {
        rest = &rest[start + 1..];
        let mut tag = String::new();
        let mut quoted = false;
        for c in rest.chars() {
            match c {
                '"' => quoted = !quoted,
                '>' if !quoted => break,
                c if !quoted => tag.push(c),
                _ => {}
            }
        }
        // a script ends at the first end tag, whatever stands in it
        if tag.starts_with("script") || tag.starts_with("style") {
            let name = if tag.starts_with("script") { "</script>" } else { "</style>" };
            rest = rest.find(name).map_or("", |end| &rest[end..]);
        }
        tags.push(tag);
    }
    tags
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 48, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn no_text_becomes_markup(text in hostile()) {
        static HARMLESS: LazyLock<Vec<String>> = LazyLock::new(|| skeleton(&with_text("word")));
        let page = with_text(&text);
        prop_assert_eq!(&skeleton(&page), &*HARMLESS);
        prop_assert!(page.contains("http-equiv=\"Content-Security-Policy\""));
        for start in ["href=\"", "src=\""] {
            for link in page.split(start).skip(1) {
                prop_assert!(link.starts_with('#') || link.starts_with("data:image/png;base64,"));
            }
        }
        let in_text = |c: char| c.is_control() && c != '\n';
        prop_assert!(!page.contains(in_text), "a control character");
        let shown = page.split("<script type=\"application/json\" id=\"report-json\">").next().unwrap_or_default();
        prop_assert!(!shown.contains(['\u{202e}', '\u{2066}', '\u{2028}']), "a turn of the direction");
    }

    #[test]
    fn any_trace_is_a_page(
        points in prop::collection::vec([prop::num::f64::ANY, prop::num::f64::ANY], 0..60),
        limit in prop::option::of(prop::num::f64::ANY),
        steps in any::<bool>(),
        total in prop::option::of(prop::num::f64::ANY),
    ) {
        let source = slam::Source::new("job.slam", "");
        let mut report = sample::report();
        report.totals.time_s = total;
        let of = [TraceOf::Speed, TraceOf::Joint(1), TraceOf::Joint(usize::MAX), TraceOf::Temperature, TraceOf::Buckling];
        let traces = of.map(|of| Trace { of, points: points.clone(), steps, limit });
        let text = page(&report, &Extras { traces: &traces, ..extras(&source) });
        prop_assert!(!text.contains("NaN") && !text.contains(">inf") && !text.contains("=\"inf"));
        prop_assert!(text.ends_with("</body></html>\n"));
    }

    #[test]
    fn any_numbers_are_a_page(number in prop::num::f64::ANY, index in any::<usize>()) {
        let source = slam::Source::new("job.slam", "a\nb");
        let mut report = sample::report();
        for finding in &mut report.findings {
            (finding.measured, finding.limit, finding.time_s) = (Some(number), Some(number), Some(number));
            (finding.line, finding.count) = (Some(index), index);
        }
        for strand in &mut report.strands {
            (strand.start_s, strand.end_s, strand.sag_nozzle_m.value) = (Some(number), Some(-number), Some(number));
        }
        (report.totals.mass_kg, report.score, report.scores.process) = (Some(number), Some(number), Some(number));
        report.stages[0].staged_m = Some(number);
        report.stages[0].buckling_factor = Some(number);
        let pictures = vec![EmbeddedPicture {
            kind: PictureKind::Strip { time_s: number }, alt: String::new(), mime: "text/html", bytes: vec![0],
        }];
        let text = page(&report, &Extras { pictures, ..extras(&source) });
        prop_assert!(text.ends_with("</body></html>\n") && !text.contains("data:text/html"));
    }
}
