//! The point of a triangle that is nearest to the origin.

use super::segment;
use super::simplex::Foot;
use super::vector::Vector;
use ccd_core::order::{greater, lesser};
use num_traits::{Float, Zero};

/// The foot of the origin on the triangle `a`, `b`, `c`, which may be degenerate.
///
/// Inside of the face where the origin is inside of all three edges; else the nearest foot on the
/// edges it is outside of. A triangle so flat that rounding may decide the sides is also compared
/// with all of its edges.
pub(crate) fn foot<V: Vector>(a: V, b: V, c: V) -> Foot<V> {
    let corners = [a, b, c];
    let (ab, ac, bc) = (b - a, c - a, c - b);
    let n = ab.cross(ac);
    // Twice the areas, times |n|², that the origin's foot spans with each edge; each edge's weight
    // goes to the corner opposite of it.
    let areas = [b.cross(bc).dot(n), -c.cross(ac).dot(n), a.cross(ab).dot(n)];
    let zero = V::Scalar::zero();
    let inside = areas.iter().all(|&area| area > zero);
    // sin² of the angle at `a` below which areas lose half of their digits.
    let flat = n.square() <= V::Scalar::epsilon() * ab.square() * greater(ac.square(), bc.square());
    let mut best = inside.then(|| face(corners, n, areas));
    for (opposite, &area) in areas.iter().enumerate() {
        if flat || !inside && !(area > zero) {
            let edge = [(opposite + 1) % 3, (opposite + 2) % 3];
            let on_edge = segment::foot(corners[edge[0]], corners[edge[1]]).lifted(&edge);
            best = Some(on_edge.or_nearer(best));
        }
    }
    best.unwrap_or(Foot::corner(a, 0))
}

/// The foot inside of the face, by the areas opposite of each corner.
fn face<V: Vector>(corners: [V; 3], n: V, areas: [V::Scalar; 3]) -> Foot<V> {
    let square = |k: usize| (corners[(k + 1) % 3] - corners[k]).square();
    let start = (1..3).fold(0, |best, k| if square(k) > square(best) { k } else { best });
    let end = (start + 1) % 3;
    let (edge, length2) = (corners[end] - corners[start], square(start));
    // In a needle rounding turns normal and areas. Along the longest edge that is made good; across
    // it the needle has no width to err by.
    let n = n - edge * (n.dot(edge) / length2);
    let total = areas[0] + areas[1] + areas[2];
    let mut weights = areas.map(|area| area / total);
    let back = combined(corners, weights).dot(edge) / length2;
    // No farther than to the edges.
    let back = lesser(weights[end], greater(-weights[start], back));
    weights[start] = weights[start] + back;
    weights[end] = weights[end] - back;
    let point = combined(corners, weights);
    Foot {
        weights: [weights[0], weights[1], weights[2], V::Scalar::zero()],
        point,
        direction: Some(straighter(corners, n, point, length2)),
    }
}

/// The normal, on the face's side of the origin, or the foot: whichever rounding turns less. The one
/// is turned by rounding over its height relative to the longest edge, the other over its length
/// relative to the corners'.
fn straighter<V: Vector>(corners: [V; 3], n: V, point: V, length2: V::Scalar) -> V {
    let reach = corners
        .iter()
        .map(|c| c.square())
        .fold(V::Scalar::zero(), greater);
    if point.square() * length2 * length2 > n.square() * reach {
        point
    } else if corners[0].dot(n) < V::Scalar::zero() {
        -n
    } else {
        n
    }
}

fn combined<V: Vector>(corners: [V; 3], [u, v, w]: [V::Scalar; 3]) -> V {
    corners[0] * u + corners[1] * v + corners[2] * w
}
