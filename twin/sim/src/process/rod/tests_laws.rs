//! What must stay the same, what yields, what stretches.

use super::super::tests::{close, within};
use super::tests::*;
use super::*;

const FLOWED: f64 = 1e-5;

/// All of it flows at once.
fn flows(_: usize, age_s: f64) -> f64 {
    FLOWED * age_s
}

fn all(out: &RodOutcome) -> Vec<[f64; 2]> {
    out.offset_m.iter().chain(&out.slope).copied().collect()
}

/// Printed level, then let go, under a gravity of the time.
fn under(gravity: &dyn Fn(f64) -> [f64; 3]) -> RodOutcome {
    let elements = level(0.03, 30);
    let after = [until_rigid(hold(End::Clamped, End::Free))];
    let strand = strand(&elements, flowing(&ages, 16.0), CLAMPED, &after);
    printed(&Strand { gravity_m_s2: gravity, ..strand })
}

#[test]
fn turns_with_gravity_and_adds_up() {
    let down = under(&plumb);
    let turn = 0.6_f64;
    let turned = under(&|_| [0.0, GRAVITY * turn.sin(), -GRAVITY * turn.cos()]);
    let across = under(&|_| [0.0, GRAVITY, 0.0]);
    let greatest = down.sag_nozzle_m;
    close(turned.sag_nozzle_m, greatest, 1e-12);
    let axes = Axes::new([1.0, 0.0, 0.0], DOWN);
    let side = axes.across[1][1]; // which way along y the second direction is
    for ((turned, down), across) in all(&turned).iter().zip(all(&down)).zip(all(&across)) {
        within(turned[0], down[0] * turn.cos(), 1e-12 * greatest);
        within(turned[1], side * down[0] * turn.sin(), 1e-12 * greatest);
        for i in 0..2 {
            let sum = down[i] * turn.cos() + across[i] * turn.sin();
            within(turned[i], sum, 1e-12 * greatest);
        }
    }
}

#[test]
fn gravity_that_turns_half_way() {
    // A bed on a flange turns while the strand is soft: the sum of what each gravity did in its time.
    let until = |time_s: f64| if time_s < 3.0 { 1.0 } else { 0.0 };
    let first = under(&|t| [0.0, 0.0, -GRAVITY * until(t)]);
    let second = under(&|t| [0.0, GRAVITY * (1.0 - until(t)), 0.0]);
    let both = under(&|t| [0.0, GRAVITY * (1.0 - until(t)), -GRAVITY * until(t)]);
    assert!(first.sag_nozzle_m > 1e-5 && second.sag_nozzle_m > 1e-5);
    for ((both, first), second) in all(&both).iter().zip(all(&first)).zip(all(&second)) {
        for i in 0..2 {
            within(both[i], first[i] + second[i], 1e-12 * both[0].hypot(both[1]).max(1e-6));
        }
    }
}

#[test]
fn split_segment_and_scale() {
    let elements = level(0.03, 30);
    let after = [until_rigid(TOUCHING)];
    let whole = printed(&strand(&elements, flowing(&ages, 16.0), CLAMPED, &after));
    // one segment in two, names apart: the others stay where they are but for the solver's own error
    let mut split = elements.clone();
    let half = Element {
        length_m: 0.5 * elements[12].length_m,
        printing_s: 0.5 * elements[12].printing_s,
        ..elements[12]
    };
    split.splice(12..13, [half, half]);
    let parts = printed(&strand(&split, flowing(&ages, 16.0), CLAMPED, &after));
    close(parts.offset_m[25][0], whole.offset_m[24][0], 0.005);
    // every segment in two is the same as two cuts to a segment
    let doubled: Vec<Element> = elements
        .iter()
        .flat_map(|e| {
            [Element { length_m: 0.5 * e.length_m, printing_s: 0.5 * e.printing_s, ..*e }; 2]
        })
        .collect();
    let twice = printed(&strand(&doubled, flowing(&ages, 16.0), CLAMPED, &after));
    let mut cut = strand(&elements, flowing(&ages, 16.0), CLAMPED, &after);
    cut.fineness.cuts = 2;
    let cut = printed(&cut);
    for i in 0..=30 {
        within(twice.offset_m[2 * i][0], cut.offset_m[i][0], 1e-15);
    }
    // all lengths three times, viscosity three times: offsets three times
    let large: Vec<Element> = elements
        .iter()
        .map(|e| Element {
            length_m: 3.0 * e.length_m,
            area_m2: 9.0 * e.area_m2,
            inertia_m4: 81.0 * e.inertia_m4,
            line_mass_kg_m: 9.0 * e.line_mass_kg_m,
            ..*e
        })
        .collect();
    let thicker = |i: usize, age_s: f64| ages(i, age_s) / 3.0;
    let scaled = printed(&strand(&large, flowing(&thicker, 16.0), CLAMPED, &after));
    for (large, small) in scaled.offset_m.iter().zip(&whole.offset_m) {
        within(large[0], 3.0 * small[0], 1e-14);
    }
}

