//! A frame of many strands: 20 000 capsules, 1280×720 with 2×2 samples a pixel, shadow, eye-dome lighting, outlines, letters.
//!
//! By the card (lavapipe where there is no other) with the adapter kept open, and by rays.

#![allow(missing_docs, clippy::print_stdout)] // made by criterion's macros; says who drew

use std::f64::consts::TAU;
use std::time::Duration;

use criterion::{Criterion, criterion_group, criterion_main};
use render::{Backend, Camera, Fit, Studio, Task, View};
use sim::pose::{Point, Pose};
use sim::scene::{BedShape, ColourScale, Scene, StrandShape};

const CAPSULES: usize = 20_000;

/// A helix of single capsules on a bed.
fn helix() -> Scene {
    let place = |i: usize| {
        let turns = i as f64 / 200.0;
        let (sin, cos) = (TAU * turns).sin_cos();
        Point::new(0.1 * cos, 0.1 * sin, 0.002 + 0.003 * turns)
    };
    let strand = |i: usize| StrandShape {
        points: vec![place(i), place(i + 1)],
        radius_m: 0.0012,
        value: Some(i as f64),
        highlighted: false,
    };
    Scene {
        strands: (0..CAPSULES).map(strand).collect(),
        bed: Some(BedShape { pose: Pose::identity(), size_m: [0.3, 0.3] }),
        title: "bench".into(),
        colour: Some(ColourScale {
            title: "order".into(),
            unit: String::new(),
            low: 0.0,
            high: CAPSULES as f64,
            limit: None,
        }),
        ..Scene::default()
    }
}

fn frame(criterion: &mut Criterion) {
    let view =
        View { size_px: (1280, 720), camera: Camera::Isometric, fit: Fit::Part, ghost_arm: false };
    let task = Task::View { scene: Box::new(helix()), view };
    let mut group = criterion.benchmark_group("frame of 20000 capsules");
    group.sample_size(10).measurement_time(Duration::from_secs(20));
    for (name, backend) in [("card", Backend::Gpu), ("rays", Backend::Cpu)] {
        let mut studio = Studio::new(backend, None);
        match studio.draw(&task) {
            Ok(picture) => {
                println!("{name}: {}", picture.drawn_by);
                group.bench_function(name, |bencher| bencher.iter(|| studio.draw(&task)));
            }
            Err(error) => println!("{name}: left out, {error}"),
        }
    }
}

criterion_group!(benches, frame);
criterion_main!(benches);
