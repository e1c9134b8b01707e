//! One strand through all laws.

use crate::interval::Interval;

use super::bead::{cold_diameter_m, draw_ratio, drawn_diameter_m, overfeed_strain};
use super::cure::{
    cure_depth_m, set_distance_m, shell_area_fraction, shell_stiffness_fraction, uncured_core_m,
};
use super::heat::modulus_through_glass_pa;
use super::history::{Corner, clock_set_s, light_set_s};
use super::light::LightRing;
use super::material::{Material, Photopolymer, Setting, Thermoplastic};
use super::sag::{SetBeam, slack_sag_m};
use super::shrinkage::{self, CureRun, cooling_end_miss_m, free_strain};
use super::soft::nozzle_sag;
use super::tait::{Tait, TaitBranch};
use super::thermal::{Heat, heat};

/// How much is computed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Fidelity {
    /// Closed forms alone; microseconds.
    ClosedForms,
    /// Heat through the radius; what a [`super::Course`] adds is in [`super::along`].
    Full,
}

/// A strand as it is printed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StrandInput {
    /// How much is computed.
    pub fidelity: Fidelity,
    /// Length of the whole strand, m.
    pub length_m: f64,
    /// Longest unsupported span: between joined ends, or from the last hold to the free end, m.
    pub span_m: f64,
    /// Speed of the nozzle, m/s.
    pub speed_m_s: f64,
    /// Flow out of the nozzle, m³/s.
    pub flow_m3_s: f64,
    /// Bore of the nozzle, m.
    pub nozzle_diameter_m: f64,
    /// Diameter of a free strand over the bore.
    pub swell: Interval,
    /// Largest component of gravity across the strand, m/s².
    pub gravity_across_m_s2: f64,
    /// What holds it.
    pub ends: Ends,
    /// Volume between the mixer of a two-part resin and the orifice, m³; zero where unknown.
    pub mixer_m3: f64,
    /// Time the nozzle waits at the end, s.
    pub dwell_s: f64,
    /// The air around it.
    pub air: Air,
    /// The light on it.
    pub light: Option<LightRing>,
}

/// What holds a strand.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Ends {
    /// Joined at both ends.
    BothHeld,
    /// Joined where it begins; the far end is free when the nozzle leaves.
    StartHeld,
    /// Lies on bed or form.
    Resting,
}

impl StrandInput {
    /// Diameter as drawn, m.
    pub fn hot_diameter_m(&self) -> f64 {
        drawn_diameter_m(self.flow_m3_s, self.speed_m_s)
    }
}

/// The air around a strand.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Air {
    /// Its temperature, K.
    pub temperature_k: f64,
    /// Draught in the room, m/s.
    pub room_m_s: f64,
    /// The jet that travels with the nozzle.
    pub jet: Option<Jet>,
    /// Jets told one by one.
    pub blown: Option<Blown>,
}

impl Air {
    /// Length behind the nozzle that jets reach, m; zero where there are none.
    pub fn jet_reach_m(&self) -> f64 {
        match (&self.jet, &self.blown) {
            (Some(jet), _) => jet.reach_m,
            (None, Some(blown)) => blown.reach_m,
            (None, None) => 0.0,
        }
    }

    /// Speed of the air across the strand at a distance behind the nozzle, m/s.
    pub fn speed_m_s(&self, behind_m: f64, corner: Corner) -> f64 {
        let jet_m_s = match (&self.jet, &self.blown) {
            (Some(jet), _) if behind_m <= jet.reach_m => corner.helpful(jet.speed_m_s),
            (None, Some(blown)) => blown.at_m_s(behind_m) * corner.helpful(blown.share),
            _ => 0.0,
        };
        jet_m_s.max(self.room_m_s)
    }

    /// Mean speed of the jets over their reach, m/s.
    pub fn mean_jet_m_s(&self, corner: Corner) -> f64 {
        const PLACES: u32 = 16;
        let step_m = self.jet_reach_m() / f64::from(PLACES);
        let speed = |k: u32| self.speed_m_s(step_m * (f64::from(k) + 0.5), corner);
        (0..PLACES).map(speed).sum::<f64>() / f64::from(PLACES)
    }
}

