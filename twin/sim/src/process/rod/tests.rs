//! Strands for the tests, order of convergence, cost, any input.

use proptest::prelude::*;

use super::super::tests::close;
use super::*;

pub(super) const GRAVITY: f64 = 9.81;
pub(super) const DENSITY: f64 = 1240.0;
pub(super) const DIAMETER: f64 = 0.0015;
pub(super) const SPEED: f64 = 0.005;
pub(super) const DOWN: [f64; 3] = [0.0, 0.0, -1.0];

/// A level piece along x; offsets down and along y.
pub(super) fn element(length_m: f64) -> Element {
    Element::round(length_m, DIAMETER, SPEED, DENSITY, Axes::new([1.0, 0.0, 0.0], DOWN))
}

pub(super) fn level(length_m: f64, count: usize) -> Vec<Element> {
    vec![element(length_m / count as f64); count]
}

pub(super) const fn hold(far: End, near: End) -> Hold {
    Hold { far, near }
}

pub(super) const CLAMPED: Hold = hold(End::Clamped, End::Clamped);
pub(super) const TOUCHING: Hold = hold(End::Clamped, End::Hinged);

pub(super) const fn until_rigid(hold: Hold) -> Phase {
    Phase { hold, duration_s: f64::INFINITY }
}

pub(super) fn flowing(compliance: &dyn Fn(usize, f64) -> f64, rigid_s: f64) -> Ageing<'_> {
    Ageing {
        compliance_per_pa: compliance,
        modulus_pa: None,
        elastic: Elastic::Total,
        free_curvature_per_m: None,
        rigid_s,
    }
}

pub(super) fn plumb(_: f64) -> [f64; 3] {
    [0.0, 0.0, -GRAVITY]
}

/// A strand under constant gravity, clamped where it began.
pub(super) fn strand<'a>(
    elements: &'a [Element],
    ageing: Ageing<'a>,
    printing: Hold,
    after: &'a [Phase],
) -> Strand<'a> {
    let fineness = Fineness { cuts: 1, steps: 32 };
    Strand { elements, ageing, gravity_m_s2: &plumb, printing, after, fineness }
}

pub(super) fn printed(strand: &Strand) -> RodOutcome {
    print_strand(strand).unwrap_or_else(|error| panic!("{error:?}"))
}

/// A strand born all at once.
pub(super) fn at_once(length_m: f64, count: usize) -> Vec<Element> {
    level(length_m, count).iter().map(|e| Element { printing_s: 1e-12, ..*e }).collect()
}

const TAU: f64 = 0.5;

pub(super) fn ages(_: usize, age_s: f64) -> f64 {
    -TAU * (-age_s / TAU).exp_m1() / 12_000.0
}

/// Down and along at a boundary of a strand of twelve e-foldings of viscosity, clamped where it began.
fn offset(
    at: usize,
    fineness: Fineness,
    ends: Hold,
    after: &[Phase],
    spring: Option<Elastic>,
) -> f64 {
    let elements = level(0.03, 10);
    let stiffens = |_: usize, age_s: f64| 2e4 * (1.0 + age_s).powi(2);
    let mut ageing = flowing(&ages, 33.0 * TAU);
    if let Some(elastic) = spring {
        ageing = Ageing { modulus_pa: Some(&stiffens), elastic, ..ageing };
    }
    printed(&Strand { fineness, ..strand(&elements, ageing, ends, after) }).offset_m[at][0]
}

/// Every halving takes the error down by 2^1.5 or more.
fn second_order(errors: &[f64]) {
    let orders: Vec<f64> = errors.windows(2).map(|pair| (pair[0] / pair[1]).log2()).collect();
    assert!(orders.iter().all(|order| *order > 1.5), "{orders:?} of {errors:?}");
}

