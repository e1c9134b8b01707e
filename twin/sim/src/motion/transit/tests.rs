use proptest::prelude::*;

use super::arena::Arena;
use super::ask::{Ask, Free};
use super::metric::{Metric, Room};
use super::random::Random;
use super::rrt::{Search, Tree};
use super::*;
use crate::finding::{Code, Phase, Site};
use crate::kinematics::{Chain, ChainJoint, JointKind};
use crate::pose::{Pose, Vector};
use crate::preflight::preflight;
use crate::test_job::{job, strand, text, try_job};

/// A chain of turning joints about z, links along x.
fn planar(links_m: &[f64], limit_rad: f64) -> Chain {
    let joint = |index: usize| {
        let offset_m = if index == 0 { 0.0 } else { links_m[index - 1] };
        ChainJoint {
            name: format!("joint_{index}"),
            kind: JointKind::Revolute,
            parent_from_joint: Pose::translation(offset_m, 0.0, 0.0),
            axis: Vector::z(),
            lower: -limit_rad,
            upper: limit_rad,
            velocity: 1.0,
            effort: None,
            mimic: None,
        }
    };
    let tip = Pose::translation(links_m[links_m.len() - 1], 0.0, 0.0);
    Chain::new((0..links_m.len()).map(joint).collect(), tip).expect("a sound chain")
}

/// A box in joint space, as obstacle.
struct Wall {
    name: &'static str,
    low: Vec<f64>,
    high: Vec<f64>,
}

impl Wall {
    /// Where the straight move enters the box grown by `need`, as share; exact.
    fn enters(&self, from: &Posture, to: &Posture, need: f64) -> Option<f64> {
        let (mut first, mut last) = (0.0_f64, 1.0_f64);
        for k in 0..from.len() {
            let (low, high) = (self.low[k] - need, self.high[k] + need);
            let step = to[k] - from[k];
            if step.abs() < 1e-15 {
                if from[k] < low || from[k] > high {
                    return None;
                }
                continue;
            }
            let (a, b) = ((low - from[k]) / step, (high - from[k]) / step);
            first = first.max(a.min(b));
            last = last.min(a.max(b));
        }
        (first <= last).then_some(first)
    }
}

fn among<'a>(walls: &'a [Wall]) -> impl Fn(&Posture, &Posture, f64) -> Result<(), Blocked> + 'a {
    move |from, to, need| {
        let entered = walls
            .iter()
            .filter_map(|wall| wall.enters(from, to, need).map(|share| (share, wall.name)));
        match entered.min_by(|a, b| a.0.total_cmp(&b.0)) {
            None => Ok(()),
            Some((share, name)) => {
                Err(Blocked { share, clearance_m: 0.0, pair: ["tool".to_owned(), name.to_owned()] })
            }
        }
    }
}

fn no_exits(_: &Posture) -> Vec<Exit> {
    Vec::new()
}

/// Plans one move among `free`, home at the start, limits ±π.
fn solve(chain: &Chain, from: &Posture, to: &Posture, free: &Free<'_>, seed: u64) -> Transit {
    let metric = Metric::new(chain, 0.0);
    let room = Room::new(chain, 0.0, &[*from, *to]);
    let arena = Arena {
        metric: &metric,
        room,
        from: *from,
        to: *to,
        home: *from,
        limit_m: 0.01,
        free,
        exits: &no_exits,
    };
    arena.straight().unwrap_or_else(|| arena.search(seed, 4000))
}

/// Every move of a way by a hundred postures, each asked for by itself.
#[track_caller]
fn stays_clear(way: &[Posture], free: &Free<'_>, need_m: f64) {
    for pair in way.windows(2) {
        for k in 0..=100 {
            let q = pair[0].toward(&pair[1], f64::from(k) / 100.0);
            assert_eq!(free(&q, &q, need_m), Ok(()), "at {:?}", &q[..]);
        }
    }
}

/// A wall across six joints with a hole of 0.6 by 1 rad in two of them.
fn wall_with_hole() -> Vec<Wall> {
    let whole = |low: [f64; 3], high: [f64; 3], name| {
        let mut wall = Wall { name, low: vec![-9.0; 6], high: vec![9.0; 6] };
        wall.low[..3].copy_from_slice(&low);
        wall.high[..3].copy_from_slice(&high);
        wall
    };
    vec![
        whole([-0.1, -9.0, -9.0], [0.1, 0.7, 9.0], "left"),
        whole([-0.1, 1.3, -9.0], [0.1, 9.0, 9.0], "right"),
        whole([-0.1, -9.0, -9.0], [0.1, 9.0, -0.5], "below"),
        whole([-0.1, -9.0, 0.5], [0.1, 9.0, 9.0], "above"),
    ]
}

