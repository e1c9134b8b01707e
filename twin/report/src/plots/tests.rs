use super::axis::Axis;
use super::text::{Scale, escaped, power, short};
use super::{card, strands_page};
use crate::parts::Report;
use crate::results::{Bond, Range, Strand};
use crate::sample;

/// A strand that sags in the middle, with numbers of every kind.
pub(super) fn bridge() -> Strand {
    let mut strand = sample::strand("s7", 4.2e-4);
    let sagging = |k: u32| {
        let s = f64::from(k) / 8.0;
        [0.06 * s, 0.0, 0.1 - 4.2e-4 * 4.0 * s * (1.0 - s)]
    };
    strand.centreline_m = (0..=8).map(sagging).collect();
    strand.ageing.age_s = vec![0.0, 1.0, 4.0, 9.0];
    strand.ageing.temperature_k = [513.0, 460.0, 400.0, 350.0].map(Some).to_vec();
    strand.ageing.core_k = [513.0, 470.0, 410.0, 355.0].map(Some).to_vec();
    strand.ageing.modulus_pa = vec![Some(1e6), None, Some(2e8), Some(2e9)];
    strand.bond = Some(Bond {
        value: Some(0.6),
        low: Some(0.3),
        high: Some(0.9),
        strength_n: Range { value: Some(12.0), low: Some(5.0), high: Some(20.0) },
        to: "s3".to_owned(),
        at_m: 0.0,
        by_law: true,
    });
    strand
}

fn many(n: usize) -> Report {
    let mut report = sample::report();
    report.strands = (0..n)
        .map(|k| {
            let mut strand = bridge();
            strand.id = format!("strand-{k}");
            let size = 1.0 + (k as f64 * 0.37).sin().abs() * 1.234_567;
            strand.sag_nozzle_m = Range {
                value: Some(1e-4 * size),
                low: Some(7.1e-5 * size),
                high: Some(3.3e-4 * size),
            };
            strand.cured_depth_m = Some(strand.sag_nozzle_m);
            strand
        })
        .collect();
    report.findings = (0..n)
        .map(|k| {
            let mut finding = sample::too_near();
            finding.site.strand = Some(format!("strand-{k}"));
            finding
        })
        .collect();
    report
}

/// Whether tags close in order and attributes are quoted; no entity but those of XML.
pub(super) fn well_formed(xml: &str) -> Result<(), String> {
    let mut open: Vec<&str> = Vec::new();
    let mut rest = xml;
    while let Some(start) = rest.find('<') {
        sound_text(&rest[..start])?;
        let end = start + rest[start..].find('>').ok_or("a tag without an end")?;
        let tag = &rest[start + 1..end];
        rest = &rest[end + 1..];
        if let Some(name) = tag.strip_prefix('/') {
            let was = open.pop();
            if was != Some(name) {
                return Err(format!("{was:?} closed by {name}"));
            }
            continue;
        }
        let name = tag.split([' ', '/']).next().unwrap_or_default();
        if name.is_empty() || tag.contains('<') || !tag.matches('"').count().is_multiple_of(2) {
            return Err(format!("no tag: {tag}"));
        }
        tag.split('"').skip(1).step_by(2).try_for_each(sound_text)?;
        if !tag.ends_with('/') {
            open.push(name);
        }
    }
    sound_text(rest)?;
    if open.is_empty() { Ok(()) } else { Err(format!("left open: {open:?}")) }
}

fn sound_text(text: &str) -> Result<(), String> {
    let known = ["amp;", "lt;", "gt;", "quot;", "#39;"];
    let sound = |after: &str| known.iter().any(|name| after.starts_with(name));
    if !text.split('&').skip(1).all(sound) {
        return Err(format!("no entity: {text}"));
    }
    match text.chars().find(|&c| c.is_control() && c != '\n') {
        Some(c) => Err(format!("control character {:#x}", u32::from(c))),
        None => Ok(()),
    }
}

/// Every drawing of a page.
pub(super) fn drawings(page: &str) -> Vec<&str> {
    let parts = page.split("<svg ").skip(1);
    parts.filter_map(|part| part.find("</svg>").map(|end| &part[..end])).collect()
}

