//! What stands in the room and what is to be printed: everything resolved, in SI, unchanging.

mod equipment;
mod equipment_from_files;
mod job;
mod machine;
mod machine_from_files;
mod material_from_file;
mod resolve;
#[cfg(test)]
mod tests;

pub use equipment::{Calibration, Controller, Hose, LinearMove, PoseError};
pub use job::{
    Air, At, End, Event, Flow, Follow, Form, Interpolation, Job, Join, Limits, LoadCase, On,
    Orientation, PointForce, ProfilePoint, Settings, Spin, Step, Strand, Support, Tilt,
};
pub use machine::{Bed, Cell, Extruder, Mode, Obstacle, Robot, RobotLink, Tool, ToolPart};
pub use machine_from_files::machine;
pub use material_from_file::material;
pub use resolve::{Parts, resolve};
