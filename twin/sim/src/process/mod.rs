//! What the process makes of a strand: bead, heat or light, setting, sag, shrinkage.
//!
//! One file to a law; [`strand`] puts the closed forms together, [`fed`], [`lit`] and [`soft_rod`] follow a
//! strand along its [`course`]. Everything depends on the age of a section, the time since it left the nozzle.
//! Reference: `process-physics.md`; what it calls not established is not claimed here, and uncertain inputs come
//! out as intervals.
//!
//! | what | files |
//! | --- | --- |
//! | flow in, bead out | `drive`, `feed`, `fed`, `bead`, `coiling`, `section`, `threads` |
//! | heat | `heat`, `air_side`, `jet`, `radial` and `cooled`, `thermal`, `reheat`, `tait`, `viscosity` |
//! | light | `lamp`, `shade`, `lights`, `dose` (with `sweep`, `steps`, `reach`, `memo`, `irradiance`), `through`, `bed_light`, `lit`; a ring by formula: `light`, `cure` |
//! | resins | `kamal`, `kinetics`, `cured`, `warming`, `lit_cure`, `oxygen`, `solid`, `clock`, `gel`, `yield_stress`, `tube`, `plastic_bending` |
//! | sag | `sag`, `gel_sag`, `soft`, `rod` and `soft_rod`, `stretch`, `corotational`, `elastica`, `angle` |
//! | joints, shrinkage | `contact`, `healing`, `shrinkage`, `age_samples` |

pub mod age_samples;
pub mod air_side;
pub mod angle;
pub mod bead;
pub mod bed_light;
pub mod clock;
pub mod coiling;
pub mod contact;
pub mod cooled;
pub mod corotational;
pub mod course;
pub mod cure;
mod cure_piece;
pub mod cured;
pub mod dose;
pub mod drive;
pub mod elastica;
pub mod fed;
pub mod feed;
pub mod gel;
pub mod gel_sag;
pub mod healing;
pub mod heat;
pub mod history;
mod irradiance;
pub mod jet;
pub mod kamal;
pub mod kinetics;
pub mod lamp;
pub mod light;
pub mod lights;
pub mod lit;
pub mod lit_cure;
pub mod material;
mod memo;
pub mod oxygen;
pub mod plastic_bending;
pub mod radial;
mod reach;
pub mod reheat;
pub mod rod;
pub mod sag;
pub mod section;
pub mod shade;
pub mod shrinkage;
pub mod soft;
pub mod soft_rod;
pub mod solid;
mod steps;
pub mod strand;
pub mod stretch;
mod sweep;
pub mod tait;
pub mod thermal;
pub mod threads;
pub mod through;
pub mod tube;
pub mod viscosity;
pub mod warming;
pub mod yield_stress;

pub use course::{Course, Station, Told};
pub use history::History;
pub use light::LightRing;
pub use material::{
    GelFlow, HeatLaw, KineticsLaw, Material, OxygenLaw, Photopolymer, Setting, TaitLaw,
    Thermoplastic, TwoPart, WeldLaw,
};
pub use strand::{
    Air, Blown, Ends, Fidelity, Heats, Jet, StrandInput, StrandOutcome, simulate, simulate_with,
};
pub use viscosity::CrossWlf;

#[cfg(test)]
mod reference;
#[cfg(test)]
mod tests;
#[cfg(test)]
mod tests_bead;
#[cfg(test)]
mod tests_clock;
#[cfg(test)]
mod tests_course;
#[cfg(test)]
mod tests_cured;
#[cfg(test)]
mod tests_dose;
#[cfg(test)]
mod tests_feed;
#[cfg(test)]
mod tests_gel;
#[cfg(test)]
mod tests_gel_corners;
#[cfg(test)]
mod tests_heat;
#[cfg(test)]
mod tests_kinetics;
#[cfg(test)]
mod tests_lamp;
#[cfg(test)]
mod tests_rods;
#[cfg(test)]
mod tests_sag;
#[cfg(test)]
mod tests_section;
#[cfg(test)]
mod tests_solid;
#[cfg(test)]
mod tests_strand;
#[cfg(test)]
mod tests_thermal_anchor;
#[cfg(test)]
mod tests_threads;
#[cfg(test)]
mod tests_through;
#[cfg(test)]
mod tests_yield;
