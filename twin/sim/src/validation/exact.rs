//! Closed forms and converged numbers, those that one call settles.
//!
//! The tests of `process` hold all of them, each by its id; what stands here is what can be shown without them.

use super::{Case, Check, Kind, exact_heat};
use crate::interval::Interval;
use crate::process::bead::drawn_diameter_m;
use crate::process::cure::{
    critical_exposure_at, cure_depth_m, shell_area_fraction, shell_stiffness_fraction,
};
use crate::process::elastica::heavy_elastica;
use crate::process::gel::{cantilever_length_m, clamped_span_m, hanging_length_m};
use crate::process::sag::{
    Fluidity, LINEAR_LIMIT, SetBeam, SoftBeam, stretched_sag_m, viscous_bridge_m,
};

pub(super) fn cases() -> Vec<Case> {
    let mut cases = beams();
    cases.extend(elasticas());
    cases.extend(viscous());
    cases.extend(gels());
    cases.extend(exact_heat::cases());
    cases.extend(cures());
    cases
}

/// A case of numbers: what, theirs, ours; all within a relative tolerance.
pub(super) fn case(
    id: &'static str,
    title: &'static str,
    relative: f64,
    numbers: &[(&str, f64, f64)],
) -> Case {
    let check = |&(what, theirs, ours): &(&str, f64, f64)| {
        let ends = [theirs * (1.0 - relative), theirs * (1.0 + relative)];
        Check::band(what, "", ends, Interval::exact(ours))
    };
    Case {
        id,
        kind: Kind::Exact,
        title,
        source: "process-physics.md 3.3",
        checks: numbers.iter().map(check).collect(),
        note: String::new(),
    }
}

fn beams() -> Vec<Case> {
    let beam = |diameter_m, density_kg_m3, youngs_modulus_pa| SetBeam {
        diameter_m,
        density_kg_m3,
        across_m_s2: 9.81,
        youngs_modulus_pa,
    };
    let slim = beam(1.5e-3, 1210.0, 3.457e9);
    let stout = beam(3e-3, 1250.0, 3.5e9);
    let unit =
        SetBeam { diameter_m: 1.0, density_kg_m3: 1.0, across_m_s2: 1.0, youngs_modulus_pa: 1.0 };
    vec![
        case(
            "EB-CANT-SELFWEIGHT",
            "cantilever under its weight, m",
            1e-3,
            &[("tip", 3.052_126_120_914_088e-4, slim.cantilever_m(0.1))],
        ),
        case(
            "EB-CC-SELFWEIGHT",
            "strand held at both ends, m",
            1e-3,
            &[("middle", 8.211_495_535_714_286e-6, stout.clamped_m(0.15))],
        ),
        case(
            "EB-CLOSED-FORMS",
            "the three beams, times E D²/(ρ g L⁴)",
            1e-12,
            &[
                ("cantilever", 2.0, unit.cantilever_m(1.0)),
                ("clamped", 1.0 / 24.0, unit.clamped_m(1.0)),
                ("simply supported", 5.0 / 24.0, unit.simply_supported_m(1.0)),
            ],
        ),
    ]
}

