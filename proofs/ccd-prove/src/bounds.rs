//! Boxes around corners with balls.

use ccd_core::glam::{DVec3, DVec4};
use ccd_core::order::{greater, lesser};

/// The least and the greatest coordinates and radius of corners.
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
        let none = Bounds {
            least: DVec4::INFINITY,
            greatest: DVec4::NEG_INFINITY,
        };
        corners.fold(none, |all, corner| {
            all.with(&Bounds {
                least: corner,
                greatest: corner,
            })
        })
    }

    /// Returns the bounds of both.
    pub(crate) fn with(&self, other: &Bounds) -> Bounds {
        Bounds {
            least: of_each(self.least, other.least, lesser),
            greatest: of_each(self.greatest, other.greatest, greater),
        }
    }

    pub(crate) fn middle(&self) -> DVec3 {
        (0.5 * (self.least + self.greatest)).truncate()
    }

    /// Returns half of the area of the box, and a tenth of the square of its diagonal, which tells boxes without an area apart.
    pub(crate) fn area(&self) -> f64 {
        let size = (self.greatest - self.least).truncate();
        let [x, y, z] = size.to_array();
        x * y + y * z + z * x + 0.1 * size.length_squared()
    }

    /// Returns the least height of the box.
    pub(crate) fn least_height(&self, direction: DVec4) -> f64 {
        of_each(direction * self.least, direction * self.greatest, lesser).element_sum()
    }
}

pub(crate) fn of_each(a: DVec4, b: DVec4, of: fn(f64, f64) -> f64) -> DVec4 {
    DVec4::new(of(a.x, b.x), of(a.y, b.y), of(a.z, b.z), of(a.w, b.w))
}
