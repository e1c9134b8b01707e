use super::{Film, Look, Player, Quantity, TraceOf, traces};
use crate::pose::Point;
use crate::preflight::{Preflight, preflight};
use crate::test_job;

/// Two legs of a tent that the bed holds.
fn tent(cell: &str) -> Preflight {
    let held = r#", "start": { "join": "bed" }"#;
    let strands = [
        test_job::strand("up", &[[0.0, 0.0, 1.0], [30.0, 0.0, 41.0]], held),
        test_job::strand("down", &[[60.0, 0.0, 1.0], [30.0, 0.0, 41.0]], held),
    ];
    let text = test_job::text(cell, "", &strands.join(","));
    preflight(test_job::job(&text), |_| {}).expect("a small frame")
}

#[test]
fn the_orifice_is_where_each_point_is_laid_when_it_is_laid() {
    for cell in ["kr6-hot-end", "kirkman-sda10d", "printer-3axis"] {
        let checked = tent(cell);
        let film = Film::new(&checked);
        let player = Player::new(&checked);
        assert_eq!(film.strands.len(), 2);
        for strand in &film.strands {
            assert!(strand.segments() >= 2, "straight stretches are cut");
            assert!(strand.time_s.windows(2).all(|pair| pair[0] <= pair[1]));
            for (point, time_s) in strand.planned.iter().zip(&strand.time_s) {
                let at = Player::orifice(&player.frame_at(*time_s));
                let off_mm = (at - point).norm() * 1e3;
                assert!(off_mm < 0.1, "{cell} {}: {off_mm} mm at {time_s} s", strand.id);
            }
        }
    }
}

#[test]
fn poses_ride_on_their_movers() {
    let checked = tent("kr6-hot-end");
    let film = Film::new(&checked);
    let frame = Player::new(&checked).frame_at(0.5 * film.total_s);
    assert_eq!(frame.world_from_mover.len(), film.movers.len());
    assert_eq!(frame.posture.len(), film.joints.len());
    let cell = &checked.job().cell;
    let tip = cell.robot.arm.chain.forward(&frame.posture);
    let tool = frame.world_from_mover[film.tool];
    assert!(
        (cell.world_from_tool(&tip).translation.vector - tool.translation.vector).norm() < 1e-12
    );
    assert!(film.bodies.iter().all(|body| body.mover < film.movers.len()));
}

#[test]
fn a_scene_grows_and_what_is_to_come_shrinks() {
    let checked = tent("kr6-hot-end");
    let film = Film::new(&checked);
    let player = Player::new(&checked);
    let look = Look { colour: Some(Quantity::Age), planned: true, ..Look::default() };
    let way = |lines: &[crate::scene::StrandShape]| -> f64 {
        lines.iter().flat_map(|s| s.points.windows(2)).map(|p| (p[1] - p[0]).norm()).sum()
    };
    let mut last = 0.0;
    for k in 0..=20 {
        let scene = film.scene(&player.frame_at(film.total_s * f64::from(k) / 20.0), &look);
        let (there, to_come) = (way(&scene.strands), way(&scene.planned));
        assert!(there >= last - 1e-12);
        // two struts of 50 mm; sag makes the printed ones a little longer
        assert!((there + to_come - 0.1).abs() < 1e-3, "{there} and {to_come}");
        last = there;
    }
    assert!((last - 0.1).abs() < 1e-3);
}

#[test]
fn quantities_have_scales_that_hold_their_values() {
    let checked = tent("kr6-hot-end");
    let film = Film::new(&checked);
    let known: Vec<Quantity> = film.painted.iter().map(|painted| painted.quantity).collect();
    for wanted in
        [Quantity::Sag, Quantity::Order, Quantity::Age, Quantity::Temperature, Quantity::Speed]
    {
        assert!(known.contains(&wanted), "{wanted:?} of {known:?}");
    }
    assert!(!known.contains(&Quantity::Cure), "PLA does not cure");
    for painted in &film.painted {
        assert!(painted.scale.low < painted.scale.high, "{painted:?}");
    }
    let hot = film.strands[0].value(0, 0, Quantity::Temperature, film.strands[0].time_s[1]);
    let cold = film.strands[0].value(0, 0, Quantity::Temperature, 1e5);
    assert!(hot > cold, "{hot:?} {cold:?}");
}

