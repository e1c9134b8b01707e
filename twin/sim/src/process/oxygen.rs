//! Oxygen against cure: induction, the tacky skin, light spent anew on a surface that saw air again.
//!
//! Oxygen is already inside a measured critical exposure (process-physics.md 1.1), so [`induction_s`] must not be
//! added to a gel time from a working curve; it is there to show what share of it oxygen is. What is added: a
//! skin that stays tacky ([`Oxygen::skin_m`], or 10–50 µm as given), and dose for surfaces that saw air in the
//! dark ([`Reoxygenation`]).

use std::f64::consts::PI;

/// Avogadro × Planck × speed of light, J m/mol.
const MOLAR_LIGHT_J_M_MOL: f64 = 0.119_626_566;

/// Damköhler number below which nothing cures in a film (Dendukuri 2008, process-physics.md 1.1).
pub const DAMKOHLER_ONSET: f64 = 4.0;

/// Oxygen in a resin under light.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Oxygen {
    /// Dissolved oxygen in air, mol/m³.
    pub dissolved_mol_m3: f64,
    /// Its diffusivity, m²/s.
    pub diffusivity_m2_s: f64,
    /// Radicals to a photon absorbed by the initiator.
    pub quantum_yield: f64,
    /// Penetration depth of the light, m: `1/(ε [PI])`, where the initiator is what absorbs.
    pub penetration_m: f64,
    /// Wavelength, m.
    pub wavelength_m: f64,
}

impl Oxygen {
    /// Dose that uses up the oxygen dissolved at the surface, J/m²: `[O2] E_hν Dp/φ`.
    ///
    /// 39 J/m² for PR48 (measured `Ec` 63), 142 for Formlabs Clear (126); six times `Ec` for VeroClear, so an
    /// upper bound where something besides the initiator lets little light be absorbed. Source: section 1.1.
    pub fn dose_j_m2(&self) -> f64 {
        self.dissolved_mol_m3 * MOLAR_LIGHT_J_M_MOL * self.penetration_m
            / (self.wavelength_m * self.quantum_yield)
    }

    /// Damköhler number of a film of thickness `H`: `Da = φ ε I [PI] H²/(D_O [O2])`, irradiance W/m².
    pub fn damkohler(&self, irradiance_w_m2: f64, thickness_m: f64) -> f64 {
        irradiance_w_m2 / self.dose_j_m2() * thickness_m * thickness_m / self.diffusivity_m2_s
    }

    /// Tacky skin on a surface in air, m: `δ = H (4/Da)^½ = 2 [D_O dose / I]^½`; the thickness cancels.
    ///
    /// `δ ~ Da^−½` is Dendukuri's; that the skin takes up the whole film at the onset `Da = 4` fixes our
    /// factor, unmeasured. 17 µm at 210 W/m² for Formlabs Clear, inside the 10–50 µm of the reference.
    pub fn skin_m(&self, irradiance_w_m2: f64) -> f64 {
        (DAMKOHLER_ONSET * self.diffusivity_m2_s * self.dose_j_m2() / irradiance_w_m2).sqrt()
    }

    /// What light on a surface costs that saw air again, through a skin of a thickness, m.
    pub fn reoxygenation(&self, skin_m: f64) -> Reoxygenation {
        let refill_s = PI * skin_m * skin_m / (4.0 * self.diffusivity_m2_s);
        Reoxygenation { dose_j_m2: self.dose_j_m2(), refill_s }
    }
}

/// Induction time, s: `τ_i = π/(4 Da)` in units of `H²/D_O`; inside the critical exposure already.
pub fn induction_s(damkohler: f64, thickness_m: f64, diffusivity_m2_s: f64) -> f64 {
    PI / (4.0 * damkohler) * thickness_m * thickness_m / diffusivity_m2_s
}

/// Dose that oxygen eats of the next light, once it has come back in the dark.
///
/// The first light of a history owes nothing, its oxygen is in the critical exposure.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Reoxygenation {
    /// Dose against a skin full of oxygen, J/m².
    pub dose_j_m2: f64,
    /// Time in air to fill the skin, s: `π δ²/(4 D_O)`, about 7 s for 30 µm.
    pub refill_s: f64,
}

impl Reoxygenation {
    /// Dose owed after a time in the dark, J/m²: what is still owed and `dose (t/refill)^½`, at most `dose`.
    ///
    /// The uptake of a half space, `2 (D t/π)^½ [O2]`, over what the skin holds; a skin fills a little slower
    /// towards the end, so this is an upper bound. A dose that is not positive owes nothing.
    pub fn owed_j_m2(&self, still_j_m2: f64, dark_s: f64) -> f64 {
        if !(self.dose_j_m2 > 0.0 && dark_s > 0.0) {
            return still_j_m2;
        }
        let filled = (dark_s / self.refill_s).sqrt().min(1.0);
        (still_j_m2 + self.dose_j_m2 * filled).min(self.dose_j_m2)
    }
}
