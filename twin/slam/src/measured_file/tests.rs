use super::{AirFile, parse};
use crate::Source;

const GOOD: &str = r#"cell = "kr6-hot-end"
material = "pla"

[[free_hang]]
diameter_mm = 1.22
sd_mm = 0.03

[[bridge]]
span_mm = 60
speed_mm_s = 4
diameter_mm = 1.1
sag_mm = 0.7
sd_mm = 0.05

[[bridge]]
span_mm = 60
flow_mm3_s = 9.5
sag_mm = 0.0
sd_mm = 0.05

[[cantilever]]
length_mm = 100
end_miss_mm = 0.21
sd_mm = 0.02

[[cured_depth]]
dose_mj_cm2 = 40
depth_mm = 0.31
sd_mm = 0.01
"#;

fn said(text: &str) -> String {
    let source = Source::new("m.toml", text);
    let problems = parse(&source).expect_err(text);
    problems.iter().map(|problem| format!("{}\n", source.plain(problem))).collect()
}

#[test]
fn a_file_is_read_with_its_defaults() {
    let file = parse(&Source::new("m.toml", GOOD)).expect("a good file");
    assert_eq!((file.cell.as_str(), file.material.as_str()), ("kr6-hot-end", "pla"));
    assert_eq!(file.slack, [0.0, -0.005, 0.005]);
    assert_eq!(file.air, AirFile { air_c: 23.0, air_m_s: 0.0 });
    assert_eq!((file.free_hang.len(), file.bridge.len()), (1, 2));
    assert_eq!(file.bridge[0].speed_mm_s, Some(4.0));
    assert_eq!((file.bridge[1].speed_mm_s, file.bridge[1].flow_mm3_s), (None, Some(9.5)));
    assert_eq!((file.cantilever[0].dwell_s, file.cured_depth[0].dose_mj_cm2), (0.0, 40.0));
}

#[test]
fn every_problem_is_told_at_its_place() {
    let text = GOOD
        .replace("sd_mm = 0.03", "sd_mm = 0")
        .replace("speed_mm_s = 4", "speed_mm_s = 4\nflow_mm3_s = 3")
        .replace("length_mm = 100", "length_mm = nan")
        .replace("depth_mm = 0.31", "depth_mm = -1");
    let all = said(&text);
    for (place, words) in [
        ("m.toml:6:9", "`sd_mm` must be more than 0"),
        ("m.toml:11:14", "both a flow and a bead"),
        ("m.toml:23:13", "`length_mm` must be a finite number"),
        ("m.toml:29:12", "`depth_mm` must be from 0 to 10000"),
    ] {
        let line = all.lines().find(|line| line.starts_with(place));
        assert!(line.is_some_and(|line| line.contains(words)), "{place} {words} in\n{all}");
    }
}

#[test]
fn what_cannot_be_meant_is_refused() {
    for (from, to, words) in [
        ("material = \"pla\"", "", "`material`"),
        ("material = \"pla\"", "material = \"\"", "name the material"),
        ("span_mm = 60", "spam_mm = 60", "did you mean `span_mm`?"),
        ("sag_mm = 0.7", "sag_mm = \"much\"", "expected a number"),
        ("cell =", "slack = [0, 0.1, 0.2]\ncell =", "its low end 0.1 is above"),
        ("cell =", "slack = [0, -1, 1]\ncell =", "must be above -0.5"),
        ("[[free_hang]]", "[air]\nair_c = 300\n[[free_hang]]", "`air_c` must be from -50 to 200"),
        ("[[cured_depth]]", "[[cured_dept]]", "did you mean `cured_depth`?"),
    ] {
        let text = GOOD.replacen(from, to, 1);
        assert!(said(&text).contains(words), "{words} in {}", said(&text));
    }
    assert!(said("cell = \"a\"\nmaterial = \"b\"\n").contains("m.toml:1:1: error: no print"));
}

proptest::proptest! {
    #[test]
    fn no_text_panics(text in "\\PC{0,200}", at in 0..GOOD.len(), cut in 0..40_usize) {
        let _ = parse(&Source::new("t", text));
        if GOOD.is_char_boundary(at) {
            let torn = format!("{}{}", &GOOD[..at], &GOOD[(at + cut).min(GOOD.len())..]);
            let _ = parse(&Source::new("t", torn));
        }
    }
}
