//! Finds the faces of a body's surface around a point, and the normals that two surfaces have in common.

use super::boxes::FaceTrees;
use super::closest::nearest_point_on_triangle;
use super::skin::NearSurface;
use crate::distance::common_normals::CommonNormals;
use crate::rounding::{ADJACENCY_DISTANCE_PER_ROUNDING, LEVEL_HEIGHT_PER_ROUNDING};
use glam::DVec3;

/// The triangles of a body's surface, with a tree that finds the triangles around a point.
pub(super) struct Surface<'a> {
    near_surface: &'a NearSurface<'a>,
    tree: FaceTrees,
}

impl<'a> Surface<'a> {
    pub(super) fn new(skin: &'a NearSurface<'a>) -> Self {
        Surface {
            near_surface: skin,
            tree: FaceTrees::over_all_faces(skin),
        }
    }

    /// Returns the common normals of two surfaces at a pair of points. The first point is on A's surface, the second on
    /// B's. All coordinates are in A's frame.
    pub(super) fn common_normals(
        surfaces: &[Surface<'_>; 2],
        points: [DVec3; 2],
        rounding: f64,
    ) -> CommonNormals {
        let reach = ADJACENCY_DISTANCE_PER_ROUNDING * rounding;
        let mut normals = CommonNormals::default();
        normals.reset(LEVEL_HEIGHT_PER_ROUNDING * rounding);
        surfaces[0]
            .for_each_vector_to_near_face(points[0], reach, |way| normals.add_constraint_of_a(way));
        surfaces[1]
            .for_each_vector_to_near_face(points[1], reach, |way| normals.add_constraint_of_b(way));
        normals.sort_constraints();
        normals
    }

    /// Calls `add` with the vectors from a point to the corners of the faces around it, and to points of the solid
    /// below these faces.
    fn for_each_vector_to_near_face(&self, at: DVec3, reach: f64, mut add: impl FnMut(DVec3)) {
        for face in self.tree.faces_near(at, reach) {
            let (_, nearest) = nearest_point_on_triangle(at, self.near_surface.triangle(face), 0.0);
            // Written so that NaN is near.
            if !(nearest.distance(at) > reach) {
                self.near_surface
                    .for_each_face_point(face, |end| add(end - at));
            }
        }
    }
}
