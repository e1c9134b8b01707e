//! Yield-stress gels against closed forms, limits and brute force.

use std::f64::consts::PI;

use proptest::prelude::*;

use super::gel::{cantilever_length_m, clamped_span_m, hanging_length_m};
use super::plastic_bending::{GelBeam, curvature_rate, plastic_moment_n_m, section_moment};
use super::sag::inertia_m4;
use super::tests::{close, within};
use super::tube::{pressure_drop_pa, tube_flow_m3_s, wall_rate_per_s, wall_stress_pa};
use super::yield_stress::{
    Carried, HerschelBulkley, Structure, capillary_pa, carried, holds_shape, yield_at_age_pa,
};

/// Nominal values of the reference.
fn silica() -> HerschelBulkley {
    HerschelBulkley { yield_pa: 60.0, consistency_pa_sn: 20.0, index: 0.5 }
}

/// Weight of a gel of 1130 kg/m³ as the cases have it.
const WEIGHT: f64 = 1130.0 * 9.81;

#[test]
fn yield_hang() {
    close(hanging_length_m(60.0, WEIGHT), 0.009_374_852_142_398_728, 1e-3);
    close(carried(60.0, WEIGHT, 3e-3).hanging_m, 0.009_374_852_142_398_728, 1e-3);
}

#[test]
fn yield_cant() {
    let want_m = 0.003_454_914_249_839_961;
    close(cantilever_length_m(60.0, WEIGHT, 3e-3), want_m, 1e-3);
    close(carried(60.0, WEIGHT, 3e-3).cantilever_m, want_m, 1e-3);
    // the flow law starts there
    let beam = GelBeam { fluid: silica(), diameter_m: 3e-3, weight_n_m3: WEIGHT };
    assert!(
        beam.cantilever_m_s(0.999 * want_m) == 0.0 && beam.cantilever_m_s(1.001 * want_m) > 0.0
    );
}

#[test]
fn yield_cc() {
    let want_m = 0.009_771_973_177_919_481;
    close(clamped_span_m(60.0, WEIGHT, 3e-3), want_m, 1e-3);
    close(carried(60.0, WEIGHT, 3e-3).clamped_m, want_m, 1e-3);
    let beam = GelBeam { fluid: silica(), diameter_m: 3e-3, weight_n_m3: WEIGHT };
    assert!(beam.clamped_m_s(0.999 * want_m) == 0.0 && beam.clamped_m_s(1.001 * want_m) > 0.0);
}

#[test]
fn structure_comes_back() {
    let structure = Structure { recovery_s: 5.0, breakdown: 0.4 };
    // brute force: Runge–Kutta on the law as printed, at rest and in shear
    for rate in [0.0, 0.3, 40.0] {
        let law = |level: f64| (1.0 - level) / 5.0 - 0.4 * rate * level;
        let (mut level, h) = (0.7, 1e-3);
        for _ in 0..2000 {
            let a = law(level);
            let b = law(level + 0.5 * h * a);
            let c = law(level + 0.5 * h * b);
            level += h / 6.0 * (a + 2.0 * b + 2.0 * c + law(level + h * c));
        }
        within(structure.sheared(0.7, rate, 2.0), level, 1e-11);
        within(law(structure.steady(rate)), 0.0, 1e-13);
    }
    within(structure.rested(0.7, 2.0), structure.sheared(0.7, 0.0, 2.0), 1e-15);
    // two rests are one
    within(structure.rested(structure.rested(0.1, 1.3), 2.2), structure.rested(0.1, 3.5), 1e-15);
    close(structure.age_to_s(0.1, structure.rested(0.1, 3.5)), 3.5, 1e-12);
    assert_eq!(structure.age_to_s(0.5, 0.4), 0.0);
    assert_eq!(structure.age_to_s(0.5, 1.0), f64::INFINITY);
}

