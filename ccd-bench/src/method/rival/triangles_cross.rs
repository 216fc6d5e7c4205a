//! Tests whether two triangles have a point in common.

use ccd_core::glam::DVec3;
use ccd_core::order::{greater, lesser};

/// Returns true if two triangles touch or cross. It searches for an axis that separates them: the
/// normals, the cross products of edges, and, for triangles in one plane, the edges' normals in it.
///
/// The arithmetic is plain: triangles closer than rounding may go either way. Degenerate triangles
/// are treated as segments or points.
pub(super) fn triangles_cross(a: &[DVec3; 3], b: &[DVec3; 3]) -> bool {
    // Relative to one corner, so that triangles far from the origin lose no digits.
    let a = a.map(|p| p - b[0]);
    let b = b.map(|p| p - b[0]);
    let [edges_a, edges_b] = [edges(&a), edges(&b)];
    let normal_a = edges_a[0].cross(edges_a[1]);
    let normal_b = edges_b[0].cross(edges_b[1]);
    let apart = |axis: DVec3| separates(axis, &a, &b);
    if apart(normal_b) || apart(normal_a) {
        return false;
    }
    if edges_a
        .iter()
        .any(|&p| edges_b.iter().any(|&q| apart(p.cross(q))))
    {
        return false;
    }
    let in_plane =
        |edges: &[DVec3; 3], normal: DVec3| edges.iter().any(|&e| apart(normal.cross(e)));
    !(in_plane(&edges_a, normal_a) || in_plane(&edges_b, normal_b))
}

fn edges(t: &[DVec3; 3]) -> [DVec3; 3] {
    [t[1] - t[0], t[2] - t[1], t[0] - t[2]]
}

/// Returns true if all corners of one triangle precede those of the other along an axis.
#[inline]
fn separates(axis: DVec3, a: &[DVec3; 3], b: &[DVec3; 3]) -> bool {
    let [a, b] = [a, b].map(|t| t.map(|p| p.dot(axis)));
    let low = |x: [f64; 3]| lesser(lesser(x[0], x[1]), x[2]);
    let high = |x: [f64; 3]| greater(greater(x[0], x[1]), x[2]);
    low(a) > high(b) || low(b) > high(a)
}

#[cfg(test)]
mod tests;
