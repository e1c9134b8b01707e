mod sample;

use super::strands::{OVER, TOP, UNDER, UNKNOWN, level};
use super::{SCRIPT, STYLE, View3d, section};
use proptest::prelude::*;
use sample::{Read, film, keys, painted};
use sim::film::Quantity;
use sim::pose::Point;
use sim::scene::Shape;

fn triples(codes: &[u16]) -> impl Iterator<Item = [u16; 3]> + '_ {
    codes.chunks(3).map(|three| [three[0], three[1], three[2]])
}

#[test]
fn places_come_back_within_a_step() {
    let film = film(3, 50, "s");
    let read = Read::of(&View3d::of(&film, &keys(9), 1_000_000));
    let grid = read.grid(&read.head["strands"]);
    let step_m = grid.size.into_iter().fold(0.0, f64::max) / 65535.0;
    let codes = read.u16s("point_at");
    let points = film.strands.iter().flat_map(|strand| &strand.points);
    assert_eq!(codes.len(), 3 * 3 * 51);
    for (code, point) in triples(&codes).zip(points) {
        assert!((grid.point(code) - point).amax() <= 0.5001 * step_m);
    }
    // 1 mm to the planned place in steps of 1/127 of it
    let (_, ways, _) = read.array("point_way");
    assert!(ways.chunks(3).all(|way| way == [0, 0, 127]));
    let when = read.u16s("point_when");
    for (k, share) in when.iter().take(51).enumerate() {
        assert!((f64::from(*share) / 65535.0 * 50.0 - k as f64).abs() <= 0.51 * 50.0 / 65535.0);
    }
}

#[test]
fn movers_come_back_within_a_step_and_those_that_stand_are_told_once() {
    let keys = keys(40);
    let read = Read::of(&View3d::of(&film(1, 10, "s"), &keys, 1_000_000));
    let movers = &read.head["movers"];
    assert!(movers[0]["still"].is_array() && movers[3]["still"].is_array());
    let grid = read.grid(&movers[1]);
    let codes = read.u16s("mover_at_1");
    for (code, pose) in triples(&codes).zip(keys.poses(1)) {
        assert!((grid.point(code).coords - pose.translation.vector).amax() < 1e-5);
    }
    // neighbours lie on one side, although the turn passes half a circle
    let (_, bytes, _) = read.array("mover_turn_1");
    let turns: Vec<f64> =
        bytes.chunks(2).map(|b| f64::from(i16::from_le_bytes([b[0], b[1]])) / 32767.0).collect();
    let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
    let turns: Vec<&[f64]> = turns.chunks(4).collect();
    assert!(turns.windows(2).all(|pair| dot(pair[0], pair[1]) > 0.98));
}

#[test]
fn bodies_keep_their_skin() {
    let read = Read::of(&View3d::of(&film(1, 10, "s"), &keys(2), 1_000_000));
    let bodies = read.head["bodies"].as_array().expect("a list");
    assert_eq!(bodies.len(), 2, "bed and form");
    let (bed, form) = (&bodies[0], &bodies[1]);
    assert_eq!((bed["kind"].as_str(), bed["triangles"].as_u64()), (Some("bed"), Some(12)));
    assert_eq!((form["capsules"].as_u64(), form["gone_s"].as_f64()), (Some(1), Some(5.0)));
    let skip = bed["corners"].as_u64().expect("a number") as usize;
    let codes = read.u16s("corner_at");
    let grid = read.grid(form);
    let skin = triples(&codes).skip(skip).map(|code| grid.point(code));
    let far = skin.map(|p| p.coords.xy().norm()).fold(0.0, f64::max);
    assert!((far - 0.05).abs() < 1e-5, "{far}");
}

#[test]
fn values_have_codes_on_and_beside_their_scale() {
    let sag = painted(Quantity::Sag, 0.0, 0.1);
    let cases = [
        (Some(0.0), 0),
        (Some(5e-5), TOP / 2),
        (Some(1e-4), TOP),
        (Some(2e-4), OVER),
        (Some(-1e-4), UNDER),
        (Some(f64::NAN), UNKNOWN),
        (None, UNKNOWN),
    ];
    for (value, code) in cases {
        assert_eq!(level(&sag, value), code, "{value:?}");
    }
    let read = Read::of(&View3d::of(&film(2, 4, "s"), &keys(2), 1_000_000));
    assert_eq!(read.u16s("sag"), [TOP / 2; 2]);
    let bead = [[TOP / 2; 4].as_slice(), &[UNKNOWN]].concat();
    assert_eq!(
        read.u16s("bead"),
        [bead.clone(), bead].concat(),
        "four segments, the last point begins none"
    );
    assert_eq!(read.u16s("clearance"), [UNKNOWN; 2], "nothing came near");
    // 500 K at first, 300 K at last, of 20 to 230 °C in 250 steps
    let (_, levels, many) = read.array("temperature");
    assert_eq!((many, levels[0], levels[23]), (48, 246, 8));
}

