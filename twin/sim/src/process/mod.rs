//! What the process makes of a strand: bead, heat or light, setting, sag, shrinkage.
//!
//! One file to a law; [`strand`] puts them together for one strand. Everything depends on the age of a
//! section, the time since it left the nozzle. Reference: `process-physics.md`; what it calls not
//! established is not claimed here, and uncertain inputs come out as intervals.

pub mod bead;
pub mod bed_light;
pub mod cure;
pub mod dose;
pub mod elastica;
pub mod gel;
pub mod heat;
pub mod history;
mod irradiance;
pub mod lamp;
pub mod light;
pub mod lights;
pub mod material;
mod memo;
mod reach;
pub mod sag;
pub mod shade;
pub mod shrinkage;
pub mod soft;
mod steps;
pub mod strand;
mod sweep;
pub mod through;
pub mod viscosity;

pub use history::History;
pub use light::LightRing;
pub use material::{Material, Photopolymer, Setting, Thermoplastic, TwoPart};
pub use strand::{Air, Ends, Jet, StrandInput, StrandOutcome, simulate};
pub use viscosity::CrossWlf;

#[cfg(test)]
mod reference;
#[cfg(test)]
mod tests;
#[cfg(test)]
mod tests_dose;
#[cfg(test)]
mod tests_heat;
#[cfg(test)]
mod tests_lamp;
#[cfg(test)]
mod tests_sag;
#[cfg(test)]
mod tests_strand;
#[cfg(test)]
mod tests_through;
