use super::*;
use crate::deposit::{self, Printed as Bead};
use crate::finding::{Family, Finding};
use crate::interval::Interval;
use crate::motion;
use crate::preflight::preflight;
use crate::structure::{At, Section};
use crate::test_job::{job, strand, text};
use crate::toolpath;

pub(super) const RADIUS_M: f64 = 1e-3;

/// PLA-like, 2 mm, fully set, without shrinkage.
pub(super) const LAW: StrandLaw = StrandLaw {
    diameter_m: 2.0 * RADIUS_M,
    area_fraction: 1.0,
    stiffness_fraction: 1.0,
    e_pa: 3.5e9,
    poisson: 0.335,
    density_kg_m3: 1240.0,
    strain: 0.0,
    strength_pa: 57e6,
    ageing: Vec::new(),
};

/// Every contact: a patch of a square millimetre, 40 MPa.
const BOND: Bond =
    Bond { area_m2: 1e-6, tension_pa: Interval { nominal: 40e6, low: 30e6, high: 50e6 } };

/// A print as planned: beads where the strands are.
pub(super) struct Print {
    pub(super) job: Job,
    pub(super) motion: Motion,
    deposit: Deposit,
    contacts: Vec<Contact>,
    bonds: Vec<Bond>,
    pub(super) laws: Vec<StrandLaw>,
}

impl Print {
    pub(super) fn new(more: &str, strands: &[String]) -> Self {
        Self::of(job(&text("kr10-cone", more, &strands.join(","))))
    }

    pub(super) fn of(job: Job) -> Self {
        let motion = motion::plan(&job, &toolpath::paths(&job));
        let bead = |printing: &motion::Printing| {
            let points = job.strands[printing.strand].points.clone();
            Bead {
                strand: printing.strand,
                at_m: toolpath::stations(&points),
                as_printed: points.clone(),
                as_planned: points,
                radius_m: RADIUS_M,
                born_s: printing.start_s,
                done_s: printing.end_s,
            }
        };
        let deposit = Deposit::new(motion.printings.iter().map(bead).collect());
        let contacts = deposit::contacts(&deposit);
        let laws = vec![LAW; deposit.strands.len()];
        let bonds = vec![BOND; contacts.len()];
        Self { job, motion, deposit, contacts, bonds, laws }
    }

    pub(super) fn printed(&self) -> Printed<'_> {
        let Self { motion, deposit, contacts, bonds, laws, .. } = self;
        Printed { deposit, contacts, bonds, laws, motion }
    }

    pub(super) fn built(&self) -> Built {
        build(&self.job, &self.printed())
    }

    pub(super) fn grown(&self) -> (Growth, Vec<Finding>) {
        let mut findings = Findings::default();
        let growth = grow(&self.job, &self.printed(), &mut findings).expect("a small frame");
        (growth, findings.sorted())
    }
}

pub(super) const FROM_BED: &str = ", \"start\": { \"join\": \"bed\" }";

#[test]
fn a_crossing_makes_one_link_of_the_length_between_the_axes() {
    let a = strand("a", &[[-20.0, 0.0, 5.0], [30.0, 0.0, 5.0]], FROM_BED);
    let b = strand("b", &[[0.0, -10.0, 7.0], [0.0, 25.0, 7.0]], "");
    let built = Print::new("", &[a, b]).built();
    assert_eq!((built.frame.nodes().len(), built.frame.members().len()), (6, 5));
    assert_eq!(
        (built.born.as_slice(), built.member_order.as_slice()),
        (&[0, 2, 5][..], &[0, 0, 1, 1, 1][..])
    );
    let link = built.frame.members()[4];
    let [from, to] = link.ends.map(|node| built.frame.nodes()[node]);
    assert!(((from - to).norm() - 2.0 * RADIUS_M).abs() < 1e-12);
    assert!((from.x.abs() + from.y.abs() + to.x.abs() + to.y.abs()) < 1e-12, "{from} {to}");
    assert_eq!((link.density_kg_m3, link.initial_strain), (0.0, 0.0));
    // pulled, the patch gives way like a disc between half-spaces, in series with the bead
    let (radius_m, bead) = ((BOND.area_m2 / std::f64::consts::PI).sqrt(), Section::circle(2e-3));
    let gives =
        2e-3 / (LAW.e_pa * bead.area_m2) + (1.0 - LAW.poisson.powi(2)) / (LAW.e_pa * radius_m);
    assert!((2e-3 / (LAW.e_pa * link.section.area_m2) / gives - 1.0).abs() < 1e-12);
    assert_eq!(built.is_link, [false, false, false, false, true]);
    let weld = &built.welds[0];
    assert_eq!((weld.through.as_slice(), weld.node), (&[(4, At::Middle)][..], link.ends[0]));
    assert!((weld.normal - Vector::z()).norm() < 1e-12, "{}", weld.normal);
    // only the start of `a` is on the bed
    assert_eq!(built.grounded, [(built.ends[0][0], 0)]);
}

