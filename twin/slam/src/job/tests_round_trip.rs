use proptest::collection::vec;
use proptest::option;
use proptest::prelude::*;

use super::tests::EXAMPLE;
use crate::document::*;
use crate::job;
use crate::{Source, Span, Spanned};

fn placed<T>(value: T) -> Spanned<T> {
    Spanned::new(value, Span::default())
}

fn length() -> impl Strategy<Value = Spanned<f64>> {
    prop_oneof![-1e5..1e5_f64, Just(-0.0), Just(1e-300), Just(0.1 + 0.2), -1.0..1.0_f64]
        .prop_map(placed)
}

fn positive() -> impl Strategy<Value = Option<Spanned<f64>>> {
    option::of(prop_oneof![1e-3..100.0_f64, 1.0..50.0_f64].prop_map(placed))
}

fn triple() -> impl Strategy<Value = Triple> {
    [length(), length(), length()].prop_map(|parts| placed(parts.map(|part| part.value)))
}

fn text() -> impl Strategy<Value = Spanned<String>> {
    ".{1,12}".prop_map(placed)
}

fn flow() -> impl Strategy<Value = Option<Spanned<Flow>>> {
    option::of(
        prop_oneof![
            (0.01..100.0_f64).prop_map(Flow::DiameterMm),
            (1e-3..1e6_f64).prop_map(Flow::RateMm3S),
            (1..1000_u32).prop_map(Flow::Level),
        ]
        .prop_map(placed),
    )
}

fn orientation() -> impl Strategy<Value = Orientation> {
    let follow =
        prop_oneof![Just(Follow::Tangent), Just(Follow::Vertical), Just(Follow::SurfaceNormal)];
    let tilt = prop_oneof![Just(Tilt::Cone), Just(Tilt::PerAxis)];
    let spin = prop_oneof![Just(Spin::Free), (-360.0..360.0_f64).prop_map(Spin::HeldDeg)];
    let parts = (
        option::of(follow),
        option::of(tilt),
        [positive(), positive(), positive()],
        option::of(spin),
    );
    parts.prop_map(|(follow, tilt, [from, max, free], spin)| Orientation {
        follow: follow.map(placed),
        tilt: tilt.map(placed),
        tilt_from_deg: from.filter(|from| from.value <= 90.0),
        tilt_max_deg: max,
        tilt_free_deg: free.filter(|free| free.value <= 90.0),
        spin: spin.map(placed),
    })
}

fn process() -> impl Strategy<Value = Process> {
    let interpolation =
        option::of(prop_oneof![Just(Interpolation::Linear), Just(Interpolation::Joint)]);
    let threads = option::of((3..12_u32, [0.01..9.0_f64, 0.01..9.0, 0.0..9.0]));
    (vec(positive(), 9), flow(), orientation(), interpolation, threads).prop_map(
        |(n, flow, orientation, interpolation, threads)| Process {
            speed_mm_s: n[0],
            flow,
            prime_s: n[1],
            lights_after_mm: n[2],
            overrun_mm: n[3],
            dwell_s: n[4],
            approach_mm: n[5],
            retract_mm: n[6],
            second_pass_mm_s: n[7],
            post_cure_j_cm2: n[8],
            threads: threads.map(|(count, [diameter_mm, pitch_mm, sweep_mm])| Threads {
                count,
                diameter_mm,
                pitch_mm,
                sweep_mm,
            }),
            orientation,
            interpolation: interpolation.map(placed),
        },
    )
}

fn event() -> impl Strategy<Value = Event> {
    let at = prop_oneof![(0.0..1e3_f64).prop_map(At::Mm), (0.0..1e3_f64).prop_map(At::S)];
    (any::<bool>(), at, text(), any::<bool>()).prop_map(|(from_end, at, set, on)| Event {
        from_end,
        at: placed(at),
        set,
        on: placed(on),
    })
}

fn strand() -> impl Strategy<Value = Strand> {
    let geometry = (2..6_usize).prop_flat_map(|count| {
        (
            vec(triple(), count),
            option::of(vec(triple(), count)),
            option::of(vec(vec(-360.0..360.0_f64, 6), count)),
            option::of(vec(0.001..9.0_f64, count)),
        )
    });
    let end = || (any::<Option<bool>>(), positive());
    (geometry, end(), end(), vec(event(), 0..3), process()).prop_map(
        |(geometry, start, end, events, process)| {
            let (mut points_mm, directions, joints, steps) = geometry;
            for (index, point) in points_mm.iter_mut().enumerate() {
                point.value[2] = index as f64; // no two alike
            }
            let mut clock = 0.0;
            let times = steps.map(|steps| {
                let tick = |step| {
                    clock += step;
                    clock
                };
                steps.into_iter().map(tick).collect()
            });
            let end_of = |(bed, dwell_s): (Option<bool>, _)| End {
                join: bed.map(|bed| placed(if bed { Join::Bed } else { Join::Free })),
                dwell_s,
            };
            let upright = |mut direction: Triple| {
                direction.value[2] = -1.0;
                direction
            };
            Strand {
                id: placed(String::new()), // numbered by `document`
                span: Span::default(),
                points_mm,
                directions: directions.map(|list| list.into_iter().map(upright).collect()),
                joints: joints.map(placed),
                times_s: times.map(placed),
                on: None,
                start: end_of(start),
                end: end_of(end),
                profile: Vec::new(),
                events,
                process,
            }
        },
    )
}

