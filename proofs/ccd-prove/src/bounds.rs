//! Bounding boxes of vertices, and the ranges of their radii.

use ccd_core::glam::{DVec3, DVec4};
use ccd_core::order::{greater, lesser};

/// The least and the greatest x, y, z and radius of some vertices.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Bounds {
    pub(crate) least: DVec4,
    pub(crate) greatest: DVec4,
}

impl Bounds {
    pub(crate) fn of(triangle: &[DVec4; 3]) -> Bounds {
        Bounds::around(triangle.iter().copied())
    }

    pub(crate) fn around(corners: impl Iterator<Item = DVec4>) -> Bounds {
        let empty = Bounds {
            least: DVec4::INFINITY,
            greatest: DVec4::NEG_INFINITY,
        };
        corners.fold(empty, |bounds, corner| {
            bounds.union(&Bounds {
                least: corner,
                greatest: corner,
            })
        })
    }

    /// Returns the smallest bounds that contain both.
    pub(crate) fn union(&self, other: &Bounds) -> Bounds {
        Bounds {
            least: by_coordinate(self.least, other.least, lesser),
            greatest: by_coordinate(self.greatest, other.greatest, greater),
        }
    }

    pub(crate) fn center(&self) -> DVec3 {
        (0.5 * (self.least + self.greatest)).truncate()
    }

    /// Returns half of the surface area of the box, plus a tenth of its squared diagonal. The diagonal also orders boxes without
    /// area.
    pub(crate) fn area(&self) -> f64 {
        let size = (self.greatest - self.least).truncate();
        let [x, y, z] = size.to_array();
        x * y + y * z + z * x + 0.1 * size.length_squared()
    }

    /// Returns the least dot product of `direction` with a point of the box.
    pub(crate) fn min_projection(&self, direction: DVec4) -> f64 {
        by_coordinate(direction * self.least, direction * self.greatest, lesser).element_sum()
    }
}

/// Returns the results of a function of each pair of coordinates.
pub(crate) fn by_coordinate(a: DVec4, b: DVec4, f: fn(f64, f64) -> f64) -> DVec4 {
    DVec4::new(f(a.x, b.x), f(a.y, b.y), f(a.z, b.z), f(a.w, b.w))
}
