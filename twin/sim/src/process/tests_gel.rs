//! Gels behind the nozzle against the Newtonian closed forms, sums and limits.

use proptest::prelude::*;

use super::gel_sag::{FreshGel, GelStrand};
use super::plastic_bending::{curvature_rate, plastic_moment_n_m};
use super::sag::{self, Fluidity, SoftBeam};
use super::tests::{close, within};
use super::yield_stress::{HerschelBulkley, Structure, carried};

const WEIGHT: f64 = 1130.0 * 9.81;

fn bingham(yield_pa: f64) -> HerschelBulkley {
    HerschelBulkley { yield_pa, consistency_pa_sn: 0.3, index: 1.0 }
}

/// A 3 mm strand at 5 mm/s, set after 2 s: a soft zone of 10 mm.
fn strand(gel: FreshGel, span_m: f64) -> GelStrand {
    GelStrand { gel, diameter_m: 3e-3, weight_n_m3: WEIGHT, speed_m_s: 5e-3, span_m, until_s: 2.0 }
}

#[test]
fn without_yield_stress_it_is_the_newtonian() {
    let fluidity = Fluidity::constant(0.3, 2.0);
    // shorter than the zone, about as long, and where the span no longer matters
    for span_m in [4e-3, 8e-3, 11e-3, 15e-3, 40e-3] {
        let beam = SoftBeam {
            diameter_m: 3e-3,
            density_kg_m3: 1130.0,
            across_m_s2: 9.81,
            speed_m_s: 5e-3,
            span_m,
        };
        let gel = strand(FreshGel::rested(bingham(0.0)), span_m);
        close(gel.clamped_sag_m(), beam.clamped_sag_m(fluidity), 1e-9);
        close(gel.tip_drop_m(), beam.tip_drop_m(fluidity), 1e-9);
        // the bound of a short span is 1/184.6 as printed, and its place is found to a node
        close(gel.hinged_sag_m(), beam.hinged_sag_m(fluidity), 2e-3);
        close(gel.shear_sag_m(), beam.shear_sag_m(0.3, 2.0), 1e-12);
    }
    let gel = strand(FreshGel::rested(bingham(0.0)), 0.04);
    let inertia_m4 = sag::inertia_m4(3e-3);
    let line = WEIGHT * std::f64::consts::PI / 4.0 * 9e-6;
    close(gel.hinged_sag_m(), line * 1e-10 / (360.0 * 0.3 * inertia_m4 * 5e-3), 1e-9);
    // and comes to it as the yield stress goes
    let off = |yield_pa: f64| {
        let gel = strand(FreshGel::rested(bingham(yield_pa)), 0.04);
        [gel.clamped_sag_m(), gel.hinged_sag_m(), gel.tip_drop_m(), gel.shear_sag_m()]
    };
    let (none, little, less) = (off(0.0), off(1e-2), off(1e-3));
    for k in 0..4 {
        let ratio = (none[k] - little[k]) / (none[k] - less[k]);
        assert!((9.0..11.0).contains(&ratio), "{k}: {ratio}");
    }
}

fn silica(index: f64) -> HerschelBulkley {
    HerschelBulkley { yield_pa: 60.0, consistency_pa_sn: 20.0, index }
}

fn recovering(fluid: HerschelBulkley, start: f64, recovery_s: f64) -> FreshGel {
    FreshGel { fluid, structure: Structure { recovery_s, breakdown: 1.0 }, start }
}

/// Root of a falling function by halving.
fn halving(mut low: f64, mut high: f64, value: impl Fn(f64) -> f64) -> f64 {
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if value(middle) > 0.0 { low = middle } else { high = middle }
    }
    0.5 * (low + high)
}

