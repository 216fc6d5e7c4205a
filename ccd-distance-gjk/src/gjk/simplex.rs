//! Up to four points of the Minkowski difference, and the point of their hull nearest to the origin.

use super::vector::Vector;
use super::{segment, tetrahedron, triangle};
use num_traits::{One, Zero};

/// A point `b − a` of the Minkowski difference, with the points it is made of.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Vertex<V> {
    pub(crate) point: V,
    pub(crate) a: u32,
    pub(crate) b: u32,
}

/// Up to four vertices, no pair of points twice.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Simplex<V> {
    vertices: [Vertex<V>; 4],
    len: usize,
}

impl<V: Vector> Simplex<V> {
    /// No vertex yet.
    pub(crate) const EMPTY: Self = Simplex {
        vertices: [Vertex {
            point: V::ZERO,
            a: 0,
            b: 0,
        }; 4],
        len: 0,
    };

    /// The vertices.
    pub(crate) fn vertices(&self) -> &[Vertex<V>] {
        &self.vertices[..self.len]
    }

    /// Adds a vertex; `false` if the pair is there already, or there are four.
    pub(crate) fn push(&mut self, vertex: Vertex<V>) -> bool {
        let same = |v: &Vertex<V>| (v.a, v.b) == (vertex.a, vertex.b);
        let room = self.len < 4 && !self.vertices().iter().any(same);
        if room {
            self.vertices[self.len] = vertex;
            self.len += 1;
        }
        room
    }

    /// The point of the hull that is nearest to the origin; none of the empty simplex.
    pub(crate) fn foot(&self) -> Option<Foot<V>> {
        let point = |k: usize| self.vertices[k].point;
        match self.len {
            0 => None,
            1 => Some(Foot::corner(point(0), 0)),
            2 => Some(segment::foot(point(0), point(1))),
            3 => Some(triangle::foot(point(0), point(1), point(2))),
            _ => Some(tetrahedron::foot(self.vertices.map(|v| v.point))),
        }
    }

    /// The vertices whose weight is positive, and those weights.
    pub(crate) fn reduced(&self, foot: &Foot<V>) -> (Self, [V::Scalar; 4]) {
        let (mut kept, mut weights) = (Self::EMPTY, [V::Scalar::zero(); 4]);
        for (&vertex, &weight) in self.vertices().iter().zip(&foot.weights) {
            if weight > V::Scalar::zero() {
                weights[kept.len] = weight;
                kept.push(vertex);
            }
        }
        (kept, weights)
    }
}

/// A point of a simplex's hull, meant to be the one nearest to the origin.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Foot<V: Vector> {
    /// One weight per vertex, none negative, of sum one.
    pub(crate) weights: [V::Scalar; 4],
    /// The vertices' combination by these weights.
    pub(crate) point: V,
    /// Along `point`, but made of the feature, so that it stays sharp where the point is short; of any
    /// length. None when the origin is inside.
    pub(crate) direction: Option<V>,
}

impl<V: Vector> Foot<V> {
    /// The corner with the given index.
    pub(crate) fn corner(point: V, index: usize) -> Self {
        let mut weights = [V::Scalar::zero(); 4];
        weights[index] = V::Scalar::one();
        Foot {
            weights,
            point,
            direction: Some(point),
        }
    }

    /// The foot on a sub-simplex, told in the indices of the whole: its vertex `k` is `places[k]`.
    pub(crate) fn lifted(self, places: &[usize]) -> Self {
        let mut weights = [V::Scalar::zero(); 4];
        for (&place, &weight) in places.iter().zip(&self.weights) {
            weights[place] = weight;
        }
        Foot { weights, ..self }
    }

    /// The nearer one, `other` if they are equal.
    pub(crate) fn or_nearer(self, other: Option<Self>) -> Self {
        match other {
            Some(other) if !(self.point.square() < other.point.square()) => other,
            _ => self,
        }
    }
}
