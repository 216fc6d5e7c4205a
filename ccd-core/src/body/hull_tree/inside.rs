//! Tests exactly whether points are in a convex hull `[SHE97]`.

use super::loops::PolygonList;
use crate::body::facets::fan_triangles;
use crate::math::exact::{is_degenerate, side_of_line_along, side_of_plane};
use crate::math::point_tree::PointTree;
use glam::DVec3;
use std::cmp::Ordering;

/// A convex hull with its facets cut into triangles, for exact tests of which points it contains.
pub(super) struct PreparedHull<'a> {
    points: &'a [DVec3],
    /// The facets as fans of triangles.
    fan_triangles: Vec<[DVec3; 3]>,
    /// The corners of the first facet. A point in the planes of all facets is inside only if this polygon contains it.
    first_facet_corners: Vec<DVec3>,
}

impl<'a> PreparedHull<'a> {
    /// Cuts the facets of a hull into triangles, to test which points the hull contains. Every edge of the facets must
    /// occur exactly once in reverse in another facet.
    pub(super) fn new(points: &'a [DVec3], facets: &PolygonList) -> Self {
        let at = |&v: &u32| points[v as usize];
        let fans = facets.iter().flat_map(fan_triangles);
        PreparedHull {
            points,
            fan_triangles: fans.map(|fan| fan.map(|v| at(&v))).collect(),
            first_facet_corners: facets
                .get(0)
                .map_or(Vec::new(), |corners| corners.iter().map(at).collect()),
        }
    }

    /// Returns the index of the first point that is not certainly inside the hull.
    ///
    /// # Guarantee
    /// The test is exact, and sound for any facets. A closed surface with its corners in the hull winds 0 times about
    /// a point outside of the hull. If the point is in front of no facet, the solid angles of all facets at the point
    /// have one sign. They must then all be 0, and the point is behind no facet.
    ///
    /// # Complexity
    /// O(n log n) for n points and facets in all, if few points are near each facet.
    pub(super) fn first_point_outside(&self, positions: &[DVec3]) -> Option<usize> {
        if self.fan_triangles.is_empty() {
            return positions
                .iter()
                .position(|&p| !is_in_simplex(self.points, p));
        }
        if positions.is_empty() {
            return None;
        }
        let tree = PointTree::new(positions);
        let mut outside = vec![false; positions.len()];
        // The facets whose planes contain the point, which is behind all others.
        let mut level = vec![0; positions.len()];
        for &triangle in &self.fan_triangles {
            tree.for_each_not_behind(triangle, |k| {
                match side_of_plane(triangle, positions[k as usize]) {
                    Ordering::Less => {}
                    Ordering::Equal => level[k as usize] += 1,
                    Ordering::Greater => outside[k as usize] = true,
                }
            });
        }
        (0..positions.len()).find(|&k| {
            let behind = level[k] < self.fan_triangles.len();
            outside[k] || !(behind || is_in_polygon(&self.first_facet_corners, positions[k]))
        })
    }
}

/// Returns whether a point is equal to one point, on a segment of two points, or in a triangle of three points.
fn is_in_simplex(points: &[DVec3], point: DVec3) -> bool {
    match *points {
        [a] => a == point,
        [a, b] => is_on_segment(a, b, point),
        [a, b, c] => {
            let edges = [(a, b), (b, c), (c, a)];
            edges.iter().any(|&(a, b)| is_on_segment(a, b, point)) || is_in_polygon(points, point)
        }
        _ => false,
    }
}

fn is_on_segment(a: DVec3, b: DVec3, point: DVec3) -> bool {
    let between = point.cmpge(a.min(b)).all() && point.cmple(a.max(b)).all();
    between && is_degenerate([a, b, point])
}

/// Returns whether a triangle is in the plane of a polygon, with the same orientation.
pub(super) fn is_coplanar_and_cooriented(polygon: &[DVec3], triangle: [DVec3; 3]) -> bool {
    projectable_corners(polygon).is_some_and(|(fan, axis)| {
        let in_plane = |&p: &DVec3| side_of_plane(fan, p).is_eq();
        let turn = |[a, b, c]: [DVec3; 3]| side_of_line_along(axis, [a, b], c);
        let same_side = turn(fan).is_gt() == turn(triangle).is_gt();
        same_side && triangle.iter().all(in_plane)
    })
}

/// Returns three corners of a polygon whose projection along a coordinate axis is not degenerate, and that axis.
pub(super) fn projectable_corners(polygon: &[DVec3]) -> Option<([DVec3; 3], usize)> {
    (1..polygon.len().saturating_sub(1)).find_map(|k| {
        let fan = [0, k, k + 1].map(|k| polygon[k]);
        let [a, b, c] = fan;
        let axis = (0..3).find(|&axis| side_of_line_along(axis, [a, b], c).is_ne())?;
        Some((fan, axis))
    })
}

/// Returns whether a point is in the plane of a polygon and in the convex hull of its corners.
fn is_in_polygon(corners: &[DVec3], point: DVec3) -> bool {
    let Some((fan, axis)) = projectable_corners(corners) else {
        return false;
    };
    let [a, b, c] = fan;
    let front = side_of_line_along(axis, [a, b], c);
    let in_plane = |p: &DVec3| side_of_plane(fan, *p).is_eq();
    if !(in_plane(&point) && corners.iter().all(in_plane)) {
        return false;
    }
    let mut inner = false;
    for (k, &from) in corners.iter().enumerate() {
        let to = corners[(k + 1) % corners.len()];
        let turn = side_of_line_along(axis, [from, to], point);
        if turn.is_eq() {
            continue;
        }
        if turn != front {
            return false;
        }
        inner = true;
    }
    inner
}
