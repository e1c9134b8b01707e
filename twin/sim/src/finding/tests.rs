use super::*;
use proptest::prelude::*;

fn hold(code: Code, measured: Interval, limit: f64, warn_limit: Option<f64>) -> Findings {
    let mut findings = Findings::default();
    note(&mut findings, code, measured, (limit, warn_limit), Site::default(), None);
    findings
}

fn note(
    findings: &mut Findings,
    code: Code,
    measured: Interval,
    (limit, warn_limit): (f64, Option<f64>),
    site: Site,
    time_s: Option<f64>,
) {
    let check = Check { code, measured, limit, warn_limit, site, time_s };
    findings
        .check(check, || Words { message: format!("{}", measured.nominal), hint: String::new() });
}

fn at(findings: &mut Findings, code: Code, value: f64, strand: usize, time_s: f64) {
    note(
        findings,
        code,
        Interval::exact(value),
        (1.0, None),
        Site::strand(strand, 0.0),
        Some(time_s),
    );
}

/// `50 + 100·clamp(m, −0.5, 0.5)`, m the distance from the limit as a share of it.
#[test]
fn scores_follow_the_formula() {
    let upper = |value: f64| hold(Code::P301, Interval::exact(value), 2.0, None).scores();
    for (value, score) in
        [(2.0, 50.0), (1.5, 75.0), (1.0, 100.0), (0.0, 100.0), (2.5, 25.0), (9.0, 0.0)]
    {
        assert_eq!(upper(value).total(), Some(score), "upper {value}");
        assert_eq!(upper(value).family(Family::Process), Some(score));
        assert_eq!(upper(value).family(Family::Reach), None);
    }
    let lower = |value: f64| hold(Code::C201, Interval::exact(value), 2.0, None).scores().total();
    for (value, score) in
        [(2.0, 50.0), (2.5, 75.0), (3.0, 100.0), (1.5, 25.0), (1.0, 0.0), (-4.0, 0.0)]
    {
        assert_eq!(lower(value), Some(score), "lower {value}");
    }
    let mut findings = Findings::default();
    findings.forbid(Code::R101, false, Site::default(), None, || unreachable!("nothing was found"));
    assert_eq!(findings.scores().total(), Some(100.0));
    findings.forbid(Code::R101, true, Site::default(), None, || Words {
        message: String::new(),
        hint: String::new(),
    });
    assert_eq!(findings.scores().total(), Some(0.0));
    assert_eq!(Findings::default().scores().total(), None);
}

/// The score is that of the worst family, not a mean.
#[test]
fn the_worst_margin_is_the_score() {
    let mut findings = hold(Code::P301, Interval::exact(0.0), 2.0, None);
    at(&mut findings, Code::C201, 1.1, 0, 0.0);
    at(&mut findings, Code::C201, 1.4, 1, 0.0);
    assert!((findings.scores().total().expect("two families") - 60.0).abs() < 1e-12);
    assert_eq!(findings.scores().family(Family::Process), Some(100.0));
}

/// Nominal past: error; low or high past, or the warning limit passed: warning.
#[test]
fn severity_follows_nominal_and_ends() {
    let judged = |code, measured, warn| {
        let findings = hold(code, measured, 1.0, warn);
        let found = findings.sorted().pop();
        let stops = findings.verdict() == Verdict::Infeasible;
        assert_eq!(stops, found.as_ref().is_some_and(|found| found.severity == Severity::Error));
        found.map(|found| (found.severity, found.limit))
    };
    let error = Some((Severity::Error, 1.0));
    let warning = Some((Severity::Warning, 1.0));
    let upper = [
        (Interval::new(0.5, 0.2, 0.9), None, None),
        (Interval::new(1.0, 1.0, 1.0), None, None),
        (Interval::new(0.5, 0.2, 1.1), None, warning),
        (Interval::new(1.1, 0.2, 1.2), None, error),
        (Interval::new(0.5, 0.2, 0.9), Some(0.6), None),
        (Interval::new(0.7, 0.7, 0.7), Some(0.6), Some((Severity::Warning, 0.6))),
        (Interval::new(1.1, 1.1, 1.1), Some(0.6), error),
        (Interval::new(f64::NAN, 0.0, 0.0), None, error),
    ];
    for (measured, warn, wanted) in upper {
        assert_eq!(judged(Code::P301, measured, warn), wanted, "{measured:?} {warn:?}");
    }
    let lower = [
        (Interval::new(1.5, 1.2, 1.9), None),
        (Interval::new(1.5, 0.9, 1.9), warning),
        (Interval::new(0.9, 0.2, 1.9), error),
    ];
    for (measured, wanted) in lower {
        assert_eq!(judged(Code::C201, measured, None), wanted, "{measured:?}");
    }
}