#[test]
fn one_strand_as_it_was() {
    let card = card::card(2, &bridge(), &[&sample::too_near(), &sample::near_stop()]);
    let lines = card.replace("><", ">\n<");
    insta::assert_snapshot!(lines);
}

#[test]
fn the_parser_of_these_tests_sees_what_is_broken() {
    assert!(well_formed("<a b=\"c\"><d/>x &amp; y</a>").is_ok());
    for broken in
        ["<a>", "<a></b>", "<a b=\"c></a>", "<a>&nbsp;</a>", "<a>\u{1}</a>", "<a", "<>x</>"]
    {
        assert!(well_formed(broken).is_err(), "{broken}");
    }
}

#[test]
fn text_of_a_job_is_never_markup() {
    let evil =
        "</title></svg><script>alert('x')</script>&\"\u{0}\u{1b}[31m\u{202e}\u{feff}\u{ffff}";
    let mut report = many(3);
    report.name = evil.to_owned();
    report.strands[1].id = evil.to_owned();
    report.strands[1].bond.as_mut().expect("a bond").to = evil.to_owned();
    report.findings[1].site.strand = Some(evil.to_owned());
    report.findings[1].message = evil.to_owned();
    report.findings[1].code = evil.to_owned();
    let page = strands_page(&report);
    assert!(!page.contains("<script"), "{page}");
    assert!(page.contains("&lt;script&gt;"));
    assert!(
        !page
            .chars()
            .any(|c| (c.is_control() && c != '\n') || matches!(c, '\u{202e}' | '\u{ffff}'))
    );
    let body = &page[page.find("<body>").expect("a body")..page.find("</html>").expect("an end")];
    assert_eq!(well_formed(body), Ok(()));
    assert_eq!(escaped("a<b", 2), "a&lt;…");
}

#[test]
fn a_page_fetches_nothing_and_runs_nothing() {
    let page = strands_page(&many(30));
    assert!(page.contains("default-src 'none'"));
    for word in ["<script", "src=", "href=", "url(", "@import", "onload", "style="] {
        assert!(!page.contains(word), "{word}");
    }
    assert_eq!(
        page.matches("http").count(),
        page.matches("http-equiv").count() + drawings(&page).len()
    );
}

#[test]
fn every_drawing_is_sound_and_has_its_own_name() {
    let page = strands_page(&many(30));
    let drawings = drawings(&page);
    assert_eq!(drawings.len(), 8 + 24 * 4, "eight over all, four of each card");
    let mut names: Vec<&str> = Vec::new();
    for drawing in drawings {
        assert_eq!(well_formed(&format!("<svg {drawing}</svg>")), Ok(()));
        let (_, from) = drawing.split_once("<title id=\"").expect("a title");
        names.push(from.split('"').next().expect("a name"));
        assert!(drawing.contains("<desc id="));
    }
    names.sort_unstable();
    let n = names.len();
    names.dedup();
    assert_eq!(names.len(), n);
}

#[test]
fn a_page_of_nine_hundred_strands_is_small() {
    let page = strands_page(&many(900));
    assert!(page.len() < 1_000_000, "{}", page.len());
    assert!(page.contains("876 strands left out, 876 of them with findings"));
    let more = strands_page(&many(5000));
    assert!(more.len() < 2_000_000, "{}", more.len());
    assert!(more.contains("Neighbours share a place"));
}

#[test]
fn strands_without_end_and_without_a_bond_are_told() {
    let mut report = many(4);
    let never = Range { value: None, low: Some(0.02), high: None };
    (report.strands[0].set_distance_m, report.strands[1].bond) = (never, None);
    let page = strands_page(&report);
    assert!(page.contains("1 strand never set: mark at the top."));
    assert!(page.contains("1 strand without it: a gap."));
    assert!(page.contains("no end (20.0 to no end)"));
    report.strands.iter_mut().for_each(|strand| strand.bond = None);
    assert!(strands_page(&report).contains("no strand touches an earlier one."));
}

