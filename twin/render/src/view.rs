//! Cameras: where the eye stands, and which point of the world falls on which pixel.

use nalgebra::Vector3;
use sim::pose::{Point, Vector};
use sim::scene::Bounds;

/// One view of a scene.
#[derive(Debug, Clone, PartialEq)]
pub struct View {
    /// Width and height, px.
    pub size_px: (u32, u32),
    /// From where.
    pub camera: Camera,
    /// How much.
    pub fit: Fit,
    /// Arm and tool, but not the nozzle, as if of glass, so that they do not hide the part.
    pub ghost_arm: bool,
}

/// From where to look. All cameras are orthographic.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Camera {
    /// From the front right and above: azimuth -50°, elevation 28°.
    Isometric,
    /// Along +y: x to the right, z up.
    Front,
    /// Along -x: y to the right, z up.
    Side,
    /// Along -z: x to the right, y up.
    Top,
    /// From any side.
    Orbit {
        /// Of the eye about the world's z, from +x, deg.
        azimuth_deg: f64,
        /// Of the eye above the x-y plane, deg.
        elevation_deg: f64,
    },
}

/// How much of the scene to show.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Fit {
    /// Everything.
    Cell,
    /// The part and a little around it.
    Part,
    /// A box of the world.
    Box(Bounds),
}

/// Orthographic projection of the world to pixels.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Projection {
    /// Point of the world that falls on `centre_px`, and where depth is 0.
    pub centre: Point,
    /// Pixel of `centre`, from the upper left corner.
    pub centre_px: [f64; 2],
    /// Unit vector to the right.
    pub right: Vector,
    /// Unit vector up.
    pub up: Vector,
    /// Unit vector away from the eye.
    pub forward: Vector,
    /// Scale.
    pub px_per_m: f64,
    /// Width and height, px.
    pub size_px: (u32, u32),
}

/// Room that a view leaves free at its edges, px.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Margins {
    pub(crate) left: f64,
    pub(crate) top: f64,
    pub(crate) right: f64,
    pub(crate) bottom: f64,
}

impl Camera {
    /// What a picture says of where it is seen from.
    pub(crate) fn name(&self) -> String {
        match self {
            Camera::Isometric => "isometric".to_owned(),
            Camera::Front => "front, along +y".to_owned(),
            Camera::Side => "side, along -x".to_owned(),
            Camera::Top => "top, along -z".to_owned(),
            Camera::Orbit { azimuth_deg, elevation_deg } => {
                format!("from azimuth {azimuth_deg:.0}°, elevation {elevation_deg:.0}°")
            }
        }
    }

    /// Unit vectors right, up and away from the eye.
    pub fn axes(&self) -> [Vector; 3] {
        let (azimuth_deg, elevation_deg) = match *self {
            Camera::Isometric => (-50.0, 28.0),
            Camera::Front => (-90.0, 0.0),
            Camera::Side => (0.0, 0.0),
            Camera::Top => (-90.0, 90.0),
            Camera::Orbit { azimuth_deg, elevation_deg } => (azimuth_deg, elevation_deg),
        };
        let (sa, ca) = f64::to_radians(azimuth_deg).sin_cos();
        let (se, ce) = f64::to_radians(elevation_deg).sin_cos();
        let forward = -Vector::new(ce * ca, ce * sa, se);
        let right = Vector::new(-sa, ca, 0.0);
        [right, right.cross(&forward), forward]
    }
}

impl Projection {
    /// The largest scale at which all points lie inside the margins.
    pub(crate) fn fit(
        axes: [Vector; 3],
        points: impl Iterator<Item = Point> + Clone,
        size_px: (u32, u32),
        margins: Margins,
    ) -> Projection {
        let [right, up, forward] = axes;
        let in_view = points
            .map(|p| Point::new(right.dot(&p.coords), up.dot(&p.coords), forward.dot(&p.coords)));
        let unit = Bounds { min: Point::new(-0.5, -0.5, -0.5), max: Point::new(0.5, 0.5, 0.5) };
        let bounds = Bounds::of(in_view).unwrap_or(unit);
        let (width, height) = (f64::from(size_px.0), f64::from(size_px.1));
        let room_x = (width - margins.left - margins.right).max(width * 0.2);
        let room_y = (height - margins.top - margins.bottom).max(height * 0.2);
        let (size, middle) = (bounds.size(), bounds.centre());
        let px_per_m = (room_x / size.x.max(1e-6)).min(room_y / size.y.max(1e-6));
        Projection {
            centre: Point::from(right * middle.x + up * middle.y + forward * middle.z),
            centre_px: [margins.left + room_x / 2.0, margins.top + room_y / 2.0],
            right,
            up,
            forward,
            px_per_m,
            size_px,
        }
    }

    /// Right, up and depth of a point from `centre`, m.
    pub fn in_view(&self, p: Point) -> Vector {
        let d = p - self.centre;
        Vector3::new(self.right.dot(&d), self.up.dot(&d), self.forward.dot(&d))
    }

    /// Pixel and depth of a point: px, px, m. The upper left corner of the picture is (0, 0).
    pub fn project(&self, p: Point) -> [f64; 3] {
        let v = self.in_view(p);
        [self.centre_px[0] + v.x * self.px_per_m, self.centre_px[1] - v.y * self.px_per_m, v.z]
    }

    /// The point that falls on a pixel at a depth.
    pub fn unproject(&self, x_px: f64, y_px: f64, depth_m: f64) -> Point {
        self.centre
            + self.right * ((x_px - self.centre_px[0]) / self.px_per_m)
            + self.up * ((self.centre_px[1] - y_px) / self.px_per_m)
            + self.forward * depth_m
    }

    /// The same view with `n` times as many pixels each way.
    pub(crate) fn finer(&self, n: u32) -> Projection {
        Projection {
            centre_px: self.centre_px.map(|c| c * f64::from(n)),
            px_per_m: self.px_per_m * f64::from(n),
            size_px: (self.size_px.0 * n, self.size_px.1 * n),
            ..*self
        }
    }
}