/// One finding per code, strand, phase and bodies; it speaks for the worst and counts the rest.
#[test]
fn findings_fold_into_the_worst() {
    let mut findings = Findings::default();
    for (value, time_s) in [(1.2, 1.0), (1.7, 2.0), (1.4, 3.0), (0.5, 4.0)] {
        at(&mut findings, Code::P301, value, 3, time_s);
    }
    at(&mut findings, Code::P301, 1.1, 4, 0.5);
    let told = findings.sorted();
    assert_eq!(told.len(), 2);
    assert_eq!((told[1].measured.nominal, told[1].count, told[1].time_s), (1.7, 3, Some(2.0)));
    assert_eq!(told[1].message, "1.7");
    assert_eq!((told[0].site.strand, told[0].count), (Some(4), 1));
    // An error speaks before a warning of a larger value.
    let mut findings = Findings::default();
    note(
        &mut findings,
        Code::C201,
        Interval::new(1.1, 0.1, 2.0),
        (1.0, None),
        Site::default(),
        None,
    );
    note(&mut findings, Code::C201, Interval::exact(0.9), (1.0, None), Site::default(), None);
    note(
        &mut findings,
        Code::C201,
        Interval::new(1.05, 0.0, 2.0),
        (1.0, None),
        Site::default(),
        None,
    );
    let told = findings.sorted();
    assert_eq!((told.len(), told[0].severity, told[0].count), (1, Severity::Error, 3));
    // Other bodies or another phase: another finding.
    for site in [Site::default().between(["nozzle", "a"]), Site::default().during(Phase::Retract)] {
        note(&mut findings, Code::C201, Interval::exact(0.9), (1.0, None), site, None);
    }
    assert_eq!(findings.sorted().len(), 3);
}

#[test]
fn findings_are_told_by_severity_then_time_then_code() {
    let mut findings = Findings::default();
    note(
        &mut findings,
        Code::P301,
        Interval::new(0.5, 0.0, 2.0),
        (1.0, None),
        Site::default(),
        Some(0.0),
    );
    at(&mut findings, Code::S401, 2.0, 0, 5.0);
    at(&mut findings, Code::P303, 2.0, 0, 5.0);
    at(&mut findings, Code::P303, 2.0, 1, 1.0);
    note(&mut findings, Code::S406, Interval::exact(2.0), (1.0, None), Site::default(), None);
    let told: Vec<_> =
        findings.sorted().iter().map(|found| (found.code, found.site.strand)).collect();
    let wanted = [
        (Code::P303, Some(1)),
        (Code::P303, Some(0)),
        (Code::S401, Some(0)),
        (Code::S406, None),
        (Code::P301, None),
    ];
    assert_eq!(told, wanted);
}

proptest! {
    /// However measurements are shared out between collectors, absorbing them in order gives what
    /// one collector would have found.
    #[test]
    fn absorbing_parts_is_collecting_the_whole(
        values in prop::collection::vec((0usize..3, 0usize..3, 0.0..2.0f64, 0.0..0.5f64), 1..40),
        cut in 0usize..40,
    ) {
        let codes = [Code::P301, Code::C201, Code::R105];
        let mut whole = Findings::default();
        let mut parts = [Findings::default(), Findings::default()];
        for (k, &(code, strand, value, doubt)) in values.iter().enumerate() {
            let measured = Interval::new(value, value - doubt, value + doubt);
            for findings in [&mut whole, &mut parts[usize::from(k >= cut)]] {
                let site = Site::strand(strand, 0.0);
                note(findings, codes[code], measured, (1.0, None), site, Some(k as f64));
            }
        }
        let [mut first, second] = parts;
        first.absorb(second);
        prop_assert_eq!(first.sorted(), whole.sorted());
        prop_assert_eq!(first.scores(), whole.scores());
        prop_assert_eq!(first.verdict(), whole.verdict());
    }
}