/// The most of all segments is what the worst stage is judged by; where the bed holds nothing moves.
#[test]
fn what_the_frame_does_is_told_place_by_place() {
    let checked = tent("kr6-hot-end");
    let film = Film::new(&checked);
    let all = |quantity: Quantity| -> Vec<Vec<f64>> {
        let of = |(order, strand): (usize, &super::FilmStrand)| {
            let value = |k| strand.value(order, k, quantity, film.total_s).expect("solved");
            (0..strand.segments()).map(value).collect()
        };
        film.strands.iter().enumerate().map(of).collect()
    };
    let most = |values: &[f64]| values.iter().copied().fold(0.0, f64::max);
    let stages = checked.growth.stages.iter().filter_map(|stage| stage.member);
    let judged = most(&stages.map(|used| used.share.nominal).collect::<Vec<_>>());
    let used = all(Quantity::Utilisation);
    assert!(judged > 0.0);
    assert_eq!(most(&used.concat()), judged);
    let moved = all(Quantity::Displacement);
    let solved = checked.growth.stages.last().and_then(|stage| stage.staged_m).expect("solved");
    assert!(most(&moved.concat()) >= 0.9 * solved, "{moved:?} {solved}");
    for strand in &moved {
        assert!(strand[0] < 0.1 * most(strand), "begins on the bed: {strand:?}");
    }
}

/// What alone has a limit is shown; sag where nothing has.
#[test]
fn the_picture_of_the_whole_shows_what_decides() {
    let checked = tent("kr6-hot-end");
    let mut film = Film::new(&checked);
    let scale_of = |film: &mut Film, quantity: Quantity, limit: f64| {
        film.painted.iter_mut().for_each(|painted| {
            painted.scale.limit = (painted.quantity == quantity).then_some(limit);
        });
    };
    for quantity in [Quantity::Sag, Quantity::Utilisation, Quantity::Displacement] {
        scale_of(&mut film, quantity, 1e-9);
        assert_eq!(film.most_telling(), quantity);
    }
    let least = film.strands.iter().map(|it| it.clearance_m).fold(f64::INFINITY, f64::min);
    if least.is_finite() {
        scale_of(&mut film, Quantity::Clearance, 1e3);
        assert_eq!(film.most_telling(), Quantity::Clearance);
    }
    film.painted.clear();
    assert_eq!(film.most_telling(), Quantity::Sag);
}

#[test]
fn traces_are_in_order_of_time_and_inside_the_program() {
    let checked = tent("kr6-hot-end");
    let film = Film::new(&checked);
    let all = traces(&checked, &film);
    for of in
        [TraceOf::Speed, TraceOf::Joint(0), TraceOf::Clearance, TraceOf::Sag, TraceOf::Displacement]
    {
        assert!(all.iter().any(|trace| trace.of == of), "{of:?}");
    }
    for trace in &all {
        assert!(trace.points.windows(2).all(|pair| pair[0][0] <= pair[1][0]), "{:?}", trace.of);
        let inside = |time_s: f64| (-1e-9..=film.total_s + 1e-9).contains(&time_s);
        assert!(trace.points.iter().all(|point| inside(point[0])), "{:?}", trace.of);
    }
    // joints are timed within their speeds
    let joint = all.iter().filter(|trace| matches!(trace.of, TraceOf::Joint(_)));
    let most = joint.flat_map(|trace| &trace.points).map(|point| point[1]).fold(0.0, f64::max);
    assert!((0.01..=1.0 + 1e-6).contains(&most), "{most}");
}

#[test]
fn key_times_keep_within_what_is_asked() {
    let checked = tent("kr6-hot-end");
    let player = Player::new(&checked);
    let all = player.key_times(usize::MAX);
    for most in [20, 50, 200] {
        let some = player.key_times(most);
        assert!(some.len() <= most + 2, "{} of {most}", some.len());
        assert!(some.windows(2).all(|pair| pair[0] < pair[1]));
        assert_eq!(some.last(), all.last());
    }
}

#[test]
fn nothing_printed_is_a_film_all_the_same() {
    let text = test_job::text(
        "kr6-hot-end",
        "",
        &test_job::strand("far", &[[9e3, 0.0, 0.0], [9e3, 10.0, 0.0]], ""),
    );
    let checked = preflight(test_job::job(&text), |_| {}).expect("a small frame");
    let film = Film::new(&checked);
    let frame = Player::new(&checked).frame_at(0.0);
    let scene = film.scene(&frame, &Look { planned: true, marks: true, ..Look::default() });
    assert!(
        scene
            .strands
            .iter()
            .flat_map(|s| &s.points)
            .all(|p: &Point| p.coords.iter().all(|x| x.is_finite()))
    );
    assert!(!film.findings.is_empty());
}
