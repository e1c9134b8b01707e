//! Knotted threads against frames of many straight rods, chains of pitches, bounds and limits.

use std::f64::consts::PI;

use nalgebra::{DMatrix, DVector, SMatrix, Vector3};
use proptest::prelude::*;

use super::tests::{close, within};
use super::tests_rods::{POISSON, Twelve, YOUNGS_PA, pitch, rod};
use super::threads::{Knotted, Stiffness};

/// Three threads of 1 mm around a core of 3 mm, knots every 20 mm. Sizes ours: the paper gives none.
fn yu(sweep_m: f64, pitch_m: f64) -> Knotted {
    Knotted { core_m: 0.003, thread_m: 0.001, count: 3, knot_offset_m: 0.002, sweep_m, pitch_m }
}

fn stiffness(strand: &Knotted) -> Stiffness {
    strand.stiffness(YOUNGS_PA, POISSON)
}

/// Twice the energy of a motion of the second knot against the first, both turned half each way or shifted.
fn energy(k: &Twelve, motion: [(usize, f64); 2]) -> f64 {
    let mut u = SMatrix::<f64, 12, 1>::zeros();
    for (at, value) in motion {
        u[at] = value;
    }
    (u.transpose() * k * u)[(0, 0)]
}

/// Axial, torsion, bending and parts of a pitch, as [`Stiffness`] has them; bending and shearing about `y`
/// and `z`.
fn by_frame(strand: &Knotted, count: usize, angle: f64) -> [f64; 6] {
    let (k, p) = (pitch(strand, count, angle), strand.pitch_m);
    let sway = p.powi(3) / 12.0;
    [
        energy(&k, [(6, 1.0), (0, 0.0)]) * p,
        energy(&k, [(9, 1.0), (3, 0.0)]) * p,
        energy(&k, [(4, -0.5), (10, 0.5)]) * p,
        energy(&k, [(5, -0.5), (11, 0.5)]) * p,
        energy(&k, [(7, 1.0), (1, 0.0)]) * sway,
        energy(&k, [(8, 1.0), (2, 0.0)]) * sway,
    ]
}

fn by_law(strand: &Knotted) -> [f64; 6] {
    let law = stiffness(strand);
    [
        law.axial_n,
        law.torsion_n_m2,
        law.bending_n_m2,
        law.bending_n_m2,
        law.parts_n_m2,
        law.parts_n_m2,
    ]
}

#[test]
fn law_against_a_frame_of_rods() {
    // Shallow and steep; straight rods in place of the curve: an error of second order in their number
    for (sweep, pitch_m) in [(0.0003, 0.02), (0.002, 0.02), (0.006, 0.02), (0.01, 0.012)] {
        let strand = yu(sweep, pitch_m);
        let want = by_law(&strand);
        let [coarse, fine] = [24, 48].map(|count| by_frame(&strand, count, 0.3));
        for ((coarse, fine), want) in coarse.iter().zip(fine).zip(want) {
            close(fine + (fine - coarse) / 3.0, want, 2e-5);
            within((coarse - want) / (fine - want), 4.0, 0.2);
        }
    }
}

#[test]
fn rotation_changes_nothing() {
    let strand = yu(0.004, 0.02);
    let whole = by_frame(&strand, 16, 0.0);
    for angle in [0.1, 0.7, 1.9] {
        for (got, want) in by_frame(&strand, 16, angle).iter().zip(whole) {
            close(*got, want, 1e-8);
        }
    }
    // Four and five threads too
    for count in [4, 5] {
        let strand = Knotted { count, ..strand };
        let (got, want) = (by_frame(&strand, 32, 0.2), by_law(&strand));
        assert!(got.iter().zip(want).all(|(got, want)| (got / want - 1.0).abs() < 5e-3));
    }
}