#[test]
fn a_sheared_gel_has_little_time() {
    // sheared apart in the nozzle, 60 Pa, 5 s: after 0.4 s of set time it holds 4.6 Pa, its surface pulls with 22
    let structure = Structure { recovery_s: 5.0, breakdown: 1.0 };
    let fresh_pa = yield_at_age_pa(60.0, structure, 0.0, 0.4);
    within(fresh_pa, 4.6, 0.05);
    within(capillary_pa(0.033, 1.5e-3), 22.0, 1e-9);
    assert!(!holds_shape(fresh_pa, 0.033, 1.5e-3) && holds_shape(60.0, 0.033, 1.5e-3));
    let age_s = structure.age_to_s(0.0, 22.0 / 60.0);
    close(yield_at_age_pa(60.0, structure, 0.0, age_s), 22.0, 1e-12);
    within(age_s, 2.28, 0.01);
    // its spans grow with age towards those of the rested gel
    let mut last = Carried { hanging_m: 0.0, cantilever_m: 0.0, clamped_m: 0.0 };
    for age_s in [0.1, 1.0, 10.0, 1e4] {
        let now = carried(yield_at_age_pa(60.0, structure, 0.0, age_s), WEIGHT, 3e-3);
        assert!(now.hanging_m > last.hanging_m && now.cantilever_m > last.cantilever_m);
        assert!(now.clamped_m > last.clamped_m);
        last = now;
    }
    assert_eq!(last, carried(60.0, WEIGHT, 3e-3));
    close(silica().at_structure(0.25).yield_pa, 15.0, 1e-15);
}

#[test]
fn the_flow_curve_turns_round() {
    for rate in [0.01, 1.0, 300.0] {
        close(silica().rate_per_s(silica().stress_pa(rate)), rate, 1e-10);
    }
    close(silica().stress_pa(4.0), 100.0, 1e-14);
    assert!(silica().rate_per_s(60.0) == 0.0 && silica().rate_per_s(-61.0) < 0.0);
}

#[test]
fn tube_limits() {
    let (diameter_m, length_m, flow) = (3e-3, 0.05, 28e-9);
    let radius_m: f64 = 0.5 * diameter_m;
    // Poiseuille
    let oil = HerschelBulkley { yield_pa: 0.0, consistency_pa_sn: 0.3, index: 1.0 };
    let want = 8.0 * 0.3 * length_m * flow / (PI * radius_m.powi(4));
    close(pressure_drop_pa(&oil, flow, diameter_m, length_m), want, 1e-12);
    // Buckingham–Reiner
    let mud = HerschelBulkley { yield_pa: 60.0, ..oil };
    for wall_pa in [60.001, 75.0, 400.0, 1e5] {
        let plug: f64 = 60.0 / wall_pa;
        let reiner = PI * radius_m.powi(3) * wall_pa / (4.0 * 0.3)
            * (1.0 - 4.0 / 3.0 * plug + plug.powi(4) / 3.0);
        let cancels = 1e-9 + 1e-15 / (1.0 - plug).powi(2);
        close(tube_flow_m3_s(&mud, wall_pa, diameter_m), reiner, cancels);
    }
    // power law, and the wall rate of Rabinowitsch
    let thin = HerschelBulkley { yield_pa: 0.0, ..silica() };
    let speed = flow / (PI * radius_m * radius_m);
    let rate = wall_rate_per_s(speed, diameter_m, 0.5);
    close(wall_stress_pa(&thin, flow, diameter_m), thin.stress_pa(rate), 1e-12);
    close(wall_rate_per_s(speed, diameter_m, 1.0), 8.0 * speed / diameter_m, 1e-14);
    // at the yield stress nothing flows, and no flow takes the yield stress to start
    assert_eq!(tube_flow_m3_s(&silica(), 60.0, diameter_m), 0.0);
    close(wall_stress_pa(&silica(), 0.0, diameter_m), 60.0, 1e-15);
    assert!(wall_stress_pa(&HerschelBulkley { index: 0.0, ..silica() }, flow, diameter_m).is_nan());
}

#[test]
fn tube_against_brute_force() {
    // velocity profile summed over the radius, shear rate from the law by linear stress
    for index in [0.3, 0.5, 1.0, 1.4] {
        let fluid = HerschelBulkley { index, ..silica() };
        let (wall_pa, radius_m, steps) = (150.0, 1.5e-3, 20_000);
        let h = radius_m / f64::from(steps);
        // Q = π ∫ r² γ̇ dr
        let term = |i: u32| {
            let r = (f64::from(i) + 0.5) * h;
            PI * r * r * fluid.rate_per_s(wall_pa * r / radius_m) * h
        };
        let want: f64 = (0..steps).map(term).sum();
        let got = tube_flow_m3_s(&fluid, wall_pa, 2.0 * radius_m);
        close(got, want, 1e-6);
        close(wall_stress_pa(&fluid, got, 2.0 * radius_m), wall_pa, 1e-12);
    }
    // a thick syringe gel at 4 mm/s through 3 mm and 50 mm: the wall rate of the power law is a lower bound
    let flow = 4e-3 * PI / 4.0 * 9e-6;
    let wall_pa = wall_stress_pa(&silica(), flow, 3e-3);
    assert!(silica().rate_per_s(wall_pa) > wall_rate_per_s(4e-3, 3e-3, 0.5));
    println!("syringe {} Pa", pressure_drop_pa(&silica(), flow, 3e-3, 0.05));
}

