//! Answers that would be lost are refused before the work.

use super::{assert_refused, folder, twin, write};
use crate::REFUSED;

const JOB: &str = r#"{ "slam": 1, "name": "t", "cell": "kr6-hot-end", "material": "pla",
  "strands": [{ "id": "a", "on": "bed", "points_mm": [[0, 0, 1], [20, 0, 1]] }] }"#;

#[test]
fn no_answer_goes_over_an_input_or_another_answer() {
    let dir = folder("targets");
    let job = write(&dir, "job.slam", JOB);
    let out = dir.join("out").display().to_string();
    let file = dir.join("x.stl").display().to_string();
    let over = |args: &[&str]| {
        let all = args.iter().map(|arg| (*arg).to_owned());
        let done = twin(all);
        assert_eq!(done.code, REFUSED, "{args:?}: {}{}", done.out, done.err);
        assert_eq!(std::fs::read_to_string(&job).expect("there"), JOB, "{args:?}");
        assert!(!std::path::Path::new(&out).join("report.json").exists(), "{args:?}: worked on");
        done
    };
    let check = ["check", &job, "--no-render", "--out", &out];
    let with = |more: &[&str]| over(&[&check[..], more].concat());
    assert_refused(&with(&["--report", &format!("sarif={job}")]), &format!("{job}:1:1"), &["read"]);
    assert_refused(
        &with(&["--report", &format!("sarif={file},junit={file}")]),
        &format!("{file}:1:1"),
        &["two answers"],
    );
    with(&["--report", &format!("sarif={out}/report.json")]);
    with(&["--record", &file, &file]);
    with(&["--report", &format!("sarif={}", dir.display())]);
    over(&["render", &job, "-o", &job]);
    over(&["render", &job, "-o", &dir.join("a.jpg").display().to_string()]);
    over(&["map", &job, "-o", &job]);
    // a link is what it leads to
    let link = dir.join("link.slam");
    std::os::unix::fs::symlink(&job, &link).expect("linked");
    with(&["--report", &format!("sarif={}", link.display())]);
}

#[test]
fn folders_of_answers_are_made() {
    let dir = folder("made");
    let job = write(&dir, "job.slam", JOB);
    let (out, deep) = (dir.join("a/out"), dir.join("b/c/twin.xml"));
    let report = format!("junit={}", deep.display());
    let out = out.display().to_string();
    let done =
        twin(["check", &job, "--no-render", "--no-pages", "--out", &out, "--report", &report]);
    assert!(done.code <= 1, "{}", done.err);
    assert!(deep.exists());
    let unknown = twin(["check", &job, "--report", "bogus"]);
    assert_eq!(unknown.code, REFUSED);
    assert!(unknown.err.contains("sarif") && unknown.err.contains("junit"), "{}", unknown.err);
}

#[test]
fn a_baseline_of_another_job_is_told() {
    let dir = folder("other");
    let job = write(&dir, "job.slam", JOB);
    let other = write(&dir, "other.slam", JOB.replace("\"t\"", "\"another\""));
    let out = |name: &str| dir.join(name).display().to_string();
    let first = twin(["check", &job, "--no-render", "--no-pages", "--out", &out("one")]);
    let base = format!("{}/report.json", out("one"));
    let args = ["--no-render", "--no-pages", "--out", &out("two"), "--baseline", &base];
    let same = twin([&["check", &job][..], &args].concat());
    assert!(!same.err.contains("another job"), "{}{}", same.err, first.err);
    let differs = twin([&["check", &other][..], &args].concat());
    assert!(differs.err.contains("the baseline is of another job, `t`"), "{}", differs.err);
}
