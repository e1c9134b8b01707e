//! `twin check` and `twin plan`.

use std::fs::File;

use super::{assert_refused, folder, twin, write};
use crate::{FEASIBLE, FOUND, REFUSED};

fn job(cell: &str, material: &str, more: &str) -> String {
    format!(
        "{{ \"slam\": 1, \"name\": \"one\",\n\"cell\": {cell:?},\n\"material\": {material:?},\n{more}\
         \"strands\": [{{ \"id\": \"a\", \"points_mm\": [[0, 0, 1], [60, 0, 1]], \"on\": \"bed\" }}] }}\n"
    )
}

#[test]
fn unknown_names_are_refused_at_their_place_in_the_job() {
    let dir = folder("names");
    let file = write(&dir, "a.slam", job("kr10-con", "pla", ""));
    let done = twin(["check", &file]);
    assert_refused(&done, &format!("{file}:2:9"), &["did you mean `kr10-cone`?", "printer-3axis"]);
    let file = write(&dir, "b.slam", job("kr10-cone", "plo", ""));
    assert_refused(&twin(["check", &file]), &format!("{file}:3:13"), &["did you mean `pla`?"]);
    let file = write(&dir, "c.slam", job("./mine.toml", "pla", ""));
    assert_refused(&twin(["check", &file]), &format!("{file}:2:9"), &["mine.toml"]);
}

#[test]
fn a_cell_by_path_uses_the_library_and_is_refused_at_its_own_place() {
    let dir = folder("cell");
    let library = crate::library::Library::open(&no_library()).expect("the one in the program");
    let found = library.find(crate::library::Kind::Cell, "kr10-cone").expect("text");
    let text = found.expect("there is one").source.text;
    write(&dir, "mine.toml", text.replace("tool = \"slim-cone\"", "tool = \"slim-con\""));
    let file = write(&dir, "a.slam", job("mine.toml", "pla", ""));
    let line = text.lines().position(|line| line.starts_with("tool = ")).expect("a tool") + 1;
    let place = format!("{}:{line}:8", dir.join("mine.toml").display());
    assert_refused(&twin(["check", &file]), &place, &["did you mean `slim-cone`?"]);
}

fn no_library() -> crate::library::LibraryArgs {
    use clap::Parser;
    #[derive(Parser)]
    struct Only {
        #[command(flatten)]
        library: crate::library::LibraryArgs,
    }
    Only::parse_from(["twin"]).library
}

#[test]
fn files_that_are_no_jobs_are_refused() {
    let dir = folder("broken");
    let binary = write(&dir, "binary.slam", b"{ \"slam\": 1,\n\xff\xfe\x00");
    assert_refused(&twin(["check", &binary]), &format!("{binary}:2:1"), &["UTF-8"]);
    let large = dir.join("large.slam").display().to_string();
    File::create(&large).and_then(|file| file.set_len(1 << 30)).expect("a sparse file");
    assert_refused(&twin(["check", &large]), &format!("{large}:1:1"), &["1024.0 MiB", "64 MiB"]);
    let dir_name = dir.display().to_string();
    assert_refused(&twin(["check", &dir_name]), &format!("{dir_name}:1:1"), &["folder"]);
    assert_refused(&twin(["check", "/nowhere/x.slam"]), "/nowhere/x.slam:1:1", &["no such file"]);
    if cfg!(unix) {
        assert_refused(&twin(["check", "/dev/zero"]), "/dev/zero:1:1", &["device"]);
    }
}

#[test]
fn forms_stay_below_the_job() {
    let dir = folder("forms");
    let inner = dir.join("inner");
    std::fs::create_dir(&inner).expect("a folder");
    let stl = "solid s\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 9 0 0\nvertex 0 9 0\nendloop\nendfacet\nendsolid s\n";
    write(&dir, "out.stl", stl);
    let form = |mesh: &str| format!("\"forms\": [{{ \"id\": \"m\",\n\"mesh\": {mesh:?} }}],\n");
    for mesh in ["../out.stl", "/etc/passwd", "none.stl"] {
        let file = write(&inner, "a.slam", job("kr10-cone", "pla", &form(mesh)));
        assert_refused(&twin(["check", &file]), &format!("{file}:5:9"), &["form `m`"]);
    }
    #[cfg(unix)]
    {
        std::os::unix::fs::symlink(dir.join("out.stl"), inner.join("link.stl")).expect("a link");
        let file = write(&inner, "a.slam", job("kr10-cone", "pla", &form("link.stl")));
        assert_refused(&twin(["check", &file]), &format!("{file}:5:9"), &["link leads out"]);
    }
}

