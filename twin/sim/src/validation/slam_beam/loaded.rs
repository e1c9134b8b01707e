//! A printed beam under its load: stiffness, first yield by three criteria, what plasticity adds.

use crate::pose::{Point, Vector};
use crate::structure::{
    Elastic, Frame, Load, Member, NodeLoad, Section, Solution, Strength, Support, plastic_bound,
    solve, utilisation,
};

use super::lines::Family;
use super::net::{Bar, Part};
use super::printed::{PLATFORM_M, Printed, SPAN_M, axes, layers};

/// `κ` of a rectangle for shear.
const SHEAR: f64 = 5.0 / 6.0;
/// Stress at yield of shear over that of tension (von Mises).
const SHEAR_YIELD: f64 = 0.577_350_269_189_625_8;

/// What a beam is made of, nominal.
#[derive(Debug, Clone, Copy)]
pub(super) struct Made {
    pub(super) density_kg_m3: f64,
    pub(super) e_pa: f64,
    pub(super) poisson: f64,
    pub(super) yield_pa: f64,
    /// Strength across a bond over strength along a strand.
    pub(super) bond_fraction: f64,
}

/// What a beam does. Loads are totals on the platform, and linear in the yield stress.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Told {
    /// Load over the mean deflection under the platform.
    pub(super) stiffness_n_per_m: f64,
    /// First yield by axial force alone, as in the paper.
    pub(super) axial_n: f64,
    /// First yield of a fibre: axial force with bending.
    pub(super) fibre_n: f64,
    /// First joint between the two families sheared off its bond.
    pub(super) joint_n: f64,
    /// `Σ |N| L` over the load; Michell's number is the least there is.
    pub(super) force_path_m: f64,
}

/// A frame with its supports and a load of 1 N.
pub(super) struct Loaded<'a> {
    printed: &'a Printed,
    made: Made,
    frame: Frame,
    supports: Vec<Support>,
    push: Load,
}

impl<'a> Loaded<'a> {
    /// Rigid joints on centre lines; no weight. Carried at the lower corners, pushed evenly over the
    /// platform in the middle of the top. `None` never for the beams of this case.
    pub(super) fn new(printed: &'a Printed, made: Made) -> Option<Self> {
        let of_bar = |bar: &Bar| {
            let bundle = printed.bundle(bar.part);
            let [a, b] = bar.ends.map(|node| printed.net.nodes_m[node]);
            Member {
                ends: bar.ends,
                // bent in the plane only: the fibre is half the thickness there
                section: Section { fibre_m: bundle.half_m[0], ..bundle.section }.sheared(SHEAR),
                elastic: Elastic::isotropic(made.e_pa, made.poisson),
                density_kg_m3: 0.0,
                initial_strain: 0.0,
                side: Vector::new(a[1] - b[1], b[0] - a[0], 0.0),
                strand: 0,
            }
        };
        let nodes = printed.net.nodes_m.iter().map(|at| Point::new(at[0], at[1], 0.0)).collect();
        let frame = Frame::new(nodes, printed.net.bars.iter().map(of_bar).collect()).ok()?;
        let fixed = |node: usize| {
            let [x, y] = printed.net.nodes_m[node];
            let (low, left, right) = (y == 0.0, x == 0.0, x == SPAN_M);
            [low && left, low && (left || right), true, true, true, false]
        };
        let supports =
            (0..frame.nodes().len()).map(|node| Support { node, fixed: fixed(node) }).collect();
        let push = Load { at_nodes: pushes(printed), ..Load::default() };
        Some(Self { printed, made, frame, supports, push })
    }

    pub(super) fn solved(&self) -> Option<Solution> {
        solve(&self.frame, &self.supports, &self.push).ok()
    }

    /// A strand yields alike in tension and compression, and through its joints.
    fn strengths(&self) -> Vec<Strength> {
        let pa = self.made.yield_pa;
        let strength = Strength { tension_pa: pa, compression_pa: pa };
        vec![strength; self.frame.members().len()]
    }