#[test]
fn second_order_in_pieces() {
    for (ends, spring) in [
        (CLAMPED, None),
        (TOUCHING, None),
        (hold(End::Hinged, End::Clamped), None),
        (CLAMPED, Some(Elastic::Total)),
        (CLAMPED, Some(Elastic::Rate)),
    ] {
        // near the nozzle, where it still moves
        let at = |cuts| offset(9, Fineness { cuts, steps: 1 }, ends, &[], spring);
        let found = [4, 8, 16, 32].map(at);
        let best = found[3] + (found[3] - found[2]) / 3.0;
        second_order(&[0, 1, 2].map(|i| (found[i] - best).abs()));
    }
}

#[test]
fn second_order_in_steps() {
    let joined = [until_rigid(TOUCHING)];
    // Without spring and with one law of ageing for all, what the ends carry does not change: any step is exact.
    for spring in [Elastic::Total, Elastic::Rate] {
        let near = |steps| offset(9, Fineness { cuts: 2, steps }, CLAMPED, &joined, Some(spring));
        let best = near(1024);
        let errors = [16, 32, 64, 128].map(|steps| (near(steps) - best).abs());
        second_order(&errors);
    }
}

#[test]
fn springs_as_beams_do() {
    // Rigid but for its modulus, gravity only once it is printed: the beams of any textbook.
    let never = |_: usize, _: f64| 0.0;
    let modulus = |_: usize, _: f64| 1e8;
    let later = |time_s: f64| if time_s > 8.0 { plumb(0.0) } else { [0.0; 3] };
    let elements = level(0.04, 64);
    let e = elements[0];
    let scale = e.line_mass_kg_m * GRAVITY * 0.04_f64.powi(4) / (1e8 * e.inertia_m4);
    for elastic in [Elastic::Total, Elastic::Rate] {
        for (ends, want) in [
            (CLAMPED, 1.0 / 384.0),
            (TOUCHING, 1.0 / 192.0),
            (hold(End::Hinged, End::Clamped), 1.0 / 192.0),
            (hold(End::Hinged, End::Hinged), 5.0 / 384.0),
            (hold(End::Clamped, End::Free), 17.0 / 384.0),
            (hold(End::Free, End::Clamped), 17.0 / 384.0),
        ] {
            let ageing = Ageing { modulus_pa: Some(&modulus), elastic, ..flowing(&never, 1.0) };
            let after = [until_rigid(ends)];
            let strand =
                Strand { gravity_m_s2: &later, ..strand(&elements, ageing, CLAMPED, &after) };
            let out = printed(&strand);
            close(out.offset_m[32][0], want * scale, 1e-9);
        }
    }
}

#[test]
fn resolving_resolves() {
    // 30 e-foldings in six segments
    let elements = level(30.0 * SPEED * TAU, 6);
    let fineness = Fineness::resolving(5.0, 1.0);
    assert_eq!(fineness, Fineness { cuts: 15, steps: 32 });
    let e = elements[0];
    let want = e.line_mass_kg_m * GRAVITY * (SPEED * TAU).powi(5) / (4000.0 * e.inertia_m4 * SPEED);
    for (ends, want, bound) in [(CLAMPED, want / 3.0, 0.001), (TOUCHING, want, 0.004)] {
        let strand = strand(&elements, flowing(&ages, 33.0 * TAU), ends, &[]);
        close(printed(&Strand { fineness, ..strand }).sag_nozzle_m, want, bound);
    }
    assert_eq!(Fineness::resolving(1.0, 0.0).cuts, 64);
    assert_eq!(Fineness::resolving(f64::NAN, 1.0).cuts, 64);
    assert_eq!(Fineness::resolving(0.001, 1.0).cuts, 1);
}

#[test]
fn cost_is_linear_in_sections() {
    let elements = level(0.1, 100);
    let after = [until_rigid(CLAMPED)];
    let out = printed(&strand(&elements, flowing(&ages, 33.0 * TAU), CLAMPED, &after));
    assert_eq!((out.steps, out.updates), (100 + 32, 100 * 101 + 32 * 200));
}

