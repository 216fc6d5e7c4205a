//! Coplanar triangles of a convex surface, merged into polygons.

use crate::exact::predicates::{Projection, side};
use crate::half_edges::twins;
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

/// Merges the triangles of a closed convex surface into convex polygons.
///
/// Exact: the corners of a polygon are exactly coplanar. A flat surface has two polygons, front and back.
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
    let count = group_of.iter().max().map_or(0, |&last| last as usize + 1);
    // Lists the triangles group by group, each group in ascending order.
    let mut ends = vec![0; count];
    group_of.iter().for_each(|&k| ends[k as usize] += 1);
    let mut end = 0;
    for next in &mut ends {
        end += std::mem::replace(next, end);
    }
    let mut members = vec![0; triangles.len()];
    for (t, &number) in (0..).zip(&group_of) {
        members[ends[number as usize] as usize] = t;
        ends[number as usize] += 1;
    }
    let starts = std::iter::once(&0).chain(&ends);
    for (&start, &end) in starts.zip(&ends) {
        let group = &members[start as usize..end as usize];
        let first = triangles[members[start as usize] as usize];
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
    /// The twin of the edge from corner `k` of triangle `t`, at `3 t + k`; empty if any edge does not have exactly one.
    pairs: Vec<u32>,
    /// The directed edges in that case, sorted, each with its triangle and start corner.
    edges: Vec<(u32, u32, u32, u8)>,
}

impl<'a> Surface<'a> {
    fn new(points: &'a [DVec3], triangles: &'a [[u32; 3]]) -> Self {
        let surface = Surface {
            points,
            triangles,
            pairs: twins(triangles).unwrap_or_default(),
            edges: Vec::new(),
        };
        if surface.pairs.is_empty() {
            surface.with_edges()
        } else {
            surface
        }
    }

    fn with_edges(mut self) -> Self {
        let triangles = self.triangles;
        let edge = |t: usize, k: usize| {
            let triangle = triangles[t];
            (triangle[k], triangle[(k + 1) % 3], t as u32, k as u8)
        };
        self.pairs = Vec::new();
        self.edges = (0..triangles.len())
            .flat_map(|t| (0..3).map(move |k| edge(t, k)))
            .collect();
        self.edges.sort_unstable();
        self
    }

    /// Returns the corners of the polygon of a group of coplanar triangles.
    fn corners(&self, group: &[u32], group_of: &[u32], plane: Projection) -> Vec<u32> {
        let is_inner = |t: usize, k: usize| {
            let mut twins = self.twins(t, k);
            twins.any(|(twin, _)| group_of[twin] == group_of[t])
        };
        let edges = group
            .iter()
            .flat_map(|&t| (0..3).map(move |k| (t as usize, k)));
        let rim = edges.filter(|&(t, k)| !is_inner(t, k));
        let rim = rim.map(|(t, k)| self.edge(t, k)).collect();
        strict_corners(self.points, &chained(rim), plane)
    }

    fn edge(&self, triangle: usize, k: usize) -> (u32, u32) {
        let corners = self.triangles[triangle];
        (corners[k], corners[(k + 1) % 3])
    }

    /// Iterates over the triangles beyond an edge, with their start corners. The two sides of a flat surface may share
    /// edges, so that there may be two.
    fn twins(&self, triangle: usize, k: usize) -> impl Iterator<Item = (usize, usize)> {
        let (a, b) = self.edge(triangle, k);
        let first = self.edges.partition_point(|e| (e.0, e.1) < (b, a));
        let same = self.edges[first..]
            .iter()
            .take_while(move |e| (e.0, e.1) == (b, a));
        let pair = self.pairs.get(3 * triangle + k).copied();
        let pair = pair.map(|edge| (edge as usize / 3, edge as usize % 3));
        pair.into_iter()
            .chain(same.map(|e| (e.2 as usize, e.3 as usize)))
    }

    /// Returns the group of each triangle: connected coplanar triangles with one normal.
    fn groups(&self) -> Vec<u32> {
        const UNSEEN: u32 = u32::MAX;
        let mut group_of = vec![UNSEEN; self.triangles.len()];
        let mut count = 0;
        // An edge that ends a group does so from both sides.
        let mut ends_at = vec![false; self.pairs.len()];
        let mut stack = Vec::new();
        for seed in 0..self.triangles.len() {
            if group_of[seed] != UNSEEN {
                continue;
            }
            group_of[seed] = count;
            stack.push(seed);
            while let Some(t) = stack.pop() {
                for (k, (next, l)) in (0..3).flat_map(|k| self.twins(t, k).map(move |n| (k, n))) {
                    let is_known = ends_at.get(3 * t + k) == Some(&true);
                    if is_known || group_of[next] != UNSEEN {
                        continue;
                    }
                    if self.goes_on(t, next, l) {
                        group_of[next] = count;
                        stack.push(next);
                    } else if let Some(ends) = ends_at.get_mut(3 * next + l) {
                        *ends = true;
                    }
                }
            }
            count += 1;
        }
        group_of
    }

    /// Returns whether a neighbour continues a triangle's plane, with the same normal.
    fn goes_on(&self, triangle: usize, next: usize, l: usize) -> bool {
        let corners = self.triangles[triangle].map(|v| self.points[v as usize]);
        let beyond = self.triangles[next].map(|v| self.points[v as usize]);
        let far = beyond[(l + 2) % 3];
        side(corners, far) == Ordering::Equal
            && Projection::new(corners).is_some_and(|plane| {
                plane.turn(beyond[l], beyond[(l + 1) % 3], far) == Ordering::Greater
            })
    }
}

#[cfg(test)]
mod tests;
