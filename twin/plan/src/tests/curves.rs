//! Curves from CSV.

use slam::Source;
use slam::document::{Flow, Follow, Placement};

use super::{ids, options};
use crate::{Options, Planned, Remark, curves};

fn read(text: &str) -> Result<Planned, Vec<Remark>> {
    curves(&Source::new("curves.csv", text), &Options { diameter_mm: Some(2.5), ..options() })
}

#[test]
fn rows_become_strands() {
    let planned = read("\u{feff}strand,x_mm,y_mm,z_mm\r\nb, 0 ,0,0\r\nb,1.5,0,1e1\r\n\r\na,0,1,0\r\na,1,1,0\r\na,2,1,0").expect("a plan");
    assert_eq!(ids(&planned), ["b", "a"]);
    let document = &planned.document;
    assert_eq!(document.strands[0].points_mm[1].value, [1.5, 0.0, 10.0]);
    assert_eq!(document.strands[1].points_mm.len(), 3);
    assert_eq!(document.placement, Placement::default());
    assert!(document.process.orientation.follow.is_none());
    assert_eq!(document.process.flow.as_ref().expect("a bead").value, Flow::DiameterMm(2.5));
}

#[test]
fn directions_are_followed() {
    let planned = read("strand,x_mm,y_mm,z_mm,dx,dy,dz\na,0,0,0,0,0,-1\na,1,0,0,0,0.1,-0.99\n")
        .expect("a plan");
    let strand = &planned.document.strands[0];
    let directions: Vec<_> =
        strand.directions.iter().flatten().map(|direction| direction.value).collect();
    assert_eq!(directions, [[0.0, 0.0, -1.0], [0.0, 0.1, -0.99]]);
    let follow = planned.document.process.orientation.follow.as_ref().expect("a rule");
    assert_eq!(follow.value, Follow::Given);
}

#[test]
fn broken_files_name_the_place() {
    let head = "strand,x_mm,y_mm,z_mm\n";
    let rows = |rows: &str| format!("{head}{rows}");
    let cases = [
        (String::new(), "the file is empty", (1, 1)),
        (head.to_owned(), "no curve", (1, 1)),
        ("strand,x_m,y_m,z_m\n".to_owned(), "`x_m`, not `x_mm`", (1, 8)),
        ("strand,x_mm,y_mm\n".to_owned(), "column `z_mm` is missing", (1, 1)),
        ("strand,x_mm,y_mm,z_mm,dx\n".to_owned(), "column `dy` is missing", (1, 1)),
        ("strand,x_mm,y_mm,z_mm,dx,dy,dz,w\n".to_owned(), "unknown column `w`", (1, 32)),
        (rows("a,0,0,0\na,1,0,0,9\n"), "5 columns here, 4 in the header", (3, 1)),
        (rows("a,0,0,0\na,1,x,0\n"), "`x` is not a number", (3, 5)),
        (rows("a,0,0,0\na,1,nan,0\n"), "`nan` is out of range", (3, 5)),
        (rows("a,0,0,0\na,1,1e999,0\n"), "out of range", (3, 5)),
        (rows("a,0,0,0\na,1,,0\n"), "`` is not a number", (3, 5)),
        (rows("a,0,0,0\nb,0,0,0\nb,1,0,0\n"), "strand `a` has a single point", (2, 1)),
        (
            rows("a,0,0,0\na,1,0,0\nb,0,0,0\nb,1,0,0\na,2,0,0\na,3,0,0\n"),
            "goes on here after",
            (6, 1),
        ),
        (rows("a,0,0,0\na,0,0,0\n"), "the one before it again", (3, 3)),
        (rows(",0,0,0\n,0,0,1\n"), "", (2, 1)),
        (rows("free,0,0,0\n"), "cannot be called `free`", (2, 1)),
        (rows("\"a\",0,0,0\n"), "without quotes", (2, 1)),
        ("strand,x_mm,y_mm,z_mm,dx,dy,dz\na,0,0,0,0,0,0\n".to_owned(), "no length", (2, 9)),
    ];
    for (text, expected, place) in cases {
        let remarks = read(&text).expect_err("unusable");
        let diagnostic = &remarks[0].diagnostic;
        assert!(diagnostic.message.contains(expected), "{} for {expected}", diagnostic.message);
        assert_eq!(
            Source::new("c", text).line_column(diagnostic.span.start),
            place,
            "{}",
            diagnostic.message
        );
        assert!(expected.is_empty() || remarks.len() == 1, "{remarks:?}");
    }
}

#[test]
fn another_unit_gets_a_hint_of_its_own() {
    let remarks = read("strand,x_in,y_in,z_in\n").expect_err("unusable");
    assert!(remarks[0].diagnostic.hints[0].contains("millimetres"));
}
