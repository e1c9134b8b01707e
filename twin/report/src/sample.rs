//! A small report made by hand.

use crate::frame::{Landing, LoadCase, Stage, Yield, YieldCriterion};
use crate::parts::{
    Assumption, Finding, Input, Phase, Provenance, Report, Scores, Severity, Site, StepTime,
    Timing, Totals, Verdict,
};
use crate::program::{Cycle, Payload, Share};
use crate::results::{
    Ageing, Coverage, Ends, Motion, Nearest, Range, Strand, StrandMotion, WorstAt,
};

fn range(nominal: f64, low: f64, high: f64) -> Range {
    let number = crate::fill::number;
    Range { value: number(nominal), low: number(low), high: number(high) }
}

/// A strand of which little is special.
pub(crate) fn strand(id: &str, sag_m: f64) -> Strand {
    Strand {
        id: id.to_owned(),
        line: Some(12),
        start_s: Some(10.0),
        end_s: Some(22.0),
        length_m: Some(0.06),
        speed_m_s: Some(0.005),
        flow_m3_s: Some(3.53e-8),
        ends: Ends::BothHeld,
        span_m: Some(0.06),
        bead_m: range(0.003, 0.0029, 0.0031),
        draw_ratio: range(1.0, 0.9, 1.1),
        set_time_s: range(4.0, 3.0, f64::INFINITY),
        set_distance_m: range(0.02, 0.015, f64::INFINITY),
        sag_nozzle_m: range(sag_m, 0.5 * sag_m, 3.0 * sag_m),
        sag_linear: true,
        sag_slack_m: range(0.0, 0.0, 0.0),
        sag_set_m: range(2e-5, 1e-5, 4e-5),
        end_miss_m: range(0.0, 0.0, 1e-4),
        shortening_m: range(1e-4, 5e-5, 2e-4),
        cured_depth_m: None,
        bond: None,
        reheated: None,
        bead_share: Some([0.98, 1.01]),
        blobs_m: [Some(0.0), Some(0.0), Some(0.0)],
        ageing: Ageing {
            age_s: vec![0.0, 1.0],
            temperature_k: vec![Some(513.0), Some(460.0)],
            core_k: vec![Some(513.0), Some(470.0)],
            cure: Vec::new(),
            modulus_pa: vec![Some(1e6), Some(1e6)],
        },
        centreline_m: vec![[0.0, 0.0, 0.0], [0.06, 0.0, 0.0]],
        uncured_core_m: None,
        warmest_k: None,
        area_fraction: range(1.0, 1.0, 1.0),
        stiffness_fraction: range(1.0, 1.0, 1.0),
        free_strain: range(0.007, 0.006, 0.008),
        laws: vec!["mass balance".to_owned()],
        motion: Some(StrandMotion {
            joint_speed_share: Some(0.05),
            joint_margin_rad: Some(0.4),
            condition_number: Some(9.0),
            deviation_m: Some(0.0),
            deviation_linear_m: Some(0.0),
            deviation_joint_m: Some(2e-5),
            wrist_rad: Some(0.6),
            elbow_rad: Some(0.9),
            shoulder_m: Some(0.5),
            worst_at: WorstAt {
                joint_speed_m: 0.01,
                joint_speed: Some("joint_a6".to_owned()),
                joint_margin_m: 0.0,
                joint_margin: Some("joint_a5".to_owned()),
                condition_m: 0.02,
                wrist_m: 0.02,
                elbow_m: 0.0,
                shoulder_m: 0.0,
            },
        }),
        tcp_speed: None,
        error_budget: None,
    }
}

/// The nozzle too near a strand.
pub(crate) fn too_near() -> Finding {
    Finding {
        code: "C201".to_owned(),
        severity: Severity::Error,
        title: "nozzle too near printed strands".to_owned(),
        message: "nozzle comes within 0.31 mm of s3 in the print of strand `s7`".to_owned(),
        hint: "print `s3` after this strand, tilt the nozzle away, or move one of them by 0.7 mm"
            .to_owned(),
        site: Site {
            strand: Some("s7".to_owned()),
            at_m: Some(0.0125),
            phase: Some(Phase::Print),
            bodies: vec!["nozzle".to_owned(), "s3".to_owned()],
            ..Site::default()
        },
        line: Some(12),
        time_s: Some(83.4),
        measured: Some(0.00031),
        low: Some(-0.00019),
        high: Some(0.00081),
        limit: Some(0.001),
        unit: "m".to_owned(),
        count: 12,
        allowed: None,
    }
}

