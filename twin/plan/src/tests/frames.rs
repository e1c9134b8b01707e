//! The frames and orders of the shared data.

use std::path::PathBuf;

use slam::Source;
use slam::document::{Flow, Join, On};

use super::options;
use crate::{Input, Options, wireframe};

/// The shared folder, or `None` with the reason printed.
fn shared() -> Option<PathBuf> {
    let default = concat!(env!("CARGO_MANIFEST_DIR"), "/../../../shared").into();
    let folder =
        std::env::var_os("TWIN_SHARED").map_or(default, PathBuf::from).join("data/extrusion");
    if folder.is_dir() {
        return Some(folder);
    }
    eprintln!("skipped: no {} (set TWIN_SHARED)", folder.display());
    None
}

fn source(path: PathBuf) -> Source {
    let text = std::fs::read_to_string(&path).expect("a readable file");
    Source::new(path.display().to_string(), text)
}

/// All 23 frames plan, in their known order where there is one: every strand rests on the bed or
/// starts where something is printed already.
#[test]
fn all_shared_frames_plan() {
    let Some(folder) = shared() else { return };
    let orders = source(folder.join("known_sequences.json"));
    let mut files: Vec<PathBuf> = std::fs::read_dir(folder.join("frames"))
        .expect("a folder")
        .map(|entry| entry.expect("an entry").path())
        .filter(|path| path.extension().is_some_and(|extension| extension == "json"))
        .collect();
    files.sort();
    assert_eq!(files.len(), 23);
    let mut without_order = Vec::new();
    for file in files {
        let stem = file.file_stem().expect("a name").to_string_lossy().into_owned();
        let text = source(file);
        let options = Options { file_stem: stem.clone(), ..options() };
        let known = wireframe(&text, Some(&orders), &options).expect("a plan");
        let bottom_up = wireframe(&text, None, &options).expect("a plan");
        assert_eq!(bottom_up.remarks, [], "{stem}");
        for planned in [&known, &bottom_up] {
            let strands = &planned.document.strands;
            let elements = text.text.matches("end_node_ids").count();
            assert_eq!(strands.len(), elements, "{stem}");
            let floating = |join: &Option<slam::Spanned<Join>>| {
                join.as_ref().is_some_and(|j| j.value == Join::Free)
            };
            // Recorded orders were searched backward and keep this rule too.
            for strand in strands {
                assert!(
                    !floating(&strand.start.join) || !floating(&strand.end.join),
                    "{stem} {}",
                    strand.id.value
                );
            }
            let flow = planned.document.process.flow.as_ref().expect("a bead");
            assert_eq!(
                flow.value,
                Flow::DiameterMm(3.0),
                "{stem}: cross_sec_area is a circle of radius 1.5 mm"
            );
        }
        match known.remarks.as_slice() {
            [] => {}
            [remark] => {
                assert_eq!(remark.input, Input::Order);
                assert_eq!(known.document, bottom_up.document);
                without_order.push(stem);
            }
            more => panic!("{stem}: {more:?}"),
        }
    }
    assert_eq!(without_order, ["klein_bottle_trail", "tre_foil_knot_S1.5"]);
}

/// By hand: the frame's origin is at (700, 0, 25) in the base with axes along it, its grounded nodes at
/// z = −10. With the bed at (500, 100, −2) the origin is at (200, −100, 27) on the bed, which puts
/// the grounded nodes at 17: down by 17 gives (200, −100, 10).
#[test]
fn four_frame_stands_where_worked_by_hand() {
    let Some(folder) = shared() else { return };
    let text = source(folder.join("frames/four-frame.json"));
    let planned = wireframe(&text, None, &options()).expect("a plan");
    let placement = &planned.document.placement;
    assert_eq!(placement.xyz_mm.as_ref().expect("a place").value, [200.0, -100.0, 10.0]);
    assert_eq!(placement.rpy_deg.as_ref().expect("axes").value, [0.0; 3]);
}

/// The wireframe of `scenarios/bunny-wireframe`, whose rim of 13 struts lies on the bed.
#[test]
fn the_bunny_plans() {
    let file = concat!(env!("CARGO_MANIFEST_DIR"), "/../../scenarios/bunny-wireframe/frame.json");
    let planned = wireframe(&source(file.into()), None, &options()).expect("a plan");
    assert_eq!(planned.remarks, []);
    let strands = &planned.document.strands;
    assert_eq!(strands.len(), 179);
    let on_bed = strands.iter().filter(|s| s.on.as_ref().is_some_and(|on| on.value == On::Bed));
    assert_eq!(on_bed.count(), 13);
    let heights = strands.iter().flat_map(|strand| &strand.points_mm).map(|point| point.value[2]);
    assert_eq!(heights.fold(0.0, f64::max), 371.0);
    assert_eq!(
        planned.document.process.flow.as_ref().expect("a bead").value,
        Flow::DiameterMm(4.0)
    );
}

/// What is planned is a job that the front door lets in unchanged.
#[test]
fn plans_survive_their_text() {
    let file = concat!(env!("CARGO_MANIFEST_DIR"), "/../../scenarios/bunny-wireframe/frame.json");
    let planned = wireframe(&source(file.into()), None, &options()).expect("a plan");
    let text = Source::new("job.slam", slam::job::print(&planned.document));
    let read = slam::job::parse(&text).unwrap_or_else(|problems| {
        panic!("{}", text.plain(&problems[0]));
    });
    assert_eq!(read, (planned.document, Vec::new()));
}
