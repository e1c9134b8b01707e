//! The page as a whole: what is on it, how large it gets, what is left out.

use sim::film::{Trace, TraceOf};
use sim::finding::Phase;

use super::base64::encode;
use super::course::{Course, State};
use super::decimate::{decimated, stepped};
use super::why::markup;
use super::{EmbeddedPicture, Extras, POLICY, PictureKind, page};
use crate::parts::{Report, Verdict};
use crate::sample;

pub(super) fn source() -> slam::Source {
    let lines: Vec<String> = (1..=20).map(|k| format!("  \"line\": {k},")).collect();
    slam::Source::new("job.slam", lines.join("\n"))
}

pub(super) fn extras(source: &slam::Source) -> Extras<'_> {
    Extras { film: None, traces: &[], source, view: None, pictures: Vec::new() }
}

fn picture(kind: PictureKind, n_bytes: usize) -> EmbeddedPicture {
    EmbeddedPicture { kind, alt: "the part".to_owned(), mime: "image/png", bytes: vec![7; n_bytes] }
}

fn trace(of: TraceOf, n: usize, total_s: f64) -> Trace {
    let at = |k: usize| [total_s * k as f64 / n as f64, 0.02 + 0.01 * (k as f64 * 0.7).sin()];
    Trace { of, points: (0..n).map(at).collect(), steps: of == TraceOf::Sag, limit: Some(0.025) }
}

fn all_traces(n: usize, total_s: f64) -> Vec<Trace> {
    let joints = (0..6).map(TraceOf::Joint);
    let others = [
        TraceOf::Speed,
        TraceOf::Clearance,
        TraceOf::Temperature,
        TraceOf::Cure,
        TraceOf::Sag,
        TraceOf::Displacement,
        TraceOf::Buckling,
    ];
    joints.chain(others).map(|of| trace(of, n, total_s)).collect()
}

#[test]
fn base64_is_as_printed_in_rfc_4648() {
    let printed = [
        ("", ""),
        ("f", "Zg=="),
        ("fo", "Zm8="),
        ("foo", "Zm9v"),
        ("foob", "Zm9vYg=="),
        ("fooba", "Zm9vYmE="),
        ("foobar", "Zm9vYmFy"),
    ];
    for (text, code) in printed {
        assert_eq!(encode(text.as_bytes()), code);
    }
    assert_eq!(encode(&[0xfb, 0xff]), "+/8=");
}

#[test]
fn a_page_has_all_its_parts_and_fetches_nothing() {
    let (report, source) = (sample::report(), source());
    let traces = all_traces(50, 3723.4);
    let pictures = vec![
        picture(PictureKind::Hero, 900),
        picture(PictureKind::Strip { time_s: 100.0 }, 300),
        picture(PictureKind::Finding { index: 0 }, 300),
        picture(PictureKind::SpinMap { strand: "s3".to_owned() }, 300),
    ];
    let page = page(&report, &Extras { traces: &traces, pictures, ..extras(&source) });
    for id in
        ["figures", "part", "time", "findings", "plots", "strands", "structure", "spin", "basis"]
    {
        assert!(page.contains(&format!("<section id=\"{id}\"")), "{id}");
        assert!(page.contains(&format!("<a href=\"#{id}\">")), "{id}");
    }
    assert!(page.contains(&format!("content=\"{POLICY}\"")));
    assert_eq!(page.matches("data:image/png;base64,").count(), 4);
    assert_eq!(page.matches("data-plot=").count(), 8, "six joints in one");
    assert!(page.contains("INFEASIBLE"));
    assert!(
        page.contains(
            "Decided by <a href=\"#finding-1\">C201</a> nozzle too near printed strands: 0.31 mm"
        ),
        "the worst error"
    );
    assert!(page.contains("▸ 12    &quot;line&quot;: 12,"), "the line of the job");
    assert!(page.contains("id=\"why-C201\""));
    let links = page.split(" href=\"").chain(page.split(" src=\"")).skip(1);
    let outside = links.filter(|link| !link.starts_with(['#', '<']) && !link.starts_with("data:"));
    assert_eq!(outside.count(), 0);
    assert!(!page.contains("NaN") && !page.contains("inf "));
}

