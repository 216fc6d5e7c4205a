//! The point of a segment that is nearest to the origin.

use super::simplex::Foot;
use super::vector::Vector;
use num_traits::{One, Zero};

/// The foot of the origin on the segment from `a` to `b`, which may be equal.
pub(crate) fn foot<V: Vector>(a: V, b: V) -> Foot<V> {
    let (zero, one) = (V::Scalar::zero(), V::Scalar::one());
    let d = b - a;
    let (along, square) = (-a.dot(d), d.square());
    // Written so that NaN, and a segment without a length, end at a corner.
    if along >= square && square > zero {
        return Foot::corner(b, 1);
    }
    if !(along > zero && square > zero) {
        return Foot::corner(a, 0);
    }
    let t = along / square;
    let point = a + d * t;
    Foot {
        weights: [one - t, t, zero, zero],
        point,
        // Made perpendicular once more: that is what rounding takes from a short difference.
        direction: Some(point - d * (point.dot(d) / square)),
    }
}
