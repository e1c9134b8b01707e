//! Shrinkage locked in by what holds a frame, and what is left of it when that lets go: closed forms.

use super::one_sided::{balance, stage};
use super::*;
use crate::structure::{Ask, Stage, StageRecord, StageState, solve_stages};

/// Strain of a strand that cooled from where it set.
const SHRUNK: f64 = -0.004;

fn run(frame: &Frame, stages: &[Stage]) -> Vec<StageRecord> {
    let keep: Vec<usize> = (0..stages.len()).collect();
    let records =
        solve_stages(frame, stages, Ask { staged: true, keep: &keep, ..Ask::default() }).unwrap();
    for (stage, record) in stages.iter().zip(&records) {
        let worst = balance(frame, stage, record);
        assert!(worst < 1e-9, "out of balance by {worst:e}");
    }
    records
}

fn staged(record: &StageRecord) -> &StageState {
    record.staged.as_ref().unwrap()
}

fn shrunk(ends: [usize; 2]) -> Member {
    Member { initial_strain: SHRUNK, ..rod(ends) }
}

fn ea(member: &Member) -> f64 {
    member.elastic.e_pa * member.section.area_m2
}

/// Held at both ends a bar pulls on them with `-E A ε`; released at one it is shorter by `-ε L` and
/// carries nothing.
#[test]
fn a_bar_between_two_holds() {
    let along = Vector::new(0.03, -0.02, 0.05);
    let nodes = vec![Point::origin(), Point::from(along)];
    let frame = Frame::new(nodes, vec![shrunk([0, 1])]).unwrap();
    let records =
        run(&frame, &[stage(1, &clamped([0, 1]), [0.0; 3]), stage(1, &clamped([0]), [0.0; 3])]);
    let pulled_n = Vector::from_column_slice(&staged(&records[0]).reactions[1][..3]);
    let wanted = along.normalize() * (-SHRUNK * ea(&frame.members()[0]));
    assert!((pulled_n - wanted).norm() < 1e-12 * wanted.norm());
    let moved = Vector::from_column_slice(&staged(&records[1]).displacement[1][..3]);
    assert!((moved - along * SHRUNK).norm() < 1e-12 * moved.norm());
    let left = staged(&records[1]).reactions[0].iter().fold(0.0f64, |most, r| most.max(r.abs()));
    assert!(left < 1e-10 * wanted.norm(), "{left:e}");
}

/// Two bars end to end between walls, the middle held until both are there; only the first shrinks.
/// Released, `N = -ε L₁/(L₁/EA₁ + L₂/EA₂)` in both.
#[test]
fn two_bars_end_to_end() {
    let nodes = [0.0, 0.03, 0.08].map(|x| Point::new(x, 0.0, 0.0)).to_vec();
    let thick = Member { section: Section::circle(3e-3), ..rod([1, 2]) };
    let frame = Frame::new(nodes, vec![shrunk([0, 1]), thick]).unwrap();
    let held = clamped([0, 1, 2]);
    let stages = [
        stage(1, &held, [0.0; 3]),
        stage(2, &held, [0.0; 3]),
        stage(2, &clamped([0, 2]), [0.0; 3]),
    ];
    let records = run(&frame, &stages);
    let [one, two] = [0, 1].map(|member| ea(&frame.members()[member]));
    near(staged(&records[1]).reactions[1][0], -SHRUNK * one, 1e-12);
    let pull_n = -SHRUNK * 0.03 / (0.03 / one + 0.05 / two);
    near(staged(&records[2]).reactions[0][0], -pull_n, 1e-12);
    near(staged(&records[2]).reactions[1][0], pull_n, 1e-12);
    near(staged(&records[2]).displacement[1][0], -pull_n * 0.05 / two, 1e-12);
}

/// Two strands of one section, one laid along the other `apart_m` away, linked at every station; the
/// upper one shrinks while the lower is held flat, then all but one end lets go.
fn laid_along(link: Section, apart_m: f64, count: usize, pitch_m: f64) -> (Frame, Vec<Stage>) {
    let at = |k: usize, z: f64| Point::new(pitch_m * k as f64, 0.0, z);
    let nodes = (0..=count).map(|k| at(k, 0.0)).chain((0..=count).map(|k| at(k, apart_m)));
    let lower = (0..count).map(|k| rod([k, k + 1]));
    let upper = (0..count).map(|k| shrunk([count + 1 + k, count + 2 + k]));
    let links = (0..=count).map(|k| member([k, count + 1 + k], link, rod([0, 1]).elastic));
    let frame = Frame::new(nodes.collect(), lower.chain(upper).chain(links).collect()).unwrap();
    let (bed, all) = (clamped(0..=count), frame.members().len());
    let stages = vec![
        stage(count, &bed, [0.0; 3]),
        stage(all, &bed, [0.0; 3]),
        stage(all, &clamped([0]), [0.0; 3]),
    ];
    (frame, stages)
}

