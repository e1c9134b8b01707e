//! Plans of real and of broken designs.

mod broken;
mod curves;
mod frames;
mod wireframe;

use slam::Source;

use crate::{Bed, Options, Planned, Remark};

/// Options with a bed at the robot's base, 2 mm below it.
fn options() -> Options {
    Options {
        name: "test".to_owned(),
        cell: "kr6-hot-end".to_owned(),
        material: "pla".to_owned(),
        bed: Bed::InRobotBase { xyz_mm: [500.0, 100.0, -2.0], rpy_deg: [0.0; 3] },
        diameter_mm: None,
        speed_mm_s: 5.0,
        file_stem: "test".to_owned(),
    }
}

/// A frame file of these nodes `[x, y, z, grounded]` and elements, base axes turned by a quarter
/// turn about z.
fn frame_text(nodes: &[[f64; 4]], elements: &[[usize; 2]]) -> String {
    let node = |[x, y, z, grounded]: &[f64; 4]| {
        format!(r#"{{"point": {{"X": {x}, "Y": {y}, "Z": {z}}}, "is_grounded": {grounded}}}"#)
    };
    let element =
        |[a, b]: &[usize; 2]| format!(r#"{{"end_node_ids": [{a}, {b}], "layer_id": -1}}"#);
    format!(
        r#"{{"unit": "millimeter",
"base_frame_in_rob_base": {{"OriginX": 600, "OriginY": 0, "OriginZ": 25,
  "XAxis": {{"X": 0, "Y": 1, "Z": 0}}, "YAxis": {{"X": -1, "Y": 0, "Z": 0}}}},
"node_list": [{}],
"element_list": [{}]}}"#,
        nodes.iter().map(node).collect::<Vec<_>>().join(", "),
        elements.iter().map(element).collect::<Vec<_>>().join(", ")
    )
}

/// A pillar, a strut from its top to a second pillar's top, and that pillar.
fn portal() -> String {
    let nodes = [
        [0.0, 0.0, -10.0, 1.0],
        [0.0, 0.0, 20.0, 0.0],
        [40.0, 0.0, 20.0, 0.0],
        [40.0, 0.0, -10.0, 1.0],
    ];
    frame_text(&nodes, &[[1, 2], [1, 0], [2, 3]])
}

fn plan(text: &str, order: Option<&str>, options: &Options) -> Result<Planned, Vec<Remark>> {
    let order = order.map(|text| Source::new("order.json", text));
    crate::wireframe(&Source::new("frame.json", text), order.as_ref(), options)
}

fn ids(planned: &Planned) -> Vec<&str> {
    planned.document.strands.iter().map(|strand| strand.id.value.as_str()).collect()
}
