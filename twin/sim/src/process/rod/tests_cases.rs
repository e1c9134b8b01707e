//! Cases of `process_validation_cases.json` by id, from the solver.

use super::super::tests::{close, within};
use super::tests::*;
use super::*;

const VISCOSITY: f64 = 4000.0;
const UNTIL: f64 = 1.2;
const TAU: f64 = 0.5;

/// Compliance of a fluid that is constant up to an age and rigid after.
fn constant(_: usize, age_s: f64) -> f64 {
    age_s.min(UNTIL) / (3.0 * VISCOSITY)
}

/// Compliance of a viscosity that grows by e in every TAU.
fn exponential(_: usize, age_s: f64) -> f64 {
    -TAU * (-age_s / TAU).exp_m1() / (3.0 * VISCOSITY)
}

/// `w x⁵/(η I v)`, m.
fn scale(length_m: f64) -> f64 {
    let e = element(1.0);
    e.line_mass_kg_m * GRAVITY * length_m.powi(5) / (VISCOSITY * e.inertia_m4 * SPEED)
}

/// Greatest offset of a strand of `over` soft zones while it is printed.
fn steady(over: f64, per_zone: f64, printing: Hold) -> RodOutcome {
    let zone = SPEED * UNTIL;
    let elements = level(over * zone, (over * per_zone) as usize);
    printed(&strand(&elements, flowing(&constant, UNTIL), printing, &[until_rigid(printing)]))
}

fn ageing(printing: Hold) -> RodOutcome {
    let elements = level(40.0 * SPEED * TAU, 400);
    let ageing = flowing(&exponential, 33.0 * TAU);
    printed(&strand(&elements, ageing, printing, &[until_rigid(printing)]))
}

#[test]
fn visc_ss_clamped() {
    let out = steady(5.0, 40.0, CLAMPED);
    close(out.sag_printing_m, scale(SPEED * UNTIL) / 2160.0, 0.001);
}

#[test]
fn visc_ss_hinged() {
    // ten soft zones: a hinge feels its span longer than a clamp does (five zones give 0.997)
    let out = steady(10.0, 40.0, TOUCHING);
    close(out.sag_printing_m, scale(SPEED * UNTIL) / 360.0, 0.001);
}

#[test]
fn visc_ss_exp_clamped() {
    close(ageing(CLAMPED).sag_printing_m, scale(SPEED * TAU) / 3.0, 0.0005);
}

#[test]
fn visc_ss_exp_hinged() {
    close(ageing(TOUCHING).sag_printing_m, scale(SPEED * TAU), 0.0005);
}

#[test]
fn visc_ss_num() {
    close(ageing(CLAMPED).sag_nozzle_m, 0.000_140_791_666_666_666_67, 0.0005);
    close(ageing(TOUCHING).sag_nozzle_m, 0.000_422_375, 0.0005);
}

#[test]
fn visc_nospan() {
    for over in [2.0, 5.0, 10.0] {
        let out = steady(over, 40.0, CLAMPED);
        close(out.sag_printing_m, scale(SPEED * UNTIL) / 2160.0, 0.001);
        close(out.sag_nozzle_m, out.sag_printing_m, 1e-9); // stopping adds no greater one
    }
    // the ends stay where they are
    let out = steady(2.0, 40.0, CLAMPED);
    for end in [out.offset_m[0], out.offset_m[80], out.slope[0], out.slope[80]] {
        within(end[0], 0.0, 1e-12);
    }
}

#[test]
fn visc_free_extrusion() {
    let (length_m, never) = (0.02, |_: usize, age_s: f64| age_s / (3.0 * VISCOSITY));
    let elements = level(length_m, 50);
    let held = hold(End::Free, End::Clamped);
    let out = printed(&strand(&elements, flowing(&never, 1e9), held, &[]));
    close(out.tip_drop_m(), scale(length_m) / 120.0, 1e-6);
}

#[test]
fn visc_free_ageing() {
    // forty e-foldings long; while the nozzle is there its end is soft, once it has set it is the limit
    let (length_m, held) = (40.0 * SPEED * TAU, hold(End::Free, End::Clamped));
    let want = scale(length_m) * SPEED * TAU / (24.0 * length_m);
    let elements = level(length_m, 160);
    let after = [until_rigid(held)];
    let out = printed(&strand(&elements, flowing(&exponential, 33.0 * TAU), held, &after));
    close(out.tip_drop_m(), want, 0.001);
    close(out.sag_printing_m, want, 0.12);
    let long = level(10.0 * length_m, 800);
    let out = printed(&strand(&long, flowing(&exponential, 33.0 * TAU), held, &[]));
    close(out.sag_printing_m, 1e4 * want, 0.02);
}

#[test]
fn eeff_frozen() {
    // Under a moment that stays, curvature times inertia over moment.
    let held = hold(End::Free, End::Clamped);
    let elements = level(0.02, 40);
    let after = [until_rigid(held)];
    let table = AgeTable::new(|a| (-a / TAU).exp() / (3.0 * VISCOSITY), 40.0 * TAU, 400);
    close(1.0 / table.frozen_per_pa(), 3.0 * VISCOSITY / TAU, 1e-9);
    let read = |_: usize, age_s: f64| table.compliance_per_pa(age_s);
    let out = printed(&strand(&elements, flowing(&read, table.rigid_s()), held, &after));
    let e = element(1.0);
    let moment = e.line_mass_kg_m * GRAVITY * 0.02_f64.powi(4) / 8.0;
    close(moment / (e.inertia_m4 * out.tip_drop_m()), 3.0 * VISCOSITY / TAU, 1e-6);
}

#[test]
fn visc_catenary_early() {
    // all of it born at once, held at both ends
    let (length_m, time_s) = (0.04, 2.0);
    let never = |_: usize, age_s: f64| age_s / (3.0 * VISCOSITY);
    let elements: Vec<Element> =
        level(length_m, 100).iter().map(|e| Element { printing_s: 1e-9, ..*e }).collect();
    let after = [Phase { hold: CLAMPED, duration_s: time_s }];
    let out = printed(&strand(&elements, flowing(&never, 1e9), CLAMPED, &after));
    let want =
        DENSITY * GRAVITY * length_m.powi(4) * time_s / (72.0 * VISCOSITY * DIAMETER.powi(2));
    close(out.offset_m[50][0], want, 0.0005);
}
