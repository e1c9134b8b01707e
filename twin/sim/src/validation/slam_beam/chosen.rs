//! The choices the paper leaves open, and the beams that follow from each.

use super::super::Library;
use super::field::Field;
use super::loaded::{Loaded, Made, Told};
use super::printed::{Printed, from_grid, from_lines, from_seeds, stress};

pub(super) const G_M_S2: f64 = 9.80665;
/// Roads across a bar: an outline around it, which the printer lays along it, is two. The others
/// stand for the density the paper does not print.
const ROADS: usize = 2;
const OTHER_ROADS: [usize; 2] = [3, 4];
/// Roads side by side and layers on each other act as one: the paper's fill is solid.
const BOND: f64 = 1.0;

/// Both beams of one mass, and what they do.
#[derive(Debug, Clone)]
pub(super) struct Pair {
    pub(super) lines: Printed,
    pub(super) grid: Printed,
    pub(super) of_lines: Told,
    pub(super) of_grid: Told,
    pub(super) weight_n: f64,
}

impl Pair {
    pub(super) fn new(field: &Field, made: Made, roads: usize) -> Option<Self> {
        let lines = from_lines(field, roads, made.density_kg_m3, BOND)?;
        let grid = from_grid(lines.volume_m3(), roads, BOND)?;
        let of_lines = Loaded::new(&lines, made)?.told()?;
        let of_grid = Loaded::new(&grid, made)?.told()?;
        let weight_n = lines.volume_m3() * made.density_kg_m3 * G_M_S2;
        Some(Self { lines, grid, of_lines, of_grid, weight_n })
    }

    /// How much stiffer the lines are than the grid.
    pub(super) fn stiffer(&self) -> f64 {
        self.of_lines.stiffness_n_per_m / self.of_grid.stiffness_n_per_m
    }

    pub(super) fn over_weight(&self, load_n: f64) -> f64 {
        load_n / self.weight_n
    }
}

fn made(library: &Library<'_>) -> Made {
    Made {
        density_kg_m3: library.abs.density_kg_m3.nominal,
        e_pa: library.abs.youngs_modulus_pa.nominal,
        poisson: library.abs.poisson.nominal,
        yield_pa: library.abs.strength_pa.nominal,
        bond_fraction: library.abs.bond_fraction.nominal,
    }
}

/// First yield by axial force and stiffness, each over weight, of a beam of lines: N/N, N/N per m.
#[derive(Debug, Clone, Copy)]
pub(super) struct Lines {
    pub(super) axial: f64,
    pub(super) stiffness: f64,
}

impl Lines {
    fn new(field: &Field, made: Made, count: usize, bond: f64) -> Option<Self> {
        let lines = from_seeds(field, ROADS, count, bond)?;
        let told = Loaded::new(&lines, made)?.told()?;
        let weight_n = lines.volume_m3() * made.density_kg_m3 * G_M_S2;
        let [axial, stiffness] = [told.axial_n, told.stiffness_n_per_m].map(|it| it / weight_n);
        Some(Self { axial, stiffness })
    }
}

/// The pair the case stands on, and what changes when what the paper leaves open is chosen otherwise.
pub(super) struct Choice {
    pub(super) pair: Pair,
    /// Thicker bars.
    pub(super) thicker: Vec<Pair>,
    /// A pair of lines fewer, and more.
    pub(super) neighbours: Vec<Lines>,
    /// Roads that slip.
    pub(super) slipping: Option<Lines>,
    /// Lower bound of the load past first yield over weight, were the material ductile.
    pub(super) plastic: Option<f64>,
}

impl Choice {
    pub(super) fn new(library: &Library<'_>) -> Option<Self> {
        let made = made(library);
        let field = stress(made.poisson)?;
        let pair = Pair::new(&field, made, ROADS)?;
        let count = pair.lines.count;
        let of = |count: usize, bond: f64| Lines::new(&field, made, count, bond);
        Some(Self {
            thicker: OTHER_ROADS.iter().filter_map(|&r| Pair::new(&field, made, r)).collect(),
            neighbours: [count.saturating_sub(2), count + 2]
                .into_iter()
                .filter_map(|count| of(count, BOND))
                .collect(),
            slipping: of(count, 0.0),
            plastic: Loaded::new(&pair.lines, made)?.plastic_n().map(|n| pair.over_weight(n)),
            pair,
        })
    }
}