#[test]
fn a_way_leads_through_a_hole_in_a_wall() {
    let chain = planar(&[0.4, 0.4, 0.3, 0.2, 0.1, 0.1], 3.0);
    let (from, to) = (
        Posture::new(&[-1.5, -1.0, 0.0, 0.0, 1.0, 0.0]),
        Posture::new(&[1.5, -1.0, 0.5, 0.0, -1.0, 0.0]),
    );
    let walls = wall_with_hole();
    let free = among(&walls);
    let mut n_wide = 0;
    for seed in 0..20 {
        let transit = solve(&chain, &from, &to, &free, seed);
        assert!(transit.n_checks < 2 * 4000 + 200, "{}", transit.n_checks);
        // a search may give up; whatever it finds is clear
        if transit.how.is_some() {
            assert_eq!(transit.how, Some(How::Search));
            assert_eq!((transit.way[0], transit.way[transit.way.len() - 1]), (from, to));
            stays_clear(&transit.way, &free, transit.keeps_m);
            n_wide += usize::from(transit.keeps_m == 0.02);
        }
    }
    assert!(n_wide >= 18, "{n_wide}");
}

/// The same seed gives the same way; another seed another one.
#[test]
fn ways_follow_from_their_seed() {
    let chain = planar(&[0.4, 0.4, 0.3, 0.2, 0.1, 0.1], 3.0);
    let (from, to) = (
        Posture::new(&[-1.5, 0.0, 0.0, 0.0, 0.0, 0.0]),
        Posture::new(&[1.5, 0.0, 0.0, 0.0, 0.0, 0.0]),
    );
    let walls = wall_with_hole();
    let free = among(&walls);
    let once = solve(&chain, &from, &to, &free, 7);
    assert_eq!(once, solve(&chain, &from, &to, &free, 7));
    assert_ne!(once.way, solve(&chain, &from, &to, &free, 8).way);
}

#[test]
fn nothing_in_the_way_is_a_direct_move() {
    let chain = planar(&[0.5, 0.5, 0.2], 3.0);
    let (from, to) = (Posture::new(&[0.0; 3]), Posture::new(&[1.0, -1.0, 0.5]));
    let transit = solve(&chain, &from, &to, &among(&[]), 0);
    assert_eq!((transit.how, transit.n_checks), (Some(How::Direct), 1));
    assert_eq!(transit.way, [from, to]);
}

/// A goal in a closed shell: none is found, and the shell is told, at the goal, not what else
/// stands about.
#[test]
fn the_shell_about_the_goal_is_the_reason() {
    let mut walls = vec![Wall { name: "post", low: vec![-0.2; 3], high: vec![0.2; 3] }];
    for k in 0..3 {
        for side in [-1.0, 1.0] {
            let centre: f64 = 1.5;
            let mut wall =
                Wall { name: "shell", low: vec![centre - 0.5; 3], high: vec![centre + 0.5; 3] };
            (wall.low[k], wall.high[k]) = (centre + side * 0.5 - 0.05, centre + side * 0.5 + 0.05);
            walls.push(wall);
        }
    }
    let chain = planar(&[0.5, 0.5, 0.2], 3.0);
    let (from, to) = (Posture::new(&[-1.5; 3]), Posture::new(&[1.5; 3]));
    let free = among(&walls);
    for seed in 0..5 {
        let transit = solve(&chain, &from, &to, &free, seed);
        assert_eq!(transit.how, None);
        assert_eq!(transit.way, [from, to]);
        let reason = transit.reason.expect("there is one");
        assert_eq!((reason.end, reason.bodies[1].as_str()), (End::Goal, "shell"));
        assert!(reason.share.expect("it was searched") > 0.9);
        // the place is on the inner face of the shell, grown by what is needed
        let out = reason.q.iter().map(|q| (q - 1.5).abs()).fold(0.0, f64::max);
        assert!((out - 0.44).abs() < 1e-9, "{out}");
        // wide and narrow search, shortening, doors
        assert!(transit.n_checks < 2 * 4000 + 50, "{}", transit.n_checks);
    }
}