#[test]
fn a_zone_against_a_sum() {
    let line = WEIGHT * std::f64::consts::PI / 4.0 * 9e-6;
    for (index, start, recovery_s) in
        [(0.3, 0.2, 3.0), (0.5, 0.0, 5.0), (0.7, 0.1, 60.0), (1.0, 0.1, 2.0), (0.5, 1.0, 1.0)]
    {
        let gel = recovering(silica(index), start, recovery_s);
        let strand = GelStrand { until_s: 4.0, ..strand(gel, 1.0) };
        let (length_m, steps) = (0.02, 4000);
        let h = length_m / f64::from(steps);
        let places = || (0..steps).map(|i| (f64::from(i) + 0.5) * h);
        // the nozzle a hinge: turns sum to none
        let rate = |x: f64, force: f64| {
            let fluid = HerschelBulkley { yield_pa: gel.yield_pa(x / 5e-3), ..gel.fluid };
            curvature_rate((0.5 * line * x - force) * x, 3e-3, &fluid)
        };
        let force = halving(0.0, 0.5 * line * length_m, |f| places().map(|x| rate(x, f)).sum());
        let want: f64 = places().map(|x| 0.5 * x * x * rate(x, force) * h / 5e-3).sum();
        close(strand.hinged_sag_m(), want, 2e-3);
        // a clamp, one yield stress: moment and force at the nozzle so that turns and their arms sum to none
        let rested = GelStrand { gel: FreshGel::rested(silica(index)), ..strand };
        let rate = |x: f64, middle: f64| {
            let from_m = x - 0.5 * length_m;
            curvature_rate(0.5 * line * from_m * from_m - middle, 3e-3, &silica(index))
        };
        let top = line * length_m * length_m / 8.0;
        let middle = halving(0.0, top, |m| places().map(|x| rate(x, m)).sum());
        let sum =
            |power: i32| -> f64 { places().map(|x| x.powi(power) * rate(x, middle) * h).sum() };
        within(sum(1), 0.0, 1e-6 * sum(2) / length_m);
        close(rested.clamped_sag_m(), 0.5 * sum(2) / 5e-3, 1e-4);
        // a free end, ages summed too
        let ages = 400;
        let drop = |x: f64| -> f64 {
            let step = (4.0 - x / 5e-3) / f64::from(ages);
            let at = |j: i32| {
                let yield_pa = gel.yield_pa(x / 5e-3 + (f64::from(j) + 0.5) * step);
                let fluid = HerschelBulkley { yield_pa, ..gel.fluid };
                curvature_rate(0.5 * line * x * x, 3e-3, &fluid) * step
            };
            (0..ages).map(at).sum()
        };
        let want: f64 =
            places().step_by(10).map(|x| (x + 4.5 * h) * drop(x + 4.5 * h) * 10.0 * h).sum();
        close(strand.tip_drop_m(), want, 2e-3);
    }
}

#[test]
fn a_free_end_of_a_power_law() {
    // κ̇ = c ξ^(2p): c ℓ^(2p+3)/(v (2p+2)(2p+3))
    let thin = HerschelBulkley { yield_pa: 0.0, ..silica(0.4) };
    let line = WEIGHT * std::f64::consts::PI / 4.0 * 9e-6;
    let root = curvature_rate(0.5 * line * 1e-4, 3e-3, &thin);
    let want = root * 1e-6 / (5e-3 * 7.0 * 8.0);
    close(strand(FreshGel::rested(thin), 1.0).tip_drop_m(), want, 1e-9);
}

#[test]
fn below_its_plastic_moment_it_stands() {
    let spans = carried(60.0, WEIGHT, 3e-3);
    let plastic = plastic_moment_n_m(60.0, 3e-3);
    let line = WEIGHT * std::f64::consts::PI / 4.0 * 9e-6;
    // clamped and hinged: a collapse of two hinges, w L² = 2 (3 + 2√2) M_p
    let propped_m = (2.0 * (3.0 + 8.0_f64.sqrt()) * plastic / line).sqrt();
    assert!(spans.cantilever_m < propped_m && propped_m < spans.clamped_m);
    for index in [0.3, 1.0] {
        // the zone or the span is what is carried, or a little more
        let at = |length_m: f64| {
            let until_s = length_m / 5e-3;
            GelStrand { until_s, ..strand(FreshGel::rested(silica(index)), 1.0) }
        };
        let short = |span_m: f64| GelStrand { span_m, ..at(1.0) };
        type Law = fn(&GelStrand) -> f64;
        let laws: [(Law, f64); 3] = [
            (GelStrand::clamped_sag_m, spans.clamped_m),
            (GelStrand::hinged_sag_m, propped_m),
            (GelStrand::tip_drop_m, spans.cantilever_m),
        ];
        for (law, carried_m) in laws {
            assert_eq!(law(&at(0.999 * carried_m)), 0.0);
            assert_eq!(law(&short(0.999 * carried_m)), 0.0);
            assert!(law(&at(1.1 * carried_m)) > 0.0 && law(&short(1.1 * carried_m)) > 0.0);
        }
        let shear_m = 2.0 * 0.9 * 60.0 / WEIGHT;
        assert_eq!(at(0.999 * shear_m).shear_sag_m(), 0.0);
        assert!(at(1.001 * shear_m).shear_sag_m() > 0.0);
    }
}

