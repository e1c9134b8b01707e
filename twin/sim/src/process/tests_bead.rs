//! Bead per segment, draw ratio, folding, narrowing.

use std::f64::consts::PI;

use proptest::prelude::*;

use super::bead::{
    Draw, Orifice, Station, arc_at_m, beads, draw_ratio, drawn_diameter_m, flow_limits_m3_s,
    judge_draw, narrowing_from_strength, overfeed_strain,
};
use super::coiling::{
    Folding, farthest_m, folding, onset_wavelength_m, overfeed, sine_amplitude_m,
};
use super::drive::Drive;
use super::feed::{Feed, Told};
use super::tests::{close, within};

fn slam() -> Orifice {
    Orifice { nozzle_m: 0.0012, swell: 1.058, hot_kg_m3: 930.0, cold_kg_m3: 1045.0 }
}

/// Stations of a constant speed, from time zero.
fn even(speed_m_s: f64, length_m: f64, count: u32) -> Vec<Station> {
    (0..=count)
        .map(|i| length_m * f64::from(i) / f64::from(count))
        .map(|arc_m| Station { time_s: arc_m / speed_m_s, arc_m })
        .collect()
}

fn times_s(stations: &[Station]) -> Vec<f64> {
    stations.iter().map(|station| station.time_s).collect()
}

#[test]
fn mass_balance() {
    // D = √(4Q/(π v)) = B D_n √(v_free/v), whatever the segments
    let (flow, speed, orifice) = (6.33e-9, 0.005, slam());
    let told = Told::new(vec![(0.0, flow)]);
    let out = Feed { lag_s: 0.0, drive: Drive::Any }.deliver(&told);
    let free = 4.0 * flow / (PI * (1.058_f64 * 0.0012).powi(2));
    for count in [1, 7, 100] {
        let stations = even(speed, 0.1, count);
        for bead in beads(&stations, &out.volumes_m3(&times_s(&stations)), &orifice) {
            close(bead.hot_m, (4.0 * flow / (PI * speed)).sqrt(), 1e-6);
            close(bead.hot_m, 1.058 * 0.0012 * (free / speed).sqrt(), 1e-6);
            close(bead.draw_ratio, draw_ratio(flow, speed, 0.0012, 1.058), 1e-9);
            within(bead.cold_m / bead.hot_m, 0.945, 0.002);
        }
    }
}

#[test]
fn slam_extruder() {
    // 1.75 mm filament, output 1.90 times as fast as the input, at 5 mm/s of output; nozzle 1.2 mm
    let flow = PI / 4.0 * 0.00175_f64.powi(2) * 0.005 / 1.9;
    let told = Told::new(vec![(0.0, flow)]);
    let out = Feed { lag_s: 0.0, drive: Drive::Any }.deliver(&told);
    let stations = even(0.005, 0.05, 10);
    for bead in beads(&stations, &out.volumes_m3(&times_s(&stations)), &slam()) {
        close(bead.hot_m * 1e3, 1.269_583_437_692_520_6, 1e-9);
        close(bead.hot_m / 0.0012, 1.057_986_198_077_100_4, 1e-9);
        close(bead.draw_ratio, (1.058_f64 / 1.057_986_198_077_100_4).powi(2), 1e-9);
    }
}

#[test]
fn slpl_narrowing() {
    let found = narrowing_from_strength(1609.1 / 3038.3);
    close(found.area_ratio, 0.529_605_371_424_809_9, 1e-12);
    close(found.diameter_ratio, 0.727_739_906_439_663_4, 1e-12);
    close(found.overspeed, 1.888_198_371_760_661_3, 1e-12);
    assert!((1.3..2.5).contains(&found.overspeed));
    // The bead itself narrows so at that overspeed
    let diameter = |speed: f64| drawn_diameter_m(6.33e-9, speed);
    close(diameter(0.005 * found.overspeed) / diameter(0.005), found.diameter_ratio, 1e-12);
}

#[test]
fn speed_steps_and_rests() {
    // Speed doubled halfway at constant flow: diameter −29 %, EI −75 %; then a rest of 2 s
    let stations: Vec<Station> = [(0.0, 0.0), (2.0, 0.01), (3.0, 0.02), (5.0, 0.02)]
        .map(|(time_s, arc_m)| Station { time_s, arc_m })
        .to_vec();
    let told = Told::new(vec![(-1.0, 5e-9), (3.0, 0.0)]);
    let out = Feed { lag_s: 0.4, drive: Drive::Any }.deliver(&told);
    let volumes = out.volumes_m3(&times_s(&stations));
    let made = beads(&stations, &volumes, &slam());
    assert!(made[2].hot_m.is_infinite() && made[2].draw_ratio == 0.0 && made[2].volume_m3 > 0.0);
    // Volume is kept: diameters give back what came out
    for bead in &made[..2] {
        close(PI / 4.0 * bead.hot_m.powi(2) * bead.length_m, bead.volume_m3, 1e-12);
    }
    close(volumes.iter().sum(), out.volume_m3(0.0, 5.0), 1e-12);
    let steady = Feed { lag_s: 0.0, drive: Drive::Any }.deliver(&told);
    let plain = beads(&stations, &steady.volumes_m3(&times_s(&stations)), &slam());
    let ratio = plain[1].hot_m / plain[0].hot_m;
    within(ratio, 0.71, 0.005);
    within(ratio.powi(4), 0.25, 1e-9);
    // A retract leaves no bead
    let none = beads(&stations[..2], &[-1e-9], &slam());
    assert!(none[0].hot_m == 0.0 && none[0].draw_ratio.is_infinite());
    // Half-way in time is half-way along
    close(arc_at_m(&stations, 2.5), 0.015, 1e-12);
    assert!(arc_at_m(&stations, -1.0) == 0.0 && arc_at_m(&stations, 9.0) == 0.02);
    assert!(arc_at_m(&[], 1.0) == 0.0);
}

