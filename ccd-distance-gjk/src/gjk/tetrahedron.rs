//! The point of a tetrahedron that is nearest to the origin.

use super::simplex::Foot;
use super::triangle;
use super::vector::{Vector, ulps};
use crate::tolerance::{INSIDE_ROUNDS, TOUCHING_ULPS, VOLUME_ULPS};
use ccd_core::order::greater;
use num_traits::Zero;

/// The foot of the origin on the tetrahedron, which may be flat.
///
/// The origin is called inside only where it is certainly on the inner side of every face, and the
/// corners do make it up; else all faces are looked at: those it seems to be inside of may hold the
/// nearest point, if the tetrahedron is flat.
pub(crate) fn foot<V: Vector>(corners: [V; 4]) -> Foot<V> {
    let heights = FACES
        .map(|[apex, a, b, c]| Height::certain(corners[a], corners[b], corners[c], corners[apex]));
    if let [Some(a), Some(b), Some(c), Some(d)] = heights
        && let Some(inside) = inside(corners, [a, b, c, d])
    {
        return inside;
    }
    let feet = FACES
        .map(|[_, a, b, c]| triangle::foot(corners[a], corners[b], corners[c]).lifted(&[a, b, c]));
    let [first, others @ ..] = feet;
    others
        .into_iter()
        .fold(first, |best, foot| foot.or_nearer(Some(best)))
}

/// Each corner with those of the face opposite of it.
const FACES: [[usize; 4]; 4] = [[0, 1, 2, 3], [1, 0, 2, 3], [2, 0, 1, 3], [3, 0, 1, 2]];

/// The weights that make up the origin, if rounding lets them.
fn inside<V: Vector>(corners: [V; 4], heights: [Height<V>; 4]) -> Option<Foot<V>> {
    let zero = V::Scalar::zero();
    let combined = |weights: [V::Scalar; 4]| {
        let terms = corners.iter().zip(weights);
        terms.fold(V::ZERO, |sum, (&corner, weight)| sum + corner * weight)
    };
    let normalised = |weights: [V::Scalar; 4]| {
        let weights = weights.map(|weight| greater(zero, weight));
        let total = weights.iter().fold(zero, |sum, &weight| sum + weight);
        weights.map(|weight| weight / total)
    };
    let mut weights = normalised(heights.map(|height| height.of_origin / height.of_apex));
    // Heights over a flat tetrahedron's faces are good to few digits; what the weights miss the
    // origin by is known to all, and each round of making it good wins as many digits again.
    for _ in 0..INSIDE_ROUNDS {
        let missed = combined(weights);
        let correction = heights.map(|height| height.normal.dot(missed) / height.of_apex);
        weights = normalised(std::array::from_fn(|k| weights[k] - correction[k]));
    }
    let reach = corners.iter().map(|c| c.square()).fold(zero, greater);
    let rounding = ulps::<V::Scalar>(TOUCHING_ULPS);
    let hit = combined(weights).square() <= rounding * rounding * reach;
    hit.then_some(Foot {
        weights,
        point: V::ZERO,
        direction: None,
    })
}

/// How high the origin stands over a face, and the corner opposite of it: both times the length of
/// the face's normal.
#[derive(Clone, Copy)]
struct Height<V: Vector> {
    normal: V,
    of_origin: V::Scalar,
    of_apex: V::Scalar,
}

impl<V: Vector> Height<V> {
    /// None unless both are certainly on the same side of the face.
    fn certain(a: V, b: V, c: V, apex: V) -> Option<Self> {
        let (ab, ac, up) = (b - a, c - a, apex - a);
        let normal = ab.cross(ac);
        let (of_origin, of_apex) = (-a.dot(normal), up.dot(normal));
        let rounding = ulps::<V::Scalar>(VOLUME_ULPS);
        let unit = rounding * rounding * ab.square() * ac.square();
        // Squares, to do without roots. Written so that NaN is on no side.
        let certain = of_origin * of_apex > V::Scalar::zero()
            && of_origin * of_origin > unit * a.square()
            && of_apex * of_apex > unit * up.square();
        certain.then_some(Height {
            normal,
            of_origin,
            of_apex,
        })
    }
}
