use proptest::prelude::*;

use super::*;
use crate::clearance::Bodies;
use crate::deposit::Printed;
use crate::parry::{ROUNDING_M, SLACK};
use crate::pose::{self, Pose, Vector};
use crate::test_job::{job, strand, text};
use crate::{motion, toolpath};

/// The nozzle of `kr10-cone`: 13 mm at 120 mm over the orifice, 2.4 mm at it.
const CONE_MM: [f64; 3] = [120.0, 13.0, 2.4];

/// Clearance of a bead across a face of the cone, `r` off its axis and `h` over the orifice, m.
fn by_hand_m(r_mm: f64, h_mm: f64, bead_mm: f64) -> f64 {
    let [length, wide, narrow] = CONE_MM;
    let at_h = narrow + (wide - narrow) / length * h_mm;
    ((r_mm - at_h) * length / length.hypot(wide - narrow) - bead_mm) / 1e3
}

/// The nozzle as a body.
fn with_nozzle(test: impl Fn(&crate::clearance::Body)) {
    static BODIES: std::sync::LazyLock<Bodies> = std::sync::LazyLock::new(|| {
        Bodies::new(&job(&text("kr10-cone", "", &strand("a", &[[0.0; 3], [9.0, 0.0, 0.0]], ""))))
    });
    test(&BODIES.tool.iter().find(|part| part.nozzle).expect("a nozzle").body);
}

/// The polygon touches the cone in the middle of its faces, at 11.25° and every 22.5° from there.
const FACE_DEG: f64 = 11.25;

#[test]
fn clearance_of_a_cone_to_a_bead_is_that_by_hand() {
    let places = [
        pose::from_xyz_rpy([0.0; 3], [0.0; 3]),
        pose::from_xyz_rpy([0.7, -0.4, 0.9], [0.5, -1.0, 2.0]),
    ];
    with_nozzle(|nozzle| {
        for (r_mm, h_mm, bead_mm) in [(8.0, 20.0, 1.5), (5.0, 9.0, 1.0), (14.0, 60.0, 0.65)] {
            for (face, place) in [(0.0, places[0]), (5.0, places[0]), (3.0, places[1])] {
                let angle = (FACE_DEG + 22.5 * face).to_radians();
                let out = Vector::new(angle.cos(), angle.sin(), 0.0);
                let along = Vector::z().cross(&out) * 1e-3;
                let middle = Point::from(out * (r_mm / 1e3)) - Vector::z() * (h_mm / 1e3);
                let piece = [place * (middle - along), place * (middle + along)];
                let found_m = nozzle.to_bead(&place, &piece, bead_mm / 1e3, 0.05);
                let wanted_m = by_hand_m(r_mm, h_mm, bead_mm);
                // the stated roundings are taken off, so it is never more than by hand
                let lost_m = 2.0 * ROUNDING_M + SLACK * (wanted_m + bead_mm / 1e3);
                let holds = found_m <= wanted_m && found_m >= wanted_m - lost_m;
                assert!(holds, "{found_m} for {wanted_m}");
            }
        }
    });
}

#[test]
fn a_bead_through_the_cone_overlaps_and_one_far_off_is_not_measured() {
    with_nozzle(|nozzle| {
        let through = [Point::new(-0.05, 0.0, -0.05), Point::new(0.05, 0.0, -0.05)];
        assert!(nozzle.to_bead(&Pose::identity(), &through, 1e-3, 2e-3) <= -1e-3);
        let far = [Point::new(-0.05, 0.1, -0.05), Point::new(0.05, 0.1, -0.05)];
        assert_eq!(nozzle.to_bead(&Pose::identity(), &far, 1e-3, 2e-3), f64::INFINITY);
    });
}

