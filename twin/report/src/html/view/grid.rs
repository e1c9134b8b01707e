//! Places as 16-bit numbers in a box.

use sim::pose::Point;
use sim::scene::Bounds;

/// Cells along each edge of the box.
const CELLS: f64 = 65535.0;

/// A box whose inside is told in 65535 steps along each axis.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Grid {
    pub(super) min: [f64; 3],
    pub(super) size: [f64; 3],
}

impl Grid {
    /// About points; those that are not finite do not count.
    pub(super) fn about(points: impl IntoIterator<Item = Point>) -> Grid {
        match Bounds::of(points) {
            Some(b) => Grid { min: b.min.coords.into(), size: b.size().into() },
            None => Grid { min: [0.0; 3], size: [0.0; 3] },
        }
    }

    pub(super) fn code(&self, point: &Point) -> [u16; 3] {
        std::array::from_fn(|i| {
            let share =
                if self.size[i] > 0.0 { (point[i] - self.min[i]) / self.size[i] } else { 0.0 };
            // the cast holds what is outside at the ends
            (share * CELLS).round() as u16
        })
    }

    /// The place of a code.
    #[cfg(test)]
    pub(super) fn point(&self, code: [u16; 3]) -> Point {
        let at = |i: usize| self.min[i] + self.size[i] * f64::from(code[i]) / CELLS;
        Point::new(at(0), at(1), at(2))
    }

    /// Lowest corner and edges, for the viewer.
    pub(super) fn told(&self) -> serde_json::Value {
        let [min, size] = [self.min, self.size];
        serde_json::json!([min[0], min[1], min[2], size[0], size[1], size[2]])
    }
}
