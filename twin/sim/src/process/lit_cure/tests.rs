//! Cure of a place with heat and oxygen, against the same without.

use super::*;
use crate::interval::Interval;
use crate::pose::Vector;
use crate::process::cure::shell_area_fraction;
use crate::process::lamp::{Lobe, RingPlace};
use crate::process::lights::{ALWAYS, Carrier, LampSet, Lights};
use crate::process::lit::{Exposure, Lit, shine};
use crate::process::material::OxygenLaw;
use crate::process::tests::{close, within};
use crate::process::tests_course::{DOWN, straight};
use crate::process::tests_strand::{resin as material, ring};
use crate::process::{Material, Setting};

fn range(nominal: f64, low: f64, high: f64) -> Interval {
    Interval::new(nominal, low, high)
}

const LAW: KineticsLaw = KineticsLaw {
    m: 0.7,
    n: 1.5,
    b: 0.6,
    k2_over_k1: 0.0,
    measured_at_w_m2: None,
    gel: 0.15,
    max: 0.8,
};

/// Numbers of materials/sla-resin-silica.toml.
fn library() -> (Material, Photopolymer) {
    let base = material();
    let Setting::Photopolymer(resin) = base.setting.clone() else { panic!("a resin") };
    let resin = Photopolymer {
        kinetics: Some(LAW),
        reaction_heat_j_kg: Some(range(330e3, 200e3, 480e3)),
        exposure_activation_j_mol: Some(range(30e3, 15e3, 50e3)),
        tacky_skin_m: Some(range(30e-6, 10e-6, 50e-6)),
        penetration_m: range(3e-4, 5e-5, 5.7e-4),
        critical_exposure_j_m2: range(100.0, 20.0, 240.0),
        ..resin
    };
    let base = Material {
        cp_j_kgk: range(1800.0, 1500.0, 2000.0),
        k_w_mk: range(0.19, 0.15, 0.25),
        emissivity: range(0.93, 0.88, 0.97),
        setting: Setting::Photopolymer(resin.clone()),
        ..base
    };
    (base, resin)
}

const STILL: Air = Air { temperature_k: 295.15, room_m_s: 0.0, jet: None, blown: None };
const WHOLE: Pass = Pass { from_s: 0.25, lit_s: 4.5, irradiance_w_m2: 370.0 };

fn place<'a>(material: &'a Material, air: &'a Air) -> Place<'a> {
    Place {
        radius_m: 1.5e-3,
        temperature_k: air.temperature_k,
        whole: WHOLE,
        twice: None,
        warmth: Some(Warmth { material, air, speed_m_s: 0.002 }),
    }
}

#[test]
fn heat_makes_it_gel_sooner_and_nothing_is_guessed_without() {
    let (material, resin) = library();
    for radius_m in [0.75e-3, 1.5e-3] {
        let place = Place { radius_m, ..place(&material, &STILL) };
        let cold = Place { warmth: None, ..place };
        for corner in [Corner::Nominal, Corner::Fast, Corner::Slow] {
            let (warm, cold) =
                (curing(LAW, &resin, &place, corner), curing(LAW, &resin, &cold, corner));
            println!(
                "R {radius_m} {corner:?}: warmest {:?} sooner {} gel {} / {} cure {} / {}",
                warm.warmest_k,
                warm.sooner,
                warm.cure.gel_age_s,
                cold.cure.gel_age_s,
                warm.cure.at(10.0),
                cold.cure.at(10.0)
            );
            assert!(warm.warmest_k.is_some_and(|kelvin| kelvin > 300.0 && kelvin < 600.0));
            assert!(warm.sooner < 1.0 && warm.sooner > 0.2);
            assert!(
                warm.cure.gel_age_s < cold.cure.gel_age_s
                    && warm.cure.at(10.0) > cold.cure.at(10.0)
            );
            assert_eq!((cold.warmest_k, cold.sooner), (None, 1.0));
            close(warm.sooner, (warm.cure.gel_age_s - 0.25) / (cold.cure.gel_age_s - 0.25), 1e-6);
        }
        let nothing = Photopolymer { reaction_heat_j_kg: None, ..resin.clone() };
        let unknown = curing(LAW, &nothing, &place, Corner::Nominal);
        assert_eq!(unknown, curing(LAW, &resin, &cold, Corner::Nominal));
    }
    // a jet keeps it cooler
    let jet = Some(crate::process::Jet { speed_m_s: Interval::exact(20.0), reach_m: 0.03 });
    let blown = Air { jet, ..STILL };
    let kelvin = |air| curing(LAW, &resin, &place(&material, air), Corner::Nominal).warmest_k;
    assert!(kelvin(&blown) < kelvin(&STILL));
}

