//! The twin: what a planned print will do, computed before the robot moves.
//!
//! [`preflight::preflight`] is the one entry and reads as the path of the data. No module here
//! does IO, looks at a clock, prints, or hides randomness. Which module may use which is a table
//! in the tidy test of the `tests` package.

pub mod aftermath;
pub mod calibration;
pub mod cell;
pub mod clearance;
pub mod collision;
pub mod deposit;
pub mod dynamics;
pub mod film;
pub mod finding;
pub mod growth;
pub mod interval;
pub mod kinematics;
pub mod motion;
pub mod parry;
pub mod pose;
pub mod preflight;
pub mod process;
pub mod program;
pub mod scene;
pub mod shape;
pub mod structure;
#[cfg(test)]
mod test_job;
pub mod timing;
pub mod toolpath;
pub mod validation;
