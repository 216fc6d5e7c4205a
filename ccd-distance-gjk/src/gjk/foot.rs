//! The point of a simplex that is nearest to the origin.

use ccd_core::glam::DVec3;

/// A point of a simplex's hull, meant to be the one nearest to the origin.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Foot {
    /// One weight per vertex, none negative, of sum one.
    pub(crate) weights: [f64; 4],
    /// The vertices' combination by these weights.
    pub(crate) point: DVec3,
    /// Along `point`, but made of the feature, so that it stays sharp where the point is short; of any
    /// length. None when the origin is inside.
    pub(crate) direction: Option<DVec3>,
}

impl Foot {
    /// The corner with the given index.
    pub(crate) fn corner(point: DVec3, index: usize) -> Self {
        let mut weights = [0.0; 4];
        weights[index] = 1.0;
        Foot {
            weights,
            point,
            direction: Some(point),
        }
    }

    /// The foot on a sub-simplex, told in the indices of the whole: its vertex `k` is `places[k]`.
    pub(crate) fn lifted(self, places: &[usize]) -> Self {
        let mut weights = [0.0; 4];
        for (&place, &weight) in places.iter().zip(&self.weights) {
            weights[place] = weight;
        }
        Foot { weights, ..self }
    }

    /// The nearer one, `other` if they are equal.
    pub(crate) fn or_nearer(self, other: Option<Self>) -> Self {
        match other {
            Some(other) if !(self.point.length_squared() < other.point.length_squared()) => other,
            _ => self,
        }
    }
}