#[test]
fn a_page_without_film_pictures_and_findings_is_whole() {
    let source = source();
    let mut report = sample::report();
    report.findings.clear();
    report.verdict = Verdict::Feasible;
    (report.score, report.scores.clearance) = (Some(55.0), Some(80.0));
    let text = page(&report, &extras(&source));
    assert!(text.contains("● FEASIBLE") || text.contains("</span> FEASIBLE"));
    assert!(text.contains("The smallest margin is in process: 5.00 % of the limit is left."));
    assert!(
        text.contains("Nothing was found.")
            && text.contains("Only the times of printing are known")
    );
    assert!(text.contains("This page has no pictures."));
    assert!(text.ends_with("</body></html>\n"));
    for empty in ["id=\"part\"", "id=\"plots\"", "id=\"spin\"", "id=\"view3d\""] {
        assert!(!text.contains(empty), "{empty}");
    }
}

#[test]
fn nothing_at_all_is_a_page() {
    let source = slam::Source::new("", "");
    let mut report = sample::report();
    report.findings.iter_mut().for_each(|finding| finding.line = Some(usize::MAX));
    (report.strands, report.stages, report.landings, report.loads) = Default::default();
    report.totals = crate::Totals {
        time_s: None,
        print_s: None,
        dwell_s: None,
        transit_s: None,
        length_m: None,
        mass_kg: None,
    };
    report.motion.smallest_clearance = None;
    (report.score, report.scores.reach) = (None, None);
    let text = page(&report, &extras(&source));
    assert!(
        text.contains("not checked") && !text.contains("id=\"slider\"") && !text.contains("<pre")
    );
}

#[test]
fn the_same_report_gives_the_same_bytes() {
    let (report, source) = (sample::report(), source());
    let traces = all_traces(3000, 3723.4);
    let one = || page(&report, &Extras { traces: &traces, ..extras(&source) });
    assert_eq!(one(), one());
}

/// A job with ten thousand findings, as many strands, and traces of a hundred thousand points.
fn large() -> (Report, Vec<Trace>) {
    let mut report = sample::report();
    let one = report.findings[0].clone();
    report.findings = (0..10_000)
        .map(|k| {
            let mut finding = one.clone();
            finding.message = "m".repeat(2000);
            finding.time_s = Some(f64::from(k));
            finding
        })
        .collect();
    report.strands = (0..10_000)
        .map(|k| {
            let mut strand = sample::strand(&format!("strand {k}"), 2e-4);
            (strand.start_s, strand.end_s) = (Some(f64::from(k)), Some(f64::from(k) + 0.5));
            strand
        })
        .collect();
    report.stages = vec![report.stages[0].clone(); 10_000];
    report.landings = vec![report.landings[0].clone(); 10_000];
    report.totals.time_s = Some(10_000.0);
    (report, all_traces(100_000, 10_000.0))
}

#[test]
fn a_huge_job_is_a_page_below_5_mb() {
    let (report, traces) = large();
    let source = source();
    let pictures = (0..200)
        .map(|k| picture(PictureKind::Finding { index: k }, 60_000))
        .chain([picture(PictureKind::Hero, 400_000)]);
    let text =
        page(&report, &Extras { traces: &traces, pictures: pictures.collect(), ..extras(&source) });
    assert!(text.len() < 5_000_000, "{}", text.len());
    assert_eq!(text.matches("<details class=\"finding\"").count(), 500);
    assert!(text.contains("9500 more findings not shown here, in report.json: C201 9500."));
    assert!(text.contains("report.json is larger than 1 MB"));
    assert!(text.contains("left out to keep it below 5 MB"));
    assert!(text.contains("<figure class=\"hero\">"), "the hero picture stays");
}

