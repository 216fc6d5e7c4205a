//! Finds extremal corners by a table of directions and hill climbing `[SWIFT01]`.

use super::Polytope;
use ccd_core::glam::DVec3;

/// The extremal vertices in directions all around, arranged by squares on the sides of a cube.
///
/// A direction belongs to one of sixteen squares on one of six sides of a cube. In most polytopes the vertex of the
/// square is one or two edges from the extremal one.
#[derive(Clone, Debug)]
pub(crate) struct DirectionTable([u32; 6 * SQUARES * SQUARES]);

/// The number of squares along an edge of the cube.
const SQUARES: usize = 4;

impl DirectionTable {
    /// Fills the table by hill climbing, from square to square.
    pub(crate) fn new(polytope: &Polytope) -> Self {
        let mut corners = [0; 6 * SQUARES * SQUARES];
        let mut at = 0;
        for (square, corner) in corners.iter_mut().enumerate() {
            at = polytope.climb(at, middle_of(square));
            *corner = at;
        }
        DirectionTable(corners)
    }

    /// Returns the vertex in the table for a direction of any length; any vertex if it is not finite.
    fn vertex_towards(&self, direction: DVec3) -> u32 {
        self.0[square_of(direction)]
    }
}

/// Returns the index of the square through which a direction passes.
fn square_of(direction: DVec3) -> usize {
    let size = direction.abs();
    let axis = match (size.x >= size.y, size.x >= size.z, size.y >= size.z) {
        (true, true, _) => 0,
        (_, _, true) => 1,
        _ => 2,
    };
    let side = 2 * axis + usize::from(direction[axis] < 0.0);
    let step = |across: f64| {
        let part = 0.5 * SQUARES as f64 * (1.0 + across / size[axis]);
        // NaN is cast to 0.
        (part as usize).min(SQUARES - 1)
    };
    let (u, v) = (direction[(axis + 1) % 3], direction[(axis + 2) % 3]);
    (side * SQUARES + step(u)) * SQUARES + step(v)
}

/// Returns the direction at the centre of a square.
fn middle_of(square: usize) -> DVec3 {
    let (side, u, v) = (
        square / (SQUARES * SQUARES),
        square / SQUARES % SQUARES,
        square % SQUARES,
    );
    let across = |step: usize| (step as f64 + 0.5) / (0.5 * SQUARES as f64) - 1.0;
    let axis = side / 2;
    let mut out = DVec3::ZERO;
    out[axis] = if side % 2 == 1 { -1.0 } else { 1.0 };
    out[(axis + 1) % 3] = across(u);
    out[(axis + 2) % 3] = across(v);
    out
}

impl Polytope {
    /// Returns a corner that is farthest along a direction, up to rounding.
    pub(crate) fn extremal(&self, direction: DVec3) -> u32 {
        if let Some(table) = &self.directions {
            return self.climb(table.vertex_towards(direction), direction);
        }
        let heights = self
            .vertices
            .iter()
            .map(|v| v.point.dot(direction))
            .zip(0..);
        let none = (f64::NEG_INFINITY, 0);
        heights
            .fold(none, |best, here| if here.0 > best.0 { here } else { best })
            .1
    }

    /// Climbs to the highest neighbour until no neighbour is higher.
    ///
    /// It may stop short of corners that are level up to rounding: a march goes on from there.
    fn climb(&self, start: u32, direction: DVec3) -> u32 {
        let height = |v: u32| self.vertex(v).point.dot(direction);
        let (mut at, mut highest) = (start, height(start));
        // Every round climbs.
        for _ in 0..self.vertices.len() {
            let before = at;
            for spoke in self.spokes_of(before) {
                let here = height(spoke.to);
                if here > highest {
                    (at, highest) = (spoke.to, here);
                }
            }
            if at == before {
                break;
            }
        }
        at
    }
}

#[cfg(test)]
mod tests;