/// Knot deflections of a chain of pitches on pins under a half sine of load, against those of a uniform beam.
fn chained(strand: &Knotted, count: usize) -> f64 {
    let k = pitch(strand, 48, 0.3);
    let uniform = rod(Vector3::zeros(), Vector3::x() * strand.pitch_m, strand.core_m);
    let middle = |k: &Twelve| {
        let mut all = DMatrix::<f64>::zeros(6 * (count + 1), 6 * (count + 1));
        for cell in 0..count {
            let mut block = all.view_mut((6 * cell, 6 * cell), (12, 12));
            block += k;
        }
        let held = (0..6).filter(|at| *at != 4 && *at != 5).chain([6 * count + 1, 6 * count + 2]);
        for at in held {
            all[(at, at)] *= 1e12;
        }
        let mut load = DVector::zeros(6 * (count + 1));
        for knot in 1..count {
            load[6 * knot + 1] = (PI * knot as f64 / count as f64).sin();
        }
        all.cholesky().unwrap().solve(&load)[6 * (count / 2) + 1]
    };
    YOUNGS_PA * PI * strand.core_m.powi(4) / 64.0 * middle(&uniform) / middle(&k)
}

#[test]
fn span_against_a_chain_of_pitches() {
    for (sweep, count) in [(0.0, 2), (0.0, 6), (0.002, 4), (0.006, 12)] {
        let strand = yu(sweep, 0.02);
        let want = stiffness(&strand).bending_over_span_n_m2(0.02 * count as f64);
        close(chained(&strand, count), want, 2e-3);
    }
}

#[test]
fn limits() {
    // No sweep: a bundle, bonded whatever the pitch, as axial sum of the parts
    for pitch_m in [0.001, 0.02, 1.0] {
        let (strand, law) = (yu(0.0, pitch_m), stiffness(&yu(0.0, pitch_m)));
        close(law.bending_n_m2, strand.bonded_bending_n_m2(YOUNGS_PA), 1e-9);
        close(law.parts_n_m2, strand.loose_bending_n_m2(YOUNGS_PA), 1e-9);
        close(law.axial_n, YOUNGS_PA * PI / 4.0 * (9e-6 + 3e-6), 1e-9);
        close(law.shear_n, 12.0 * strand.loose_bending_n_m2(YOUNGS_PA) / pitch_m.powi(2), 1e-9);
        // Torsion: own twist, and threads bent around the core, 12 EI r²/p² each
        let (core, thread) = (PI * 0.003_f64.powi(4) / 64.0, PI * 0.001_f64.powi(4) / 64.0);
        let own = (core + 3.0 * thread) / (1.0 + POISSON);
        let around = 36.0 * thread * (0.002 / pitch_m).powi(2);
        close(law.torsion_n_m2, YOUNGS_PA * (own + around), 1e-9);
    }
    // Over a span: a short pitch is bonded, a pitch of the span or more is the parts alone
    let strand = yu(0.0, 0.001);
    close(
        stiffness(&strand).bending_over_span_n_m2(10.0),
        strand.bonded_bending_n_m2(YOUNGS_PA),
        1e-6,
    );
    for pitch_m in [0.2, 0.5, 1e3] {
        let strand = yu(0.0, pitch_m);
        let alone = strand.loose_bending_n_m2(YOUNGS_PA);
        close(stiffness(&strand).bending_over_span_n_m2(0.2), alone, 1e-9);
    }
    // Shallow arch: 1/(1 + 2 (a/d)²) of E A
    let law = stiffness(&yu(0.002, 1.0));
    close(law.axial_n, YOUNGS_PA * PI / 4.0 * (9e-6 + 3e-6 / (1.0 + 2.0 * 4.0)), 1e-4);
    // Stiffest at a sweep of d²/(4 r_k), 0.125 mm here, where shallow
    let bending = |sweep| stiffness(&yu(sweep, 1.0)).bending_n_m2;
    assert!(bending(0.124e-3) < bending(0.125e-3) && bending(0.126e-3) < bending(0.125e-3));
    // No threads: the core
    let core = Knotted { count: 0, ..yu(0.002, 0.02) };
    close(stiffness(&core).bending_over_span_n_m2(0.1), core.loose_bending_n_m2(YOUNGS_PA), 1e-12);
    close(core.volume_per_length_m2(), PI / 4.0 * 9e-6, 1e-12);
    for count in [1, 2] {
        assert!(stiffness(&Knotted { count, ..yu(0.0, 0.02) }).bending_n_m2.is_nan());
    }
}