#[test]
fn check_writes_its_report_and_says_where() {
    let dir = folder("check");
    let file = write(&dir, "a.slam", job("kr10-cone", "pla", ""));
    let out = dir.join("out");
    let args = |more: &[&str]| {
        let common =
            ["check", &file, "--no-render", "--jobs", "1", "--out", &out.display().to_string()]
                .map(str::to_owned);
        common.into_iter().chain(more.iter().map(|&each| each.to_owned())).collect::<Vec<_>>()
    };
    let done = twin(args(&[]));
    assert!([FEASIBLE, FOUND].contains(&done.code), "{}", done.err);
    let path = out.join("report.json");
    assert!(done.out.contains(&path.display().to_string()), "{}", done.out);
    let page = out.join("strands.html");
    assert!(done.out.contains(&page.display().to_string()), "{}", done.out);
    assert!(std::fs::read_to_string(&page).expect("a page").contains("Content-Security-Policy"));
    let text = std::fs::read_to_string(&path).expect("a report");
    let report: serde_json::Value = serde_json::from_str(&text).expect("JSON");
    let errors = report["findings"].as_array().expect("findings").iter();
    let n_errors = errors.filter(|finding| finding["severity"] == "error").count();
    assert_eq!(done.code == FOUND, n_errors > 0);
    assert_eq!(report["provenance"]["inputs"][0]["what"], "job");
    let done = twin(args(&["--no-pages", "--format", "json", "--fail-on", "warning"]));
    assert!(!page.exists(), "the page of an earlier check is gone");
    let printed: serde_json::Value = serde_json::from_str(&done.out).expect("JSON");
    assert_eq!(printed["findings"], report["findings"]);
    assert_eq!(
        done.code == FOUND,
        printed["findings"].as_array().is_some_and(|all| !all.is_empty())
    );
}

#[test]
fn an_out_that_is_a_file_is_refused() {
    let dir = folder("outfile");
    let file = write(&dir, "a.slam", job("kr10-cone", "pla", ""));
    let out = write(&dir, "out", "");
    assert_refused(&twin(["check", &file, "--out", &out]), &format!("{out}:1:1"), &["--out"]);
}

#[test]
fn plan_makes_a_job_that_reads_back() {
    let dir = folder("plan");
    let csv = write(&dir, "c.csv", "strand,x_mm,y_mm,z_mm\na,0,0,0\na,50,0,0\n");
    let common = ["plan", &csv, "--cell", "kr10-cone", "--material", "pla"];
    let done = twin(common);
    assert_eq!(done.code, FEASIBLE, "{}", done.err);
    let source = slam::Source::new("c", done.out);
    let (document, _) = slam::job::parse(&source).expect("a job");
    assert_eq!((document.name.value.as_str(), document.strands.len()), ("c", 1));
    let output = dir.join("c.slam").display().to_string();
    let done =
        twin(common.into_iter().chain(["-o", &output, "--name", "mine", "--speed-mm-s", "2"]));
    assert_eq!(done.code, FEASIBLE, "{}", done.err);
    let text = std::fs::read_to_string(&output).expect("the job");
    assert!(text.contains("\"mine\""));
    for wrong in [["--cell", "kr10-con"], ["--speed-mm-s", "0"], ["--order", &csv]] {
        let done = twin(["plan", &csv, "--material", "pla"].into_iter().chain(wrong));
        assert_eq!(done.code, REFUSED, "{wrong:?}");
    }
    let broken = write(&dir, "d.csv", "strand,x_mm,y_mm,z_mm\na,0,0,zero\n");
    let done = twin(["plan", &broken, "--cell", "kr10-cone", "--material", "pla"]);
    assert_refused(&done, &format!("{broken}:2:7"), &[]);
}
