//! The point of a tetrahedron that is nearest to the origin.

use super::simplex::Foot;
use super::triangle;
use super::vector::{Vector, ulps};
use crate::tolerance::VOLUME_ULPS;
use num_traits::Zero;

/// The foot of the origin on the tetrahedron, which may be flat.
///
/// The origin is called inside only where it is certainly on the inner side of every face; else the
/// nearest foot on the faces it may be outside of is returned.
pub(crate) fn foot<V: Vector>(corners: [V; 4]) -> Foot<V> {
    let mut weights = [V::Scalar::zero(); 4];
    let mut best = None;
    for (opposite, face) in FACES.iter().enumerate() {
        let [a, b, c] = face.map(|k| corners[k]);
        match share(a, b, c, corners[opposite]) {
            Some(share) => weights[opposite] = share,
            None => best = Some(triangle::foot(a, b, c).lifted(face).or_nearer(best)),
        }
    }
    best.unwrap_or_else(|| {
        let total = weights.iter().fold(V::Scalar::zero(), |sum, &w| sum + w);
        Foot {
            weights: weights.map(|w| w / total),
            point: V::ZERO,
            direction: None,
        }
    })
}

/// The corners of the face opposite of each corner.
const FACES: [[usize; 3]; 4] = [[1, 2, 3], [0, 2, 3], [0, 1, 3], [0, 1, 2]];

/// The origin's height above the face relative to that of `apex`, if certainly positive.
fn share<V: Vector>(a: V, b: V, c: V, apex: V) -> Option<V::Scalar> {
    let (ab, ac, up) = (b - a, c - a, apex - a);
    let n = ab.cross(ac);
    let (of_origin, of_apex) = (-a.dot(n), up.dot(n));
    let rounding = ulps::<V::Scalar>(VOLUME_ULPS);
    let unit = rounding * rounding * ab.square() * ac.square();
    // Squares, to do without roots. Written so that NaN is on no side.
    let certain = of_origin * of_apex > V::Scalar::zero()
        && of_origin * of_origin > unit * a.square()
        && of_apex * of_apex > unit * up.square();
    certain.then(|| of_origin / of_apex)
}
