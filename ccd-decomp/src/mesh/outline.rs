//! The triangulation of polygons that the fan about their first corner does not fit.

use ccd_core::glam::DVec3;
use spade::handles::FixedVertexHandle;
use spade::{ConstrainedDelaunayTriangulation, Point2, Triangulation};
use std::panic::catch_unwind;

type Plane = ConstrainedDelaunayTriangulation<Point2<f64>>;

/// Fills a polygon with triangles, by the numbers of its corners: two fewer than corners, oriented like the
/// polygon, with each of its edges once.
///
/// None for a polygon that has a corner twice, or that meets itself when projected along the coordinate axis
/// nearest to its normal.
///
/// # Guarantee
/// Exact in that projection: triangles have an area and do not overlap. The same polygon gives the same
/// triangles.
pub(super) fn fill(points: &[DVec3]) -> Option<Vec<[usize; 3]>> {
    let places = projected(points)?;
    // A fault of the library may panic; the fan is used then.
    let plane = catch_unwind(|| triangulated(places)).ok()??;
    let count = points.len();
    let at = FixedVertexHandle::from_index;
    let has_outline = (0..count).all(|k| plane.exists_constraint(at(k), at((k + 1) % count)));
    if plane.num_vertices() != count || plane.num_constraints() != count || !has_outline {
        return None;
    }
    let mut triangles = within(&plane, count)?;
    triangles.sort_unstable();
    (triangles.len() == count - 2).then_some(triangles)
}

/// Projects the points along the coordinate axis nearest to their normal, so that they turn left.
fn projected(points: &[DVec3]) -> Option<Vec<Point2<f64>>> {
    let first = *points.first()?;
    let pairs = points.iter().zip(points.iter().cycle().skip(1));
    let normal: DVec3 = pairs.map(|(&p, &q)| (p - first).cross(q - first)).sum();
    let axis = normal.abs().max_position();
    let flat = |p: &DVec3| {
        let (x, y) = (p[(axis + 1) % 3], p[(axis + 2) % 3]);
        match normal[axis] > 0.0 {
            true => Point2::new(x, y),
            false => Point2::new(y, x),
        }
    };
    Some(points.iter().map(flat).collect())
}

/// Triangulates the points with the outline as edges; none where that is not possible.
fn triangulated(places: Vec<Point2<f64>>) -> Option<Plane> {
    let count = places.len();
    let edges = (0..count).map(|k| [k, (k + 1) % count]).collect();
    let mut conflicts = 0;
    let plane = Plane::try_bulk_load_cdt(places, edges, |_| conflicts += 1).ok()?;
    (conflicts == 0).then_some(plane)
}

/// Collects the triangles on the left of the outline.
fn within(plane: &Plane, count: usize) -> Option<Vec<[usize; 3]>> {
    let mut seen = vec![false; plane.num_all_faces()];
    let mut stack = Vec::new();
    for k in 0..count {
        let [from, to] = [k, (k + 1) % count].map(FixedVertexHandle::from_index);
        let edge = plane.get_edge_from_neighbors(from, to)?;
        stack.push(edge.face().as_inner()?.fix());
    }
    let mut triangles = Vec::with_capacity(count);
    // Every triangle is visited at most once for each of its edges.
    while let Some(face) = stack.pop() {
        if std::mem::replace(&mut seen[face.index()], true) {
            continue;
        }
        let face = plane.face(face);
        let mut corners = face.vertices().map(|v| v.index());
        let least = (0..3).min_by_key(|&k| corners[k])?;
        corners.rotate_left(least);
        triangles.push(corners);
        for edge in face.adjacent_edges() {
            if !edge.is_constraint_edge() {
                stack.push(edge.rev().face().as_inner()?.fix());
            }
        }
    }
    Some(triangles)
}

#[cfg(test)]
mod tests;
