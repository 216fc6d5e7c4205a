//! Convex polygons of many slivers, such as fans of triangles. Their triangles are tested only if another face enters the polygon.

use crate::bounds::{BoundingBox, BoundingBoxTree};
use crate::exact::predicates::{Projection, side_of_plane};
use crate::search::TriangleBoxes;
use crate::search::region::Region;
use crate::solid::flats::{ConvexPolygon, ConvexPolygons};
use crate::solid::manifold::Manifold;
use crate::tolerance::MIN_FAN_TRIANGLES;
use crate::work::WorkBudget;
use ccd_core::glam::DVec3;
use std::cell::OnceCell;
use std::cmp::Ordering;

/// The convex polygons of a surface that have a large fan of triangles, and the remaining triangles.
///
/// The triangles of a polygon cover it once: two of them meet only in shared corners and edges.
pub(super) struct FannedPolygons<'a, 'm> {
    manifold: &'a Manifold<'m>,
    polygons: Vec<FannedPolygon>,
    /// For each face, the number of its polygon; [`NO_POLYGON`] for a face outside all polygons.
    polygon_of_face: Vec<u32>,
    /// The axis-aligned boxes of the polygons.
    bounds: BoundingBoxTree,
    /// The faces outside all polygons.
    faces_outside_polygons: FacesWithTree,
}

const NO_POLYGON: u32 = u32::MAX;

/// A convex polygon of a mesh: its triangles, plane, and boundary.
struct FannedPolygon {
    faces: Vec<u32>,
    plane: [DVec3; 3],
    projection: Projection,
    /// The boundary vertices, in ascending order, each with its neighbours on the boundary.
    rim: Vec<RimVertex>,
    bounds: BoundingBox,
    /// The search trees over the polygon's triangles, created on demand.
    triangle_trees: OnceCell<FacesWithTree>,
}

#[derive(Clone, Copy, Debug)]
struct RimVertex {
    rim_vertex: u32,
    previous_vertex: u32,
    next_vertex: u32,
}

/// Some faces of a mesh, with search trees over them.
struct FacesWithTree {
    faces: Vec<u32>,
    boxes: TriangleBoxes,
}

/// The approximate number of exact predicates that separate a face from a polygon.
const STEPS_PER_POLYGON: usize = 4;

impl<'a, 'm> FannedPolygons<'a, 'm> {
    /// Finds these polygons of a surface; `None` if no polygon has a large fan, so that the boxes of all triangles
    /// suffice. O(n log n), the time of [`ConvexPolygons::new`].
    pub(super) fn from_manifold(manifold: &'a Manifold<'m>) -> Option<Self> {
        let mut count = vec![0; manifold.mesh().vertices().len()];
        for &v in manifold.faces().iter().flatten() {
            count[v as usize] += 1;
        }
        if count.iter().all(|&about| about < MIN_FAN_TRIANGLES) {
            return None;
        }
        let flats = ConvexPolygons::new(manifold);
        let mut polygons = Vec::new();
        let mut polygon_of = vec![NO_POLYGON; manifold.faces().len()];
        for number in 0..flats.len() as u32 {
            let Some(polygon) = FannedPolygon::new(manifold, flats.get(number)) else {
                continue;
            };
            let number = polygons.len() as u32;
            for &face in &polygon.faces {
                polygon_of[face as usize] = number;
            }
            polygons.push(polygon);
        }
        if polygons.is_empty() {
            return None;
        }
        let rest = (0..)
            .zip(&polygon_of)
            .filter(|(_, polygon)| **polygon == NO_POLYGON);
        let rest = FacesWithTree::new(manifold, rest.map(|(face, _)| face).collect());
        Some(FannedPolygons {
            manifold,
            bounds: BoundingBoxTree::new(polygons.iter().map(|polygon| polygon.bounds).collect()),
            polygons,
            polygon_of_face: polygon_of,
            faces_outside_polygons: rest,
        })
    }

    /// Calls `holds` for the faces that may intersect the given face, until `holds` returns false or the work is spent.
    /// Each pair is reported for at least one of its faces: faces of lower number may be omitted.
    pub(super) fn all_near_faces_satisfy(
        &self,
        face: u32,
        region: &Region,
        work: &WorkBudget,
        mut holds: impl FnMut(u32) -> bool,
    ) -> bool {
        let own = self.polygon_of_face[face as usize];
        // Pairs with a face of a polygon are reported for the other face.
        if own == NO_POLYGON {
            let FacesWithTree { faces, boxes } = &self.faces_outside_polygons;
            let later = |other: u32| faces[other as usize] <= face || holds(faces[other as usize]);
            if !boxes.all_near_faces_satisfy(region, work, later) {
                return false;
            }
        }
        let mut polygon_satisfies = |number: u32| {
            let polygon = &self.polygons[number as usize];
            let new_group = || FacesWithTree::new(self.manifold, polygon.faces.clone());
            let FacesWithTree { faces, boxes } = polygon.triangle_trees.get_or_init(new_group);
            boxes.all_near_faces_satisfy(region, work, |other| {
                let other = faces[other as usize];
                // Pairs of faces of two polygons are found twice.
                own != NO_POLYGON && other < face || holds(other)
            })
        };
        self.bounds
            .all_meeting_boxes_satisfy(&region.bounds, |number| {
                number == own
                    || work.spend(STEPS_PER_POLYGON)
                        && (self.is_separated_from_polygon(face, number)
                            || polygon_satisfies(number))
            })
    }

