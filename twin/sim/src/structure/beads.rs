//! The section of a member that is made of many beads laid beside and on each other.

use std::f64::consts::PI;

use thiserror::Error;

use super::section::Section;

/// Below this part of `Iy + Iz` a product of inertia is rounding and turns no axes.
const ROUNDING: f64 = 1e-12;

/// One bead in the cross-section of a member.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Bead {
    /// Its own section, principal axes along y and z of the member.
    pub section: Section,
    /// Half of its width along y and of its height along z, m.
    pub half_m: [f64; 2],
    /// Where its centroid is: y, z, m.
    pub at_m: [f64; 2],
}

impl Bead {
    /// A bead laid flat by the nozzle: a rectangle with half circles for sides, full width along y
    /// and height along z, `width_m >= height_m`.
    ///
    /// With `r = h/2`, `d = (w - h)/2`: `A = 2 d h + π r²`, `Iy = 2 d h³/12 + π r⁴/4`,
    /// `Iz = h (2 d)³/12 + π r⁴/4 + 8 r³ d/3 + π r² d²`. J is that of the ellipse inside it: J never
    /// falls when a section grows (Pólya and Szegő 1951), so it is a lower bound, exact at `w = h`.
    pub fn flattened(width_m: f64, height_m: f64, at_m: [f64; 2]) -> Self {
        let (r, d) = (height_m / 2.0, (width_m - height_m) / 2.0);
        let section = Section {
            area_m2: 2.0 * d * height_m + PI * r * r,
            iy_m4: d * height_m.powi(3) / 6.0 + PI * r.powi(4) / 4.0,
            iz_m4: 2.0 * height_m * d.powi(3) / 3.0
                + PI * r.powi(4) / 4.0
                + 8.0 / 3.0 * r.powi(3) * d
                + PI * (r * d).powi(2),
            ..Section::ellipse(width_m, height_m)
        };
        Self { section, half_m: [width_m / 2.0, height_m / 2.0], at_m }
    }

    fn is_usable(&self) -> bool {
        let sized = self.half_m.iter().all(|half| half.is_finite() && *half > 0.0);
        sized && self.at_m.iter().all(|at| at.is_finite()) && self.section.is_usable()
    }
}

/// Many beads as one section.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Bundle {
    /// About the principal axes. `fibre_m` is for bending about any axis; a bundle that is long one
    /// way and is bent in one plane only may take [`Bundle::half_m`] instead.
    pub section: Section,
    /// Its centroid, in the axes the beads were given in: y, z, m.
    pub centroid_m: [f64; 2],
    /// Turn from the given y to the principal y, towards z; -π/4 to π/4.
    pub roll_rad: f64,
    /// Fibre distance along the principal y (bending about z) and z (bending about y), m.
    pub half_m: [f64; 2],
}

/// Why beads make no section.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
pub enum BeadsFault {
    /// No bead at all.
    #[error("a member needs a bead")]
    Empty,
    /// A bead without size, or nowhere.
    #[error("bead {bead} needs a positive finite section and a place")]
    BadBead {
        /// The bead.
        bead: usize,
    },
    /// A bond factor outside 0 to 1.
    #[error("a bond factor is 0 to 1, not {bond}")]
    BadBond {
        /// What was given.
        bond: f64,
    },
}