    pub(super) fn told(&self) -> Option<Told> {
        let solution = self.solved()?;
        let sunk_m: f64 = self
            .push
            .at_nodes
            .iter()
            .map(|push| push.load[1] * solution.displacement[push.node][1])
            .sum();
        let axial: Vec<f64> =
            (0..self.frame.members().len()).map(|bar| self.axial_n(&solution, bar)).collect();
        let lengths = self.printed.net.bars.iter().map(|bar| self.printed.net.length_m(bar));
        let stress = |(bar, axial_n): (&Bar, &f64)| {
            axial_n.abs() / self.printed.bundle(bar.part).section.area_m2
        };
        let most_pa = self.printed.net.bars.iter().zip(&axial).map(stress).fold(0.0, f64::max);
        let used = utilisation(&self.frame, &self.strengths(), &solution, [0.0; 3]).ok()??.value;
        Some(Told {
            stiffness_n_per_m: 1.0 / sunk_m,
            axial_n: self.made.yield_pa / most_pa,
            fibre_n: 1.0 / used,
            joint_n: 1.0 / self.joint_use(&solution),
            force_path_m: axial.iter().zip(lengths).map(|(axial_n, l)| axial_n.abs() * l).sum(),
        })
    }

    /// A lower bound of the load past first yield, were the material ductile.
    pub(super) fn plastic_n(&self) -> Option<f64> {
        let none = Load::default();
        let bound =
            plastic_bound(&self.frame, &self.supports, &self.strengths(), &none, &self.push)
                .ok()?;
        Some(bound.bound)
    }

    /// Tension positive.
    fn axial_n(&self, solution: &Solution, bar: usize) -> f64 {
        let [from, to] = self.frame.members()[bar].ends.map(|node| self.frame.nodes()[node]);
        let force = Vector::from_column_slice(&solution.end_forces[bar][6..9]);
        force.dot(&(to - from).normalize())
    }

    /// The most used joint of two families: what one hands to the other goes as shear through every
    /// bond between its layers and the other's, a square as wide as a bar: `F/A + M r/Ip`.
    fn joint_use(&self, solution: &Solution) -> f64 {
        let nodes = self.frame.nodes().len();
        let mut handed = vec![[[0.0; 3]; 2]; nodes];
        let mut boxed = vec![false; nodes];
        for (bar, ends) in self.printed.net.bars.iter().zip(&solution.end_forces) {
            for (end, &node) in bar.ends.iter().enumerate() {
                let force = [ends[6 * end], ends[6 * end + 1], ends[6 * end + 5]];
                match bar.part {
                    Part::Enclosure => boxed[node] = true,
                    Part::Inner(family) => {
                        let side = usize::from(family == Family::Smaller);
                        (0..3).for_each(|k| handed[node][side][k] += force[k]);
                    }
                }
            }
        }
        let (wide_m, bonds) = (self.printed.inner_m, (layers() - 1) as f64);
        let (area_m2, polar_m4) = (bonds * wide_m.powi(2), bonds * wide_m.powi(4) / 6.0);
        let corner_m = wide_m / 2f64.sqrt();
        let shear_pa = |[fx, fy, moment]: [f64; 3]| {
            fx.hypot(fy) / area_m2 + moment.abs() * corner_m / polar_m4
        };
        let crossings = handed.iter().zip(&boxed).filter(|(_, boxed)| !**boxed);
        let most_pa = crossings.map(|(both, _)| shear_pa(both[0])).fold(0.0, f64::max);
        most_pa / (SHEAR_YIELD * self.made.bond_fraction * self.made.yield_pa)
    }
}

/// 1 N downwards, even over the platform: half of each covered piece to each of its nodes.
fn pushes(printed: &Printed) -> Vec<NodeLoad> {
    let (top, middle) = (axes().high_m[1], SPAN_M / 2.0);
    let nodes = &printed.net.nodes_m;
    let on =
        |at: &[f64; 2]| at[1] == top && (at[0] - middle).abs() <= PLATFORM_M / 2.0 * (1.0 + 1e-9);
    let down = |node: usize, n: f64| NodeLoad { node, load: [0.0, -n, 0.0, 0.0, 0.0, 0.0] };
    let covered =
        printed.net.bars.iter().filter(|bar| {
            bar.part == Part::Enclosure && bar.ends.iter().all(|&node| on(&nodes[node]))
        });
    covered
        .flat_map(|bar| {
            let half_n = 0.5 * printed.net.length_m(bar) / PLATFORM_M;
            bar.ends.map(|node| down(node, half_n))
        })
        .collect()
}
