//! Slabs that bound the triangles of flat nodes between two planes, in f64.

use crate::math::order::greater;
use crate::math::vector::unit;
use crate::rounding::UNIT_ROUNDOFF_F64;
use crate::tuning::MAX_FLAT_THICKNESS;
use glam::DVec3;

/// Two parallel planes that bound a flat node's triangles, at equal distances from the node's center. All triangles of
/// the node are between the planes.
///
/// The axes of a node's box are rounded to f32. The box of a flat node that is not parallel to the coordinates is
/// therefore thicker than the node by that rounding.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Slab {
    /// The unit normal of the planes.
    pub(crate) normal: DVec3,
    /// Half the distance between the planes.
    pub(crate) half_thickness: f64,
}

impl Slab {
    /// Fits a slab about a center to the corners of triangles; `None` unless they are in one plane up to rounding.
    pub(super) fn fit_to(corners: &[DVec3], center: DVec3) -> Option<Self> {
        let triangles = corners.as_chunks().0.iter();
        let normal = unit(triangles.map(|[a, b, c]| (b - a).cross(c - a)).sum())?;
        let (mut half, mut size) = (0.0, 0.0);
        for &corner in corners {
            let way = corner - center;
            half = greater(half, normal.dot(way).abs());
            size = greater(size, way.abs().max_element());
        }
        // Differences are off by 1u, products with a unit vector and their sum by 3u of √3.
        half += 16.0 * UNIT_ROUNDOFF_F64 * size;
        // Written so that NaN is not flat.
        (half <= MAX_FLAT_THICKNESS * size).then_some(Slab {
            normal,
            half_thickness: half,
        })
    }
}

#[cfg(test)]
mod tests;
