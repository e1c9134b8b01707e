//! A material file in SI; its numbers are in SI already, save temperatures.

use slam::material_file::{MaterialFile, Number, SettingFile};

use crate::interval::Interval;
use crate::process::{CrossWlf, Material, Photopolymer, Setting, Thermoplastic, TwoPart};

/// The material of a file, in SI.
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
        } => Setting::Photopolymer(Photopolymer {
            gel_density_kg_m3: interval(gel_density_kg_m3),
            base_viscosity_pa_s: interval(base_viscosity_pa_s),
            yield_stress_pa: interval(yield_stress_pa),
            penetration_m: interval(penetration_m),
            critical_exposure_j_m2: interval(critical_exposure_j_m2),
            gel_modulus_pa: interval(gel_modulus_pa),
            cured_modulus_pa: interval(cured_modulus_pa),
            linear_shrinkage: interval(linear_shrinkage),
        }),
        SettingFile::TwoPart { set_time_s, viscosity_pa_s, linear_shrinkage } => {
            Setting::TwoPart(TwoPart {
                set_time_s: interval(set_time_s),
                viscosity_pa_s: interval(viscosity_pa_s),
                linear_shrinkage: interval(linear_shrinkage),
            })
        }
    }
}

fn interval(number: &Number) -> Interval {
    Interval::new(number.value, number.low, number.high)
}

fn kelvin(celsius: &Number) -> Interval {
    interval(celsius).plus(Interval::exact(273.15))
}
