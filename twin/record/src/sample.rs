//! Small jobs for tests: text and the project's library, read from disk and resolved.

#![allow(clippy::unwrap_used)]

use std::collections::BTreeMap;
use std::fs::read_to_string;
use std::sync::LazyLock;

use sim::cell::{Parts, resolve};
use sim::preflight::{Preflight, preflight};
use slam::Source;

/// A checked job in this cell of PLA with these strands: name and points, mm.
fn checked(cell: &str, job: &str, strands: &[(&str, &[[f64; 3]])]) -> Preflight {
    let strands: Vec<String> = strands
        .iter()
        .map(|(id, points_mm)| format!(r#"{{ "id": {id:?}, "points_mm": {points_mm:?} }}"#))
        .collect();
    let text = format!(
        r#"{{ "slam": 1, "name": {job:?}, "cell": "{cell}", "material": "pla", "strands": [{}] }}"#,
        strands.join(",")
    );
    let (document, _) = slam::job::parse(&Source::new("job", text)).unwrap();
    let file = |path: String| {
        let text = read_to_string(format!("{}/{path}", root())).unwrap();
        Source::new(path, text)
    };
    let cell = slam::cell_file::parse(&file(format!("robots/cells/{cell}.toml"))).unwrap();
    let robot =
        slam::robot_file::parse(&file(format!("robots/{}/robot.toml", cell.robot))).unwrap();
    let parts = Parts {
        robot: Some(&robot),
        urdf: &slam::urdf::parse(&file(format!("robots/{}/robot.urdf", cell.robot))).unwrap(),
        link_meshes: &BTreeMap::new(),
        tool: &slam::tool_file::parse(&file(format!("robots/tools/{}.toml", cell.tool))).unwrap(),
        material: &slam::material_file::parse(&file("materials/pla.toml".to_owned())).unwrap(),
        form_meshes: &[],
        cell: &cell,
    };
    preflight(resolve(&document, &parts).unwrap(), |_| {}).unwrap()
}

/// Two legs of a tent on the bed, checked once for all tests.
pub(crate) fn tent() -> &'static Preflight {
    static TENT: LazyLock<Preflight> = LazyLock::new(|| {
        let up = [[0.0, 0.0, 1.0], [30.0, 0.0, 41.0]];
        let down = [[60.0, 0.0, 1.0], [30.0, 0.0, 41.0]];
        checked("kr6-hot-end", "tent", &[("up", &up), ("down", &down)])
    });
    &TENT
}

/// A strand that no arm reaches.
pub(crate) fn far() -> &'static Preflight {
    static FAR: LazyLock<Preflight> = LazyLock::new(|| {
        checked("kr6-hot-end", "far", &[("far", &[[9e3, 0.0, 0.0], [9e3, 10.0, 0.0]])])
    });
    &FAR
}

/// The project's folder.
fn root() -> String {
    format!("{}/../..", env!("CARGO_MANIFEST_DIR"))
}
