//! The table is complete, explained, and says today what it said yesterday.

use slam::Source;

use super::*;

fn material(name: &str, text: &str) -> Material {
    let file = slam::material_file::parse(&Source::new(name, text)).expect("a library file");
    crate::cell::material(&file)
}

/// The cases on the materials of the library and the ring of `kirkman-nozzle`.
fn on_the_library(look: impl FnOnce(&[Case])) {
    let abs = material("abs", include_str!("../../../../materials/abs.toml"));
    let pla = material("pla", include_str!("../../../../materials/pla.toml"));
    let carbon = material("pla-carbon", include_str!("../../../../materials/pla-carbon.toml"));
    let resin = material("resin", include_str!("../../../../materials/sla-resin-silica.toml"));
    let two_part =
        material("two-part", include_str!("../../../../materials/two-part-acrylic.toml"));
    let tool = Source::new("tool", include_str!("../../../../robots/tools/kirkman-nozzle.toml"));
    let tool = slam::tool_file::parse(&tool).expect("a library file");
    let ring = tool.light_ring.expect("the nozzle has lamps");
    let [nominal, one, other] = ring.intensity_w_sr;
    let library = Library {
        abs: &abs,
        pla: &pla,
        pla_carbon: &carbon,
        resin: &resin,
        two_part: &two_part,
        ring: Some(LightRing {
            leds: ring.leds,
            distance_m: ring.distance_mm * 1e-3,
            angle_rad: ring.angle_deg.to_radians(),
            intensity_w_sr: Interval::new(nominal, one, other),
            full_angle_rad: ring.full_angle_deg.to_radians(),
            shadow_m: ring.shadow_mm * 1e-3,
            aim_m: 0.002,
        }),
        deflection_m: 1e-3,
    };
    look(&cases(&library));
}

/// Verdict of every case: a change of a law that moves one must be seen here.
const PINNED: [(&str, &str); 32] = [
    ("SEPPALA-MIGLER", "inside"),
    ("FLOW-STOP-PLA", "inside"),
    ("PRICCI-TRENDS", "inside"),
    ("BRIDGE-BANDS", "outside"),
    ("CURA-WIREPRINT", "outside"),
    ("DREPP-GRAVITY", "inside"),
    ("SAG-TABLE", "inside"),
    ("JETS-2-10", "outside"),
    ("SLAM-EXTRUDER", "inside"),
    ("SWELL-SHAPE", "outside"),
    ("SLPL-NARROWING", "inside"),
    ("SEWING-ONSET", "inside"),
    ("JACOBS-BENNETT", "inside"),
    ("JACOBS-ILS", "inside"),
    ("KIRKMAN-SET", "inside"),
    ("LAARMAN-SET", "inside"),
    ("MASSIVIT-SPEED", "inside"),
    ("COCOONER", "not comparable"),
    ("MERL-SOLAR", "inside"),
    ("LED-15DEG", "inside"),
    ("GREEN-POST", "inside"),
    ("VOL-SHRINK", "outside"),
    ("ENDPOINT-ORDER", "inside"),
    ("SLAM-XY-YIELD", "inside"),
    ("GRID-XY-YIELD", "outside"),
    ("ANISO-TABLE", "outside"),
    ("LAYER-XZ", "outside"),
    ("HEAL-R2", "not comparable"),
    ("DOB-RANGE", "inside"),
    ("YU-BUNNY", "inside"),
    ("MIT-TOOLSPEED", "inside"),
    ("TOL-DEFAULTS", "inside"),
];

#[test]
fn verdicts_are_pinned() {
    on_the_library(|cases| {
        let word = |case: &Case| match case.verdict() {
            Verdict::Inside => "inside",
            Verdict::Outside(_) => "outside",
            Verdict::NotComparable(_) => "not comparable",
        };
        let got: Vec<_> = cases.iter().map(|case| (case.id, word(case))).collect();
        assert_eq!(got, PINNED);
    });
}

/// Outside is explained, check by check; a reason that is no longer needed is taken out.
#[test]
fn reasons_stand_where_they_are_needed() {
    on_the_library(|cases| {
        for case in cases {
            assert!(case.is_explained(), "{}: {:?}", case.id, case.verdict());
            for check in &case.checks {
                let place = format!("{}: {}", case.id, check.what);
                assert_eq!(check.holds() == Some(false), !check.why.is_empty(), "{place}");
                assert!(!check.ours().contains("NaN"), "{place}: {}", check.ours());
            }
        }
    });
}

#[test]
fn exact_cases_are_inside() {
    for case in exact_cases() {
        for check in &case.checks {
            assert_eq!(
                check.holds(),
                Some(true),
                "{}: {} {}",
                case.id,
                check.theirs(),
                check.ours()
            );
        }
        assert_eq!(case.verdict(), Verdict::Inside);
    }
}

/// Every published, paper and practice case of the shared list has a row of its kind, and no other.
#[test]
fn every_case_of_the_list_has_a_row() {
    let shared = std::env::var_os("TWIN_SHARED").map_or_else(
        || std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../shared"),
        std::path::PathBuf::from,
    );
    let path = shared.join("data/process_validation_cases.json");
    let Ok(text) = std::fs::read_to_string(&path) else {
        eprintln!("skipped: {} is not there (set TWIN_SHARED)", path.display());
        return;
    };
    let list: serde_json::Value = serde_json::from_str(&text).expect("JSON");
    let of_kind = |kinds: &[&str]| {
        let mut ids: Vec<(&str, &str)> = list["cases"]
            .as_array()
            .expect("a list")
            .iter()
            .map(|case| (case["id"].as_str().unwrap_or(""), case["kind"].as_str().unwrap_or("")))
            .filter(|(_, kind)| kinds.contains(kind))
            .collect();
        ids.sort_unstable();
        ids
    };
    let name = |kind| match kind {
        Kind::Published => "measured_published",
        Kind::Paper => "seed",
        Kind::Practice => "practice_default",
        Kind::Reference => "",
        Kind::Exact => "exact",
    };
    on_the_library(|cases| {
        let mut ours: Vec<_> = cases
            .iter()
            .filter(|case| case.kind != Kind::Reference)
            .map(|case| (case.id, name(case.kind)))
            .collect();
        ours.sort_unstable();
        assert_eq!(ours, of_kind(&["measured_published", "seed", "practice_default"]));
    });
    let exact = of_kind(&["exact"]);
    for case in exact_cases() {
        assert!(exact.contains(&(case.id, "exact")), "{} is not in the list", case.id);
    }
}

/// A material of another kind is not inside anything, and nothing explains it.
#[test]
fn the_wrong_material_is_not_explained_away() {
    let pla = material("pla", include_str!("../../../../materials/pla.toml"));
    let library = Library {
        abs: &pla,
        pla: &pla,
        pla_carbon: &pla,
        resin: &pla,
        two_part: &pla,
        ring: None,
        deflection_m: 1e-3,
    };
    let cases = cases(&library);
    let of = |id: &str| cases.iter().find(|case| case.id == id).map(Case::verdict);
    for id in ["KIRKMAN-SET", "LAARMAN-SET", "MERL-SOLAR", "GREEN-POST", "ENDPOINT-ORDER"] {
        assert_eq!(of(id), Some(Verdict::Outside(String::new())), "{id}");
    }
}

#[test]
fn numbers_have_three_digits() {
    let told = [0.0, 1.0, 0.061_54, 12.345, 147.2, 2495.1, -2.608, 1.0e-9];
    let wanted = ["0", "1", "0.0615", "12.3", "147", "2495", "-2.61", "0.000000001"];
    assert_eq!(told.map(number), wanted);
}
