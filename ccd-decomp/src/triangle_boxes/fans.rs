//! Many triangles about one vertex.

use super::rim::{Edge, Rim, Slab};
use super::{Bounds, Shape};
use crate::predicates::{Projection, side, turn_along};
use crate::tolerance::FAN_TRIANGLES;
use ccd_core::glam::DVec3;
use ccd_core::order::greater;
use ccd_core::tolerance::height_rounding;
use std::cmp::Ordering;

/// Triangles that have one vertex, the hub, in common: searched by the edges across from it.
pub(super) struct Fan {
    hub: DVec3,
    rim: Rim,
}

/// The faces that are in no large fan, and the large fans; each face is in one at most.
pub(super) fn split(points: &[DVec3], faces: &[[u32; 3]]) -> (Vec<u32>, Vec<Fan>) {
    let mut count = vec![0; points.len()];
    for &v in faces.iter().flatten() {
        count[v as usize] += 1;
    }
    let (mut single, mut members) = (Vec::new(), Vec::new());
    for (number, face) in (0..).zip(faces) {
        let hub = face.iter().copied().max_by_key(|&v| count[v as usize]);
        match hub.filter(|&v| count[v as usize] >= FAN_TRIANGLES) {
            Some(hub) => members.push((hub, number)),
            None => single.push(number),
        }
    }
    members.sort_unstable();
    let fans = members.chunk_by(|a, b| a.0 == b.0);
    (
        single,
        fans.map(|fan| Fan::new(points, faces, fan)).collect(),
    )
}

impl Fan {
    fn new(points: &[DVec3], faces: &[[u32; 3]], members: &[(u32, u32)]) -> Self {
        let hub = members[0].0;
        let edge = |&(_, face): &(u32, u32)| {
            let corners = faces[face as usize];
            let k = corners.iter().position(|&v| v == hub).unwrap_or(0);
            let ends = [1, 2].map(|step| points[corners[(k + step) % 3] as usize]);
            Edge { ends, face }
        };
        Fan {
            hub: points[hub as usize],
            rim: Rim::new(members.iter().map(edge).collect()),
        }
    }

    pub(super) fn bounds(&self) -> Bounds {
        let ends = self.rim.edges.iter().flat_map(|edge| edge.ends);
        Bounds::of(ends.chain([self.hub]))
    }

    /// As [`TriangleBoxes::all_meeting`](super::TriangleBoxes::all_meeting).
    pub(super) fn all_meeting(&self, shape: &Shape, holds: impl FnMut(u32) -> bool) -> bool {
        let planes = planes(shape, self.hub);
        let is_far = |slab: &Slab| planes.iter().any(|plane| plane.has_in_front(slab));
        self.rim.all_but(is_far, holds)
    }
}

/// A plane, by a point of it and two vectors that span it, so that `u × v` looks to its front.
#[derive(Clone, Copy, Debug)]
struct Plane {
    foot: DVec3,
    sides: [DVec3; 2],
    normal: DVec3,
}

impl Plane {
    fn new(foot: DVec3, [u, v]: [DVec3; 2]) -> Self {
        Plane {
            foot,
            sides: [u, v],
            normal: u.cross(v),
        }
    }

    fn of([a, b, c]: [DVec3; 3]) -> Self {
        Plane::new(a, [b - a, c - a])
    }

    /// Whether all of a box is certainly in front.
    fn has_in_front(&self, slab: &Slab) -> bool {
        let way = slab.centre - self.foot;
        let reach = greater(
            way.abs().max_element() + slab.halves.element_sum() + slab.slack,
            self.foot.abs().max_element(),
        );
        let along = DVec3::from_array(slab.axes.map(|axis| self.normal.dot(axis).abs()));
        let depth = along.dot(slab.halves) + self.normal.abs().element_sum() * slab.slack;
        // Twice, as there are three axes to go along. Written so that NaN is not in front.
        self.normal.dot(way) - depth > 2.0 * height_rounding(self.sides, reach)
    }
}

/// How many facets of a hull are looked at.
const PLANES: usize = 64;

/// Planes that have all of a shape behind or in them, and a hub in front or in them: exactly. A triangle
/// of the hub and an edge in front of one of them has no point in common with the shape but the hub.
fn planes(shape: &Shape, hub: DVec3) -> Vec<Plane> {
    match shape {
        Shape::Segment([p, q]) => vec![Plane::of([hub, *p, *q]), Plane::of([hub, *q, *p])],
        Shape::Inside(facets) => {
            let is_front = |&&facet: &&[DVec3; 3]| side(facet, hub) != Ordering::Less;
            // The newest ones are the likeliest to have something in front of them.
            let facets = facets.iter().rev().take(PLANES).filter(is_front);
            facets.map(|&facet| Plane::of(facet)).collect()
        }
        Shape::Triangle(corners) => {
            let mut planes = Vec::new();
            // A hub amid the triangle is a point in common, whatever is in front.
            if !corners.contains(&hub) && holds(*corners, hub) {
                return planes;
            }
            for k in 0..3 {
                let [p, q, r] = [0, 1, 2].map(|l| corners[(k + l) % 3]);
                through(&mut planes, hub, [p, q], r);
                if hub == p {
                    beside(&mut planes, [p, q], r);
                    beside(&mut planes, [p, r], q);
                }
            }
            let [p, q, r] = *corners;
            for facet in [[p, q, r], [q, p, r]] {
                if side(facet, hub) != Ordering::Less {
                    planes.push(Plane::of(facet));
                }
            }
            planes
        }
    }
}

/// Whether a triangle holds a point.
fn holds(triangle: [DVec3; 3], point: DVec3) -> bool {
    let within = |plane: Projection| {
        let mut edges = (0..3).map(|k| (triangle[k], triangle[(k + 1) % 3]));
        edges.all(|(a, b)| plane.turn(a, b, point) != Ordering::Less)
    };
    side(triangle, point) == Ordering::Equal && Projection::of(triangle).is_none_or(within)
}

/// The plane of the hub and an edge, the rest of the triangle behind it.
fn through(planes: &mut Vec<Plane>, hub: DVec3, [p, q]: [DVec3; 2], rest: DVec3) {
    for plane in [[hub, p, q], [hub, q, p]] {
        if side(plane, rest) != Ordering::Greater {
            planes.push(Plane::of(plane));
        }
    }
}

/// The planes along an edge that are upright on the coordinate planes, the rest of the triangle behind
/// them.
fn beside(planes: &mut Vec<Plane>, [p, q]: [DVec3; 2], rest: DVec3) {
    for (axis, upright) in DVec3::AXES.into_iter().enumerate() {
        let turn = turn_along(axis, [p, q], rest);
        if turn != Ordering::Greater {
            planes.push(Plane::new(p, [upright, q - p]));
        }
        if turn != Ordering::Less {
            planes.push(Plane::new(p, [q - p, upright]));
        }
    }
}
