//! Pixels against rays of parry3d's own shapes: another program's idea of what is seen, and how far it is.

use parry3d::math::Vector;
use parry3d::query::{Ray, RayCast as _};
use parry3d::shape::{Capsule, Triangle};
use render::{Backend, Camera, Probe, probe};
use sim::film::{Film, Look, Player};
use sim::pose::{Point, Vector as Vector64};
use sim::scene::Scene;
use sim::scene::solid::{HitId, solids};

use crate::tools::root;

/// Pixels asked of each scenario.
const PIXELS: usize = 10_000;
const SIZE_PX: (u32, u32) = (960, 600);
/// Off edges, at least this share must show the same thing.
const SAME: f64 = 0.995;
/// Depths may differ by this, m.
const DEPTH_M: f64 = 1e-4;

/// Scenario, and when as a share of the program.
const SHOWN: [(&str, f64); 5] = [
    ("tapered-helix", 1.0),
    ("lattice", 0.6),
    ("bunny-wireframe", 0.5),
    ("dome-on-form", 0.7),
    ("beam-150", 1.0),
];

/// By the card, which may be software.
#[test]
fn pixels_show_what_rays_of_parry_meet() {
    for (name, share) in SHOWN {
        let job = root().join("scenarios").join(name).join("job.slam");
        let checked = cli::checked(&job).expect("a scenario");
        let film = Film::new(&checked);
        let frame = Player::new(&checked).frame_at(share * film.total_s);
        let scene = film.scene(&frame, &Look::default());
        let seen = match probe(&scene, Camera::Isometric, SIZE_PX, Backend::Gpu) {
            Ok(seen) => seen,
            // rays draw by rays of our own: they would be held against their like
            Err(error) => return eprintln!("skipped: {error}"),
        };
        compare(name, &scene, &seen);
    }
}

fn compare(name: &str, scene: &Scene, seen: &Probe) {
    let rays = Rays::new(scene, &seen.projection);
    // a fixed walk over the picture: no two runs differ
    let mut state = 0x2545_F491_4F6C_DD1D_u64;
    let mut next = |n: u32| {
        state =
            state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        ((state >> 33) % u64::from(n)) as u32
    };
    let (mut asked, mut edges, mut same, mut deepest_m, mut things) = (0, 0, 0, 0.0_f64, 0);
    while asked < PIXELS {
        let (x, y) = (1 + next(SIZE_PX.0 - 2), 1 + next(SIZE_PX.1 - 2));
        asked += 1;
        let at = |x: u32, y: u32| (y * SIZE_PX.0 + x) as usize;
        let id = seen.things[at(x, y)];
        let around = (0..9).map(|k| seen.things[at(x + k % 3 - 1, y + k / 3 - 1)]);
        if around.into_iter().any(|there| there != id) {
            edges += 1;
            continue;
        }
        let met = rays.cast(f64::from(x) + 0.5, f64::from(y) + 0.5);
        if met.map(|(id, _)| id) == id {
            same += 1;
            if let Some((_, depth_m)) = met {
                things += 1;
                deepest_m = deepest_m.max((depth_m - f64::from(seen.depth_m[at(x, y)])).abs());
            }
        }
    }
    let off_edges = asked - edges;
    let share = f64::from(same) / off_edges as f64;
    eprintln!(
        "{name}: {asked} pixels, {edges} on edges, {:.3} % the same, {things} things within {:.4} mm; {}",
        share * 100.0,
        deepest_m * 1e3,
        seen.drawn_by
    );
    assert!(things > PIXELS / 50, "{name}: hardly anything is seen");
    assert!(share >= SAME, "{name}: {same} of {off_edges} pixels off edges show the same thing");
    assert!(deepest_m <= DEPTH_M, "{name}: depth off by {} mm", deepest_m * 1e3);
}

/// Everything as shapes of parry3d, about the middle of the view in its own axes: f32 is kept small.
struct Rays {
    view: render::Projection,
    capsules: Vec<(Capsule, HitId)>,
    triangles: Vec<(Triangle, HitId)>,
}

impl Rays {
    fn new(scene: &Scene, view: &render::Projection) -> Rays {
        let all = solids(scene, |_| true);
        let place = |p: &Point| {
            let v: Vector64 = view.in_view(*p);
            Vector::new(v.x as f32, v.y as f32, v.z as f32)
        };
        let capsule = |c: &sim::scene::solid::Capsule| {
            (Capsule::new(place(&c.a), place(&c.b), c.radius_m as f32), c.id)
        };
        let triangle = |t: &sim::scene::solid::Triangle| {
            let [a, b, c] = t.points.each_ref().map(place);
            (Triangle::new(a, b, c), t.id)
        };
        Rays {
            view: *view,
            capsules: all.capsules.iter().map(capsule).collect(),
            triangles: all.triangles.iter().map(triangle).collect(),
        }
    }

    /// The first thing on the ray of a pixel, and its depth.
    fn cast(&self, x_px: f64, y_px: f64) -> Option<(HitId, f64)> {
        const BACK: f32 = -10.0;
        let at = self.view.in_view(self.view.unproject(x_px, y_px, 0.0));
        let (x, y) = (at.x as f32, at.y as f32);
        let mut nearest: Option<(HitId, f64)> = None;
        let mut take = |id, depth_m: f64| {
            if nearest.is_none_or(|(_, known_m)| depth_m < known_m) {
                nearest = Some((id, depth_m));
            }
        };
        for (capsule, id) in &self.capsules {
            let [a, b] = [capsule.segment.a, capsule.segment.b];
            let r = capsule.radius;
            let beside = |p: f32, q: f32, at: f32| at < p.min(q) - r || at > p.max(q) + r;
            if beside(a.x, b.x, x) || beside(a.y, b.y, y) {
                continue;
            }
            // from near by, since parry searches capsules step by step in f32
            let from = a.z.min(b.z) - 2.0 * r;
            let ray = Ray::new(Vector::new(x, y, from), Vector::new(0.0, 0.0, 1.0));
            if let Some(t) = capsule.cast_local_ray(&ray, f32::MAX, false) {
                take(*id, f64::from(from) + f64::from(t));
            }
        }
        let ray = Ray::new(Vector::new(x, y, BACK), Vector::new(0.0, 0.0, 1.0));
        for (triangle, id) in &self.triangles {
            if let Some(t) = triangle.cast_local_ray(&ray, f32::MAX, false) {
                take(*id, f64::from(BACK) + f64::from(t));
            }
        }
        nearest
    }
}