#[test]
fn ends_that_meet_become_one_node() {
    let apex = [10.0, 10.0, 40.0];
    // a third comes near by less than half a bead, a fourth by more
    let strands = [
        strand("a", &[[0.0, 0.0, 0.5], apex], ""),
        strand("b", &[apex, [20.0, 20.0, 0.5]], ""),
        strand("c", &[[20.0, 0.0, 0.5], [10.0, 10.0, 40.6]], ""),
        strand("d", &[[0.0, 20.0, 0.5], [10.0, 10.0, 41.9]], ""),
    ];
    let built = Print::new("", &strands).built();
    let [a, b, c, d] = [built.ends[0][1], built.ends[1][0], built.ends[2][1], built.ends[3][1]];
    assert_eq!((a, a), (b, c));
    assert_ne!(a, d);
    let feet: Vec<(usize, usize)> = vec![
        (built.ends[0][0], 0),
        (built.ends[1][1], 1),
        (built.ends[2][0], 2),
        (built.ends[3][0], 3),
    ];
    assert_eq!(built.grounded, feet);
    assert_eq!(built.supports(2, &[]).len(), 2);
    assert_eq!(built.supports(4, &[]).len(), 4);
}

/// All of a strand on the bed is held, at its corners too.
#[test]
fn a_strand_on_the_bed_is_held_along_its_length() {
    let a =
        strand("a", &[[0.0, 0.0, 1.0], [20.0, 0.0, 1.0], [20.0, 20.0, 1.0]], ", \"on\": \"bed\"");
    let built = Print::new("", &[a]).built();
    assert_eq!(built.frame.nodes().len(), 3);
    assert_eq!(built.supports(1, &[]).len(), 3);
    assert!(built.supports(0, &[]).is_empty());
}

#[test]
fn an_end_said_to_be_free_is_not_joined() {
    let apex = [10.0, 10.0, 40.0];
    let a = strand("a", &[[0.0, 0.0, 0.5], apex], "");
    for (more, n_nodes) in [("", 3), (", \"start\": { \"join\": \"free\" }", 4)] {
        let built =
            Print::new("", &[a.clone(), strand("b", &[apex, [20.0, 20.0, 0.5]], more)]).built();
        assert_eq!(built.frame.nodes().len(), n_nodes, "{more}");
    }
}

/// Tip of a level strand held at one end: `2ρgL⁴/(E D²)` by bending, `ρgL²/(2κG)` by shear.
#[test]
fn a_cantilever_sags_as_in_the_books() {
    for length_mm in [20.0, 60.0, 150.0] {
        let a = strand("a", &[[0.0, 0.0, 5.0], [length_mm, 0.0, 5.0]], FROM_BED);
        let print = Print::new("", &[a]);
        let (growth, _) = print.grown();
        let (length_m, g) = (length_mm / 1e3, print.job.cell.gravity_m_s2.norm());
        let weight = LAW.density_kg_m3 * g;
        let bending_m = 2.0 * weight * length_m.powi(4) / (LAW.e_pa * LAW.diameter_m.powi(2));
        let kappa = 6.0 * (1.0 + LAW.poisson) / (7.0 + 6.0 * LAW.poisson);
        let shear_pa = LAW.e_pa / (2.0 * (1.0 + LAW.poisson));
        let wanted_m = bending_m + weight * length_m.powi(2) / (2.0 * kappa * shear_pa);
        assert_eq!(growth.stages.len(), 1);
        let stage = &growth.stages[0];
        for found_m in [stage.one_shot_m, stage.staged_m] {
            let found_m = found_m.expect("it is held");
            assert!(
                (found_m / wanted_m - 1.0).abs() < 1e-6,
                "{found_m:e} for {wanted_m:e} at {length_mm} mm"
            );
        }
        assert_eq!((stage.printed, stage.one_shot_node), (1, Some(growth.built.ends[0][1])));
    }
}

