//! Triangulates polygons that a triangle fan about the first corner does not cover exactly.

use crate::exact::predicates::has_zero_area;
use ccd_core::glam::DVec3;
use spade::handles::FixedVertexHandle;
use spade::{ConstrainedDelaunayTriangulation, HierarchyHintGenerator, Point2, Triangulation};
use std::cmp::Ordering;
use std::collections::VecDeque;
use std::panic::catch_unwind;

type OutlineTriangulation =
    ConstrainedDelaunayTriangulation<Point2<f64>, (), (), (), HierarchyHintGenerator<f64>>;

/// Triangulates a polygon of `n` corners, which may repeat the corner before or turn back on its own line, into `n − 2`
/// triangles. Triangles are given by corner numbers.
///
/// Returns `None` if the polygon without its flat corners cannot be [triangulated](triangulate_outline).
///
/// # Guarantee
/// The triangles cover every point of the outline. Those of flat corners have no area; the others are as
/// [`triangulate_outline`] makes them.
pub(super) fn fill_outline(points: &[DVec3]) -> Option<Vec<[usize; 3]>> {
    let (outline, mut triangles) = cut_flat_corners(points);
    if outline.len() == 3 {
        triangles.push([outline[0], outline[1], outline[2]]);
        return Some(triangles);
    }
    let rest: Vec<DVec3> = outline.iter().map(|&k| points[k]).collect();
    let filled = triangulate_outline(&rest)?;
    triangles.extend(filled.iter().map(|triangle| triangle.map(|k| outline[k])));
    Some(triangles)
}

/// Cuts off flat corners until there are none, or three corners are left. A corner is flat if it is at the same point as one
/// beside it, or if the outline turns back there on its own line. Returns the corners that are left, and each flat corner
/// between those beside it: a triangle without area.
fn cut_flat_corners(points: &[DVec3]) -> (Vec<usize>, Vec<[usize; 3]>) {
    let is_flat = |corners: [usize; 3]| {
        let [a, b, c] = corners.map(|k| points[k]);
        let turns_back = (b - a).dot(c - b).partial_cmp(&0.0) != Some(Ordering::Greater);
        turns_back && has_zero_area([a, b, c])
    };
    let mut count = points.len();
    let (mut kept, mut flat) = (Vec::new(), Vec::new());
    for corner in 0..points.len() {
        // A cut changes the angle at the corner before it.
        while let [.., a, b] = kept[..]
            && count > 3
            && is_flat([a, b, corner])
        {
            kept.pop();
            flat.push([a, b, corner]);
            count -= 1;
        }
        kept.push(corner);
    }
    let mut ring = VecDeque::from(kept);
    // Each step cuts the last corner or the first.
    while ring.len() > 3 {
        let ends = [ring[ring.len() - 2], ring[ring.len() - 1], ring[0], ring[1]];
        if is_flat([ends[0], ends[1], ends[2]]) {
            flat.push([ends[0], ends[1], ends[2]]);
            ring.pop_back();
        } else if is_flat([ends[1], ends[2], ends[3]]) {
            flat.push([ends[1], ends[2], ends[3]]);
            ring.pop_front();
        } else {
            break;
        }
    }
    (ring.into(), flat)
}

/// Triangulates a polygon of `n` corners into `n − 2` triangles, oriented like the polygon. Triangles are given by
/// corner numbers.
///
/// Returns `None` if the polygon repeats a corner, or intersects itself when projected along the coordinate axis
/// nearest to its normal.
///
/// # Guarantee
/// Exact in that projection: triangles have an area and do not overlap. The same polygon gives the same
/// triangles.
///
/// # Complexity
/// Expected `n log n` for `n` corners: corners and edges are inserted in a pseudorandom order. A sweep takes `n²` for
/// corners on or near a line.
fn triangulate_outline(points: &[DVec3]) -> Option<Vec<[usize; 3]>> {
    let places = project_to_coordinate_plane(points)?;
    // A fault of the library may panic; the fan is used then.
    let order = corner_insertion_order(&places)?;
    let (plane, at) = catch_unwind(|| triangulate_constrained(&places, &order)).ok()??;
    let mut triangles = triangles_inside(&plane, &at, &order)?;
    triangles.sort_unstable();
    (triangles.len() == points.len() - 2).then_some(triangles)
}

