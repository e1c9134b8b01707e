//! Jobs for tests: text and the project's library, read from disk and resolved.

#![allow(clippy::unwrap_used)]

use std::collections::BTreeMap;
use std::fs::read_to_string;

use slam::cell_file::CellFile;
use slam::mesh::Mesh;
use slam::{Diagnostic, Source};

use crate::cell::{Job, Parts, resolve};

/// Every cell of the library.
pub(crate) const CELLS: [&str; 5] =
    ["kirkman-sda10d", "kr10-cone", "kr6-2-hot-end", "kr6-hot-end", "printer-3axis"];

/// A job in this cell of PLA; `more` are further keys, each with a comma after it.
pub(crate) fn text(cell: &str, more: &str, strands: &str) -> String {
    format!(
        r#"{{ "slam": 1, "name": "test", "cell": "{cell}", "material": "pla", {more} "strands": [{strands}] }}"#
    )
}

/// A strand of these points, mm; `more` are further keys, each with a comma before it.
pub(crate) fn strand(id: &str, points_mm: &[[f64; 3]], more: &str) -> String {
    format!(r#"{{ "id": "{id}", "points_mm": {points_mm:?} {more} }}"#)
}

/// The job of a text without forms.
#[track_caller]
pub(crate) fn job(text: &str) -> Job {
    try_job(text, &[]).unwrap_or_else(|problems| panic!("{problems:?}\n{text}"))
}

/// The job of a text, or what `resolve` refuses; the text itself is sound.
#[track_caller]
pub(crate) fn try_job(text: &str, form_meshes: &[Mesh]) -> Result<Job, Vec<Diagnostic>> {
    try_job_in(text, form_meshes, |_| {})
}

/// The same with the cell's file changed first.
#[track_caller]
pub(crate) fn try_job_in(
    text: &str,
    form_meshes: &[Mesh],
    change: impl FnOnce(&mut CellFile),
) -> Result<Job, Vec<Diagnostic>> {
    let (document, _) = slam::job::parse(&Source::new("job", text)).unwrap();
    let file = |path: String| {
        let path = format!("{}/../../{path}", env!("CARGO_MANIFEST_DIR"));
        let text = read_to_string(&path).unwrap_or_else(|error| panic!("{path}: {error}"));
        Source::new(path, text)
    };
    let cell_file = file(format!("robots/cells/{}.toml", document.cell.value));
    let mut cell = slam::cell_file::parse(&cell_file).unwrap();
    change(&mut cell);
    let parts = Parts {
        robot: Some(
            &slam::robot_file::parse(&file(format!("robots/{}/robot.toml", cell.robot))).unwrap(),
        ),
        urdf: &slam::urdf::parse(&file(format!("robots/{}/robot.urdf", cell.robot))).unwrap(),
        link_meshes: &BTreeMap::new(),
        tool: &slam::tool_file::parse(&file(format!("robots/tools/{}.toml", cell.tool))).unwrap(),
        material: &slam::material_file::parse(&file(format!(
            "materials/{}.toml",
            document.material.value
        )))
        .unwrap(),
        form_meshes,
        cell: &cell,
    };
    resolve(&document, &parts)
}