/// Beads that run side by side along a member, as one section. They may touch, not overlap.
///
/// `A = Σ A`, `I = Σ I + β Σ A a²` with a the distance from the common centroid (Steiner), then
/// turned to principal axes. `bond` is β: 1, cross-sections stay plane (one body); 0, beads bend with
/// one curvature and slip along each other (`Σ I`); between, the composite factor γ of mechanically
/// jointed beams (Möhler 1956; Eurocode 5, annex B: there `γ = 1/(1 + π² E A s/(K L²))` for layers
/// with slip modulus K over spacing s). Fibre of a bead: `β a + c`, since its stress is
/// `E κ (β a + c)`; by corners of the box around it and by its own fibre, the smaller, so never
/// below the truth.
///
/// `J = Σ J` whatever the bond: a lower bound (the beads' stress functions together are one of the
/// whole), so soft and over-stressed in torsion; [`torsion_ceiling_m4`] is the other side.
/// `κ A = Σ κ A`: sheared by one angle.
///
/// # Errors
/// [`BeadsFault`].
pub fn bundle(beads: &[Bead], bond: f64) -> Result<Bundle, BeadsFault> {
    if beads.is_empty() {
        return Err(BeadsFault::Empty);
    }
    if !(0.0..=1.0).contains(&bond) {
        return Err(BeadsFault::BadBond { bond });
    }
    if let Some(bead) = beads.iter().position(|bead| !bead.is_usable()) {
        return Err(BeadsFault::BadBead { bead });
    }
    let sum = |of: &dyn Fn(&Bead) -> f64| beads.iter().map(of).sum::<f64>();
    let area_m2 = sum(&|bead| bead.section.area_m2);
    let centroid_m =
        [0, 1].map(|axis| sum(&|bead| bead.section.area_m2 * bead.at_m[axis]) / area_m2);
    let arm = |bead: &Bead| [bead.at_m[0] - centroid_m[0], bead.at_m[1] - centroid_m[1]];
    let steiner =
        |of: &dyn Fn([f64; 2]) -> f64| bond * sum(&|bead| bead.section.area_m2 * of(arm(bead)));
    let iy_m4 = sum(&|bead| bead.section.iy_m4) + steiner(&|[_, z]| z * z);
    let iz_m4 = sum(&|bead| bead.section.iz_m4) + steiner(&|[y, _]| y * y);
    let roll_rad = roll(iy_m4, iz_m4, steiner(&|[y, z]| y * z));
    let (principal_y_m4, principal_z_m4) = turned(iy_m4, iz_m4, steiner(&|[y, z]| y * z), roll_rad);
    let far = |of: &dyn Fn(&Bead) -> f64| beads.iter().map(of).fold(0.0, f64::max);
    let section = Section {
        area_m2,
        iy_m4: principal_y_m4,
        iz_m4: principal_z_m4,
        j_m4: sum(&|bead| bead.section.j_m4),
        shear_kappa: sum(&|bead| bead.section.shear_kappa * bead.section.area_m2) / area_m2,
        fibre_m: far(&|bead| fibre(bead, arm(bead), bond)),
    };
    let (sin, cos) = roll_rad.sin_cos();
    let reach = |bead: &Bead, [a, b]: [f64; 2]| {
        let [y, z] = arm(bead);
        bond * (a * y + b * z).abs() + (a * bead.half_m[0]).abs() + (b * bead.half_m[1]).abs()
    };
    let half_m = [[cos, sin], [-sin, cos]].map(|along| far(&|bead| reach(bead, along)));
    Ok(Bundle { section, centroid_m, roll_rad, half_m })
}

/// No section has more torsion constant than `4 Iy Iz/(Iy + Iz)` (Nicolai; the warping `c y z` put
/// into the principle of least energy). An ellipse has it.
pub fn torsion_ceiling_m4(section: &Section) -> f64 {
    4.0 * section.iy_m4 * section.iz_m4 / (section.iy_m4 + section.iz_m4)
}

/// Farthest point of a bead as its stress sees it.
fn fibre(bead: &Bead, [y, z]: [f64; 2], bond: f64) -> f64 {
    let (y, z) = (bond * y.abs(), bond * z.abs());
    let by_corner = (y + bead.half_m[0]).hypot(z + bead.half_m[1]);
    by_corner.min(y.hypot(z) + bead.section.fibre_m)
}

/// Turn to the principal axes that are nearest: `tan 2φ = 2 Iyz/(Iz - Iy)`.
fn roll(iy_m4: f64, iz_m4: f64, iyz_m4: f64) -> f64 {
    if iyz_m4.abs() <= ROUNDING * (iy_m4 + iz_m4) {
        return 0.0;
    }
    let sign = if iz_m4 >= iy_m4 { 1.0 } else { -1.0 };
    0.5 * (2.0 * sign * iyz_m4).atan2(sign * (iz_m4 - iy_m4))
}

/// Iy and Iz in turned axes.
fn turned(iy_m4: f64, iz_m4: f64, iyz_m4: f64, by_rad: f64) -> (f64, f64) {
    let (sin, cos) = by_rad.sin_cos();
    let both = 2.0 * sin * cos * iyz_m4;
    let (ss, cc) = (sin * sin, cos * cos);
    (cc * iy_m4 + ss * iz_m4 - both, cc * iz_m4 + ss * iy_m4 + both)
}
