//! Distances of points, segments and triangles in closed form.

mod axis;
pub(crate) mod nearest;
mod pierce;
#[cfg(test)]
mod tests;

use crate::tolerance::{INTERSECTION_TEST_GAP_RATIO, MIN_CERTIFIED_SHARE};
use axis::best_separating_axis;
use ccd_core::fearless_simd::Level;
use ccd_core::glam::DVec3;
use ccd_core::schedule::VectorInstructions;
use ccd_core::{
    Claim, ConvexCombination, DistanceOracle, GiveUpReason, Piece, PiecePair, vectorize,
};
use nearest::{Corners, NearestPoints, nearest_points, support_gap};

/// An oracle for the distance of two points, segments or triangles in closed form, degenerate ones included.
///
/// Compares edges with edges and corners with faces, all at once. Intersection is tested only if the axis found does
/// not separate the pieces. Nothing is stored between calls.
///
/// # Guarantee
/// For separated pieces of size s, both moved near the origin, the witnesses are within about 1e-15
/// s of the nearest pair's distance. The axis certifies at least half of it down to distances of
/// about 1e-15 s. Needles thinner than 1e-7 s may lose up to their width when the distance is no
/// larger than that.
///
/// # Errors
/// [`GiveUpReason::TooManyPoints`] for pieces of more than three points, or none.
///
/// # Complexity
/// Constant, without allocation.
///
/// ```
/// use ccd_core::{DistanceOracle, Frame, Piece, PiecePair, glam::DVec3};
/// use ccd_distance_gjk::ClosedForm;
/// let floor = [DVec3::ZERO, 4.0 * DVec3::X, 4.0 * DVec3::Y];
/// let above = [DVec3::new(1.0, 1.0, 0.5)];
/// let pair = PiecePair {
///     a: Piece::from_points(&floor),
///     b: Piece::from_points(&above),
///     b_to_a: Frame::IDENTITY,
/// };
/// let claim = ClosedForm::default().separation(&pair, &mut ()).unwrap();
/// assert_eq!(claim.a.position(&floor), Some(DVec3::new(1.0, 1.0, 0.0)));
/// ```
#[derive(Clone, Copy, Debug)]
pub struct ClosedForm {
    simd_level: Level,
}

impl ClosedForm {
    /// Creates the oracle for a choice of vector instructions. All choices give the same claims, to the last bit.
    pub fn new(instructions: VectorInstructions) -> Self {
        ClosedForm {
            simd_level: instructions.simd_level(),
        }
    }
}

impl Default for ClosedForm {
    /// Creates the oracle with the best vector instructions of the machine.
    fn default() -> Self {
        ClosedForm::new(VectorInstructions::Best)
    }
}

impl DistanceOracle for ClosedForm {
    type Cache = ();

    #[inline]
    fn separation(&mut self, pair: &PiecePair<'_>, (): &mut ()) -> Result<Claim, GiveUpReason> {
        let (p, q) = corners_in_local_frame(pair).ok_or(GiveUpReason::TooManyPoints)?;
        let near = nearest_points(self.simd_level, &p, &q);
        let w = near.separation_vector(&p, &q);
        let separated = support_gap(&p, &q, w) >= MIN_CERTIFIED_SHARE * w.length_squared();
        let (axis, near) = if separated && w.length_squared().is_normal() {
            (w, near)
        } else {
            best_axis_and_points(self.simd_level, &p, &q, near)
        };
        Ok(Claim {
            axis,
            a: convex_combination(near.a, pair.a.points.len()),
            b: convex_combination(near.b, pair.b.points.len()),
        })
    }
}

/// Returns the best separating axis for pieces that nearly touch or intersect, and a common point if there is one.
#[cold]
#[inline(never)]
fn best_axis_and_points(
    level: Level,
    p: &Corners,
    q: &Corners,
    near: NearestPoints,
) -> (DVec3, NearestPoints) {
    let w = near.separation_vector(p, q);
    let (axis, gap) = vectorize!(level, level => best_separating_axis(level, p, q, w));
    if gap >= INTERSECTION_TEST_GAP_RATIO * w.length() && gap > 0.0 {
        return (axis, near);
    }
    (
        axis,
        pierce::nearest_with_edge_plane_intersections(p, q, near),
    )
}

/// Returns the corners of both pieces along A's axes, with A's first point as origin; `None` unless both have one to
/// three points. The rounding of later operations then depends on the pieces' size and distance, not on where they lie
/// in their bodies.
#[inline]
fn corners_in_local_frame(pair: &PiecePair<'_>) -> Option<(Corners, Corners)> {
    let (a, b) = (corners(&pair.a)?, corners(&pair.b)?);
    let first = pair.b_to_a.transform_point(b[0]) - a[0];
    let turn = pair.b_to_a.rotation;
    Some((
        [DVec3::ZERO, a[1] - a[0], a[2] - a[0]],
        [
            first,
            turn * (b[1] - b[0]) + first,
            turn * (b[2] - b[0]) + first,
        ],
    ))
}

#[inline]
fn corners(piece: &Piece<'_>) -> Option<Corners> {
    match *piece.points {
        [a] => Some([a; 3]),
        [a, b] => Some([a, b, b]),
        [a, b, c] => Some([a, b, c]),
        _ => None,
    }
}

#[inline]
fn convex_combination(weights: [f64; 3], points: usize) -> ConvexCombination {
    let mut out = ConvexCombination::EMPTY;
    for (k, weight) in weights.into_iter().enumerate() {
        out.add_weighted_point(k.min(points - 1) as u32, weight);
    }
    out
}
