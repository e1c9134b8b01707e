use proptest::prelude::*;

use super::*;
use crate::process::tests::{close, within};

/// Brass at 240 °C, 2 mm face; emissivity ours.
const TIP: HotTip = HotTip { temperature_k: 513.15, radius_m: 0.001, emissivity: 0.6 };

/// ABS strand of 1.27 mm at room temperature: materials/abs.toml; heat transfer of still air, 38 W/(m² K).
const ABS: Neighbour = Neighbour {
    start_k: 295.15,
    glass_k: 378.15,
    diameter_m: 0.00127,
    length_m: 0.05,
    heat_capacity_j_m3k: 1040.0 * 1550.0,
    emissivity: 0.92,
    air_k: 295.15,
    room_h_w_m2k: 38.0,
};

const PASS: Passing = Passing { gap_m: 0.0005, speed_m_s: 0.005, dwell_s: 0.0, way: Way::Along };

fn capacity_j_mk(strand: &Neighbour) -> f64 {
    strand.heat_capacity_j_m3k * PI * strand.diameter_m.powi(2) / 4.0
}

#[test]
fn view_factor_of_a_disc() {
    // On the axis: r²/(r² + g²). At the rim, touching: a half. Far: r² g²/d⁴.
    close(disc_view_factor(0.003, 0.004, 0.0), 9.0 / 25.0, 1e-12);
    close(disc_view_factor(1.0, 0.0, 1.0), 0.5, 1e-12);
    close(disc_view_factor(1.0, 0.0, 0.3), 1.0, 1e-12);
    close(disc_view_factor(0.001, 0.3, 0.4), 1e-6 * 0.09 / 0.0625, 1e-4);
    // Reciprocity: an unbounded plane sees the disc over ∫ F dA = π r².
    let (radius, gap): (f64, f64) = (1.0, 0.7);
    let pieces = 200_000;
    let sum: f64 = (0..pieces)
        .map(|i| {
            // ρ = tan φ takes the plane into a finite range.
            let width = PI / 2.0 / f64::from(pieces);
            let angle = (f64::from(i) + 0.5) * width;
            let offset = angle.tan();
            let slope = 1.0 + offset * offset;
            disc_view_factor(radius, gap, offset) * 2.0 * PI * offset * slope * width
        })
        .sum();
    close(sum, PI, 1e-4);
}

#[test]
fn heat_of_a_quick_pass_is_conduction_and_radiation_counted_apart() {
    // So quick that the strand hardly warms: its heat is the flux into a cold strand, whose radiation is counted the other
    // way round, from each strip of the disc to the whole line (a strip to a line: ½ g²/(g² + u²)^(3/2)).
    let strand = Neighbour { room_h_w_m2k: 0.0, ..ABS };
    for gap_m in [0.0003, 0.001, 0.004] {
        let pass = Passing { gap_m, speed_m_s: 50.0, ..PASS };
        let pieces = 20_000;
        let (r, wide) = (TIP.radius_m, 2.0 * TIP.radius_m / f64::from(pieces));
        let seen_m: f64 = (0..pieces)
            .map(|i| {
                let u = -r + (f64::from(i) + 0.5) * wide;
                let chord = 2.0 * (r * r - u * u).sqrt();
                chord * 0.5 * gap_m * gap_m / (gap_m * gap_m + u * u).powf(1.5) * wide
            })
            .sum();
        let air = air_properties(0.5 * (513.15 + 295.15)).conductivity_w_mk;
        let radiated = 0.6 * 0.92 * 5.670_374e-8 * (513.15_f64.powi(4) - 295.15_f64.powi(4));
        let per_m = 0.00127 * (air / gap_m * 218.0 * 2.0 * r + radiated * seen_m);
        let want_k = per_m / pass.speed_m_s / capacity_j_mk(&strand);
        let got_k = reheat(&TIP, None, &strand, &pass).peak_k - 295.15;
        assert!(want_k < 0.1);
        close(got_k, want_k, 3e-3);
    }
}

