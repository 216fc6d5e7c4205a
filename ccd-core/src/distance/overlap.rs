//! Whether two pieces truly intersect: a penetration is confirmed before it is believed, and so is that
//! there is none.

use super::oracle::PiecePair;
use super::separation::Checked;
use crate::math::order::{greater, lesser};
use crate::math::vector::across;
use crate::math::vector::unit_or_any;
use crate::tolerance::MAX_CORNERS;
use glam::DVec3;

/// Whether two pieces intersect by more than rounding.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Intersection {
    /// They certainly do: moved by less than rounding any way, they still have points in common.
    Certain,
    /// They do not: an axis keeps them apart, or would after so small a move.
    None,
    /// Neither could be shown.
    Undecided,
}

/// Tells intersecting pieces from touching ones; `rounding` bounds the error of their points' places.
///
/// # Guarantee
/// Without rounding radii the claim is not believed either way: the origin is in the hull of
/// differences of the pieces' points, by more than `rounding`, or an axis shows that it is not. With
/// rounding radii the claim's witnesses prove an intersection, and its axis that there is none; where
/// it offers neither, the pieces count as touching.
pub(crate) fn intersects(pair: &PiecePair<'_>, checked: &Checked, rounding: f64) -> Intersection {
    let radii = pair.a.radius + pair.b.radius;
    if radii > 0.0 {
        // Witnesses of the cores that are nearer than the radii are proof enough.
        return match checked.core_distance + rounding < radii {
            true => Intersection::Certain,
            false => Intersection::None,
        };
    }
    if checked.lower >= -2.0 * rounding {
        return Intersection::None;
    }
    let Some(mut inner) = Inner::tetrahedron(pair, rounding) else {
        // The differences are flat, to within rounding.
        return Intersection::None;
    };
    for _ in 0..MAX_CORNERS {
        let Some(&face) = inner.shallowest() else {
            return Intersection::Undecided;
        };
        if face.depth > rounding {
            return Intersection::Certain;
        }
        let corner = farthest_difference(pair, face.normal);
        match face.normal.dot(corner) {
            height if height <= rounding => return Intersection::None,
            // It is no farther than the face: rounding is in the way.
            height if !(height > face.height) => return Intersection::Undecided,
            _ => inner.add(corner, face.corners),
        }
    }
    Intersection::Undecided
}

/// The difference of two points, of A and of B in A's frame, that is farthest along a direction.
fn farthest_difference(pair: &PiecePair<'_>, along: DVec3) -> DVec3 {
    let of_b = pair.b.farthest(-pair.b_to_a.inverse_vector(along));
    pair.a.farthest(along) - pair.b_to_a.point(of_b)
}

/// A polytope with corners among the differences of the pieces' points `[GJK88]`: where it holds the
/// origin, the pieces intersect.
///
/// It grows as in the expanding polytope algorithm `[BERGEN01]`, but need not hold the origin to begin
/// with. Its faces are a closed surface whatever rounding makes of their normals: what a new corner
/// sees is replaced by a cone to the rim of that. Once all look away from the origin it winds about it.
struct Inner {
    corners: Vec<DVec3>,
    faces: Vec<Face>,
}

#[derive(Clone, Copy)]
struct Face {
    /// Counter-clockwise seen from outside.
    corners: [usize; 3],
    /// Unit.
    normal: DVec3,
    /// The distances of the nearest and the farthest of its corners from the origin, along its
    /// normal.
    depth: f64,
    height: f64,
}

impl Inner {
    /// Four differences far from one another; none when all differences are, to within rounding, in a
    /// plane, so that nothing is deeper than that.
    fn tetrahedron(pair: &PiecePair<'_>, rounding: f64) -> Option<Self> {
        let both = |along: DVec3| [along, -along].map(|along| farthest_difference(pair, along));
        let farther = |best: (f64, DVec3), next: (f64, DVec3)| match next.0 > best.0 {
            true => next,
            false => best,
        };
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
        let normal = unit_or_any(across(b - a, c - a));
        let d = pick(&both(normal), &|p| normal.dot(p - a).abs())?;
        let corners = match normal.dot(d - a) < 0.0 {
            true => vec![a, b, c, d],
            false => vec![a, c, b, d],
        };
        let mut inner = Inner {
            corners,
            faces: Vec::new(),
        };
        for face in [[0, 1, 2], [0, 3, 1], [1, 3, 2], [2, 3, 0]] {
            inner.push(face);
        }
        Some(inner)
    }

    fn push(&mut self, corners: [usize; 3]) {
        let [a, b, c] = corners.map(|k| self.corners[k]);
        let normal = normal([a, b, c]);
        let heights = [a, b, c].map(|p| normal.dot(p));
        self.faces.push(Face {
            corners,
            normal,
            depth: heights.into_iter().fold(f64::INFINITY, lesser),
            height: heights.into_iter().fold(f64::NEG_INFINITY, greater),
        });
    }

    /// The face that is nearest to the origin, or farthest on its wrong side.
    fn shallowest(&self) -> Option<&Face> {
        self.faces.iter().min_by(|f, g| f.depth.total_cmp(&g.depth))
    }

    /// Adds a corner that sees a face.
    fn add(&mut self, corner: DVec3, seen: [usize; 3]) {
        let new = self.corners.len();
        self.corners.push(corner);
        let mut rim: Vec<[usize; 2]> = Vec::new();
        self.faces.retain(|face| {
            let sees = face.corners == seen || face.normal.dot(corner) > face.height;
            for k in (0..3).filter(|_| sees) {
                let [from, to] = [face.corners[k], face.corners[(k + 1) % 3]];
                // An edge of two faces that go is none of the rim.
                match rim.iter().position(|&edge| edge == [to, from]) {
                    Some(other) => drop(rim.swap_remove(other)),
                    None => rim.push([from, to]),
                }
            }
            !sees
        });
        for [from, to] in rim {
            self.push([from, to, new]);
        }
    }
}

/// The unit normal of a triangle, with which even the corners of a needle are level: of the rounding of
/// the cross product it is what is along the needle that would tilt it.
fn normal([a, b, c]: [DVec3; 3]) -> DVec3 {
    let edges = [b - a, c - b, a - c];
    let longest = |e: DVec3, f: DVec3| match f.length_squared() > e.length_squared() {
        true => f,
        false => e,
    };
    let along = unit_or_any(edges.into_iter().fold(DVec3::ZERO, longest));
    let normal = unit_or_any(across(edges[0], edges[1]));
    unit_or_any(normal - along * along.dot(normal))
}

#[cfg(test)]
mod tests;
