//! Triangles of a convex surface that lie in one plane, as one polygon.

use crate::predicates::{Projection, side};
use ccd_core::glam::DVec3;
use std::cmp::Ordering;

/// Triangles of a convex surface that fill a convex polygon.
#[derive(Clone, Debug)]
pub(crate) struct Polygon {
    /// Its strict corners, counter-clockwise seen from outside.
    pub(crate) corners: Vec<u32>,
    /// The triangles, as indices into those given, in ascending order.
    pub(crate) triangles: Vec<u32>,
}

/// The convex polygons that a closed convex surface of triangles consists of.
///
/// Exact: polygons are in one plane precisely. The two sides of a flat surface are two polygons.
pub(crate) fn polygons(points: &[DVec3], triangles: &[[u32; 3]]) -> Vec<Polygon> {
    let surface = Surface::new(points, triangles);
    let group_of = surface.groups();
    let count = group_of.iter().max().map_or(0, |&last| last as usize + 1);
    let mut groups = vec![Group::default(); count];
    for (t, &number) in group_of.iter().enumerate() {
        let group = &mut groups[number as usize];
        group.triangles.push(t as u32);
        let inner = |k: usize| {
            surface
                .twins(t, k)
                .any(|(twin, _)| group_of[twin] == number)
        };
        let rim = (0..3).filter(|&k| !inner(k)).map(|k| surface.edge(t, k));
        group.rim.extend(rim);
    }
    let polygon = |group: Group| {
        let first = *group.triangles.first()?;
        let plane = Projection::of(triangles[first as usize].map(|v| points[v as usize]))?;
        Some(Polygon {
            corners: strict_corners(points, &chained(group.rim), plane),
            triangles: group.triangles,
        })
    };
    groups.into_iter().filter_map(polygon).collect()
}

#[derive(Clone, Default)]
struct Group {
    triangles: Vec<u32>,
    /// The directed edges around it.
    rim: Vec<(u32, u32)>,
}

/// Drops the corners of a convex loop at which it goes straight on.
pub(crate) fn strict_corners(points: &[DVec3], rim: &[u32], plane: Projection) -> Vec<u32> {
    let at = |k: usize| points[rim[k % rim.len()] as usize];
    (0..rim.len())
        .filter(|&k| plane.turn(at(k + rim.len() - 1), at(k), at(k + 1)) != Ordering::Equal)
        .map(|k| rim[k])
        .collect()
}

/// The directed edges of one loop, one after the other, as the loop of their first ends.
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
    /// Directed edges, sorted, with the triangle and the place in it that each starts from.
    edges: Vec<(u32, u32, u32, u8)>,
}

impl<'a> Surface<'a> {
    fn new(points: &'a [DVec3], triangles: &'a [[u32; 3]]) -> Self {
        let edge = |t: usize, k: usize| {
            let triangle = triangles[t];
            (triangle[k], triangle[(k + 1) % 3], t as u32, k as u8)
        };
        let mut edges: Vec<_> = (0..triangles.len())
            .flat_map(|t| (0..3).map(move |k| edge(t, k)))
            .collect();
        edges.sort_unstable();
        Surface {
            points,
            triangles,
            edges,
        }
    }

    fn edge(&self, triangle: usize, k: usize) -> (u32, u32) {
        let corners = self.triangles[triangle];
        (corners[k], corners[(k + 1) % 3])
    }

    /// The triangles beyond an edge, and where in each the edge starts; the two sides of a flat surface
    /// may have edges in common, so that there are two.
    fn twins(&self, triangle: usize, k: usize) -> impl Iterator<Item = (usize, usize)> {
        let (a, b) = self.edge(triangle, k);
        let first = self.edges.partition_point(|e| (e.0, e.1) < (b, a));
        let same = self.edges[first..]
            .iter()
            .take_while(move |e| (e.0, e.1) == (b, a));
        same.map(|e| (e.2 as usize, e.3 as usize))
    }

    /// The number of every triangle's group: one plane, one side, connected.
    fn groups(&self) -> Vec<u32> {
        const UNSEEN: u32 = u32::MAX;
        let mut group_of = vec![UNSEEN; self.triangles.len()];
        let mut count = 0;
        let mut stack = Vec::new();
        for seed in 0..self.triangles.len() {
            if group_of[seed] != UNSEEN {
                continue;
            }
            group_of[seed] = count;
            stack.push(seed);
            while let Some(t) = stack.pop() {
                for (next, l) in (0..3).flat_map(|k| self.twins(t, k)) {
                    if group_of[next] == UNSEEN && self.goes_on(t, next, l) {
                        group_of[next] = count;
                        stack.push(next);
                    }
                }
            }
            count += 1;
        }
        group_of
    }

    /// Whether a triangle's plane goes on in its neighbour, on the same side.
    fn goes_on(&self, triangle: usize, next: usize, l: usize) -> bool {
        let corners = self.triangles[triangle].map(|v| self.points[v as usize]);
        let beyond = self.triangles[next].map(|v| self.points[v as usize]);
        let far = beyond[(l + 2) % 3];
        side(corners, far) == Ordering::Equal
            && Projection::of(corners).is_some_and(|plane| {
                plane.turn(beyond[l], beyond[(l + 1) % 3], far) == Ordering::Greater
            })
    }
}

#[cfg(test)]
mod tests;
