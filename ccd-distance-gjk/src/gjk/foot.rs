//! The point of a simplex that is nearest to the origin, called its foot.

use ccd_core::glam::DVec3;

/// A point of a simplex, usually the point nearest to the origin.
#[derive(Clone, Copy, Debug)]
pub(crate) struct NearestPoint {
    /// The weights of the vertices, none negative, of sum one.
    pub(crate) weights: [f64; 4],
    /// The position of the point: the sum of the vertices times `weights`.
    pub(crate) point: DVec3,
    /// The direction of `point`, of any length; `None` if the origin is inside. It is computed from the nearest
    /// feature, so that it is accurate for a short `point`.
    pub(crate) direction: Option<DVec3>,
}

impl NearestPoint {
    /// Creates the foot that is the vertex with the given index.
    pub(crate) fn at_vertex(point: DVec3, index: usize) -> Self {
        let mut weights = [0.0; 4];
        weights[index] = 1.0;
        NearestPoint {
            weights,
            point,
            direction: Some(point),
        }
    }

    /// Converts the foot on a sub-simplex to a foot on the whole simplex. Vertex `k` of the sub-simplex is vertex
    /// `indices[k]` of the whole simplex.
    pub(crate) fn lifted_to_whole_simplex(self, indices: &[usize]) -> Self {
        let mut weights = [0.0; 4];
        for (&index, &weight) in indices.iter().zip(&self.weights) {
            weights[index] = weight;
        }
        NearestPoint { weights, ..self }
    }

    /// Returns `self` or `other`, whichever is nearer to the origin; `other` if both are equally near.
    pub(crate) fn nearer_of(self, other: Option<Self>) -> Self {
        match other {
            Some(other) if !(self.point.length_squared() < other.point.length_squared()) => other,
            _ => self,
        }
    }
}
