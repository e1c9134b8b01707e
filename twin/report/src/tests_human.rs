use crate::parts::{Severity, Verdict};
use crate::quantity::{Unit, against, clock, digits};
use crate::results::Range;
use crate::{human, sample};

#[test]
fn the_whole_page() {
    insta::assert_snapshot!(human(&sample::report(), false, 78), @r"
    INFEASIBLE  score 0 of 100  (R 80, C 0, P 55, S 90, E –)  tower

    error C201 nozzle too near printed strands
             nozzle comes within 0.31 mm of s3 in the print of strand `s7`
      where  strand s7, at 12.5 mm, print, 0:01:23, job.slam:12
      found  0.31 mm (-0.19 to 0.81), at least 1.00 mm; worst of 12
      hint   print `s3` after this strand, tilt the nozzle away, or move one of
             them by 0.7 mm

    warning R102 too near a joint limit
             joint a4 is 2.0° from its stop on strand `s7` at 4.0 mm
      where  strand s7, job.slam:12
      found  2.00°, at least 3.00°
      hint   turn the spin

    worst of 2 strands
      bead               3.00 mm (2.90 to 3.10)       s3
      sag behind nozzle  0.42 mm (0.21 to 1.26)       s7
      sag once set       0.020 mm (0.010 to 0.040)    s3
      set behind nozzle  20.0 mm (15.0 to no end)     s3
      end pulled back    0.00 mm (0.00 to 0.10)       s3

    frame      moves 0.12 mm by its weight, worst after 2 strands, staged 0.080 mm
    strength   used while printing: members to 2.00 %, nodes to 5.00 %, buckling at 45.0 times its load
    load       seat: bends 2.40 mm, `s3` yields at 3.20 times (worth 2.46, 1.65 to 3.49), buckles at 8.50
    clearance  0.31 mm at the least, nozzle to s3 at 0:01:23; covered to 0.10 mm, arm ± 0.50 mm
    totals     0.12 m, 0.88 g
    time       1:02:03: print 0:50:00, dwell 0:02:00, transit 0:10:03
               1 assumption in report.json
    ");
}

#[test]
fn colours_only_when_asked() {
    let mut report = sample::report();
    assert!(!human(&report, false, 80).contains('\x1b'));
    assert!(human(&report, true, 80).starts_with("\x1b[1;31mINFEASIBLE\x1b[0m"));
    report.verdict = Verdict::Feasible;
    assert!(human(&report, true, 80).starts_with("\x1b[1;32mFEASIBLE\x1b[0m"));
}

#[test]
fn words_stay_inside_the_width() {
    let text = human(&sample::report(), false, 60);
    let findings = text.split("worst of 2 strands").next().expect("a first part");
    for line in findings.lines().skip(1) {
        assert!(line.chars().count() <= 60, "{line}");
    }
}

#[test]
fn many_findings_are_cut_short_by_severity() {
    let mut report = sample::report();
    report.findings = vec![sample::too_near(); 23];
    report.findings.extend(vec![sample::near_stop(); 21]);
    let text = human(&report, false, 80);
    assert_eq!(text.matches("error C201").count(), 20);
    assert_eq!(text.matches("warning R102").count(), 20);
    assert!(text.contains("… and 3 more errors in report.html and report.json"));
    assert!(text.contains("… and 1 more warning in report.html and report.json"));
}

#[test]
fn a_report_of_nothing_is_still_a_page() {
    let mut report = sample::report();
    report.findings.clear();
    report.strands.clear();
    report.stages.clear();
    report.loads.clear();
    report.motion.smallest_clearance = None;
    report.provenance.inputs.clear();
    assert!(human(&report, false, 0).lines().count() >= 3);
}

#[test]
fn numbers_have_three_digits() {
    let shown: Vec<String> =
        [0.0, -0.0001, 0.0312, 0.0996, 0.31, 9.99, 9.996, 12.34, 99.96, 1234.5].map(digits).into();
    assert_eq!(
        shown,
        ["0.00", "0.000", "0.031", "0.10", "0.31", "9.99", "10.0", "12.3", "100", "1234"]
    );
}

#[test]
fn units_are_those_of_people() {
    let quarter_turn = std::f64::consts::FRAC_PI_2;
    assert_eq!(Unit::Degree.show(Some(quarter_turn)), "90.0°");
    assert_eq!(Unit::Percent.show(Some(1.2)), "120 %");
    assert_eq!(Unit::Millimetre.show(None), "no end");
    let endless = Range { value: Some(0.02), low: Some(0.015), high: Some(1e3) };
    assert_eq!(Unit::Millimetre.show_range(&endless), "20.0 mm (15.0 to no end)");
    assert_eq!(clock(Some(3723.6)), "1:02:04");
}

#[test]
fn a_limit_says_its_side() {
    assert_eq!(
        against(&sample::too_near()).as_deref(),
        Some("0.31 mm (-0.19 to 0.81), at least 1.00 mm")
    );
    let mut flip = sample::too_near();
    flip.code = "R104".to_owned();
    assert_eq!(against(&flip), None);
    let mut fast = sample::near_stop();
    (fast.code, fast.unit, fast.severity) = ("R105".to_owned(), "1".to_owned(), Severity::Error);
    (fast.measured, fast.low, fast.high, fast.limit) = (Some(1.5), Some(1.5), Some(1.5), Some(1.0));
    assert_eq!(against(&fast).as_deref(), Some("150 %, at most 100 %"));
}
