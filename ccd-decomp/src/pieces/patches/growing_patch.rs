//! A convex patch under construction, which grows polygon by polygon.

use super::obstacle::HullInteriorTest;
use crate::bounds::BoundingBox;
use crate::exact::predicates::side_of;
use crate::hull::exact_hull::ExactHull;
use crate::hull::polygons::merged_polygons;
use crate::search::region::Region;
use crate::solid::flats::ConvexPolygons;
use crate::solid::manifold::Manifold;
use crate::tolerance::MAX_PATCH_CORNERS;
use crate::work::WorkBudget;
use ccd_core::PolygonList;
use ccd_core::glam::DVec3;
use std::cmp::Ordering;

/// A set of polygons of a mesh and their hull. The hull lies inside the solid, and all polygons are on its boundary.
pub(super) struct GrowingPatch {
    /// The polygons of the patch, in the order in which they joined.
    pub(super) polygons: Vec<u32>,
    pub(super) hull: ExactHull,
    has_volume: bool,
}

/// The result of an attempt to add a polygon to a patch.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum JoinResult {
    Joined,
    /// The polygon can never join the patch.
    Refused,
    /// The polygon is coplanar with a patch that has no volume yet.
    Coplanar,
}

impl GrowingPatch {
    pub(super) fn new(flats: &ConvexPolygons, seed: u32) -> Self {
        GrowingPatch {
            polygons: vec![seed],
            hull: ExactHull::from_polygon(&flats.get(seed).corners),
            has_volume: false,
        }
    }

    /// Returns the facets of the hull, with coplanar triangles merged; a flat hull has two facets.
    pub(super) fn facets(&self, points: &[DVec3]) -> PolygonList {
        if self.has_volume {
            return merged_polygons(points, self.hull.facets());
        }
        let mut front = self.hull.corners().to_vec();
        let least = (0..front.len()).min_by_key(|&k| front[k]);
        front.rotate_left(least.unwrap_or(0));
        let mut back = front.clone();
        back[1..].reverse();
        PolygonList::from_iter([front, back])
    }

    /// Adds a polygon to the patch if the patch stays valid, and returns whether the polygon joined. The result is
    /// meaningful only if work is left.
    pub(super) fn join(
        &mut self,
        manifold: &Manifold<'_>,
        flats: &ConvexPolygons,
        flat: u32,
        work: &WorkBudget,
    ) -> JoinResult {
        let points = manifold.mesh().vertices();
        if self.hull.corners().len() + flats.get(flat).corners.len() > MAX_PATCH_CORNERS {
            return JoinResult::Refused;
        }
        let plane = |f: u32| manifold.faces()[flats.get(f).faces[0] as usize];
        // The hull so far must lie behind the polygon, …
        match self.side_of_highest_corner(points, plane(flat)) {
            Ordering::Greater => return JoinResult::Refused,
            Ordering::Equal if !self.has_volume && self.is_hull_in_plane(points, plane(flat)) => {
                return JoinResult::Coplanar;
            }
            _ => {}
        }
        // … the polygon behind those of the patch, …
        let corners = flats.get(flat).corners.iter().copied();
        let mut new: Vec<u32> = corners.filter(|&v| !self.is_corner(v)).collect();
        let in_front = |&v: &u32| {
            let sees = |&f: &u32| side_of(points, plane(f), v) == Ordering::Greater;
            self.polygons.iter().any(sees)
        };
        if new.iter().any(in_front) {
            return JoinResult::Refused;
        }
        if !self.has_volume {
            // The first point has to be off the plane.
            let first_plane = plane(self.polygons[0]);
            new.sort_by_key(|&v| side_of(points, first_plane, v) == Ordering::Equal);
        }
        // … and the new hull within the solid.
        work.spend(new.len() * self.hull.facets().len());
        let (hull, changed) = self.extended_hull(points, &new);
        if let Some(changed) = changed {
            let obstacle = HullInteriorTest::new(points, &hull);
            let is_apart = |face: u32| {
                let of = flats.polygon_of_face(face);
                of == flat
                    || self.polygons.contains(&of)
                    || work.spend(hull.facets().len())
                        && obstacle.is_separated_from(manifold.faces()[face as usize])
            };
            let facets = hull.facets().iter();
            let facets = facets.map(|facet| facet.map(|v| points[v as usize]));
            let corners = hull.corners().iter().map(|&v| points[v as usize]);
            let near = Region::from_box_and_hull(corners.collect(), facets.collect(), changed);
            if !manifold
                .boxes()
                .all_near_faces_satisfy(&near, work, is_apart)
            {
                return JoinResult::Refused;
            }
            self.hull = hull;
            self.has_volume = true;
        }
        self.polygons.push(flat);
        JoinResult::Joined
    }

    /// Returns the side of a plane on which the hull's highest corner lies: `Greater` in front, `Equal` on the plane,
    /// `Less` behind.
    fn side_of_highest_corner(&self, points: &[DVec3], plane: [u32; 3]) -> Ordering {
        let corners = self.hull.corners().iter();
        let mut highest = Ordering::Less;
        for &v in corners {
            highest = highest.max(side_of(points, plane, v));
            if highest == Ordering::Greater {
                break;
            }
        }
        highest
    }

    fn is_hull_in_plane(&self, points: &[DVec3], plane: [u32; 3]) -> bool {
        let mut corners = self.hull.corners().iter();
        corners.all(|&v| side_of(points, plane, v) == Ordering::Equal)
    }

    fn is_corner(&self, vertex: u32) -> bool {
        if self.has_volume {
            self.hull.corners().binary_search(&vertex).is_ok()
        } else {
            self.hull.corners().contains(&vertex)
        }
    }

    /// Returns the hull extended by the points `new`, with the bounding box of what changed. The box is `None` if the
    /// hull is unchanged.
    fn extended_hull(&self, points: &[DVec3], new: &[u32]) -> (ExactHull, Option<BoundingBox>) {
        let mut hull = self.hull.clone();
        let mut changed: Option<BoundingBox> = None;
        for &v in new {
            if let Some(more) = hull.insert(points, v) {
                changed = Some(changed.map_or(more, |bounds| bounds.union(more)));
            }
        }
        (hull, changed)
    }
}
