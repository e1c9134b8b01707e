//! Sag behind the nozzle by the ageing rod: gravity as the part saw it, speed as it was, both ends
//! through time.

use super::corotational::{HeavyPiece, droop};
use super::course::Course;
use super::gel;
use super::history::{Corner, clock_set_s, light_set_s};
use super::material::{Material, Setting};
use super::plastic_bending::plastic_moment_n_m;
use super::rod::{
    AgeTable, Ageing, Axes, Elastic, Element, End, Fineness, Hold, Phase, Strand, print_strand,
};
use super::soft::rigid_age_s;
use super::strand::{Ends, Heats, StrandInput};

/// Elements to the stretch that hangs free; with [`CUTS`] pieces to each.
const ELEMENTS: usize = 60;
const CUTS: u32 = 2;
const STEPS: u32 = 40;
/// Pieces of the table of compliance.
const TABLE: u32 = 160;

/// What the rod makes of the stretch of a strand that hangs free.
#[derive(Debug, Clone, PartialEq)]
pub struct Sagged {
    /// Greatest offset from the nozzle's path, m.
    pub greatest_m: f64,
    /// Arc lengths, m, and offsets there at the last, part axes, m.
    pub offsets: Vec<(f64, [f64; 3])>,
}

impl Sagged {
    /// Offset at an arc length, part axes, m: straight in between, none outside the stretch.
    pub fn offset_at(&self, at_m: f64) -> [f64; 3] {
        let k = self.offsets.partition_point(|(place_m, _)| *place_m < at_m);
        match (self.offsets.get(k.wrapping_sub(1)), self.offsets.get(k)) {
            (Some((from_m, from)), Some((to_m, to))) => {
                let share = (at_m - from_m) / (to_m - from_m);
                std::array::from_fn(|i| from[i] + (to[i] - from[i]) * share)
            }
            (None, Some((place_m, offset))) if *place_m == at_m => *offset,
            _ => [0.0; 3],
        }
    }
}

/// Sag A at a corner of the stretch `[from, to]` of arc length, m, that nothing holds in between.
///
/// A gel is a rested Bingham fluid of its resin's viscosity, at all corners: the rod knows no index and no recovery, so
/// where the gel's flow is known [`super::soft`] has the worse slow corner.
///
/// Small slopes; `None` where the laws know no fluid (nothing is there that could flow), nothing holds the stretch, or
/// numbers mean nothing. The start is taken as grown onto what holds it, the nozzle clamps the slope (a hinge at
/// the slow corner), and after the dwell the end is held or let go. 60 elements: cost about a
/// millisecond. Source: process-physics.md section 3.1.
pub fn sag(
    input: &StrandInput,
    course: &Course,
    material: &Material,
    heats: &Heats,
    stretch_m: [f64; 2],
    corner: Corner,
) -> Option<Sagged> {
    let (rigid_s, fluidity) = flow_law(input, material, heats, corner)?;
    let table = AgeTable::new(fluidity, rigid_s, TABLE);
    let compliance = |_: usize, age_s: f64| table.compliance_per_pa(age_s);
    let elements = elements(input, course, material, stretch_m, corner)?;
    let start_s = course.time_at_s(stretch_m[0]);
    let gravity = |time_s: f64| gravity_at(course, start_s + time_s);
    let nozzle = if corner == Corner::Slow { End::Hinged } else { End::Clamped };
    let printing = Hold { far: End::Clamped, near: nozzle };
    let left = match input.ends {
        Ends::BothHeld => Hold { far: End::Clamped, near: nozzle },
        Ends::StartHeld => Hold { far: End::Clamped, near: End::Free },
        Ends::Resting => return None,
    };
    let after = [
        Phase { hold: printing, duration_s: input.dwell_s },
        Phase { hold: left, duration_s: f64::INFINITY },
    ];
    let ageing = Ageing {
        compliance_per_pa: &compliance,
        modulus_pa: None,
        elastic: Elastic::Rate,
        free_curvature_per_m: None,
        rigid_s,
    };
    let fineness = Fineness { cuts: CUTS, steps: STEPS };
    let strand = Strand {
        elements: &elements,
        ageing,
        gravity_m_s2: &gravity,
        printing,
        after: &after,
        fineness,
    };
    let outcome = print_strand(&strand).ok()?;
    let span_m = stretch_m[1] - stretch_m[0];
    if input.ends == Ends::StartHeld && outcome.sag_nozzle_m > LARGE * span_m {
        return Some(drooped(&elements, &gravity(0.0), &table, stretch_m));
    }
    let step_m = (stretch_m[1] - stretch_m[0]) / elements.len() as f64;
    let offsets = outcome.offset_m.iter().enumerate().map(|(k, offset)| {
        let across = elements[k.min(elements.len() - 1)].axes.across;
        let way = |i: usize| offset[0] * across[0][i] + offset[1] * across[1][i];
        (stretch_m[0] + step_m * k as f64, [way(0), way(1), way(2)])
    });
    Some(Sagged { greatest_m: outcome.sag_nozzle_m, offsets: offsets.collect() })
}

/// Sag over span past which slopes are no longer small.
const LARGE: f64 = 0.3;

