//! Depth through the radius and the arithmetic of the cure cases.

use std::f64::consts::PI;

use super::cure;
use super::dose::{Run, strand_dose};
use super::tests::{close, within};
use super::tests_dose::{CLEAR, lamps, on_tool, ring, straight};
use super::through::{Inside, Section, irradiance_to_set_w_m2, through_cure_speed_m_s};

#[test]
fn shell_ei() {
    // Even light: the quadrature gives the concentric shell of the depth it finds, in both limits.
    for inside in [Inside::Radial, Inside::Straight] {
        for dose in [200.0, 800.0, 3450.0] {
            let doses = [dose; 16];
            let section = Section {
                radius_m: 1.5e-3,
                penetration_m: 192e-6,
                critical_j_m2: 126.0,
                doses_j_m2: &doses,
                inside,
            };
            let cured = section.cured();
            let depth = cured.least_depth_m;
            let (area, stiffness) = (
                cure::shell_area_fraction(depth, 1.5e-3),
                cure::shell_stiffness_fraction(depth, 1.5e-3),
            );
            within(cured.area_fraction, area, 5e-3);
            within(cured.stiffness_fraction, stiffness, 5e-3);
            if inside == Inside::Radial {
                close(depth, cure::cure_depth_m(192e-6, dose, 126.0), 1e-9);
                close(cured.mean_depth_m, depth, 1e-9);
            }
        }
    }
    close(cure::shell_stiffness_fraction(1.0, 3.0), 1.0 - (2.0_f64 / 3.0).powi(4), 1e-9);
    close(cure::shell_area_fraction(1.0, 3.0), 1.0 - (2.0_f64 / 3.0).powi(2), 1e-9);
}

#[test]
fn beams_through_a_section() {
    let section = |doses| Section {
        radius_m: 1.5e-3,
        penetration_m: 0.56e-3,
        critical_j_m2: 144.7,
        doses_j_m2: doses,
        inside: Inside::Straight,
    };
    // Axis: N H exp(−R/Dp), from the sum and from the point there.
    let doses = [900.0; 8];
    let want = 8.0 * 900.0 * (-1.5_f64 / 0.56).exp();
    close(section(&doses).axis_j_m2(), want, 1e-12);
    close(section(&doses).dose_j_m2(0.0, 1.234), want, 1e-12);
    // One beam: full at its own side, exp(−2R/Dp) behind; a slab of the working curve on the diameter.
    let one = [900.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0];
    close(section(&one).dose_j_m2(1.5e-3, 0.0), 900.0, 1e-9);
    close(section(&one).dose_j_m2(1.5e-3, PI), 900.0 * (-3.0_f64 / 0.56).exp(), 1e-9);
    let depth = cure::cure_depth_m(0.56e-3, 900.0, 144.7);
    close(section(&one).dose_j_m2(1.5e-3 - depth, 0.0), 144.7, 1e-9);
    // What one side cures is soft: less stiffness than its area, no depth on the far side; brute force.
    let cured = section(&one).cured();
    let cells = 800;
    let (mut count, mut x1, mut x2, mut y2) = (0.0, 0.0, 0.0, 0.0);
    for i in 0..cells {
        for j in 0..cells {
            let at = |k: i32| 2.0 * (f64::from(k) + 0.5) / f64::from(cells) - 1.0;
            let (x, y) = (at(i), at(j));
            let r = x.hypot(y);
            if r < 1.0 && section(&one).dose_j_m2(r * 1.5e-3, y.atan2(x)) > 144.7 {
                count += 1.0;
                (x1, x2, y2) = (x1 + x, x2 + x * x, y2 + y * y);
            }
        }
    }
    let cell = (2.0 / f64::from(cells)).powi(2);
    within(cured.area_fraction, count * cell / PI, 0.01);
    let soft = (x2 - x1 * x1 / count).min(y2) * cell / (PI / 4.0);
    within(cured.stiffness_fraction, soft, 0.01);
    assert!(cured.least_depth_m == 0.0);
    // Dark and flooded.
    let dark = section(&[0.0; 9]).cured();
    assert!(dark.area_fraction == 0.0 && dark.stiffness_fraction == 0.0);
    let full = section(&[1e6; 9]).cured();
    within(full.area_fraction, 1.0, 1e-9);
    within(full.least_depth_m, 1.5e-3, 1e-12);
}

