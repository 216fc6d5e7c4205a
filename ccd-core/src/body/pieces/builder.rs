//! Builds a list of pieces by adding one polytope after the other.

use super::{PieceShapes, Pieces, Polytopes};
use crate::body::polytope::{FacetOrigin, MeshFace, Polytope};
use crate::error::InputError;
use glam::DVec3;

/// The data of a polytope that is added to a list, borrowed or as iterators; otherwise as in
/// [`Polytope`](crate::Polytope).
pub(crate) struct PolytopeParts<'a, A, B> {
    pub(crate) points: &'a [DVec3],
    pub(crate) vertex_ids: &'a [u32],
    /// The corners and the origin of each facet.
    pub(crate) facets: A,
    pub(crate) faces: B,
    pub(crate) radius: f64,
}

/// A list of pieces under construction.
#[derive(Default)]
pub(crate) struct PiecesBuilder {
    points: Vec<DVec3>,
    vertex_ids: Vec<u32>,
    polytope_data: Polytopes,
}

impl Pieces {
    /// Creates pieces from convex polytopes, each grown by a radius. A ball is one point and a capsule two, with a radius.
    ///
    /// # Guarantee
    /// A piece is the hull of its points. Facets only name features and confirm overlaps, so a wrong facet list
    /// cannot make a query late.
    ///
    /// # Errors
    /// [`InputError::EmptyPiece`], [`InputError::BadPoint`], [`InputError::BadRadius`],
    /// [`InputError::FacetOutOfRange`], [`InputError::BadFace`], [`InputError::NoPieces`],
    /// [`InputError::TooManyPieces`].
    pub fn from_polytopes(polytopes: &[Polytope]) -> Result<Self, InputError> {
        let mut builder = PiecesBuilder::default();
        for polytope in polytopes {
            let facets = polytope.facets.iter();
            builder.push(PolytopeParts {
                points: &polytope.points,
                vertex_ids: &polytope.vertex_ids,
                facets: facets.map(|facet| (&facet.corners[..], facet.origin)),
                faces: polytope.faces.iter().copied(),
                radius: polytope.radius,
            });
        }
        builder.into_pieces()
    }
}

impl PiecesBuilder {
    /// Adds a polytope to the list as a piece, without checks.
    pub(crate) fn push<'a>(
        &mut self,
        polytope: PolytopeParts<
            'a,
            impl Iterator<Item = (&'a [u32], FacetOrigin)>,
            impl Iterator<Item = MeshFace>,
        >,
    ) {
        let count = polytope.points.len();
        self.points.extend_from_slice(polytope.points);
        if polytope.vertex_ids.len() == count {
            self.vertex_ids.extend_from_slice(polytope.vertex_ids);
        } else {
            self.vertex_ids.extend(0..count as u32);
        }
        let polytopes = &mut self.polytope_data;
        polytopes.point_ends.push(self.points.len() as u32);
        polytopes.radii.push(polytope.radius);
        for (corners, origin) in polytope.facets {
            polytopes.facet_corners.extend_from_slice(corners);
            polytopes
                .facet_corner_ends
                .push(polytopes.facet_corners.len() as u32);
            polytopes.facet_source_mesh_faces.push(origin);
        }
        polytopes
            .facet_ends
            .push(polytopes.facet_source_mesh_faces.len() as u32);
        polytopes.faces.extend(polytope.faces);
        polytopes.face_ends.push(polytopes.faces.len() as u32);
    }

    /// Checks the pieces, and returns the finished list.
    ///
    /// # Errors
    /// The errors of [`Pieces::from_polytopes`].
    pub(crate) fn into_pieces(self) -> Result<Pieces, InputError> {
        self.into_unchecked_pieces().into_validated()
    }

    /// Returns the finished list without checks, for pieces that are known to be valid.
    pub(super) fn into_unchecked_pieces(self) -> Pieces {
        let shape = PieceShapes::Polytopes(Box::new(self.polytope_data));
        Pieces::new_unvalidated(self.points, self.vertex_ids, shape)
    }
}
