//! Pieces put together one by one.

use super::{Pieces, Radii, Shape, Surfaces};
use crate::body::polytope::{Face, Origin};
use crate::body::side_table::SideTable;
use crate::error::InputError;
use glam::DVec3;

/// A polytope by its parts, as those of [`Polytope`](crate::Polytope).
pub(crate) struct Listed<'a, A, B> {
    pub(crate) points: &'a [DVec3],
    pub(crate) vertex_ids: &'a [u32],
    /// Corners, and what the facet is of the mesh.
    pub(crate) facets: A,
    pub(crate) faces: B,
    pub(crate) radius: f64,
}

/// The pieces so far.
pub(crate) struct Row {
    points: Vec<DVec3>,
    vertex_ids: Vec<u32>,
    point_ends: Vec<u32>,
    radii: Vec<f64>,
    surfaces: Surfaces,
}

/// How much there is of everything.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Room {
    pub(crate) pieces: usize,
    pub(crate) points: usize,
    pub(crate) facets: usize,
    /// Of all facets.
    pub(crate) corners: usize,
    pub(crate) faces: usize,
}

impl Row {
    pub(crate) fn with_room(room: Room) -> Self {
        Row {
            points: Vec::with_capacity(room.points),
            vertex_ids: Vec::with_capacity(room.points),
            point_ends: Vec::with_capacity(room.pieces),
            radii: Vec::with_capacity(room.pieces),
            surfaces: Surfaces {
                facet_ends: Vec::with_capacity(room.pieces),
                origins: Vec::with_capacity(room.facets),
                corner_ends: Vec::with_capacity(room.facets),
                corners: Vec::with_capacity(room.corners),
                face_ends: Vec::with_capacity(room.pieces),
                faces: Vec::with_capacity(room.faces),
            },
        }
    }

    /// Adds one.
    ///
    /// # Errors
    /// [`InputError::FacetOutOfRange`], [`InputError::BadFace`].
    pub(crate) fn push<'a>(
        &mut self,
        polytope: Listed<'a, impl Iterator<Item = (&'a [u32], Origin)>, impl Iterator<Item = Face>>,
    ) -> Result<(), InputError> {
        let (piece, count) = (self.point_ends.len(), polytope.points.len());
        self.points.extend_from_slice(polytope.points);
        match polytope.vertex_ids.len() == count {
            true => self.vertex_ids.extend_from_slice(polytope.vertex_ids),
            false => self.vertex_ids.extend(0..count as u32),
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

    /// All of them.
    ///
    /// # Errors
    /// As [`Pieces::polytopes`].
    pub(crate) fn into_pieces(self) -> Result<Pieces, InputError> {
        Pieces {
            points: self.points,
            vertex_ids: self.vertex_ids,
            point_ends: self.point_ends,
            radii: Radii::Each(self.radii),
            shape: Shape::Polytopes(Box::new(self.surfaces)),
            side_table: SideTable::default(),
        }
        .checked()
    }
}
