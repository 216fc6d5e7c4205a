//! Improves the nearest points of a search by closed forms.

use super::minkowski::MinkowskiDifference;
use super::search::SearchResult;
use super::simplex::Simplex;
use crate::closed_form::nearest::{Corners, nearest_points};
use ccd_core::Instructions;
use ccd_core::glam::DVec3;
use ccd_core::order::lesser;

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
    let p = Points::new(vertices.iter().map(|v| (v.a, difference.point_a(v.a))));
    let q = Points::new(vertices.iter().map(|v| (v.b, difference.point_b(v.b))));
    let (Some(p), Some(q)) = (p, q) else {
        return;
    };
    let near = nearest_points(Instructions::Best.simd_level(), &p.corners, &q.corners);
    let square = near.difference(&p.corners, &q.corners).length_squared();
    if square < found.squared_distance {
        let shares = PairedWeights::new(near.a, near.b);
        found.squared_distance = square;
        (found.simplex, found.weights) = pair_weights(difference, &p, &q, shares);
    }
}

/// Three points of a piece; the last point is repeated if there are fewer.
struct Points {
    corners: Corners,
    indices: [u32; 3],
}

impl Points {
    /// Collects the first three distinct points; `None` if there is no point.
    fn new(points: impl Iterator<Item = (u32, Option<DVec3>)>) -> Option<Self> {
        let mut out = Points {
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

/// Converts combinations of both pieces' points to the equal combination of vertices of the difference.
fn pair_weights(
    difference: &MinkowskiDifference<'_>,
    p: &Points,
    q: &Points,
    paired_weights: PairedWeights,
) -> (Simplex, [f64; 4]) {
    let (mut simplex, mut weights) = (Simplex::EMPTY, [0.0; 4]);
    for (i, j, weight) in paired_weights {
        let vertex = difference.vertex(p.indices[i], q.indices[j]);
        if vertex.is_some_and(|vertex| simplex.push(vertex)) {
            weights[simplex.vertices().len() - 1] = weight;
        }
    }
    (simplex, weights)
}

/// An iterator over weighted pairs of points from two lists. The weights of the pairs that contain a point add up to
/// the point's weight.
///
/// `m` and `n` positive weights make at most `m + n − 1` pairs: three for corner and face, and for edge
/// and edge.
pub(crate) struct PairedWeights {
    a: [f64; 3],
    b: [f64; 3],
    current_indices: (usize, usize),
}

impl PairedWeights {
    pub(crate) fn new(a: [f64; 3], b: [f64; 3]) -> Self {
        PairedWeights {
            a,
            b,
            current_indices: (0, 0),
        }
    }
}

impl Iterator for PairedWeights {
    type Item = (usize, usize, f64);

    fn next(&mut self) -> Option<Self::Item> {
        let (i, j) = self.current_indices;
        if i >= 3 || j >= 3 {
            return None;
        }
        let share = lesser(self.a[i], self.b[j]);
        self.a[i] -= share;
        self.b[j] -= share;
        // Both advance when both are used up.
        self.current_indices = (
            i + usize::from(self.a[i] <= self.b[j]),
            j + usize::from(self.b[j] <= self.a[i]),
        );
        match share {
            share if share > 0.0 => Some((i, j, share)),
            _ => self.next(),
        }
    }
}