/// A tip that gives nothing, and a jet.
const COLD_TIP: HotTip = HotTip { temperature_k: 295.15, radius_m: 1e-9, emissivity: 0.0 };
const JET: WarmJet = WarmJet { temperature_k: 453.15, reach_m: 0.006, h_w_m2k: 150.0 };

#[test]
fn a_warm_jet_alone_is_two_exponentials() {
    let per_m = |h: f64| PI * ABS.diameter_m * h / capacity_j_mk(&ABS);
    let (jet, room) = (per_m(150.0), per_m(38.0));
    for speed_m_s in [0.0005, 0.001, 0.002] {
        let blown_s = 0.012 / speed_m_s;
        let pass = Passing { speed_m_s, ..PASS };
        let got = reheat(&COLD_TIP, Some(&JET), &ABS, &pass);
        let peak_k = 453.15 - 158.0 * (-jet * blown_s).exp();
        close(got.peak_k, peak_k, 1e-8);
        let hot_s = if peak_k > 378.15 {
            let up_s = (158.0_f64 / (453.15 - 378.15)).ln() / jet;
            blown_s - up_s + ((peak_k - 295.15) / 83.0).ln() / room
        } else {
            0.0
        };
        within(got.above_glass_s, hot_s, 1e-6 * hot_s);
        assert_eq!(got.length_m, if hot_s > 0.0 { 0.05 } else { 0.0 });
    }
}

#[test]
fn limits_of_reheating() {
    // Far away: nothing. Standing for ever, no loss: the tip's temperature, never more. Loss: less.
    let far = reheat(&TIP, None, &ABS, &Passing { gap_m: 0.2, speed_m_s: 0.05, ..PASS });
    within(far.peak_k, 295.15, 0.05);
    assert!(far.above_glass_s == 0.0 && far.length_m == 0.0);
    let standing = Passing { dwell_s: 1e5, ..PASS };
    let kept = reheat(&TIP, None, &Neighbour { room_h_w_m2k: 0.0, ..ABS }, &standing);
    close(kept.peak_k, 513.15, 1e-9);
    assert!(kept.above_glass_s.is_infinite());
    let lossy = reheat(&TIP, None, &ABS, &standing);
    assert!(lossy.peak_k < 480.0 && lossy.peak_k > 350.0, "{lossy:?}");
    // Touching: the tip's temperature, in any time.
    let touching = reheat(&TIP, None, &ABS, &Passing { gap_m: 0.0, ..PASS });
    assert!(touching.peak_k > 510.0 && touching.peak_k <= 513.15, "{touching:?}");
    // A strand that starts hot cools by the room, and its peak is its start.
    let warm = Neighbour { start_k: 400.0, ..ABS };
    let left = reheat(&COLD_TIP, None, &warm, &Passing { speed_m_s: 50.0, ..PASS });
    assert!(left.peak_k == 400.0);
    let room = PI * ABS.diameter_m * 38.0 / capacity_j_mk(&ABS);
    close(left.above_glass_s, (104.85_f64 / 83.0).ln() / room, 1e-3);
}

#[test]
fn steps_are_second_order() {
    let pass = Passing { gap_m: 0.0003, speed_m_s: 0.002, ..PASS };
    let scene = Scene::new(&TIP, Some(&JET), &ABS, &pass);
    let exact = scene.section(0.0, 4096).0;
    let errors = [8, 16, 32, 64].map(|steps| (scene.section(0.0, steps).0 - exact).abs());
    for pair in errors.windows(2) {
        let order = (pair[0] / pair[1]).log2();
        assert!((1.6..2.4).contains(&order), "{order} of {errors:?}");
    }
    assert!(errors[1] < 1e-3 * (exact - 295.15), "{errors:?} {exact}");
}

