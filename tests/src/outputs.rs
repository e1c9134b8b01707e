//! What `twin check` leaves behind: forms for CI systems, recordings, pages; and what happens where they cannot be written.

use std::path::{Path, PathBuf};

use cli::{GitHub, Screen};

use crate::tools::{root, scratch, twin};

fn scenario(name: &str) -> String {
    root().join("scenarios").join(name).display().to_string()
}

fn read(path: &Path) -> String {
    std::fs::read_to_string(path).unwrap_or_else(|e| panic!("{}: {e}", path.display()))
}

/// The names in a folder, in order.
fn names(folder: &Path) -> Vec<String> {
    let entries = std::fs::read_dir(folder).expect("the folder is there").flatten();
    let mut names: Vec<String> =
        entries.map(|entry| entry.file_name().to_string_lossy().into_owned()).collect();
    names.sort();
    names
}

#[test]
fn every_form_and_every_recording_is_written() {
    let folder = scratch("forms");
    let file = |name: &str| folder.join(name).display().to_string();
    let out = folder.join("out");
    let (job, junit) = (scenario("two-strands/job.slam"), format!("junit={}", file("mine.xml")));
    let (mcap, rrd) = (file("run.mcap"), file("run.rrd"));
    let (glb, stl) = (file("part.glb"), file("part.stl"));
    let ran = twin([
        "check",
        &job,
        "--no-render",
        "--out",
        &out.display().to_string(),
        "--report",
        &format!("sarif,gitlab,markdown,concise,github,{junit}"),
        "--record",
        &mcap,
        &rrd,
        &glb,
        &stl,
    ]);
    assert!(ran.code <= 1, "{}", ran.err);
    assert_eq!(names(&folder), ["mine.xml", "out", "part.glb", "part.stl", "run.mcap", "run.rrd"]);
    for name in ["report.html", "report.json", "twin.sarif", "gitlab.json", "report.md"] {
        assert!(names(&out).iter().any(|there| there == name), "{name} of {:?}", names(&out));
        assert!(ran.out.contains(&out.join(name).display().to_string()), "{name}: {}", ran.out);
    }
    let sarif: serde_json::Value =
        serde_json::from_str(&read(&out.join("twin.sarif"))).expect("JSON");
    assert_eq!(sarif["version"], "2.1.0");
    let begins = |path: &str, with: &[u8]| {
        let bytes = std::fs::read(path).expect("a recording");
        assert!(bytes.starts_with(with), "{path} begins with {:?}", &bytes[..16]);
    };
    begins(&mcap, b"\x89MCAP0\r\n");
    begins(&rrd, b"RRF");
    begins(&glb, b"glTF");
    let facets = std::fs::read(&stl).expect("a part");
    let count = u32::from_le_bytes(facets[80..84].try_into().expect("four bytes"));
    assert_eq!(facets.len(), 84 + 50 * count as usize);
    assert!(count > 0);
}

#[test]
fn recordings_of_no_known_kind_are_refused_before_the_work() {
    let ran = twin(["check", &scenario("two-strands/job.slam"), "--record", "run.avi"]);
    assert_eq!(ran.code, 2);
    assert!(ran.err.contains(".mcap, .rrd, .glb or .stl"), "{}", ran.err);
    let ran = twin(["check", &scenario("two-strands/job.slam"), "--report", "pdf"]);
    assert_eq!(ran.code, 2);
}

/// A job that fails does not fail against itself, and a better one differs from it.
#[test]
fn a_baseline_lets_pass_what_is_known() {
    let (past, near) =
        (scenario("near-miss-c201/past.slam"), scenario("near-miss-c201/within.slam"));
    let folder = scratch("baseline");
    let check = |job: &str, name: &str, more: &[&str]| -> (u8, PathBuf) {
        let out = folder.join(name);
        let text = out.display().to_string();
        let args = ["check", job, "--no-render", "--no-pages", "--out", &text];
        (twin(args.iter().chain(more)).code, out.join("report.json"))
    };
    let (code, known) = check(&past, "past", &[]);
    assert_eq!(code, 1);
    let baseline = known.display().to_string();
    assert_eq!(check(&past, "again", &["--baseline", &baseline]).0, 0);
    let (code, better) = check(&near, "near", &[]);
    assert_eq!(code, 0);
    let better = better.display().to_string();
    assert_eq!(check(&past, "worse", &["--baseline", &better]).0, 1);
    let ran = twin(["diff", &baseline, &better]);
    assert_eq!(ran.code, 0, "{}", ran.err);
    assert!(ran.out.contains("C201"), "{}", ran.out);
    assert_eq!(twin(["diff", &better, &baseline]).code, 1, "the second has an error more");
    let ran = twin(["diff", &past, &better]);
    assert_eq!(ran.code, 2, "a job is no report");
    assert!(ran.err.contains("report.json"), "{}", ran.err);
}