/// The pair bends when it is let go. With forces ±N in the strands, `e₁ + e₂ = ε` (no force in all),
/// `e₁ - e₂ = κ d` (one curvature) and `2 E I κ = -N d`:
/// ```text
/// κ = -ε d/(d² + 4 I/A)
/// ```
/// which is Timoshenko's strip (1925) with strands for layers. Stiff links keep sections plane at each
/// station; with links of the bead itself the ends shear over and the middle has that curvature.
#[test]
fn a_strand_laid_along_another_bends_it() {
    let (section, apart_m) = (rod([0, 1]).section, 2e-3);
    let wanted = -SHRUNK * apart_m / (apart_m.powi(2) + 4.0 * section.iy_m4 / section.area_m2);
    let stiff = Section {
        area_m2: 1e4 * section.area_m2,
        iy_m4: 1e5 * section.iy_m4,
        iz_m4: 1e5 * section.iz_m4,
        j_m4: 1e5 * section.j_m4,
        ..section
    };
    let bead = section.sheared(Section::cowper_circle(0.36));
    for (link, pairs, bound) in
        [(stiff, [(0, 20), (9, 10)], 1e-4), (bead, [(9, 11), (8, 12)], 1e-2)]
    {
        let (frame, stages) = laid_along(link, apart_m, 20, 5e-3);
        let records = run(&frame, &stages);
        // while it is held flat the middle of the upper strand wants to be as short as it was born
        let u = &staged(&records[2]).displacement;
        for (from, to) in pairs {
            // a turn about y lifts x towards -z: the shrunk strand is inside the bend
            let bent = -(u[to][4] - u[from][4]) / (5e-3 * (to - from) as f64);
            eprintln!("curvature {bent:.6} of {wanted:.6} per m from {from} to {to}");
            near(bent, wanted, bound);
        }
        let left =
            staged(&records[2]).reactions[0].iter().fold(0.0f64, |most, r| most.max(r.abs()));
        assert!(left < 1e-6, "{left:e}");
    }
}

/// Half a ring on a form: while the form is there its feet carry nothing but their own halves of the
/// outermost members; released, the feet carry all of it, and the thrust is that of one-shot.
#[test]
fn an_arch_comes_off_its_form() {
    let (count, radius_m) = (24, 0.04);
    let at = |k: usize| {
        let angle = std::f64::consts::PI * k as f64 / count as f64;
        Point::new(radius_m * angle.cos(), 0.0, radius_m * angle.sin())
    };
    let members: Vec<Member> = (0..count).map(|k| rod([k, k + 1])).collect();
    let frame = Frame::new((0..=count).map(at).collect(), members).unwrap();
    let down = [0.0, 0.0, -9.80665];
    let form = clamped(0..=count);
    let mut stages: Vec<Stage> = (1..=count).map(|born| stage(born, &form, down)).collect();
    stages.push(stage(count, &clamped([0, count]), down));
    let records = run(&frame, &stages);
    let weight_n: f64 = frame
        .members()
        .iter()
        .map(|member| {
            let [a, b] = member.ends.map(|node| frame.nodes()[node]);
            member.density_kg_m3 * member.section.area_m2 * (b - a).norm() * 9.80665
        })
        .sum();
    let part_n = weight_n / count as f64;
    let on_form = staged(&records[count - 1]);
    near(on_form.reactions[0][2], part_n / 2.0, 1e-9);
    near(on_form.reactions[7][2], part_n, 1e-9);
    let free = &records[count];
    for state in [staged(free), free.one_shot.as_ref().unwrap()] {
        for foot in 0..2 {
            near(state.reactions[foot][2], weight_n / 2.0, 1e-9);
        }
        near(state.reactions[0][0], -state.reactions[1][0], 1e-9);
        assert!(
            state.reactions[0][0] < -0.1 * weight_n,
            "the right foot is pushed out: {:?}",
            state.reactions[0]
        );
    }
    // born on a form that holds every node it has no history: both answers are one
    let (a, b) = (&staged(free).displacement, &free.one_shot.as_ref().unwrap().displacement);
    assert!(block_gap(&a.concat(), &b.concat()) < 1e-9);
}
