use std::path::{Path, PathBuf};

use crate::{Diagnostic, Source, cell_file, material_file, robot_file, tool_file};

fn library(folder: &str) -> Vec<(PathBuf, Source)> {
    let root = Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../..")).join(folder);
    let mut files = Vec::new();
    collect(&root, &mut files);
    files.sort();
    assert!(!files.is_empty(), "no .toml under {}", root.display());
    let read = |path: PathBuf| {
        let text = std::fs::read_to_string(&path).expect("a file of the library");
        (path.clone(), Source::new(path.display().to_string(), text))
    };
    files.into_iter().map(read).collect()
}

fn collect(folder: &Path, files: &mut Vec<PathBuf>) {
    for entry in std::fs::read_dir(folder).expect("a folder of the library").flatten() {
        let path = entry.path();
        if path.is_dir() {
            collect(&path, files);
        } else if path.extension().is_some_and(|extension| extension == "toml") {
            files.push(path);
        }
    }
}

fn said(source: &Source, problems: &[Diagnostic]) -> String {
    problems.iter().map(|problem| format!("{}\n", source.plain(problem))).collect()
}

#[test]
fn every_file_of_the_library_is_accepted() {
    for (path, source) in library("materials") {
        let material =
            material_file::parse(&source).unwrap_or_else(|p| panic!("{}", said(&source, &p)));
        assert_eq!(Some(material.name.as_str()), path.file_stem().and_then(|stem| stem.to_str()));
    }
    for (path, source) in library("robots") {
        let problems = match path.parent().and_then(Path::file_name).and_then(|name| name.to_str())
        {
            Some("cells") => cell_file::parse(&source).err(),
            Some("tools") => tool_file::parse(&source).err(),
            _ => robot_file::parse(&source).err(),
        };
        assert!(problems.is_none(), "{}", said(&source, &problems.unwrap_or_default()));
    }
}

#[derive(Clone, Copy)]
enum Kind {
    Cell,
    Tool,
    Robot,
    Material,
}

fn problems(kind: Kind, source: &Source) -> Vec<Diagnostic> {
    match kind {
        Kind::Cell => cell_file::parse(source).err(),
        Kind::Tool => tool_file::parse(source).err(),
        Kind::Robot => robot_file::parse(source).err(),
        Kind::Material => material_file::parse(source).err(),
    }
    .unwrap_or_default()
}

