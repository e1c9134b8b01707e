//! A process that draws and dies, hangs or works: the report is whole all the same.

use std::io::{Read as _, stdin, stdout};
use std::path::Path;
use std::time::Duration;

use cli::Screen;
use render::Drawer;

use crate::tools::{root, scratch};

/// This very test binary, as the process that draws.
fn drawer(child: &str, patience: Duration) -> Drawer {
    let program = std::env::current_exe().expect("a test runs from a file");
    let args = ["--exact", child, "--ignored", "--nocapture"];
    Drawer { program, args: args.map(Into::into).to_vec(), patience }
}

#[test]
#[ignore = "the child of another test: draws what it is asked for"]
fn child_that_draws() {
    render::serve(stdin().lock(), stdout().lock()).expect("our own messages");
}

#[test]
#[ignore = "the child of another test: a driver that takes its process with it in mid-frame"]
fn child_that_aborts() {
    if stdin().read(&mut [0; 64]).is_ok_and(|n| n > 0) {
        std::process::abort();
    }
}

#[test]
#[ignore = "the child of another test: a driver that hangs"]
fn child_that_hangs() {
    if stdin().read(&mut [0; 64]).is_ok_and(|n| n > 0) {
        std::thread::sleep(Duration::from_secs(60));
    }
}

struct Ran {
    code: u8,
    err: String,
    report: serde_json::Value,
}

fn check(name: &str, drawer: Option<Drawer>, more: &[&str]) -> Ran {
    let folder = scratch(name);
    let job = root().join("scenarios/two-strands/job.slam").display().to_string();
    let out_folder = folder.display().to_string();
    let args = ["twin", "check", &job, "--out", &out_folder];
    let args = args.iter().chain(more).map(Into::into);
    let (mut out, mut err) = (Vec::new(), Vec::new());
    let mut screen = Screen { drawer, ..Screen::quiet(&mut out, &mut err) };
    let code = cli::run_on(args, &mut screen);
    let text = std::fs::read_to_string(folder.join("report.json")).expect("a report");
    let report = serde_json::from_str(&text).expect("a whole report");
    no_temporary_files(&folder);
    if !more.contains(&"--no-render") {
        image::open(folder.join("picture.png")).expect("a whole picture");
    }
    Ran { code, err: String::from_utf8_lossy(&err).into_owned(), report }
}

fn no_temporary_files(folder: &Path) {
    for entry in std::fs::read_dir(folder).expect("the folder is there").flatten() {
        let name = entry.file_name().to_string_lossy().into_owned();
        assert!(!name.ends_with(".tmp") && !name.ends_with(".part"), "{name} was left behind");
    }
}

fn drawn_by(ran: &Ran) -> &str {
    ran.report["provenance"]["drawn_by"].as_str().unwrap_or("nobody")
}

#[test]
fn a_process_of_its_own_draws() {
    let ran =
        check("apart", Some(drawer("isolated::child_that_draws", Duration::from_secs(120))), &[]);
    assert!(!drawn_by(&ran).contains("lost"), "{}", drawn_by(&ran));
}

/// Neither verdict nor score nor exit code know whether anything was drawn.
#[test]
fn a_crash_or_a_hang_of_the_driver_changes_no_answer() {
    let bare = check("bare", None, &["--no-render"]);
    for (child, patience_s) in
        [("isolated::child_that_aborts", 60), ("isolated::child_that_hangs", 1)]
    {
        let ran = check("lost", Some(drawer(child, Duration::from_secs(patience_s))), &[]);
        assert_eq!(ran.code, bare.code, "{}", ran.err);
        assert!(drawn_by(&ran).contains("the process that draws was lost"), "{}", drawn_by(&ran));
        for key in ["verdict", "score", "findings", "strands", "stages", "loads", "totals"] {
            assert_eq!(ran.report[key], bare.report[key], "{key}");
        }
    }
}