/// A free stretch that hangs far down: the co-rotational rod with what has flowed frozen in, `E_eff = 1/J` (case
/// EEFF-FROZEN). Where it finds no rest shape it hangs straight down: the greatest there can be.
fn drooped(
    elements: &[Element],
    gravity_m_s2: &[f64; 3],
    table: &AgeTable,
    stretch_m: [f64; 2],
) -> Sagged {
    let e_pa = 1.0 / table.frozen_per_pa();
    let piece = |element: &Element| HeavyPiece {
        length_m: element.length_m,
        bending_n_m2: e_pa * element.inertia_m4,
        axial_n: e_pa * element.area_m2,
        line_mass_kg_m: element.line_mass_kg_m,
    };
    let pieces: Vec<HeavyPiece> = elements.iter().map(piece).collect();
    let along = elements[0].axes.along;
    let step_m = (stretch_m[1] - stretch_m[0]) / elements.len() as f64;
    let straight = |k: usize| along.map(|x| x * step_m * k as f64);
    let rest = droop(&pieces, [0.0; 3], along, *gravity_m_s2, 1);
    let strength = gravity_m_s2.iter().map(|g| g * g).sum::<f64>().sqrt();
    let offset = |k: usize| -> [f64; 3] {
        let from = straight(k);
        match &rest {
            Ok(points) => std::array::from_fn(|i| points[k][i] - from[i]),
            Err(_) => {
                std::array::from_fn(|i| gravity_m_s2[i] / strength * step_m * k as f64 - from[i])
            }
        }
    };
    let offsets: Vec<(f64, [f64; 3])> =
        (0..=elements.len()).map(|k| (stretch_m[0] + step_m * k as f64, offset(k))).collect();
    let size = |o: &[f64; 3]| o.iter().map(|x| x * x).sum::<f64>().sqrt();
    let greatest_m = offsets.iter().map(|(_, o)| size(o)).fold(0.0, f64::max);
    Sagged { greatest_m, offsets }
}

/// Fluidity `1/(3 η)`, 1/(Pa s), at an age, s.
type Fluidity<'a> = Box<dyn Fn(f64) -> f64 + 'a>;

/// Age from which nothing flows, s, and the fluidity `1/(3 η)` until then, 1/(Pa s).
fn flow_law<'a>(
    input: &'a StrandInput,
    material: &'a Material,
    heats: &'a Heats,
    corner: Corner,
) -> Option<(f64, Fluidity<'a>)> {
    let (rigid_s, law): (f64, Fluidity<'a>) = match &material.setting {
        Setting::Thermoplastic(plastic) => {
            let heat = heats.at(corner)?;
            let factor = corner.helpful(plastic.viscosity.factor);
            let viscosity = plastic.viscosity;
            let law = move |age_s: f64| {
                1.0 / (3.0 * factor * viscosity.zero_shear_pa_s(heat.temperature_k(age_s)))
            };
            (rigid_age_s(plastic, heat), Box::new(law))
        }
        Setting::Photopolymer(resin) => {
            let set_s = light_set_s(input, resin, corner);
            let fluid = 1.0 / (3.0 * corner.helpful(resin.base_viscosity_pa_s));
            (set_s, Box::new(move |_| fluid))
        }
        Setting::TwoPart(mix) => {
            let fluid = 1.0 / (3.0 * corner.helpful(mix.viscosity_pa_s));
            (clock_set_s(input, mix, corner), Box::new(move |_| fluid))
        }
    };
    (rigid_s.is_finite() && rigid_s > 0.0).then_some((rigid_s, law))
}

fn elements(
    input: &StrandInput,
    course: &Course,
    material: &Material,
    [from_m, to_m]: [f64; 2],
    corner: Corner,
) -> Option<Vec<Element>> {
    let diameter_m = input.hot_diameter_m();
    let area_m2 = std::f64::consts::PI * diameter_m * diameter_m / 4.0;
    let (yield_moment_n_m, yield_force_n) = match &material.setting {
        Setting::Photopolymer(resin) => {
            let yield_pa = corner.helpful(resin.yield_stress_pa);
            let pull_pa = gel::hanging_length_m(yield_pa, 1.0);
            (plastic_moment_n_m(yield_pa, diameter_m), pull_pa * area_m2)
        }
        _ => (0.0, 0.0),
    };
    let step_m = (to_m - from_m) / ELEMENTS as f64;
    let down = gravity_at(course, course.time_at_s(0.5 * (from_m + to_m)));
    let element = |k: usize| {
        let at_m = from_m + step_m * k as f64;
        let printing_s = course.time_at_s(at_m + step_m) - course.time_at_s(at_m);
        let tangent = course.tangent_at(at_m + 0.5 * step_m);
        Element {
            length_m: step_m,
            printing_s,
            area_m2,
            inertia_m4: area_m2 * diameter_m * diameter_m / 16.0,
            line_mass_kg_m: area_m2 * corner.harmful(material.fresh_density_kg_m3()),
            axes: Axes::new(tangent.into(), down),
            yield_moment_n_m,
            yield_force_n,
        }
    };
    (step_m > 0.0).then(|| (0..ELEMENTS).map(element).collect())
}

fn gravity_at(course: &Course, time_s: f64) -> [f64; 3] {
    course.gravity_at(time_s).into()
}
