//! Files that are no jobs, and jobs that name files that cannot be used.

use std::fs::File;
use std::path::{Path, PathBuf};

use super::{SOUND, assert_none, check, faults, library_file, nothing_written, place_of, write};
use crate::tools::scratch;

/// What is broken; how it is made, in a folder (the answer: the path to check, and place
/// `FILE:LINE:COLUMN` below that folder); words of the message.
type Case = (&'static str, fn(&Path) -> (PathBuf, String), &'static [&'static str]);

const FILES: [Case; 14] = [
    ("not there", |dir| (dir.join("none.slam"), "none.slam:1:1".into()), &["no such file"]),
    ("folder", |dir| (dir.to_owned(), ":1:1".into()), &["folder"]),
    ("empty", |dir| job(dir, "", "1:1"), &["empty"]),
    ("blank", |dir| job(dir, "\n  // nothing\n", "1:1"), &["empty"]),
    ("a list", |dir| job(dir, "[1, 2]", "1:1"), &["a job is an object"]),
    ("a gigabyte", sparse, &["1024.0 MiB", "64 MiB"]),
    ("binary", |dir| job(dir, b"\x7fELF\x02\x01\x01\0\0\xff\xfe", "1:10"), &["UTF-8"]),
    ("UTF-16", |dir| job(dir, b"\xff\xfe{\0\"\0", "1:1"), &["UTF-8"]),
    (
        "Latin-1 in a name",
        |dir| job(dir, b"{ \"slam\": 1,\n\"name\": \"Tr\xe4ger\" }", "2:12"),
        &["UTF-8"],
    ),
    ("lists in lists", |dir| job(dir, "[".repeat(100_000), "1:33"), &["nested deeper than 32"]),
    ("objects in objects", |dir| job(dir, "{\"a\":".repeat(50_000), "1:161"), &["nested deeper"]),
    (
        "commas",
        |dir| job(dir, format!("[{}]", "0,".repeat(31_000_000)), "1:60000003"),
        &["30000000 values", "split the job"],
    ),
    (
        "a key of a megabyte",
        |dir| job(dir, format!("{{ \"slam\": 1, {:?}: 1 }}", "k".repeat(1 << 20)), "1:14"),
        &["unknown key"],
    ),
    ("zeros", |dir| job(dir, [0; 4096], "1:1"), &["NUL"]),
];

#[test]
fn files_that_are_no_jobs() {
    let mut all = Vec::new();
    for (name, make, words) in FILES {
        let folder = scratch("no-job");
        let (path, place) = make(&folder);
        let out = scratch("no-job-out");
        let ran = check(&path, &out, None);
        let place = if place.starts_with(':') {
            format!("{}{place}", folder.display())
        } else {
            folder.join(place).display().to_string()
        };
        all.extend(faults(name, &ran, &place, words));
        nothing_written(name, &out);
    }
    assert_none(&all);
}

const NAMED: [Case; 24] = [
    ("form above", |dir| form(dir, "../mould.stl"), &["leads out of the job's folder"]),
    ("form by absolute path", |dir| form(dir, "/etc/passwd"), &["leads out of the job's folder"]),
    ("form not there", |dir| form(dir, "none.stl"), &["no such file"]),
    (
        "form is a folder",
        |dir| form_of(dir, "sub", &|path| std::fs::create_dir(path).expect("a folder")),
        &["folder"],
    ),
    ("form by a link out", linked, &["link leads out"]),
    (
        "STL cut short",
        |dir| stl(dir, b"solid\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 9"),
        &["line 5"],
    ),
    (
        "binary STL cut short",
        |dir| stl(dir, &[&[0; 80][..], &2_u32.to_le_bytes(), &[0; 60]].concat()),
        &["promises 2 triangles"],
    ),
    (
        "STL with NaN",
        |dir| stl(dir, b"solid\nfacet normal 0 0 1\nouter loop\nvertex nan 0 0\n"),
        &["not finite"],
    ),
    ("STL without triangles", |dir| stl(dir, b"solid s\nendsolid s\n"), &["no triangle"]),
    (
        "STL of a billion triangles",
        |dir| stl(dir, &[&[0; 80][..], &u32::MAX.to_le_bytes()].concat()),
        &["4294967295"],
    ),
    (
        "material upside down",
        |dir| material(dir, "low = 1220.0", "low = 1250.0", "[density_kg_m3]"),
        &["density_kg_m3", "low end 1250"],
    ),
    (
        "material of no density",
        |dir| material(dir, "value = 1240.0", "value = 0.0", "0.0"),
        &["must be more than 0"],
    ),
    ("material with nan", |dir| material(dir, "value = 3.5e9", "value = nan", "nan"), &["finite"]),
    (
        "material without Poisson",
        |dir| material(dir, "[poisson]", "[poison]", "poison]"),
        &["poisson"],
    ),
    (
        "material with a text",
        |dir| material(dir, "value = 1240.0", "value = \"much\"", "\"much\""),
        &["expected a number"],
    ),
    (
        "material that melts too late",
        |dir| {
            material(
                dir,
                "value = 60.0\nlow = 55.0\nhigh = 65.0",
                "value = 260.0\nlow = 255.0\nhigh = 265.0",
                "[setting.thermoplastic.glass_c]",
            )
        },
        &["glass_c"],
    ),
    (
        "cell without a tool",
        |dir| cell(dir, "tool = \"slim-cone\"", "tool = \"slim-con\"", "\"slim-con\""),
        &["did you mean `slim-cone`?"],
    ),
    ("cell without TOML", |dir| cell(dir, "name = \"kr10-cone\"", "name = = 1", "= 1"), &["TOML"]),
    (
        "cell with an unknown key",
        |dir| cell(dir, "home_deg", "home_dg", "home_dg"),
        &["did you mean `home_deg`?"],
    ),
    (
        "cell with a limit of zero",
        |dir| cell(dir, "clearance_mm = 1.0", "clearance_mm = 0", "0 # uncal"),
        &["clearance_mm"],
    ),
    (
        "cell with five joints",
        |dir| {
            cell_at(
                dir,
                "home_deg = [0, -90, 90, 0, 90, 0]",
                "home_deg = [0, -90]",
                "job.slam:4:11",
            )
        },
        &["home"],
    ),
    ("robot cut short", |dir| robot(dir, "</robot>", "", "<robot"), &["robot"]),
    (
        "robot with a DOCTYPE",
        |dir| {
            robot(
                dir,
                "<robot name",
                "<!DOCTYPE r [<!ENTITY e SYSTEM \"file:///etc/passwd\">]>\n<robot name",
                "<!DOCTYPE",
            )
        },
        &["DOCTYPE"],
    ),
    (
        "robot with a limit of text",
        |dir| robot(dir, "<limit lower=\"", "<limit lower=\"low", "low-"),
        &["not a number"],
    ),
];

#[test]
fn jobs_that_name_what_cannot_be_used() {
    let mut all = Vec::new();
    for (name, make, words) in NAMED {
        let folder = scratch("naming");
        let (path, place) = make(&folder);
        let ran = check(&path, &folder.join("out"), None);
        all.extend(faults(name, &ran, &folder.join(place).display().to_string(), words));
        nothing_written(name, &folder.join("out"));
    }
    assert_none(&all);
}

#[test]
fn a_library_with_a_broken_file_is_refused_in_that_file() {
    let library = scratch("library");
    let text = library_file("materials/pla.toml").replacen("high = 1260.0", "high = 1230.0", 1);
    let file = write(&library, "materials/pla.toml", &text);
    let folder = scratch("of-library");
    let path = write(&folder, "job.slam", SOUND);
    let ran = check(&path, &folder.join("out"), Some(&library));
    let place = format!("{}:{}", file.display(), place_of(&text, "[density_kg_m3]"));
    assert_none(&faults("library", &ran, &place, &["high end 1230"]));
    nothing_written("library", &folder.join("out"));
    let ran = check(&path, &folder.join("out"), Some(&folder));
    assert_none(&faults("no library", &ran, &format!("{}:1:1", folder.display()), &["no library"]));
}

/// Not refused: the arm is there, one shape of it is not, and the user is told.
#[test]
fn a_robot_without_one_of_its_meshes_is_checked_with_a_warning() {
    let folder = scratch("meshless");
    let (path, _) = robot(
        &folder,
        "<link name=\"tool0\"/>",
        "<link name=\"tool0\"><collision><geometry><mesh filename=\"package://maker/a.stl\"/></geometry></collision></link>",
        "<robot",
    );
    let ran = check(&path, &folder.join("out"), None);
    assert!(ran.code <= 1, "{}", ran.err);
    assert!(ran.err.contains(": warning: mesh package://maker/a.stl is left out"), "{}", ran.err);
    assert!(ran.err.contains("hint: say where the package lies"), "{}", ran.err);
}

fn job(dir: &Path, bytes: impl AsRef<[u8]>, place: &str) -> (PathBuf, String) {
    (write(dir, "job.slam", bytes), format!("job.slam:{place}"))
}

fn sparse(dir: &Path) -> (PathBuf, String) {
    let path = dir.join("job.slam");
    File::create(&path).and_then(|file| file.set_len(1 << 30)).expect("a sparse file");
    (path, "job.slam:1:1".into())
}

/// The sound job with a form of this mesh; the place is that of the mesh's name.
fn form(dir: &Path, mesh: &str) -> (PathBuf, String) {
    let form = format!("\"forms\": [{{ \"id\": \"mould\", \"mesh\": {mesh:?} }}],\n  \"strands\"");
    let text =
        SOUND.replace("\"strands\"", &form).replacen("\"on\": \"bed\"", "\"on\": \"mould\"", 1);
    job(dir, &text, &place_of(&text, &format!("{mesh:?}")))
}

fn form_of(dir: &Path, mesh: &str, make: &dyn Fn(&Path)) -> (PathBuf, String) {
    make(&dir.join(mesh));
    form(dir, mesh)
}

fn stl(dir: &Path, bytes: &[u8]) -> (PathBuf, String) {
    form_of(dir, "mould.stl", &|path| std::fs::write(path, bytes).expect("a mesh"))
}

#[cfg(unix)]
fn linked(dir: &Path) -> (PathBuf, String) {
    form_of(dir, "link.stl", &|path| {
        std::os::unix::fs::symlink("/etc/passwd", path).expect("a link")
    })
}

#[cfg(not(unix))]
fn linked(dir: &Path) -> (PathBuf, String) {
    // no links without rights there; the message is that of the test's table all the same
    let (path, place) = form(dir, "../a link leads out.stl");
    (path, place)
}

/// A file of the library with one thing replaced, and the place of something in what became of it.
fn broken(dir: &Path, original: &str, name: &str, [from, to, at]: [&str; 3]) -> String {
    let text = library_file(original);
    assert!(text.contains(from), "{original} has no {from}");
    let text = text.replacen(from, to, 1);
    write(dir, name, &text);
    format!("{name}:{}", place_of(&text, at))
}

fn material(dir: &Path, from: &str, to: &str, at: &str) -> (PathBuf, String) {
    let place = broken(dir, "materials/pla.toml", "mine.toml", [from, to, at]);
    (write(dir, "job.slam", SOUND.replace("\"pla\"", "\"mine.toml\"")), place)
}

fn cell(dir: &Path, from: &str, to: &str, at: &str) -> (PathBuf, String) {
    let place = broken(dir, "robots/cells/kr10-cone.toml", "mine.toml", [from, to, at]);
    (write(dir, "job.slam", SOUND.replace("kr10-cone", "mine.toml")), place)
}

/// A cell that is sound by itself but does not fit its robot: the job that names it is refused.
fn cell_at(dir: &Path, from: &str, to: &str, place: &str) -> (PathBuf, String) {
    let (path, _) = cell(dir, from, to, to);
    (path, place.to_owned())
}

fn robot(dir: &Path, from: &str, to: &str, at: &str) -> (PathBuf, String) {
    let place =
        broken(dir, "robots/kuka/kr10_r1100_sixx/robot.urdf", "arm/robot.urdf", [from, to, at]);
    write(dir, "arm/robot.toml", library_file("robots/kuka/kr10_r1100_sixx/robot.toml"));
    let (path, _) = cell(dir, "\"kuka/kr10_r1100_sixx\"", "\"arm/robot.urdf\"", "robot");
    (path, place)
}