/// Time of one strand, printed; `cargo test --release -- --ignored rod_times --nocapture`.
#[test]
#[ignore = "measures time"]
fn rod_times() {
    let table = AgeTable::new(|a| (-a / TAU).exp() / 12_000.0, 33.0 * TAU, 200);
    let read = |_: usize, age_s: f64| table.compliance_per_pa(age_s);
    let modulus = |_: usize, age_s: f64| 1e6 * (1.0 + age_s);
    for springs in [false, true] {
        for count in [25, 50, 100, 200] {
            let elements = level(0.001 * count as f64, count);
            let after = [until_rigid(hold(End::Clamped, End::Free))];
            let mut ageing = flowing(&read, table.rigid_s());
            if springs {
                ageing.modulus_pa = Some(&modulus);
            }
            let strand = strand(&elements, ageing, CLAMPED, &after);
            let mut best = f64::INFINITY;
            let mut updates = 0;
            for _ in 0..50 {
                let start = std::time::Instant::now();
                updates = printed(&strand).updates;
                best = best.min(start.elapsed().as_secs_f64());
            }
            println!("{count} segments {springs}: {:.0} us, {updates} updates", best * 1e6);
        }
    }
}

#[test]
fn says_what_falls() {
    let elements = level(0.01, 4);
    let falls =
        [hold(End::Free, End::Free), hold(End::Free, End::Hinged), hold(End::Hinged, End::Free)];
    for ends in falls {
        let after = [until_rigid(ends)];
        let rod = strand(&elements, flowing(&ages, 16.0), CLAMPED, &after);
        assert_eq!(print_strand(&rod), Err(RodError::Falls));
    }
    let rod = strand(&[], flowing(&ages, 16.0), CLAMPED, &[]);
    assert_eq!(print_strand(&rod), Err(RodError::Input));
    // a wait of the nozzle is an element without length
    let mut waits = level(0.01, 10);
    waits.insert(5, Element { length_m: 0.0, printing_s: 3.0, ..waits[0] });
    let out = printed(&strand(&waits, flowing(&ages, 16.0), CLAMPED, &[]));
    assert!(out.sag_nozzle_m > 0.0 && out.offset_m[5] == out.offset_m[6]);
}

fn end() -> impl Strategy<Value = End> {
    prop_oneof![Just(End::Clamped), Just(End::Hinged), Just(End::Free)]
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(200))]
    #[test]
    fn any_strand_is_told(
        numbers in proptest::collection::vec(any::<f64>(), 9),
        ends in (end(), end(), end(), end()),
        (cuts, steps) in (any::<u32>(), 0..200_u32),
        count in 0..4_usize,
    ) {
        let [length_m, printing_s, inertia_m4, mass, threshold, scale, modulus, rigid_s, wait_s] =
            <[f64; 9]>::try_from(numbers).unwrap_or([1.0; 9]);
        let piece = Element {
            length_m,
            printing_s,
            inertia_m4,
            line_mass_kg_m: mass,
            yield_moment_n_m: threshold,
            yield_force_n: threshold,
            ..element(1.0)
        };
        let flows = |_: usize, age_s: f64| scale * age_s;
        let springs = |_: usize, age_s: f64| modulus * age_s;
        let ageing = Ageing { modulus_pa: Some(&springs), ..flowing(&flows, rigid_s) };
        let after = [Phase { hold: hold(ends.2, ends.3), duration_s: wait_s }];
        let elements = vec![piece; count];
        let rod = strand(&elements, ageing, hold(ends.0, ends.1), &after);
        let _ = print_strand(&Strand { fineness: Fineness { cuts: cuts % 5, steps }, ..rod });
        let table = AgeTable::new(|a| scale * a, rigid_s, 5);
        let _ = table.compliance_per_pa(wait_s);
    }
}
