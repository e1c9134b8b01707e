#![allow(clippy::print_stderr)] // a test that skips says why

mod animation;
mod row;

use super::*;
use crate::layer::{Things, thing};
use crate::overlay::{legend::ticks, round_below};
use crate::text::{Anchor, Ink, Pen};
use crate::view::Margins;
use image::{Rgba, RgbaImage};
use sim::pose::{Point, Pose, Vector};
use sim::scene::solid::HitId;
use sim::scene::{
    BedShape, Body, BodyKind, ColourScale, Mark, MarkSeverity, Scene, Shape, StrandShape,
};

fn draw(task: Task, backend: Backend) -> Result<Picture, RenderError> {
    Studio::new(backend, None).draw(&task)
}

fn picture(scene: &Scene, view: &View, backend: Backend) -> Result<Picture, RenderError> {
    draw(Task::View { scene: Box::new(scene.clone()), view: view.clone() }, backend)
}

fn sheet(scene: &Scene, size_px: (u32, u32), backend: Backend) -> Result<Picture, RenderError> {
    draw(Task::Sheet { scene: Box::new(scene.clone()), size_px }, backend)
}

fn body(kind: BodyKind, shape: Shape) -> Body {
    Body { name: format!("{kind:?}"), kind, pose: Pose::identity(), shape, highlighted: false }
}

/// One of each shape, a bed, an obstacle and a spiral.
pub(crate) fn scene() -> Scene {
    let p = Point::new;
    let spiral = |i: i32| {
        let a = 0.2 * f64::from(i);
        p(0.4 + 0.06 * a.cos(), 0.06 * a.sin(), 0.001 + 0.0006 * f64::from(i))
    };
    let half_m = Vector::new(0.02, 0.2, 0.15);
    Scene {
        planned: Vec::new(),
        bodies: vec![
            body(
                BodyKind::Arm,
                Shape::Capsule { a: p(0.0, 0.0, 0.1), b: p(0.0, 0.0, 0.4), radius_m: 0.08 },
            ),
            body(BodyKind::Tool, Shape::cylinder(p(0.4, 0.0, 0.2), p(0.4, 0.0, 0.3), 0.03)),
            body(
                BodyKind::Nozzle,
                Shape::Cone {
                    from: p(0.4, 0.0, 0.2),
                    to: p(0.46, 0.0, 0.13),
                    radius_from_m: 0.02,
                    radius_to_m: 0.002,
                },
            ),
            body(
                BodyKind::Obstacle,
                Shape::Box { half_m, pose: Pose::translation(0.4, 0.5, 0.15) },
            ),
            body(BodyKind::OtherArm, Shape::sphere(p(0.0, 0.3, 0.1), 0.1)),
        ],
        strands: (0..200)
            .map(|i| StrandShape {
                points: vec![spiral(i), spiral(i + 1)],
                radius_m: 0.002,
                value: Some(f64::from(i) / 20.0),
                highlighted: false,
            })
            .collect(),
        bed: Some(BedShape { pose: Pose::translation(0.4, 0.0, 0.0), size_m: [0.3, 0.3] }),
        title: "Test scene".into(),
        marks: vec![Mark { at: spiral(100), label: "C201".into(), severity: MarkSeverity::Error }],
        colour: Some(ColourScale {
            title: "Sag".into(),
            unit: "mm".into(),
            low: 0.0,
            high: 9.0,
            limit: Some(6.0),
        }),
        part_bounds: None,
    }
}

fn view(camera: Camera) -> View {
    View { size_px: (480, 320), camera, fit: Fit::Cell, ghost_arm: false }
}

const CAMERAS: [Camera; 5] = [
    Camera::Isometric,
    Camera::Front,
    Camera::Side,
    Camera::Top,
    Camera::Orbit { azimuth_deg: 130.0, elevation_deg: -20.0 },
];

#[test]
fn axes_are_right_handed_and_named_as_said() {
    for camera in CAMERAS {
        let [right, up, forward] = camera.axes();
        assert!((right.cross(&up) + forward).norm() < 1e-12, "{camera:?}");
        assert!((right.norm() - 1.0).abs() < 1e-12 && right.dot(&up).abs() < 1e-12);
    }
    let [right, up, forward] = Camera::Front.axes();
    assert!(
        (right - Vector::x()).norm() + (up - Vector::z()).norm() + (forward - Vector::y()).norm()
            < 1e-12
    );
    let [right, up, _] = Camera::Top.axes();
    assert!((right - Vector::x()).norm() + (up - Vector::y()).norm() < 1e-12);
    let [right, up, _] = Camera::Side.axes();
    assert!((right - Vector::y()).norm() + (up - Vector::z()).norm() < 1e-12);
}

