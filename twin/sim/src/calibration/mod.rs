//! What a few measured prints say about the material: fit, confidence, and which print would help most.
//!
//! The numbers that matter most are the least known: a factor of three in viscosity, of two in critical
//! exposure. [`fit`] takes the material's own ranges as what is known before, a handful of [`Measured`]
//! prints, and gives each [`Parameter`] its most probable value with a 90 % interval. Predictions are
//! those of [`crate::process`]; nothing here knows a law of its own but how a free end contracts.
//!
//! Cost: one `simulate` per strand, parameter and step; eight to thirty milliseconds for three strands.

mod fit;
mod known;
mod next;
mod predict;
mod prior;
#[cfg(test)]
mod tests;
#[cfg(test)]
mod tests_coverage;
#[cfg(test)]
mod tests_next;

pub use fit::{Fit, Fitted, MISFIT_SIGMAS, Residual, fit};
pub use known::{Known, Parameter};
pub use next::Next;
pub use predict::{Measured, Print, predicted_m};