/// A joint near its stop, as a warning.
pub(crate) fn near_stop() -> Finding {
    Finding {
        code: "R102".to_owned(),
        severity: Severity::Warning,
        title: "too near a joint limit".to_owned(),
        message: "joint a4 is 2.0° from its stop on strand `s7` at 4.0 mm".to_owned(),
        hint: "turn the spin".to_owned(),
        site: Site { strand: Some("s7".to_owned()), ..Site::default() },
        line: Some(12),
        time_s: None,
        measured: Some(2.0_f64.to_radians()),
        low: Some(2.0_f64.to_radians()),
        high: Some(2.0_f64.to_radians()),
        limit: Some(3.0_f64.to_radians()),
        unit: "rad".to_owned(),
        count: 1,
        allowed: None,
    }
}

/// A report with one of everything.
pub(crate) fn report() -> Report {
    Report {
        schema: crate::SCHEMA.to_owned(),
        name: "tower".to_owned(),
        verdict: Verdict::Infeasible,
        score: Some(0.0),
        scores: Scores {
            reach: Some(80.2),
            clearance: Some(0.0),
            process: Some(55.0),
            structure: Some(90.0),
            program: None,
        },
        findings: vec![too_near(), near_stop()],
        strands: vec![strand("s3", 2e-4), strand("s7", 4.2e-4)],
        stages: vec![Stage {
            strand: Some("s7".to_owned()),
            printed: 2,
            released: None,
            one_shot_m: Some(1.2e-4),
            one_shot_node: Some(3),
            staged_m: Some(8e-5),
            staged_node: Some(3),
            states_m: [Some(8e-5), Some(4e-4), None],
            buckling_factor: Some(45.0),
            followed_factor: None,
            member_utilisation: Some(0.02),
            member: Some(2),
            node_utilisation: Some(0.05),
            node: Some(3),
            shaken_m: None,
            residual: Some(1e-12),
            hold: Some(0.3),
            released_m: None,
        }],
        landings: vec![Landing {
            strand: "s7".to_owned(),
            at_end: true,
            node: 3,
            frame_m: Some([0.0, 0.0, -8e-5]),
            shrinkage_m: Some([0.0; 3]),
            sag_m: Some([0.0, 0.0, -1e-5]),
            weight_m: Some([0.0; 3]),
            push_m: Some([0.0, 0.0, -3e-4]),
            push_length_m: range(3e-4, 1e-4, 9e-4),
            sum_m: Some(3.9e-4),
            accuracy_m: Some(5e-4),
            remedies: Vec::new(),
        }],
        motion: Motion {
            total_s: Some(3723.4),
            smallest_clearance: Some(Nearest {
                clearance_m: Some(0.00031),
                resolution_m: Some(1e-4),
                accuracy_m: Some(5e-4),
                phase: Phase::Print,
                strand: Some("s5".to_owned()),
                at_m: Some(0.012),
                point_m: [Some(0.01), Some(0.02), Some(0.03)],
                bodies: ["nozzle".to_owned(), "s3".to_owned()],
                time_s: Some(83.4),
            }),
            ik_coverage: Coverage::Complete,
            cycle: Cycle {
                print_s: Some(3000.0),
                dwell_s: Some(400.0),
                approach_s: Some(200.0),
                transit_s: Some(123.4),
                wait_s: Some(0.0),
            },
            payload: Some(Payload {
                mass_kg: Some(0.9),
                rated_kg: Some(6.0),
                moments: vec![Share { joint: "joint_5".to_owned(), share: Some(0.2) }],
            }),
            hoses: Vec::new(),
            tracking: None,
        },
        loads: vec![LoadCase {
            name: "seat".to_owned(),
            deflection_m: Some(2.4e-3),
            load_n: Some(10.0),
            weight_n: Some(0.0086),
            stiffness_n_m: Some(4200.0),
            yield_per_weight: Some(3700.0),
            first_yield: Some(3.2),
            yields: vec![Yield {
                criterion: YieldCriterion::Fibre,
                factor: Some(3.2),
                expected: range(2.464, 1.65, 3.49),
                strand: Some("s3".to_owned()),
                node: None,
            }],
            plastic_factor: None,
            buckling_factor: Some(8.5),
            followed_factor: None,
            fault: None,
        }],
        totals: Totals {
            time_s: Some(3723.4),
            print_s: Some(3000.0),
            dwell_s: Some(120.0),
            transit_s: Some(603.4),
            length_m: Some(0.12),
            mass_kg: Some(0.00088),
        },
        assumptions: vec![Assumption { about: "motion".to_owned(), text: "no ramps.".to_owned() }],
        provenance: Provenance::new(
            vec![Input {
                what: "job".to_owned(),
                name: "job.slam".to_owned(),
                sha256: "00".repeat(32),
            }],
            Some("rays".to_owned()),
        ),
        timing: Timing {
            steps: vec![StepTime { step: "sampling strands".to_owned(), time_s: 0.01 }],
            total_s: 0.01,
        },
    }
}