/// Air speed across a strand behind the nozzle, of jets told one by one.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Blown {
    /// Length behind the nozzle to which it is told, m.
    pub reach_m: f64,
    /// Speed at even places from the nozzle to there, m/s, nominal.
    pub speeds_m_s: [f64; 40],
    /// What the speeds may be over that.
    pub share: Interval,
}

impl Blown {
    /// Nominal speed at a distance behind the nozzle, m/s; nothing beyond the reach.
    pub fn at_m_s(&self, behind_m: f64) -> f64 {
        let last = self.speeds_m_s.len() - 1;
        let place = behind_m / self.reach_m * last as f64;
        if !(place >= 0.0 && place <= last as f64) {
            return 0.0;
        }
        let k = (place as usize).min(last - 1);
        let share = place - k as f64;
        self.speeds_m_s[k] + (self.speeds_m_s[k + 1] - self.speeds_m_s[k]) * share
    }
}

/// A jet of air that travels with the nozzle.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Jet {
    /// Speed at the strand, m/s.
    pub speed_m_s: Interval,
    /// Length of strand behind the nozzle that it reaches, m.
    pub reach_m: f64,
}

/// What becomes of a strand.
#[derive(Debug, Clone, PartialEq)]
pub struct StrandOutcome {
    /// Diameter once set, m.
    pub bead_diameter_m: Interval,
    /// Diameter as drawn, m.
    pub hot_diameter_m: f64,
    /// Nozzle speed over the speed of a free strand.
    pub draw_ratio: Interval,
    /// Age at which it is set (thermoplastic: flow arrest), s; infinite if it never is.
    pub set_time_s: Interval,
    /// How far behind the nozzle that is, m; infinite if never.
    pub set_distance_m: Interval,
    /// Sag A, behind the nozzle, m.
    pub sag_nozzle_m: Interval,
    /// Whether sag A is inside linear theory at its nominal value.
    pub sag_linear: bool,
    /// Sag B, of a strand longer than its chord, m.
    pub sag_slack_m: Interval,
    /// Sag C, of the set strand under its own weight, m; infinite where nothing is set and
    /// both ends are held.
    pub sag_set_m: Interval,
    /// How far the end is pulled back after the nozzle has left it, m.
    pub end_miss_m: Interval,
    /// Shortening still to come of the whole strand when the nozzle leaves, were its end free, m.
    pub shortening_m: Interval,
    /// Radius left uncured, m; photopolymers only.
    pub uncured_core_m: Option<Interval>,
    /// Depth cured from the surface, m; photopolymers only.
    pub cured_depth_m: Option<Interval>,
    /// Share of the area that is solid.
    pub area_fraction: Interval,
    /// Share of the bending stiffness that is solid.
    pub stiffness_fraction: Interval,
    /// Young's modulus of what is solid, at air temperature, Pa.
    pub youngs_modulus_pa: Interval,
    /// Linear strain it still wants to lose once set; positive is shorter.
    pub free_strain: Interval,
    /// Laws used.
    pub laws: Vec<&'static str>,
}

/// One strand through all laws; deterministic, microseconds.
///
/// Intervals are corners, all adverse inputs together (no probability is meant): those of
/// [`nozzle_sag`] for sag A; swell and contraction for B; modulus, density, cured shell and end fixity
/// (clamped to hinged) for C; expansion, set temperature and cooling, or shrinkage and gel time, for the
/// end miss; penetration, critical exposure and lamp for the shell. Inputs out of their domain (speed or flow not positive)
/// give numbers that are not finite, never a panic.
pub fn simulate(input: &StrandInput, material: &Material) -> StrandOutcome {
    simulate_with(input, material, &Heats::new(input, material))
}

