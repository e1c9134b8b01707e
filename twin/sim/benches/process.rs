//! One strand through the closed forms, the ageing rod of 25 to 200 segments, and the co-rotational rod.

// criterion_group! makes a public function without documentation.
#![allow(missing_docs)]

use std::f64::consts::PI;
use std::hint::black_box;

use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use sim::interval::Interval;
use sim::process::corotational::{HeavyPiece, HeavyRod, Support, hang_fine};
use sim::process::rod::{
    AgeTable, Ageing, Axes, Elastic, Element, End, Fineness, Hold, Phase, Strand, print_strand,
};
use sim::process::{Air, Ends, Jet, Material, StrandInput, simulate};

const DIAMETER: f64 = 0.0015;
const SPEED: f64 = 0.005;
const TAU: f64 = 0.5;

/// ABS of materials_reference.json.
fn abs() -> Material {
    use sim::process::{CrossWlf, Setting};
    let exact = Interval::exact;
    let factor = Interval::new(1.0, 0.27, 2.3);
    let viscosity = CrossWlf { d1_pa_s: 9.95e11, t_star_k: 373.15, a1: 27.322, a2_k: 51.6, factor };
    Material {
        name: "ABS".to_owned(),
        density_kg_m3: exact(1040.0),
        youngs_modulus_pa: exact(2.3e9),
        poisson: exact(0.35),
        strength_pa: exact(45e6),
        bond_fraction: exact(0.56),
        cte_per_k: Interval::new(8.8e-5, 8e-5, 9.5e-5),
        cp_j_kgk: Interval::new(1950.0, 1800.0, 2100.0),
        k_w_mk: exact(0.19),
        emissivity: exact(0.92),
        setting: Setting::Thermoplastic(sim::process::Thermoplastic {
            heat: None,
            tait: None,
            weld: None,
            surface_tension_n_m: None,
            melt_life_s: None,
            extrusion_k: exact(513.15),
            melt_density_kg_m3: exact(930.0),
            glass_k: exact(378.15),
            flow_arrest_k: exact(423.15),
            viscosity,
            plateau_modulus_pa: exact(2e6),
        }),
    }
}

fn closed_forms(criterion: &mut Criterion) {
    let jet = Jet { speed_m_s: Interval::new(10.0, 5.0, 20.0), reach_m: 0.03 };
    let input = StrandInput {
        fidelity: sim::process::Fidelity::ClosedForms,
        length_m: 0.06,
        span_m: 0.06,
        speed_m_s: SPEED,
        flow_m3_s: PI * DIAMETER * DIAMETER / 4.0 * SPEED,
        nozzle_diameter_m: 0.0012,
        swell: Interval::new(1.058, 1.0, 1.1),
        gravity_across_m_s2: 9.81,
        ends: Ends::BothHeld,
        mixer_m3: 0.0,
        dwell_s: 0.0,
        air: Air { temperature_k: 296.15, room_m_s: 0.0, jet: Some(jet), blown: None },
        light: None,
    };
    let material = abs();
    let mut group = criterion.benchmark_group("process");
    group.throughput(Throughput::Elements(1));
    group.bench_function("closed forms of one strand", |bencher| {
        bencher.iter(|| simulate(black_box(&input), black_box(&material)));
    });
    group.finish();
}

/// Segments of 1 mm at 5 mm/s, viscosity growing by e each 2.5 mm; let go at the end.
fn ageing_rod(criterion: &mut Criterion) {
    let table = AgeTable::new(|a| (-a / TAU).exp() / 12_000.0, 33.0 * TAU, 200);
    let compliance = |_: usize, age_s: f64| table.compliance_per_pa(age_s);
    let gravity = |_: f64| [0.0, 0.0, -9.81];
    let axes = Axes::new([1.0, 0.0, 0.0], [0.0, 0.0, -1.0]);
    let element = Element::round(0.001, DIAMETER, SPEED, 1240.0, axes);
    let released = Hold { far: End::Clamped, near: End::Free };
    let after = [Phase { hold: released, duration_s: f64::INFINITY }];
    let mut group = criterion.benchmark_group("ageing rod");
    for count in [25_usize, 50, 100, 200] {
        let elements = vec![element; count];
        let strand = Strand {
            elements: &elements,
            ageing: Ageing {
                compliance_per_pa: &compliance,
                modulus_pa: None,
                elastic: Elastic::Total,
                free_curvature_per_m: None,
                rigid_s: table.rigid_s(),
            },
            gravity_m_s2: &gravity,
            printing: Hold { far: End::Clamped, near: End::Clamped },
            after: &after,
            fineness: Fineness { cuts: 1, steps: 32 },
        };
        group.bench_with_input(BenchmarkId::from_parameter(count), &strand, |bencher, strand| {
            bencher.iter(|| print_strand(black_box(strand)));
        });
    }
    group.finish();
}

fn heavy_rod(criterion: &mut Criterion) {
    let piece =
        HeavyPiece { length_m: 1.0 / 16.0, bending_n_m2: 1.0, axial_n: 1e6, line_mass_kg_m: 8.0 };
    let pieces = [piece; 16];
    let rod = HeavyRod {
        pieces: &pieces,
        from_m: [0.0; 2],
        angle_rad: 0.0,
        ends: [Support::Clamped { at_m: [0.0; 2], angle_rad: 0.0 }, Support::Free],
        gravity_m_s2: [0.0, -1.0],
    };
    criterion.bench_function("co-rotational rod, 16, 32 and 64 elements", |bencher| {
        bencher.iter(|| hang_fine(black_box(&rod), 1));
    });
}

criterion_group!(benches, closed_forms, ageing_rod, heavy_rod);
criterion_main!(benches);