/// An end inside something is told without a search.
#[test]
fn an_end_that_is_not_clear_is_the_reason() {
    let chain = planar(&[0.5, 0.5, 0.2], 3.0);
    let (from, to) = (Posture::new(&[-1.5; 3]), Posture::new(&[1.5; 3]));
    let walls = [Wall { name: "block", low: vec![1.4; 3], high: vec![1.6; 3] }];
    for (from, to, end) in [(from, to, End::Goal), (to, from, End::Start)] {
        let transit = solve(&chain, &from, &to, &among(&walls), 0);
        let reason = transit.reason.expect("there is one");
        assert_eq!((reason.end, reason.share, reason.q), (end, None, Posture::new(&[1.5; 3])));
        assert_eq!(reason.bodies[1], "block");
        assert!(transit.n_checks < 20);
    }
}

/// What twice the limit does not let through the limit itself may.
#[test]
fn a_gap_for_the_limit_alone_is_found() {
    let chain = planar(&[0.5, 0.5], 3.0);
    let (from, to) = (Posture::new(&[-1.0, 0.0]), Posture::new(&[1.0, 0.0]));
    // the gap is 0.03 wide, about zero: the limit is 0.01
    let walls = [
        Wall { name: "left", low: vec![-0.1, -9.0], high: vec![0.1, -0.015] },
        Wall { name: "right", low: vec![-0.1, 0.015], high: vec![0.1, 9.0] },
    ];
    let free = among(&walls);
    let transit = solve(&chain, &from, &to, &free, 0);
    assert_eq!((transit.how, transit.keeps_m), (Some(How::Direct), 0.01));
    stays_clear(&transit.way, &free, 0.01);
}

/// Ways out at both ends: over a wall that the direct move and the search about the ends run into.
#[test]
fn ways_out_are_taken_before_a_search() {
    let chain = planar(&[0.5, 0.5, 0.2], 3.0);
    let (from, to) = (Posture::new(&[-1.0, 0.0, 0.0]), Posture::new(&[1.0, 0.0, 0.0]));
    let walls = [Wall { name: "wall", low: vec![-0.2, -9.0, -9.0], high: vec![0.2, 0.9, 9.0] }];
    let free = among(&walls);
    let out = |q: &Posture, how, top: f64| {
        let step = |k: usize| Posture::new(&[q[0], top * k as f64 / 8.0, 0.0]);
        Exit { how, way: (1..=8).map(step).collect() }
    };
    let exits = |q: &Posture| vec![out(q, How::Along, 0.5), out(q, How::Over, 1.2)];
    let metric = Metric::new(&chain, 0.0);
    let room = Room::new(&chain, 0.0, &[from, to]);
    let arena = Arena {
        metric: &metric,
        room,
        from,
        to,
        home: from,
        limit_m: 0.01,
        free: &free,
        exits: &exits,
    };
    let transit = arena.straight().expect("over");
    assert_eq!(transit.how, Some(How::Over));
    assert_eq!(transit.way.len(), 2 + 2 * 8);
    stays_clear(&transit.way, &free, 0.02);
    // through home, where home is past the wall
    let home = Posture::new(&[0.0, 1.5, 0.0]);
    let arena = Arena { home, exits: &no_exits, ..arena };
    let transit = arena.straight().expect("through home");
    assert_eq!((transit.how, transit.way), (Some(How::Home), vec![from, home, to]));
}

/// Discs about which a planar arm of three links finds its way; clearance is that of the links.
mod discs {
    use super::*;

    /// Middle and radius.
    type Disc = ([f64; 2], f64);
    const LINKS_M: [f64; 3] = [0.5, 0.4, 0.3];

    fn clearance(discs: &[Disc], q: &Posture) -> (f64, usize) {
        let (mut at, mut angle) = ([0.0, 0.0], 0.0);
        let mut least = (f64::INFINITY, 0);
        for (turn, length) in q.iter().zip(LINKS_M) {
            angle += turn;
            let to = [at[0] + length * f64::cos(angle), at[1] + length * f64::sin(angle)];
            for (index, (middle, radius)) in discs.iter().enumerate() {
                let (dx, dy) = (to[0] - at[0], to[1] - at[1]);
                let t = ((middle[0] - at[0]) * dx + (middle[1] - at[1]) * dy) / (length * length);
                let t = t.clamp(0.0, 1.0);
                let off = f64::hypot(middle[0] - at[0] - t * dx, middle[1] - at[1] - t * dy);
                if off - radius < least.0 {
                    least = (off - radius, index);
                }
            }
            at = to;
        }
        least
    }