/// The same with the temperatures of [`Heats::new`] made before.
pub fn simulate_with(input: &StrandInput, material: &Material, heats: &Heats) -> StrandOutcome {
    let hot_m = drawn_diameter_m(input.flow_m3_s, input.speed_m_s);
    let fresh = material.fresh_density_kg_m3();
    let bead_diameter_m = match material.setting {
        Setting::TwoPart(_) => Interval::exact(hot_m),
        Setting::Thermoplastic(_) | Setting::Photopolymer(_) => {
            let set = material.density_kg_m3;
            Interval::new(
                cold_diameter_m(hot_m, fresh.nominal, set.nominal),
                cold_diameter_m(hot_m, fresh.low, set.high),
                cold_diameter_m(hot_m, fresh.high, set.low),
            )
        }
    };
    let ratio =
        |swell| draw_ratio(input.flow_m3_s, input.speed_m_s, input.nozzle_diameter_m, swell);
    let draw_ratio = input.swell.map(ratio);
    let set_time_s = set_time_s(input, material, heats);
    let sag = nozzle_sag(input, material, heats);
    let free_strain = free_strain(material, input.air.temperature_k);
    let shell = shell(input, material, bead_diameter_m.nominal / 2.0);
    let youngs_modulus_pa = set_modulus_pa(input, material);
    let stiffness = Interval {
        nominal: youngs_modulus_pa.nominal * shell.stiffness.nominal,
        low: youngs_modulus_pa.low * shell.stiffness.low,
        high: youngs_modulus_pa.high * shell.stiffness.high,
    };
    let shortening_m =
        Corner::interval(|corner| shortening_at(input, material, heats, input.dwell_s, corner));
    StrandOutcome {
        bead_diameter_m,
        hot_diameter_m: hot_m,
        draw_ratio,
        set_time_s,
        set_distance_m: set_time_s.map(|time_s| set_distance_m(0.0, input.speed_m_s, time_s)),
        sag_nozzle_m: sag.offset_m,
        sag_linear: sag.linear,
        sag_slack_m: slack_m(input, draw_ratio, free_strain),
        sag_set_m: sag_set_m(input, material, bead_diameter_m.nominal, stiffness),
        end_miss_m: end_miss_m(input, shortening_m),
        shortening_m,
        uncured_core_m: shell.core_m,
        cured_depth_m: shell.depth_m,
        area_fraction: shell.area,
        stiffness_fraction: shell.stiffness,
        youngs_modulus_pa,
        free_strain,
        laws: laws(input, material),
    }
}

/// Temperature against age at all corners, each made once; none but of a thermoplastic.
#[derive(Debug, Clone, PartialEq)]
pub struct Heats(Option<[Heat; 3]>);

impl Heats {
    /// Of a strand.
    pub fn new(input: &StrandInput, material: &Material) -> Self {
        let Setting::Thermoplastic(plastic) = &material.setting else { return Self(None) };
        let corners = [Corner::Nominal, Corner::Fast, Corner::Slow];
        Self(Some(corners.map(|corner| heat(input, material, plastic, corner))))
    }

    /// At a corner; `None`: no thermoplastic.
    pub fn at(&self, corner: Corner) -> Option<&Heat> {
        self.0.as_ref().map(|heats| match corner {
            Corner::Nominal => &heats[0],
            Corner::Fast => &heats[1],
            Corner::Slow => &heats[2],
        })
    }
}

fn set_time_s(input: &StrandInput, material: &Material, heats: &Heats) -> Interval {
    Corner::interval(|corner| match &material.setting {
        Setting::Thermoplastic(plastic) => heats
            .at(corner)
            .map_or(f64::INFINITY, |heat| heat.time_to_s(corner.helpful(plastic.flow_arrest_k))),
        Setting::Photopolymer(resin) => light_set_s(input, resin, corner),
        Setting::TwoPart(mix) => clock_set_s(input, mix, corner),
    })
}

fn slack_m(input: &StrandInput, draw_ratio: Interval, free_strain: Interval) -> Interval {
    if input.ends != Ends::BothHeld {
        return Interval::exact(0.0);
    }
    let sag = |ratio, strain| slack_sag_m(input.span_m, overfeed_strain(ratio) - strain);
    Interval::new(
        sag(draw_ratio.nominal, free_strain.nominal),
        sag(draw_ratio.high, free_strain.high),
        sag(draw_ratio.low, free_strain.low),
    )
}

fn set_modulus_pa(input: &StrandInput, material: &Material) -> Interval {
    let set = material.youngs_modulus_pa;
    let Setting::Thermoplastic(plastic) = &material.setting else { return set };
    Corner::interval(|corner| {
        modulus_through_glass_pa(
            corner.helpful(set),
            corner.helpful(plastic.plateau_modulus_pa),
            input.air.temperature_k,
            corner.helpful(plastic.glass_k),
        )
    })
}

