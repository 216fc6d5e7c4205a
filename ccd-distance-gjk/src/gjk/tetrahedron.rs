//! The point of a tetrahedron that is nearest to the origin.

use super::foot::NearestPoint;
use super::triangle;
use crate::tolerance::{TOUCHING_ULPS, VOLUME_ULPS, WEIGHT_CORRECTION_ROUNDS};
use ccd_core::glam::DVec3;
use ccd_core::order::greater;

/// Returns the point of a tetrahedron, which may be flat, that is nearest to the origin.
///
/// The origin counts as inside only if it is certainly on the inner side of every face, and is a
/// combination of the corners. Otherwise all faces are examined: if the tetrahedron is flat, even a
/// face with the origin on its inner side may contain the nearest point.
pub(crate) fn foot(corners: [DVec3; 4]) -> NearestPoint {
    let heights = CORNER_WITH_OPPOSITE_FACE.map(|[apex, a, b, c]| {
        FaceHeights::heights_if_same_side(corners[a], corners[b], corners[c], corners[apex])
    });
    if let [Some(a), Some(b), Some(c), Some(d)] = heights
        && let Some(inside) = origin_as_nearest_point(corners, [a, b, c, d])
    {
        return inside;
    }
    let feet = CORNER_WITH_OPPOSITE_FACE.map(|[_, a, b, c]| {
        triangle::nearest_point(corners[a], corners[b], corners[c])
            .lifted_to_whole_simplex(&[a, b, c])
    });
    let [first, others @ ..] = feet;
    others
        .into_iter()
        .fold(first, |best, foot| foot.nearer_of(Some(best)))
}

/// The index of each corner, followed by the indices of the opposite face's corners.
const CORNER_WITH_OPPOSITE_FACE: [[usize; 4]; 4] =
    [[0, 1, 2, 3], [1, 0, 2, 3], [2, 0, 1, 3], [3, 0, 1, 2]];

/// Returns the weights of the origin inside the tetrahedron; `None` if their combination misses the origin by more than
/// rounding.
fn origin_as_nearest_point(corners: [DVec3; 4], heights: [FaceHeights; 4]) -> Option<NearestPoint> {
    let combined = |weights: [f64; 4]| {
        let terms = corners.iter().zip(weights);
        terms.fold(DVec3::ZERO, |sum, (&corner, weight)| sum + corner * weight)
    };
    let normalised = |weights: [f64; 4]| {
        let weights = weights.map(|weight| greater(0.0, weight));
        let total = weights.iter().fold(0.0, |sum, &weight| sum + weight);
        weights.map(|weight| weight / total)
    };
    let mut weights =
        normalised(heights.map(|height| height.scaled_origin_height / height.scaled_apex_height));
    // Heights over a flat tetrahedron's faces have few correct digits. The residual of the weights is accurate, and
    // each round of correction gains as many digits again.
    for _ in 0..WEIGHT_CORRECTION_ROUNDS {
        let missed = combined(weights);
        let correction =
            heights.map(|height| height.normal.dot(missed) / height.scaled_apex_height);
        weights = normalised(std::array::from_fn(|k| weights[k] - correction[k]));
    }
    let reach = corners
        .iter()
        .map(|c| c.length_squared())
        .fold(0.0, greater);
    let rounding = TOUCHING_ULPS * f64::EPSILON;
    let hit = combined(weights).length_squared() <= rounding * rounding * reach;
    hit.then_some(NearestPoint {
        weights,
        point: DVec3::ZERO,
        direction: None,
    })
}

/// The heights of the origin and of the opposite corner above a face, each multiplied by the length of the face's normal.
#[derive(Clone, Copy)]
struct FaceHeights {
    normal: DVec3,
    scaled_origin_height: f64,
    scaled_apex_height: f64,
}

impl FaceHeights {
    /// Computes both heights; `None` unless both are certainly on the same side of the face.
    fn heights_if_same_side(a: DVec3, b: DVec3, c: DVec3, apex: DVec3) -> Option<Self> {
        let (ab, ac, up) = (b - a, c - a, apex - a);
        let normal = ab.cross(ac);
        let (of_origin, of_apex) = (-a.dot(normal), up.dot(normal));
        let rounding = VOLUME_ULPS * f64::EPSILON;
        let unit = rounding * rounding * ab.length_squared() * ac.length_squared();
        // Squares avoid roots. Written so that NaN is on no side.
        let certain = of_origin * of_apex > 0.0
            && of_origin * of_origin > unit * a.length_squared()
            && of_apex * of_apex > unit * up.length_squared();
        certain.then_some(FaceHeights {
            normal,
            scaled_origin_height: of_origin,
            scaled_apex_height: of_apex,
        })
    }
}

#[cfg(test)]
mod tests;
