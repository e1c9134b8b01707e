//! Sag, set strands and gel limits against closed forms.

use std::f64::consts::PI;

use super::tests::{close, within};
use super::{elastica, gel, sag};

/// A beam whose span does not matter.
fn long_beam() -> sag::SoftBeam {
    sag::SoftBeam {
        diameter_m: 0.0015,
        density_kg_m3: 1240.0,
        across_m_s2: 9.81,
        speed_m_s: 0.005,
        span_m: 10.0,
    }
}

pub(super) fn exponential(viscosity: f64, tau: f64, panels: u32) -> sag::Fluidity {
    sag::Fluidity::integrate(
        |age| (-age / tau).exp() / (3.0 * viscosity),
        &[0.0, 33.0 * tau],
        panels,
    )
}

#[test]
fn sag_behind_the_nozzle() {
    let beam = long_beam();
    let (viscosity, until) = (4000.0, 1.2);
    let load = beam.density_kg_m3 * beam.across_m_s2 * PI * beam.diameter_m.powi(2) / 4.0;
    let inertia = sag::inertia_m4(beam.diameter_m);
    let scale = load * (beam.speed_m_s * until).powi(5) / (viscosity * inertia * beam.speed_m_s);
    let constant = sag::Fluidity::constant(viscosity, until);
    close(beam.clamped_sag_m(constant), scale / 2160.0, 1e-9); // VISC-SS-CLAMPED
    close(beam.hinged_sag_m(constant), scale / 360.0, 1e-9); // VISC-SS-HINGED
    close(beam.tip_drop_m(constant), scale / 120.0, 1e-9); // VISC-FREE-EXTRUSION, same form
    let numeric = sag::Fluidity::integrate(|_| 1.0 / (3.0 * viscosity), &[0.0, until], 10);
    close(beam.clamped_sag_m(numeric), scale / 2160.0, 1e-6);
    let pieces = sag::Fluidity::integrate(|_| 1.0 / (3.0 * viscosity), &[0.0, 0.4, until], 10);
    close(beam.clamped_sag_m(pieces), scale / 2160.0, 1e-6);
    // VISC-SS-EXP-CLAMPED, -HINGED, VISC-SS-NUM
    let ageing = exponential(4000.0, 0.5, 10);
    close(beam.clamped_sag_m(ageing), 0.000_140_791_666_666_666_67, 1e-6);
    close(beam.hinged_sag_m(ageing), 0.000_422_375, 1e-6);
    close(1.0 / ageing.moments[0], 3.0 * 4000.0 / 0.5, 1e-6); // EEFF-FROZEN
    // A rigid strand does not sag.
    let rigid = sag::Fluidity { moments: [0.0; 5] };
    assert!(beam.clamped_sag_m(rigid) == 0.0 && beam.hinged_sag_m(rigid) == 0.0);
}

#[test]
fn short_spans_are_bounded() {
    let constant = sag::Fluidity::constant(4000.0, 1.2);
    let zone = 0.005 * 1.2;
    let at = |span_m: f64| sag::SoftBeam { span_m, ..long_beam() };
    // VISC-NOSPAN
    for over in [2.0, 5.0, 10.0] {
        close(at(over * zone).clamped_sag_m(constant), long_beam().clamped_sag_m(constant), 1e-12);
    }
    // Half a zone: the beam clamped at both ends for the whole time, VISC-CATENARY-EARLY.
    let weight = 1240.0 * 9.81;
    let bridge = sag::viscous_bridge_m(weight, zone / 2.0, 1.2, 4000.0, 0.0015);
    close(at(zone / 2.0).clamped_sag_m(constant), bridge, 1e-12);
    // VISC-FREE-AGEING: a cantilever with the frozen modulus, w L⁴ τ / (24 η0 I)
    let set = sag::SetBeam {
        diameter_m: 0.0015,
        density_kg_m3: 1240.0,
        across_m_s2: 9.81,
        youngs_modulus_pa: 3.0 * 4000.0 / 0.5,
    };
    let load_over_inertia = at(1.0).load_over_inertia();
    close(
        set.cantilever_m(0.02),
        load_over_inertia * 0.02_f64.powi(4) * 0.5 / (24.0 * 4000.0),
        1e-12,
    );
}

#[test]
fn quadrature_is_of_tenth_order() {
    // G0 of an exponential is known but for the tail of e^-33.
    let exact = (1.0 - (-33.0_f64).exp()) / 24_000.0;
    let error = |panels| (exponential(4000.0, 0.5, panels).moments[0] / exact - 1.0).abs();
    let orders: Vec<f64> = [3, 4, 5].iter().map(|&n| (error(n) / error(2 * n)).log2()).collect();
    assert!(orders.iter().all(|order| (8.5..13.0).contains(order)), "{orders:?}");
    for (panels, bound) in [(8, 1e-6), (10, 1e-7), (12, 1e-8)] {
        close(
            long_beam().clamped_sag_m(exponential(4000.0, 0.5, panels)),
            0.000_140_791_666_666_666_67,
            bound,
        );
    }
}

