//! Films for tests: made by hand, and of a small checked job.

#![allow(clippy::unwrap_used)]

use sim::film::{Ageing, Film, FilmBody, FilmStrand, Frame, Painted, Quantity};
use sim::pose::{Point, Pose};
use sim::preflight::Preflight;
use sim::scene::{BodyKind, ColourScale, Shape};
use slam::Source;
use std::collections::BTreeMap;
use std::fs::read_to_string;

/// A strand of these points, mm, laid at 10 mm/s from `born_s` on.
pub(crate) fn strand(id: &str, points_mm: &[[f64; 3]], born_s: f64) -> FilmStrand {
    let points: Vec<Point> = points_mm.iter().map(|p| Point::from(p.map(|x| x * 1e-3))).collect();
    let mut at_m = vec![0.0; points.len()];
    for k in 1..points.len() {
        at_m[k] = at_m[k - 1] + (points[k] - points[k - 1]).norm();
    }
    let segments = points.len().saturating_sub(1);
    FilmStrand {
        id: id.to_owned(),
        strand: 0,
        planned: points.clone(),
        time_s: at_m.iter().map(|at_m| born_s + at_m / 0.01).collect(),
        points,
        at_m,
        radius_m: 0.001,
        bead_m: vec![0.002; segments],
        speed_m_s: vec![0.01; segments],
        sag_m: 1e-4,
        clearance_m: f64::INFINITY,
        displacement_m: Vec::new(),
        utilisation: Vec::new(),
        ageing: Ageing::default(),
    }
}

/// A film of these strands with one arm, one nozzle and a bed.
pub(crate) fn film(job: &str, strands: Vec<FilmStrand>) -> Film {
    let body = |name: &str, kind, mover, shape| FilmBody {
        name: name.to_owned(),
        kind,
        mover,
        mover_from_body: Pose::translation(0.0, 0.0, 0.01),
        shapes: vec![shape],
        gone_s: None,
    };
    let [a, b] = [Point::origin(), Point::new(0.0, 0.0, 0.2)];
    let scale = ColourScale {
        title: "printing order".into(),
        unit: String::new(),
        low: 1.0,
        high: strands.len().max(2) as f64,
        limit: None,
    };
    Film {
        job: job.to_owned(),
        cell: "cell".into(),
        movers: ["world", "a1", "tool", "bed", "part"].map(str::to_owned).to_vec(),
        tool: 2,
        bed: 3,
        part: 4,
        bodies: vec![
            body("link", BodyKind::Arm, 1, Shape::Capsule { a, b, radius_m: 0.05 }),
            body("nozzle", BodyKind::Nozzle, 2, Shape::cylinder(a, b, 0.004)),
        ],
        bed_size_m: [0.2, 0.1],
        total_s: strands.iter().filter_map(FilmStrand::done_s).fold(0.0, f64::max),
        strands,
        legs: Vec::new(),
        findings: Vec::new(),
        joints: Vec::new(),
        painted: vec![Painted { quantity: Quantity::Order, scale }],
    }
}

/// The last frame of such a film.
pub(crate) fn frame(film: &Film) -> Frame {
    let world_from_mover =
        (0..film.movers.len()).map(|k| Pose::translation(0.1 * k as f64, 0.0, 0.5)).collect();
    Frame { time_s: film.total_s, posture: vec![0.0], world_from_mover }
}

/// A checked job of strands (id, points in mm) of PLA.
pub(crate) fn checked(name: &str, strands: &[(&str, &[[f64; 3]])]) -> Preflight {
    let told = strands
        .iter()
        .map(|(id, points)| format!(r#"{{ "id": "{id}", "points_mm": {points:?} }}"#));
    let told: Vec<String> = told.collect();
    let text = format!(
        r#"{{ "slam": 1, "name": {}, "cell": "kr6-hot-end", "material": "pla", "strands": [{}] }}"#,
        serde_json::json!(name),
        told.join(",")
    );
    let (document, _) = slam::job::parse(&Source::new("job", text)).unwrap();
    let file = |path: String| {
        let path = format!("{}/../../{path}", env!("CARGO_MANIFEST_DIR"));
        let text = read_to_string(&path).unwrap_or_else(|error| panic!("{path}: {error}"));
        Source::new(path, text)
    };
    let cell = slam::cell_file::parse(&file("robots/cells/kr6-hot-end.toml".into())).unwrap();
    let robot = |name: &str| file(format!("robots/{}/{name}", cell.robot));
    let parts = sim::cell::Parts {
        robot: Some(&slam::robot_file::parse(&robot("robot.toml")).unwrap()),
        urdf: &slam::urdf::parse(&robot("robot.urdf")).unwrap(),
        link_meshes: &BTreeMap::new(),
        tool: &slam::tool_file::parse(&file(format!("robots/tools/{}.toml", cell.tool))).unwrap(),
        material: &slam::material_file::parse(&file("materials/pla.toml".into())).unwrap(),
        form_meshes: &[],
        cell: &cell,
    };
    let job = sim::cell::resolve(&document, &parts).unwrap();
    sim::preflight::preflight(job, |_| {}).unwrap()
}