/// Held at one end and landed on by the nozzle at the other: `F L³/(3 E I)` and shear.
#[test]
fn the_nozzle_pushes_a_cantilever_as_in_the_books() {
    let length_m: f64 = 0.05;
    let a = strand("a", &[[0.0, 0.0, 5.0], [50.0, 0.0, 5.0]], FROM_BED);
    let b = strand("b", &[[50.0, 0.0, 5.0], [50.0, 0.0, 25.0]], "");
    let print = Print::new("", &[a, b]);
    let (growth, _) = print.grown();
    assert_eq!(growth.landings.len(), 1);
    let landing = &growth.landings[0];
    assert_eq!((landing.strand, landing.at_end), (1, false));
    let force_n = print.job.cell.extruder.nozzle_force_n;
    let section = Section::circle(LAW.diameter_m);
    let kappa_g = Section::cowper_circle(LAW.poisson) * LAW.e_pa / (2.0 * (1.0 + LAW.poisson));
    let per_newton = length_m.powi(3) / (3.0 * LAW.e_pa * section.iy_m4)
        + length_m / (kappa_g * section.area_m2);
    let wanted_m = -force_n.nominal * per_newton;
    assert!(
        (landing.push_m.z / wanted_m - 1.0).abs() < 1e-6,
        "{} for {wanted_m}",
        landing.push_m.z
    );
    assert!((landing.push_length_m.high / (force_n.high * per_newton) - 1.0).abs() < 1e-6);
    assert!(landing.frame_m.z < 0.0 && landing.shrinkage_m.norm() == 0.0);
    let sum = landing.frame_m + landing.push_m;
    assert!((landing.sum_m - sum.norm()).abs() < 1e-15);
}

#[test]
fn a_strand_that_hangs_on_nothing_is_found() {
    let a = strand("a", &[[0.0, 0.0, 1.0], [20.0, 0.0, 30.0]], "");
    let b = strand("b", &[[60.0, 0.0, 40.0], [90.0, 0.0, 40.0]], "");
    let (growth, findings) = Print::new("", &[a, b]).grown();
    let found: Vec<_> =
        findings.iter().map(|found| (found.code, found.site.strand, found.site.stage)).collect();
    assert_eq!(found, [(Code::S402, Some(1), Some(2))]);
    assert!(growth.stages[0].one_shot_m.is_some());
}

/// The part turned about the bed's z: what process and structure find does not change.
#[test]
fn turning_the_part_about_the_vertical_changes_no_finding_of_process_or_structure() {
    let turned = |deg: f64| {
        let more = format!(
            r#""placement": {{ "rpy_deg": [0, 0, {deg}] }}, "process": {{ "speed_mm_s": 6 }},"#
        );
        let strands = [
            strand("a", &[[0.0, 0.0, 1.0], [40.0, 0.0, 1.0]], ", \"on\": \"bed\""),
            strand("b", &[[0.0, 0.0, 1.0], [5.0, 10.0, 60.0]], ""),
            strand("c", &[[5.0, 10.0, 60.0], [45.0, 30.0, 70.0]], ""),
        ];
        let checked =
            preflight(job(&text("kr10-cone", &more, &strands.join(","))), |_| {}).expect("small");
        let kept =
            |found: &&Finding| matches!(found.code.family(), Family::Process | Family::Structure);
        let told: Vec<_> = checked
            .findings()
            .iter()
            .filter(kept)
            .map(|found| (found.code, found.severity, found.site.strand, found.measured))
            .collect();
        let stages: Vec<f64> =
            checked.growth.stages.iter().filter_map(|stage| stage.staged_m).collect();
        (told, stages)
    };
    let (wanted, wanted_stages) = turned(0.0);
    assert!(!wanted.is_empty());
    for deg in [90.0, 137.0] {
        let (told, stages) = turned(deg);
        assert_eq!(told.len(), wanted.len());
        let mut told = told;
        let mut wanted = wanted.clone();
        for list in [&mut told, &mut wanted] {
            list.sort_by_key(|(code, _, strand, _)| (*code, *strand));
        }
        for (one, other) in told.iter().zip(&wanted) {
            assert_eq!((one.0, one.1, one.2), (other.0, other.1, other.2));
            assert!((one.3.nominal / other.3.nominal - 1.0).abs() < 1e-6, "{one:?} {other:?}");
        }
        for (one, other) in stages.iter().zip(&wanted_stages) {
            assert!((one - other).abs() <= 1e-9 + 1e-6 * other, "{one} {other}");
        }
    }
}