    /// Covered: advances by the clearance to spare over the bound on the motion of any point.
    fn covered(discs: &[Disc]) -> impl Fn(&Posture, &Posture, f64) -> Result<(), Blocked> + '_ {
        move |from, to, need_m| {
            let mut reach_m: f64 = LINKS_M.iter().sum();
            let mut motion_m = 0.0;
            for (k, length) in LINKS_M.iter().enumerate() {
                motion_m += reach_m * (to[k] - from[k]).abs();
                reach_m -= length;
            }
            let mut share = 0.0;
            loop {
                let (clearance_m, disc) = clearance(discs, &from.toward(to, share));
                if clearance_m < need_m {
                    let pair = ["link".to_owned(), format!("disc {disc}")];
                    return Err(Blocked { share, clearance_m, pair });
                }
                share += ((clearance_m - need_m) / motion_m).max(1e-4);
                if !(share < 1.0) {
                    return Ok(());
                }
            }
        }
    }

    #[test]
    fn an_arm_finds_its_way_among_discs() {
        let chain = planar(&LINKS_M, 2.9);
        let discs: [Disc; 3] = [([0.75, 0.0], 0.15), ([0.0, 0.9], 0.15), ([-0.6, -0.4], 0.1)];
        let free = covered(&discs);
        let (from, to) = (Posture::new(&[-0.6, 0.2, 0.2]), Posture::new(&[0.6, 0.2, 0.2]));
        for seed in 0..10 {
            let transit = solve(&chain, &from, &to, &free, seed);
            assert_eq!(transit.how, Some(How::Search), "{:?}", transit.reason);
            stays_clear(&transit.way, &free, transit.keeps_m - 1e-4 * 1.2);
            // the arm folds, turns by 1.2 rad and unfolds
            let metric = Metric::new(&chain, 0.0);
            let turn_rad = metric.time(&transit.way);
            assert!(turn_rad < 6.5, "{turn_rad} rad");
        }
    }
}

/// No way gets longer, none turns more sharply, and most corners get rounder: those that are left
/// stand close to the edge of the hole.
#[test]
fn shortened_and_rounded_ways_are_shorter_and_smoother() {
    let chain = planar(&[0.4, 0.4, 0.3, 0.2, 0.1, 0.1], 3.0);
    let metric = Metric::new(&chain, 0.0);
    let walls = wall_with_hole();
    let free = among(&walls);
    let length = |way: &[Posture]| way.windows(2).map(|p| metric.length(&p[0], &p[1])).sum::<f64>();
    let (from, to) = (
        Posture::new(&[-1.5, -1.0, 0.0, 0.0, 1.0, 0.0]),
        Posture::new(&[1.5, -1.0, 0.5, 0.0, -1.0, 0.0]),
    );
    let (mut n_corners, mut n_rounded) = (0, 0);
    for seed in 0..10 {
        let mut ask = Ask::new(&free, 0.01);
        let (mut here, mut there) = (Tree::new(from, &[]), Tree::new(to, &[]));
        let way = Search {
            ask: &mut ask,
            metric: &metric,
            room: Room::new(&chain, 0.0, &[from, to]),
            random: Random::new(seed),
            checks_max: 20_000,
        }
        .connect(&mut here, &mut there)
        .expect("there is a hole");
        let short = shortcut::shorten(&mut ask, &metric, &mut Random::new(seed), way.clone(), 60);
        assert!(length(&short) <= length(&way) + 1e-12);
        let round = shortcut::round(&mut ask, &metric, &short);
        assert!(length(&round) <= length(&short) + 1e-12);
        stays_clear(&round, &free, 0.01);
        let sharpest = |way: &[Posture]| {
            way.windows(3).map(|p| turn(&metric, &p[0], &p[1], &p[2])).fold(0.0, f64::max)
        };
        assert!(sharpest(&round) <= sharpest(&short) + 1e-6, "seed {seed}");
        n_corners += short.len() - 2;
        n_rounded += (round.len() - short.len()).div_ceil(6);
    }
    assert!(2 * n_rounded > n_corners, "{n_rounded} of {n_corners}");
}

/// Angle by which a way turns at a corner, in the metric.
fn turn(metric: &Metric, before: &Posture, at: &Posture, after: &Posture) -> f64 {
    let (a, b, c) =
        (metric.length(before, at), metric.length(at, after), metric.length(before, after));
    std::f64::consts::PI - ((a * a + b * b - c * c) / (2.0 * a * b)).clamp(-1.0, 1.0).acos()
}