/// Projects the corners to the coordinate plane nearest to the polygon's plane, counterclockwise.
fn project_to_coordinate_plane(points: &[DVec3]) -> Option<Vec<Point2<f64>>> {
    let first = *points.first()?;
    let pairs = points.iter().zip(points.iter().cycle().skip(1));
    let normal: DVec3 = pairs.map(|(&p, &q)| (p - first).cross(q - first)).sum();
    let axis = normal.abs().max_position();
    let flat = |p: &DVec3| {
        let (x, y) = (p[(axis + 1) % 3], p[(axis + 2) % 3]);
        if normal[axis] > 0.0 {
            Point2::new(x, y)
        } else {
            Point2::new(y, x)
        }
    };
    Some(points.iter().map(flat).collect())
}

/// Triangulates the points with the outline as constraint edges. Returns the triangulation's vertex for each point;
/// `None` if it fails.
fn triangulate_constrained(
    places: &[Point2<f64>],
    order: &[usize],
) -> Option<(OutlineTriangulation, Vec<FixedVertexHandle>)> {
    let count = places.len();
    let mut plane = OutlineTriangulation::new();
    let mut at = vec![FixedVertexHandle::from_index(0); count];
    for (done, &number) in order.iter().enumerate() {
        at[number] = plane.insert(places[number]).ok()?;
        if plane.num_vertices() == done {
            return None;
        }
    }
    for &number in order {
        let [from, to] = [at[number], at[(number + 1) % count]];
        // An edge through a corner would be several.
        if plane.try_add_constraint(from, to).len() != 1 {
            return None;
        }
    }
    (plane.num_constraints() == count).then_some((plane, at))
}

/// Returns the order of insertion: first three corners that span a triangle, then the others in pseudorandom order.
/// The library scans all points while they are collinear. Returns `None` if all are collinear.
fn corner_insertion_order(places: &[Point2<f64>]) -> Option<Vec<usize>> {
    let point = |k: usize| DVec3::new(places[k].x, places[k].y, 0.0);
    let second = (1..places.len()).find(|&k| places[k] != places[0])?;
    let spans = |&k: &usize| !has_zero_area([point(0), point(second), point(k)]);
    let third = (1..places.len()).find(spans)?;
    let mut order: Vec<usize> = (0..places.len()).collect();
    order.sort_by_cached_key(|&k| {
        if [0, second, third].contains(&k) {
            0
        } else {
            hash(k as u64)
        }
    });
    Some(order)
}

/// Hashes a number by the finalizer of SplitMix64.
fn hash(number: u64) -> u64 {
    let mut bits = number.wrapping_mul(0x9e37_79b9_7f4a_7c15);
    bits = (bits ^ (bits >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    bits = (bits ^ (bits >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    bits ^ (bits >> 31)
}

/// Collects the triangles of a triangulation that are inside the outline.
fn triangles_inside(
    plane: &OutlineTriangulation,
    at: &[FixedVertexHandle],
    order: &[usize],
) -> Option<Vec<[usize; 3]>> {
    let mut seen = vec![false; plane.num_all_faces()];
    let (mut stack, count) = (Vec::new(), at.len());
    for k in 0..count {
        let edge = plane.get_edge_from_neighbors(at[k], at[(k + 1) % count])?;
        stack.push(edge.face().as_inner()?.fix());
    }
    let mut triangles = Vec::with_capacity(count);
    // Every triangle is visited at most once for each of its edges.
    while let Some(face) = stack.pop() {
        if std::mem::replace(&mut seen[face.index()], true) {
            continue;
        }
        let face = plane.face(face);
        let mut corners = face.vertices().map(|v| order[v.index()]);
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
