//! Better axes than the difference of the nearest points: those of the features they lie on.

use super::minkowski::{Difference, Exact};
use super::search::Found;
use super::simplex::Vertex;
use crate::axis::{Candidates, Corners};
use crate::tolerance::KEEP;
use ccd_core::glam::DVec3;

/// Tries the axes of the features that hold the nearest points; the vertex that is least along the
/// best one, if any was better than what is known.
///
/// The features' own gap bounds that of the hulls from above, so that axes are tried in its order,
/// and only while it promises more.
pub(crate) fn to_features(exact: &Exact<'_>, found: &mut Found<DVec3>) -> Option<Vertex<DVec3>> {
    let vertices = found.simplex.vertices();
    let p = corners(vertices.iter().map(|v| (v.a, exact.point_a(v.a))))?;
    let q = corners(vertices.iter().map(|v| (v.b, exact.point_b(v.b))))?;
    let w = vertices
        .iter()
        .zip(found.weights)
        .fold(DVec3::ZERO, |sum, (v, weight)| sum + weight * v.point);
    let enough = KEEP * found.square.sqrt();
    let mut least = None;
    for axis in Candidates::new(&p, &q, w).ranked() {
        if !(axis.gap > found.gap) || found.gap >= enough && found.gap > 0.0 {
            break;
        }
        let before = found.gap;
        let (vertex, gap) = found.probe(exact, axis.direction);
        if gap > before {
            least = Some(vertex);
        }
    }
    least
}

/// Tries the faces of a simplex that encloses the origin: the axes of the least way out of it.
pub(crate) fn to_faces(exact: &Exact<'_>, found: &mut Found<DVec3>) {
    let corners = found.simplex.vertices();
    let Ok([a, b, c, d]) = <[Vertex<DVec3>; 4]>::try_from(corners) else {
        return;
    };
    for [a, b, c] in [[a, b, c], [a, b, d], [a, c, d], [b, c, d]] {
        let n = (b.point - a.point).cross(c.point - a.point);
        let inward = if n.dot(a.point) > 0.0 { -n } else { n };
        if let Some(axis) = inward.try_normalize() {
            found.probe(exact, axis);
        }
    }
}

/// Up to three different points, the last one repeated.
fn corners(points: impl Iterator<Item = (u32, Option<DVec3>)>) -> Option<Corners> {
    let (mut indices, mut corners, mut len) = ([0; 3], [DVec3::ZERO; 3], 0);
    for (index, point) in points {
        if len < 3 && !indices[..len].contains(&index) {
            indices[len] = index;
            corners[len..].fill(point?);
            len += 1;
        }
    }
    (len > 0).then_some(corners)
}
