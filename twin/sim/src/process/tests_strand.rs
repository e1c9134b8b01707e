//! A whole strand: trends, limits, the tables of the reference.

use super::history::Corner;
use super::sag::SoftBeam;
use super::soft::{melt_fluidity, melt_fluidity_with};
use super::*;
use crate::interval::Interval;

fn range(nominal: f64, low: f64, high: f64) -> Interval {
    Interval::new(nominal, low, high)
}

/// Thermoplastic from the numbers of materials_reference.json.
fn plastic(numbers: [f64; 9], cte: Interval, cp: Interval, factor: Interval) -> Material {
    let [density, melt, start_c, glass_c, arrest_c, k, modulus, d1, a1] = numbers;
    let exact = Interval::exact;
    Material {
        name: "test".to_owned(),
        density_kg_m3: exact(density),
        youngs_modulus_pa: exact(modulus),
        poisson: exact(0.35),
        strength_pa: exact(45e6),
        bond_fraction: exact(0.56),
        cte_per_k: cte,
        cp_j_kgk: cp,
        k_w_mk: exact(k),
        emissivity: exact(0.92),
        setting: Setting::Thermoplastic(Thermoplastic {
            heat: None,
            tait: None,
            weld: None,
            surface_tension_n_m: None,
            melt_life_s: None,
            extrusion_k: exact(start_c + 273.15),
            melt_density_kg_m3: exact(melt),
            glass_k: exact(glass_c + 273.15),
            flow_arrest_k: exact(arrest_c + 273.15),
            viscosity: CrossWlf { d1_pa_s: d1, t_star_k: 373.15, a1, a2_k: 51.6, factor },
            plateau_modulus_pa: exact(2e6),
        }),
    }
}

fn abs() -> Material {
    plastic(
        [1040.0, 930.0, 240.0, 105.0, 150.0, 0.19, 2.3e9, 9.95e11, 27.322],
        range(8.8e-5, 8e-5, 9.5e-5),
        range(1950.0, 1800.0, 2100.0),
        range(1.0, 0.27, 2.3),
    )
}

pub(super) fn pla() -> Material {
    plastic(
        [1240.0, 1240.0, 210.0, 60.0, 155.0, 0.18, 3.5e9, 3.317_19e9, 20.194],
        range(6.8e-5, 4.1e-5, 8.5e-5),
        range(1800.0, 1700.0, 1900.0),
        range(1.0, 0.5, 2.0),
    )
}

fn carbon() -> Material {
    plastic(
        [1290.0, 1290.0, 215.0, 60.0, 155.0, 0.26, 4.8e9, 2.0 * 3.317_19e9, 20.194],
        range(4.5e-5, 1.5e-5, 6.2e-5),
        range(1650.0, 1400.0, 1850.0),
        range(1.0, 0.5, 2.0),
    )
}

pub(super) fn resin() -> Material {
    let exact = Interval::exact;
    Material {
        density_kg_m3: exact(1200.0),
        youngs_modulus_pa: range(1.6e9, 0.45e9, 2e9),
        setting: Setting::Photopolymer(Photopolymer {
            kinetics: None,
            reaction_heat_j_kg: None,
            exposure_activation_j_mol: None,
            tacky_skin_m: None,
            oxygen: None,
            flow: None,
            surface_tension_n_m: None,
            gel_density_kg_m3: exact(1130.0),
            base_viscosity_pa_s: range(0.3, 0.06, 1.5),
            yield_stress_pa: range(60.0, 15.0, 250.0),
            penetration_m: range(192e-6, 128e-6, 288e-6),
            critical_exposure_j_m2: range(126.0, 63.0, 252.0),
            gel_modulus_pa: exact(1e6),
            cured_modulus_pa: exact(2.8e9),
            linear_shrinkage: range(0.01, 0.005, 0.02),
        }),
        ..pla()
    }
}