/// A ball of known place is drawn where `project` says, with the diameter that the scale says.
#[test]
fn a_ball_falls_on_its_pixel() {
    let at = Point::new(0.3, -0.2, 0.5);
    let mut scene = Scene::default();
    scene.bodies.push(body(BodyKind::Nozzle, Shape::sphere(at, 0.05)));
    // something far off, so that the ball is not in the middle
    scene.bodies.push(body(BodyKind::Arm, Shape::sphere(Point::new(-0.9, 0.8, -0.3), 0.1)));
    for camera in CAMERAS {
        let engine = Engine::Cpu { because: None };
        let things = Things::new(&scene, &engine, 0.0, |_| true);
        let axes = camera.axes();
        let points = layer::outline(&things.solids, &axes);
        let projection = Projection::fit(axes, points, (400, 300), Margins::default());
        let layer = things.capture(&engine, &projection).expect("draws");
        let ball: Vec<[f64; 2]> = (0..300)
            .flat_map(|y| (0..400).map(move |x| (x, y)))
            .filter(|(x, y)| thing(layer.at(*x, *y).id) == Some(HitId::Body(0)))
            .map(|(x, y)| [x as f64 + 0.5, y as f64 + 0.5])
            .collect();
        let n = ball.len() as f64;
        let [x, y, depth_m] = projection.project(at);
        for (axis, want) in [x, y].into_iter().enumerate() {
            let mean = ball.iter().map(|p| p[axis]).sum::<f64>() / n;
            assert!((mean - want).abs() < 0.15, "{camera:?}: {mean} {want}");
        }
        let area = std::f64::consts::PI * (0.05 * projection.px_per_m).powi(2);
        assert!((n / area - 1.0).abs() < 0.05, "{camera:?}: {n} {area}");
        let middle = layer.at(x as i64, y as i64).depth_m;
        assert!((f64::from(middle) - (depth_m - 0.05)).abs() < 1e-4);
        assert!((projection.unproject(x, y, depth_m) - at).norm() < 1e-12);
    }
}

/// Both engines see the same thing at the same depth with the same normal.
#[test]
fn card_and_rays_agree() {
    let gpu = match gpu::Gpu::open() {
        Ok(gpu) => Engine::Gpu(Box::new(gpu)),
        Err(e) => {
            eprintln!("skipped: {e}");
            return;
        }
    };
    let rays = Engine::Cpu { because: None };
    let scene = scene();
    for camera in CAMERAS {
        let axes = camera.axes();
        let by = |engine: &Engine| {
            let plain = Things::new(&scene, engine, 0.0, |_| true);
            let points = layer::outline(&plain.solids, &axes);
            let projection = Projection::fit(axes, points, (960, 640), Margins::default());
            // as wide as pictures draw them
            let things = Things::new(&scene, engine, 1.2 / projection.px_per_m, |_| true);
            things.capture(engine, &projection).expect("draws")
        };
        let (card, ray) = (by(&gpu), by(&rays));
        let total = card.samples.len();
        let seen = ray.samples.iter().filter(|s| s.id != layer::NOTHING).count();
        assert!(seen > total / 20, "{camera:?}: {seen}");
        let (mut other, mut deep, mut bent) = (0, 0, 0);
        for (a, b) in card.samples.iter().zip(&ray.samples) {
            if a.id != b.id {
                other += 1;
            } else if a.id != layer::NOTHING {
                deep += usize::from((a.depth_m - b.depth_m).abs() > 1e-4);
                let apart = (a.normal[0] - b.normal[0]).hypot(a.normal[1] - b.normal[1]);
                bent += usize::from(apart > 0.02);
            }
        }
        eprintln!("{camera:?}: {seen} seen, {other} other, {deep} deep, {bent} bent");
        // f32 against f64 on silhouettes
        assert!(other * 500 < seen, "{camera:?}: {other} of {seen} show another thing");
        assert!(deep * 500 < seen, "{camera:?}: {deep} of {seen} at another depth");
        assert!(bent * 200 < seen, "{camera:?}: {bent} of {seen} with another normal");
    }
}

