//! The Minkowski difference of a pair's hulls: its vertices and its support.

use super::simplex::Vertex;
use super::vector::Vector;
use ccd_core::PiecePair;
use ccd_core::glam::DVec3;

/// The difference of two hulls, in whatever precision and axes.
pub(crate) trait Difference {
    /// The precision.
    type Vector: Vector;

    /// The vertex that is least along `direction`.
    fn support(&self, direction: Self::Vector) -> Vertex<Self::Vector>;

    /// The vertex of the given points, if both pieces have them.
    fn vertex(&self, a: u32, b: u32) -> Option<Vertex<Self::Vector>>;

    /// From the first point of A to that of B.
    fn between(&self) -> Self::Vector;
}

/// A pair in f64, in A's axes, each piece told from its own first point: rounding is that of the
/// pieces' sizes and of their distance, wherever they lie.
pub(crate) struct Exact<'a> {
    pub(crate) pair: &'a PiecePair<'a>,
    first_a: DVec3,
    first_b: DVec3,
    between: DVec3,
}

impl<'a> Exact<'a> {
    /// None for a piece without points.
    pub(crate) fn new(pair: &'a PiecePair<'a>) -> Option<Self> {
        let (&first_a, &first_b) = (pair.a.points.first()?, pair.b.points.first()?);
        Some(Exact {
            pair,
            first_a,
            first_b,
            between: pair.b_to_a.point(first_b) - first_a,
        })
    }

    /// A point of A's piece.
    #[inline]
    pub(crate) fn point_a(&self, index: u32) -> Option<DVec3> {
        Some(*self.pair.a.points.get(index as usize)? - self.first_a)
    }

    /// A point of B's piece.
    #[inline]
    pub(crate) fn point_b(&self, index: u32) -> Option<DVec3> {
        let turned = *self.pair.b.points.get(index as usize)? - self.first_b;
        Some(self.pair.b_to_a.rotation * turned + self.between)
    }
}

impl Difference for Exact<'_> {
    type Vector = DVec3;

    fn support(&self, direction: DVec3) -> Vertex<DVec3> {
        let a = least(self.pair.a.points, |p| -direction.dot(p - self.first_a));
        let turned = self.pair.b_to_a.inverse_vector(direction);
        let b = least(self.pair.b.points, |p| turned.dot(p - self.first_b));
        self.vertex(a, b).unwrap_or(Vertex {
            point: self.between,
            a: 0,
            b: 0,
        })
    }

    #[inline]
    fn vertex(&self, a: u32, b: u32) -> Option<Vertex<DVec3>> {
        let point = self.point_b(b)? - self.point_a(a)?;
        Some(Vertex { point, a, b })
    }

    fn between(&self) -> DVec3 {
        self.between
    }
}

/// The first index of the least value; points are never empty.
#[inline]
fn least<P: Copy, S: PartialOrd>(points: &[P], value: impl Fn(P) -> S) -> u32 {
    let mut best = (0, value(points[0]));
    for (k, &point) in points.iter().enumerate().skip(1) {
        let value = value(point);
        if value < best.1 {
            best = (k as u32, value);
        }
    }
    best.0
}
