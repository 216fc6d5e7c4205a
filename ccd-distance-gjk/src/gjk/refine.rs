//! Improves the nearest points of a search by closed forms.

use super::minkowski::MinkowskiDifference;
use super::search::SearchResult;
use super::simplex::Simplex;
use crate::closed_form::nearest::{Corners, nearest_points};
use ccd_core::glam::DVec3;
use ccd_core::order::lesser;
use ccd_core::schedule::VectorInstructions;

/// Computes the nearest points of the two features that a simplex spans by a closed form, and stores them in `found` if
/// they are nearer.
///
/// The closed form is immune to the rounding that stalls a search on nearly parallel edges. If one
/// side has four points, the first three are used.
pub(crate) fn refine_witnesses(
    difference: &MinkowskiDifference<'_>,
    simplex: Simplex,
    found: &mut SearchResult,
) {
    let vertices = simplex.vertices();
    let p = PaddedTriangle::new(vertices.iter().map(|v| (v.a, difference.point_a(v.a))));
    let q = PaddedTriangle::new(vertices.iter().map(|v| (v.b, difference.point_b(v.b))));
    let (Some(p), Some(q)) = (p, q) else {
        return;
    };
    let near = nearest_points(
        VectorInstructions::Best.simd_level(),
        &p.corners,
        &q.corners,
    );
    let square = near
        .separation_vector(&p.corners, &q.corners)
        .length_squared();
    if square < found.squared_distance {
        found.squared_distance = square;
        (found.simplex, found.weights) = (Simplex::EMPTY, [0.0; 4]);
        for (i, j, weight) in weights_of_point_pairs(near.a, near.b) {
            let vertex = difference.vertex(p.indices[i], q.indices[j]);
            if vertex.is_some_and(|vertex| found.simplex.push(vertex)) {
                found.weights[found.simplex.vertices().len() - 1] = weight;
            }
        }
    }
}

/// Three points of a piece; the last point is repeated if there are fewer.
struct PaddedTriangle {
    corners: Corners,
    indices: [u32; 3],
}

impl PaddedTriangle {
    /// Collects the first three distinct points; `None` if there is no point.
    fn new(points: impl Iterator<Item = (u32, Option<DVec3>)>) -> Option<Self> {
        let mut out = PaddedTriangle {
            corners: [DVec3::ZERO; 3],
            indices: [0; 3],
        };
        let mut len = 0;
        for (index, point) in points {
            if len < 3 && !out.indices[..len].contains(&index) {
                out.indices[len..].fill(index);
                out.corners[len..].fill(point?);
                len += 1;
            }
        }
        (len > 0).then_some(out)
    }
}

/// Converts the weights of points in two lists to weights of pairs of them. The weights of the pairs that contain a point
/// add up to the point's weight.
///
/// `m` and `n` positive weights make at most `m + n − 1` pairs: three for corner and face, and for edge
/// and edge.
pub(crate) fn weights_of_point_pairs(
    mut a: [f64; 3],
    mut b: [f64; 3],
) -> impl Iterator<Item = (usize, usize, f64)> {
    let (mut next_a, mut next_b) = (0, 0);
    std::iter::from_fn(move || {
        while next_a < 3 && next_b < 3 {
            let (i, j) = (next_a, next_b);
            let share = lesser(a[i], b[j]);
            a[i] -= share;
            b[j] -= share;
            // Both advance when both are used up.
            next_a += usize::from(a[i] <= b[j]);
            next_b += usize::from(b[j] <= a[i]);
            if share > 0.0 {
                return Some((i, j, share));
            }
        }
        None
    })
}