pub(super) fn two_part() -> Material {
    let setting = Setting::TwoPart(TwoPart {
        pot_life_s: None,
        activation_j_mol: None,
        reference_k: None,
        set_time_s: range(0.3, 0.3, 1.0),
        viscosity_pa_s: Interval::exact(50.0),
        linear_shrinkage: range(0.01, 0.002, 0.03),
    });
    Material { setting, ..resin() }
}

/// A 1.27 mm strand, 60 mm, 5 mm/s, in a jet of 5 m/s over 30 mm.
pub(super) fn strand() -> StrandInput {
    StrandInput {
        fidelity: Fidelity::ClosedForms,
        length_m: 0.06,
        span_m: 0.06,
        speed_m_s: 0.005,
        flow_m3_s: bead::flow_m3_s(0.00127, 0.005),
        nozzle_diameter_m: 0.0012,
        swell: range(1.058, 1.0, 1.15),
        gravity_across_m_s2: 9.806_65,
        ends: Ends::BothHeld,
        mixer_m3: 0.0,
        dwell_s: 0.0,
        air: Air {
            temperature_k: 295.15,
            room_m_s: 0.1,
            jet: Some(Jet { speed_m_s: range(10.0, 5.0, 20.0), reach_m: 0.03 }),
            blown: None,
        },
        light: None,
    }
}

pub(super) fn ring() -> LightRing {
    LightRing {
        leds: 8,
        distance_m: 0.025,
        angle_rad: std::f64::consts::FRAC_PI_4,
        intensity_w_sr: range(0.129, 0.11, 0.14),
        full_angle_rad: 15.0_f64.to_radians(),
        shadow_m: 0.0005,
        aim_m: 0.002,
    }
}

pub(super) fn gel_strand() -> StrandInput {
    StrandInput {
        speed_m_s: 0.002,
        flow_m3_s: bead::flow_m3_s(0.003, 0.002),
        nozzle_diameter_m: 0.003,
        light: Some(ring()),
        ..strand()
    }
}

/// At constant diameter, so that only speed changes.
fn at_speed(speed_m_s: f64) -> StrandInput {
    StrandInput { speed_m_s, flow_m3_s: bead::flow_m3_s(0.00127, speed_m_s), ..strand() }
}

fn in_jet(air_m_s: f64) -> StrandInput {
    let jet = Some(Jet { speed_m_s: Interval::exact(air_m_s), reach_m: 0.03 });
    StrandInput { air: Air { jet, ..strand().air }, ..strand() }
}

fn is_interval(interval: Interval) -> bool {
    interval.low <= interval.nominal && interval.nominal <= interval.high
}

#[test]
fn sag_table_of_the_reference() {
    // process-physics.md 3.2, clamped..hinged in mm; held to the printed digits; heat transfer given.
    for (material, d_mm, h, v_mm, clamped, hinged) in [
        (pla(), 1.27, 40.0, 2.0, "1.8", "6.5"),
        (pla(), 1.27, 100.0, 2.0, "0.02", "0.09"),
        (pla(), 1.27, 100.0, 5.0, "0.9", "3.4"),
        (pla(), 1.27, 200.0, 5.0, "0.04", "0.15"),
        (pla(), 1.27, 200.0, 10.0, "0.7", "2.5"),
        (pla(), 1.27, 400.0, 10.0, "0.04", "0.16"),
        (pla(), 3.0, 200.0, 2.0, "0.04", "0.13"),
        (pla(), 3.0, 200.0, 5.0, "1.4", "5"),
        (pla(), 3.0, 400.0, 5.0, "0.16", "0.6"),
        (pla(), 3.0, 400.0, 10.0, "2.6", "9"),
        (abs(), 3.0, 400.0, 5.0, "0.09", "0.3"),
        (abs(), 3.0, 400.0, 10.0, "1.5", "5"),
    ] {
        let Setting::Thermoplastic(plastic) = &material.setting else { unreachable!() };
        let diameter_m = d_mm * 1e-3;
        let density_kg_m3 = material.density_kg_m3.nominal;
        let effective = heat::effective_h_w_m2k(h, diameter_m, material.k_w_mk.nominal);
        let cp = material.cp_j_kgk.nominal;
        let rate = heat::cooling_rate_per_s(effective, density_kg_m3, cp, diameter_m);
        let cooling = thermal::Heat::Lumped(heat::Cooling {
            start_k: plastic.extrusion_k.nominal,
            air_k: 295.15,
            jet_rate_per_s: rate,
            jet_until_s: 0.0,
            room_rate_per_s: rate,
        });
        let beam = SoftBeam {
            diameter_m,
            density_kg_m3,
            across_m_s2: 9.81,
            speed_m_s: v_mm * 1e-3,
            span_m: 10.0,
        };
        let fluidity = melt_fluidity(plastic, &cooling);
        let got = [beam.clamped_sag_m(fluidity) * 1e3, beam.hinged_sag_m(fluidity) * 1e3];
        // Fine quadrature agrees to 1e-6.
        let fine = beam.clamped_sag_m(melt_fluidity_with(plastic, &cooling, 400)) * 1e3;
        assert!((got[0] / fine - 1.0).abs() < 1e-6, "{} {fine}", got[0]);
        for (got, printed) in got.into_iter().zip([clamped, hinged]) {
            let decimals = printed.split_once('.').map_or(0, |(_, digits)| digits.len());
            let want: f64 = printed.parse().unwrap();
            let half_digit = 0.5 * 0.1_f64.powi(decimals as i32) * (1.0 + 1e-9);
            assert!((got - want).abs() <= half_digit, "{got} printed as {printed}");
        }
    }
}

