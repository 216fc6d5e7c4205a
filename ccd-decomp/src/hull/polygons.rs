//! Coplanar triangles of a convex surface, merged into polygons.

use crate::disjoint_sets::DisjointSets;
use crate::exact::predicates::{Projection, side_of};
use crate::half_edges::{HalfEdge, twins};
use ccd_core::Loops;
use ccd_core::glam::DVec3;
use std::cmp::Ordering;

/// A convex polygon that triangles of a convex surface fill.
#[derive(Clone, Debug)]
pub(crate) struct Polygon {
    /// The strict corners, counter-clockwise seen from outside.
    pub(crate) corners: Vec<u32>,
    /// The indices of the triangles, in ascending order.
    pub(crate) triangles: Vec<u32>,
}

/// Merges the triangles of a closed convex surface around a volume into convex polygons.
///
/// Exact: the corners of a polygon are exactly coplanar.
pub(crate) fn polygons(points: &[DVec3], triangles: &[[u32; 3]]) -> Vec<Polygon> {
    let mut polygons = Vec::new();
    for_each_polygon(points, triangles, |corners, group| {
        polygons.push(Polygon {
            corners: corners.to_vec(),
            triangles: group.to_vec(),
        });
    });
    polygons
}

/// Merges triangles like [polygons], and returns only the corners.
pub(crate) fn loops(points: &[DVec3], triangles: &[[u32; 3]]) -> Loops {
    let mut loops = Loops::with_capacity(triangles.len(), 3 * triangles.len());
    for_each_polygon(points, triangles, |corners, _| loops.push(corners));
    loops
}

fn for_each_polygon(
    points: &[DVec3],
    triangles: &[[u32; 3]],
    mut visit: impl FnMut(&[u32], &[u32]),
) {
    let surface = Surface::new(points, triangles);
    let group_of = surface.groups();
    // Sorting is stable: each group is in ascending order.
    let mut members: Vec<u32> = (0..triangles.len() as u32).collect();
    members.sort_by_key(|&t| group_of[t as usize]);
    for group in members.chunk_by(|&t, &u| group_of[t as usize] == group_of[u as usize]) {
        let first = triangles[group[0] as usize];
        let Some(plane) = Projection::new(first.map(|v| points[v as usize])) else {
            continue;
        };
        match group {
            [_] => visit(&smallest_first(first), group),
            _ => visit(&surface.corners(group, &group_of, plane), group),
        }
    }
}

/// Drops the corners of a convex loop at which it is straight.
pub(crate) fn strict_corners(points: &[DVec3], rim: &[u32], plane: Projection) -> Vec<u32> {
    let at = |k: usize| points[rim[k % rim.len()] as usize];
    (0..rim.len())
        .filter(|&k| plane.turn(at(k + rim.len() - 1), at(k), at(k + 1)) != Ordering::Equal)
        .map(|k| rim[k])
        .collect()
}

/// Rotates a triangle so that its smallest corner comes first.
pub(crate) fn smallest_first([a, b, c]: [u32; 3]) -> [u32; 3] {
    if a <= b && a <= c {
        [a, b, c]
    } else if b <= c {
        [b, c, a]
    } else {
        [c, a, b]
    }
}

/// Chains the directed edges of one loop to a list of vertices.
fn chained(mut rim: Vec<(u32, u32)>) -> Vec<u32> {
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

struct Surface<'a> {
    points: &'a [DVec3],
    triangles: &'a [[u32; 3]],
    /// The twin of every half-edge; empty if any does not have exactly one.
    twins: Vec<HalfEdge>,
}

impl<'a> Surface<'a> {
    fn new(points: &'a [DVec3], triangles: &'a [[u32; 3]]) -> Self {
        Surface {
            points,
            triangles,
            twins: twins(triangles).unwrap_or_default(),
        }
    }

    /// Returns the corners of the polygon of a group of coplanar triangles.
    fn corners(&self, group: &[u32], group_of: &[u32], plane: Projection) -> Vec<u32> {
        let edges = group.iter().flat_map(|&t| 3 * t..3 * t + 3);
        let is_outer = |&edge: &HalfEdge| {
            let twin = self.twins.get(edge as usize);
            twin.is_none_or(|twin| group_of[*twin as usize / 3] != group_of[edge as usize / 3])
        };
        let ends = |edge: HalfEdge| {
            let corners = self.triangles[edge as usize / 3];
            let k = edge as usize % 3;
            (corners[k], corners[(k + 1) % 3])
        };
        let rim = edges.filter(is_outer).map(ends).collect();
        strict_corners(self.points, &chained(rim), plane)
    }

    /// Returns the group of each triangle: connected coplanar triangles.
    fn groups(&self) -> Vec<u32> {
        let mut groups = DisjointSets::new(self.triangles.len());
        for (edge, &twin) in (0..).zip(&self.twins).filter(|(edge, twin)| edge < *twin) {
            let [one, other] = [edge, twin].map(|edge| edge / 3);
            let triangle = self.triangles[one as usize];
            let far = self.triangles[other as usize][(twin as usize + 2) % 3];
            // The predicate is slow in a plane.
            if groups.root(one) != groups.root(other)
                && side_of(self.points, triangle, far) == Ordering::Equal
            {
                groups.join(one, other);
            }
        }
        groups.numbers()
    }
}

#[cfg(test)]
mod tests;
