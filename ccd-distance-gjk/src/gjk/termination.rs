//! The termination criteria of a GJK search.

use super::foot::NearestPoint;
use super::simplex::Simplex;
use crate::tolerance::TOUCHING_ULPS;
use ccd_core::order::greater;

/// The reason why a search stopped.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum StopReason {
    /// The support gap equals the distance, up to rounding.
    Converged,
    /// The nearest point is the origin, up to rounding.
    Touching,
    /// The simplex encloses the origin: the hulls intersect.
    OriginEnclosed,
    /// No vertex decreases the distance from the origin.
    Stalled,
    /// The search reached its limit of steps.
    StepLimit,
}

/// Returns whether the nearest point is the origin, up to rounding.
pub(crate) fn is_at_origin(foot: &NearestPoint, simplex: &Simplex) -> bool {
    let rounding = TOUCHING_ULPS * f64::EPSILON;
    foot.point.length_squared() <= rounding * rounding * max_squared_length(simplex)
}

/// Returns whether a support gap equals a distance, given by its square, up to a tolerance for rounding.
///
/// The two may differ by `share` units in the last place of the distance, plus rounding.
pub(crate) fn gap_equals_distance(gap: f64, square: f64, simplex: &Simplex, share: f64) -> bool {
    let distance = square.sqrt();
    let rounding = TOUCHING_ULPS * f64::EPSILON * max_squared_length(simplex).sqrt();
    distance - gap <= share * f64::EPSILON * distance + rounding
}

/// Returns the largest squared length of the simplex's vertices, to which rounding is relative.
fn max_squared_length(simplex: &Simplex) -> f64 {
    let squares = simplex.vertices().iter().map(|v| v.point.length_squared());
    squares.fold(f64::MIN_POSITIVE, greater)
}
