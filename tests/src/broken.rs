//! Input that cannot be used: every one is refused with its place and a hint, none half-answered.

mod files;

use std::path::{Path, PathBuf};

use crate::tools::{Ran, root, scratch, twin};

/// A sound job; each case below breaks one thing in it.
const SOUND: &str = r#"{
  "slam": 1,
  "name": "broken",
  "cell": "kr10-cone",
  "material": "pla",
  "process": { "speed_mm_s": 4 },
  "strands": [
    { "id": "a", "points_mm": [[0, 0, 1], [60, 0, 1]], "on": "bed" },
    { "id": "b", "points_mm": [[0, 10, 1], [60, 10, 1]], "on": "bed" }
  ]
}
"#;

/// What is broken, the text that is replaced, what by, line and column, a word of the message.
type Edit = (&'static str, &'static str, &'static str, &'static str, &'static str);

const EDITS: [Edit; 43] = [
    ("comma missing", "\"slam\": 1,", "\"slam\": 1", "2:12", "comma"),
    ("brace missing", "  ]\n}\n", "  ]\n", "1:1", "closed"),
    ("quote missing", "\"broken\"", "\"broken", "3:11", "not closed"),
    ("quotes single", "\"broken\"", "'broken'", "3:11", "double quotes"),
    ("key without quotes", "\"name\"", "name", "3:3", "double quotes"),
    ("comment open", "\"slam\": 1,", "\"slam\": 1, /* ", "2:14", "never closed"),
    ("text after the end", "]\n}", "]\n} {}", "11:3", "after the end"),
    ("control character", "broken", "bro\u{1}ken", "3:11", "control character"),
    ("NUL", "broken", "bro\0ken", "3:15", "NUL"),
    ("byte order mark", "{\n  \"slam\"", "\u{feff}{\n  \"slam\"", "1:1", "byte order mark"),
    ("NaN", "\"speed_mm_s\": 4", "\"speed_mm_s\": NaN", "6:30", "finite"),
    ("Infinity", "\"speed_mm_s\": 4", "\"speed_mm_s\": -Infinity", "6:30", "finite"),
    ("too large", "\"speed_mm_s\": 4", "\"speed_mm_s\": 1e999", "6:30", "too large"),
    ("too large in a point", "[60, 0, 1]", "[1e999, 0, 1]", "8:44", "too large"),
    ("null", "\"speed_mm_s\": 4", "\"speed_mm_s\": null", "6:30", "leave the key out"),
    ("unknown key", "\"material\"", "\"materiel\"", "5:3", "did you mean \"material\"?"),
    ("key of nobody", "\"process\": {", "\"process\": { \"zzz\": 1,", "6:16", "unknown key"),
    ("unit m/s", "speed_mm_s", "speed_m_s", "6:16", "did you mean \"speed_mm_s\"?"),
    ("unit missing", "speed_mm_s", "speed", "6:16", "did you mean \"speed_mm_s\"?"),
    (
        "unit of a length",
        "\"id\": \"a\", \"points_mm\"",
        "\"id\": \"a\", \"points_m\"",
        "8:18",
        "points_mm",
    ),
    ("key twice", "\"speed_mm_s\": 4", "\"speed_mm_s\": 4, \"speed_mm_s\": 5", "6:33", "twice"),
    ("key missing", "  \"name\": \"broken\",\n", "", "1:1", "lacks the key \"name\""),
    ("other version", "\"slam\": 1,", "\"slam\": 2,", "2:11", "version 2"),
    ("no version", "  \"slam\": 1,\n", "", "1:1", "\"slam\": 1"),
    ("unknown cell", "kr10-cone", "kr10-con", "4:11", "did you mean `kr10-cone`?"),
    ("unknown material", "\"pla\"", "\"plo\"", "5:15", "did you mean `pla`?"),
    (
        "unknown form",
        "1]], \"on\": \"bed\" },",
        "1]], \"on\": \"mould\" },",
        "8:62",
        "no form \"mould\"",
    ),
    (
        "unknown strand",
        "\"on\": \"bed\" },",
        "\"start\": { \"join\": \"c\" } },",
        "8:75",
        "no form or strand \"c\"",
    ),
    (
        "unknown output",
        "\"on\": \"bed\" },",
        "\"events\": [{ \"at_mm\": 1, \"set\": \"siren\", \"to\": \"on\" }] },",
        "8:88",
        "no output `siren`",
    ),
    ("name of a device", "\"pla\"", "\"../../etc/passwd\"", "5:15", "passwd"),
    ("zero speed", "\"speed_mm_s\": 4", "\"speed_mm_s\": 0", "6:30", "speed_mm_s is 0"),
    ("negative speed", "\"speed_mm_s\": 4", "\"speed_mm_s\": -4", "6:30", "speed_mm_s is -4"),
    ("speed as text", "\"speed_mm_s\": 4", "\"speed_mm_s\": \"fast\"", "6:30", "a number"),
    ("flow level", "\"speed_mm_s\": 4", "\"flow\": { \"level\": 9 }", "6:24", "no flow level 9"),
    (
        "two flows",
        "\"speed_mm_s\": 4",
        "\"flow\": { \"diameter_mm\": 3, \"level\": 1 }",
        "6:24",
        "exactly one",
    ),
    ("points coincide", "[60, 0, 1]]", "[0, 0, 1]]", "8:43", "coincides"),
    ("one point", "[[0, 0, 1], [60, 0, 1]]", "[[0, 0, 1]]", "8:31", "at least 2"),
    ("point in a plane", "[60, 0, 1]", "[60, 0]", "8:43", "three numbers"),
    ("id twice", "\"id\": \"b\"", "\"id\": \"a\"", "9:13", "already taken"),
    ("id reserved", "\"id\": \"b\"", "\"id\": \"bed\"", "9:13", "cannot be an id"),
    (
        "joints of another arm",
        "\"on\": \"bed\" },",
        "\"joints\": [[1, 2], [3, 4]] },",
        "8:66",
        "6 joints",
    ),
    ("times run back", "\"on\": \"bed\" },", "\"times_s\": [1, 0] },", "8:67", "is not after"),
    (
        "direction of no length",
        "\"on\": \"bed\" },",
        "\"directions\": [[0, 0, 0], [0, 0, -1]] },",
        "8:71",
        "no length",
    ),
];

#[test]
fn the_job_that_is_broken_below_is_sound() {
    let folder = scratch("sound");
    let job = write(&folder, "job.slam", SOUND);
    let ran = check(&job, &folder.join("out"), None);
    assert!(ran.code <= 1, "{}", ran.err);
    assert!(folder.join("out/report.json").is_file());
}

#[test]
fn jobs_with_one_thing_broken() {
    let mut all = Vec::new();
    for (name, from, to, place, word) in EDITS {
        assert!(SOUND.contains(from), "{name}: the sound job has no {from}");
        let folder = scratch("edited");
        let job = write(&folder, "job.slam", SOUND.replacen(from, to, 1));
        let ran = check(&job, &folder.join("out"), None);
        all.extend(faults(name, &ran, &format!("{}:{place}", job.display()), &[word]));
        nothing_written(name, &folder.join("out"));
    }
    assert_none(&all);
}

#[test]
fn all_problems_of_a_job_are_told_at_once() {
    let folder = scratch("many");
    let text = SOUND
        .replace("speed_mm_s", "speed_m_s")
        .replace("[60, 0, 1]", "[0, 0, 1]")
        .replace("\"b\"", "\"a\"");
    let job = write(&folder, "job.slam", text);
    let ran = check(&job, &folder.join("out"), None);
    for place in ["6:16", "8:43", "9:13"] {
        assert_none(&faults("many", &ran, &format!("{}:{place}", job.display()), &[]));
    }
}

/// What a refusal lacks: exit code 2, the place, a hint, the words, and no panic behind it.
fn faults(name: &str, ran: &Ran, place: &str, words: &[&str]) -> Vec<String> {
    let place = format!("{place}: error: ");
    let tests = [
        (ran.code == 2, "exit code 2"),
        (ran.err.contains(&place), &place),
        (ran.err.contains("\n  hint: "), "a hint"),
        (!ran.err.contains("bug of twin"), "no panic"),
        (!ran.err.contains(|c: char| c.is_control() && c != '\n'), "no control characters"),
        (ran.err.len() < 20_000, "a complaint that can be read"),
    ];
    let words = words.iter().map(|word| (ran.err.contains(word), *word));
    let lacking = tests.into_iter().chain(words).filter(|(holds, _)| !holds);
    let told: String = ran.err.chars().take(600).collect();
    lacking
        .map(|(_, what)| format!("{name}: not {what:?}, code {}, in\n{told}", ran.code))
        .collect()
}

#[track_caller]
fn assert_none(faults: &[String]) {
    assert!(faults.is_empty(), "{} faults\n{}", faults.len(), faults.join("\n"));
}

/// No answer, and no half of one.
fn nothing_written(name: &str, out: &Path) {
    let n_files = std::fs::read_dir(out).into_iter().flatten().count();
    assert_eq!(n_files, 0, "{name}: something lies in {}", out.display());
}

fn write(folder: &Path, name: &str, bytes: impl AsRef<[u8]>) -> PathBuf {
    let path = folder.join(name);
    std::fs::create_dir_all(path.parent().expect("a folder")).expect("a folder for the test");
    std::fs::write(&path, bytes).expect("a file for the test");
    path
}

fn check(job: &Path, out: &Path, library: Option<&Path>) -> Ran {
    let mut args = vec![
        "check".as_ref(),
        job.as_os_str(),
        "--no-render".as_ref(),
        "--out".as_ref(),
        out.as_os_str(),
    ];
    args.extend(
        library.into_iter().flat_map(|library| ["--library".as_ref(), library.as_os_str()]),
    );
    twin(args)
}

/// A file of the project's own library.
fn library_file(path: &str) -> String {
    std::fs::read_to_string(root().join(path)).expect("a file of the library")
}

/// Line and column of the first place of a text, as messages give them.
fn place_of(text: &str, what: &str) -> String {
    let at = text.find(what).expect("it is there");
    let line_start = text[..at].rfind('\n').map_or(0, |newline| newline + 1);
    let line = text[..at].matches('\n').count() + 1;
    format!("{line}:{}", text[line_start..at].chars().count() + 1)
}
