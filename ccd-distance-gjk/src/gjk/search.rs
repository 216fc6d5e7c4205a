//! The iteration of the GJK algorithm `[GJK88]`.

use super::minkowski::MinkowskiDifference;
use super::simplex::{Simplex, Vertex};
use super::termination::{StopReason, gap_equals_distance, is_at_origin};
use crate::tolerance::{CONVERGED_ULPS, MAX_STEPS};
use ccd_core::glam::DVec3;

/// The best results for a pair so far: nearest point and axis.
#[derive(Clone, Copy, Debug)]
pub(crate) struct SearchResult {
    /// The simplex that contains the nearest point.
    pub(crate) simplex: Simplex,
    pub(crate) weights: [f64; 4],
    /// The squared distance of the nearest point from the origin.
    pub(crate) squared_distance: f64,
    /// The axis with the largest support gap so far, of any length.
    pub(crate) axis: DVec3,
    /// The gap along the unit vector of `axis`.
    pub(crate) gap: f64,
}

impl SearchResult {
    /// Creates the state before a search: an empty simplex, no axis, and an infinite distance.
    pub(crate) fn empty() -> Self {
        SearchResult {
            simplex: Simplex::EMPTY,
            weights: [0.0; 4],
            squared_distance: f64::INFINITY,
            axis: DVec3::ZERO,
            gap: f64::NEG_INFINITY,
        }
    }

    /// Combines two results: takes the nearer point, and the axis with the larger gap.
    pub(crate) fn combine_results(self, other: Self) -> Self {
        let nearer = if other.squared_distance < self.squared_distance {
            other
        } else {
            self
        };
        let wider = if other.gap > self.gap { other } else { self };
        SearchResult {
            axis: wider.axis,
            gap: wider.gap,
            ..nearer
        }
    }

    /// Computes the support gap along an axis, and the vertex with the least height. Stores the axis if its gap is the
    /// largest so far.
    pub(crate) fn probe_axis(
        &mut self,
        difference: &MinkowskiDifference<'_>,
        axis: DVec3,
    ) -> (Vertex, f64) {
        let vertex = difference.lowest_vertex(axis);
        let gap = axis.dot(vertex.point) / axis.length_squared().sqrt();
        if gap > self.gap {
            (self.axis, self.gap) = (axis, gap);
        }
        (vertex, gap)
    }
}

/// Searches for the point of the difference that is nearest to the origin, from an initial simplex. `found` keeps the
/// best result, however the search stops.
pub(crate) fn search(
    difference: &MinkowskiDifference<'_>,
    mut simplex: Simplex,
    found: &mut SearchResult,
) -> StopReason {
    for _ in 0..MAX_STEPS {
        let Some(foot) = simplex.foot() else {
            return StopReason::Stalled;
        };
        let square = foot.point.length_squared();
        // Written so that NaN stops it.
        if !(square < found.squared_distance) {
            return StopReason::Stalled;
        }
        let reduced;
        (reduced, found.weights) = simplex.without_zero_weights(&foot);
        (found.simplex, found.squared_distance) = (reduced, square);
        let Some(direction) = foot.direction else {
            return StopReason::OriginEnclosed;
        };
        if is_at_origin(&foot, &simplex) {
            return StopReason::Touching;
        }
        let (vertex, gap) = found.probe_axis(difference, direction);
        if gap_equals_distance(gap, square, &simplex, CONVERGED_ULPS) {
            return StopReason::Converged;
        }
        simplex = reduced;
        if !simplex.push(vertex) {
            return StopReason::Stalled;
        }
    }
    StopReason::StepLimit
}