#[test]
fn heavy_cantilevers() {
    // ELASTICA-K*: drop, shortening, tip angle
    for (k, drop, shortening, angle) in [
        (0.1, 0.012498, 8.9e-05, 0.016665),
        (1.0, 0.123471, 0.008754, 0.165116),
        (2.0, 0.238507, 0.033107, 0.321594),
        (4.0, 0.425159, 0.109889, 0.588592),
        (8.0, 0.640631, 0.275575, 0.940122),
        (16.0, 0.79702, 0.490005, 1.260253),
        (32.0, 0.878457, 0.671507, 1.46136),
    ] {
        let got = elastica::heavy_elastica(k, 100);
        within(got.drop, drop, 1e-6);
        within(got.shortening, shortening, 1e-6);
        within(got.tip_rad, angle, 1e-6);
    }
    let error = |steps| {
        (elastica::heavy_elastica(8.0, steps).drop - elastica::heavy_elastica(8.0, 1280).drop).abs()
    };
    let orders: Vec<f64> = [40, 80].iter().map(|&n| (error(n) / error(2 * n)).log2()).collect();
    assert!(orders.iter().all(|order| (3.7..4.3).contains(order)), "{orders:?}");
    let drops: Vec<f64> =
        (1..=250).map(|i| elastica::heavy_elastica(0.2 * f64::from(i), 100).drop).collect();
    assert!(drops.windows(2).all(|pair| pair[0] < pair[1]), "{drops:?}");
    // Boundary layer at the clamp: 1 − (2 − √2)/√k
    let plumb = elastica::heavy_elastica(f64::INFINITY, 100).drop;
    within(plumb, 1.0 - (2.0 - 2.0_f64.sqrt()) / 50.0_f64.sqrt(), 0.01);
    let light = sag::SetBeam {
        diameter_m: 0.003,
        density_kg_m3: 1150.0,
        across_m_s2: 9.81,
        youngs_modulus_pa: 1e9,
    };
    close(light.heavy_cantilever_m(0.06), light.cantilever_m(0.06), 1e-12);
}

#[test]
fn stretching_takes_over() {
    // VISC-CATENARY-XOVER 1.299, VISC-CATENARY-STRETCH
    within(sag::LINEAR_LIMIT, 1.299, 5e-4);
    let (diameter, weight, span, viscosity, time) = (0.0015, 12_164.4, 0.1, 4000.0, 30.0);
    let linear = sag::viscous_bridge_m(weight, span, time, viscosity, diameter);
    let want = (3.0 * weight * span.powi(4) * time / (128.0 * viscosity)).cbrt();
    let (got, is_linear) = sag::stretched_sag_m(linear, diameter);
    close(got, want, 1e-12);
    assert!(!is_linear && got < linear);
    let edge = sag::LINEAR_LIMIT * diameter;
    close(sag::stretched_sag_m(edge * 1.000_001, diameter).0, edge, 1e-5);
}

#[test]
fn set_strands() {
    let frame_fab = sag::SetBeam {
        diameter_m: 0.0015,
        density_kg_m3: 1210.0,
        across_m_s2: 9.81,
        youngs_modulus_pa: 3.457e9,
    };
    close(frame_fab.cantilever_m(0.1), 0.000_305_212_612_091_408_8, 1e-9); // EB-CANT-SELFWEIGHT
    let conmech = sag::SetBeam {
        diameter_m: 0.003,
        density_kg_m3: 1250.0,
        across_m_s2: 9.81,
        youngs_modulus_pa: 3.5e9,
    };
    close(conmech.clamped_m(0.15), 8.211_495_535_714_286e-6, 1e-9); // EB-CC-SELFWEIGHT
    close(conmech.simply_supported_m(0.15), 5.0 * conmech.clamped_m(0.15), 1e-12);
    // SMAY-SPAN: E = 3 G, sag 5 % of D, G = (25/18) w s⁴ D
    let shear = 25.0 / 18.0 * 1210.0 * 9.81 * 20.0_f64.powi(4) * 0.001;
    let smay = sag::SetBeam { youngs_modulus_pa: 3.0 * shear, diameter_m: 0.001, ..frame_fab };
    close(smay.simply_supported_m(0.02), 0.05 * 0.001, 1e-9);
    // BRIDGE-BANDS: implied slack (8/3)(sag/L)²
    let strain = 8.0 / 3.0 * (0.5e-3_f64 / 30e-3).powi(2);
    close(sag::slack_sag_m(30e-3, strain), 0.5e-3, 1e-12);
    assert!(sag::slack_sag_m(0.1, -0.01) == 0.0);
    // Just gelled, 3 mm, 60 mm: 32 mm at 1 MPa, 0.65 at 50 MPa, 0.02 at 1.6 GPa (process-physics.md 1.3;
    // its density is not printed, 1150 gives all three)
    for (modulus, want_mm, digit) in [(1e6, 32.0, 0.5), (50e6, 0.65, 0.01), (1.6e9, 0.02, 0.005)] {
        let gel = sag::SetBeam { youngs_modulus_pa: modulus, density_kg_m3: 1150.0, ..conmech };
        within(gel.cantilever_m(0.06) * 1e3, want_mm, digit);
    }
}

#[test]
fn gel_limits() {
    let weight = 1130.0 * 9.81;
    close(gel::hanging_length_m(60.0, weight), 0.009_374_852_142_398_728, 1e-9); // YIELD-HANG
    close(gel::cantilever_length_m(60.0, weight, 0.003), 0.003_454_914_249_839_961, 1e-9); // YIELD-CANT
    close(gel::clamped_span_m(60.0, weight, 0.003), 0.009_771_973_177_919_481, 1e-9); // YIELD-CC
}