    /// Returns whether a face and a polygon share at most a corner or an edge of the polygon's boundary.
    ///
    /// The part of the face in the polygon's plane is then outside the polygon's box, or beyond a line along the rim with
    /// only a shared corner or edge on that line.
    fn is_separated_from_polygon(&self, face: u32, number: u32) -> bool {
        let polygon = &self.polygons[number as usize];
        let (corners, points) = (
            self.manifold.faces()[face as usize],
            self.manifold.triangle(face),
        );
        let sides = points.map(|p| side_of_plane(polygon.plane, p));
        if sides.contains(&Ordering::Less) && sides.contains(&Ordering::Greater) {
            return false;
        }
        let level = || (0..3).filter(|&k| sides[k] == Ordering::Equal);
        let beyond = |from: u32, to: u32| {
            let [from, to] = [from, to].map(|v| self.manifold.point(v));
            let turn = |k: usize| polygon.projection.turn(from, to, points[k]);
            if level().any(|k| turn(k) == Ordering::Greater) {
                return false;
            }
            let mut on = level().filter(|&k| turn(k) == Ordering::Equal);
            match [on.next(), on.next(), on.next()] {
                // The one corner is the rim vertex on the line.
                [Some(_), None, None] => true,
                [Some(k), Some(l), None] => {
                    let start = if (k + 1) % 3 == l { k } else { l };
                    let twin = self.manifold.twin(3 * face + start as u32);
                    self.polygon_of_face[twin as usize / 3] == number
                }
                _ => false,
            }
        };
        let mut level_corners = level().map(|k| polygon.rim_vertex(corners[k]));
        // The bounds of no points meet no bounds.
        !BoundingBox::enclosing(level().map(|k| points[k])).meets(&polygon.bounds)
            || level_corners.any(|rim_vertex| {
                rim_vertex.is_some_and(|p| {
                    beyond(p.previous_vertex, p.rim_vertex) || beyond(p.rim_vertex, p.next_vertex)
                })
            })
    }
}

/// Returns whether at least [`MIN_FAN_TRIANGLES`] of the given faces share a vertex.
fn has_fan(manifold: &Manifold<'_>, faces: &[u32]) -> bool {
    if faces.len() < MIN_FAN_TRIANGLES as usize {
        return false;
    }
    let corners = faces.iter().flat_map(|&f| manifold.faces()[f as usize]);
    let mut corners: Vec<u32> = corners.collect();
    corners.sort_unstable();
    let mut about = corners.chunk_by(|v, w| v == w);
    about.any(|about| about.len() >= MIN_FAN_TRIANGLES as usize)
}

impl FannedPolygon {
    /// Prepares a polygon for searches; `None` if it has no large fan.
    fn new(manifold: &Manifold<'_>, flat: &ConvexPolygon) -> Option<Self> {
        if !has_fan(manifold, &flat.faces) {
            return None;
        }
        let plane = manifold.triangle(*flat.faces.first()?);
        let starts = || flat.rim.iter().map(|&h| manifold.ends(h)[0]);
        let triples = starts()
            .zip(starts().cycle().skip(1))
            .zip(starts().cycle().skip(2));
        let mut rim: Vec<RimVertex> = triples
            .map(|((before, at), after)| RimVertex {
                rim_vertex: at,
                previous_vertex: before,
                next_vertex: after,
            })
            .collect();
        rim.sort_unstable_by_key(|rim_vertex| rim_vertex.rim_vertex);
        Some(FannedPolygon {
            projection: Projection::new(plane)?,
            bounds: BoundingBox::enclosing(starts().map(|v| manifold.point(v))),
            faces: flat.faces.clone(),
            plane,
            rim,
            triangle_trees: OnceCell::new(),
        })
    }

    /// Returns a boundary vertex with its neighbours; `None` if the vertex is not on the boundary.
    fn rim_vertex(&self, vertex: u32) -> Option<RimVertex> {
        let found = self
            .rim
            .binary_search_by_key(&vertex, |rim_vertex| rim_vertex.rim_vertex);
        found.ok().map(|k| self.rim[k])
    }
}

impl FacesWithTree {
    /// Builds the search trees in O(n log n) in the number of faces.
    fn new(manifold: &Manifold<'_>, faces: Vec<u32>) -> Self {
        let corners = faces.iter().map(|&f| manifold.faces()[f as usize]);
        let mut vertices: Vec<u32> = corners.clone().flatten().collect();
        vertices.sort_unstable();
        vertices.dedup();
        let place = |v: u32| vertices.partition_point(|&w| w < v) as u32;
        let named: Vec<[u32; 3]> = corners.map(|corners| corners.map(place)).collect();
        let points: Vec<DVec3> = vertices.iter().map(|&v| manifold.point(v)).collect();
        FacesWithTree {
            boxes: TriangleBoxes::new(&points, &named),
            faces,
        }
    }
}

#[cfg(test)]
mod tests;
