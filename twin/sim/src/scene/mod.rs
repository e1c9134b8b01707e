//! What there is to see: a plain description of cell, arm and deposit in world axes.
//!
//! Whoever has the values builds a [`Scene`]; `render` draws it and [`cast`] sends rays through it.
//! Nothing here judges or computes: the scene is a copy for the eye, in metres.

pub mod cast;
pub mod colours;
pub mod solid;
#[cfg(test)]
mod tests;

use crate::pose::{Point, Pose, Vector, is_finite_point};
pub use crate::shape::Shape;

/// All that one picture can show, in world axes.
#[derive(Debug, Clone, Default)]
pub struct Scene {
    /// Arm, tool, fixtures and forms.
    pub bodies: Vec<Body>,
    /// The deposit, one entry per strand, or per piece of strand that has a colour of its own.
    pub strands: Vec<StrandShape>,
    /// Strands not printed yet: clear lines that hide nothing.
    pub planned: Vec<StrandShape>,
    /// The plate that is printed on, where the cell has one.
    pub bed: Option<BedShape>,
    /// Heading of the picture.
    pub title: String,
    /// Places to point at.
    pub marks: Vec<Mark>,
    /// What the colours of the strands mean, where they mean anything.
    pub colour: Option<ColourScale>,
    /// What a close-up shows; the strands where absent.
    pub part_bounds: Option<Bounds>,
}

/// Several moments of one thing, drawn from one side at one scale.
#[derive(Debug, Clone, Default)]
pub struct Row {
    /// Heading of the page.
    pub title: String,
    /// The moments; the lines of each title are its caption, and colours mean the same in all.
    pub scenes: Vec<Scene>,
    /// Sentences under the legend.
    pub notes: Vec<String>,
    /// A word on every picture that says what it is not, such as "illustration".
    pub stamp: Option<String>,
}

/// One rigid thing of the cell.
#[derive(Debug, Clone)]
pub struct Body {
    /// Name as in the cell or the robot's URDF.
    pub name: String,
    /// What it is, which decides its colour.
    pub kind: BodyKind,
    /// `world_from_body`.
    pub pose: Pose,
    /// Shape in the body's axes.
    pub shape: Shape,
    /// Drawn with a coloured outline.
    pub highlighted: bool,
}

/// What a body is.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum BodyKind {
    /// A link of the arm that prints.
    Arm,
    /// Any part of the tool but the nozzle.
    Tool,
    /// The part of the tool that the material leaves.
    Nozzle,
    /// What carries the printed part, beside the plate of [`Scene::bed`].
    Bed,
    /// A fixture, wall or table.
    Obstacle,
    /// A form that is printed on.
    Form,
    /// A link of an arm that does not print, a torso or a rail.
    OtherArm,
}

/// A strand as the eye sees it: a round bead along a polyline.
#[derive(Debug, Clone)]
pub struct StrandShape {
    /// Axis of the bead in world axes.
    pub points: Vec<Point>,
    /// Half of the bead's diameter.
    pub radius_m: f64,
    /// Value on [`Scene::colour`]; grey where absent.
    pub value: Option<f64>,
    /// Drawn with a coloured outline.
    pub highlighted: bool,
}

/// The plate that is printed on: its top lies in the x-y plane of `pose`, about its origin.
#[derive(Debug, Clone, PartialEq)]
pub struct BedShape {
    /// `world_from_bed`, z out of the plate.
    pub pose: Pose,
    /// Extent along x and y.
    pub size_m: [f64; 2],
}

/// A place with a label.
#[derive(Debug, Clone)]
pub struct Mark {
    /// Where, in world axes.
    pub at: Point,
    /// A few words or a code.
    pub label: String,
    /// Decides the colour.
    pub severity: MarkSeverity,
}

impl MarkSeverity {
    /// The word for it.
    pub fn word(self) -> &'static str {
        match self {
            Self::Note => "note",
            Self::Warning => "warning",
            Self::Error => "error",
        }
    }
}

/// How bad the thing marked is.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum MarkSeverity {
    /// Only to point at something.
    Note,
    /// A limit is near.
    Warning,
    /// A limit is passed.
    Error,
}

/// What the colours of the strands mean.
#[derive(Debug, Clone, PartialEq)]
pub struct ColourScale {
    /// Quantity, as a heading.
    pub title: String,
    /// Its unit as printed; empty for none.
    pub unit: String,
    /// Value of the first colour.
    pub low: f64,
    /// Value of the last colour.
    pub high: f64,
    /// Where the limit lies, if there is one.
    pub limit: Option<f64>,
}

/// A box along the world's axes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Bounds {
    /// Lowest corner.
    pub min: Point,
    /// Highest corner.
    pub max: Point,
}

impl Bounds {
    /// The smallest box about the finite ones among the points; `None` where there are none.
    pub fn of(points: impl IntoIterator<Item = Point>) -> Option<Bounds> {
        points.into_iter().filter(is_finite_point).fold(None, |acc, p| {
            Some(match acc {
                None => Bounds { min: p, max: p },
                Some(b) => Bounds { min: b.min.inf(&p), max: b.max.sup(&p) },
            })
        })
    }

    /// Middle of the box.
    pub fn centre(&self) -> Point {
        nalgebra::center(&self.min, &self.max)
    }

    /// Edge lengths, m.
    pub fn size(&self) -> Vector {
        self.max - self.min
    }

    /// The eight corners.
    pub fn corners(&self) -> [Point; 8] {
        let pick = |bit: bool, low: f64, high: f64| if bit { high } else { low };
        std::array::from_fn(|i| {
            Point::new(
                pick(i & 1 != 0, self.min.x, self.max.x),
                pick(i & 2 != 0, self.min.y, self.max.y),
                pick(i & 4 != 0, self.min.z, self.max.z),
            )
        })
    }
}

impl BedShape {
    /// Thickness the plate is drawn with, m. Only the top is known.
    pub const THICKNESS_M: f64 = 0.012;

    /// The plate as a body, for whoever draws or casts.
    pub fn body(&self) -> Body {
        let t = Self::THICKNESS_M;
        let half_m = Vector::new(self.size_m[0] / 2.0, self.size_m[1] / 2.0, t / 2.0);
        let shape = Shape::Box { half_m, pose: Pose::translation(0.0, 0.0, -t / 2.0) };
        Body { name: "bed".into(), kind: BodyKind::Bed, pose: self.pose, shape, highlighted: false }
    }
}

impl Scene {
    /// Box about the part: `part_bounds`, or else the strands with their thickness.
    pub fn part(&self) -> Option<Bounds> {
        self.part_bounds.or_else(|| {
            Bounds::of(self.strands.iter().flat_map(|s| {
                let r = Vector::repeat(s.radius_m);
                s.points.iter().flat_map(move |p| [p - r, p + r])
            }))
        })
    }
}