/// Solid part of the section.
struct Shell {
    area: Interval,
    stiffness: Interval,
    core_m: Option<Interval>,
    depth_m: Option<Interval>,
}

fn shell(input: &StrandInput, material: &Material, radius_m: f64) -> Shell {
    let Setting::Photopolymer(resin) = &material.setting else {
        let whole = Interval::exact(1.0);
        return Shell { area: whole, stiffness: whole, core_m: None, depth_m: None };
    };
    let depth = Corner::interval(|corner| depth_m(input, resin, corner));
    let under_skin = |share: fn(f64, f64) -> f64| {
        Corner::interval(|corner| {
            let skin_m = resin.tacky_skin_m.map_or(0.0, |skin_m| corner.harmful(skin_m));
            let left = share(corner.helpful(depth), radius_m) - share(skin_m, radius_m);
            if left < 0.0 { 0.0 } else { left }
        })
    };
    Shell {
        area: under_skin(shell_area_fraction),
        stiffness: under_skin(shell_stiffness_fraction),
        core_m: Some(depth.map(|d| uncured_core_m(d, radius_m))),
        depth_m: Some(depth),
    }
}

/// Depth cured once the ring has passed, m; a dwell adds nothing but at the end and is left out.
fn depth_m(input: &StrandInput, resin: &Photopolymer, corner: Corner) -> f64 {
    let Some(ring) = input.light else { return 0.0 };
    let dose = ring.dose_j_m2(corner.helpful(ring.intensity_w_sr), input.speed_m_s);
    let critical = corner.harmful(resin.critical_exposure_j_m2);
    cure_depth_m(corner.helpful(resin.penetration_m), dose, critical)
}

fn sag_set_m(
    input: &StrandInput,
    material: &Material,
    diameter_m: f64,
    stiffness_pa: Interval,
) -> Interval {
    let beam = |corner: Corner| SetBeam {
        diameter_m,
        density_kg_m3: corner.harmful(material.density_kg_m3),
        across_m_s2: input.gravity_across_m_s2,
        youngs_modulus_pa: corner.helpful(stiffness_pa),
    };
    match input.ends {
        Ends::Resting => Interval::exact(0.0),
        Ends::StartHeld => Corner::interval(|corner| beam(corner).heavy_cantilever_m(input.span_m)),
        Ends::BothHeld => Corner::interval(|corner| match corner {
            Corner::Nominal | Corner::Fast => beam(corner).clamped_m(input.span_m),
            Corner::Slow => beam(corner).simply_supported_m(input.span_m),
        }),
    }
}

/// Pull-back of the end: the shortening where it is free. Held or resting: nominally none, since what it is
/// joined to holds it and the strain becomes force; the high end is that of a free one.
fn end_miss_m(input: &StrandInput, shortening_m: Interval) -> Interval {
    match input.ends {
        Ends::StartHeld => shortening_m,
        Ends::BothHeld | Ends::Resting => {
            Interval { nominal: 0.0, low: 0.0, high: shortening_m.high }
        }
    }
}

/// Linear expansion below the glass transition, 1/K: the material's number; at the slow corner that of Tait's equation if
/// greater, which sees the step just below the transition (ABS: 118e-6 against 88e-6).
fn expansion_per_k(
    material: &Material,
    plastic: &Thermoplastic,
    air_k: f64,
    corner: Corner,
) -> f64 {
    let told = corner.harmful(material.cte_per_k);
    let Some(law) = plastic.tait.filter(|_| corner == Corner::Slow) else { return told };
    let branch = |[b1, b2, b3, b4]: [f64; 4]| TaitBranch {
        b1_m3_kg: b1,
        b2_m3_kgk: b2,
        b3_pa: b3,
        b4_per_k: b4,
    };
    let tait = Tait {
        b5_k: law.b5_k,
        b6_k_pa: law.b6_k_pa,
        melt: branch(law.melt),
        solid: branch(law.solid),
    };
    let solid_k = plastic.glass_k.nominal.min(tait.transition_k(0.0));
    let strain = tait.linear_strain(air_k, solid_k).abs() / (solid_k - air_k);
    if strain.is_finite() { told.max(strain) } else { told }
}