#[test]
fn tiny_deviations_are_drawn_larger_and_said_so() {
    let mut strand = bridge();
    let side = |strand: &Strand| super::course::views(strand, "s1");
    let told = "Up to 0.42 mm off its chord (dashed), drawn 20 times as large.";
    assert_eq!(side(&strand).matches(told).count(), 2, "caption and description");
    strand.centreline_m.iter_mut().for_each(|point| point[2] = 0.1 + point[0]);
    assert_eq!(side(&strand).matches("Straight as seen from here.").count(), 4, "both views");
    strand.centreline_m = vec![[0.0, 0.0, 0.0], [0.01, 0.02, 0.0], [0.0, 0.0, 0.0]];
    assert!(!side(&strand).contains("chord"), "a closed line has none");
}

#[test]
fn limits_come_from_findings() {
    let mut report = many(2);
    (report.findings[0].code, report.findings[0].limit) = ("P301".to_owned(), Some(5e-4));
    let page = strands_page(&report);
    assert_eq!(
        page.matches(">limit 0.50 mm<").count(),
        2,
        "behind the nozzle and once set; slack is zero"
    );
}

#[test]
fn ticks_cover_and_are_round() {
    let ranges = [
        (0.0, 1.0),
        (0.0029, 0.0031),
        (-3.0, 7.0),
        (1e-7, 3e-7),
        (99_998.0, 99_999.0),
        (5.0, 5.0),
        (-1e8, 1e8),
        (0.3, 29.0),
        (0.001, 2.0),
        (1e-9, 9e8),
        (4.0, 400.1),
        (0.0, 1e-9),
        (1.0, 1.0 + 1e-12),
    ];
    for (least, most) in ranges {
        let axis = Axis::round([least, most], 4);
        let slack = 1e-6 * (axis.high - axis.low);
        assert!(axis.low - slack <= least && most <= axis.high + slack, "{least} {most} {axis:?}");
        assert!((2..=14).contains(&axis.ticks.len()), "{least} {most} {axis:?}");
        assert!(axis.ticks.iter().all(|&tick| (axis.low..=axis.high).contains(&tick)
            || axis.share(tick) < 1e-6
            || axis.share(tick) > 1.0 - 1e-6));
        assert_eq!(axis.log, least > 0.0 && most / least > 100.0, "{least} {most}");
        let labels: Vec<String> = axis.ticks.iter().map(|&tick| axis.label(tick)).collect();
        assert!(labels.windows(2).all(|pair| pair[0] != pair[1]), "{labels:?}");
        let digits = |label: &str| {
            label
                .split('·')
                .next()
                .map_or(0, |all| all.chars().filter(char::is_ascii_digit).count())
        };
        assert!(labels.iter().all(|label| digits(label) <= 5), "{labels:?}");
        if !axis.log {
            let step = axis.ticks[1] - axis.ticks[0];
            let first = step / 10f64.powf(step.log10().floor());
            assert!(
                [1.0, 2.0, 5.0, 10.0].iter().any(|round| (first - round).abs() < 1e-6),
                "{step}"
            );
            assert!(
                axis.ticks.iter().all(|tick| (tick / step - (tick / step).round()).abs() < 1e-6)
            );
        }
    }
}

#[test]
fn labels_are_told_apart() {
    let axis = Axis::round([2.9, 3.1], 4);
    let labels: Vec<String> = axis.ticks.iter().map(|&tick| axis.label(tick)).collect();
    assert_eq!(labels, ["2.90", "2.95", "3.00", "3.05", "3.10"]);
    let decades = Axis::round([0.02, 900.0], 4);
    let labels: Vec<String> = decades.ticks.iter().map(|&tick| decades.label(tick)).collect();
    assert_eq!(labels, ["0.01", "0.1", "1", "10", "100", "1000"]);
    assert!((decades.share(3.162_277_66) - 0.5).abs() < 1e-9);
    assert_eq!([power(2.5e-5, 1), power(1e7, 1), short(123_456.0)], ["2.5·10⁻⁵", "10⁷", "1.2·10⁵"]);
    assert_eq!(Scale::MILLIMETRE.show(Some(0.0312)), "31.2 mm");
    assert_eq!(Scale::MILLIMETRE.show(Some(1e3)), "no end");
}
