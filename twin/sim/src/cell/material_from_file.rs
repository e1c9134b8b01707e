//! A material file in SI; its numbers are in SI already, save temperatures.

use slam::material_file::{MaterialFile, Number, SettingFile};

use crate::interval::Interval;
use crate::process::{
    CrossWlf, GelFlow, HeatLaw, KineticsLaw, Material, OxygenLaw, Photopolymer, Setting, TaitLaw,
    Thermoplastic, TwoPart, WeldLaw,
};

/// The material of a file.
pub fn material(file: &MaterialFile) -> Material {
    Material {
        name: file.name.clone(),
        density_kg_m3: interval(&file.density_kg_m3),
        youngs_modulus_pa: interval(&file.youngs_modulus_pa),
        poisson: interval(&file.poisson),
        strength_pa: interval(&file.strength_pa),
        bond_fraction: interval(&file.bond_fraction),
        cte_per_k: interval(&file.cte_per_k),
        cp_j_kgk: interval(&file.cp_j_kgk),
        k_w_mk: interval(&file.k_w_mk),
        emissivity: interval(&file.emissivity),
        setting: setting(&file.setting),
    }
}

fn setting(file: &SettingFile) -> Setting {
    match file {
        SettingFile::Thermoplastic {
            extrusion_c,
            melt_density_kg_m3,
            glass_c,
            flow_arrest_c,
            viscosity,
            plateau_modulus_pa,
            heat,
            tait,
            weld,
            surface_tension_n_m,
            melt_life_s,
        } => Setting::Thermoplastic(Thermoplastic {
            extrusion_k: kelvin(extrusion_c),
            melt_density_kg_m3: interval(melt_density_kg_m3),
            glass_k: kelvin(glass_c),
            flow_arrest_k: kelvin(flow_arrest_c),
            viscosity: CrossWlf {
                d1_pa_s: viscosity.d1_pa_s,
                t_star_k: viscosity.t_star_k,
                a1: viscosity.a1,
                a2_k: viscosity.a2_k,
                factor: Interval::new(1.0, viscosity.factor_low, viscosity.factor_high),
            },
            plateau_modulus_pa: interval(plateau_modulus_pa),
            heat: heat.as_ref().map(|law| HeatLaw {
                cp: [law.cp0_j_kgk, law.cp1_j_kgk2],
                k: [law.k0_w_mk, law.k1_w_mk2],
            }),
            tait: tait.as_ref().map(|law| TaitLaw {
                b5_k: law.b5_k,
                b6_k_pa: law.b6_k_pa,
                melt: law.melt,
                solid: law.solid,
            }),
            weld: weld.as_ref().map(|law| WeldLaw {
                a_s: law.a_s,
                q_j_mol: law.q_j_mol,
                factor: Interval::new(1.0, law.factor_low, law.factor_high),
            }),
            surface_tension_n_m: surface_tension_n_m.as_ref().map(interval),
            melt_life_s: melt_life_s.as_ref().map(interval),
        }),
        SettingFile::Photopolymer {
            gel_density_kg_m3,
            base_viscosity_pa_s,
            yield_stress_pa,
            penetration_m,
            critical_exposure_j_m2,
            gel_modulus_pa,
            cured_modulus_pa,
            linear_shrinkage,
            kinetics,
            reaction_heat_j_kg,
            exposure_activation_j_mol,
            tacky_skin_m,
            oxygen,
            consistency_pa_sn,
            flow_index,
            recovery_s,
            surface_tension_n_m,
        } => Setting::Photopolymer(Photopolymer {
            gel_density_kg_m3: interval(gel_density_kg_m3),
            base_viscosity_pa_s: interval(base_viscosity_pa_s),
            yield_stress_pa: interval(yield_stress_pa),
            penetration_m: interval(penetration_m),
            critical_exposure_j_m2: interval(critical_exposure_j_m2),
            gel_modulus_pa: interval(gel_modulus_pa),
            cured_modulus_pa: interval(cured_modulus_pa),
            linear_shrinkage: interval(linear_shrinkage),
            kinetics: kinetics.as_ref().map(|law| KineticsLaw {
                m: law.m,
                n: law.n,
                b: law.b,
                k2_over_k1: law.k2_over_k1,
                measured_at_w_m2: law.measured_at_w_m2,
                gel: law.gel,
                max: law.max,
            }),
            reaction_heat_j_kg: reaction_heat_j_kg.as_ref().map(interval),
            exposure_activation_j_mol: exposure_activation_j_mol.as_ref().map(interval),
            tacky_skin_m: tacky_skin_m.as_ref().map(interval),
            oxygen: oxygen.as_ref().map(|law| OxygenLaw {
                dissolved_mol_m3: law.dissolved_mol_m3,
                diffusivity_m2_s: law.diffusivity_m2_s,
                quantum_yield: law.quantum_yield,
                wavelength_m: law.wavelength_m,
            }),
            flow: gel_flow(consistency_pa_sn, flow_index, recovery_s),
            surface_tension_n_m: surface_tension_n_m.as_ref().map(interval),
        }),
        SettingFile::TwoPart {
            set_time_s,
            activation_j_mol,
            reference_k,
            viscosity_pa_s,
            linear_shrinkage,
            pot_life_s,
        } => Setting::TwoPart(TwoPart {
            set_time_s: interval(set_time_s),
            activation_j_mol: activation_j_mol.as_ref().map(interval),
            reference_k: *reference_k,
            viscosity_pa_s: interval(viscosity_pa_s),
            linear_shrinkage: interval(linear_shrinkage),
            pot_life_s: pot_life_s.as_ref().map(interval),
        }),
    }
}

/// The law of a flowing gel, where all of it is known.
fn gel_flow(
    consistency_pa_sn: &Option<Number>,
    index: &Option<Number>,
    recovery_s: &Option<Number>,
) -> Option<GelFlow> {
    Some(GelFlow {
        consistency_pa_sn: interval(consistency_pa_sn.as_ref()?),
        index: interval(index.as_ref()?),
        recovery_s: interval(recovery_s.as_ref()?),
    })
}

fn interval(number: &Number) -> Interval {
    Interval::new(number.value, number.low, number.high)
}

fn kelvin(celsius: &Number) -> Interval {
    interval(celsius).plus(Interval::exact(273.15))
}