/// The metric bounds what a joint moves: link by link from the joint to the tip.
#[test]
fn the_metric_weighs_a_joint_by_what_hangs_on_it() {
    let chain = planar(&[0.5, 0.3, 0.1], 3.0);
    let metric = Metric::new(&chain, 0.2);
    let zero = Posture::zeros(3);
    for (joint, reach_m) in [(0, 1.1), (1, 0.6), (2, 0.3)] {
        let mut q = zero;
        q[joint] = 0.1;
        assert!((metric.length(&zero, &q) - 0.1 * reach_m).abs() < 1e-12);
    }
}

proptest! {
    /// In any room of boxes: what is found is clear over its whole length, begins and ends as asked,
    /// and stays within limits.
    #[test]
    fn ways_found_are_clear(
        boxes in prop::collection::vec((prop::array::uniform3(-2.0..2.0f64), prop::array::uniform3(0.05..0.8f64)), 0..12),
        from in prop::array::uniform3(-2.5..2.5f64),
        to in prop::array::uniform3(-2.5..2.5f64),
        seed in 0u64..1000,
    ) {
        let walls: Vec<Wall> = boxes
            .iter()
            .map(|(middle, half)| Wall {
                name: "box",
                low: middle.iter().zip(half).map(|(m, h)| m - h).collect(),
                high: middle.iter().zip(half).map(|(m, h)| m + h).collect(),
            })
            .collect();
        let free = among(&walls);
        let chain = planar(&[0.5, 0.5, 0.2], 2.6);
        let (from, to) = (Posture::new(&from), Posture::new(&to));
        let transit = solve(&chain, &from, &to, &free, seed);
        prop_assert_eq!(transit.how.is_none(), transit.reason.is_some());
        prop_assert_eq!(transit.way[0], from);
        prop_assert_eq!(transit.way[transit.way.len() - 1], to);
        if transit.how.is_some() {
            stays_clear(&transit.way, &free, transit.keeps_m);
            prop_assert!(transit.way.iter().all(|q| q.iter().all(|q| q.abs() <= 2.6)));
        }
    }
}

/// A job on the printer with a fence across its bed, between two strands; the orifice can be lifted to
/// 400 mm.
fn fenced(height_mm: f64) -> Job {
    let corner = |k: usize| {
        let side = |bit: usize, low, high| if k >> bit & 1 == 0 { low } else { high };
        [side(0, 58.0, 62.0), side(1, -230.0, 230.0), side(2, 0.0, height_mm)]
    };
    let sides =
        [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
    let halves = |[a, b, c, d]: [u32; 4]| [[a, b, c], [a, c, d]];
    let mesh = slam::mesh::Mesh {
        vertices: (0..8).map(corner).collect(),
        triangles: sides.into_iter().flat_map(halves).collect(),
    };
    let lying = |id, x_mm: f64| {
        strand(id, &[[x_mm - 10.0, 0.0, 0.6], [x_mm + 10.0, 0.0, 0.6]], ", \"on\": \"bed\"")
    };
    let strands = [lying("here", 0.0), lying("there", 100.0)].join(",");
    let form = r#""forms": [{ "id": "fence", "mesh": "fence.stl" }],"#;
    try_job(&text("printer-3axis", form, &strands), &[mesh]).expect("a sound job")
}

/// Strand, phase, bodies and message of a finding.
type Told = (Option<usize>, Option<Phase>, Vec<String>, String);

/// What preflight says of a job, as code, strand, phase and bodies.
fn lost(job: Job) -> Vec<Told> {
    let done = preflight(job, |_| ()).expect("a small frame");
    let c207 = done.findings().iter().filter(|finding| finding.code == Code::C207);
    c207.map(|finding| {
        let Site { strand, phase, bodies, .. } = finding.site.clone();
        (strand, phase, bodies, finding.message.clone())
    })
    .collect()
}

#[test]
fn a_fence_too_high_to_climb_is_told_with_its_pair() {
    let found = lost(fenced(402.0));
    // to the strand behind it, and home again
    assert_eq!(found.iter().map(|found| found.0).collect::<Vec<_>>(), [Some(1), None]);
    for (_, phase, bodies, message) in found {
        assert_eq!(phase, Some(Phase::Transit));
        assert_eq!(bodies[1], "fence", "{message}");
        assert!(message.contains("a search"), "{message}");
    }
    assert!(lost(fenced(390.0)).is_empty());
}

/// One thread or two: the same ways.
#[test]
fn ways_do_not_depend_on_threads() {
    let job = fenced(390.0);
    let paths = crate::toolpath::paths(&job);
    let with = |n_threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(n_threads).build().expect("a pool");
        pool.install(|| crate::motion::plan(&job, &paths))
    };
    assert_eq!(with(1), with(2));
}

