//! Placement, order, joints and bead of small frames worked by hand.

use slam::document::{Flow, Follow, Join, On, Strand};

use super::{frame_text, ids, options, plan, portal};
use crate::{Bed, Input, Options, Planned};

fn joins(strand: &Strand) -> [&Join; 2] {
    [&strand.start, &strand.end].map(|end| &end.join.as_ref().expect("a join").value)
}

fn points(strand: &Strand) -> Vec<[f64; 3]> {
    strand.points_mm.iter().map(|point| point.value).collect()
}

fn pose(planned: &Planned) -> ([f64; 3], [f64; 3]) {
    let placement = &planned.document.placement;
    (
        placement.xyz_mm.as_ref().expect("a place").value,
        placement.rpy_deg.as_ref().expect("axes").value,
    )
}

#[test]
fn bottom_up_grows_from_the_bed() {
    let planned = plan(&portal(), None, &options()).expect("a plan");
    assert_eq!(planned.remarks, []);
    assert_eq!(ids(&planned), ["e1", "e2", "e0"]);
    let strands = &planned.document.strands;
    assert_eq!(points(&strands[0]), [[0.0, 0.0, -10.0], [0.0, 0.0, 20.0]]);
    assert_eq!(joins(&strands[0]), [&Join::Bed, &Join::Free]);
    assert_eq!(points(&strands[1]), [[40.0, 0.0, -10.0], [40.0, 0.0, 20.0]]);
    assert_eq!(points(&strands[2]), [[0.0, 0.0, 20.0], [40.0, 0.0, 20.0]]);
    assert_eq!(joins(&strands[2]), [&Join::Id("e1".to_owned()), &Join::Id("e2".to_owned())]);
    assert!(strands.iter().all(|strand| strand.on.is_none()));
    let process = &planned.document.process;
    assert_eq!(process.orientation.follow.as_ref().expect("a rule").value, Follow::Vertical);
    assert_eq!(process.speed_mm_s.as_ref().expect("a speed").value, 5.0);
    assert!(process.flow.is_none(), "no cross-section, none asked: the cell's");
}

/// Origin at (600, 0) in the base, bed at (500, 100): (100, −100) on the bed, axes turned by 90°;
/// grounded nodes at −10 in the part's axes, so its origin is 10 mm over the bed.
#[test]
fn a_turned_frame_keeps_its_axes() {
    let planned = plan(&portal(), None, &options()).expect("a plan");
    assert_eq!(pose(&planned), ([100.0, -100.0, 10.0], [0.0, 0.0, 90.0]));
}

/// The bed's x axis points along the base's y, as the part's: nothing is turned, and
/// (100, −100, ·) in the base is (−100, −100, ·) on the bed.
#[test]
fn a_turned_bed_turns_the_other_way() {
    let bed = Bed::InRobotBase { xyz_mm: [500.0, 100.0, 300.0], rpy_deg: [0.0, 0.0, 90.0] };
    let planned = plan(&portal(), None, &Options { bed, ..options() }).expect("a plan");
    assert_eq!(pose(&planned), ([-100.0, -100.0, 10.0], [0.0; 3]));
}

/// The feet at x = 0 and 40 are centred: with the axes turned by 90° their mean lies at y = 20.
#[test]
fn on_a_moving_bed_the_feet_are_centred() {
    let planned =
        plan(&portal(), None, &Options { bed: Bed::OnFlange, ..options() }).expect("a plan");
    assert_eq!(pose(&planned), ([0.0, -20.0, 10.0], [0.0, 0.0, 90.0]));
    assert_eq!(planned.remarks.len(), 1);
}