/// Shortening still to come after a wait at the end, m, at a corner; by the law of the setting.
pub fn shortening_at(
    input: &StrandInput,
    material: &Material,
    heats: &Heats,
    dwell_s: f64,
    corner: Corner,
) -> f64 {
    let (length_m, speed_m_s) = (input.length_m, input.speed_m_s);
    match &material.setting {
        Setting::Thermoplastic(plastic) => {
            let glass_k = corner.harmful(plastic.glass_k);
            let expansion = expansion_per_k(material, plastic, input.air.temperature_k, corner);
            match heats.at(corner) {
                Some(Heat::Lumped(cooling)) => {
                    cooling_end_miss_m(expansion, glass_k, cooling, length_m, speed_m_s, dwell_s)
                }
                Some(heat) => {
                    let printed_s = length_m / speed_m_s;
                    let air_k = input.air.temperature_k;
                    let stations = [(0.0, 0.0), (length_m, printed_s)];
                    shrinkage::end_miss_m(&stations, printed_s + dwell_s, |age_s| {
                        expansion * (heat.temperature_k(age_s).min(glass_k) - air_k)
                    })
                }
                None => 0.0,
            }
        }
        Setting::Photopolymer(resin) => {
            light_run(input, resin, corner).end_miss_m(length_m, speed_m_s, dwell_s)
        }
        Setting::TwoPart(mix) => {
            let gel_s = clock_set_s(input, mix, corner);
            let strain = corner.harmful(mix.linear_shrinkage);
            CureRun { strain, shadow_m: 0.0, gel_s, done_s: 2.0 * gel_s }
                .end_miss_m(length_m, speed_m_s, dwell_s)
        }
    }
}

fn light_run(input: &StrandInput, resin: &Photopolymer, corner: Corner) -> CureRun {
    let shadow_m = input.light.map_or(0.0, |ring| ring.shadow_m);
    let gel_s = light_set_s(input, resin, corner) - shadow_m / input.speed_m_s;
    let lit_s = input.light.map_or(0.0, |ring| ring.lit_length_m()) / input.speed_m_s;
    CureRun { strain: corner.harmful(resin.linear_shrinkage), shadow_m, gel_s, done_s: lit_s }
}

fn laws(input: &StrandInput, material: &Material) -> Vec<&'static str> {
    let mut laws = vec!["mass balance", "draw ratio and swell"];
    match &material.setting {
        Setting::Thermoplastic(_) => laws.extend([
            "Churchill-Chu natural convection",
            "Churchill-Bernstein cross flow",
            "radiation",
            "lumped cooling with radial resistance",
            "Cross-WLF zero-shear viscosity",
            "shrinkage by expansion below the glass transition",
        ]),
        Setting::Photopolymer(resin) => {
            laws.extend(["ring irradiance", "Jacobs cure depth", "shrinkage past the gel point"]);
            if resin.tacky_skin_m.is_some() {
                laws.push("tacky skin carries nothing");
            }
            if input.ends != Ends::Resting {
                laws.extend(gel_laws(resin));
            }
        }
        Setting::TwoPart(mix) => {
            laws.push("set time");
            if mix.activation_j_mol.is_some() && mix.reference_k.is_some() {
                laws.extend(["residence in the mixer", "Arrhenius clock"]);
            }
            laws.push("shrinkage past the gel point");
        }
    }
    let gel = matches!(material.setting, Setting::Photopolymer(_));
    if input.ends != Ends::Resting && !gel {
        laws.push("viscous beam behind the nozzle");
    }
    match input.ends {
        Ends::BothHeld => laws.extend(["slack parabola", "elastic self-weight"]),
        Ends::StartHeld => laws.push("elastic cantilever"),
        Ends::Resting => {}
    }
    laws
}

/// Laws of a gel behind the nozzle.
fn gel_laws(resin: &Photopolymer) -> &'static [&'static str] {
    if resin.flow.is_none() {
        return &["Bingham beam behind the nozzle", "Bingham shear behind the nozzle"];
    }
    &[
        "Herschel-Bulkley beam behind the nozzle",
        "Herschel-Bulkley shear behind the nozzle",
        "gel recovery after the nozzle (slow corner)",
    ]
}