#[test]
fn length_brought_above_the_glass_transition() {
    let pass = Passing { gap_m: 0.0001, speed_m_s: 0.0003, dwell_s: 0.0, way: Way::Across };
    let got = reheat(&TIP, None, &ABS, &pass);
    let scene = Scene::new(&TIP, None, &ABS, &pass);
    // At its ends the peak passes the glass transition; it is no longer than the face plus a little.
    let at = |half_m: f64| scene.section(half_m, STEPS).0;
    assert!(at(0.49 * got.length_m) > 378.15 && at(0.51 * got.length_m) < 378.15, "{got:?}");
    assert!(got.length_m > 0.5 * TIP.radius_m && got.length_m < 2.2 * TIP.radius_m, "{got:?}");
    // A wait over a strand that a pass along it does not soften does so only where it waits.
    let quick = Passing { gap_m: 0.0001, speed_m_s: 0.05, dwell_s: 0.0, way: Way::Along };
    assert_eq!(reheat(&TIP, None, &ABS, &quick).length_m, 0.0);
    let waits = reheat(&TIP, None, &ABS, &Passing { dwell_s: 5.0, ..quick });
    assert!(waits.length_m > TIP.radius_m && waits.length_m < 3.0 * TIP.radius_m, "{waits:?}");
    // Never longer than the strand.
    let short = Neighbour { length_m: 0.0005, ..ABS };
    assert_eq!(reheat(&TIP, None, &short, &Passing { dwell_s: 5.0, ..quick }).length_m, 0.0005);
}

/// At the speeds of printing a bare tip of 4 mm does not soften what it passes at a tenth of a millimetre; a wait does, and a jet
/// that is hot. What the model gives for cold ABS, still air.
#[test]
fn a_passing_tip_warms_and_a_waiting_one_softens() {
    let tip = HotTip { radius_m: 0.002, ..TIP };
    let peak_c = |gap_m: f64, speed_m_s: f64, dwell_s: f64| {
        let pass = Passing { gap_m, speed_m_s, dwell_s, way: Way::Along };
        reheat(&tip, None, &ABS, &pass).peak_k - 273.15
    };
    let glass_c = 105.0;
    within(peak_c(1e-4, 0.002, 0.0), 93.6, 0.5);
    within(peak_c(5e-4, 0.005, 0.0), 29.8, 0.5);
    for gap_m in [1e-4, 2e-4, 5e-4] {
        for speed_m_s in [0.002, 0.005, 0.01] {
            assert!(peak_c(gap_m, speed_m_s, 0.0) < glass_c);
        }
    }
    within(peak_c(1e-4, 0.005, 3.0), 130.9, 0.5);
    within(peak_c(2e-4, 0.005, 10.0), 135.8, 0.5);
    within(peak_c(5e-4, 0.005, 10.0), 84.7, 0.5);
}

proptest! {
    #[test]
    fn no_temperature_leaves_the_range_of_its_sources(
        gap_m in 0.0..0.01f64, speed_m_s in 1e-4..0.1f64, dwell_s in 0.0..20.0f64,
        start_k in 280.0..450.0f64, jet_k in 290.0..500.0f64, h in 0.0..500.0f64,
    ) {
        let strand = Neighbour { start_k, ..ABS };
        let jet = WarmJet { temperature_k: jet_k, h_w_m2k: h, ..JET };
        for way in [Way::Along, Way::Across] {
            let pass = Passing { gap_m, speed_m_s, dwell_s, way };
            let got = reheat(&TIP, Some(&jet), &strand, &pass);
            prop_assert!(got.peak_k >= start_k && got.peak_k <= 513.15 + 1e-9, "{got:?}");
            prop_assert!(got.above_glass_s >= 0.0 && (0.0..=0.05).contains(&got.length_m));
        }
    }

    #[test]
    fn any_input_ends(numbers in prop::array::uniform9(any::<f64>())) {
        let [temperature_k, radius_m, start_k, diameter_m, capacity, gap_m, speed_m_s, dwell_s, h] = numbers;
        let tip = HotTip { temperature_k, radius_m, emissivity: 0.5 };
        let strand = Neighbour {
            start_k, diameter_m, heat_capacity_j_m3k: capacity, room_h_w_m2k: h, length_m: radius_m, ..ABS
        };
        let pass = Passing { gap_m, speed_m_s, dwell_s, way: Way::Across };
        let jet = WarmJet { temperature_k: h, reach_m: gap_m, h_w_m2k: start_k };
        let got = reheat(&tip, Some(&jet), &strand, &pass);
        prop_assert!(!(got.length_m > radius_m.abs()), "{got:?}");
    }
}
