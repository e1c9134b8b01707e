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
        "above the second",
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
    (Kind::Tool, "robots/tools/kirkman-nozzle.toml", "leds = 24", "leds = 0", "more than 0"),
    (
        Kind::Tool,
        "robots/tools/small-hot-end.toml",
        "centre_mm = [0, 0, -90]",
        "centre_mm = [0, 0, nan]",
        "finite",
    ),
    (
        Kind::Tool,
        "robots/tools/kirkman-nozzle.toml",
        "orifice_diameter_mm = 3.0",
        "centre_mm = [0, 0, -90]\norifice_diameter_mm = 3.0",
        "a centre of mass, but no mass",
    ),
    (
        Kind::Robot,
        "robots/kuka/kr6_r900_sixx/robot.toml",
        "payload_kg = 6.0",
        "payload_centre_mm = [0, 0, 80]",
        "a centre of the payload, but no payload",
    ),
    (
        Kind::Cell,
        "robots/cells/kirkman-sda10d.toml",
        "mass_kg = 1.0",
        "mass_kg = -1.0",
        "more than 0",
    ),
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

/// A cell of the library with tables added at its end.
fn with_tables(tables: &str) -> Source {
    let path = "/../../robots/cells/kr6-hot-end.toml";
    let path = format!("{}{path}", env!("CARGO_MANIFEST_DIR"));
    let text = std::fs::read_to_string(path).expect("a cell of the library");
    // The tables that stand there already make room for those of the test.
    let kept: Vec<&str> = text.split("\n[").filter(|table| !is_equipment(table)).collect();
    Source::new("cell", format!("{}\n{tables}", kept.join("\n[")))
}

fn is_equipment(table: &str) -> bool {
    ["controller]", "calibration]", "[hose]]", "[carried]]"].iter().any(|t| table.starts_with(t))
}

const HOSE: &str = "[[hose]]\nname = \"h\"\nlink = \"link_3\"\nat_mm = [0, 0, 100]\ntool_at_mm = [0, 0, -120]\nlength_mm = 800\nradius_mm = 8\n";
const FEEDER: &str = "[[carried]]\nname = \"feeder\"\nlink = \"link_3\"\nshape = { box = { size_mm = [80, 80, 80], xyz_mm = [0, 0, 150] } }\n";

#[test]
fn equipment_may_be_left_out() {
    let cell = cell_file::parse(&with_tables("")).expect("a cell without equipment");
    assert_eq!(cell.controller, cell_file::ControllerFile::default());
    assert!(cell.hose.is_empty() && cell.carried.is_empty() && cell.calibration.is_none());
    assert_eq!((cell.limits.speed_band_percent, cell.limits.cycle_time_s), (10.0, None));
    let tables =
        format!("{HOSE}{FEEDER}[controller]\nblend_mm = 2\n[calibration]\ntool_mm = 0.3\n");
    let source = with_tables(&tables);
    let cell = cell_file::parse(&source).unwrap_or_else(|p| panic!("{}", said(&source, &p)));
    assert_eq!((cell.controller.blend_mm, cell.controller.joint_move_percent), (2.0, 100.0));
    assert_eq!((cell.hose[0].length_mm, cell.hose[0].twist_deg), (800.0, None));
    assert_eq!(cell.carried[0].link, "link_3");
    let calibration = cell.calibration.expect("the table is there");
    assert_eq!((calibration.tool_mm, calibration.form_deg), (0.3, 0.1));
}

#[test]
fn impossible_equipment_is_refused_at_its_place() {
    let controller = |line: &str| format!("[controller]\n{line}\n");
    let calibration = |line: &str| format!("[calibration]\n{line}\n");
    let hose = |good: &str, bad: &str| HOSE.replacen(good, bad, 1);
    let cases = [
        (controller("acceleration_mm_s2 = 0"), "= 0", "more than 0"),
        (controller("jerk_mm_s3 = -5"), "= -5", "more than 0"),
        (controller("blend_mm = -1"), "= -1", "not be negative"),
        (controller("joint_move_percent = 150"), "= 150", "at most 100"),
        (controller("joint_acceleration_percent = 0"), "= 0", "above 0"),
        (controller("acceleration = 3"), "acceleration = 3", "unknown key"),
        (calibration("tool_mm = -0.1"), "= -0.1", "from 0 to 100"),
        (calibration("base_deg = 45"), "= 45", "from 0 to 10"),
        (hose("length_mm = 800", "length_mm = 0"), "length_mm = 0", "more than 0"),
        (hose("radius_mm = 8", "radius_mm = 900"), "radius_mm", "wider than its length"),
        (hose("radius_mm = 8", "twist_deg = -90\nradius_mm = 8"), "= -90", "more than 0"),
        (hose("at_mm = [0, 0, 100]", "at_mm = [0, nan, 100]"), "nan", "finite"),
        (hose("\"link_3\"", "\"\""), "link =", "empty"),
        (format!("{HOSE}{HOSE}"), "name = \"h\"", "two hoses named `h`"),
        (format!("{FEEDER}{FEEDER}"), "\"feeder\"", "two carried bodies named `feeder`"),
        (FEEDER.replacen("[80, 80, 80]", "[80, 0, 80]", 1), "size_mm", "more than 0"),
    ];
    for (tables, at, word) in cases {
        let source = with_tables(&tables);
        let found = problems(Kind::Cell, &source);
        let line = source.text.lines().count() - tables.lines().count()
            + tables
                .lines()
                .enumerate()
                .filter(|(_, line)| line.contains(at))
                .last()
                .map_or(0, |(k, _)| k + 1);
        let hit = found.iter().any(|problem| {
            source.line_column(problem.span.start).0 == line && problem.message.contains(word)
        });
        assert!(hit, "{tables}at line {line}:\n{}", said(&source, &found));
    }
    let limits = [
        ("speed_band_percent = 120", "at most 100"),
        ("torque_percent = 0", "above 0"),
        ("cycle_time_s = 0", "more than 0"),
    ];
    for (line, word) in limits {
        let key = line.split(' ').next().expect("a key");
        let text = with_tables("").text;
        let others: Vec<&str> = text.lines().filter(|line| !line.starts_with(key)).collect();
        let text = others.join("\n").replace("sag_mm = 1.0", &format!("{line}\nsag_mm = 1.0"));
        let source = Source::new("cell", text);
        let said = said(&source, &problems(Kind::Cell, &source));
        assert!(said.contains(word), "{line}: {said}");
    }
}
