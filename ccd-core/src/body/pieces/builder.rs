//! Builds a list of pieces, one by one.

use super::{Pieces, Radii, Shape, Surfaces};
use crate::body::polytope::{Face, FacetOrigin, Polytope};
use crate::body::side_table::SideTable;
use crate::error::InputError;
use glam::DVec3;

/// The data of a polytope, as in [`Polytope`](crate::Polytope).
pub(crate) struct PolytopeParts<'a, A, B> {
    pub(crate) points: &'a [DVec3],
    pub(crate) vertex_ids: &'a [u32],
    /// The corners and the origin of each facet.
    pub(crate) facets: A,
    pub(crate) faces: B,
    pub(crate) radius: f64,
}

/// A list of pieces under construction.
pub(crate) struct PiecesBuilder {
    points: Vec<DVec3>,
    vertex_ids: Vec<u32>,
    point_ends: Vec<u32>,
    radii: Vec<f64>,
    surfaces: Surfaces,
}

/// The total numbers of elements in the lists of the pieces.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Capacity {
    pub(crate) pieces: usize,
    pub(crate) points: usize,
    pub(crate) facets: usize,
    /// The number of corners of all facets.
    pub(crate) corners: usize,
    pub(crate) faces: usize,
}

impl Pieces {
    /// Creates pieces from convex polytopes, including balls and capsules.
    ///
    /// # Guarantee
    /// A piece is the hull of its points. Facets only name features and confirm overlaps, so a wrong facet list
    /// cannot make a query late.
    ///
    /// # Errors
    /// [`InputError::EmptyPiece`], [`InputError::BadPoint`], [`InputError::BadRadius`],
    /// [`InputError::FacetOutOfRange`], [`InputError::BadFace`], [`InputError::NoPieces`],
    /// [`InputError::TooManyPieces`].
    pub fn polytopes(polytopes: &[Polytope]) -> Result<Self, InputError> {
        let facets = || polytopes.iter().flat_map(|polytope| &polytope.facets);
        let mut builder = PiecesBuilder::with_capacity(Capacity {
            pieces: polytopes.len(),
            points: polytopes.iter().map(|p| p.points.len()).sum(),
            facets: facets().count(),
            corners: facets().map(|facet| facet.corners.len()).sum(),
            faces: polytopes.iter().map(|p| p.faces.len()).sum(),
        });
        for polytope in polytopes {
            let facets = polytope.facets.iter();
            builder.push(PolytopeParts {
                points: &polytope.points,
                vertex_ids: &polytope.vertex_ids,
                facets: facets.map(|facet| (&facet.corners[..], facet.origin)),
                faces: polytope.faces.iter().copied(),
                radius: polytope.radius,
            })?;
        }
        builder.into_pieces()
    }
}

impl PiecesBuilder {
    pub(crate) fn with_capacity(capacity: Capacity) -> Self {
        PiecesBuilder {
            points: Vec::with_capacity(capacity.points),
            vertex_ids: Vec::with_capacity(capacity.points),
            point_ends: Vec::with_capacity(capacity.pieces),
            radii: Vec::with_capacity(capacity.pieces),
            surfaces: Surfaces {
                facet_ends: Vec::with_capacity(capacity.pieces),
                origins: Vec::with_capacity(capacity.facets),
                corner_ends: Vec::with_capacity(capacity.facets),
                corners: Vec::with_capacity(capacity.corners),
                face_ends: Vec::with_capacity(capacity.pieces),
                faces: Vec::with_capacity(capacity.faces),
            },
        }
    }

    /// Adds a piece to the list.
    ///
    /// # Errors
    /// [`InputError::FacetOutOfRange`], [`InputError::BadFace`].
    pub(crate) fn push<'a>(
        &mut self,
        polytope: PolytopeParts<
            'a,
            impl Iterator<Item = (&'a [u32], FacetOrigin)>,
            impl Iterator<Item = Face>,
        >,
    ) -> Result<(), InputError> {
        let (piece, count) = (self.point_ends.len(), polytope.points.len());
        self.points.extend_from_slice(polytope.points);
        if polytope.vertex_ids.len() == count {
            self.vertex_ids.extend_from_slice(polytope.vertex_ids);
        } else {
            self.vertex_ids.extend(0..count as u32);
        }
        self.point_ends.push(self.points.len() as u32);
        self.radii.push(polytope.radius);
        let surfaces = &mut self.surfaces;
        let exists = |&c: &u32| (c as usize) < count;
        for (facet, (corners, origin)) in polytope.facets.enumerate() {
            if corners.len() < 3 || !corners.iter().all(exists) {
                return Err(InputError::FacetOutOfRange { piece, facet });
            }
            surfaces.corners.extend_from_slice(corners);
            surfaces.corner_ends.push(surfaces.corners.len() as u32);
            surfaces.origins.push(origin);
        }
        surfaces.facet_ends.push(surfaces.origins.len() as u32);
        for (face, on_it) in polytope.faces.enumerate() {
            if !on_it.corners.iter().all(|p| p.is_finite()) {
                return Err(InputError::BadFace { piece, face });
            }
            surfaces.faces.push(on_it);
        }
        surfaces.face_ends.push(surfaces.faces.len() as u32);
        Ok(())
    }

    /// Returns the finished list of pieces.
    ///
    /// # Errors
    /// The errors of [`Pieces::polytopes`].
    pub(crate) fn into_pieces(self) -> Result<Pieces, InputError> {
        Pieces {
            points: self.points,
            vertex_ids: self.vertex_ids,
            point_ends: self.point_ends,
            radii: Radii::PerPiece(self.radii),
            shape: Shape::Polytopes(Box::new(self.surfaces)),
            side_table: SideTable::default(),
        }
        .checked()
    }
}