#[test]
fn thread_length() {
    assert!(yu(0.0, 0.02).thread_length_ratio() - 1.0 < 1e-12);
    // Shallow: 1 + (π a/p)²/4; steep, by chords
    close(yu(1e-4, 0.02).thread_length_ratio() - 1.0, (PI * 1e-4 / 0.02_f64).powi(2) / 4.0, 1e-3);
    let strand = yu(0.01, 0.02);
    let place = |i: u32| {
        let share = f64::from(i) / 1e5;
        (0.02 * share, 0.005 * (1.0 - (2.0 * PI * share).cos()))
    };
    let chords: f64 = (0..100_000)
        .map(|i| (place(i), place(i + 1)))
        .map(|(one, other)| (other.0 - one.0).hypot(other.1 - one.1))
        .sum();
    close(strand.thread_length_ratio(), chords / 0.02, 1e-8);
    close(
        strand.volume_per_length_m2(),
        PI / 4.0 * (9e-6 + 3e-6 * strand.thread_length_ratio()),
        1e-12,
    );
}

proptest! {
    #[test]
    fn between_the_bounds(
        sweep in 0.0..0.01_f64, pitch_m in 0.005..0.1_f64, span in 0.01..1.0_f64, shorter in 0.1..0.99_f64,
    ) {
        let strand = yu(sweep, pitch_m);
        let law = stiffness(&strand);
        let upper = strand.bonded_bending_n_m2(YOUNGS_PA) * (1.0 + 1e-9);
        prop_assert!(law.parts_n_m2 <= law.bending_n_m2 && law.bending_n_m2 <= upper);
        let over = law.bending_over_span_n_m2(span);
        prop_assert!(law.parts_n_m2 * (1.0 - 1e-9) <= over && over <= law.bending_n_m2 * (1.0 + 1e-9));
        // Longer spans are stiffer; straight threads are stiffer and shear less at a shorter pitch
        prop_assert!(law.bending_over_span_n_m2(shorter * span) <= over * (1.0 + 1e-12));
        let (long, short) = (stiffness(&yu(0.0, pitch_m)), stiffness(&yu(0.0, shorter * pitch_m)));
        prop_assert!(short.shear_n > long.shear_n);
        let grown = short.bending_over_span_n_m2(span) / long.bending_over_span_n_m2(span);
        prop_assert!(grown >= 1.0 - 1e-12);
        // Swept threads never pull harder than straight ones
        prop_assert!(law.axial_n <= long.axial_n * (1.0 + 1e-12));
    }

    #[test]
    fn any_strand(sizes in any::<[f64; 5]>(), count in any::<u32>(), poisson in any::<f64>()) {
        let [core_m, thread_m, knot_offset_m, sweep_m, pitch_m] = sizes;
        let strand = Knotted { core_m, thread_m, count, knot_offset_m, sweep_m, pitch_m };
        let law = stiffness(&strand);
        let _ = (law.bending_over_span_n_m2(poisson), strand.volume_per_length_m2());
        let _ = strand.stiffness(YOUNGS_PA, poisson);
        if !(core_m > 0.0 && thread_m > 0.0 && pitch_m > 0.0 && sweep_m >= 0.0) {
            prop_assert!(law.bending_n_m2.is_nan() && law.shear_n.is_nan());
        }
    }
}

#[test]
fn scales() {
    // Twice the size: axial fourfold, bending sixteenfold
    let (one, two) = (yu(0.003, 0.02), yu(0.006, 0.04));
    let two = Knotted { core_m: 0.006, thread_m: 0.002, knot_offset_m: 0.004, ..two };
    close(stiffness(&two).axial_n, 4.0 * stiffness(&one).axial_n, 1e-12);
    close(stiffness(&two).bending_n_m2, 16.0 * stiffness(&one).bending_n_m2, 1e-12);
    close(stiffness(&two).torsion_n_m2, 16.0 * stiffness(&one).torsion_n_m2, 1e-12);
    close(stiffness(&two).shear_n, 4.0 * stiffness(&one).shear_n, 1e-12);
}