#[test]
fn a_unit_is_told_once() {
    let mut report = sample::report();
    let finding = &mut report.findings[0];
    (finding.code, finding.unit) = ("P310".to_owned(), "N".to_owned());
    (finding.measured, finding.limit) = (Some(5.0), Some(2.0));
    (finding.low, finding.high) = (Some(4.0), Some(6.0));
    let html = page(&report, &extras(&source()));
    assert!(html.contains("5.00 N") && !html.contains(" N N"));
}

#[test]
fn the_film_strip_gets_coarser_before_findings_lose_pictures() {
    let strip = (0..40).map(|k| picture(PictureKind::Strip { time_s: f64::from(k) }, 1000));
    let near = (0..4).map(|index| picture(PictureKind::Finding { index }, 1000));
    let pictures: Vec<EmbeddedPicture> =
        strip.chain(near).chain([picture(PictureKind::Hero, 1000)]).collect();
    let counts = |budget: usize| {
        let album = super::Album::within(&pictures, budget);
        let near =
            (0..4).filter(|&index| album.first(&PictureKind::Finding { index }).is_some()).count();
        let last = album.strip().last().map(|(time_s, _)| time_s);
        (
            album.strip().count(),
            near,
            album.first(&PictureKind::Hero).is_some(),
            last,
            album.left_out,
        )
    };
    assert_eq!(counts(1_000_000), (40, 4, true, Some(39.0), 0));
    assert_eq!(counts(45_000), (20, 4, true, Some(39.0), 20));
    assert_eq!(counts(18_000), (5, 4, true, Some(39.0), 35));
    assert_eq!(counts(9_000), (4, 0, true, Some(31.0), 40));
    assert_eq!(counts(2_000), (0, 0, true, None, 44));
    assert_eq!(counts(100), (0, 0, false, None, 45));
}

#[test]
fn few_points_keep_every_peak() {
    let peak = |k: usize| {
        if k == 54_321 {
            9.0
        } else if k == 77_777 {
            -9.0
        } else {
            (k as f64 * 0.01).sin()
        }
    };
    let many: Vec<(f64, Option<f64>)> = (0..100_000).map(|k| (k as f64, Some(peak(k)))).collect();
    let few = decimated(&many, 100_000.0);
    assert!(few.len() <= 800, "{}", few.len());
    assert!(few.contains(&(54_321.0, Some(9.0))) && few.contains(&(77_777.0, Some(-9.0))));
    assert!(few.windows(2).all(|pair| pair[0].0 <= pair[1].0));
    let mut gap = many;
    gap[500].1 = None;
    assert!(decimated(&gap, 100_000.0).iter().any(|point| point.1.is_none()), "a gap stays");
}

#[test]
fn a_step_holds_until_the_next() {
    let line = stepped(&[(1.0, Some(5.0)), (3.0, Some(7.0))], 10.0);
    assert_eq!(line, [(1.0, Some(5.0)), (3.0, Some(5.0)), (3.0, Some(7.0)), (10.0, Some(7.0))]);
}

#[test]
fn a_course_of_many_strands_is_sampled_in_order() {
    let (report, _) = large();
    let course = Course::new(&report, None);
    assert!((course.spent_s(State::Doing(Phase::Print)) - 5000.0).abs() < 1e-6);
    let few = course.sampled();
    assert!(few.len() <= 4000 && few.windows(2).all(|pair| pair[0].to_s <= pair[1].from_s + 1e-9));
}

#[test]
fn the_markdown_of_pages_becomes_html() {
    let page = "# C1 title\n\nOne *two* `a < b`\nthree.\n\n**Limit.** Four.\n\n- five\n  more\n- six ** seven\n";
    assert_eq!(
        markup(page),
        "<p>One *two* <code>a &lt; b</code> three.</p><p><b>Limit.</b> Four.</p><ul><li>five more</li><li>six ** seven</li></ul>"
    );
    for code in sim::finding::Code::ALL {
        let html = markup(code.page());
        assert!(!html.contains("```") && !html.contains("<pre tabindex=\"0\">text"), "{html}");
        assert!(html.contains("<b>Measured.</b>") && !html.contains("**"), "{}", code.as_str());
    }
}