#[test]
fn outcomes_are_ordered_intervals() {
    for material in [abs(), pla(), carbon(), resin(), two_part()] {
        for ends in [Ends::BothHeld, Ends::StartHeld, Ends::Resting] {
            let base = if matches!(material.setting, Setting::Photopolymer(_)) {
                gel_strand()
            } else {
                strand()
            };
            let out = simulate(&StrandInput { ends, ..base }, &material);
            for interval in [
                out.bead_diameter_m,
                out.draw_ratio,
                out.set_time_s,
                out.set_distance_m,
                out.sag_nozzle_m,
                out.sag_slack_m,
                out.sag_set_m,
                out.end_miss_m,
                out.area_fraction,
                out.stiffness_fraction,
                out.youngs_modulus_pa,
                out.free_strain,
            ] {
                assert!(is_interval(interval), "{interval:?} in {out:?}");
            }
            assert!(!out.laws.is_empty());
        }
    }
}

#[test]
fn trends() {
    let sag =
        |input: &StrandInput, material: &Material| simulate(input, material).sag_nozzle_m.nominal;
    for material in [abs(), pla()] {
        let faster: Vec<f64> =
            [0.002, 0.003, 0.005, 0.008].iter().map(|&v| sag(&at_speed(v), &material)).collect();
        assert!(faster.windows(2).all(|pair| pair[0] < pair[1]), "{faster:?}");
        let blown: Vec<f64> =
            [0.0, 1.0, 5.0, 20.0].iter().map(|&u| sag(&in_jet(u), &material)).collect();
        assert!(blown.windows(2).all(|pair| pair[0] > pair[1]), "{blown:?}");
        let still = StrandInput { air: Air { jet: None, ..strand().air }, ..strand() };
        assert!(sag(&still, &material) > sag(&strand(), &material));
        let upright = StrandInput { gravity_across_m_s2: 0.0, ..strand() };
        assert!(sag(&upright, &material) == 0.0);
        let tip = StrandInput { ends: Ends::StartHeld, ..strand() };
        assert!(sag(&tip, &material) >= sag(&strand(), &material));
    }
    // ENDPOINT-ORDER
    let end = |material: &Material| {
        simulate(&StrandInput { ends: Ends::StartHeld, ..strand() }, material).end_miss_m.nominal
    };
    assert!(end(&abs()) > end(&pla()) && end(&pla()) > end(&carbon()));
    assert!(simulate(&strand(), &abs()).end_miss_m.nominal == 0.0);
}

