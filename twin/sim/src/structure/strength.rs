//! Stress in members against strength along the strand. What holds strands together is in `weld`.

use super::beam::{Beam, beams};
use super::frame::{Frame, Member};
use super::solve::{Solution, SolveError};
use crate::pose::Vector;

/// What a strand can take.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Strength {
    /// In tension along the strand, Pa.
    pub tension_pa: f64,
    /// In compression along the strand, Pa (positive).
    pub compression_pa: f64,
}

impl Strength {
    fn is_usable(&self) -> bool {
        [self.tension_pa, self.compression_pa]
            .iter()
            .all(|number| number.is_finite() && *number > 0.0)
    }
}

/// Which law governs.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Governs {
    /// Tension with torsion in the strand.
    Tension,
    /// Compression with torsion in the strand.
    Compression,
}

/// How much of the strength is used, and where.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Utilisation {
    /// Equivalent stress over strength; 1 is the limit.
    pub value: f64,
    /// The member.
    pub member: usize,
    /// Distance from its first node, m.
    pub station_m: f64,
    /// The law.
    pub governs: Governs,
}

/// Forces on the first end of a member and what it carries: enough for every section of it.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Cut {
    force_n: Vector,
    moment_n_m: Vector,
    /// At the first end.
    line_n_per_m: Vector,
    /// How it grows along the member; none by weight, some where the bed turns.
    growth_n_per_m2: Vector,
}

impl Cut {
    pub(crate) fn new(end_forces: &[f64], line_n_per_m: Vector) -> Self {
        Self {
            force_n: Vector::from_column_slice(&end_forces[..3]),
            moment_n_m: Vector::from_column_slice(&end_forces[3..6]),
            line_n_per_m,
            growth_n_per_m2: Vector::zeros(),
        }
    }

    /// Under a line load that goes straight from `lines[0]` at the first end to `lines[1]`.
    pub(crate) fn linear(end_forces: &[f64], lines: [Vector; 2], length_m: f64) -> Self {
        let growth_n_per_m2 = (lines[1] - lines[0]) / length_m;
        Self { growth_n_per_m2, ..Self::new(end_forces, lines[0]) }
    }

    /// Force and moment on the first end, from its node.
    pub(crate) fn on_first_end(&self) -> [Vector; 2] {
        [self.force_n, self.moment_n_m]
    }

    /// This one and a multiple of another.
    pub(crate) fn plus(&self, other: &Self, factor: f64) -> Self {
        Self {
            force_n: self.force_n + other.force_n * factor,
            moment_n_m: self.moment_n_m + other.moment_n_m * factor,
            line_n_per_m: self.line_n_per_m + other.line_n_per_m * factor,
            growth_n_per_m2: self.growth_n_per_m2 + other.growth_n_per_m2 * factor,
        }
    }

    /// Force and moment that the rest of the member puts on the piece before a section, from
    /// equilibrium of that piece under the line load `w + k s`: `-(F + w s + k s²/2)` and
    /// `-M₁ + s x × F + s²/2 x × w + s³/6 x × k`.
    pub(crate) fn on_cut(&self, x: &Vector, s: f64) -> [Vector; 2] {
        let [half, third] =
            [2.0, 3.0].map(|part| self.line_n_per_m + self.growth_n_per_m2 * (s / part));
        let moment =
            -self.moment_n_m + x.cross(&self.force_n) * s + x.cross(&third) * (s * s / 2.0);
        [-(self.force_n + half * s), moment]
    }

    /// Axial force at a section, tension positive.
    pub(crate) fn axial_n(&self, x: &Vector, s: f64) -> f64 {
        self.on_cut(x, s)[0].dot(x)
    }

    /// Axial force (tension positive), bending moment (vector across) and torque at a section.
    pub(super) fn at(&self, x: &Vector, s: f64) -> (f64, Vector, f64) {
        let [force, moment] = self.on_cut(x, s);
        let torque = moment.dot(x);
        (force.dot(x), moment - x * torque, torque)
    }

    /// Ends, and where the moment may peak between them: no shear along or across what lies across
    /// the middle (exact where the line load keeps its direction), and the middle.
    pub(super) fn stations(&self, x: &Vector, length_m: f64) -> [f64; 5] {
        let middle = self.line_n_per_m + self.growth_n_per_m2 * (length_m / 2.0);
        let line = middle - x * x.dot(&middle);
        let [constant, linear, square] =
            [self.force_n, self.line_n_per_m, self.growth_n_per_m2 / 2.0].map(|v| v.dot(&line));
        let [one, other] = no_shear(constant, linear, square);
        let inside = |s: f64| s.clamp(0.0, length_m);
        [0.0, length_m, inside(one), 0.5 * length_m, inside(other)]
    }
}

/// Real roots of `c + b s + a s²`; 0 in place of one that is not there.
fn no_shear(c: f64, b: f64, a: f64) -> [f64; 2] {
    let root = (b * b - 4.0 * a * c).max(0.0).sqrt();
    // without cancellation: the large one by addition, the small one by the product of both
    let sum = -0.5 * (b + root.copysign(b));
    let safe = |number: f64| if number.is_finite() { number } else { 0.0 };
    [safe(c / sum), safe(sum / a)]
}

/// Geometry of a member as the laws need it.
#[derive(Debug, Clone)]
pub(crate) struct Span<'a> {
    pub(crate) member: &'a Member,
    pub(crate) x: Vector,
    pub(crate) y: Vector,
    pub(crate) length_m: f64,
}