#[test]
fn through_cure_table_of_the_reference() {
    // Section 1.1, Formlabs Clear: shell 0.64/0.50/0.33 mm at 1/2/5 mm/s, EI 89/80/63 %, area 67/56/39 %.
    let table = [(1.0, 0.64, 89.0, 67.0), (2.0, 0.50, 80.0, 56.0), (5.0, 0.33, 63.0, 39.0)];
    for (speed, shell, stiffness, area) in table {
        let doses = [3450.0 / speed; 9];
        let section = Section {
            radius_m: 1.5e-3,
            penetration_m: 192e-6,
            critical_j_m2: 126.0,
            doses_j_m2: &doses,
            inside: Inside::Radial,
        };
        let cured = section.cured();
        within(cured.least_depth_m * 1e3, shell, 0.006);
        within(cured.stiffness_fraction * 100.0, stiffness, 0.8);
        within(cured.area_fraction * 100.0, area, 0.8);
        // The same ring by geometry, no shades, whole spot: beams straight on and bent square.
        let lights = on_tool(lamps(ring(40e-3)), vec![]);
        let stations = straight(0.2, 201, speed * 1e-3);
        let run = Run { stations: &stations, dwell_s: 0.0, lights: &lights };
        let dose = &strand_dose(&run, &CLEAR)[60];
        let rays = Section { doses_j_m2: &dose.surface_j_m2, ..section }.cured();
        let beams =
            Section { doses_j_m2: &dose.beam_j_m2, inside: Inside::Straight, ..section }.cured();
        within(rays.least_depth_m * 1e3, shell, 0.03);
        within(beams.mean_depth_m * 1e3, shell, 0.1);
    }
}

#[test]
fn jacobs_num() {
    let doses = [300.0; 9];
    let section = Section {
        radius_m: 1e-3,
        penetration_m: 0.175e-3,
        critical_j_m2: 80.0,
        doses_j_m2: &doses,
        inside: Inside::Radial,
    };
    within(section.cured().least_depth_m * 1e3, 0.231_307_271_996_905_9, 1e-4);
    within(cure::cure_depth_m(0.175, 30.0, 8.0), 0.231_307_271_996_905_9, 1e-12);
}

#[test]
fn ect_num() {
    let got = cure::critical_exposure_at(5.0, 30_000.0, 298.15, 313.15);
    close(got, 2.800_287_087_601_147_6, 1e-3);
}

#[test]
fn massivit_speed() {
    // 300 mm/s set within 10..30 mm, Ec 5..15 mJ/cm²: 50..450 mW/cm² (1 mW/cm² is 10 W/m²).
    close(irradiance_to_set_w_m2(50.0, 0.3, 0.03) / 10.0, 50.0, 1e-12);
    close(irradiance_to_set_w_m2(150.0, 0.3, 0.01) / 10.0, 450.0, 1e-12);
}

#[test]
fn merl_solar() {
    // 3..6 mW/cm² of UVA (from memory) set a resin in 1..10 s: PR48, Formlabs Clear, Tough X, slowest and fastest.
    for critical_mj_cm2 in [6.3, 12.6, 24.2] {
        for irradiance_mw_cm2 in [3.0, 6.0] {
            let gel_s = cure::gel_time_s(critical_mj_cm2 * 10.0, irradiance_mw_cm2 * 10.0);
            assert!((1.0..=10.0).contains(&gel_s), "{gel_s}");
        }
    }
}

