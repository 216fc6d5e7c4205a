//! Decides whether two pieces intersect by more than rounding. A claimed intersection is confirmed by a proof, and so
//! is its absence.

use super::oracle::PiecePair;
use super::separation::CheckedClaim;
use crate::math::order::{greater, lesser};
use crate::math::vector::{unit_or_any, vector_perpendicular_to_both};
use crate::tuning::MAX_EXPANDING_POLYTOPE_CORNERS;
use glam::DVec3;

/// Whether two pieces intersect by more than rounding.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Intersection {
    /// The pieces certainly intersect, even after any displacement smaller than rounding.
    Certain,
    /// The pieces do not intersect by more than rounding: an axis separates them, or would after a displacement smaller
    /// than rounding.
    None,
    /// Neither intersection nor its absence could be proven.
    Undecided,
}

/// Decides whether two pieces intersect by more than rounding; `rounding` bounds the error of their points' positions.
///
/// # Guarantee
/// Without rounding radii the claim alone decides nothing. Either the origin is in the hull of the differences of the
/// pieces' points by more than `rounding`, or an axis proves that it is not. With rounding radii either the claim's
/// witnesses prove an intersection, or its axis disproves one. If neither does, the pieces count as touching.
pub(crate) fn decide_intersection(
    pair: &PiecePair<'_>,
    checked: &CheckedClaim,
    rounding: f64,
    inner: &mut ExpandingPolytope,
) -> Intersection {
    let radii = pair.a.radius + pair.b.radius;
    if radii > 0.0 {
        // Witnesses of the cores that are nearer than the radii are a proof.
        return if checked.claimed_core_distance + rounding < radii {
            Intersection::Certain
        } else {
            Intersection::None
        };
    }
    if checked.lower >= -2.0 * rounding {
        return Intersection::None;
    }
    if !inner.start_with_tetrahedron(pair, rounding) {
        // The differences are in one plane, up to rounding.
        return Intersection::None;
    }
    for _ in 0..MAX_EXPANDING_POLYTOPE_CORNERS {
        let Some(&face) = inner.shallowest_face() else {
            return Intersection::Undecided;
        };
        if face.min_corner_height > rounding {
            return Intersection::Certain;
        }
        let corner = minkowski_support_point(pair, face.face_normal);
        match face.face_normal.dot(corner) {
            height if height <= rounding => return Intersection::None,
            // The farthest difference is no farther than the face: rounding prevents progress.
            height if !(height > face.max_corner_height) => return Intersection::Undecided,
            _ => inner.add(corner, face.corners),
        }
    }
    Intersection::Undecided
}

/// Returns the point of the Minkowski difference `a − b` that is farthest along a direction, in A's frame.
fn minkowski_support_point(pair: &PiecePair<'_>, along: DVec3) -> DVec3 {
    let of_b = pair
        .b
        .extremal_position(-pair.b_to_a.inverse_transform_vector(along));
    pair.a.extremal_position(along) - pair.b_to_a.transform_point(of_b)
}

/// A growing polytope inside the Minkowski difference of two pieces `[GJK88]`. If it contains the origin, the pieces
/// intersect.
///
/// The polytope grows as in the expanding polytope algorithm `[BERGEN01]`, but need not contain the origin initially.
/// Its faces form a closed surface even if their normals are rounded: the faces that a new corner sees are replaced
/// by a cone to their rim. Once all faces are turned away from the origin, the surface winds about it.
#[derive(Debug, Default)]
pub(crate) struct ExpandingPolytope {
    corners: Vec<DVec3>,
    faces: Vec<Face>,
    /// The edges between a face that the last added corner is in front of, and a face that the corner is behind.
    horizon_edges: Vec<[usize; 2]>,
}

#[derive(Clone, Copy, Debug)]
struct Face {
    /// The indices of the corners, counterclockwise as seen from outside.
    corners: [usize; 3],
    /// The outward unit normal.
    face_normal: DVec3,
    /// The least height of the face's corners above the origin, along the normal.
    min_corner_height: f64,
    /// The greatest height of the face's corners above the origin, along the normal.
    max_corner_height: f64,
}

