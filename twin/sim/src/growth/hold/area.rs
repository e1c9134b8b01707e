//! The area with which a strand touches bed or form around a node.

use std::f64::consts::{FRAC_PI_4, PI};

use crate::cell::{Job, On};
use crate::growth::{Built, Printed};
use crate::pose::Vector;
use crate::structure::Member;
use crate::toolpath::Forms;

/// A bead is not taken to spread wider than this many diameters, however near the nozzle is: what is
/// pressed out further has left the strand. Ours.
const WIDEST: f64 = 2.0;

/// A place where a strand touches a surface.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Foot {
    /// Out of the surface, unit, axes of the part.
    pub(super) normal: Vector,
    /// Area of contact, m².
    pub(super) area_m2: f64,
}

/// Looks up feet.
pub(super) struct Feet<'a> {
    job: &'a Job,
    printed: &'a Printed<'a>,
    built: &'a Built,
    /// Members by node, links left out.
    at: Vec<Vec<usize>>,
    forms: Forms,
    up: Vector,
}

impl<'a> Feet<'a> {
    pub(super) fn new(job: &'a Job, printed: &'a Printed<'a>, built: &'a Built) -> Self {
        let mut at = vec![Vec::new(); built.frame.nodes().len()];
        for (index, member) in built.frame.members().iter().enumerate() {
            if member.density_kg_m3 > 0.0 {
                member.ends.iter().for_each(|&node| at[node].push(index));
            }
        }
        let up = job.bed_from_part.inverse_transform_vector(&Vector::z());
        Self { job, printed, built, at, forms: Forms::new(&job.forms, up), up }
    }

    /// How a strand (by order) touches the bed, or a form, at one of its nodes.
    ///
    /// Lying on it: width times half the length of its members there. Standing on it with an end:
    /// the section as the surface cuts it, `(π D²/4)/cos θ`, at most what lies of it would touch.
    pub(super) fn foot(&self, node: usize, order: usize, form: Option<usize>) -> Foot {
        let place = self.built.frame.nodes()[node];
        let bed_m = (self.job.bed_from_part * place).z;
        let (normal, height_m) = form
            .and_then(|form| self.forms.nearest(form, place))
            .unwrap_or((self.up, bed_m.max(0.0)));
        let bead = &self.printed.deposit.strands[order];
        let diameter_m = 2.0 * bead.radius_m;
        let members: Vec<&Member> = self.at[node]
            .iter()
            .filter(|&&member| self.built.member_order[member] == order)
            .map(|&member| &self.built.frame.members()[member])
            .collect();
        let along = |member: &Member| {
            let [a, b] = member.ends.map(|node| self.built.frame.nodes()[node]);
            b - a
        };
        let half_m = members.iter().map(|member| along(member).norm() / 2.0).sum::<f64>();
        let lying_m2 = half_m * contact_width_m(diameter_m, height_m);
        let on = match form {
            None => On::Bed,
            Some(form) => On::Form(form),
        };
        let area_m2 = if self.job.strands[bead.strand].on == on {
            lying_m2
        } else {
            let section_m2 = FRAC_PI_4 * diameter_m * diameter_m;
            let cosines = members.iter().map(|it| along(it).normalize().dot(&normal).abs());
            let steepest = cosines.fold(0.0, f64::max);
            (section_m2 / steepest.max(f64::MIN_POSITIVE)).min(section_m2 + lying_m2)
        };
        Foot { normal, area_m2 }
    }
}

/// Width of the flat on which a bead lies, m: `A/h - π h/4`, `A = π D²/4`.
///
/// The bead is pressed by the orifice, which is `h` above the surface, into a rectangle with half-round
/// sides of the same section; the flat is its straight part. Nothing from `h = D` on, at most
/// [`WIDEST`] diameters. Half-round sides are the custom of slicers; how far the melt wets the
/// surface beyond is not known. D diameter of the set bead, m.
pub(super) fn contact_width_m(diameter_m: f64, height_m: f64) -> f64 {
    let widest_m = WIDEST * diameter_m;
    let flat_m = 0.25 * PI * (diameter_m * diameter_m / height_m - height_m);
    // a height of nothing, or none at all, is no less than the widest
    if flat_m < widest_m { flat_m.max(0.0) } else { widest_m }
}