#[test]
fn oxygen_that_came_back_eats_the_first_of_the_second_light() {
    let (material, resin) = library();
    let first = Pass { lit_s: 0.4, ..WHOLE };
    let second = Pass { from_s: 60.0, lit_s: 0.4, ..WHOLE };
    let twice = Some([first, second]);
    let place = Place {
        whole: Pass { lit_s: 0.8, ..WHOLE },
        twice,
        warmth: None,
        ..place(&material, &STILL)
    };
    let law = OxygenLaw {
        dissolved_mol_m3: 1.5,
        diffusivity_m2_s: 1.08e-10,
        quantum_yield: 0.6,
        wavelength_m: 405e-9,
    };
    let airy =
        Photopolymer { oxygen: Some(law), penetration_m: Interval::exact(53e-6), ..resin.clone() };
    let of = |resin: &Photopolymer| curing(LAW, resin, &place, Corner::Nominal).cure;
    let (without, with) = (of(&resin), of(&airy));
    // 39 J/m² at 370 W/m² are 0.106 s of the second 0.4 s; the first owes nothing.
    let lit_s = 0.8 - 39.1 / 370.0;
    let shorter = Place { whole: Pass { lit_s, ..WHOLE }, twice: None, ..place };
    let want = curing(LAW, &resin, &shorter, Corner::Nominal).cure.at(100.0);
    within(with.at(100.0), want, 2e-4);
    assert!(with.at(100.0) < without.at(100.0));
    close(with.gel_age_s, without.gel_age_s, 1e-9);
    // a skin of unknown thickness owes nothing that could be told
    let skinless = Photopolymer { tacky_skin_m: None, ..airy };
    assert_eq!(of(&skinless), without);
}

/// Light of the ring of the reference on a strand that goes straight up.
fn shone(radius_m: f64, speed_m_s: f64, resin: &Photopolymer, warmth: Option<Warmth>) -> Lit {
    let course = straight(0.06, speed_m_s, DOWN, Vector::z());
    let ring = ring();
    let exposure = Exposure {
        lights: &|corner: Corner| {
            let place = RingPlace::of(&ring, ring.aim_m);
            let peak_w_sr = corner.helpful(ring.intensity_w_sr);
            let lamps = place.lamps(peak_w_sr, ring.full_angle_rad, Lobe::Gaussian);
            let set = LampSet { carrier: Carrier::Tool, lamps, on_s: vec![ALWAYS] };
            Lights { sets: vec![set], shades: Vec::new() }
        },
        radius_m,
        length_m: 0.06,
        second_pass_m_s: None,
        post_cure_j_m2: None,
        resting: false,
        temperature_k: STILL.temperature_k,
        warmth,
    };
    shine(&course, resin, &exposure)
}

#[test]
fn a_lit_strand_gels_sooner_by_its_heat_and_carries_less_by_its_skin() {
    let (material, resin) = library();
    let before = Photopolymer { tacky_skin_m: None, reaction_heat_j_kg: None, ..resin.clone() };
    for (radius_m, speed_m_s) in [(0.75e-3, 2e-3), (1.5e-3, 2e-3), (1.5e-3, 5e-3)] {
        let warmth = Some(Warmth { material: &material, air: &STILL, speed_m_s });
        let (cold, warm) = (
            shone(radius_m, speed_m_s, &before, warmth),
            shone(radius_m, speed_m_s, &resin, warmth),
        );
        println!("R {radius_m} v {speed_m_s}");
        println!("  dose {:?}", cold.dose_j_m2[cold.dose_j_m2.len() / 2]);
        println!("  gel {:?} -> {:?}", cold.median_gel_s(), warm.median_gel_s());
        println!("  warmest {:?}", warm.warmest_k);
        println!("  area {:?} -> {:?}", cold.area_fraction, warm.area_fraction);
        println!("  stiffness {:?} -> {:?}", cold.stiffness_fraction, warm.stiffness_fraction);
        let degree = |lit: &Lit| lit.cure.as_ref().map(|cure| (cure.gel_age_s, cure.at(3600.0)));
        println!("  cure {:?} -> {:?}", degree(&cold), degree(&warm));
        // Nothing of it moves where the material does not tell, be the air known or not.
        assert_eq!(cold, shone(radius_m, speed_m_s, &before, None));
        assert_eq!(cold.warmest_k, None);
        assert_eq!((&cold.dose_j_m2, &cold.depth_m), (&warm.dose_j_m2, &warm.depth_m));
        let (sooner, later) = (warm.median_gel_s(), cold.median_gel_s());
        assert!(sooner.nominal < later.nominal && sooner.nominal > 0.5 * later.nominal);
        let skin = shell_area_fraction(30e-6, radius_m);
        close(cold.area_fraction.nominal - warm.area_fraction.nominal, skin, 0.02);
        let (warmest, degree) =
            (warm.warmest_k.expect("told"), warm.cure.expect("told").at(3600.0));
        assert!(warmest.low > STILL.temperature_k && warmest.high > warmest.nominal);
        assert!(degree > cold.cure.expect("told").at(3600.0));
    }
}
