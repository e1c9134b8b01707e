use super::stl;
use crate::test_film::{film, strand};
use std::collections::BTreeMap;
use std::f64::consts::PI;

/// Corners of every facet, mm.
fn facets(bytes: &[u8]) -> Vec<[[f32; 3]; 3]> {
    let count = u32::from_le_bytes(bytes[80..84].try_into().expect("four bytes")) as usize;
    assert_eq!(bytes.len(), 84 + 50 * count);
    let float = |at: usize| f32::from_le_bytes(bytes[at..at + 4].try_into().expect("four bytes"));
    let corner = |at: usize| [float(at), float(at + 4), float(at + 8)];
    (0..count).map(|k| [12, 24, 36].map(|off| corner(84 + 50 * k + off))).collect()
}

#[test]
fn the_part_holds_what_was_laid() {
    let strands = vec![
        strand("a", &[[0.0; 3], [30.0, 0.0, 0.0], [30.0, 40.0, 0.0]], 0.0),
        strand("b", &[[0.0, 0.0, 10.0], [0.0, 25.0, 20.0]], 10.0),
    ];
    let length_mm: f64 = strands.iter().filter_map(|s| s.at_m.last()).sum::<f64>() * 1e3;
    let facets = facets(&stl(&film("job", strands)));
    let volume_mm3: f64 = facets
        .iter()
        .map(|[a, b, c]| {
            let [a, b, c] = [a, b, c].map(|p| nalgebra::Vector3::from(p.map(f64::from)));
            a.dot(&b.cross(&c)) / 6.0
        })
        .sum();
    let wanted = PI * length_mm;
    assert!((volume_mm3 / wanted - 1.0).abs() < 1e-5, "{volume_mm3} {wanted}");
}

#[test]
fn each_edge_is_shared_by_two_facets_after_rounding() {
    let strands = vec![strand("a", &[[0.0; 3], [13.3, 0.7, 0.1], [30.0, 40.0, 7.7]], 0.0)];
    let mut edges: BTreeMap<[[u32; 3]; 2], i32> = BTreeMap::new();
    for facet in facets(&stl(&film("job", strands))) {
        let bits = facet.map(|corner| corner.map(|x| (x + 0.0).to_bits()));
        for k in 0..3 {
            let (from, to) = (bits[k], bits[(k + 1) % 3]);
            *edges.entry([from.min(to), from.max(to)]).or_default() +=
                if from < to { 1 } else { -1 };
        }
    }
    assert!(!edges.is_empty() && edges.values().all(|&both| both == 0));
}

#[test]
fn no_name_makes_it_text_and_nothing_is_a_file_too() {
    for name in ["solid", "solid\0\n", "ü\u{202e}\"", &"x".repeat(1000)] {
        let bytes = stl(&film(name, Vec::new()));
        assert_eq!(bytes.len(), 84);
        assert!(!bytes.starts_with(b"solid"));
        assert!(bytes[..80].iter().all(|b| *b == 0 || b.is_ascii_graphic() || *b == b' '));
    }
    let odd = vec![strand("none", &[], 0.0), strand("dot", &[[1.0; 3], [1.0; 3]], 0.0)];
    assert_eq!(stl(&film("odd", odd)).len(), 84);
}

#[test]
fn the_same_film_is_the_same_file() {
    let made = || stl(&film("job", vec![strand("a", &[[0.0; 3], [30.0, 0.0, 0.0]], 0.0)]));
    assert_eq!(made(), made());
}