/// Id, weight number, then drop, shortening and angle of the tip.
type Heavy = (&'static str, f64, [f64; 3]);
const HEAVY: [Heavy; 7] = [
    ("ELASTICA-K0.1", 0.1, [0.012_498, 8.9e-5, 0.016_665]),
    ("ELASTICA-K1", 1.0, [0.123_471, 0.008_754, 0.165_116]),
    ("ELASTICA-K2", 2.0, [0.238_507, 0.033_107, 0.321_594]),
    ("ELASTICA-K4", 4.0, [0.425_159, 0.109_889, 0.588_592]),
    ("ELASTICA-K8", 8.0, [0.640_631, 0.275_575, 0.940_122]),
    ("ELASTICA-K16", 16.0, [0.797_02, 0.490_005, 1.260_253]),
    ("ELASTICA-K32", 32.0, [0.878_457, 0.671_507, 1.461_36]),
];

fn elasticas() -> Vec<Case> {
    let one = |&(id, weight, theirs): &Heavy| {
        let bent = heavy_elastica(weight, 200);
        let check = |what: &str, theirs: f64, ours: f64| {
            Check::band(what, "", [theirs - 2e-5, theirs + 2e-5], Interval::exact(ours))
        };
        Case {
            checks: vec![
                check("drop over length", theirs[0], bent.drop),
                check("shortening over length", theirs[1], bent.shortening),
                check("angle of the tip, rad", theirs[2], bent.tip_rad),
            ],
            ..case(id, "heavy elastica", 0.0, &[])
        }
    };
    HEAVY.iter().map(one).collect()
}

fn viscous() -> Vec<Case> {
    let beam = SoftBeam {
        diameter_m: 1.5e-3,
        density_kg_m3: 1240.0,
        across_m_s2: 9.81,
        speed_m_s: 0.005,
        span_m: 1e3,
    };
    let unit = beam.load_over_inertia() / beam.speed_m_s;
    let constant = Fluidity::constant(4000.0, 2.0);
    let zone_m = 2.0 * beam.speed_m_s;
    let ageing = Fluidity::integrate(|age_s| (-2.0 * age_s).exp() / 12_000.0, &[0.0, 30.0], 40);
    let bridge = |span_m: f64| viscous_bridge_m(1240.0 * 9.81, span_m, 10.0, 4000.0, 1.5e-3);
    let bent = bridge(0.1);
    let stretched = (3.0 * 1240.0 * 9.81 * 0.1_f64.powi(4) * 10.0 / (128.0 * 4000.0)).cbrt();
    vec![
        case(
            "VISC-SS-CLAMPED",
            "sag behind the nozzle, constant viscosity, clamped, over w ℓ⁵/(ηIv)",
            0.005,
            &[(
                "sag",
                1.0 / 2160.0,
                beam.clamped_sag_m(constant) * 4000.0 / (unit * zone_m.powi(5)),
            )],
        ),
        case(
            "VISC-SS-HINGED",
            "the same, hinged",
            0.005,
            &[("sag", 1.0 / 360.0, beam.hinged_sag_m(constant) * 4000.0 / (unit * zone_m.powi(5)))],
        ),
        case(
            "VISC-SS-NUM",
            "sag behind the nozzle, viscosity that grows by e in 0.5 s, m",
            0.005,
            &[
                ("clamped", 1.407_916_666_666_666_7e-4, beam.clamped_sag_m(ageing)),
                ("hinged", 4.223_75e-4, beam.hinged_sag_m(ageing)),
            ],
        ),
        case(
            "EEFF-FROZEN",
            "modulus frozen into an ageing strand, Pa",
            1e-6,
            &[("3 η0/τ", 24_000.0, 1.0 / ageing.moments[0])],
        ),
        case(
            "VISC-CATENARY-EARLY",
            "hot bridge, bending, over ρ g L⁴ t/(η D²)",
            0.02,
            &[("sag", 1.0 / 72.0, bent * 4000.0 * 1.5e-3 * 1.5e-3 / (1240.0 * 9.81 * 1e-4 * 10.0))],
        ),
        case(
            "VISC-CATENARY-STRETCH",
            "hot bridge, stretching, m",
            0.1,
            &[("sag", stretched, stretched_sag_m(bent, 1.5e-3).0)],
        ),
        case(
            "VISC-CATENARY-XOVER",
            "sag over diameter where stretching takes over",
            0.1,
            &[("crossover", 1.299, LINEAR_LIMIT)],
        ),
    ]
}

fn gels() -> Vec<Case> {
    let weight = 1130.0 * 9.81;
    vec![
        case(
            "YIELD-HANG",
            "gel that hangs, m",
            1e-3,
            &[("length", 9.374_852e-3, hanging_length_m(60.0, weight))],
        ),
        case(
            "YIELD-CANT",
            "gel cantilever, m",
            1e-3,
            &[("length", 3.454_915e-3, cantilever_length_m(60.0, weight, 3e-3))],
        ),
        case(
            "YIELD-CC",
            "gel held at both ends, m",
            1e-3,
            &[("span", 9.771_973e-3, clamped_span_m(60.0, weight, 3e-3))],
        ),
    ]
}

fn cures() -> Vec<Case> {
    vec![
        case(
            "MASS-BALANCE",
            "strand drawn twice as fast, diameter",
            1e-6,
            &[(
                "over that before",
                0.5_f64.sqrt(),
                drawn_diameter_m(1.0, 2.0) / drawn_diameter_m(1.0, 1.0),
            )],
        ),
        case(
            "JACOBS-NUM",
            "depth of cure, mm",
            4e-4,
            &[("depth", 0.231_307_272, cure_depth_m(0.175, 30.0, 8.0))],
        ),
        case(
            "ECT-NUM",
            "critical exposure at 40 °C",
            1e-3,
            &[("exposure", 2.800_287_088, critical_exposure_at(5.0, 3e4, 298.15, 313.15))],
        ),
        case(
            "SHELL-EI",
            "shell of half the radius",
            1e-9,
            &[
                ("stiffness", 0.937_5, shell_stiffness_fraction(0.5, 1.0)),
                ("area", 0.75, shell_area_fraction(0.5, 1.0)),
            ],
        ),
    ]
}
