//! Finds extremal corners by hill climbing, from a start in a table of directions `[SWIFT01]`.

use super::Polytope;
use ccd_core::glam::DVec3;

/// A table of extremal vertices along 96 directions: those to the centers of 16 squares on each side of a cube.
///
/// A direction belongs to the square through which it passes. In most polytopes the vertex of the square is one or two
/// edges from the extremal one.
#[derive(Clone, Debug)]
pub(crate) struct StartVertexTable([u32; CUBE_MAP_SQUARE_COUNT]);

/// The number of squares along an edge of the cube.
const CUBE_MAP_SQUARES_PER_EDGE: usize = 4;

/// The number of squares on all sides of the cube.
const CUBE_MAP_SQUARE_COUNT: usize = 6 * CUBE_MAP_SQUARES_PER_EDGE * CUBE_MAP_SQUARES_PER_EDGE;

impl StartVertexTable {
    /// Fills the table by hill climbing, from square to square.
    pub(crate) fn new(polytope: &Polytope) -> Self {
        let mut corners = [0; CUBE_MAP_SQUARE_COUNT];
        let mut at = 0;
        for (square, corner) in corners.iter_mut().enumerate() {
            at = polytope.hill_climb(at, square_center_direction(square));
            *corner = at;
        }
        StartVertexTable(corners)
    }

    /// Returns the table's vertex for a direction of any length; an arbitrary vertex if the direction is not finite.
    fn start_vertex(&self, direction: DVec3) -> u32 {
        self.0[square_index_towards(direction)]
    }
}

/// Returns the index of the square through which a direction passes.
fn square_index_towards(direction: DVec3) -> usize {
    let size = direction.abs();
    let axis = match (size.x >= size.y, size.x >= size.z, size.y >= size.z) {
        (true, true, _) => 0,
        (_, _, true) => 1,
        _ => 2,
    };
    let side = 2 * axis + usize::from(direction[axis] < 0.0);
    let step = |across: f64| {
        let part = 0.5 * CUBE_MAP_SQUARES_PER_EDGE as f64 * (1.0 + across / size[axis]);
        // NaN is cast to 0.
        (part as usize).min(CUBE_MAP_SQUARES_PER_EDGE - 1)
    };
    let (u, v) = (direction[(axis + 1) % 3], direction[(axis + 2) % 3]);
    (side * CUBE_MAP_SQUARES_PER_EDGE + step(u)) * CUBE_MAP_SQUARES_PER_EDGE + step(v)
}

/// Returns the direction at the center of a square.
fn square_center_direction(square: usize) -> DVec3 {
    let (side, u, v) = (
        square / (CUBE_MAP_SQUARES_PER_EDGE * CUBE_MAP_SQUARES_PER_EDGE),
        square / CUBE_MAP_SQUARES_PER_EDGE % CUBE_MAP_SQUARES_PER_EDGE,
        square % CUBE_MAP_SQUARES_PER_EDGE,
    );
    let across = |step: usize| (step as f64 + 0.5) / (0.5 * CUBE_MAP_SQUARES_PER_EDGE as f64) - 1.0;
    let axis = side / 2;
    let mut out = DVec3::ZERO;
    out[axis] = if side % 2 == 1 { -1.0 } else { 1.0 };
    out[(axis + 1) % 3] = across(u);
    out[(axis + 2) % 3] = across(v);
    out
}

impl Polytope {
    /// Returns a corner that is farthest along a direction, up to rounding.
    pub(crate) fn extremal_vertex(&self, direction: DVec3) -> u32 {
        if let Some(table) = &self.start_vertex_table {
            return self.hill_climb(table.start_vertex(direction), direction);
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

    /// Moves to the highest neighbour until no neighbour is higher.
    ///
    /// It may stop before corners that are higher by rounding only. A march continues from there.
    fn hill_climb(&self, start: u32, direction: DVec3) -> u32 {
        let height = |v: u32| self.vertex(v).point.dot(direction);
        let (mut at, mut highest) = (start, height(start));
        // Every round climbs.
        for _ in 0..self.vertices.len() {
            let before = at;
            for edge in self.outgoing_edges_of(before) {
                let here = height(edge.end_vertex);
                if here > highest {
                    (at, highest) = (edge.end_vertex, here);
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