#[test]
fn recovery_lies_between_sheared_and_rested() {
    let sags = |gel: FreshGel, span_m: f64| {
        let strand = GelStrand { until_s: 4.0, ..strand(gel, span_m) };
        [strand.hinged_sag_m(), strand.tip_drop_m()]
    };
    for span_m in [0.012, 0.1] {
        let fluid = silica(0.5);
        let rested = sags(FreshGel::rested(fluid), span_m);
        let apart = HerschelBulkley { yield_pa: 0.0, ..fluid };
        let gone = sags(FreshGel::rested(apart), span_m);
        let never = sags(recovering(fluid, 0.0, 1e12), span_m);
        let times = [0.1, 1.0, 5.0, 60.0].map(|t| sags(recovering(fluid, 0.0, t), span_m));
        for k in 0..2 {
            close(never[k], gone[k], 1e-6);
            assert!(times.windows(2).all(|pair| pair[0][k] < pair[1][k]), "{times:?}");
            assert!(rested[k] < times[0][k] && times[3][k] < gone[k], "{times:?}");
        }
        let soon = sags(recovering(fluid, 0.999_999, 5.0), span_m);
        for k in 0..2 {
            within(soon[k], rested[k], 1e-4 * gone[k]);
        }
    }
}

/// Powers of hundreds cancel: no number, not a negative one.
#[test]
fn an_index_near_zero_sags_no_negative_number() {
    let fluid = HerschelBulkley {
        yield_pa: 60.0,
        consistency_pa_sn: 20.0,
        index: 0.001_697_898_041_317_335_4,
    };
    let gel = recovering(fluid, 4.934_097_085_252_959e-145, 6.236_623_725_515_179e293);
    let strand = strand(gel, 0.001_697_898_041_317_335_4);
    for sag in [strand.clamped_sag_m(), strand.hinged_sag_m(), strand.tip_drop_m()] {
        assert!(sag.is_nan() || sag >= 0.0, "{sag}");
    }
}

/// Its youngest section alone yields, and the clamp not: no force at the hinge turns anything, the greatest among them.
#[test]
fn a_zone_that_turns_nowhere_does_not_sag() {
    let fluid = HerschelBulkley { yield_pa: 229.5, consistency_pa_sn: 0.1, index: 0.3 };
    let gel = recovering(fluid, 0.332_672_528_774_477_45, 1.315_681_543_383_456);
    let strand = GelStrand { until_s: 2.181_341_942_222_628_6, ..strand(gel, 0.05) };
    assert_eq!(strand.hinged_sag_m(), 0.0);
}

proptest! {
    #[test]
    fn more_yield_stress_never_more_sag(
        yield_pa in 0.0..100.0_f64, more in 1.0..3.0_f64, index in 0.3..1.0_f64, k in 0.1..80.0_f64,
        start in 0.0..1.0_f64, recovery_s in 0.1..60.0_f64, span_m in 1e-3..0.05_f64, until_s in 0.05..8.0_f64,
    ) {
        let sags = |yield_pa: f64| {
            let fluid = HerschelBulkley { yield_pa, consistency_pa_sn: k, index };
            let strand = GelStrand { until_s, ..strand(recovering(fluid, start, recovery_s), span_m) };
            let rested = GelStrand { gel: FreshGel::rested(fluid), ..strand };
            [strand.hinged_sag_m(), strand.tip_drop_m(), strand.shear_sag_m(), strand.clamped_sag_m(),
             rested.hinged_sag_m(), rested.tip_drop_m(), rested.shear_sag_m(), rested.clamped_sag_m()]
        };
        let (less, much) = (sags(yield_pa), sags(yield_pa * more));
        for i in 0..8 {
            prop_assert!(much[i] <= less[i] * (1.0 + 1e-6), "{i}: {less:?} {much:?}");
            // recovering never sags less than rested
            prop_assert!(i > 3 || less[i] >= less[i + 4] * (1.0 - 1e-3), "{i}: {less:?}");
        }
    }

    #[test]
    fn any_gel_sags_a_number_or_none(v in proptest::collection::vec(any::<f64>(), 11), small in 1e-3..2.0_f64) {
        let fluid = HerschelBulkley { yield_pa: v[0], consistency_pa_sn: v[1], index: if v[2] > 0.0 { small } else { v[2] } };
        let wild = GelStrand {
            gel: recovering(fluid, v[3], v[4]),
            diameter_m: v[5], weight_n_m3: v[6], speed_m_s: v[7], span_m: v[8], until_s: v[9],
        };
        let tame = GelStrand { gel: wild.gel, ..strand(wild.gel, v[8]) };
        for strand in [wild, tame, strand(FreshGel::sheared(silica(small), wild.gel.structure, v[10]), small)] {
            for sag in [strand.clamped_sag_m(), strand.hinged_sag_m(), strand.tip_drop_m(), strand.shear_sag_m()] {
                prop_assert!(sag.is_nan() || sag >= 0.0, "{sag} {strand:?}");
            }
        }
    }
}
