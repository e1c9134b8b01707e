//! The program without a process: command lines in, text and exit code out.

mod calibrate;
mod jobs;
mod robots;
mod solve;
mod targets;
mod validate;

use std::ffi::OsString;
use std::path::{Path, PathBuf};

use crate::{FEASIBLE, REFUSED};

/// What the program did.
struct Done {
    code: u8,
    out: String,
    err: String,
}

fn twin<S: Into<OsString>>(args: impl IntoIterator<Item = S>) -> Done {
    let (mut out, mut err) = (Vec::new(), Vec::new());
    let args = std::iter::once("twin".into()).chain(args.into_iter().map(Into::into));
    let code = crate::run(args, &mut out, &mut err);
    let text = |bytes| String::from_utf8(bytes).expect("the program writes UTF-8");
    Done { code, out: text(out), err: text(err) }
}

/// A folder of its own for one test, emptied first.
fn folder(name: &str) -> PathBuf {
    let folder = std::env::temp_dir().join(format!("twin-cli-{name}-{}", std::process::id()));
    let _ = std::fs::remove_dir_all(&folder);
    std::fs::create_dir_all(&folder).expect("a folder for the test");
    folder
}

fn write(folder: &Path, name: &str, text: impl AsRef<[u8]>) -> String {
    let path = folder.join(name);
    std::fs::write(&path, text).expect("a file for the test");
    path.display().to_string()
}

/// The refusal contract: exit 2 and a line `name:line:column: error: …` for each of the words.
fn assert_refused(done: &Done, place: &str, words: &[&str]) {
    assert_eq!(done.code, REFUSED, "{}{}", done.out, done.err);
    assert!(done.err.contains(&format!("{place}: error: ")), "{place} in {}", done.err);
    for word in words {
        assert!(done.err.contains(word), "{word} in {}", done.err);
    }
}

#[test]
fn what_clap_refuses_exits_with_2() {
    for args in [vec![], vec!["fly"], vec!["check"], vec!["check", "a", "--fail-on", "x"]] {
        let done = twin(args.clone());
        assert_eq!(done.code, REFUSED, "{args:?}");
        assert!(done.err.contains("--help") && done.out.is_empty(), "{}", done.err);
    }
}

#[test]
fn help_and_version_are_answers() {
    let done = twin(["--version"]);
    assert_eq!(
        (done.code, done.out.trim()),
        (FEASIBLE, concat!("twin ", env!("CARGO_PKG_VERSION")))
    );
    let commands =
        ["check", "plan", "calibrate", "inspect", "explain", "schema", "validate", "doctor"];
    for command in commands {
        let done = twin([command, "--help"]);
        assert_eq!(done.code, FEASIBLE);
        assert!(done.out.contains("Usage: twin"), "{command}: {}", done.out);
    }
}

#[test]
fn explain_knows_its_codes() {
    let all = twin(["explain"]);
    assert_eq!(all.code, FEASIBLE);
    for code in sim::finding::Code::ALL {
        assert!(all.out.contains(code.as_str()));
        let page = twin(["explain", code.as_str()]);
        assert_eq!(page.code, FEASIBLE);
        assert!(page.out.contains(code.page().trim_end()));
    }
    assert_refused(&twin(["explain", "C299"]), "CODE:1:1", &["C299", "C201"]);
}

#[test]
fn schemas_are_json_with_an_address() {
    for format in ["job", "report"] {
        let done = twin(["schema", format]);
        assert_eq!(done.code, FEASIBLE);
        let schema: serde_json::Value = serde_json::from_str(&done.out).expect("JSON");
        assert_eq!(schema["$schema"], "https://json-schema.org/draft/2020-12/schema");
    }
}

#[test]
fn doctor_reads_the_whole_library() {
    let done = twin(["doctor"]);
    assert_eq!(done.code, FEASIBLE);
    assert!(
        !done.out.contains("BROKEN") && !done.out.contains("FAILS"),
        "{}{}",
        done.out,
        done.err
    );
    for name in ["kuka/kr10_r1100_sixx", "kr10-cone", "slim-cone", "pla-carbon"] {
        assert!(done.out.contains(name), "{name} in {}", done.out);
    }
}

#[cfg(unix)]
#[test]
fn a_pipe_stays_a_pipe_and_gets_the_bytes() {
    use std::os::unix::fs::FileTypeExt as _;
    let pipe = folder("pipe").join("pipe");
    let made = std::process::Command::new("mkfifo").arg(&pipe).status().expect("mkfifo");
    assert!(made.success());
    let reader = std::thread::spawn({
        let pipe = pipe.clone();
        move || std::fs::read(pipe).expect("the pipe can be read")
    });
    crate::files::write_whole(&pipe, b"plan").expect("it is written");
    // Looked at before joining: were the pipe gone, its reader would wait for ever.
    assert!(std::fs::symlink_metadata(&pipe).expect("there").file_type().is_fifo());
    assert_eq!(reader.join().expect("read"), b"plan");
}

#[cfg(unix)]
#[test]
fn a_recording_does_not_take_the_place_of_a_device() {
    let link = folder("device").join("run.mcap");
    std::os::unix::fs::symlink("/dev/null", &link).expect("linked");
    let refused = crate::files::write_by(&link, |_| unreachable!("nothing is written"));
    assert!(refused.expect_err("refused").sentences().contains("a device or a pipe"));
    assert!(std::fs::symlink_metadata(&link).expect("there").is_symlink());
}

#[cfg(unix)]
#[test]
fn a_link_stays_a_link_and_what_it_names_is_written() {
    let folder = folder("link");
    let (link, file) = (folder.join("link"), folder.join("file"));
    std::fs::write(&file, "old").expect("written");
    std::os::unix::fs::symlink(&file, &link).expect("linked");
    crate::files::write_whole(&link, b"new").expect("it is written");
    assert!(std::fs::symlink_metadata(&link).expect("there").is_symlink());
    assert_eq!(std::fs::read(&file).expect("read"), b"new");
    assert_eq!(std::fs::read_dir(&folder).expect("listed").count(), 2);
}