#[test]
fn cocooner() {
    // Published: 10 mm/s, 2 mm, four heads; not their irradiance. Read backwards for a resin of Dp 0.56 mm and
    // Ec 14.5 mJ/cm²: each head must give 22 mW/cm² over a centimetre, ordinary for a UV head.
    let speed = |w_m2: f64| through_cure_speed_m_s(4.0, w_m2, 0.01, 1e-3, 0.56e-3, 144.7);
    let needed_w_m2 = 0.01 / speed(1.0);
    within(needed_w_m2 / 10.0, 22.0, 1.0);
    close(speed(needed_w_m2), 0.01, 1e-12);
}

#[test]
fn laarman_set() {
    // 1 mm at 20 cm/min: 0.3 s ± 30 %; the irradiance that gives it for Ec 12.6 mJ/cm² is 42 mW/cm².
    let needed_w_m2 = irradiance_to_set_w_m2(126.0, 0.2 / 60.0, 1e-3);
    within(cure::gel_time_s(126.0, needed_w_m2), 0.3, 0.09);
    within(needed_w_m2 / 10.0, 42.0, 0.1);
}

#[test]
fn a_tacky_skin_is_there_and_carries_nothing() {
    // Even light, a shell of depth d under a skin s: R − d to R − s.
    for (dose, radius_m) in [(400.0, 1.5e-3), (3450.0, 1.5e-3), (800.0, 0.75e-3)] {
        let doses = [dose; 9];
        let section = Section {
            radius_m,
            penetration_m: 300e-6,
            critical_j_m2: 100.0,
            doses_j_m2: &doses,
            inside: Inside::Radial,
        };
        assert_eq!(section.cured_under(0.0), section.cured());
        let (bare, under) = (section.cured(), section.cured_under(30e-6));
        let depth = bare.least_depth_m;
        assert_eq!((under.least_depth_m, under.mean_depth_m), (depth, bare.mean_depth_m));
        close(
            under.area_fraction,
            cure::shell_area_fraction(depth, radius_m) - cure::shell_area_fraction(30e-6, radius_m),
            1e-9,
        );
        close(
            under.stiffness_fraction,
            cure::shell_stiffness_fraction(depth, radius_m)
                - cure::shell_stiffness_fraction(30e-6, radius_m),
            1e-9,
        );
        println!("{radius_m}: {} -> {}", bare.area_fraction, under.area_fraction);
    }
    // a skin as deep as the cure leaves nothing
    let doses = [110.0; 9];
    let thin = Section {
        radius_m: 1.5e-3,
        penetration_m: 300e-6,
        critical_j_m2: 100.0,
        doses_j_m2: &doses,
        inside: Inside::Radial,
    };
    assert_eq!(thin.cured_under(50e-6).area_fraction, 0.0);
    assert!(thin.cured().area_fraction > 0.0);
    // the closed forms of a strand take it off alike
    use super::tests_strand::{gel_strand, resin};
    use super::{Material, Photopolymer, Setting, simulate};
    let Setting::Photopolymer(bare) = resin().setting else { panic!("a resin") };
    let skin_m = crate::interval::Interval::new(30e-6, 10e-6, 50e-6);
    let skinned = Photopolymer { tacky_skin_m: Some(skin_m), ..bare };
    let skinned = Material { setting: Setting::Photopolymer(skinned), ..resin() };
    let (bare, under) = (simulate(&gel_strand(), &resin()), simulate(&gel_strand(), &skinned));
    let radius_m = bare.bead_diameter_m.nominal / 2.0;
    close(
        bare.area_fraction.nominal - under.area_fraction.nominal,
        cure::shell_area_fraction(30e-6, radius_m),
        1e-9,
    );
    assert_eq!(bare.cured_depth_m, under.cured_depth_m);
    assert!(under.stiffness_fraction.low < bare.stiffness_fraction.low);
}