fn load() -> impl Strategy<Value = LoadCase> {
    let fix = (any::<[bool; 3]>(), any::<bool>())
        .prop_filter("holds something", |(xyz, r)| *r || xyz.contains(&true));
    let support = (triple(), fix).prop_map(|(at_mm, (xyz, rotations))| SupportPoint {
        at_mm,
        fix: placed(Fix { xyz, rotations }),
    });
    let force = (triple(), triple()).prop_map(|(at_mm, force_n)| PointForce { at_mm, force_n });
    (text(), vec(support, 1..3), vec(force, 0..3)).prop_map(|(name, supports, forces)| LoadCase {
        name,
        supports,
        forces,
    })
}

fn allowance() -> impl Strategy<Value = Allowance> {
    let reason = text().prop_filter("says something", |reason| !reason.value.trim().is_empty());
    let day = (2000..2100_u32, 1..=12_u32, 1..=28_u32)
        .prop_map(|(year, month, day)| placed(format!("{year}-{month:02}-{day:02}")));
    (text(), any::<bool>(), reason, day).prop_map(|(code, on_strand, reason, until)| Allowance {
        code,
        strand: on_strand.then(|| placed("s\"\\0".to_owned())),
        reason,
        until,
    })
}

fn document() -> impl Strategy<Value = Document> {
    let head = (text(), text(), option::of(triple()), vec(positive(), 8));
    let lists = (vec(load(), 0..3), vec(allowance(), 0..3));
    let parts = (vec(strand(), 1..5), process(), lists, any::<bool>());
    (head, parts).prop_map(|((name, cell, xyz_mm, n), (mut strands, process, lists, ordered))| {
        let (loads, allow) = lists;
        for (index, strand) in strands.iter_mut().enumerate() {
            strand.id = placed(format!("s\"\\{index}"));
        }
        strands[0].on = Some(placed(On::Form("form".to_owned())));
        let mut steps: Vec<_> =
            strands.iter().rev().map(|strand| Step::Strand(strand.id.value.clone())).collect();
        steps.insert(0, Step::Move(vec![vec![0.5, -1.25], vec![0.0, 3.0]]));
        steps.extend([
            Step::Wait(0.125),
            Step::Release("form".to_owned()),
            Step::Checkpoint("é".to_owned()),
        ]);
        let form = Form {
            id: placed("form".to_owned()),
            mesh: cell.clone(),
            placement: Placement { xyz_mm, rpy_deg: None },
            adhesion_mpa: n[0],
        };
        Document {
            name,
            material: cell.clone(),
            cell,
            placement: Placement { xyz_mm, rpy_deg: Some(placed([0.0, -90.0, 12.5])) },
            environment: Environment { air_c: n[1], air_m_s: n[0] },
            forms: vec![form],
            process,
            strands,
            sequence: ordered.then(|| steps.into_iter().map(placed).collect()),
            loads,
            limits: Limits {
                clearance_mm: n[2],
                node_miss_mm: n[3],
                sag_mm: n[4],
                deflection_mm: n[5],
                strength_percent: n[6],
                buckling_factor: n[2],
                load_factor: n[3],
                speed_band_percent: n[6],
                cycle_time_s: n[7],
            },
            allow,
        }
    })
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 128, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn printed_documents_read_back_the_same(document in document()) {
        let source = Source::new("printed", job::print(&document));
        match job::parse(&source) {
            Ok((again, _)) => {
                prop_assert_eq!(&again, &document);
                prop_assert_eq!(job::print(&again), source.text);
            }
            Err(problems) => {
                prop_assert!(false, "{}\n{}", source.plain(&problems[0]), source.text);
            }
        }
    }

    #[test]
    fn no_text_panics(text in ".{0,200}") {
        read(&text);
    }

    #[test]
    fn no_mutation_of_a_job_panics(cuts in vec((any::<prop::sample::Index>(), 0..40_usize, "[\\[\\]{}\",:0-9eE/*\\\\a-z-]{0,4}"), 1..6)) {
        let mut text: Vec<char> = EXAMPLE.chars().collect();
        for (at, length, insert) in cuts {
            let start = at.index(text.len().max(1)).min(text.len());
            let end = (start + length).min(text.len());
            text.splice(start..end, insert.chars());
        }
        read(&text.into_iter().collect::<String>());
    }
}

/// Reads and shows, for panics and for places outside the text.
fn read(text: &str) {
    let source = Source::new("text", text);
    let problems = match job::parse(&source) {
        Ok((_, warnings)) => warnings,
        Err(problems) => {
            assert!(!problems.is_empty());
            problems
        }
    };
    assert!(problems.iter().all(|problem| problem.span.start <= text.len()));
    source.fancy(&problems, false);
}
