use super::{GlbOptions, glb};
use crate::test_film::{film, frame, strand};
use serde_json::Value;
use sim::film::{Film, FilmStrand, Quantity};

const COLOURED: GlbOptions = GlbOptions { cell: false, colour: Some(Quantity::Order) };

fn u32_at(bytes: &[u8], at: usize) -> usize {
    u32::from_le_bytes(bytes[at..at + 4].try_into().expect("four bytes")) as usize
}

/// The two chunks; their layout is held to the format.
fn chunks(bytes: &[u8]) -> (Value, Vec<u8>) {
    assert_eq!(&bytes[..4], b"glTF");
    assert_eq!(u32_at(bytes, 4), 2);
    assert_eq!(u32_at(bytes, 8), bytes.len());
    assert_eq!(&bytes[16..20], b"JSON");
    let text = u32_at(bytes, 12);
    assert_eq!(text % 4, 0);
    let json = serde_json::from_slice(&bytes[20..20 + text]).expect("JSON");
    let at = 20 + text;
    if at == bytes.len() {
        return (json, Vec::new());
    }
    assert_eq!(&bytes[at + 4..at + 8], b"BIN\0");
    assert_eq!(at + 8 + u32_at(bytes, at), bytes.len());
    (json, bytes[at + 8..].to_vec())
}

fn list<'a>(json: &'a Value, key: &str) -> &'a [Value] {
    json[key].as_array().map_or(&[], Vec::as_slice)
}

fn number(value: &Value) -> usize {
    value.as_u64().unwrap_or(0) as usize
}

/// Every accessor lies in its view, every view in the buffer, every index names a vertex.
fn is_sound(json: &Value, binary: &[u8]) {
    for view in list(json, "bufferViews") {
        assert!(number(&view["byteOffset"]) + number(&view["byteLength"]) <= binary.len());
        assert_eq!(number(&view["byteOffset"]) % 4, 0);
    }
    for mesh in list(json, "meshes") {
        let primitive = &mesh["primitives"][0];
        let accessor = |index: &Value| &json["accessors"][number(index)];
        let position = accessor(&primitive["attributes"]["POSITION"]);
        let n = number(&position["count"]);
        assert_eq!(number(&accessor(&primitive["attributes"]["NORMAL"])["count"]), n);
        let indices = accessor(&primitive["indices"]);
        let from = number(&json["bufferViews"][number(&indices["bufferView"])]["byteOffset"])
            + number(&indices["byteOffset"]);
        for k in 0..number(&indices["count"]) {
            assert!(u32_at(binary, from + 4 * k) < n);
        }
        for k in 0..3 {
            assert!(position["min"][k].as_f64() <= position["max"][k].as_f64());
        }
    }
}

fn two() -> Vec<FilmStrand> {
    vec![
        strand("a", &[[0.0; 3], [15.0, 0.0, 0.0], [30.0, 0.0, 0.0]], 0.0),
        strand("b", &[[0.0, 0.0, 10.0], [0.0, 25.0, 20.0]], 3.0),
    ]
}

fn of(film: &Film, options: GlbOptions) -> (Value, Vec<u8>) {
    let (json, binary) = chunks(&glb(film, &frame(film), options));
    is_sound(&json, &binary);
    (json, binary)
}

#[test]
fn each_strand_is_a_node_of_its_name() {
    let (json, _) = of(&film("job", two()), COLOURED);
    let names: Vec<&str> = list(&json, "nodes").iter().filter_map(|n| n["name"].as_str()).collect();
    assert_eq!(names, ["a", "b", "part", "job"]);
    assert_eq!(list(&json, "meshes").len(), 2);
    // straight and of one colour: two rings, two half balls of a ring and a tip
    assert_eq!(number(&json["accessors"][0]["count"]), 2 * 8 + 2 * (8 + 1));
    assert_eq!(json["scenes"][0]["extras"]["job"], "job");
    // 30 mm along x and the half balls, which stick out by the radius of the polygon's corners
    let most = json["accessors"][0]["max"][0].as_f64().expect("a number");
    assert!((0.0309..0.0312).contains(&most), "{most}");
}

#[test]
fn the_root_turns_z_up_to_y_up() {
    let (json, _) = of(&film("job", two()), COLOURED);
    let root = &json["nodes"][number(&json["scenes"][0]["nodes"][0])];
    let q: Vec<f64> = list(root, "rotation").iter().filter_map(Value::as_f64).collect();
    let q = nalgebra::UnitQuaternion::from_quaternion(nalgebra::Quaternion::new(
        q[3], q[0], q[1], q[2],
    ));
    assert!((q * nalgebra::Vector3::z() - nalgebra::Vector3::y()).norm() < 1e-12);
    assert!((q * nalgebra::Vector3::x() - nalgebra::Vector3::x()).norm() < 1e-12);
}

#[test]
fn the_cell_comes_where_asked() {
    let (json, _) = of(&film("job", two()), GlbOptions { cell: true, ..COLOURED });
    let names: Vec<&str> = list(&json, "nodes").iter().filter_map(|n| n["name"].as_str()).collect();
    for name in ["a1", "link", "tool", "nozzle", "bed", "part", "a"] {
        assert!(names.contains(&name), "{name} of {names:?}");
    }
    assert_eq!(list(&json, "materials").len(), 4, "strands, arm, nozzle, bed");
}

#[test]
fn only_what_is_laid_is_there() {
    let film = film("job", two());
    let mut half = frame(&film);
    half.time_s = 2.0;
    let (json, _) = chunks(&glb(&film, &half, COLOURED));
    assert_eq!(list(&json, "meshes").len(), 1);
    let most = json["accessors"][0]["max"][0].as_f64().expect("a number");
    assert!((0.0209..0.0212).contains(&most), "20 mm in 2 s, {most}");
}

#[test]
fn many_strands_share_nodes() {
    let many = (0..4500).map(|k| {
        let y = f64::from(k);
        strand(&format!("s{k}"), &[[0.0, y, 0.0], [5.0, y, 0.0]], y)
    });
    let (json, _) = of(&film("job", many.collect()), COLOURED);
    assert_eq!(list(&json, "meshes").len(), 1500);
    assert_eq!(json["nodes"][0]["name"], "strands 1 to 3");
}

#[test]
fn hostile_names_stay_names() {
    let name = format!("\"}},\u{0}\u{202e}</script>{}", "x".repeat(100_000));
    let (json, _) = of(&film(&name, vec![strand(&name, &[[0.0; 3], [9.0; 3]], 0.0)]), COLOURED);
    let told = json["nodes"][0]["name"].as_str().expect("a name");
    assert!(name.starts_with(told) && told.chars().count() == 120);
}

#[test]
fn nothing_printed_is_a_file_all_the_same() {
    let (json, binary) = of(&film("job", Vec::new()), COLOURED);
    assert!(binary.is_empty() && json.get("meshes").is_none() && json.get("buffers").is_none());
    assert_eq!(list(&json, "nodes").len(), 1);
}

#[test]
fn the_same_film_is_the_same_file() {
    let film = film("job", two());
    let options = GlbOptions { cell: true, ..COLOURED };
    assert_eq!(glb(&film, &frame(&film), options), glb(&film, &frame(&film), options));
}