#[test]
fn viscous_beams_are_elastic_beams_in_time() {
    // E is 3 η/t, whatever holds it.
    let (elements, time_s) = (at_once(0.04, 64), 3.0);
    let e = elements[0];
    let scale = e.line_mass_kg_m * GRAVITY * 0.04_f64.powi(4) * FLOWED * time_s / e.inertia_m4;
    for (ends, want) in [
        (CLAMPED, 1.0 / 384.0),
        (TOUCHING, 1.0 / 192.0),
        (hold(End::Hinged, End::Clamped), 1.0 / 192.0),
        (hold(End::Hinged, End::Hinged), 5.0 / 384.0),
        (hold(End::Clamped, End::Free), 17.0 / 384.0),
        (hold(End::Free, End::Clamped), 17.0 / 384.0),
    ] {
        let after = [Phase { hold: ends, duration_s: time_s }];
        let out = printed(&strand(&elements, flowing(&flows, 1e9), CLAMPED, &after));
        close(out.offset_m[32][0], want * scale, 1e-6);
    }
}

#[test]
fn smay_span_small_slopes() {
    // SMAY-SPAN: G = (25/18) w s⁴ D, E = 3 G, both ends free to turn: a twentieth of the diameter
    let length_m = 20.0 * DIAMETER;
    let shear_pa = 25.0 / 18.0 * DENSITY * GRAVITY * 20.0_f64.powi(4) * DIAMETER;
    let never = |_: usize, _: f64| 0.0;
    let modulus = |_: usize, _: f64| 3.0 * shear_pa;
    let ageing = Ageing { modulus_pa: Some(&modulus), ..flowing(&never, 0.0) };
    let after = [until_rigid(hold(End::Hinged, End::Hinged))];
    let elements = at_once(length_m, 64);
    let out = printed(&strand(&elements, ageing, CLAMPED, &after));
    close(out.offset_m[32][0], 0.05 * DIAMETER, 1e-6);
}

#[test]
fn relaxes_as_maxwell_does() {
    // A cantilever that flows and springs: both add, exactly.
    let elements = at_once(0.02, 20);
    let modulus = |_: usize, _: f64| 2e5;
    let ageing = Ageing { modulus_pa: Some(&modulus), ..flowing(&flows, 1e9) };
    let free = hold(End::Clamped, End::Free);
    let after = [Phase { hold: free, duration_s: 2.0 }];
    let out = printed(&strand(&elements, ageing, CLAMPED, &after));
    let e = elements[0];
    let scale = e.line_mass_kg_m * GRAVITY * 0.02_f64.powi(4) / (8.0 * e.inertia_m4);
    close(out.end_drop_m(), scale * (2.0 * FLOWED + 1.0 / 2e5), 1e-6);
    // Released from its clamp a strand springs back by its spring alone, however stiff that is against the flow.
    for modulus_pa in [1e3, 1e6, 1e12] {
        let modulus = |_: usize, _: f64| modulus_pa;
        let ageing = Ageing { modulus_pa: Some(&modulus), ..flowing(&flows, 1e9) };
        let out = printed(&strand(
            &elements,
            ageing,
            CLAMPED,
            &[Phase { hold: CLAMPED, duration_s: 50.0 }],
        ));
        assert!(out.offset_m.iter().flatten().all(|x| x.is_finite()));
        let bent = scale * 8.0 / 384.0 * (50.0 * FLOWED + 1.0 / modulus_pa);
        close(out.offset_m[10][0], bent, 1e-4);
    }
}

