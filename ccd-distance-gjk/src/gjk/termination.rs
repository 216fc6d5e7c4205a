//! When a search stops.

use super::simplex::{Foot, Simplex};
use super::vector::{Vector, ulps};
use crate::tolerance::TOUCHING_ULPS;
use ccd_core::order::greater;
use num_traits::Float;

/// Why a search stopped.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Stop {
    /// The support gap has met the distance.
    Converged,
    /// The nearest point does not differ from the origin by more than rounding.
    Touching,
    /// The simplex encloses the origin: the hulls intersect.
    Enclosed,
    /// No vertex brings it nearer in this precision.
    Stalled,
    /// It took too many steps.
    Capped,
}

/// Whether the nearest point is the origin, up to rounding.
pub(crate) fn touches<V: Vector>(foot: &Foot<V>, simplex: &Simplex<V>) -> bool {
    let rounding = ulps::<V::Scalar>(TOUCHING_ULPS);
    foot.point.square() <= rounding * rounding * reach(simplex)
}

/// Whether a support gap has met the distance of the nearest point, whose square is given, up to
/// `share` units in the last place of it, and rounding.
pub(crate) fn meets<V: Vector>(
    gap: V::Scalar,
    square: V::Scalar,
    simplex: &Simplex<V>,
    share: f32,
) -> bool {
    let distance = square.sqrt();
    let rounding = ulps::<V::Scalar>(TOUCHING_ULPS) * reach(simplex).sqrt();
    distance - gap <= ulps::<V::Scalar>(share) * distance + rounding
}

/// The square of the largest vertex: what rounding is relative to.
fn reach<V: Vector>(simplex: &Simplex<V>) -> V::Scalar {
    let squares = simplex.vertices().iter().map(|v| v.point.square());
    squares.fold(V::Scalar::min_positive_value(), greater)
}
