//! Large fans: many triangles that share one vertex.

use super::box_tree::BoxTree;
use super::element::Element;
use super::oriented_box::OrientedBox;
use super::planes::separating_planes;
use super::region::{Hull, Shape};
use crate::bounds::BoundingBox;
use crate::exact::predicates::{is_degenerate, side_of_plane};
use crate::tolerance::MIN_FAN_TRIANGLES;
use crate::work::WorkBudget;
use ccd_core::glam::DVec3;
use std::cmp::Ordering;

/// The triangles around one vertex, the hub. They are searched by their edges opposite to it.
pub(super) struct Fan {
    hub: DVec3,
    rim_tree: BoxTree,
    /// The corners of one triangle of the fan, if all its triangles are coplanar; else `None`.
    plane: Option<[DVec3; 3]>,
}

/// Splits faces into large fans and single faces. Each face is in at most one fan.
pub(super) fn split_into_fans(points: &[DVec3], faces: &[[u32; 3]]) -> (Vec<u32>, Vec<Fan>) {
    let mut count = vec![0; points.len()];
    for &v in faces.iter().flatten() {
        count[v as usize] += 1;
    }
    let (mut single, mut members) = (Vec::new(), Vec::new());
    for (number, face) in (0..).zip(faces) {
        let hub = face.iter().copied().max_by_key(|&v| count[v as usize]);
        match hub.filter(|&v| count[v as usize] >= MIN_FAN_TRIANGLES) {
            Some(hub) => members.push((hub, number)),
            None => single.push(number),
        }
    }
    members.sort_unstable();
    let mut fans = Vec::new();
    for members in members.chunk_by(|a, b| a.0 == b.0) {
        let (fan, others) = Fan::new(points, faces, members);
        fans.push(fan);
        single.extend(others);
    }
    (single, fans)
}

impl Fan {
    /// Creates a fan from the faces around a vertex, and returns the faces that it leaves out. If most faces are
    /// coplanar, the fan leaves out the faces off that plane.
    fn new(points: &[DVec3], faces: &[[u32; 3]], members: &[(u32, u32)]) -> (Self, Vec<u32>) {
        let number = members[0].0;
        let hub = points[number as usize];
        let edge = |&(_, face): &(u32, u32)| {
            let corners = faces[face as usize];
            let k = corners.iter().position(|&v| v == number).unwrap_or(0);
            let corners = [1, 2, 2].map(|step| points[corners[(k + step) % 3] as usize]);
            Element { corners, face }
        };
        let mut rim: Vec<Element> = members.iter().map(edge).collect();
        let [p, q, _] = rim[rim.len() / 2].corners;
        let in_plane = |element: &Element| {
            let mut corners = element.corners.iter();
            corners.all(|&corner| side_of_plane([hub, p, q], corner) == Ordering::Equal)
        };
        let level: Vec<Element> = rim.iter().copied().filter(in_plane).collect();
        let is_plane = !is_degenerate([hub, p, q]) && 2 * level.len() > rim.len();
        let mut others = Vec::new();
        if is_plane {
            others.extend(rim.iter().filter(|p| !in_plane(p)).map(|p| p.face));
            rim = level;
        }
        let fan = Fan {
            hub,
            plane: is_plane.then_some([hub, p, q]),
            rim_tree: BoxTree::new(rim),
        };
        (fan, others)
    }

    /// Returns whether the fan is flat and a hull lies on one side of its plane. Then no part of the fan is inside
    /// the hull.
    fn is_flat_beside_hull(&self, hull: &Hull) -> bool {
        self.plane.is_some_and(|plane| {
            let sides = hull
                .corners
                .iter()
                .map(|&corner| side_of_plane(plane, corner));
            let mut sides = sides.filter(|&side| side != Ordering::Equal);
            let first = sides.next();
            sides.all(|side| Some(side) == first)
        })
    }

    pub(super) fn bounds(&self) -> BoundingBox {
        let hub = BoundingBox::enclosing([self.hub]);
        self.rim_tree.bounds().map_or(hub, |rim| rim.union(hub))
    }

    /// Calls `holds` for the triangles of the fan that may meet a shape. It is a part of
    /// [`TriangleBoxes::all_near_faces_satisfy`](super::TriangleBoxes::all_near_faces_satisfy).
    pub(super) fn all_near_faces_satisfy(
        &self,
        shape: &Shape,
        work: &WorkBudget,
        mut holds: impl FnMut(u32) -> bool,
    ) -> bool {
        if let Shape::HullInBox(hull) = shape
            && self.is_flat_beside_hull(hull)
        {
            return true;
        }
        let planes = separating_planes(shape, self.hub);
        let is_far = |_: &BoundingBox, oriented: &OrientedBox| {
            planes.iter().any(|plane| plane.has_box_in_front(oriented))
        };
        self.rim_tree
            .all_near_elements_satisfy(is_far, work, |element| holds(element.face))
    }
}