#[test]
fn curvature_limits() {
    let diameter_m = 3e-3;
    close(section_moment(diameter_m, 1.0), inertia_m4(diameter_m), 1e-12);
    close(section_moment(diameter_m, 0.0), diameter_m.powi(3) / 6.0, 1e-12);
    // Newtonian: M/(3 η I)
    let oil = HerschelBulkley { yield_pa: 0.0, consistency_pa_sn: 20.0, index: 1.0 };
    let want = 1e-6 / (3.0 * 20.0 * inertia_m4(diameter_m));
    close(curvature_rate(1e-6, diameter_m, &oil), want, 1e-12);
    // odd, nothing up to M_p = √3 τ_y D³/6, then on as the 1/n power
    let gel = silica();
    let plastic = plastic_moment_n_m(60.0, diameter_m);
    close(plastic, 3.0_f64.sqrt() * 60.0 * 27e-9 / 6.0, 1e-14);
    assert_eq!(curvature_rate(plastic, diameter_m, &gel), 0.0);
    assert_eq!(
        curvature_rate(-1.5 * plastic, diameter_m, &gel),
        -curvature_rate(1.5 * plastic, diameter_m, &gel)
    );
    let over = |share: f64| curvature_rate((1.0 + share) * plastic, diameter_m, &gel);
    close(over(0.2), 4.0 * over(0.1), 1e-10);
    // scaling: a section twice as thick under eight times the moment flows with half the curvature
    close(curvature_rate(16.0 * plastic, 2.0 * diameter_m, &gel), 0.5 * over(1.0), 1e-10);
}

#[test]
fn curvature_against_a_sum_over_the_section() {
    for index in [0.3, 0.5, 0.7, 1.0, 1.6] {
        let fluid = HerschelBulkley { index, ..silica() };
        let (diameter_m, rate, steps) = (3e-3, 40.0, 20_000);
        let radius_m = 0.5 * diameter_m;
        let h = 0.5 * PI / f64::from(steps);
        // y = R sin θ: M = ∫ σ(κ̇ y) y dA, σ = √3 τ(√3 ε̇)
        let term = |i: u32| {
            let angle = (f64::from(i) + 0.5) * h;
            let y = radius_m * angle.sin();
            let stress = 3.0_f64.sqrt() * fluid.stress_pa(3.0_f64.sqrt() * rate * y);
            4.0 * radius_m * radius_m * angle.cos().powi(2) * stress * y * h
        };
        let moment: f64 = (0..steps).map(term).sum();
        close(curvature_rate(moment, diameter_m, &fluid), rate, 1e-6);
    }
}

#[test]
fn beams_that_flow() {
    let oil = HerschelBulkley { yield_pa: 0.0, consistency_pa_sn: 20.0, index: 1.0 };
    let beam = GelBeam { fluid: oil, diameter_m: 3e-3, weight_n_m3: WEIGHT };
    let line = WEIGHT * PI / 4.0 * 9e-6;
    let stiff = 3.0 * 20.0 * inertia_m4(3e-3);
    close(beam.cantilever_m_s(0.02), line * 0.02_f64.powi(4) / (8.0 * stiff), 1e-12);
    close(beam.clamped_m_s(0.02), line * 0.02_f64.powi(4) / (384.0 * stiff), 1e-9);
    // a yield stress takes off more the nearer the span is to what it carries, and little far from it
    let gel = GelBeam { fluid: HerschelBulkley { yield_pa: 60.0, ..oil }, ..beam };
    let share = |span_m: f64| gel.clamped_m_s(span_m) / beam.clamped_m_s(span_m);
    let carried_m = carried(60.0, WEIGHT, 3e-3).clamped_m;
    let shares = [1.05, 1.5, 3.0, 10.0].map(|over| share(over * carried_m));
    println!("share of the weight that flows at 1.05, 1.5, 3, 10 times the span: {shares:?}");
    assert!(shares.windows(2).all(|pair| pair[1] > pair[0]) && shares[3] < 1.0 && shares[3] > 0.95);
    // a power law by hand: the free end, closed
    let thin = HerschelBulkley { yield_pa: 0.0, ..silica() };
    let free = GelBeam { fluid: thin, ..beam };
    let root = curvature_rate(0.5 * line * 0.02 * 0.02, 3e-3, &thin);
    close(free.cantilever_m_s(0.02), root * 0.02 * 0.02 / 6.0, 1e-10); // κ̇ ~ x⁴
    // no weight, no flow
    assert_eq!(GelBeam { weight_n_m3: 0.0, ..gel }.clamped_m_s(0.1), 0.0);
    assert_eq!(GelBeam { weight_n_m3: 0.0, ..gel }.cantilever_m_s(0.1), 0.0);
}