#[test]
fn a_hundred_thousand_segments_fit_three_megabytes() {
    let view = View3d::of(&film(500, 200, "strand"), &keys(2000), 3_000_000);
    assert!(section(&view).len() < 3_020_000, "{}", section(&view).len());
    assert_eq!(view.thinned, None);
}

#[test]
fn the_budget_is_kept_and_what_is_missing_is_said() {
    let film = film(400, 300, "a strand with a name of some length");
    let mut last = usize::MAX;
    for budget in [2_000_000, 800_000, 300_000, 100_000, 40_000] {
        let view = View3d::of(&film, &keys(20), budget);
        assert!(view.data.len() <= budget, "{} of {budget}", view.data.len());
        let said = view.thinned.clone().unwrap_or_default();
        assert!(said.contains("segments") || said.contains("strands"), "{said}");
        assert!(section(&view).contains(&said));
        let points = Read::of(&view).u16s("point_when").len();
        assert!(points <= last && points > 10, "{points}");
        last = points;
    }
}

#[test]
fn names_from_a_job_stay_names() {
    let evil = "</script><script>alert(1)</script><img src=x onerror=alert(2)>\"'&\u{0}";
    let mut film = film(2, 5, evil);
    film.painted[0].scale.title = evil.to_owned();
    let html = section(&View3d::of(&film, &keys(3), 1_000_000));
    assert_eq!(html.matches("<script").count(), 1);
    assert_eq!(html.matches("</script").count(), 1);
    assert!(!html.contains("<img") && !html.contains('\u{0}'));
    assert!(html.contains("&lt;/script&gt;"));
    let read = Read::of(&View3d::of(&film, &keys(3), 1_000_000));
    assert_eq!(
        read.head["names"][0].as_str().map(|name| name.starts_with("</script>")),
        Some(true)
    );
}

#[test]
fn script_and_style_can_stand_in_a_page() {
    for text in [SCRIPT, STYLE] {
        assert!(!text.contains("</s") && !text.contains("<!--") && !text.contains("://"));
    }
    for banned in ["eval(", "new Function", "fetch(", "XMLHttpRequest", "import(", "innerHTML"] {
        assert!(!SCRIPT.contains(banned), "{banned}");
    }
    assert_eq!(SCRIPT.matches("'use strict';").count(), 1);
}

#[test]
fn the_same_film_gives_the_same_bytes() {
    let html = || section(&View3d::of(&film(5, 20, "s"), &keys(9), 30_000));
    assert_eq!(html(), html());
}

fn any_number() -> impl Strategy<Value = f64> {
    prop_oneof![
        4 => -1.0..1.0_f64,
        1 => any::<f64>(),
        1 => Just(f64::NAN),
        1 => Just(f64::INFINITY),
    ]
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    #[test]
    fn any_film_can_be_packed(
        numbers in prop::collection::vec(any_number(), 30),
        strands in 0_usize..4, segments in 0_usize..6, budget in 0_usize..60_000, many in 0_usize..4,
    ) {
        let mut film = film(strands, segments, "s");
        let mut next = numbers.iter().copied().cycle();
        let mut number = || next.next().unwrap_or(0.0);
        for strand in &mut film.strands {
            strand.radius_m = number();
            strand.sag_m = number();
            let last = strand.points.len() - 1;
            strand.points[last] = Point::new(number(), number(), number());
            strand.planned[last] = Point::new(number(), number(), number());
            strand.time_s[last] = number();
            strand.ageing.age_s = vec![number(), number()];
            strand.planned.truncate(last + 1);
        }
        film.painted[0].scale.high = number();
        film.total_s = number();
        film.findings[0].at = Some(Point::new(number(), number(), number()));
        film.bodies[0].shapes.push(Shape::Hull { points: vec![Point::new(number(), 0.0, 0.0); 5] });
        let mut keys = keys(many);
        if let Some(pose) = keys.world_from_mover.first_mut() {
            pose[1].translation.vector.x = number();
        }
        let read = Read::of(&View3d::of(&film, &keys, budget));
        prop_assert!(read.head["arrays"].is_object());
    }
}
