//! Checks that faces cover the boundary of a convex polytope, and cover each part of it exactly once.

use super::{FaceEdge, NO_FACE, Polytope, unit_or_zero};
use crate::tolerance::{CONVEXITY_TOLERANCE, COPLANARITY_TOLERANCE};
use ccd_core::glam::DVec3;
use ccd_core::order::greater;

/// Returns whether a closed surface is that of a convex polytope, up to the rounding of its
/// corners.
///
/// It is if it is connected, and each face is a polygon that turns left at every corner, once around, with all corners
/// behind its plane. Then each face is a part of the boundary of the corners' hull, and the surface covers it. It
/// covers it once, because no two polygons have a side in the same direction.
pub(crate) fn is_convex(points: &[DVec3], polytope: &Polytope, rounding: f64) -> bool {
    let edges = &polytope.edges;
    if polytope.faces.len() < 2 || edges.iter().any(|edge| edge.faces.contains(&NO_FACE)) {
        return false;
    }
    let check = ConvexityCheck {
        points,
        polytope,
        rounding: rounding * (CONVEXITY_TOLERANCE / COPLANARITY_TOLERANCE),
    };
    (0..polytope.faces.len() as u32).all(|f| check.is_hull_face(f)) && check.is_connected()
}

struct ConvexityCheck<'a> {
    points: &'a [DVec3],
    polytope: &'a Polytope,
    /// The allowed error of a corner's position, as a length.
    rounding: f64,
}

impl ConvexityCheck<'_> {
    /// Returns whether a face is a planar convex polygon that winds once, with all corners of the polytope behind it.
    fn is_hull_face(&self, face: u32) -> bool {
        let normal = self.polytope.face(face).normal;
        let sides = self.polytope.sides_of(face);
        if sides.len() < 3 || normal == DVec3::ZERO {
            return false;
        }
        // The distance from the face's plane that rounding of the corners allows.
        let width = greater(
            f64::MIN_POSITIVE,
            face_width_lower_bound(self.polytope, face),
        );
        let slack = self.rounding * (1.0 + self.polytope.reach / width);
        let at = |k: usize| self.corner(sides[k % sides.len()].vertex);
        let first = at(0);
        let highest = self.corner(self.polytope.extremal_vertex(normal));
        let behind = normal.dot(highest - first) <= slack;
        behind
            && (0..sides.len()).all(|k| {
                let (here, next, over) = (at(k), at(k + 1), at(k + 2));
                let inward = normal.cross(unit_or_zero(next - here));
                // No triangle of the fan about the first corner is reversed.
                let fan = (here - first).cross(next - first).dot(normal);
                let longest = greater((here - first).length(), (next - first).length());
                normal.dot(here - first).abs() <= slack
                    && inward.dot(over - next) >= -slack
                    && fan >= -slack * longest
            })
    }

    /// Returns whether any face can be reached from any other face over shared edges.
    fn is_connected(&self) -> bool {
        let mut reached = vec![false; self.polytope.faces.len()];
        reached[0] = true;
        let mut open = vec![0];
        while let Some(face) = open.pop() {
            for side in self.polytope.sides_of(face) {
                for other in self.polytope.edge(side.edge).faces {
                    if !std::mem::replace(&mut reached[other as usize], true) {
                        open.push(other);
                    }
                }
            }
        }
        reached.into_iter().all(|reached| reached)
    }

    fn corner(&self, v: u32) -> DVec3 {
        self.points[self.polytope.vertex(v).point_index as usize]
    }
}

/// Returns a lower bound of a face's width, at least a quarter of it: the area over the extent from the first vertex.
fn face_width_lower_bound(polytope: &Polytope, face: u32) -> f64 {
    let sides = polytope.sides_of(face);
    let first = polytope.vertex(sides[0].vertex).point;
    let arm = |side: &FaceEdge| polytope.vertex(side.vertex).point - first;
    let fan = sides
        .windows(2)
        .map(|two| 0.5 * arm(&two[0]).cross(arm(&two[1])).length());
    let farthest = sides
        .iter()
        .map(|side| arm(side).length())
        .fold(0.0, greater);
    fan.sum::<f64>() / farthest
}