/// What is broken: kind, file, the line as it stands, the line as broken, a word of the message.
const BROKEN: &[(Kind, &str, &str, &str, &str)] = &[
    (
        Kind::Cell,
        "robots/cells/kr6-hot-end.toml",
        "travel_mm_s = 50",
        "travel_mm_s = 0",
        "more than 0",
    ),
    (
        Kind::Cell,
        "robots/cells/kr6-hot-end.toml",
        "travel_mm_s = 50",
        "travel_mms = 50",
        "unknown key",
    ),
    (
        Kind::Cell,
        "robots/cells/kr6-hot-end.toml",
        "size_mm = [600, 600, 20]",
        "size_mm = [600, -1, 20]",
        "more than 0",
    ),
    (Kind::Cell, "robots/cells/kr6-hot-end.toml", "tip = \"tool0\"", "tip = \"\"", "empty"),
    (
        Kind::Cell,
        "robots/cells/kr6-hot-end.toml",
        "tip = \"tool0\"",
        "tip = \"base_link\"",
        "same link",
    ),
    (
        Kind::Cell,
        "robots/cells/kr6-hot-end.toml",
        "mode = \"tool-on-flange\"",
        "mode = \"tool-on-flang\"",
        "unknown word",
    ),
    (Kind::Cell, "robots/cells/kr6-hot-end.toml", "sag_mm = 1.0", "sag_mm = 0.0", "more than 0"),
    (Kind::Cell, "robots/cells/kr6-hot-end.toml", "sag_mm = 1.0", "sag_mm = nan", "finite"),
    (
        Kind::Cell,
        "robots/cells/kr6-hot-end.toml",
        "condition_number = [17, 30]",
        "condition_number = [30, 17]",
        "warns",
    ),
    (
        Kind::Cell,
        "robots/cells/kr6-hot-end.toml",
        "io = []",
        "gravity_m_s2 = [0, 0, -9810]",
        "gravity",
    ),
    (
        Kind::Cell,
        "robots/cells/kr6-hot-end.toml",
        "swell = [1.058, 1.0, 1.15]",
        "swell = [1.058, 1.1, 1.15]",
        "low end",
    ),
    (
        Kind::Tool,
        "robots/tools/small-hot-end.toml",
        "orifice_diameter_mm = 1.2",
        "orifice_diameter_mm = 0",
        "more than 0",
    ),
    (Kind::Tool, "robots/tools/small-hot-end.toml", "nozzle = true", "nozzle = false", "nozzle"),
    (Kind::Tool, "robots/tools/kirkman-nozzle.toml", "leds = 8", "leds = 0", "more than 0"),
    (
        Kind::Robot,
        "robots/kuka/kr6_r900_sixx/robot.toml",
        "accuracy_mm = 0.5",
        "accuracy_mm = -0.5",
        "more than 0",
    ),
    (
        Kind::Robot,
        "robots/kuka/kr6_r900_sixx/robot.toml",
        "branch_type = \"opw\"",
        "branch_type = \"owp\"",
        "unknown word",
    ),
    (Kind::Material, "materials/abs.toml", "value = 1040.0", "value = 1060.0", "high end"),
    (Kind::Material, "materials/abs.toml", "low = 1030.0", "low = -3", "more than 0"),
    (Kind::Material, "materials/abs.toml", "high = 0.39", "high = 0.5", "below 0.5"),
    (Kind::Material, "materials/abs.toml", "high = 0.6", "high = 1.6", "at most 1"),
    (Kind::Material, "materials/abs.toml", "a1 = 27.322", "a1 = inf", "finite"),
    (Kind::Material, "materials/abs.toml", "a1 = 27.322", "a1 = = 2", ""),
];

#[test]
fn every_broken_line_is_named() {
    for &(kind, file, good, bad, word) in BROKEN {
        let path = Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../..")).join(file);
        let text = std::fs::read_to_string(&path).expect("a file of the library");
        let at = text.find(good).unwrap_or_else(|| panic!("{file} lacks {good}"));
        let line = text[..at].lines().count() + usize::from(text[..at].ends_with('\n'));
        let source = Source::new(file, text.replacen(good, bad, 1));
        let found = problems(kind, &source);
        let hit = found.iter().any(|problem| {
            let near = source.line_column(problem.span.start).0;
            // A table's own place is its header, above the number that breaks its order; a part
            // list's is its first part.
            let above = matches!(word, "high end" | "nozzle") && near <= line && near + 5 > line;
            (near == line || above) && problem.message.contains(word)
        });
        assert!(hit, "{bad} at line {line}:\n{}", said(&source, &found));
    }
}

#[test]
fn all_problems_are_told_at_once_with_hints() {
    let (_, source) = library("robots/cells").swap_remove(1);
    let text = source
        .text
        .replace("travel_mm_s", "travel_mms")
        .replace("diameter_mm = ", "diametre_mm = ");
    let source = Source::new("cell", text.replace("sag_mm = 1.0", "sag_mm = 0"));
    let said = said(&source, &problems(Kind::Cell, &source));
    assert!(said.contains("did you mean `travel_mm_s`?"), "{said}");
    assert!(said.contains("did you mean `diameter_mm`?"), "{said}");
    assert!(said.contains("`sag_mm` must be more than 0"), "{said}");
    assert!(!said.contains("missing"), "{said}");
}

#[test]
fn a_missing_key_is_named_with_its_table() {
    let source = Source::new("tool", "name = \"a\"\nsource = \"ours\"\norifice_diameter_mm = 1\n");
    let said = said(&source, &problems(Kind::Tool, &source));
    assert!(said.contains("`part` is missing"), "{said}");
}