impl ExpandingPolytope {
    /// Replaces the polytope by a tetrahedron of four points of the Minkowski difference. Returns false if all
    /// differences are in one plane.
    fn start_with_tetrahedron(&mut self, pair: &PiecePair<'_>, rounding: f64) -> bool {
        self.corners.clear();
        self.faces.clear();
        let Some(corners) = find_start_tetrahedron(pair, rounding) else {
            return false;
        };
        self.corners.extend(corners);
        for face in [[0, 1, 2], [0, 3, 1], [1, 3, 2], [2, 3, 0]] {
            self.push_face(face);
        }
        true
    }

    fn push_face(&mut self, corners: [usize; 3]) {
        let [a, b, c] = corners.map(|k| self.corners[k]);
        let normal = triangle_normal([a, b, c]);
        let heights = [a, b, c].map(|p| normal.dot(p));
        self.faces.push(Face {
            corners,
            face_normal: normal,
            min_corner_height: heights.into_iter().fold(f64::INFINITY, lesser),
            max_corner_height: heights.into_iter().fold(f64::NEG_INFINITY, greater),
        });
    }

    /// Returns the face with the least height above the origin; the height is negative if the origin is in front of the
    /// face.
    fn shallowest_face(&self) -> Option<&Face> {
        self.faces
            .iter()
            .min_by(|f, g| f.min_corner_height.total_cmp(&g.min_corner_height))
    }

    /// Adds a corner, which is in front of the face `seen`, and replaces every face that the corner is in front of by
    /// faces at the corner.
    fn add(&mut self, corner: DVec3, seen: [usize; 3]) {
        let new = self.corners.len();
        self.corners.push(corner);
        let horizon_edges = &mut self.horizon_edges;
        horizon_edges.clear();
        self.faces.retain(|face| {
            let sees =
                face.corners == seen || face.face_normal.dot(corner) > face.max_corner_height;
            for k in (0..3).filter(|_| sees) {
                let [from, to] = [face.corners[k], face.corners[(k + 1) % 3]];
                // An edge of two removed faces is not part of the rim.
                match horizon_edges.iter().position(|&edge| edge == [to, from]) {
                    Some(other) => drop(horizon_edges.swap_remove(other)),
                    None => horizon_edges.push([from, to]),
                }
            }
            !sees
        });
        for k in 0..self.horizon_edges.len() {
            let [from, to] = self.horizon_edges[k];
            self.push_face([from, to, new]);
        }
    }
}

/// Returns four points of the Minkowski difference that are far from one another. Returns `None` if all differences are
/// in a plane up to rounding, so that the pieces cannot intersect by more than that.
fn find_start_tetrahedron(pair: &PiecePair<'_>, rounding: f64) -> Option<[DVec3; 4]> {
    let both = |along: DVec3| [along, -along].map(|along| minkowski_support_point(pair, along));
    let farther =
        |best: (f64, DVec3), next: (f64, DVec3)| if next.0 > best.0 { next } else { best };
    let pick = |points: &[DVec3], measure: &dyn Fn(DVec3) -> f64| {
        let measured = points.iter().map(|&p| (measure(p), p));
        let (size, point) = measured.fold((0.0, DVec3::ZERO), farther);
        (size > rounding).then_some(point)
    };
    let around = DVec3::AXES.map(both);
    let a = around[0][0];
    let b = pick(around.as_flattened(), &|p| p.distance(a))?;
    let line = unit_or_any(b - a);
    let aside = line.any_orthonormal_vector();
    let around = [aside, line.cross(aside)].map(both);
    let c = pick(around.as_flattened(), &|p| {
        (p - a - line * line.dot(p - a)).length()
    })?;
    let normal = unit_or_any(vector_perpendicular_to_both(b - a, c - a));
    let d = pick(&both(normal), &|p| normal.dot(p - a).abs())?;
    Some(if normal.dot(d - a) < 0.0 {
        [a, b, c, d]
    } else {
        [a, c, b, d]
    })
}

/// Returns the unit normal of a triangle, computed so that even the corners of a needle have equal heights along it.
/// The part of the cross product's rounding that lies along the needle would tilt the normal.
fn triangle_normal([a, b, c]: [DVec3; 3]) -> DVec3 {
    let edges = [b - a, c - b, a - c];
    let longest = |e: DVec3, f: DVec3| {
        if f.length_squared() > e.length_squared() {
            f
        } else {
            e
        }
    };
    let along = unit_or_any(edges.into_iter().fold(DVec3::ZERO, longest));
    let normal = unit_or_any(vector_perpendicular_to_both(edges[0], edges[1]));
    unit_or_any(normal - along * along.dot(normal))
}

#[cfg(test)]
mod tests;