/// The deposit of a job as planned, with beads of 1 mm radius.
fn deposit(job: &Job, motion: &Motion) -> Deposit {
    let printed = |printing: &motion::Printing| {
        let points = job.strands[printing.strand].points.clone();
        Printed {
            strand: printing.strand,
            at_m: toolpath::stations(&points),
            as_printed: points.clone(),
            as_planned: points,
            radius_m: 1e-3,
            born_s: printing.start_s,
            done_s: printing.end_s,
        }
    };
    Deposit::new(motion.printings.iter().map(printed).collect())
}

/// Findings of a job in `kr10-cone` with these strands; contacts as found, or none at all.
fn looked_at(strands: &str, with_contacts: bool) -> Vec<crate::finding::Finding> {
    let held = format!(r#""process": {{ "orientation": {{ "spin": {FACE_DEG} }} }},"#);
    let job = job(&text("kr10-cone", &held, strands));
    let motion = motion::plan(&job, &toolpath::paths(&job));
    let deposit = deposit(&job, &motion);
    let contacts = if with_contacts { crate::deposit::contacts(&deposit) } else { Vec::new() };
    let mut findings = Findings::default();
    check(&job, &motion, &deposit, &contacts, &mut findings);
    findings.sorted()
}

/// The second strand passes beside the first, which hangs 9 mm higher.
#[test]
fn the_nozzle_beside_an_earlier_strand_is_found_with_its_clearance() {
    for (wanted_mm, is_found) in [(0.5, true), (0.95, true), (1.05, false), (-0.3, true)] {
        let [length, wide, narrow] = CONE_MM;
        let cos = length / length.hypot(wide - narrow);
        let y = narrow + (wide - narrow) / length * 9.0 + (wanted_mm + 1.0) / cos;
        let a = strand("a", &[[-60.0, y, 10.0], [60.0, y, 10.0]], "");
        let b = strand("b", &[[-20.0, 0.0, 1.0], [20.0, 0.0, 1.0]], "");
        let found = looked_at(&[a.as_str(), b.as_str()].join(","), false);
        let print = |finding: &&crate::finding::Finding| {
            finding.site.phase == Some(Phase::Print) && finding.code == Code::C201
        };
        let told = found.iter().find(print);
        // 0.05 mm clear is within the arm's accuracy: a warning, not an error
        let error = told.is_some_and(|told| told.severity == crate::finding::Severity::Error);
        assert_eq!(error, is_found, "{wanted_mm} mm");
        let Some(told) = told else { continue };
        assert_eq!((told.site.strand, told.limit), (Some(1), 1e-3));
        assert_eq!(told.site.bodies, ["nozzle", "a"]);
        let off_m = told.measured.nominal - wanted_mm / 1e3;
        assert!(off_m <= 1e-9 && off_m > -2.5 * ROUNDING_M, "{wanted_mm} mm: off by {off_m:e} m");
    }
}

/// Where strands touch the nozzle may come near; without the contact it may not.
#[test]
fn at_a_crossing_the_nozzle_may_come_near() {
    let a = strand("a", &[[-40.0, 0.0, 1.0], [40.0, 0.0, 1.0]], ", \"on\": \"bed\"");
    let b = strand("b", &[[0.0, -30.0, 2.5], [0.0, 30.0, 2.5]], "");
    let strands = [a.as_str(), b.as_str()].join(",");
    let of_nozzle = |found: Vec<crate::finding::Finding>| {
        found.iter().filter(|f| f.code == Code::C201 && f.site.phase == Some(Phase::Print)).count()
    };
    assert_eq!(of_nozzle(looked_at(&strands, false)), 1);
    assert_eq!(of_nozzle(looked_at(&strands, true)), 0);
}

/// A strand alone on the bed in the middle of the cell is no clearance finding at all.
#[test]
fn a_strand_alone_is_clear() {
    let a = strand("a", &[[-20.0, 0.0, 1.0], [20.0, 0.0, 1.0]], ", \"on\": \"bed\"");
    let found = looked_at(&a, true);
    assert!(found.is_empty(), "{found:?}");
}

/// The second strand crosses the first at another height: half the radius decides.
#[test]
fn a_bead_laid_through_an_earlier_one_is_found_by_its_depth() {
    for (over_mm, is_found) in
        [(0.0, true), (0.45, true), (0.55, false), (2.0, false), (6.0, false)]
    {
        let a = strand("a", &[[-40.0, 0.0, 1.0], [40.0, 0.0, 1.0]], ", \"on\": \"bed\"");
        let b = strand("b", &[[0.0, -30.0, 1.0 + over_mm], [0.0, 30.0, 1.0 + over_mm]], "");
        let found = looked_at(&[a.as_str(), b.as_str()].join(","), true);
        let told = found.iter().find(|finding| finding.code == Code::C208);
        assert_eq!(told.is_some(), is_found, "{over_mm} mm: {found:?}");
        let Some(told) = told else { continue };
        assert!((told.measured.nominal - (1.0 - over_mm)).abs() < 1e-9);
        assert!((told.site.at_m.expect("a place") - 0.03).abs() < 1e-9);
        assert_eq!((told.site.strand, told.site.bodies[1].as_str()), (Some(1), "a"));
    }
}

/// Where a strand ends on another they are joined; a ring may end where it began, a figure of
/// eight may not cross itself.
#[test]
fn ends_may_be_joined_and_a_strand_may_not_cross_itself() {
    let a = strand("a", &[[-40.0, 0.0, 1.0], [40.0, 0.0, 1.0]], ", \"on\": \"bed\"");
    let on_it = strand("b", &[[0.0, 0.0, 1.0], [0.0, 30.0, 1.0]], ", \"on\": \"bed\"");
    let ring =
        [[0.0, 0.0, 1.0], [40.0, 0.0, 1.0], [40.0, 40.0, 1.0], [0.0, 40.0, 1.0], [0.0, 0.0, 1.0]];
    let ring = strand("ring", &ring, ", \"on\": \"bed\"");
    let eight = [[0.0, 0.0, 1.0], [40.0, 40.0, 1.0], [40.0, 0.0, 1.0], [0.0, 40.0, 1.0]];
    let eight = strand("eight", &eight, ", \"on\": \"bed\"");
    // one line there and back, and one that comes back beside itself
    let back = [[-40.0, 0.0, 1.0], [40.0, 0.0, 1.0], [-40.0, 0.0, 1.0]];
    let back = strand("back", &back, ", \"on\": \"bed\"");
    let beside = [[-40.0, 0.0, 1.0], [40.0, 0.0, 1.0], [40.0, 3.0, 1.0], [-40.0, 3.0, 1.0]];
    let beside = strand("beside", &beside, ", \"on\": \"bed\"");
    let joined = [a.as_str(), on_it.as_str()].join(",");
    for (strands, n) in [(joined, 0), (ring, 0), (eight, 1), (back, 1), (beside, 0)] {
        let found = looked_at(&strands, true);
        let told = found.iter().filter(|finding| finding.code == Code::C208);
        assert_eq!(told.count(), n, "{strands}: {found:?}");
    }
}

/// An upright strand that the nozzle passes between two moments of its motion: at the moments there is
/// nothing within the horizon.
#[test]
fn what_lies_between_two_moments_is_found() {
    let held = format!(r#""process": {{ "orientation": {{ "spin": {FACE_DEG} }} }},"#);
    let [length, wide, narrow] = CONE_MM;
    let cos = length / length.hypot(wide - narrow);
    // The top of the post is half a millimetre off the cone, 20 mm over its orifice.
    let y = narrow + (wide - narrow) / length * 20.0 + (0.5 + 1.0) / cos;
    let (a, b) = ([[0.0, y, 1.0], [0.0, y, 21.0]], [[-60.0, 0.0, 1.0], [60.0, 0.0, 1.0]]);
    let strands = [strand("post", &a, ""), strand("pass", &b, "")].join(",");
    let job = job(&text("kr10-cone", &held, &strands));
    let mut motion = motion::plan(&job, &toolpath::paths(&job));
    let deposit = deposit(&job, &motion);
    let pass = |leg: &&mut motion::Leg| leg.phase == Phase::Print && leg.strand == Some(1);
    let leg = motion.legs.iter_mut().find(pass).expect("the pass");
    leg.moments.retain(|moment| (moment.at_m - 0.06).abs() > 10e-3);
    let mut findings = Findings::default();
    let nearest = check(&job, &motion, &deposit, &[], &mut findings).0.expect("a clearance");
    let found = findings.sorted();
    let of_post = |f: &&crate::finding::Finding| {
        f.site.bodies == ["nozzle", "post"] && f.site.phase == Some(Phase::Print)
    };
    let told = found.iter().find(of_post).expect("half a millimetre");
    // Joints that turn evenly over 24 mm leave the line by a tenth or two.
    assert!((told.measured.nominal - 0.5e-3).abs() < 0.25e-3, "{told:?}");
    let at_m = told.site.at_m.expect("a place");
    assert!((at_m - 0.06).abs() < 2e-3, "{at_m}");
    let gap_m = told.measured.nominal - told.measured.low - nearest.accuracy_m;
    assert!(gap_m > 0.0 && gap_m < 0.5e-3, "resolution and bow {gap_m}");
}

/// A form is there until it is released, and not after.
#[test]
fn a_released_form_is_no_longer_there() {
    let corner = |k: usize, bit: usize| if k & bit == 0 { -1.0 } else { 1.0 };
    let vertices = (0..8)
        .map(|k| [corner(k, 1) * 20.0, corner(k, 2) * 20.0, 15.0 + corner(k, 4) * 10.0])
        .collect();
    let triangles = vec![
        [0, 2, 1],
        [1, 2, 3],
        [4, 5, 6],
        [5, 7, 6],
        [0, 1, 4],
        [1, 5, 4],
        [2, 6, 3],
        [3, 6, 7],
        [0, 4, 2],
        [2, 4, 6],
        [1, 3, 5],
        [3, 7, 5],
    ];
    let block = slam::mesh::Mesh { vertices, triangles };
    let a = strand("a", &[[-15.0, 0.0, 26.0], [15.0, 0.0, 26.0]], ", \"on\": \"block\"");
    let b = strand("b", &[[-15.0, 60.0, 1.0], [-15.0, -60.0, 1.0]], ", \"on\": \"bed\"");
    for (sequence, in_the_way) in
        [(r#""a", "b""#, true), (r#""a", { "release": "block" }, "b""#, false)]
    {
        let more = format!(
            r#""forms": [{{ "id": "block", "mesh": "block.stl" }}], "sequence": [{sequence}],"#
        );
        let text = text("kr10-cone", &more, &[a.as_str(), b.as_str()].join(","));
        let job =
            crate::test_job::try_job(&text, std::slice::from_ref(&block)).expect("a sound job");
        let motion = motion::plan(&job, &toolpath::paths(&job));
        let mut findings = Findings::default();
        check(&job, &motion, &deposit(&job, &motion), &[], &mut findings);
        let found = findings.sorted();
        let hits = |phase: Phase| {
            found.iter().any(|f| {
                f.site.bodies == ["nozzle", "block"]
                    && f.site.phase == Some(phase)
                    && f.site.strand == Some(1)
            })
        };
        assert_eq!(hits(Phase::Print), in_the_way, "{found:?}");
    }
}

/// One thread and two: the same findings to the last bit.
#[test]
fn the_number_of_threads_does_not_matter() {
    let strands: Vec<String> = (0..6)
        .map(|k| {
            let y = 12.0 * f64::from(k);
            strand(
                &format!("s{k}"),
                &[[-30.0, y, 1.0], [30.0, y - 20.0, 1.0 + 4.0 * f64::from(k)]],
                "",
            )
        })
        .collect();
    let with = |n_threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(n_threads).build();
        pool.expect("threads").install(|| format!("{:?}", looked_at(&strands.join(","), true)))
    };
    let one = with(1);
    assert!(one.len() > 2, "something is found");
    assert_eq!(one, with(2));
}

/// How long the bunny takes; printed, with `TWIN_SLOW=1`.
#[test]
fn the_bunny_is_judged_in_seconds() {
    if std::env::var("TWIN_SLOW").is_err() {
        println!("skipped without TWIN_SLOW=1");
        return;
    }
    let path = format!("{}/../../scenarios/bunny-wireframe/job.slam", env!("CARGO_MANIFEST_DIR"));
    let job = job(&std::fs::read_to_string(path).expect("the scenario"));
    let motion = motion::plan(&job, &toolpath::paths(&job));
    let deposit = deposit(&job, &motion);
    let contacts = crate::deposit::contacts(&deposit);
    let mut findings = Findings::default();
    let start = std::time::Instant::now();
    let nearest = check(&job, &motion, &deposit, &contacts, &mut findings);
    let found = findings.sorted();
    println!(
        "bunny: {:.2} s, {} findings, {nearest:?}",
        start.elapsed().as_secs_f64(),
        found.len()
    );
    for code in [Code::C201, Code::C202, Code::C203, Code::C204, Code::C205, Code::C206, Code::C208]
    {
        let of = found.iter().filter(|finding| finding.code == code).count();
        let low = found.iter().filter(|f| f.code == code).map(|f| f.measured.nominal);
        println!(
            "{code:?}: {of}, {:.3e} to {:.3e}",
            low.clone().fold(f64::INFINITY, f64::min),
            low.fold(f64::NEG_INFINITY, f64::max)
        );
        let widest = found
            .iter()
            .filter(|f| f.code == code)
            .map(|f| f.measured.nominal - f.measured.low)
            .fold(0.0, f64::max);
        println!("   widest below nominal {widest:.3e}");
    }
}

/// A nozzle that dips into the bed is found by how deep it is.
#[test]
fn the_nozzle_in_the_bed_is_found() {
    let a = strand("a", &[[-20.0, 0.0, -3.0], [20.0, 0.0, -3.0]], ", \"on\": \"bed\"");
    let found = looked_at(&a, true);
    let told = found.iter().find(|f| f.code == Code::C205 && f.site.phase == Some(Phase::Print));
    let told = told.expect("3 mm deep");
    assert_eq!(told.site.bodies, ["nozzle", "bed"]);
    // full clearance 1 mm; half a bead of 1 mm may press in, 3 mm do
    assert!((told.measured.nominal - (1e-3 - 3e-3 + 1e-3)).abs() < 5e-6, "{:?}", told.measured);
}

#[test]
fn pieces_outside_one_zone_have_the_lengths_by_hand() {
    let whole = [Point::new(-5.0, 3.0, 0.0), Point::new(10.0, 3.0, 0.0)];
    let mut pieces = Vec::new();
    let lengths = |pieces: &[crate::clearance::Piece]| -> Vec<f64> {
        pieces.iter().map(|piece| (piece[1] - piece[0]).norm()).collect()
    };
    crate::clearance::outside(whole, &[Point::origin()], 5.0, &mut pieces);
    assert_eq!(lengths(&pieces), [1.0, 6.0]);
    crate::clearance::outside(whole, &[Point::origin()], 2.9, &mut pieces);
    assert_eq!(pieces, [whole]);
    crate::clearance::outside(
        whole,
        &[Point::origin(), Point::new(7.0, 3.0, 0.0)],
        5.0,
        &mut pieces,
    );
    assert_eq!(lengths(&pieces), [1.0]);
    crate::clearance::outside(whole, &[Point::new(2.5, 3.0, 0.0)], 8.0, &mut pieces);
    assert!(pieces.is_empty());
}

/// Distance of a place from the round cone itself, m; `None` inside.
fn from_cone_m(place: &Point) -> Option<f64> {
    let [length, wide, narrow] = CONE_MM.map(|mm| mm / 1e3);
    let at = [place.x.hypot(place.y), -place.z];
    if at[1] >= 0.0 && at[1] <= length && at[0] <= narrow + (wide - narrow) / length * at[1] {
        return None;
    }
    let outline = [[0.0, length], [wide, length], [narrow, 0.0], [0.0, 0.0]];
    let to_edge = |edge: &[[f64; 2]]| {
        let along = [edge[1][0] - edge[0][0], edge[1][1] - edge[0][1]];
        let from = [at[0] - edge[0][0], at[1] - edge[0][1]];
        let dot = from[0] * along[0] + from[1] * along[1];
        let share = (dot / (along[0].powi(2) + along[1].powi(2))).clamp(0.0, 1.0);
        (from[0] - share * along[0]).hypot(from[1] - share * along[1])
    };
    outline.windows(2).map(to_edge).reduce(f64::min)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(2000))]

    /// Beads of any length and direction: never further than from the round cone, and nearer by no
    /// more than the polygon stands out (two per cent of the radius).
    #[test]
    fn clearance_to_a_bead_agrees_with_a_search_along_it(
        turn in 0.0..std::f64::consts::TAU,
        (out_m, up_m) in (0.0..0.03f64, -0.13..0.02f64),
        along in [-1.0..1.0f64, -1.0..1.0, -1.0..1.0],
        size in -4.3..-1.3f64,
    ) {
        let middle = Point::new(out_m * turn.cos(), out_m * turn.sin(), up_m);
        let half = Vector::from(along) * 10f64.powf(size);
        let piece = [middle - half, middle + half];
        let n_steps = (half.norm() * 2.0 / 5e-6).ceil().max(1.0);
        let places = (0..=n_steps as usize).map(|k| piece[0] + half * (2.0 * k as f64 / n_steps));
        let searched = places.map(|place| from_cone_m(&place)).reduce(|a, b| Some(a?.min(b?)));
        let Some(Some(searched_m)) = searched else { return Ok(()) };
        with_nozzle(|nozzle| {
            let found_m = nozzle.to_bead(&Pose::identity(), &piece, 0.0, 1.0);
            assert!(found_m <= searched_m + 1e-7, "{found_m} m for {searched_m} m");
            let lost_m = 0.26e-3 + 3.0 * ROUNDING_M + SLACK * searched_m;
            assert!(found_m >= searched_m - lost_m, "{found_m} m for {searched_m} m");
        });
    }

    /// A place of the strand is in a piece exactly if it is outside all zones.
    #[test]
    fn pieces_outside_zones_agree_with_sampling(
        [a, b] in prop::array::uniform2([-3.0..3.0f64, -3.0..3.0, -3.0..3.0]),
        centres in prop::collection::vec([-3.0..3.0f64, -3.0..3.0, -3.0..3.0], 0..6),
        radius in 0.1..2.5f64,
    ) {
        let whole = [Point::from(a), Point::from(b)];
        let centres: Vec<Point> = centres.into_iter().map(Point::from).collect();
        let mut pieces = Vec::new();
        crate::clearance::outside(whole, &centres, radius, &mut pieces);
        prop_assert!(pieces.len() <= centres.len() + 1);
        for k in 0..=200 {
            let place = whole[0] + (whole[1] - whole[0]) * (f64::from(k) / 200.0);
            let gap = centres.iter().map(|centre| (place - centre).norm() - radius).fold(f64::INFINITY, f64::min);
            if gap.abs() < 1e-9 {
                continue;
            }
            let holding = pieces.iter().filter(|[from, to]| {
                let along = to - from;
                let share = (place - from).dot(&along) / along.norm_squared();
                (-1e-9..=1.0 + 1e-9).contains(&share)
            });
            prop_assert_eq!(holding.count().min(1) == 1, gap > 0.0, "at {}", k);
        }
    }
}
