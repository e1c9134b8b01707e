use super::{MAX_TRIANGLES, MeshError, parse_obj, parse_obj_lines, parse_stl};

fn binary(header: &str, triangles: &[[[f32; 3]; 3]]) -> Vec<u8> {
    let mut bytes = header.as_bytes().to_vec();
    bytes.resize(80, b' ');
    bytes.extend((triangles.len() as u32).to_le_bytes());
    for triangle in triangles {
        bytes.extend([0; 12]);
        triangle.as_flattened().iter().for_each(|number| bytes.extend(number.to_le_bytes()));
        bytes.extend([0; 2]);
    }
    bytes
}

const SQUARE: [[[f32; 3]; 3]; 2] = [
    [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0]],
    [[-0.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]],
];

const ASCII: &str = "solid two words
facet normal 0 0 1
 outer loop
  vertex 0 0 0
  vertex 1 0 0
  VERTEX 1e0 1 0
 endloop
endfacet
facet normal 0 0 1
 outer loop
  vertex 0 0 0
  vertex 1 1 0
  vertex 0 1 0
 endloop
endfacet
endsolid two words
";

#[test]
fn binary_and_ascii_give_one_mesh_with_shared_vertices() {
    let mesh = parse_stl(&binary("made by us", &SQUARE)).unwrap();
    assert_eq!(mesh.triangles, [[0, 1, 2], [0, 2, 3]]);
    assert_eq!(mesh.vertices, [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]]);
    assert_eq!(parse_stl(ASCII.as_bytes()).unwrap(), mesh);
    assert_eq!(parse_stl(ASCII.replace('\n', "\r\n").as_bytes()).unwrap(), mesh);
    // binary files that begin with "solid" exist; the length decides
    assert_eq!(parse_stl(&binary("solid lie", &SQUARE)).unwrap(), mesh);
    let obj = "v 0 0 0\nv 1 0 0 1\nv 1 1 0\nv 0 1 0\nvn 0 0 1\no x\nf 1//1 2/1 \\\n -2 4 # four\n";
    assert_eq!(parse_obj(obj).unwrap(), mesh);
}

#[test]
fn header_is_not_trusted() {
    let mut lying = binary("x", &SQUARE);
    lying[80..84].copy_from_slice(&u32::MAX.to_le_bytes());
    let found = lying.len();
    let expected = 84 + 50 * u64::from(u32::MAX);
    assert_eq!(parse_stl(&lying), Err(MeshError::Length { triangles: u32::MAX, expected, found }));
    let cut = binary("x", &SQUARE);
    for length in 1..cut.len() {
        assert!(parse_stl(&cut[..length]).is_err(), "{length}");
    }
    assert!(parse_stl(&[cut, vec![0]].concat()).is_err());
    assert_eq!(parse_stl(&binary("x", &[])), Err(MeshError::Empty("triangle")));
    assert_eq!(parse_stl(b""), Err(MeshError::Empty("triangle")));
}

#[test]
fn broken_stl_is_refused_with_its_place() {
    let mut bad = SQUARE;
    bad[1][2][1] = f32::NAN;
    assert_eq!(parse_stl(&binary("x", &bad)), Err(MeshError::NotFinite { triangle: 2 }));
    for (from, to, expected) in [
        ("1e0 1 0", "1e999 1 0", "line 6: \"1e999\" is not finite"),
        ("1e0 1 0", "1e0 one 0", "line 6: \"one\" is not a number"),
        ("1e0 1 0", "1e0 1", "line 6: three coordinates are needed"),
        ("  VERTEX 1e0 1 0\n", "", "line 6: a facet has three vertices, this one has fewer"),
        (
            "  VERTEX 1e0 1 0\n",
            "vertex 1 1 0\nvertex 2 2 2\n",
            "line 7: a facet has three vertices, this one has more",
        ),
        ("endsolid two words\n", "", "line 15: the file ends before \"endsolid\""),
        ("endfacet\nfacet", "endfacet\nfasset", "line 9: \"fasset\" is out of place"),
    ] {
        let text = ASCII.replacen(from, to, 1);
        assert_eq!(parse_stl(text.as_bytes()).unwrap_err().to_string(), expected);
    }
}

#[test]
fn broken_obj_is_refused_with_its_line() {
    for (text, expected) in [
        ("", "the file holds no face"),
        ("v 0 0 0\nf 1 1\n", "line 2: f needs 3 vertices or more"),
        ("v 0 0 0\nf 1 1 2\n", "line 2: vertex 2 does not exist; there are 1 so far"),
        ("v 0 0 0\nf 0 1 1\n", "line 2: vertex 0 does not exist; there are 1 so far"),
        ("v 0 0 0\nf -2 1 1\n", "line 2: vertex -2 does not exist; there are 1 so far"),
        (
            "f -9223372036854775808 1 1\n",
            "line 1: vertex -9223372036854775808 does not exist; there are 0 so far",
        ),
        ("v 0 nan 0\n", "line 1: \"nan\" is not finite"),
        ("v 0 0 0\nf 1 x 1\n", "line 2: \"x\" is not a vertex"),
    ] {
        assert_eq!(parse_obj(text).unwrap_err().to_string(), expected);
    }
}

#[test]
fn obj_lines_share_vertices() {
    let lines = parse_obj_lines("v 0 0 0\nv 0 0 1\nv 0 0 0\nl 1 2\nl 3/1 2\n").unwrap();
    assert_eq!(lines.vertices, [[0.0, 0.0, 0.0], [0.0, 0.0, 1.0]]);
    assert_eq!(lines.polylines, [[0, 1], [0, 1]]);
    assert_eq!(parse_obj_lines("v 0 0 0\n"), Err(MeshError::Empty("line")));
}

#[test]
fn fan_of_too_many_triangles_is_refused() {
    let text = format!("v 0 0 0\nf {}", "1 ".repeat(MAX_TRIANGLES + 3));
    assert_eq!(parse_obj(&text), Err(MeshError::TooMany("triangles")));
}
