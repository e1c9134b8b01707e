//! Draws a made-up cell: `demo OUT_DIR [strand segments] [gpu|cpu]`. Shows the pictures and how long they take.
#![allow(clippy::print_stdout)] // a program for the terminal

use render::{Backend, Camera, Fit, Studio, Task, View};
use sim::pose::{Point, Pose, Vector};
use sim::scene::{
    BedShape, Body, BodyKind, Bounds, ColourScale, Mark, MarkSeverity, Scene, Shape, StrandShape,
};
use std::f64::consts::TAU;
use std::time::Instant;

fn body(name: &str, kind: BodyKind, shape: Shape) -> Body {
    Body { name: name.into(), kind, pose: Pose::identity(), shape, highlighted: false }
}

/// An arm of about 0.9 m reach over a plate.
fn cell() -> Scene {
    let p = Point::new;
    let arm = |name, a, b, radius_m| body(name, BodyKind::Arm, Shape::Capsule { a, b, radius_m });
    let half_m = Vector::new(0.02, 0.35, 0.2);
    Scene {
        bodies: vec![
            body("base", BodyKind::Arm, Shape::cylinder(p(0.0, 0.0, 0.0), p(0.0, 0.0, 0.2), 0.13)),
            arm("shoulder", p(0.0, -0.07, 0.40), p(0.03, 0.07, 0.40), 0.10),
            body(
                "column",
                BodyKind::Arm,
                Shape::Cone {
                    from: p(0.0, 0.0, 0.2),
                    to: p(0.01, 0.0, 0.40),
                    radius_from_m: 0.12,
                    radius_to_m: 0.09,
                },
            ),
            arm("upper arm", p(0.03, 0.0, 0.40), p(0.14, 0.0, 0.84), 0.068),
            arm("elbow", p(0.14, -0.05, 0.84), p(0.14, 0.05, 0.84), 0.075),
            arm("forearm", p(0.15, 0.0, 0.86), p(0.52, 0.0, 0.80), 0.050),
            arm("wrist", p(0.54, 0.0, 0.79), p(0.56, 0.0, 0.74), 0.042),
            body(
                "flange",
                BodyKind::Tool,
                Shape::cylinder(p(0.56, 0.0, 0.70), p(0.56, 0.0, 0.67), 0.05),
            ),
            body(
                "feeder",
                BodyKind::Tool,
                Shape::Box {
                    half_m: Vector::new(0.03, 0.04, 0.06),
                    pose: Pose::translation(0.56, 0.0, 0.61),
                },
            ),
            body(
                "barrel",
                BodyKind::Tool,
                Shape::cylinder(p(0.56, 0.0, 0.55), p(0.56, 0.0, 0.40), 0.016),
            ),
            body(
                "heater",
                BodyKind::Tool,
                Shape::Box {
                    half_m: Vector::new(0.022, 0.016, 0.013),
                    pose: Pose::translation(0.56, 0.0, 0.39),
                },
            ),
            body(
                "nozzle",
                BodyKind::Nozzle,
                Shape::Cone {
                    from: p(0.56, 0.0, 0.378),
                    to: p(0.56, 0.0, 0.3185),
                    radius_from_m: 0.014,
                    radius_to_m: 0.002,
                },
            ),
            body(
                "wall",
                BodyKind::Obstacle,
                Shape::Box { half_m, pose: Pose::translation(-0.35, 0.2, 0.2) },
            ),
        ],
        bed: Some(BedShape { pose: Pose::translation(0.5, 0.0, 0.15), size_m: [0.4, 0.4] }),
        title: "tapered-helix: KR 6 R900 sixx, PLA".into(),
        colour: Some(ColourScale {
            title: "Sag behind the nozzle".into(),
            unit: "mm".into(),
            low: 0.0,
            high: 2.5,
            limit: Some(2.0),
        }),
        ..Scene::default()
    }
}

/// A tapered lattice: rings, and struts between them, with about `n` segments.
fn deposit(scene: &mut Scene, n: usize) {
    let (rings, struts) = (6, 24);
    let per_ring = (n / (rings * 3)).max(24);
    let at = |level: f64, turn: f64| {
        let r = 0.06 + 0.025 * (level * 1.1).cos();
        Point::new(0.5 + r * (TAU * turn).cos(), r * (TAU * turn).sin(), 0.152 + 0.033 * level)
    };
    let mut add = |points: Vec<Point>, value: f64| {
        scene.strands.push(StrandShape {
            points,
            radius_m: 0.0015,
            value: Some(value),
            highlighted: false,
        });
    };
    for level in 0..rings {
        let l = level as f64;
        for k in 0..8 {
            let turn = |i: usize| (k as f64 + i as f64 * 8.0 / per_ring as f64) / 8.0;
            let points = (0..=per_ring / 8).map(|i| at(l, turn(i))).collect();
            add(points, 0.25 * l + 0.1 * k as f64);
        }
        if level + 1 < rings {
            for k in 0..struts {
                let (a, b) = (k as f64 / struts as f64, (k as f64 + 1.0) / struts as f64);
                let many = (2 * per_ring / struts).max(1);
                let up = |i: usize| {
                    let t = i as f64 / many as f64;
                    let (p, q) = (at(l, a), at(l + 1.0, if k % 2 == 0 { b } else { a }));
                    p + (q - p) * t - Vector::z() * 0.006 * t * (1.0 - t)
                };
                add((0..=many).map(up).collect(), 0.45 * l + 0.03 * k as f64);
            }
        }
    }
    let mark = |at, label: &str, severity| Mark { at, label: label.into(), severity };
    scene.marks.push(mark(at(4.0, 0.9), "P301 sag 2.6 mm", MarkSeverity::Error));
    scene.marks.push(mark(at(2.0, 0.8), "C201 clearance 0.7 mm", MarkSeverity::Warning));
    scene.part_bounds = Bounds::of(scene.strands.iter().flat_map(|s| s.points.clone()));
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut args = std::env::args().skip(1);
    let out = std::path::PathBuf::from(args.next().unwrap_or_else(|| ".".into()));
    let n: usize = args.next().map_or(Ok(1200), |a| a.parse())?;
    let only = args.next();
    println!("adapters: {:?}", render::adapters());
    let mut scene = cell();
    deposit(&mut scene, n);
    let segments: usize = scene.strands.iter().map(|s| s.points.len() - 1).sum();
    for (name, choice) in [("gpu", Backend::Gpu), ("cpu", Backend::Cpu)] {
        if only.as_deref().is_some_and(|o| o != name) {
            continue;
        }
        let start = Instant::now();
        let done = Studio::new(choice, None)
            .draw(&Task::Sheet { scene: Box::new(scene.clone()), size_px: (1600, 900) })?;
        println!("sheet {name}: {segments} segments, {:.2?}, {}", start.elapsed(), done.drawn_by);
        done.rgba.save(out.join(format!("sheet-{name}.png")))?;
        for (view, camera) in
            [("iso", Camera::Isometric), ("front", Camera::Front), ("top", Camera::Top)]
        {
            let start = Instant::now();
            let ask = View { size_px: (1280, 800), camera, fit: Fit::Cell, ghost_arm: false };
            let done = Studio::new(choice, None)
                .draw(&Task::View { scene: Box::new(scene.clone()), view: ask })?;
            println!("{view} {name}: {:.2?}", start.elapsed());
            done.rgba.save(out.join(format!("{view}-{name}.png")))?;
        }
    }
    Ok(())
}