#[test]
fn faster_travel_at_fixed_flow_takes_the_slack_out() {
    // PRICCI-TRENDS: at fixed screw speed a faster nozzle sags less, which sag A alone contradicts.
    let total = |speed_m_s: f64| {
        let flow_m3_s = bead::flow_m3_s(0.00127, 0.004);
        let out = simulate(&StrandInput { speed_m_s, flow_m3_s, ..in_jet(20.0) }, &pla());
        (out.sag_nozzle_m.nominal, out.sag_slack_m.nominal)
    };
    let (slow, fast) = (total(0.003), total(0.004));
    assert!(fast.0 > slow.0 && fast.0 + fast.1 < slow.0 + slow.1);
}

#[test]
fn gels_stand_in_the_set_zone() {
    // process-physics.md 1.3: no sag in the set zone above 20 Pa.
    let out = simulate(&gel_strand(), &resin());
    assert!(out.sag_nozzle_m.nominal == 0.0 && out.sag_linear);
    assert!((out.set_distance_m.nominal - (0.0005 + 0.68e-3)).abs() < 1e-5, "{out:?}");
    assert!(out.uncured_core_m.is_some_and(|core| core.nominal > 0.9e-3));
    assert!((out.stiffness_fraction.nominal - 0.80).abs() < 0.02);
    // In the dark it never sets, carries nothing, and nothing panics.
    let dark = simulate(&StrandInput { light: None, ..gel_strand() }, &resin());
    assert!(dark.set_time_s.nominal.is_infinite() && dark.stiffness_fraction.nominal == 0.0);
    assert!(dark.sag_set_m.nominal.is_infinite() && dark.sag_nozzle_m.nominal.is_finite());
    assert!(!dark.sag_linear);
    // DREPP-GRAVITY: without gravity nothing sags, with a longer zone more does.
    let afloat = StrandInput { light: None, gravity_across_m_s2: 0.0, ..gel_strand() };
    assert!(simulate(&afloat, &resin()).sag_nozzle_m.high == 0.0);
}

#[test]
fn history_and_corners() {
    let history = History::new(&strand(), &abs());
    assert!((history.temperature_k(0.0) - 513.15).abs() < 1e-9);
    assert!(history.temperature_k(1.0) > history.temperature_k(3.0));
    assert!(history.modulus_pa(0.0) < 2.1e6 && history.modulus_pa(600.0) > 2.29e9);
    let gel = History::new(&gel_strand(), &resin());
    assert!(gel.modulus_pa(0.1) == 0.0 && gel.modulus_pa(0.7) >= 1e6);
    assert!((gel.modulus_pa(60.0) - 1.6e9).abs() < 1.0);
    let clock = History::new(&strand(), &two_part());
    assert!(clock.modulus_pa(0.2) == 0.0 && clock.modulus_pa(0.4) == 1.6e9);
    let Setting::Thermoplastic(plastic) = &abs().setting.clone() else { unreachable!() };
    let rate = |corner| super::thermal::cooling(&strand(), &abs(), plastic, corner).jet_rate_per_s;
    assert!(
        rate(Corner::Fast) > rate(Corner::Nominal) && rate(Corner::Nominal) > rate(Corner::Slow)
    );
}

#[test]
fn no_input_panics() {
    let odd = [0.0, -1.0, f64::NAN, f64::INFINITY, 1e-300, 1e300];
    for material in [abs(), resin(), two_part()] {
        for value in odd {
            for ends in [Ends::BothHeld, Ends::StartHeld, Ends::Resting] {
                let base = StrandInput { ends, ..gel_strand() };
                let air = Air { temperature_k: value, ..base.air };
                for input in [
                    StrandInput { speed_m_s: value, ..base },
                    StrandInput { flow_m3_s: value, ..base },
                    StrandInput { length_m: value, span_m: value, ..base },
                    StrandInput { gravity_across_m_s2: value, dwell_s: value, ..base },
                    StrandInput { air, ..base },
                ] {
                    let _ = simulate(&input, &material);
                    let history = History::new(&input, &material);
                    let _ = (history.temperature_k(value), history.modulus_pa(value));
                }
            }
        }
    }
}