/// A place of the nozzle, straight down, in the cell of a slim cone.
fn standing(job: &Job) -> Place {
    let point = job.strands[0].points[0];
    let mut solutions = Vec::new();
    let nozzle = -Vector::z();
    crate::motion::solve(job, point, nozzle, 0.0, 0.0, Some(&job.cell.home), &mut solutions);
    Place { point, nozzle, q: solutions[0].q }
}

/// A ball over the start: the nozzle leaves beside it, and says how.
#[test]
fn what_is_over_the_nozzle_is_left_aside() {
    let job = job(&text("kr10-cone", "", &strand("a", &[[0.0, 0.0, 9.0], [20.0, 0.0, 9.0]], "")));
    let place = standing(&job);
    let ball = |radius_m: f64, over_m: f64| {
        let (job, middle) = (&job, place.point + Vector::z() * over_m);
        move |from: &Posture, to: &Posture, need_m: f64| {
            for share in [0.0, 0.25, 0.5, 0.75, 1.0] {
                let (tip, _) = between::nozzle_at(job, &from.toward(to, share));
                let clearance_m = (tip - middle).norm() - radius_m;
                if clearance_m < need_m {
                    let pair = ["nozzle".to_owned(), "ball".to_owned()];
                    return Err(Blocked { share, clearance_m, pair });
                }
            }
            Ok(())
        }
    };
    let free = ball(3e-3, 200e-3);
    let asked = leave(&job, &place, 20e-3, || None, &free);
    assert_eq!((asked.tilt_rad, asked.keeps_m), (0.0, 2.0 * job.limits.clearance_m));
    assert_eq!((asked.way.len(), asked.length_m, asked.reason), (5, 20e-3, None));

    let free = ball(3e-3, 10e-3);
    let aside = leave(&job, &place, 20e-3, || None, &free);
    assert!(aside.tilt_rad.to_degrees() > 14.0 && aside.tilt_rad.to_degrees() < 61.0);
    assert_eq!((aside.way.len(), aside.length_m, aside.reason), (5, 20e-3, None));
    stays_clear(&aside.way, &free, aside.keeps_m);
    let (tip, axis) = between::nozzle_at(&job, &aside.way[4]);
    assert!((tip - (place.point + aside.direction * 20e-3)).norm() < 1e-9);
    assert!((axis - place.nozzle).norm() < 1e-9);

    // away from what meets there comes first
    let away = Vector::new(1.0, 0.0, 1.0).normalize();
    let away = leave(&job, &place, 20e-3, || Some(away), &free);
    assert!((away.tilt_rad.to_degrees() - 45.0).abs() < 1e-6, "{}", away.tilt_rad.to_degrees());

    // inside the ball there is no way out; the asked one is taken, and the reason told
    let free = ball(50e-3, 10e-3);
    let shut = leave(&job, &place, 20e-3, || None, &free);
    assert_eq!((shut.way.len(), shut.keeps_m, shut.tilt_rad), (5, 0.0, 0.0));
    let reason = shut.reason.expect("there is one");
    assert_eq!((reason.end, reason.bodies[1].as_str()), (End::Strand, "ball"));
}

#[test]
fn away_is_against_the_strands_that_meet() {
    let strands = [
        strand("a", &[[0.0, 0.0, 10.0], [30.0, 0.0, 10.0]], ""),
        strand("b", &[[0.0, 0.0, 10.0], [0.0, 30.0, 10.0]], ""),
        strand("far", &[[90.0, 0.0, 10.0], [90.0, 30.0, 10.0]], ""),
    ];
    let job = job(&text("kr10-cone", "", &strands.join(",")));
    let point = job.strands[0].points[0];
    let away = away_from(&job, &[0, 1, 2], point).expect("a direction");
    assert!((away - Vector::new(-1.0, -1.0, 0.0).normalize()).norm() < 1e-12);
    assert_eq!(away_from(&job, &[2], point), None);
}
