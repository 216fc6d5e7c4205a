//! Merges coplanar triangles of a convex surface into polygons.

use crate::disjoint_sets::DisjointSets;
use crate::exact::predicates::{Projection, side_of};
use crate::half_edges::{HalfEdge, twins};
use ccd_core::PolygonList;
use ccd_core::glam::DVec3;
use std::cmp::Ordering;

/// Merges triangles like [`for_each_merged_polygon`], and returns the corners of each polygon.
pub(crate) fn merged_polygons(points: &[DVec3], triangles: &[[u32; 3]]) -> PolygonList {
    let mut loops = PolygonList::with_capacity(triangles.len(), 3 * triangles.len());
    for_each_merged_polygon(points, triangles, |corners, _| loops.push(corners));
    loops
}

/// Merges the triangles of a closed convex surface around a volume into convex polygons. Calls `visit` for each, with
/// its strict corners, counter-clockwise seen from outside, and the indices of its triangles, in ascending order.
///
/// Exact: the corners of a polygon are exactly coplanar.
pub(crate) fn for_each_merged_polygon(
    points: &[DVec3],
    triangles: &[[u32; 3]],
    mut visit: impl FnMut(&[u32], &[u32]),
) {
    // A closed surface has all twins; without them each triangle is a polygon.
    let twins = twins(triangles).unwrap_or_default();
    let group_of = coplanar_group_by_triangle(points, triangles, &twins);
    // Sorting is stable: each group is in ascending order.
    let mut members: Vec<u32> = (0..triangles.len() as u32).collect();
    members.sort_by_key(|&t| group_of[t as usize]);
    for group in members.chunk_by(|&t, &u| group_of[t as usize] == group_of[u as usize]) {
        let first = triangles[group[0] as usize];
        let Some(plane) = Projection::new(first.map(|v| points[v as usize])) else {
            continue;
        };
        match group {
            [_] => visit(&with_smallest_corner_first(first), group),
            _ => {
                let rim = chain_edges(boundary_edges(triangles, &twins, group, &group_of));
                visit(&strictly_convex_corners(points, &rim, plane), group);
            }
        }
    }
}

/// Returns the corners of a convex polygon, except those at which the interior angle is 180°.
pub(crate) fn strictly_convex_corners(
    points: &[DVec3],
    rim: &[u32],
    plane: Projection,
) -> Vec<u32> {
    let at = |k: usize| points[rim[k % rim.len()] as usize];
    (0..rim.len())
        .filter(|&k| plane.turn(at(k + rim.len() - 1), at(k), at(k + 1)) != Ordering::Equal)
        .map(|k| rim[k])
        .collect()
}

/// Rotates the corners of a triangle cyclically so that the smallest index comes first.
pub(crate) fn with_smallest_corner_first([a, b, c]: [u32; 3]) -> [u32; 3] {
    if a <= b && a <= c {
        [a, b, c]
    } else if b <= c {
        [b, c, a]
    } else {
        [c, a, b]
    }
}

/// Sorts the directed edges of one closed loop into a list of consecutive vertices.
fn chain_edges(mut rim: Vec<(u32, u32)>) -> Vec<u32> {
    rim.sort_unstable();
    let Some(&(first, mut at)) = rim.first() else {
        return Vec::new();
    };
    let mut corners = vec![first];
    while at != first && corners.len() < rim.len() {
        corners.push(at);
        match rim.binary_search_by_key(&at, |edge| edge.0) {
            Ok(k) => at = rim[k].1,
            Err(_) => break,
        }
    }
    corners
}

/// Returns the directed boundary edges of a group of triangles, each as its two end vertices.
fn boundary_edges(
    triangles: &[[u32; 3]],
    twins: &[HalfEdge],
    group: &[u32],
    group_of: &[u32],
) -> Vec<(u32, u32)> {
    let edges = group.iter().flat_map(|&t| 3 * t..3 * t + 3);
    let is_outer = |&edge: &HalfEdge| {
        let twin = twins.get(edge as usize);
        twin.is_none_or(|twin| group_of[*twin as usize / 3] != group_of[edge as usize / 3])
    };
    let ends = |edge: HalfEdge| {
        let corners = triangles[edge as usize / 3];
        let k = edge as usize % 3;
        (corners[k], corners[(k + 1) % 3])
    };
    edges.filter(is_outer).map(ends).collect()
}

/// Returns, for each triangle, the number of its group of connected coplanar triangles.
fn coplanar_group_by_triangle(
    points: &[DVec3],
    triangles: &[[u32; 3]],
    twins: &[HalfEdge],
) -> Vec<u32> {
    let mut groups = DisjointSets::new(triangles.len());
    for (edge, &twin) in (0..).zip(twins).filter(|(edge, twin)| edge < *twin) {
        let [one, other] = [edge, twin].map(|edge| edge / 3);
        let far = triangles[other as usize][(twin as usize + 2) % 3];
        // The predicate is slow in a plane.
        if groups.root(one) != groups.root(other)
            && side_of(points, triangles[one as usize], far) == Ordering::Equal
        {
            groups.join(one, other);
        }
    }
    groups.set_index_by_element()
}

#[cfg(test)]
mod tests;
