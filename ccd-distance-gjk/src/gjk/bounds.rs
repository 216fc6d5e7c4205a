//! Bounds of the distance of two convex sets, only as tight as the caller needs them.

use super::simplex::{Simplex, Vertex};
use crate::tolerance::MAX_STEPS;
use ccd_core::glam::DVec3;

/// The bounds at which a search ends.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TerminationBounds {
    /// The search ends when the lower bound exceeds this distance.
    pub sufficient_lower_bound: f64,
    /// The search ends when the upper bound is at most this distance.
    pub sufficient_upper_bound: f64,
}

/// Bounds of the distance of two convex sets, up to the rounding of their points.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DistanceBounds {
    /// A lower bound: the support gap along `axis`. It is negative if no axis was found that separates the sets.
    pub lower: f64,
    /// An upper bound: the distance of two points of the sets. It is 0 if the sets intersect.
    pub upper: f64,
    /// The vector from A's set to B's, of any length, that gives the lower bound.
    pub axis: DVec3,
}

impl TerminationBounds {
    /// Returns whether the search ends with these bounds.
    #[inline(always)]
    pub fn are_met_by(&self, bounds: &DistanceBounds) -> bool {
        bounds.lower > self.sufficient_lower_bound || bounds.upper <= self.sufficient_upper_bound
    }
}

/// Bounds the distance of two convex sets by GJK `[GJK88]`, and ends as soon as the bounds are good enough.
///
/// The function `support` returns the vertex `b − a` of the Minkowski difference with the least height along a direction
/// of any length. The first axis is tried first; it decides alone if the sets are far enough apart along it. The search
/// ends when `is_enough` returns true, see [`TerminationBounds::are_met_by`].
///
/// # Guarantee
/// Both bounds hold up to the rounding of the vertices that `support` returns and of their heights, whatever the first
/// axis is. The search ends after at most 64 vertices.
///
/// ```
/// use ccd_core::glam::DVec3;
/// use ccd_distance_gjk::{TerminationBounds, Vertex, bound_distance};
/// // A point at the origin, and a segment from (1, -1, 0) to (1, 1, 0).
/// let ends = [DVec3::new(1.0, -1.0, 0.0), DVec3::new(1.0, 1.0, 0.0)];
/// let support = |direction: DVec3| {
///     let b = if ends[1].dot(direction) < ends[0].dot(direction) { 1 } else { 0 };
///     Vertex { point: ends[b as usize], a: 0, b }
/// };
/// let required = TerminationBounds { sufficient_lower_bound: 0.5, sufficient_upper_bound: 0.0 };
/// let bounds = bound_distance(support, DVec3::X, |bounds| required.are_met_by(bounds));
/// assert_eq!((bounds.lower, bounds.axis), (1.0, DVec3::X));
/// ```
#[inline(always)]
pub fn bound_distance(
    support: impl Fn(DVec3) -> Vertex,
    first_axis: DVec3,
    is_enough: impl Fn(&DistanceBounds) -> bool,
) -> DistanceBounds {
    let mut bounds = DistanceBounds {
        lower: f64::NEG_INFINITY,
        upper: f64::INFINITY,
        axis: first_axis,
    };
    let (mut simplex, mut axis) = (Simplex::EMPTY, first_axis);
    for _ in 0..MAX_STEPS {
        let vertex = support(axis);
        let gap = axis.dot(vertex.point) / axis.length();
        if gap > bounds.lower {
            (bounds.lower, bounds.axis) = (gap, axis);
        }
        if is_enough(&bounds) || !simplex.push(vertex) {
            break;
        }
        let Some(foot) = simplex.foot() else { break };
        let Some(direction) = foot.direction else {
            bounds.upper = 0.0;
            break;
        };
        let distance = foot.point.length();
        // Written so that NaN ends the search.
        if !(distance < bounds.upper) {
            break;
        }
        bounds.upper = distance;
        if is_enough(&bounds) {
            break;
        }
        (simplex, _) = simplex.without_zero_weights(&foot);
        axis = direction;
    }
    bounds
}

#[cfg(test)]
mod tests;
