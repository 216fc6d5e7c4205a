//! Simplices of up to four vertices of the Minkowski difference.

use super::foot::NearestPoint;
use super::{segment, tetrahedron, triangle};
use ccd_core::glam::DVec3;

/// A vertex `b − a` of the Minkowski difference, with the indices of both points in their pieces.
#[derive(Clone, Copy, Debug)]
pub struct Vertex {
    /// The position of the vertex: B's point minus A's.
    pub point: DVec3,
    /// The index of A's point.
    pub a: u32,
    /// The index of B's point.
    pub b: u32,
}

/// A simplex of up to four vertices, all with different pairs of points.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Simplex {
    vertices: [Vertex; 4],
    len: usize,
}

impl Simplex {
    /// The simplex without vertices.
    pub(crate) const EMPTY: Self = Simplex {
        vertices: [Vertex {
            point: DVec3::ZERO,
            a: 0,
            b: 0,
        }; 4],
        len: 0,
    };

    /// Returns the vertices of the simplex, of which there may be none.
    pub(crate) fn vertices(&self) -> &[Vertex] {
        &self.vertices[..self.len]
    }

    /// Adds a vertex to the simplex, and returns whether the vertex was added. A duplicate and a fifth vertex are
    /// refused.
    pub(crate) fn push(&mut self, vertex: Vertex) -> bool {
        let same = |v: &Vertex| (v.a, v.b) == (vertex.a, vertex.b);
        let room = self.len < 4 && !self.vertices().iter().any(same);
        if room {
            self.vertices[self.len] = vertex;
            self.len += 1;
        }
        room
    }

    /// Returns the point of the simplex that is nearest to the origin; `None` if it is empty.
    pub(crate) fn foot(&self) -> Option<NearestPoint> {
        let point = |k: usize| self.vertices[k].point;
        match self.len {
            0 => None,
            1 => Some(NearestPoint::at_vertex(point(0), 0)),
            2 => Some(segment::nearest_point(point(0), point(1))),
            3 => Some(triangle::nearest_point(point(0), point(1), point(2))),
            _ => Some(tetrahedron::foot(self.vertices.map(|v| v.point))),
        }
    }

    /// Returns the simplex of the vertices with positive weights, and those weights.
    pub(crate) fn without_zero_weights(&self, foot: &NearestPoint) -> (Self, [f64; 4]) {
        let (mut kept, mut weights) = (Self::EMPTY, [0.0; 4]);
        for (&vertex, &weight) in self.vertices().iter().zip(&foot.weights) {
            if weight > 0.0 {
                weights[kept.len] = weight;
                kept.push(vertex);
            }
        }
        (kept, weights)
    }
}
