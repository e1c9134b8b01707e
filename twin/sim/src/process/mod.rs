//! What the process makes of a strand: bead, heat or light, setting, sag, shrinkage.
//!
//! One file to a law; [`strand`] puts them together for one strand. Everything depends on the age of a
//! section, the time since it left the nozzle. Reference: `process-physics.md`; what it calls not
//! established is not claimed here, and uncertain inputs come out as intervals.

pub mod angle;
pub mod bead;
pub mod corotational;
pub mod cure;
pub mod elastica;
pub mod gel;
pub mod heat;
pub mod history;
pub mod light;
pub mod material;
pub mod rod;
pub mod sag;
pub mod shrinkage;
pub mod soft;
pub mod strand;
pub mod stretch;
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
mod tests_heat;
#[cfg(test)]
mod tests_sag;
#[cfg(test)]
mod tests_strand;
