//! The point of a triangle that is nearest to the origin.

use super::segment;
use super::simplex::Foot;
use super::vector::Vector;
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
    let flat = n.square() <= V::Scalar::epsilon() * ab.square() * ac.square().max(bc.square());
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

fn face<V: Vector>(corners: [V; 3], n: V, areas: [V::Scalar; 3]) -> Foot<V> {
    let total = areas[0] + areas[1] + areas[2];
    let [u, v, w] = areas.map(|area| area / total);
    let point = corners[0] * u + corners[1] * v + corners[2] * w;
    let height = corners[0].dot(n) / n.square();
    Foot {
        weights: [u, v, w, V::Scalar::zero()],
        point,
        // The face's normal, on the side of the origin that the face lies on.
        direction: Some(match height {
            height if height < V::Scalar::zero() => -n,
            _ => n,
        }),
    }
}
