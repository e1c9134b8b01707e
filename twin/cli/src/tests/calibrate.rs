//! `twin calibrate`.

use slam::Source;
use slam::material_file::{self, MaterialFile, SettingFile, Status};

use super::{assert_refused, folder, twin, write};
use crate::{FEASIBLE, FOUND};

const PLA: &str = r#"cell = "kr6-hot-end"
material = "pla"

[[free_hang]]
diameter_mm = 1.21
sd_mm = 0.02

[[bridge]] # drawn, so that no over-feed hides the slack
span_mm = 60
speed_mm_s = 3
diameter_mm = 1.1
sag_mm = 1.42
sd_mm = 0.04

[[bridge]]
span_mm = 30
speed_mm_s = 10
diameter_mm = 1.1
sag_mm = 0.9
sd_mm = 0.04

[[cantilever]]
length_mm = 100
speed_mm_s = 5
diameter_mm = 1.1
end_miss_mm = 0.15
sd_mm = 0.02
"#;

const RESIN: &str = r#"cell = "kirkman-sda10d"
material = "sla-resin-silica"

[[cured_depth]]
dose_mj_cm2 = 40
depth_mm = 0.265
sd_mm = 0.008

[[cured_depth]]
dose_mj_cm2 = 160
depth_mm = 0.57
sd_mm = 0.017
"#;

fn read(path: &std::path::Path) -> (String, MaterialFile) {
    let text = std::fs::read_to_string(path).expect("it was written");
    let source = Source::new("written", text.clone());
    (text, material_file::parse(&source).expect("a material"))
}

#[test]
fn a_thermoplastic_is_fitted_written_and_read_back() {
    let dir = folder("calibrate-pla");
    let file = write(&dir, "m.toml", PLA);
    let out = dir.join("mine.toml");
    let done = twin(["calibrate", &file, "--out", &out.display().to_string()]);
    println!("{}", done.out);
    assert_eq!(done.code, FEASIBLE, "{}{}", done.out, done.err);
    for words in ["viscosity-cooling lump", "slack, %", "swell = [", "next print: ", "material  "] {
        assert!(done.out.contains(words), "{words} in {}", done.out);
    }
    assert!(!done.out.contains("not informed") && !done.out.contains("DOES NOT FIT"));
    let (text, material) = read(&out);
    assert!(text.starts_with("# Fitted by `twin calibrate`") && text.contains("# PLA, unfilled."));
    let cte = &material.cte_per_k;
    assert_eq!(cte.status, Status::Measured);
    assert_eq!(cte.source, format!("twin calibrate of {file}"));
    assert!(cte.low < cte.value && cte.value < cte.high && (cte.high - cte.low) < 3e-5);
    let SettingFile::Thermoplastic { viscosity, glass_c, .. } = &material.setting else {
        panic!("a thermoplastic")
    };
    assert_eq!((viscosity.status, glass_c.status), (Status::Measured, Status::Found));
    assert!(viscosity.factor_low > 0.34 && viscosity.factor_high < 2.9);
    // The written file is a material like any other: it can be calibrated again, by its path.
    let again = write(&dir, "again.toml", PLA.replace("\"pla\"", "\"./mine.toml\""));
    assert_eq!(twin(["calibrate", &again]).code, FEASIBLE);
}

#[test]
fn a_resin_gets_its_working_curve() {
    let dir = folder("calibrate-resin");
    let file = write(&dir, "m.toml", RESIN);
    let out = dir.join("mine.toml");
    let done = twin(["calibrate", &file, "-o", &out.display().to_string()]);
    println!("{}", done.out);
    assert_eq!(done.code, FEASIBLE, "{}{}", done.out, done.err);
    assert!(done.out.contains("not informed by these prints"));
    let (_, material) = read(&out);
    let SettingFile::Photopolymer { penetration_m, critical_exposure_j_m2, .. } = &material.setting
    else {
        panic!("a photopolymer")
    };
    // Two depths give 0.305 mm / ln 4 and 40 mJ/cm² exp(−0.265/0.22) in closed form, the prior a little less.
    for (number, closed) in [(penetration_m, 2.2e-4), (critical_exposure_j_m2, 120.0)] {
        assert_eq!(number.status, Status::Measured);
        assert!(number.low < closed && closed < number.high, "{number:?}");
        assert!((number.value / closed - 1.0).abs() < 0.1, "{number:?}");
    }
}

#[test]
fn a_print_that_does_not_fit_is_told_and_found() {
    let dir = folder("calibrate-misfit");
    let twice = "\n[[free_hang]]\ndiameter_mm = 1.5\nsd_mm = 0.02\n";
    let file = write(&dir, "m.toml", format!("{PLA}{twice}{twice}"));
    let done = twin(["calibrate", &file]);
    assert_eq!(done.code, FOUND, "{}{}", done.out, done.err);
    assert!(done.out.contains("DOES NOT FIT") && done.out.contains("past its range"));
    assert!(!done.out.contains("material  "));
}

#[test]
fn what_cannot_be_calibrated_is_refused_at_its_place() {
    let dir = folder("calibrate-refused");
    let refused = |text: String, place: &str, words: &[&str]| {
        let file = write(&dir, "m.toml", text);
        assert_refused(&twin(["calibrate", &file]), &format!("{file}:{place}"), words);
    };
    refused(PLA.replace("kr6-hot-end", "kr6-hot-and"), "1:8", &["did you mean `kr6-hot-end`?"]);
    refused(PLA.replace("\"pla\"", "\"plo\""), "2:12", &["did you mean `pla`?"]);
    refused(RESIN.replace("sla-resin-silica", "pla"), "2:12", &["no photopolymer"]);
    refused(PLA.replace("sag_mm = 0.9", "sag_mm = -1"), "19:10", &["`sag_mm`"]);
    let missing = dir.join("none.toml").display().to_string();
    assert_refused(&twin(["calibrate", &missing]), &format!("{missing}:1:1"), &["no such file"]);
    let file = write(&dir, "m.toml", PLA);
    let nowhere = format!("{file}/folder.toml");
    assert_refused(
        &twin(["calibrate", &file, "--out", &nowhere]),
        &format!("{nowhere}:1:1"),
        &["cannot be made"],
    );
}