#[test]
fn a_given_order_sets_the_direction() {
    let pairs = "[[3, 2], [2, 1], [1, 0]]";
    let named = format!(r#"{{"directed_elements": {pairs}}}"#);
    let known = format!(r#"{{"instances": {{"test": {{"directed_elements": {pairs}}}}}}}"#);
    for order in [pairs, &named, &known] {
        let planned = plan(&portal(), Some(order), &options()).expect("a plan");
        assert_eq!(planned.remarks, []);
        assert_eq!(ids(&planned), ["e2", "e0", "e1"]);
        let strands = &planned.document.strands;
        assert_eq!(points(&strands[1]), [[40.0, 0.0, 20.0], [0.0, 0.0, 20.0]]);
        assert_eq!(joins(&strands[1]), [&Join::Id("e2".to_owned()), &Join::Free]);
        assert_eq!(joins(&strands[2]), [&Join::Id("e0".to_owned()), &Join::Bed]);
    }
}

#[test]
fn without_its_order_a_frame_goes_bottom_up_and_says_so() {
    let order = r#"{"instances": {"other": {"directed_elements": []}}}"#;
    let planned = plan(&portal(), Some(order), &options()).expect("a plan");
    assert_eq!(ids(&planned), ["e1", "e2", "e0"]);
    assert_eq!(planned.remarks.len(), 1);
    assert_eq!(planned.remarks[0].input, Input::Order);
}

#[test]
fn units_count_for_nodes_and_place() {
    let metres = portal().replace("millimeter", "meter");
    let planned = plan(&metres, None, &options()).expect("a plan");
    assert_eq!(points(&planned.document.strands[0])[1], [0.0, 0.0, 20_000.0]);
    assert_eq!(pose(&planned).0[0], 600_000.0 - 500.0);
}

/// π r² with r = 1.5 mm, and the same in cm².
#[test]
fn area_gives_the_bead_before_the_asked_one() {
    let area = std::f64::consts::PI * 1.5 * 1.5;
    for (number, unit) in [(area, "mm2"), (area / 100.0, "centimeter^2")] {
        let section = format!(
            r#""material_properties": {{"cross_sec_area": {number}, "cross_sec_area_unit": "{unit}"}}, "unit""#
        );
        let text = portal().replace("\"unit\"", &section);
        let asked = Options { diameter_mm: Some(2.0), ..options() };
        let planned = plan(&text, None, &asked).expect("a plan");
        assert_eq!(
            planned.document.process.flow.as_ref().expect("a bead").value,
            Flow::DiameterMm(3.0)
        );
        assert_eq!(planned.remarks.len(), 1, "two beads: {:?}", planned.remarks);
    }
    let asked = Options { diameter_mm: Some(2.0), ..options() };
    let planned = plan(&portal(), None, &asked).expect("a plan");
    assert_eq!(
        planned.document.process.flow.as_ref().expect("a bead").value,
        Flow::DiameterMm(2.0)
    );
}

#[test]
fn a_strut_between_feet_lies_on_the_bed() {
    let nodes = [[0.0, 0.0, 5.0, 1.0], [30.0, 0.0, 5.0, 1.0], [0.0, 0.0, 25.0, 0.0]];
    let planned = plan(&frame_text(&nodes, &[[0, 1], [0, 2]]), None, &options()).expect("a plan");
    let on =
        planned.document.strands.iter().map(|strand| strand.on.as_ref().map(|on| on.value.clone()));
    assert_eq!(on.collect::<Vec<_>>(), [Some(On::Bed), None]);
}

#[test]
fn what_nothing_holds_comes_last_and_is_said() {
    let nodes = [
        [0.0, 0.0, 0.0, 1.0],
        [0.0, 0.0, 90.0, 0.0],
        [50.0, 0.0, 20.0, 0.0],
        [50.0, 0.0, 10.0, 0.0],
        [60.0, 0.0, 20.0, 0.0],
    ];
    let planned =
        plan(&frame_text(&nodes, &[[4, 2], [2, 3], [1, 0]]), None, &options()).expect("a plan");
    assert_eq!(ids(&planned), ["e2", "e1", "e0"]);
    assert_eq!(joins(&planned.document.strands[1]), [&Join::Free, &Join::Free]);
    assert_eq!(points(&planned.document.strands[1])[0], [50.0, 0.0, 10.0]);
    assert_eq!(points(&planned.document.strands[2])[0], [50.0, 0.0, 20.0]);
    assert!(planned.remarks[0].diagnostic.message.contains("2 elements"));
}

#[test]
fn elements_call_nodes_by_their_id() {
    let mut text = portal()
        .replace("[1, 2]", "[11, 12]")
        .replace("[1, 0]", "[11, 10]")
        .replace("[2, 3]", "[12, 13]");
    for id in 10..14 {
        text = text.replacen("{\"point\"", &format!("{{\"node_id\": {id}, \"point\" "), 1);
    }
    let planned = plan(&text, Some("[[10, 11], [11, 12], [12, 13]]"), &options()).expect("a plan");
    assert_eq!(ids(&planned), ["e1", "e0", "e2"]);
}