#[test]
fn draw_limits() {
    let (low, high) = flow_limits_m3_s(0.005, &slam(), 0.9, 3.0);
    close(draw_ratio(low, 0.005, 0.0012, 1.058), 3.0, 1e-12);
    close(draw_ratio(high, 0.005, 0.0012, 1.058), 0.9, 1e-12);
    for (ratio, want) in [
        (0.899, Draw::Overfed),
        (0.9, Draw::Within),
        (3.0, Draw::Within),
        (3.01, Draw::Thinned),
        (f64::NAN, Draw::Thinned),
    ] {
        assert_eq!(judge_draw(ratio, 0.9, 3.0), want);
    }
}

#[test]
fn sewing_onset() {
    // Onset at v/v_free = 1 ± 15 %: the free speed itself stands in the doubt, the sides are clear
    for (factor, want) in [
        (0.84, Folding::Folds),
        (0.86, Folding::MayFold),
        (1.0, Folding::MayFold),
        (1.14, Folding::MayFold),
        (1.16, Folding::Straight),
    ] {
        let free = super::bead::free_speed_m_s(6.33e-9, 0.0012, 1.058);
        let ratio = draw_ratio(6.33e-9, factor * free, 0.0012, 1.058);
        assert_eq!(folding(ratio, 1.0, 0.15), want);
    }
    // Mass: the thread that folds holds the volume of the mean strand
    let fed = overfeed(0.8, 0.0014, 0.1);
    close(fed.strain, 0.25, 1e-12);
    close(fed.excess_m, 0.025, 1e-12);
    close(fed.thread_m.powi(2) * (0.1 + fed.excess_m), 0.0014_f64.powi(2) * 0.1, 1e-12);
    let drawn = overfeed(2.0, 0.0014, 0.1);
    assert!(drawn.excess_m == 0.0 && drawn.thread_m == 0.0014);
    // At onset a meander is as long as a coil's circumference: v = R Ω
    close(onset_wavelength_m(0.003, 0.003 / 0.001), 2.0 * PI * 0.001, 1e-12);
}

/// Length of a sine over its wavelength, less one, by many chords.
fn chorded_excess(amplitude: f64) -> f64 {
    let count = 100_000;
    let point = |i: i32| {
        let x = f64::from(i) / f64::from(count);
        (x, amplitude * (2.0 * PI * x).sin())
    };
    (0..count)
        .map(|i| (point(i), point(i + 1)))
        .map(|(one, other)| (other.0 - one.0).hypot(other.1 - one.1))
        .sum::<f64>()
        - 1.0
}

#[test]
fn amplitude_holds_the_excess() {
    for strain in [0.01, 0.1, 0.25, 0.5, 2.0] {
        let amplitude = sine_amplitude_m(strain, 1.0);
        close(chorded_excess(amplitude), strain, 1e-8);
        assert!(amplitude < farthest_m(strain, 1.0));
        close(sine_amplitude_m(strain, 0.004), 0.004 * amplitude, 1e-12);
    }
    // a → (λ/π) √e
    close(sine_amplitude_m(1e-8, 1.0), 1e-4 / PI, 1e-7);
    assert!(sine_amplitude_m(0.0, 1.0) == 0.0 && sine_amplitude_m(f64::NAN, 1.0) == 0.0);
    assert!(sine_amplitude_m(f64::INFINITY, 1.0).is_infinite() && farthest_m(-1.0, 1.0) == 0.0);
}

proptest! {
    #[test]
    fn splitting_keeps_the_bead(
        flow in 1e-10..1e-7_f64, lag in 0.0..3.0_f64, speed in 1e-3..2e-2_f64, at in 0.01..0.99_f64,
    ) {
        let out = Feed { lag_s: lag, drive: Drive::Any }.deliver(&Told::new(vec![(-0.5, flow)]));
        let whole = even(speed, 0.05, 1);
        let split: Vec<Station> = [0.0, at, 1.0]
            .map(|share| Station { time_s: share * 0.05 / speed, arc_m: share * 0.05 })
            .to_vec();
        let one = beads(&whole, &out.volumes_m3(&times_s(&whole)), &slam());
        let two = beads(&split, &out.volumes_m3(&times_s(&split)), &slam());
        let volume: f64 = two.iter().map(|bead| bead.volume_m3).sum();
        prop_assert!((volume - one[0].volume_m3).abs() <= 1e-12 * volume);
        let kept: f64 = two.iter().map(|bead| bead.hot_m.powi(2) * bead.length_m).sum();
        prop_assert!((kept - one[0].hot_m.powi(2) * 0.05).abs() <= 1e-11 * kept);
    }

    #[test]
    fn any_bead(
        arc in any::<[f64; 3]>(), volumes in any::<[f64; 2]>(), ratio in any::<f64>(), wave in any::<f64>(),
    ) {
        let stations = arc.map(|arc_m| Station { time_s: arc_m, arc_m });
        prop_assert_eq!(beads(&stations, &volumes, &slam()).len(), 2);
        let _ = arc_at_m(&stations, wave);
        let _ = (folding(ratio, 1.0, 0.15), overfeed(ratio, wave, 1.0), farthest_m(ratio, wave));
        prop_assert!(sine_amplitude_m(ratio, 1.0) >= 0.0);
        prop_assert!(overfeed_strain(ratio) >= 0.0);
        let _ = (narrowing_from_strength(ratio), judge_draw(ratio, 0.9, 3.0));
    }
}