impl Span<'_> {
    /// `σ = N/A ± c |(M_y/I_y, M_z/I_z)|`, `τ = T c/J`, both as if at the outermost fibre: exact for
    /// a circle, not below the truth for other sections (for a strongly oblong one τ is the
    /// circle's formula, not Saint-Venant's peak).
    fn stress(&self, cut: &Cut, station_m: f64) -> (f64, f64, f64) {
        let section = &self.member.section;
        let (axial_n, bending, torque) = cut.at(&self.x, station_m);
        let z = self.x.cross(&self.y);
        let bend_pa = section.fibre_m
            * (bending.dot(&self.y) / section.iy_m4).hypot(bending.dot(&z) / section.iz_m4);
        let axial_pa = axial_n / section.area_m2;
        (axial_pa + bend_pa, axial_pa - bend_pa, torque * section.fibre_m / section.j_m4)
    }

    /// `√(σ² + 3 τ²)` against tension and compression apart.
    pub(crate) fn utilisation(&self, cut: &Cut, strength: &Strength) -> (f64, f64, Governs) {
        let mut worst = (0.0, 0.0, Governs::Tension);
        for station_m in cut.stations(&self.x, self.length_m) {
            let (high_pa, low_pa, shear_pa) = self.stress(cut, station_m);
            let equivalent_pa = |normal_pa: f64| normal_pa.hypot(3f64.sqrt() * shear_pa);
            let tension = equivalent_pa(high_pa.max(0.0)) / strength.tension_pa;
            let compression = equivalent_pa(low_pa.min(0.0)) / strength.compression_pa;
            for (value, governs) in
                [(tension, Governs::Tension), (compression, Governs::Compression)]
            {
                if value > worst.0 {
                    worst = (value, station_m, governs);
                }
            }
        }
        worst
    }

    /// `N/A` against tension and compression apart, at the end where it is greater.
    pub(crate) fn axial_utilisation(&self, cut: &Cut, strength: &Strength) -> (f64, f64, Governs) {
        let of = |station_m: f64| {
            let axial_pa = cut.axial_n(&self.x, station_m) / self.member.section.area_m2;
            if axial_pa < 0.0 {
                (-axial_pa / strength.compression_pa, station_m, Governs::Compression)
            } else {
                (axial_pa / strength.tension_pa, station_m, Governs::Tension)
            }
        };
        let (near, far) = (of(0.0), of(self.length_m));
        if far.0 > near.0 { far } else { near }
    }
}

/// One strength per member, each usable.
pub(crate) fn check_strengths(members: usize, strengths: &[Strength]) -> Result<(), SolveError> {
    if strengths.len() != members {
        return Err(SolveError::BadMember { member: strengths.len().min(members) });
    }
    match strengths.iter().position(|strength| !strength.is_usable()) {
        Some(member) => Err(SolveError::BadMember { member }),
        None => Ok(()),
    }
}

/// The most used member of a solution; `None` for a frame without members. `strengths` by member,
/// `gravity` the one the solution was made with.
///
/// # Errors
/// [`SolveError::BadMember`] where a strength or a force is missing or not positive.
pub fn utilisation(
    frame: &Frame,
    strengths: &[Strength],
    solution: &Solution,
    gravity_m_s2: [f64; 3],
) -> Result<Option<Utilisation>, SolveError> {
    check_strengths(frame.members().len(), strengths)?;
    let cuts = cuts(frame, solution, gravity_m_s2)?;
    Ok(worst(&spans(frame, &beams(frame)), &cuts, strengths))
}

/// Members with their directions and lengths.
pub(crate) fn spans<'a>(frame: &'a Frame, beams: &[Beam]) -> Vec<Span<'a>> {
    let of_member = |(member, beam): (&'a Member, &Beam)| Span {
        member,
        x: beam.axes.column(0).into_owned(),
        y: beam.axes.column(1).into_owned(),
        length_m: beam.length_m,
    };
    frame.members().iter().zip(beams).map(of_member).collect()
}

/// The cuts of a solution, by member.
pub(crate) fn cuts(
    frame: &Frame,
    of: &Solution,
    gravity_m_s2: [f64; 3],
) -> Result<Vec<Cut>, SolveError> {
    let count = frame.members().len();
    if of.end_forces.len() != count {
        return Err(SolveError::BadMember { member: of.end_forces.len().min(count) });
    }
    let cut = |(member, ends): (&Member, &[f64; 12])| {
        let line_kg_per_m = member.density_kg_m3 * member.section.area_m2;
        Cut::new(ends, Vector::from(gravity_m_s2) * line_kg_per_m)
    };
    Ok(frame.members().iter().zip(&of.end_forces).map(cut).collect())
}

/// The first of the most used members.
pub(crate) fn worst(spans: &[Span], cuts: &[Cut], strengths: &[Strength]) -> Option<Utilisation> {
    worst_by(spans, cuts, strengths, |_, span, cut, strength| span.utilisation(cut, strength))
}

/// The same by any law; members are asked in order, each once.
pub(crate) fn worst_by(
    spans: &[Span],
    cuts: &[Cut],
    strengths: &[Strength],
    mut law: impl FnMut(usize, &Span, &Cut, &Strength) -> (f64, f64, Governs),
) -> Option<Utilisation> {
    let mut worst: Option<Utilisation> = None;
    for (member, ((span, cut), strength)) in spans.iter().zip(cuts).zip(strengths).enumerate() {
        let (value, station_m, governs) = law(member, span, cut, strength);
        if worst.is_none_or(|worst| value > worst.value) {
            worst = Some(Utilisation { value, member, station_m, governs });
        }
    }
    worst
}
