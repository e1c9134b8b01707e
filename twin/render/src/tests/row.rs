//! Pages of several moments.

use super::*;
use sim::scene::Row;

/// A bar of a length along x and a height, with a colour.
fn bar(length_m: f64, height_m: f64, value: f64) -> Scene {
    let p = |x, z| Point::new(x, 0.0, z);
    let colour = ColourScale {
        title: "moved".into(),
        unit: "mm".into(),
        low: 0.0,
        high: 1.0,
        limit: Some(0.5),
    };
    Scene {
        strands: vec![StrandShape {
            points: vec![p(0.0, 0.0), p(length_m, height_m)],
            radius_m: 0.003,
            value: Some(value),
            highlighted: false,
        }],
        bed: Some(BedShape { pose: Pose::identity(), size_m: [0.5, 0.5] }),
        title: "after 1 of 3 strands\nat most 1 mm\nmore".into(),
        colour: Some(colour),
        ..Scene::default()
    }
}

fn row(row: &Row, size_px: (u32, u32), backend: Backend) -> Result<Picture, RenderError> {
    draw(Task::Row { row: Box::new(row.clone()), size_px }, backend)
}

fn page(scenes: Vec<Scene>) -> Row {
    let notes = vec!["thin lines: as planned".into(), "word ".repeat(40)];
    Row { title: "A row".into(), scenes, notes, stamp: Some("illustration".into()) }
}

/// Long things are drawn below each other, tall ones beside, all at one scale and inside their picture.
#[test]
fn moments_lie_where_they_are_largest() {
    for (length_m, height_m, is_below) in [(0.2, 0.01, true), (0.01, 0.2, false)] {
        let scenes = [0.1, 0.2, 0.3].map(|value| bar(length_m, height_m, value)).to_vec();
        let drawn = row(&page(scenes), (960, 660), Backend::Cpu).expect("draws");
        assert_eq!(drawn.views.len(), 3);
        let [first, second] = [0, 1].map(|k| drawn.views[k].0);
        assert_eq!((first.0 == second.0, first.1 == second.1), (is_below, !is_below));
        for (_, view) in &drawn.views {
            assert!((view.px_per_m - drawn.views[0].1.px_per_m).abs() < 1e-9);
            for end in [Point::origin(), Point::new(length_m, 0.0, height_m)] {
                let [x, y, _] = view.project(end);
                assert!(x > 0.0 && y > 0.0);
                assert!(x < f64::from(view.size_px.0) && y < f64::from(view.size_px.1));
            }
        }
    }
}

/// The card and the rays draw the same page, but for who drew it.
#[test]
fn card_and_rays_draw_the_same_row() {
    let scenes = vec![scene(), bar(0.5, 0.1, 0.8)];
    let [card, rays] =
        [Backend::Gpu, Backend::Cpu].map(|choice| row(&page(scenes.clone()), (800, 560), choice));
    let card = match card {
        Ok(card) => card,
        Err(e) => {
            eprintln!("skipped: {e}");
            return;
        }
    };
    let (card, rays) = (card.rgba, rays.expect("draws").rgba);
    let apart = |(a, b): (&Rgba<u8>, &Rgba<u8>)| (0..3).any(|c| a[c].abs_diff(b[c]) > 24);
    let other = card.pixels().zip(rays.pixels()).filter(|pair| apart(*pair)).count();
    let total = card.width() * card.height();
    eprintln!("{other} of {total} pixels differ");
    assert!(other * 100 < total as usize, "{other} of {total}");
}

#[test]
fn odd_rows_draw() {
    let mut odd = scene();
    odd.title = "long ".repeat(200);
    odd.strands[0].points[0] = Point::new(f64::NAN, f64::INFINITY, 0.0);
    for scenes in [vec![], vec![Scene::default()], vec![odd; 9], vec![bar(1e6, 0.0, f64::NAN)]] {
        for size_px in [(240, 240), (320, 700), (900, 300)] {
            assert!(row(&page(scenes.clone()), size_px, Backend::Cpu).is_ok());
        }
    }
    assert!(row(&Row::default(), (9, 9), Backend::Cpu).is_err());
}