#[test]
fn clamped_beam_against_a_sum() {
    // turn of the half span by midpoints for the moment at the middle found by halving
    for (span_m, fluid) in
        [(0.012, silica()), (0.03, silica()), (0.012, HerschelBulkley { index: 1.0, ..silica() })]
    {
        let beam = GelBeam { fluid, diameter_m: 3e-3, weight_n_m3: WEIGHT };
        let line = WEIGHT * PI / 4.0 * 9e-6;
        let (half_m, steps) = (0.5 * span_m, 2000);
        let h = half_m / f64::from(steps);
        let sum = |middle: f64, weight: &dyn Fn(f64) -> f64| -> f64 {
            let at = |i: u32| (f64::from(i) + 0.5) * h;
            (0..steps)
                .map(at)
                .map(|x| h * weight(x) * curvature_rate(0.5 * line * x * x - middle, 3e-3, &fluid))
                .sum()
        };
        let (mut low, mut high) = (0.0, 0.5 * line * half_m * half_m);
        for _ in 0..50 {
            let middle = 0.5 * (low + high);
            if sum(middle, &|_| 1.0) > 0.0 { low = middle } else { high = middle }
        }
        close(beam.clamped_m_s(span_m), sum(0.5 * (low + high), &|x| x - half_m), 1e-5);
    }
}

fn any_number() -> impl Strategy<Value = f64> {
    prop_oneof![any::<f64>(), -1.0..3.0, 0.0..1e3, Just(0.0), Just(f64::NAN), Just(f64::INFINITY)]
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(300))]

    #[test]
    fn any_gel_is_bounded(v in prop::array::uniform9(any_number())) {
        let fluid = HerschelBulkley { yield_pa: v[0], consistency_pa_sn: v[1], index: v[2] };
        let structure = Structure { recovery_s: v[3], breakdown: v[4] };
        let _ = (structure.sheared(v[5], v[6], v[7]), structure.steady(v[6]), structure.age_to_s(v[5], v[6]));
        let aged = yield_at_age_pa(60.0, structure, v[5], v[7]);
        prop_assert!(aged.is_nan() || (0.0..=60.0).contains(&aged));
        let pressure = pressure_drop_pa(&fluid, v[5], v[6], v[7]);
        prop_assert!(pressure.is_nan() || pressure >= 0.0 || v[7] < 0.0);
        let beam = GelBeam { fluid, diameter_m: v[5], weight_n_m3: v[6] };
        let _ = (beam.clamped_m_s(v[7]), beam.cantilever_m_s(v[7]), carried(v[0], v[6], v[5]));
        let _ = (curvature_rate(v[8], v[5], &fluid), wall_rate_per_s(v[7], v[5], v[2]), holds_shape(v[0], v[1], v[2]));
    }

    #[test]
    fn pressure_grows_with_flow(
        yield_pa in 0.0..500.0_f64, k in 0.01..200.0_f64, n in 0.2..1.5_f64, flow in 1e-12..1e-5_f64,
    ) {
        let fluid = HerschelBulkley { yield_pa, consistency_pa_sn: k, index: n };
        let pressure = |flow: f64| pressure_drop_pa(&fluid, flow, 2e-3, 0.1);
        prop_assert!(pressure(1.5 * flow) > pressure(flow));
        let wall_pa = wall_stress_pa(&fluid, flow, 2e-3);
        if wall_pa > yield_pa * (1.0 + 1e-6) {
            close(tube_flow_m3_s(&fluid, wall_pa, 2e-3), flow, 1e-6);
        }
    }
}
