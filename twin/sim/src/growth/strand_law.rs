//! What the structure needs to know about a strand.

use crate::structure::{Elastic, Section};

/// What the structure needs to know about a strand.
#[derive(Debug, Clone, PartialEq)]
pub struct StrandLaw {
    /// Diameter of the set bead, m.
    pub diameter_m: f64,
    /// Share of the section that carries (uncured cores do not).
    pub area_fraction: f64,
    /// Share of the bending stiffness that is there.
    pub stiffness_fraction: f64,
    /// Young's modulus, Pa.
    pub e_pa: f64,
    /// Poisson's ratio.
    pub poisson: f64,
    /// Density, kg/m³.
    pub density_kg_m3: f64,
    /// Strain the strand would still have if both its ends were free; shrinkage is negative.
    pub strain: f64,
    /// Strength along the strand, Pa.
    pub strength_pa: f64,
    /// Modulus at ages (s, ascending) as a share of the final one; empty: 1 at any age.
    pub ageing: Vec<[f64; 2]>,
}

/// From this share of its final modulus on a strand counts as hard.
const HARD_SHARE: f64 = 0.995;
/// The least share of its modulus that a strand is given: below, pivots lose too many digits.
const SOFT_SHARE: f64 = 1e-3;

impl StrandLaw {
    pub(super) fn section(&self) -> Section {
        let full = Section::circle(self.diameter_m);
        Section {
            area_m2: full.area_m2 * self.area_fraction,
            iy_m4: full.iy_m4 * self.stiffness_fraction,
            iz_m4: full.iz_m4 * self.stiffness_fraction,
            j_m4: full.j_m4 * self.stiffness_fraction,
            ..full
        }
        .sheared(Section::cowper_circle(self.poisson))
    }

    /// The section that makes a member of this length between two axes as soft as a bead of that length with a patch of
    /// contact in its middle.
    ///
    /// A disc of radius r between two bodies that spread what goes through it (two half-spaces in series; Johnson, Contact
    /// Mechanics, 1985, 3.6, 7.2, with the rocking and twisting of a rigid disc):
    ///
    /// ```text
    /// pull E r/(1-ν²)    shear 4 G r/(2-ν)    bending 4 G r³/(3 (1-ν))    twist 8 G r³/3
    /// ```
    ///
    /// each in series with the bead, `E A/l`, `κ G A/l`, `E I/l`, `G J/l`. For patches narrower than the bead; wider ones come
    /// out too soft.
    pub(super) fn link(&self, area_m2: f64, length_m: f64) -> Section {
        let bead = self.section();
        let Elastic { e_pa, g_pa } = self.elastic();
        let (radius_m, nu) = ((area_m2 / std::f64::consts::PI).sqrt(), self.poisson);
        let cubed_m3 = radius_m.powi(3);
        let in_series =
            |of_bead: f64, of_patch: f64| 1.0 / (1.0 / of_bead + length_m.recip() / of_patch);
        let pull_n = in_series(e_pa * bead.area_m2, e_pa * radius_m / (1.0 - nu * nu));
        let shear_n =
            in_series(bead.shear_kappa * g_pa * bead.area_m2, 4.0 * g_pa * radius_m / (2.0 - nu));
        let bend = in_series(e_pa * bead.iy_m4, 4.0 * g_pa * cubed_m3 / (3.0 * (1.0 - nu)));
        let twist = in_series(g_pa * bead.j_m4, 8.0 * g_pa * cubed_m3 / 3.0);
        let section_m2 = pull_n / e_pa;
        Section {
            area_m2: section_m2,
            iy_m4: bend / e_pa,
            iz_m4: bend / e_pa,
            j_m4: twist / g_pa,
            shear_kappa: shear_n / (g_pa * section_m2),
            fibre_m: radius_m,
        }
    }

    /// Share of the final modulus at an age, between the samples linear in age.
    pub(super) fn share_at(&self, age_s: f64) -> f64 {
        let after = self.ageing.partition_point(|[at_s, _]| *at_s <= age_s);
        let share = match (after.checked_sub(1).map(|k| self.ageing[k]), self.ageing.get(after)) {
            (Some([a_s, a]), Some([b_s, b])) => a + (b - a) * (age_s - a_s) / (b_s - a_s),
            (Some([_, last]), None) => last,
            (None, Some([_, first])) => *first,
            (None, None) => 1.0,
        };
        if share >= HARD_SHARE { 1.0 } else { share.max(SOFT_SHARE) }
    }

    pub(super) fn elastic(&self) -> Elastic {
        Elastic::isotropic(self.e_pa, self.poisson)
    }
}