/// A wanted card that is not there is an error; any machine will do for `Auto`.
#[test]
fn pictures_are_drawn_and_written() {
    let scene = scene();
    for choice in [Backend::Auto, Backend::Cpu] {
        let picture = picture(&scene, &view(Camera::Isometric), choice).expect("draws");
        assert_eq!(picture.rgba.dimensions(), (480, 320));
        assert!(picture.rgba.pixels().all(|p| p[3] == 255));
        if choice == Backend::Cpu {
            assert_eq!(picture.drawn_by, DrawnBy::Cpu { because: None });
        }
        let path =
            std::env::temp_dir().join(format!("twin-render-{}-{choice:?}.png", std::process::id()));
        picture.rgba.save(&path).expect("writes");
        let back = image::open(&path).expect("reads").to_rgba8();
        assert_eq!(back, picture.rgba);
        std::fs::remove_file(&path).expect("removes");
    }
    if let Err(e) = picture(&scene, &view(Camera::Top), Backend::Gpu) {
        assert!(matches!(e, RenderError::NoAdapter(_)), "{e}");
        eprintln!("skipped the card: {e}");
    }
}

#[test]
fn rays_draw_the_same_bytes_twice() {
    let one = sheet(&scene(), (640, 400), Backend::Cpu).expect("draws");
    let two = sheet(&scene(), (640, 400), Backend::Cpu).expect("draws");
    assert_eq!(one.rgba, two.rgba);
    assert_eq!(one.views.len(), 2);
}

#[test]
fn odd_scenes_draw() {
    let nan = Point::new(f64::NAN, 0.0, f64::INFINITY);
    let mut odd = scene();
    odd.strands.push(StrandShape {
        points: vec![nan, nan],
        radius_m: 0.1,
        value: Some(f64::NAN),
        highlighted: true,
    });
    odd.marks.push(Mark { at: nan, label: "lost\n\u{1F600}".into(), severity: MarkSeverity::Note });
    odd.title = "long ".repeat(2000);
    odd.colour = Some(ColourScale {
        title: String::new(),
        unit: String::new(),
        low: 1.0,
        high: 1.0,
        limit: Some(f64::NAN),
    });
    for scene in [Scene::default(), odd] {
        for camera in CAMERAS {
            let view = View { fit: Fit::Part, ghost_arm: true, ..view(camera) };
            assert!(picture(&scene, &view, Backend::Cpu).is_ok());
        }
        assert!(sheet(&scene, (400, 240), Backend::Auto).is_ok());
        assert!(sheet(&scene, (240, 240), Backend::Cpu).is_ok());
    }
    let refused =
        picture(&Scene::default(), &View { size_px: (0, 9), ..view(Camera::Top) }, Backend::Cpu);
    assert_eq!(refused.map(|_| ()), Err(RenderError::Size { width: 0, height: 9 }));
}

#[test]
fn letters_leave_ink() {
    let pen = Pen::new().expect("font");
    let mut image = RgbaImage::from_pixel(200, 40, Rgba([255; 4]));
    let ink = Ink { size: 24.0, rgb: 0x000000, halo: 0.0 };
    pen.write(&mut image, [10.0, 20.0], Anchor::Left, ink, "12.5 µm °C");
    let dark: Vec<u32> =
        image.enumerate_pixels().filter(|(_, _, p)| p[0] < 128).map(|(x, _, _)| x).collect();
    let (first, last) = (dark.iter().min().copied(), dark.iter().max().copied());
    let width = pen.width("12.5 µm °C", 24.0);
    assert!(dark.len() > 150 && first >= Some(10), "{} {first:?}", dark.len());
    assert!(last.is_some_and(|x| (x as f32 - 10.0 - width).abs() < 4.0), "{last:?} {width}");
    assert!(pen.width(&pen.cut("a very long title indeed", 20.0, 90.0), 20.0) <= 90.0);
}

#[test]
fn ticks_are_round() {
    let texts = |low, high| ticks(low, high).into_iter().map(|(_, t)| t).collect::<Vec<_>>();
    assert_eq!(texts(0.0, 1.0), ["0.0", "0.2", "0.4", "0.6", "0.8", "1.0"]);
    assert_eq!(texts(-3.0, 12.0), ["-2", "0", "2", "4", "6", "8", "10", "12"]);
    assert_eq!(texts(0.0, 0.037), ["0.00", "0.01", "0.02", "0.03"]);
    assert_eq!(texts(5.0, 5.0).len(), 1);
    assert!(texts(f64::NAN, 1.0).is_empty());
    for (most, round) in [(0.37, 0.2), (9.99, 5.0), (100.0, 100.0), (1e-3, 1e-3)] {
        assert!((round_below(most) / round - 1.0).abs() < 1e-12);
    }
}
