//! What holds one strand to another: force through a patch of contact against its strength.

use std::f64::consts::PI;

use super::solve::SolveError;
use super::strength::{Cut, Span};
use crate::pose::Vector;

/// Where a weld cuts a member.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum At {
    /// At its first end: the member is the younger side.
    First,
    /// At its last end: the member is the younger side.
    Last,
    /// In its middle, its first half on the younger side: a link between two axes.
    Middle,
}

/// The patch of contact by which a strand holds to what was there before it.
#[derive(Debug, Clone, PartialEq)]
pub struct Weld {
    /// The node of the younger strand.
    pub node: usize,
    /// What the younger side hands through the patch: each member once.
    pub through: Vec<(usize, At)>,
    /// Area of the patch, m².
    pub area_m2: f64,
    /// Across the patch, unit, from the older to the younger side.
    pub normal: Vector,
    /// Strength in tension across the patch, Pa.
    pub tension_pa: f64,
    /// Strength in shear along it, Pa.
    pub shear_pa: f64,
}

/// How much of a weld's strength is used.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct WeldUse {
    /// Equivalent traction over strength; 1 is the limit.
    pub value: f64,
    /// The weld.
    pub weld: usize,
    /// Its node.
    pub node: usize,
}

impl Weld {
    pub(crate) fn is_usable(&self, members: usize, nodes: usize) -> bool {
        [self.area_m2, self.tension_pa, self.shear_pa].iter().all(|x| x.is_finite() && *x > 0.0)
            && (self.normal.norm() - 1.0).abs() < 1e-6
            && self.node < nodes
            && self.through.iter().all(|(member, _)| *member < members)
    }

    /// The patch is taken as a disc of its area, `r = √(A/π)`, with force F and moment M (about its
    /// middle) of the older on the younger side:
    ///
    /// ```text
    /// σ = -F·n/A + 4 |M - (M·n) n|/(π r³)      τ = |F - (F·n) n|/A + 2 |M·n|/(π r³)
    /// used = √((σ⁺/f_t)² + (τ/f_s)²)
    /// ```
    ///
    /// Pressure alone uses nothing: what is pressed to failure is the strand. The greatest stresses
    /// are added as if they met at one point, and pressure is not let carry shear by friction: both to
    /// the safe side. Source of the interaction: structures.md section 7.
    pub(crate) fn used(&self, spans: &[Span], cuts: &[Cut]) -> f64 {
        let (mut force_n, mut moment_n_m) = (Vector::zeros(), Vector::zeros());
        for &(member, at) in &self.through {
            let (Some(span), Some(cut)) = (spans.get(member), cuts.get(member)) else { return 0.0 };
            let [force, moment] = match at {
                At::First => cut.on_first_end(),
                At::Last => cut.on_cut(&span.x, span.length_m),
                At::Middle => cut.on_cut(&span.x, 0.5 * span.length_m),
            };
            force_n += force;
            moment_n_m += moment;
        }
        let cubed_m3 = PI * (self.area_m2 / PI).powf(1.5);
        let [pull_n, twist_n_m] = [force_n, moment_n_m].map(|vector| vector.dot(&self.normal));
        let [shear_n, bend_n_m] =
            [force_n - self.normal * pull_n, moment_n_m - self.normal * twist_n_m]
                .map(|vector| vector.norm());
        let normal_pa = -pull_n / self.area_m2 + 4.0 * bend_n_m / cubed_m3;
        let shear_pa = shear_n / self.area_m2 + 2.0 * twist_n_m.abs() / cubed_m3;
        (normal_pa.max(0.0) / self.tension_pa).hypot(shear_pa / self.shear_pa)
    }
}

/// Every weld usable, its members and node there.
pub(crate) fn check_welds(welds: &[Weld], members: usize, nodes: usize) -> Result<(), SolveError> {
    match welds.iter().find(|weld| !weld.is_usable(members, nodes)) {
        Some(weld) => Err(SolveError::BadNode { node: weld.node }),
        None => Ok(()),
    }
}

/// The first of the most used welds; those of members without forces (not born yet) use nothing.
/// `None` without welds.
pub(crate) fn worst_weld(welds: &[Weld], spans: &[Span], cuts: &[Cut]) -> Option<WeldUse> {
    let mut worst: Option<WeldUse> = None;
    for (index, weld) in welds.iter().enumerate() {
        let value = weld.used(spans, cuts);
        if worst.is_none_or(|worst| value > worst.value) {
            worst = Some(WeldUse { value, weld: index, node: weld.node });
        }
    }
    worst
}