#[test]
fn yields_where_the_moment_is_above() {
    // A cantilever of Bingham gel: κ = J (M − M_y)/I where M is above M_y.
    let (length_m, count, time_s) = (0.02, 400, 3.0);
    let elements = at_once(length_m, count);
    let e = elements[0];
    let weight = e.line_mass_kg_m * GRAVITY;
    let root = 0.5 * weight * length_m * length_m;
    let drop = |threshold: f64| {
        let elements: Vec<Element> =
            elements.iter().map(|e| Element { yield_moment_n_m: threshold, ..*e }).collect();
        let after = [Phase { hold: hold(End::Clamped, End::Free), duration_s: time_s }];
        printed(&strand(&elements, flowing(&flows, 1e9), CLAMPED, &after)).end_drop_m()
    };
    let free = drop(0.0);
    close(free, weight * length_m.powi(4) * FLOWED * time_s / (8.0 * e.inertia_m4), 1e-6);
    assert!(drop(1.001 * root) < 1e-5 * free);
    let ratio = 0.3;
    // ∫ (w r²/2 − M_y) r dr from where they are equal, r = √0.3 L, to L
    let want = 0.125 * (1.0 - ratio * ratio) - 0.25 * ratio * (1.0 - ratio);
    close(drop(ratio * root), free * 8.0 * want, 0.002);
    // held at both ends by its nozzle and where it began, it hangs by what yields
    let strand_of = |threshold: f64| {
        let elements: Vec<Element> =
            level(0.02, 40).iter().map(|e| Element { yield_moment_n_m: threshold, ..*e }).collect();
        printed(&strand(&elements, flowing(&ages, 16.0), CLAMPED, &[])).sag_nozzle_m
    };
    let sags = [0.0, 0.001, 0.01, 0.1, 1.0].map(|share| strand_of(share * root));
    assert!(sags.windows(2).all(|pair| pair[0] > pair[1]), "{sags:?}");
    assert!(sags[4] < 1e-4 * sags[0], "{sags:?}");
}

#[test]
fn steep_strands_stretch() {
    // Hanging from the nozzle: N = ρ g A x, so L² ρ g J/2 longer; between two holds the middle moves an eighth.
    let (length_m, time_s) = (0.03, 2.0);
    let axes = Axes::new(DOWN, DOWN);
    let upright = Axes::new([0.0, 0.0, 1.0], DOWN);
    let elements = |axes| -> Vec<Element> {
        at_once(length_m, 30).iter().map(|e| Element { axes, ..*e }).collect()
    };
    let stretch = DENSITY * GRAVITY * length_m * length_m * FLOWED * time_s;
    let run = |axes, ends| {
        let elements = elements(axes);
        let after = [Phase { hold: ends, duration_s: time_s }];
        printed(&strand(&elements, flowing(&flows, 1e9), CLAMPED, &after))
    };
    let hanging = run(upright, hold(End::Free, End::Clamped));
    close(hanging.along_m[0], -0.5 * stretch, 1e-9);
    within(hanging.along_m[30], 0.0, 1e-15);
    close(hanging.thinning[29], (1.0 + stretch / length_m * 29.5 / 30.0).powf(-0.5), 1e-9);
    let held = run(axes, CLAMPED);
    close(held.along_m[15], stretch / 8.0, 1e-9);
    within(held.along_m[30], 0.0, 1e-15);
    assert!(held.thinning[0] < 1.0 && held.thinning[29] > 1.0);
    assert!(held.sag_nozzle_m == 0.0);
    // the same of one that springs, whatever it is held by
    let never = |_: usize, _: f64| 0.0;
    let modulus = |_: usize, _: f64| 1e6;
    for ends in [CLAMPED, TOUCHING, hold(End::Hinged, End::Hinged)] {
        let ageing = Ageing { modulus_pa: Some(&modulus), ..flowing(&never, 0.0) };
        let elements = elements(axes);
        let out = printed(&strand(&elements, ageing, CLAMPED, &[until_rigid(ends)]));
        close(out.along_m[15], DENSITY * GRAVITY * length_m * length_m / 8e6, 1e-9);
    }
    let standing = run(upright, hold(End::Clamped, End::Free));
    close(standing.along_m[30], -0.5 * stretch, 1e-9);
}

#[test]
fn shrinks_to_one_side() {
    // Curvature 1/m that comes with age and no load: an arc where nothing holds, none where all is clamped.
    let curls = |_: usize, age_s: f64| [0.0, age_s.min(1.0)];
    let ageing = Ageing { free_curvature_per_m: Some(&curls), ..flowing(&ages, 16.0) };
    let elements = at_once(0.02, 20);
    let none = |_: f64| [0.0; 3];
    let after = [until_rigid(hold(End::Clamped, End::Free))];
    let free = Strand { gravity_m_s2: &none, ..strand(&elements, ageing, CLAMPED, &after) };
    close(printed(&free).offset_m[20][1], 0.5 * 0.02 * 0.02, 1e-6);
    let after = [until_rigid(CLAMPED)];
    let clamped = Strand { gravity_m_s2: &none, ..strand(&elements, ageing, CLAMPED, &after) };
    assert!(printed(&clamped).sag_nozzle_m < 1e-12);
}
