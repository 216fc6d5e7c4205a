//! The Minkowski difference of a pair's hulls, with its support function.

use super::simplex::Vertex;
use crate::tolerance::MAX_SCANNED_POINTS;
use ccd_core::glam::DVec3;
use ccd_core::{Piece, PiecePair};

/// The Minkowski difference of a pair's hulls, along A's axes.
///
/// Points are relative to the first point of A's piece, and B's piece is rotated about its own first point: rounding
/// depends on the sizes and the distance of the pieces, not on their positions.
pub(crate) struct MinkowskiDifference<'a> {
    piece_pair: &'a PiecePair<'a>,
    reference_point_a: DVec3,
    reference_point_b: DVec3,
    /// The vector from the first point of A's piece to the first point of B's piece.
    pub(crate) between: DVec3,
}

impl<'a> MinkowskiDifference<'a> {
    /// Creates the difference of a pair of pieces; `None` if a piece has no points.
    pub(crate) fn new(pair: &'a PiecePair<'a>) -> Option<Self> {
        let (&first_a, &first_b) = (pair.a.points.first()?, pair.b.points.first()?);
        Some(MinkowskiDifference {
            piece_pair: pair,
            reference_point_a: first_a,
            reference_point_b: first_b,
            between: pair.b_to_a.transform_point(first_b) - first_a,
        })
    }

    /// Returns a point of A's piece, relative to the first point of A's piece; `None` if the index is out of range.
    #[inline]
    pub(crate) fn point_a(&self, index: u32) -> Option<DVec3> {
        Some(*self.piece_pair.a.points.get(index as usize)? - self.reference_point_a)
    }

    /// Returns a point of B's piece along A's axes, relative to the first point of A's piece; `None` if the index is
    /// out of range.
    #[inline]
    pub(crate) fn point_b(&self, index: u32) -> Option<DVec3> {
        let turned = *self.piece_pair.b.points.get(index as usize)? - self.reference_point_b;
        Some(self.piece_pair.b_to_a.rotation * turned + self.between)
    }

    /// Returns the vertex of the difference with the least height along `direction`.
    pub(crate) fn lowest_vertex(&self, direction: DVec3) -> Vertex {
        let a = farthest_index_along(&self.piece_pair.a, self.reference_point_a, direction);
        let turned = self.piece_pair.b_to_a.inverse_transform_vector(direction);
        let b = farthest_index_along(&self.piece_pair.b, self.reference_point_b, -turned);
        self.vertex(a, b).unwrap_or(Vertex {
            point: self.between,
            a: 0,
            b: 0,
        })
    }

    /// Returns the vertex `b − a` for the points with these indices; `None` if an index is out of range.
    #[inline]
    pub(crate) fn vertex(&self, a: u32, b: u32) -> Option<Vertex> {
        let point = self.point_b(b)? - self.point_a(a)?;
        Some(Vertex { point, a, b })
    }
}

/// Returns the index of a point of a piece that is farthest along a direction.
///
/// Scans up to [`MAX_SCANNED_POINTS`] points; for more, calls [`Piece::extremal_point`].
#[inline]
fn farthest_index_along(piece: &Piece<'_>, first: DVec3, direction: DVec3) -> u32 {
    if piece.points.len() > MAX_SCANNED_POINTS {
        return piece.extremal_point(direction);
    }
    let mut best = (0, f64::NEG_INFINITY);
    for (k, &point) in (0..).zip(piece.points) {
        let height = direction.dot(point - first);
        if height > best.1 {
            best = (k, height);
        }
    }
    best.0
}
