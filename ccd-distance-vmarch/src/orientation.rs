//! The exact sign of a point above or below a triangle `[SHE97]`.

use ccd_core::glam::DVec3;
use robust::{Coord3D, orient3d};

/// Positive where the point sees the triangle counter-clockwise, negative behind it: exactly, unless
/// coordinates are finer than [`LEAST_COORDINATE`](ccd_core::tolerance::LEAST_COORDINATE), by which
/// points may be off then.
#[inline]
pub(crate) fn orientation([a, b, c]: [DVec3; 3], point: DVec3) -> f64 {
    let level = a.cmpeq(b) & a.cmpeq(c) & a.cmpeq(point);
    if level.any() {
        // In a plane across a coordinate axis, which would take the predicate its longest computation.
        return 0.0;
    }
    let coord = |p: DVec3| Coord3D {
        x: p.x,
        y: p.y,
        z: p.z,
    };
    // Shewchuk's determinant is positive below.
    -orient3d(coord(a), coord(b), coord(c), coord(point))
}

#[cfg(test)]
mod tests;