#[test]
fn githubs_runner_gets_annotations_and_a_summary() {
    let folder = scratch("github");
    let summary = folder.join("summary.md");
    std::fs::write(&summary, "of an earlier step\n").expect("writable");
    let (job, out_folder) = (scenario("near-miss-c201/past.slam"), folder.display().to_string());
    let args = ["twin", "check", &job, "--no-render", "--no-pages", "--out", &out_folder];
    let (mut out, mut err) = (Vec::new(), Vec::new());
    let mut screen = Screen {
        github: Some(GitHub { summary: Some(summary.clone()) }),
        ..Screen::quiet(&mut out, &mut err)
    };
    assert_eq!(cli::run_on(args.map(Into::into), &mut screen), 1);
    let out = String::from_utf8(out).expect("text");
    let annotation = out.lines().find(|line| line.starts_with("::error")).expect("an annotation");
    assert!(annotation.contains("C201") && annotation.contains("line="), "{annotation}");
    let text = read(&summary);
    assert!(text.starts_with("of an earlier step\n") && text.contains("C201"), "{text}");
}

#[test]
fn what_cannot_be_written_is_told_and_nothing_is_left_half() {
    let folder = scratch("unwritable");
    let job = scenario("two-strands/job.slam");
    // a folder that nobody may write to, not even root
    let ran = twin(["check", &job, "--no-render", "--out", "/proc/twin"]);
    assert_eq!(ran.code, 2);
    assert!(ran.err.contains("/proc/twin"), "{}", ran.err);
    let out = folder.display().to_string();
    let ran =
        twin(["check", &job, "--no-render", "--out", &out, "--record", "/proc/twin/run.mcap"]);
    assert_eq!(ran.code, 2);
    assert!(ran.err.contains("/proc/twin/run.mcap"), "{}", ran.err);
    assert!(names(&folder).is_empty(), "refused before the work: {:?}", names(&folder));
    // a device, told from a file only when it is written
    let device = scratch("device").join("run.mcap");
    std::os::unix::fs::symlink("/dev/null", &device).expect("linked");
    let device = device.display().to_string();
    let ran = twin(["check", &job, "--no-render", "--out", &out, "--record", &device]);
    assert_eq!(ran.code, 2);
    assert!(ran.err.contains("a device or a pipe"), "{}", ran.err);
    assert!(names(&folder).iter().all(|name| !name.starts_with('.')), "{:?}", names(&folder));
    // the answer was safe before
    let report: serde_json::Value =
        serde_json::from_str(&read(&folder.join("report.json"))).expect("whole");
    assert_eq!(report["name"], "two-strands");
}

/// A finding that the job lets pass fails nothing until its day is over.
#[test]
fn what_is_allowed_does_not_fail_until_its_day() {
    let text = read(&root().join("scenarios/near-miss-c201/past.slam"));
    let folder = scratch("allowed");
    for (until, code) in [("2999-12-31", 0), ("2020-01-31", 1)] {
        let allow = format!(
            "\"slam\": 1, \"allow\": [{{ \"code\": \"C201\", \"reason\": \"a test\", \"until\": \"{until}\" }}],"
        );
        assert!(text.contains("\"slam\": 1,"));
        let job = folder.join("job.slam");
        std::fs::write(&job, text.replacen("\"slam\": 1,", &allow, 1)).expect("writable");
        let (job, out) = (job.display().to_string(), folder.join("out").display().to_string());
        let ran = twin(["check", &job, "--no-render", "--no-pages", "--out", &out]);
        assert_eq!(ran.code, code, "{until}: {}{}", ran.out, ran.err);
        assert!(ran.out.contains("INFEASIBLE"), "{}", ran.out);
    }
}
