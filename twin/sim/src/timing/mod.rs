//! When the arm is where: a time law along a path within limits of speed, acceleration, jerk and
//! torque.
//!
//! The path is `q(s)`, joint values over a path parameter (m of TCP path, or any other that grows);
//! the law is `s(t)`. With `'` for d/ds and a dot for d/dt:
//!
//! ```text
//! dq/dt   = q' ṡ
//! d²q/dt² = q' s̈ + q'' ṡ²
//! d³q/dt³ = q' s⃛ + 3 q'' ṡ s̈ + q''' ṡ³
//! torque  = M(q) d²q/dt² + … = a(s) s̈ + b(s) ṡ² + c(s)
//! ```
//!
//! | step | file | what |
//! |---|---|---|
//! | path | `course`, `spline` | samples to a curve with continuous `q''`; corners rounded or stopped at |
//! | constraints | `grid` | the path cut into cells, limits as linear forms in `s̈` and `ṡ²` |
//! | speed | `phase` | backward and forward pass through the phase plane `(s, ṡ²)` |
//! | jerk | `smooth` | S-curves: the running mean over time of a law whose ceilings are widened first |
//! | proof | `measure` | every limit looked at along the finished law; cells that exceed are slowed, the rest is scaled |
//!
//! Sources: J. E. Bobrow, S. Dubowsky, J. S. Gibson, "Time-optimal control of robotic manipulators
//! along specified paths", IJRR 4(3), 1985 (phase plane); H. Pham, Q.-C. Pham, "A new approach to
//! time-optimal path parameterization based on reachability analysis", IEEE T-RO 34(3), 2018 (the
//! two passes, both ends of a cell); L. Biagiotti, C. Melchiorri, "Trajectory Planning for Automatic
//! Machines and Robots", Springer 2008, 3.4 and 4.5 (S-curves, as trapezoids through a running mean).

mod course;
mod given;
mod grid;
mod law;
mod limits;
mod measure;
mod phase;
mod profile;
mod smooth;
mod spline;
#[cfg(test)]
mod tests;

pub use course::Rounding;
pub use given::follow_times;
pub use law::{Law, Passing, State, time_law};
pub use limits::{Limits, Torque, TorqueLaw, TorqueRow};
pub use measure::{Bound, Peaks};

use crate::kinematics::Posture;

/// A sample of the path.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Station {
    /// Path parameter, m of TCP path or any other that does not fall.
    pub s: f64,
    /// Joint values, rad or m.
    pub q: Posture,
    /// Largest ds/dt asked from here to the next station, m/s; infinite: none asked.
    pub ceiling: f64,
    /// The arm must come to rest here.
    pub stop: bool,
    /// The tangent jumps here.
    pub corner: bool,
}

/// Why there is no time law; stations and joints count from zero.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
pub enum Fault {
    /// No station at all.
    #[error("a path without stations")]
    Empty,
    /// A number of a station is not finite.
    #[error("station {station}: not a number")]
    NotFinite {
        /// Index of the station.
        station: usize,
    },
    /// The joints of a station are not as many as those of the limits.
    #[error("station {station}: not as many joints as limits")]
    Joints {
        /// Index of the station.
        station: usize,
    },
    /// The path parameter falls.
    #[error("station {station}: the path runs backwards")]
    Backwards {
        /// Index of the station.
        station: usize,
    },
    /// The joints move while the path parameter stands still.
    #[error("station {station}: joints move while the path stands still")]
    Jump {
        /// Index of the station.
        station: usize,
    },
    /// The asked speed is not above zero.
    #[error("station {station}: asked speed is not above zero")]
    Ceiling {
        /// Index of the station.
        station: usize,
    },
    /// A limit is not above zero.
    #[error("a limit of joint {joint} is not above zero")]
    Limit {
        /// Index of the joint.
        joint: usize,
    },
    /// A limit on the path parameter is not above zero, or the rounding of corners is below zero.
    #[error("a limit along the path is not above zero")]
    PathLimit,
    /// Nothing bounds the acceleration: neither the path nor this joint has a limit.
    #[error("no acceleration known for joint {joint} nor along the path")]
    NoAcceleration {
        /// Index of the joint.
        joint: usize,
    },
    /// A joint lacks the torque to stand still on the path.
    #[error("joint {joint} lacks the torque to stand still at {s} on the path")]
    Weak {
        /// Index of the joint.
        joint: usize,
        /// Path parameter, as in the stations.
        s: f64,
    },
    /// No speed above zero was found on a stretch between two rests.
    #[error("no speed above zero found from {s} on the path on")]
    Stuck {
        /// Path parameter where the stretch begins, as in the stations.
        s: f64,
    },
    /// Times are not as many as stations, fall, or leave no time for a way.
    #[error("station {station}: no time given, or none left")]
    Times {
        /// Index of the station.
        station: usize,
    },
}
