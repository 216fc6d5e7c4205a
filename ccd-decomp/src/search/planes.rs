//! Planes, and tests that separate oriented boxes from a shape.

use super::oriented_box::OrientedBox;
use super::region::{Hull, Shape};
use crate::exact::predicates::{Projection, side_of_line_along, side_of_plane};
use ccd_core::glam::DVec3;
use ccd_core::rounding::height_rounding;
use std::cmp::Ordering;

/// A plane through a point, with a normal of any length.
#[derive(Clone, Copy, Debug)]
pub(super) struct Plane {
    point: DVec3,
    normal: DVec3,
    max_abs_coordinate: f64,
    /// A bound on the rounding error of heights above the plane, per unit of the largest coordinate.
    relative_rounding: f64,
}

impl Plane {
    fn new(foot: DVec3, [u, v]: [DVec3; 2]) -> Self {
        Plane {
            point: foot,
            normal: u.cross(v),
            max_abs_coordinate: foot.abs().max_element(),
            // Twice, to cover three axes.
            relative_rounding: 2.0 * height_rounding([u, v], 1.0),
        }
    }

    fn from_triangle([a, b, c]: [DVec3; 3]) -> Self {
        Plane::new(a, [b - a, c - a])
    }

    /// Returns whether a box is certainly in front of the plane.
    #[inline]
    pub(super) fn has_box_in_front(&self, oriented: &OrientedBox) -> bool {
        let offset = oriented.center - self.point;
        let reach = oriented.max_abs_coordinate + 2.0 * self.max_abs_coordinate;
        let height = self.normal.dot(offset) - oriented.support_bound(self.normal);
        // Written so that NaN is not in front.
        height > self.relative_rounding * reach + f64::MIN_POSITIVE
    }
}

/// The maximum number of facets of a hull against whose planes boxes are tested.
const MAX_TESTED_FACETS: usize = 16;

/// Returns planes with the shape on or behind them and the hub of a fan on or in front of them, exactly. A triangle of
/// the hub and an edge in front of such a plane shares no point with the shape, except the hub.
pub(super) fn separating_planes(shape: &Shape, hub: DVec3) -> Vec<Plane> {
    match shape {
        &Shape::Segment([p, q]) => Vec::from([[hub, p, q], [hub, q, p]].map(Plane::from_triangle)),
        Shape::HullInBox(Hull {
            largest_facets: facets,
            ..
        }) => {
            let is_front = |&&facet: &&[DVec3; 3]| side_of_plane(facet, hub) != Ordering::Less;
            let facets = facets.iter().filter(is_front);
            facets.map(|&facet| Plane::from_triangle(facet)).collect()
        }
        Shape::Triangle(corners) => {
            let mut planes = Vec::new();
            // A hub inside the triangle is a common point.
            if !corners.contains(&hub) && triangle_contains_point(*corners, hub) {
                return planes;
            }
            for k in 0..3 {
                let [p, q, r] = [0, 1, 2].map(|l| corners[(k + l) % 3]);
                add_plane_through_edge(&mut planes, hub, [p, q], r);
                if hub == p {
                    add_axis_parallel_planes(&mut planes, [p, q], &[r], hub);
                    add_axis_parallel_planes(&mut planes, [p, r], &[q], hub);
                }
            }
            let [p, q, r] = *corners;
            for facet in [[p, q, r], [q, p, r]] {
                if side_of_plane(facet, hub) != Ordering::Less {
                    planes.push(Plane::from_triangle(facet));
                }
            }
            planes
        }
    }
}

/// Returns the planes of the largest facets of a hull, which have the hull behind them.
pub(super) fn largest_facet_planes(hull: &Hull) -> Vec<Plane> {
    let tested = hull.largest_facets.iter().take(MAX_TESTED_FACETS);
    tested.map(|&facet| Plane::from_triangle(facet)).collect()
}

/// Adds the planes through the line `p q` and parallel to a coordinate axis that separate the hub from the points
/// `behind`. The points are on or behind each plane, and the hub is on or in front of it.
fn add_axis_parallel_planes(
    planes: &mut Vec<Plane>,
    [p, q]: [DVec3; 2],
    behind: &[DVec3],
    hub: DVec3,
) {
    for (axis, up) in DVec3::AXES.into_iter().enumerate() {
        let turn = |x: DVec3| side_of_line_along(axis, [p, q], x);
        let none = |of: Ordering| behind.iter().all(|&x| turn(x) != of);
        if none(Ordering::Greater) && turn(hub) != Ordering::Less {
            planes.push(Plane::new(p, [up, q - p]));
        }
        if none(Ordering::Less) && turn(hub) != Ordering::Greater {
            planes.push(Plane::new(p, [q - p, up]));
        }
    }
}

/// Returns whether a triangle contains a point. A triangle without area counts as containing every point.
fn triangle_contains_point(triangle: [DVec3; 3], point: DVec3) -> bool {
    let within = |plane: Projection| {
        let mut edges = (0..3).map(|k| (triangle[k], triangle[(k + 1) % 3]));
        edges.all(|(a, b)| plane.turn(a, b, point) != Ordering::Less)
    };
    side_of_plane(triangle, point) == Ordering::Equal
        && Projection::new(triangle).is_none_or(within)
}

/// Of the two oriented planes through the hub and the edge `p q`, adds those that do not have the corner `rest` in
/// front.
fn add_plane_through_edge(planes: &mut Vec<Plane>, hub: DVec3, [p, q]: [DVec3; 2], rest: DVec3) {
    for plane in [[hub, p, q], [hub, q, p]] {
        if side_of_plane(plane, rest) != Ordering::Greater {
            planes.push(Plane::from_triangle(plane));
        }
    }
}
