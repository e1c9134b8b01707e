//! Pictures without a window.
//!
//! A [`Studio`] draws a [`Task`], in a process of its own where it is given one. One path for both machines:
//! a [`Scene`](sim::scene::Scene) is captured as a [`layer`] that says
//! for every sample which thing is seen, how far and with which normal. The graphics card rasterises
//! that, or rays of `sim` do; light, lines and letters are then put on by the same code. All views
//! are orthographic, so a scale bar is exact.

mod animation;
mod canvas;
mod closeup;
mod cpu;
mod gpu;
mod layer;
mod map;
mod overlay;
mod paint;
mod probe;
mod process;
mod row;
mod shade;
mod sheet;
mod task;
mod text;
pub mod view;

#[cfg(test)]
mod tests;

pub use animation::{apng, gif};
use image::RgbaImage;
pub use map::spin_map;
pub use probe::{Probe, probe};
pub use process::{Drawer, Studio, serve};
pub use task::Task;
pub use view::{Camera, Fit, Projection, View};

/// Which machine is asked to draw.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Backend {
    /// The graphics card where a Vulkan adapter works, else rays.
    #[default]
    Auto,
    /// A Vulkan adapter or nothing.
    Gpu,
    /// Rays of `sim` on the processor.
    Cpu,
}

/// Which machine has drawn.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum DrawnBy {
    /// A Vulkan adapter, which may itself be software.
    Gpu {
        /// Name of the adapter.
        adapter: String,
        /// Driver and its version.
        driver: String,
    },
    /// Rays of `sim` on the processor.
    Cpu {
        /// Why not the graphics card, where it was wanted.
        because: Option<String>,
    },
}

/// A finished picture.
#[derive(Debug, Clone)]
pub struct Picture {
    /// Opaque pixels in sRGB.
    pub rgba: RgbaImage,
    /// Who drew it.
    pub drawn_by: DrawnBy,
    /// The views in it, each with the place of its upper left corner, px: where things of the world lie.
    pub views: Vec<((u32, u32), Projection)>,
}

/// Why there is no picture.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum RenderError {
    /// Asked for the graphics card, and none can draw.
    #[error("no Vulkan adapter can draw: {0}")]
    NoAdapter(String),
    /// The graphics card failed while drawing.
    #[error("the graphics card failed: {0}")]
    Gpu(String),
    /// The asked size cannot be drawn.
    #[error(
        "a picture of {width}x{height} px is outside {MIN_PX}x{MIN_PX} to {MAX_PX}x{MAX_PX} px"
    )]
    Size {
        /// Asked width, px.
        width: u32,
        /// Asked height, px.
        height: u32,
    },
    /// The embedded font is damaged.
    #[error("the embedded font cannot be read")]
    Font,
    /// The process that draws is lost.
    #[error("the process that draws was lost: {0}")]
    Process(String),
}

impl RenderError {
    /// Whether rays might do what failed.
    fn is_of_the_card(&self) -> bool {
        matches!(self, Self::NoAdapter(_) | Self::Gpu(_) | Self::Process(_))
    }
}

/// Shortest edge of a picture, px: less has no room for letters.
pub const MIN_PX: u32 = 240;
/// Longest edge of a picture, px.
pub const MAX_PX: u32 = 4096;

/// Vulkan adapters in the order of preference, as "name (kind, driver)".
pub fn adapters() -> Vec<String> {
    gpu::names()
}

impl std::fmt::Display for DrawnBy {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            DrawnBy::Gpu { adapter, driver } => write!(f, "{adapter}, {driver}"),
            DrawnBy::Cpu { because: None } => write!(f, "rays on the processor"),
            DrawnBy::Cpu { because: Some(why) } => write!(f, "rays on the processor ({why})"),
        }
    }
}

/// The machine a layer is captured with.
enum Engine {
    Gpu(Box<gpu::Gpu>),
    Cpu { because: Option<String> },
}

impl Engine {
    fn drawn_by(&self) -> DrawnBy {
        match self {
            Engine::Gpu(gpu) => gpu.drawn_by(),
            Engine::Cpu { because } => DrawnBy::Cpu { because: because.clone() },
        }
    }
}

fn check_size((width, height): (u32, u32)) -> Result<(), RenderError> {
    let ok = |n| (MIN_PX..=MAX_PX).contains(&n);
    if ok(width) && ok(height) { Ok(()) } else { Err(RenderError::Size { width, height }) }
}
