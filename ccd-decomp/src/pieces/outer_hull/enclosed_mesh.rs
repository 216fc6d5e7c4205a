//! The solid or surface that the hull encloses, with queries for the location and distance of a point.

use crate::bounds::{BoundingBox, to_parry_vector};
use crate::exact::predicates::{side_of_line_along, side_of_plane};
use crate::mesh::TriangleMesh;
use crate::search::box_tree::BoxTree;
use crate::search::region::Region;
use crate::solid::topology::TopologyDefects;
use crate::tolerance::{MAX_NEEDLE_RATIO, excess_rounding_bound};
use crate::work::WorkBudget;
use ccd_core::glam::DVec3;
use ccd_core::order::{greater, lesser};
use parry3d_f64::query::PointQueryWithLocation;
use parry3d_f64::shape::Triangle;
use std::cmp::Ordering;

/// The solid that the hull encloses, or the surface if the mesh is open; with data for distance queries.
pub(super) struct EnclosedMesh<'a> {
    mesh: &'a TriangleMesh,
    search: BoxTree,
    is_solid: bool,
    /// 1 if the mesh's normals point out of the solid, −1 if they point into it.
    pub(super) orientation_sign: f64,
    /// The lower and the upper corner of the mesh's bounding box.
    pub(super) bounds: [DVec3; 2],
    /// Half the diagonal of the mesh's bounding box, to which tolerances are relative.
    pub(super) half_diagonal: f64,
    /// A bound on the rounding error of distances to the mesh.
    pub(super) distance_rounding: f64,
}

/// Whether a point is in the solid, with a bound on its distance to the surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Location {
    /// The point is in the solid, at least `least_depth` below the surface.
    Inside { least_depth: f64 },
    /// The point is not in the solid, or the surface is open; the target is at most `distance` away.
    Outside { distance_bound: f64 },
}

impl<'a> EnclosedMesh<'a> {
    pub(super) fn new(mesh: &'a TriangleMesh, topology: &TopologyDefects) -> Self {
        let bounds = mesh.bounding_box();
        let [lo, hi] = bounds;
        let farthest = lo.abs().max(hi.abs()).max_element();
        let half_diagonal = (hi - lo).length() / 2.0;
        EnclosedMesh {
            mesh,
            search: BoxTree::from_faces(
                mesh.vertices(),
                mesh.faces(),
                0..mesh.faces().len() as u32,
            ),
            is_solid: topology.is_solid(),
            orientation_sign: if topology.is_inside_out() { -1.0 } else { 1.0 },
            bounds,
            half_diagonal,
            distance_rounding: excess_rounding_bound(half_diagonal, farthest),
        }
    }

    pub(super) fn triangles(&self) -> impl ExactSizeIterator<Item = [DVec3; 3]> {
        (0..self.mesh.faces().len() as u32).map(|face| self.mesh.triangle(face))
    }

    /// Returns the triangles whose bounding boxes meet a given box; `None` if there are more than `most`.
    pub(super) fn triangles_meeting_box(
        &self,
        [lo, hi]: [DVec3; 2],
        most: usize,
        work: &WorkBudget,
    ) -> Option<Vec<[DVec3; 3]>> {
        let mut found = Vec::new();
        let all =
            self.search
                .all_triangles_meeting_box_satisfy(&BoundingBox { lo, hi }, work, |face| {
                    found.push(self.mesh.triangle(face));
                    found.len() <= most
                });
        all.then_some(found)
    }

    /// Returns whether a point is in the solid, with a bound on its distance to the surface.
    pub(super) fn locate(&self, point: DVec3, work: &WorkBudget) -> Location {
        let (found, reached) = self.distance_bounds(point, work);
        if self.has_nonzero_winding_number(point, work) {
            Location::Inside {
                least_depth: greater(0.0, lesser(found, reached) - self.distance_rounding),
            }
        } else {
            Location::Outside {
                distance_bound: reached + self.distance_rounding,
            }
        }
    }

