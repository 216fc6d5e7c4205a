//! Checks oracles' claims and turns them into proven distance bounds.

pub(crate) mod sharp;

use super::oracle::{Claim, PiecePair};
use crate::body::piece::ConvexCombination;
use crate::math::order::{greater, lesser};
use crate::math::vector::{length, unit_or_any};
use glam::DVec3;

/// A checked claim with proven bounds of the distance, in A's frame.
#[derive(Clone, Copy, Debug)]
pub(crate) struct CheckedClaim {
    /// The oracle's claim. A point of it that refers to no corner of its piece is replaced by the piece's first corner.
    pub(crate) claim: Claim,
    /// A lower bound of the distance, minus rounding; negative if no axis separates the pieces.
    pub(crate) lower: f64,
    /// An upper bound of the distance, plus rounding.
    pub(crate) upper: f64,
    /// The unit axis along which `lower` was computed.
    pub(crate) axis: DVec3,
    /// The distance of the claimed nearest points, before the pieces' radii are subtracted.
    pub(crate) claimed_core_distance: f64,
    /// The point of A from which `upper` was computed, on the surface that includes the radius.
    pub(crate) witness_a: DVec3,
    pub(crate) witness_b: DVec3,
}

/// Computes bounds of the distance from a claim: the gap along its axis, and the distance of its points. `rounding`
/// bounds the error of either.
///
/// # Guarantee
/// `lower ≤ distance ≤ upper`, for any claim.
pub(crate) fn check_claim(pair: &PiecePair<'_>, claim: &Claim, rounding: f64) -> CheckedClaim {
    let (a, on_a) = valid_combination_and_position(claim.a, pair.a.points);
    let (b, on_b) = valid_combination_and_position(claim.b, pair.b.points);
    let on_b = pair.b_to_a.transform_point(on_b);
    let way = on_b - on_a;
    let distance = length(way);
    let radii = pair.a.radius + pair.b.radius;

    let mut axis = unit_or_any(claim.axis);
    let near = [&a, &b].map(|claimed| claimed.point_indices().first().copied());
    let mut gap = support_gap_with_hints(pair, axis, on_a, near);
    // Written so that NaN tries the second axis.
    if !(gap > 0.5 * distance) {
        let second = unit_or_any(way);
        let second_gap = support_gap_with_hints(pair, second, on_a, near);
        if !(gap >= second_gap) {
            (axis, gap) = (second, second_gap);
        }
    }
    let outward = if distance > 0.0 {
        unit_or_any(way)
    } else {
        axis
    };
    CheckedClaim {
        claim: Claim { axis, a, b },
        lower: gap - radii - rounding,
        upper: greater(0.0, distance - radii) + rounding,
        axis,
        claimed_core_distance: distance,
        witness_a: on_a + outward * pair.a.radius,
        witness_b: on_b - outward * pair.b.radius,
    }
}

/// Returns the gap `min_B n·y − max_A n·x` of two pieces without their radii. Heights are measured from `from`.
#[inline]
pub(crate) fn support_gap(pair: &PiecePair<'_>, n: DVec3, from: DVec3) -> f64 {
    support_gap_with_hints(pair, n, from, [None; 2])
}

/// Like [`support_gap`], but starts the search for the extremal point of each piece at its corner in `near`, if given.
#[inline]
fn support_gap_with_hints(
    pair: &PiecePair<'_>,
    n: DVec3,
    from: DVec3,
    near: [Option<u32>; 2],
) -> f64 {
    let highest = match pair.a.support_map {
        Some(support) => {
            let farthest = support.extremal_point_with_hint(near[0], n);
            n.dot(pair.a.points[farthest as usize] - from)
        }
        None => {
            let heights = pair.a.points.iter().map(|&x| n.dot(x - from));
            heights.fold(f64::NEG_INFINITY, greater)
        }
    };
    let n_b = pair.b_to_a.inverse_transform_vector(n);
    let origin_b = n.dot(pair.b_to_a.translation - from);
    let lowest = match pair.b.support_map {
        Some(support) => {
            let farthest = support.extremal_point_with_hint(near[1], -n_b);
            n_b.dot(pair.b.points[farthest as usize])
        }
        None => {
            let heights = pair.b.points.iter().map(|&y| n_b.dot(y));
            heights.fold(f64::INFINITY, lesser)
        }
    };
    lowest + origin_b - highest
}

/// Returns a combination and its position; a combination with invalid indices is replaced by the first point.
fn valid_combination_and_position(
    combination: ConvexCombination,
    points: &[DVec3],
) -> (ConvexCombination, DVec3) {
    match combination.position(points) {
        Some(point) => (combination, point),
        None => (ConvexCombination::from_single_point(0), points[0]),
    }
}

#[cfg(test)]
mod tests;
