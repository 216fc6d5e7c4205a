//! Finds the side of a flat piece that faces out of the solid.

use super::tree::ray::sum_signed_crossings;
use super::{Body, Solidity};
use crate::math::order::greater;
use crate::rounding::UNIT_ROUNDOFF_F64;
use crate::tuning::INTERIOR_PROBE_DEPTHS;
use glam::DVec3;

/// The orientation of a flat piece relative to the solid that the body's faces bound.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Facing {
    /// The solid is on one side of the piece only; the unit normal points out of the solid.
    OutwardNormal(DVec3),
    /// No side of the piece faces out of a solid. Examples are a piece of a surface, a piece with a volume or without
    /// an area, and two faces back to back.
    NoOutwardSide,
    /// The solid is on different sides at different points, or other faces are too near to decide.
    Unclear,
}

/// The orientation of a flat piece and a point inside the solid near it, computed once per piece.
struct CachedOutwardSide {
    outward_side: Facing,
    inside_point: Option<DVec3>,
}

impl Body {
    /// Returns on which side of a flat piece the solid is; computed at the first call and cached.
    ///
    /// # Guarantee
    /// [`Facing::OutwardNormal`] and [`Facing::NoOutwardSide`] of a solid's flat piece hold, exactly, at the four
    /// examined points of the piece. They hold for its whole part that no other face passes
    /// through.
    pub(crate) fn facing(&self, piece: u32) -> Facing {
        self.cached_outward_side(piece)
            .map_or(Facing::NoOutwardSide, |kept| kept.outward_side)
    }

    /// Returns the unit normal of a flat piece that points out of the solid; `None` if there is no such normal.
    pub(crate) fn outward_normal(&self, piece: u32) -> Option<DVec3> {
        match self.facing(piece) {
            Facing::OutwardNormal(normal) => Some(normal),
            Facing::NoOutwardSide | Facing::Unclear => None,
        }
    }

    /// Returns a point inside the solid, near the middle of a piece; `None` if there is none.
    pub(crate) fn interior_point(&self, piece: u32) -> Option<DVec3> {
        if !self.pieces().get(piece as usize).is_flat() {
            return Some(self.mean_of_points(piece));
        }
        self.cached_outward_side(piece)?.inside_point
    }

    /// Returns the mean of a piece's points.
    pub(crate) fn mean_of_points(&self, piece: u32) -> DVec3 {
        let points = self.pieces().get(piece as usize).points;
        points.iter().sum::<DVec3>() / points.len() as f64
    }

    /// Returns the cached orientation of a flat piece, computed at the first call; `None` unless it is a flat piece of
    /// a solid, with a triangle that has a normal.
    fn cached_outward_side(&self, piece: u32) -> Option<&CachedOutwardSide> {
        let of = self.pieces().get(piece as usize);
        if self.solidity() == Solidity::Surface || !of.is_flat() {
            return None;
        }
        of.cached_value(|_| self.compute_facing(piece))?.as_ref()
    }

    /// Returns the orientation of a flat piece; `None` if no triangle of the mesh with a normal is on it.
    fn compute_facing(&self, piece: u32) -> Option<CachedOutwardSide> {
        let triangle = self.pieces().first_mesh_triangle(piece as usize)?;
        let normal = crate::math::vector::normal(triangle)?;
        let middle = triangle.iter().sum::<DVec3>() / 3.0;
        let samples = [middle, triangle[0], triangle[1], triangle[2]].map(|p| 0.5 * (p + middle));
        let [first, others @ ..] = samples.map(|at| self.facing_at(at, normal));
        let facing = if others.iter().all(|other| *other == first) {
            first
        } else {
            Facing::Unclear
        };
        let size = triangle
            .iter()
            .fold(0.0, |size, p| greater(size, p.distance(middle)));
        let inside = match facing {
            Facing::OutwardNormal(out) => INTERIOR_PROBE_DEPTHS
                .iter()
                .map(|share| middle - out * (share * size))
                .find(|&p| self.has_nonzero_winding(p)),
            Facing::NoOutwardSide | Facing::Unclear => None,
        };
        Some(CachedOutwardSide {
            outward_side: facing,
            inside_point: inside,
        })
    }

    /// Returns on which side of a face the solid is near the point `at`, by the winding numbers of both sides.
    fn facing_at(&self, at: DVec3, normal: DVec3) -> Facing {
        // A mean is rounded in units of the coordinates.
        let slack = 4.0 * UNIT_ROUNDOFF_F64 * at.abs().element_sum();
        let Some(found) = sum_signed_crossings(self.tree(), self.pieces(), at, slack) else {
            return Facing::Unclear;
        };
        let (ahead, behind) = (found.sum_ahead, found.sum_ahead + found.sum_at_start);
        let ahead_is_out = match ahead.abs().cmp(&behind.abs()) {
            _ if found.triangle_count_at_start == 0 => return Facing::Unclear,
            std::cmp::Ordering::Equal => return Facing::NoOutwardSide,
            std::cmp::Ordering::Less => true,
            std::cmp::Ordering::Greater => false,
        };
        if ahead_is_out == (normal.dot(found.direction) > 0.0) {
            Facing::OutwardNormal(normal)
        } else {
            Facing::OutwardNormal(-normal)
        }
    }

    /// Returns whether the winding number of the body's surface about a point is certainly not 0.
    fn has_nonzero_winding(&self, point: DVec3) -> bool {
        sum_signed_crossings(self.tree(), self.pieces(), point, 0.0)
            .is_some_and(|found| found.triangle_count_at_start == 0 && found.sum_ahead != 0)
    }
}

#[cfg(test)]
mod tests;