    /// Returns a lower and an upper bound of the distance from a point to the surface. The lower bound holds up to the
    /// slack. The upper bound is the distance to a point that is certainly on a triangle: the library's projection with
    /// clamped weights, which may be wrong for needles.
    fn distance_bounds(&self, point: DVec3, work: &WorkBudget) -> (f64, f64) {
        let query = to_parry_vector(point);
        let project = |corners: [DVec3; 3]| {
            let [a, b, c] = corners.map(to_parry_vector);
            Triangle::new(a, b, c).project_local_point_and_get_location(query, false)
        };
        let distance = |corners: [DVec3; 3]| {
            needle_distance_lower_bound(corners, point).unwrap_or_else(|| {
                let (found, _) = project(corners);
                DVec3::from_array(found.point.to_array()).distance(point)
            })
        };
        let Some((face, found)) = self.search.nearest_face(point, work, distance) else {
            return (0.0, f64::INFINITY);
        };
        let corners = self.mesh.triangle(face);
        let (_, location) = project(corners);
        let weights = location
            .barycentric_coordinates()
            .unwrap_or([1.0, 0.0, 0.0]);
        let weights = weights.map(|w| w.clamp(0.0, 1.0));
        let sum: f64 = weights.iter().sum();
        let on = corners.iter().zip(weights);
        let on: DVec3 = on.map(|(&p, w)| w / sum * (p - point)).sum();
        let known = |length: f64, otherwise: f64| if length.is_nan() { otherwise } else { length };
        (known(found, 0.0), known(on.length(), f64::INFINITY))
    }

    /// Returns whether the winding number of the mesh about a point is not 0, by exact predicates. A point on the
    /// surface counts as a point next to it. An open mesh winds about no point.
    pub(super) fn has_nonzero_winding_number(&self, point: DVec3, work: &WorkBudget) -> bool {
        if !self.is_solid {
            return false;
        }
        let top = DVec3::new(point.x, point.y, greater(point.z, self.bounds[1].z));
        let above = Region::segment([point, top]);
        let mut winding = 0;
        self.search.all_near_faces_satisfy(&above, work, |face| {
            winding += ray_crossing_sign(self.mesh.triangle(face), point);
            true
        });
        winding != 0
    }
}

/// Returns a lower bound of the distance from a point to a needle: the distance to its longest side, less its height.
/// Returns `None` for other triangles.
fn needle_distance_lower_bound([a, b, c]: [DVec3; 3], point: DVec3) -> Option<f64> {
    let square = |[from, to, _]: &[DVec3; 3]| from.distance_squared(*to);
    let turned = [[a, b, c], [b, c, a], [c, a, b]].into_iter();
    let [from, to, apex] = turned.max_by(|s, t| square(s).total_cmp(&square(t)))?;
    let side = to - from;
    let (square, area) = (side.length_squared(), side.cross(apex - from).length());
    // Written so that NaN is no needle.
    (area < MAX_NEEDLE_RATIO * square).then(|| {
        let offset = from - point;
        let share = (-offset.dot(side) / square).clamp(0.0, 1.0);
        greater(0.0, (offset + side * share).length() - area / square.sqrt())
    })
}

/// Returns the direction in which the ray from a point along z crosses a triangle. It is 1 from back to front, −1 from
/// front to back, 0 if it misses.
///
/// Degenerate cases are decided by symbolic perturbation of the point along x, and less along y, consistently for all
/// triangles at an edge.
fn ray_crossing_sign(triangle: [DVec3; 3], point: DVec3) -> i32 {
    let [a, b, c] = triangle;
    let around: i32 = [(a, b), (b, c), (c, a)]
        .into_iter()
        .map(|(v, w)| {
            let turn = || side_of_line_along(2, [v, w], point);
            match (v.y <= point.y, w.y <= point.y) {
                (true, false) => i32::from(turn().is_gt()),
                (false, true) => -i32::from(turn().is_lt()),
                _ => 0,
            }
        })
        .sum();
    let below = match around.signum() {
        0 => return 0,
        1 => Ordering::Less,
        _ => Ordering::Greater,
    };
    around * i32::from(side_of_plane(triangle, point) == below)
}

#[cfg(test)]
mod tests;
