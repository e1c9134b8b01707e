//! Rules about the source that the compiler cannot see.

use std::fs;
use std::path::{Path, PathBuf};

use crate::tools::root;

/// The architecture of `sim` as a table: each module, and what it may use.
const MAY_USE: [(&str, &[&str]); 24] = [
    ("interval", &[]),
    ("pose", &[]),
    ("parry", &["pose"]),
    ("shape", &["parry", "pose"]),
    ("scene", &["shape", "parry", "pose"]),
    ("kinematics", &["pose"]),
    ("timing", &["kinematics", "pose"]),
    ("dynamics", &["kinematics", "pose"]),
    ("process", &["interval", "pose"]),
    ("calibration", &["process", "interval"]),
    ("structure", &["interval", "pose"]),
    ("validation", &["structure", "process", "interval", "pose"]),
    ("finding", &["interval", "pose"]),
    ("cell", &["finding", "dynamics", "kinematics", "process", "shape", "interval", "pose"]),
    ("toolpath", &["cell", "parry", "pose"]),
    (
        "motion",
        &[
            "clearance",
            "deposit",
            "timing",
            "dynamics",
            "toolpath",
            "kinematics",
            "finding",
            "cell",
            "interval",
            "pose",
        ],
    ),
    ("program", &["toolpath", "motion", "kinematics", "finding", "cell", "interval", "pose"]),
    ("deposit", &["toolpath", "pose"]),
    ("clearance", &["deposit", "kinematics", "cell", "shape", "parry", "pose"]),
    ("collision", &["clearance", "deposit", "motion", "finding", "cell", "interval", "pose"]),
    (
        "growth",
        &[
            "structure",
            "deposit",
            "motion",
            "toolpath",
            "process",
            "finding",
            "cell",
            "interval",
            "pose",
        ],
    ),
    ("aftermath", &["structure", "parry", "pose"]),
    (
        "preflight",
        &[
            "aftermath",
            "program",
            "dynamics",
            "scene",
            "program",
            "growth",
            "collision",
            "deposit",
            "motion",
            "toolpath",
            "structure",
            "process",
            "finding",
            "cell",
            "kinematics",
            "shape",
            "interval",
            "pose",
        ],
    ),
    (
        "film",
        &[
            "preflight",
            "scene",
            "growth",
            "structure",
            "deposit",
            "motion",
            "process",
            "finding",
            "interval",
            "kinematics",
            "cell",
            "shape",
            "pose",
        ],
    ),
];

/// No file is longer than this.
const LINES_MAX: usize = 600;

/// What `source`, a file of `module`, uses against the table.
fn forbidden_uses(module: &str, source: &str) -> Vec<String> {
    let may_use = |name: &str| MAY_USE.iter().find(|row| row.0 == name).map(|row| row.1);
    let Some(allowed) = may_use(module) else {
        return vec![format!("{module} is not in the table")];
    };
    source
        .split("crate::")
        .skip(1)
        .map(|rest| rest.split(|c: char| !c.is_alphanumeric() && c != '_').next().unwrap_or(""))
        .filter(|name| *name != module && !allowed.contains(name))
        .map(|name| match may_use(name) {
            Some(_) => format!("{module} must not use {name}"),
            None => format!("{module}: name one module after `crate::`, not `{name}`"),
        })
        .collect()
}

#[test]
fn the_table_of_modules_finds_what_it_should() {
    let check = |module, source, found: &[&str]| assert_eq!(forbidden_uses(module, source), found);
    check("collision", "use crate::deposit::Deposit;", &[]);
    check("collision", "use crate::process::simulate;", &["collision must not use process"]);
    check("cell", "use crate::{pose::Pose};", &["cell: name one module after `crate::`, not ``"]);
}

#[test]
fn modules_of_sim_only_look_where_they_may() {
    let sim = root().join("twin/sim/src");
    let mut problems = Vec::new();
    for file in rust_files(&sim) {
        let inside = file.strip_prefix(&sim).expect("a file of sim");
        let first =
            inside.components().next().expect("a name").as_os_str().to_string_lossy().into_owned();
        let module = first.trim_end_matches(".rs");
        let is_test = inside.iter().any(|part| part.to_string_lossy().starts_with("tests"));
        if module == "lib" || module == "test_job" || is_test {
            continue;
        }
        let text = fs::read_to_string(&file).expect("a source file can be read");
        let uses = forbidden_uses(module, &text);
        problems.extend(uses.into_iter().map(|problem| format!("{}: {problem}", inside.display())));
    }
    assert!(problems.is_empty(), "\n{}", problems.join("\n"));
}

#[test]
fn files_are_short() {
    let mut long = Vec::new();
    for folder in ["twin", "tests"] {
        for file in rust_files(&root().join(folder)) {
            let n_lines =
                fs::read_to_string(&file).expect("a source file can be read").lines().count();
            if n_lines > LINES_MAX {
                long.push(format!("{}: {n_lines} lines", file.display()));
            }
        }
    }
    assert!(long.is_empty(), "longer than {LINES_MAX} lines:\n{}", long.join("\n"));
}

/// Every code has a title, a unit and a page that says more than its name.
#[test]
fn the_register_of_codes_is_complete() {
    for code in sim::finding::Code::ALL {
        let page = code.page();
        assert!(page.contains(code.as_str()), "{code:?}: the page does not name its code");
        assert!(page.lines().count() >= 10, "{code:?}: the page says nothing");
        assert_eq!(sim::finding::Code::from_name(code.as_str()), Some(code));
        assert!(!code.title().is_empty() && !code.unit().is_empty());
    }
}

/// ARCHITECTURE.md names every crate and every module of `sim`, and stays short.
#[test]
fn the_architecture_is_told() {
    let text =
        fs::read_to_string(root().join("twin/ARCHITECTURE.md")).expect("twin/ARCHITECTURE.md");
    assert!(text.lines().count() < 200, "ARCHITECTURE.md is longer than 200 lines");
    for name in ["slam", "sim", "plan", "report", "render", "cli"] {
        assert!(
            text.contains(&format!("`{name}`")),
            "ARCHITECTURE.md does not name the crate {name}"
        );
    }
    for (name, _) in MAY_USE {
        assert!(
            text.contains(&format!("`{name}`")),
            "ARCHITECTURE.md does not name the module {name}"
        );
    }
}

/// `sim` does no IO and hides no randomness.
#[test]
fn sim_does_no_io() {
    const FORBIDDEN: [&str; 6] =
        ["std::fs", "std::env", "std::time", "std::net", "println!", "SystemTime"];
    for file in rust_files(&root().join("twin/sim/src")) {
        let is_test = file.iter().any(|part| part.to_string_lossy().starts_with("tests"))
            || file.file_name().is_some_and(|name| name == "reference.rs" || name == "test_job.rs");
        let text = fs::read_to_string(&file).expect("a source file can be read");
        for word in FORBIDDEN.iter().filter(|_| !is_test) {
            assert!(!text.contains(word), "{} uses {word}", file.display());
        }
    }
}

fn rust_files(folder: &Path) -> Vec<PathBuf> {
    let mut files = Vec::new();
    let mut folders = vec![folder.to_owned()];
    while let Some(folder) = folders.pop() {
        for entry in
            fs::read_dir(&folder).expect("a folder of the workspace").filter_map(Result::ok)
        {
            let path = entry.path();
            if path.is_dir() {
                folders.push(path);
            } else if path.extension().is_some_and(|extension| extension == "rs") {
                files.push(path);
            }
        }
    }
    files.sort();
    files
}
