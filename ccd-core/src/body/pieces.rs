//! The convex pieces of a body, with their points and facets in contiguous lists.

pub(crate) mod builder;
#[cfg(feature = "serde")]
mod serial;
mod unpack;

use super::cache_table::CacheTable;
use super::facets::{Facets, range_from_ends};
use super::feature::Feature;
use super::feature_lookup::find_mesh_feature;
use super::piece::{CacheTableRow, ConvexCombination, Piece};
use super::polytope::{FacetOrigin, MeshFace};
use crate::error::InputError;
use crate::limits::MAX_COORDINATE;
use builder::{PiecesBuilder, PolytopeParts};
use glam::DVec3;

/// The convex pieces of one body, with the vertex and face numbers of the mesh that they were made from.
#[derive(Clone, Debug)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(
    feature = "serde",
    serde(try_from = "serial::StoredPieces", into = "serial::StoredPieces")
)]
pub struct Pieces {
    points: Vec<DVec3>,
    vertex_ids: Vec<u32>,
    shape: PieceShapes,
    /// The cached values that backends derive from the pieces.
    cache_table: CacheTable,
}

/// The largest number of points that all pieces of a body may have together. Indices have 32 bits: a quarter of their
/// range is for points, the rest leaves room for nodes.
const MAX_BODY_POINTS: usize = u32::MAX as usize / 4;

#[derive(Clone, Debug)]
enum PieceShapes {
    /// Every piece is one triangular face of the mesh, with radius 0.
    Triangles {
        face_ids: Vec<u32>,
    },
    Polytopes(Box<Polytopes>),
}

/// The data that convex polytopes have and triangles lack.
#[derive(Clone, Debug, Default)]
struct Polytopes {
    /// The end of each piece's points in the list of points.
    point_ends: Vec<u32>,
    radii: Vec<f64>,
    /// The end of each piece's facets in `facet_corner_ends` and `facet_source_mesh_faces`.
    facet_ends: Vec<u32>,
    facet_source_mesh_faces: Vec<FacetOrigin>,
    /// The end of each facet's corners in `facet_corners`.
    facet_corner_ends: Vec<u32>,
    facet_corners: Vec<u32>,
    /// The end of each piece's mesh faces in `faces`.
    face_ends: Vec<u32>,
    faces: Vec<MeshFace>,
}

impl Pieces {
    /// Creates one piece per triangle of a mesh or soup; `face_ids[k]` is the number of `faces[k]`.
    ///
    /// # Errors
    /// [`InputError::VertexOutOfRange`], [`InputError::BadPoint`], [`InputError::NoPieces`],
    /// [`InputError::FaceIdCountMismatch`], [`InputError::TooManyPieces`].
    pub fn from_triangles(
        vertices: &[DVec3],
        faces: &[[u32; 3]],
        face_ids: &[u32],
    ) -> Result<Self, InputError> {
        if faces.len() != face_ids.len() {
            return Err(InputError::FaceIdCountMismatch {
                faces: faces.len(),
                id_count: face_ids.len(),
            });
        }
        if faces.len() >= MAX_BODY_POINTS / 3 {
            return Err(InputError::TooManyPieces {
                pieces: faces.len(),
            });
        }
        for (face, corners) in faces.iter().enumerate() {
            if let Some(&vertex) = corners.iter().find(|&&v| v as usize >= vertices.len()) {
                return Err(InputError::VertexOutOfRange {
                    face,
                    vertex,
                    vertices: vertices.len(),
                });
            }
        }
        let vertex_ids: Vec<u32> = faces.iter().flatten().copied().collect();
        let points = vertex_ids.iter().map(|&v| vertices[v as usize]).collect();
        let face_ids = face_ids.to_vec();
        Pieces::new_unvalidated(points, vertex_ids, PieceShapes::Triangles { face_ids })
            .into_validated()
    }

    fn new_unvalidated(points: Vec<DVec3>, vertex_ids: Vec<u32>, shape: PieceShapes) -> Self {
        Pieces {
            points,
            vertex_ids,
            shape,
            cache_table: CacheTable::default(),
        }
    }

    fn into_validated(self) -> Result<Self, InputError> {
        if self.len() == 0 {
            return Err(InputError::NoPieces);
        }
        if self.points.len() >= MAX_BODY_POINTS {
            return Err(InputError::TooManyPieces { pieces: self.len() });
        }
        for piece in 0..self.len() {
            self.check_facets_and_faces(piece)?;
        }
        for piece in 0..self.len() {
            let points = &self.points[self.point_range(piece)];
            if points.is_empty() {
                return Err(InputError::EmptyPiece { piece });
            }
            // Written so that NaN fails.
            let good = |p: &DVec3| p.abs().max_element() <= MAX_COORDINATE && p.is_finite();
            if let Some(point) = points.iter().position(|p| !good(p)) {
                return Err(InputError::BadPoint { piece, point });
            }
            let radius = self.radius(piece);
            if !(0.0..=MAX_COORDINATE).contains(&radius) {
                return Err(InputError::BadRadius { piece, radius });
            }
        }
        Ok(self)
    }

    /// Checks that a piece's facets have valid corners, and that its mesh faces have finite coordinates.
    fn check_facets_and_faces(&self, piece: usize) -> Result<(), InputError> {
        let facets = self.facets(piece);
        let count = self.point_range(piece).len();
        let exists = |&corner: &u32| (corner as usize) < count;
        let good = |corners: &[u32]| corners.len() >= 3 && corners.iter().all(exists);
        if let Some(facet) = facets.iter().position(|corners| !good(corners)) {
            return Err(InputError::FacetOutOfRange { piece, facet });
        }
        let finite = |face: &MeshFace| face.corners.iter().all(|p| p.is_finite());
        match facets.mesh_faces.iter().position(|face| !finite(face)) {
            Some(face) => Err(InputError::BadFace { piece, face }),
            None => Ok(()),
        }
    }

    /// Returns the number of pieces, at least one.
    #[allow(clippy::len_without_is_empty)]
    pub fn len(&self) -> usize {
        match &self.shape {
            PieceShapes::Triangles { face_ids } => face_ids.len(),
            PieceShapes::Polytopes(polytopes) => polytopes.point_ends.len(),
        }
    }

    /// Returns whether every piece is a triangle with radius 0.
    pub fn are_all_triangles(&self) -> bool {
        matches!(self.shape, PieceShapes::Triangles { .. })
    }

    /// Returns the piece at an index, as a view of the shared points and facets.
    ///
    /// # Panics
    /// When `index` is not below [`Pieces::len`].
    #[inline]
    pub fn get(&self, index: usize) -> Piece<'_> {
        Piece {
            points: &self.points[self.point_range(index)],
            radius: self.radius(index),
            facets: self.facets(index),
            support_map: None,
            cache_table_row: Some(CacheTableRow {
                cache_table: &self.cache_table,
                row_len: self.len(),
                index,
            }),
        }
    }

    /// Returns all pieces in order.
    pub fn iter(&self) -> impl Iterator<Item = Piece<'_>> {
        (0..self.len()).map(|k| self.get(k))
    }

    /// Returns all points of all pieces in order. Points that pieces share appear once for each piece.
    pub fn points(&self) -> &[DVec3] {
        &self.points
    }

    /// Returns the approximate memory use in bytes.
    pub(crate) fn memory_usage(&self) -> usize {
        let others = match &self.shape {
            PieceShapes::Triangles { face_ids } => size_of_val(face_ids.as_slice()),
            PieceShapes::Polytopes(polytopes) => polytopes.memory_usage(),
        };
        size_of_val(self.points.as_slice()) + 4 * self.vertex_ids.len() + others
    }

    /// Returns the three corners of a piece. All pieces must be triangles.
    #[inline]
    pub(crate) fn triangle(&self, index: usize) -> [DVec3; 3] {
        let corners = &self.points[3 * index..3 * index + 3];
        [corners[0], corners[1], corners[2]]
    }

    /// Returns the corners of the first mesh triangle on a piece, or of the piece if it is a triangle.
    pub(crate) fn first_mesh_triangle(&self, index: usize) -> Option<[DVec3; 3]> {
        if self.are_all_triangles() {
            Some(self.triangle(index))
        } else {
            self.get(index).mesh_triangles().next().map(|(_, t)| t)
        }
    }

    /// Returns the points of consecutive pieces, one piece after the other.
    pub(crate) fn points_of(&self, pieces: std::ops::Range<usize>) -> &[DVec3] {
        let start = self.point_range(pieces.start).start;
        &self.points[start..self.point_range(pieces.end - 1).end]
    }

    /// Returns the pieces in a new order: piece `k` of the result is piece `order[k]` of `self`.
    pub(crate) fn with_piece_order(&self, order: &[u32]) -> Pieces {
        let order = order.iter().map(|&k| k as usize);
        match &self.shape {
            PieceShapes::Triangles { face_ids } => {
                let numbers = self.vertex_ids.as_chunks::<3>().0;
                Pieces::new_unvalidated(
                    order.clone().flat_map(|k| self.triangle(k)).collect(),
                    order.clone().flat_map(|k| numbers[k]).collect(),
                    PieceShapes::Triangles {
                        face_ids: order.map(|k| face_ids[k]).collect(),
                    },
                )
            }
            PieceShapes::Polytopes(_) => {
                let mut builder = PiecesBuilder::default();
                for k in order {
                    let piece = self.get(k);
                    let origins = piece.facets.origins_in_mesh().iter().copied();
                    builder.push(PolytopeParts {
                        points: piece.points,
                        vertex_ids: self.vertex_ids(k),
                        facets: piece.facets.iter().zip(origins),
                        faces: piece.facets.mesh_faces.iter().copied(),
                        radius: piece.radius,
                    });
                }
                builder.into_unchecked_pieces()
            }
        }
    }

    /// Returns the mesh's vertex, edge or face at a point of a piece. It has the combined corners, or else it is the
    /// face that contains the point. It is [`Feature::Piece`] for points inside, and if all facets of the piece are
    /// virtual.
    pub fn feature(&self, piece: usize, point: &ConvexCombination) -> Feature {
        let id = |corner: u32| self.vertex_ids[self.point_range(piece).start + corner as usize];
        match (&self.shape, point.point_indices()) {
            (_, []) => Feature::Piece(piece as u32),
            (PieceShapes::Triangles { .. }, [v]) => Feature::Vertex(id(*v)),
            (PieceShapes::Triangles { .. }, [v, w]) => Feature::edge(id(*v), id(*w)),
            (PieceShapes::Triangles { face_ids }, _) => Feature::Face(face_ids[piece]),
            (PieceShapes::Polytopes(_), _) => find_mesh_feature(&self.get(piece), point, id)
                .unwrap_or(Feature::Piece(piece as u32)),
        }
    }

    #[inline]
    pub(crate) fn point_range(&self, piece: usize) -> std::ops::Range<usize> {
        match &self.shape {
            PieceShapes::Triangles { .. } => 3 * piece..3 * piece + 3,
            PieceShapes::Polytopes(polytopes) => range_from_ends(&polytopes.point_ends, piece),
        }
    }

    #[inline]
    fn radius(&self, piece: usize) -> f64 {
        match &self.shape {
            PieceShapes::Triangles { .. } => 0.0,
            PieceShapes::Polytopes(polytopes) => polytopes.radii[piece],
        }
    }

    #[inline]
    fn facets(&self, piece: usize) -> Facets<'_> {
        match &self.shape {
            PieceShapes::Triangles { .. } => Facets::EMPTY,
            PieceShapes::Polytopes(polytopes) => polytopes.facets_of(piece),
        }
    }
}

impl Polytopes {
    #[inline]
    fn facets_of(&self, piece: usize) -> Facets<'_> {
        let facets = range_from_ends(&self.facet_ends, piece);
        Facets {
            corners_start_index: match facets.start {
                0 => 0,
                start => self.facet_corner_ends[start - 1],
            },
            facet_sources: &self.facet_source_mesh_faces[facets.clone()],
            ends: &self.facet_corner_ends[facets],
            corners: &self.facet_corners,
            mesh_faces: &self.faces[range_from_ends(&self.face_ends, piece)],
        }
    }

    fn memory_usage(&self) -> usize {
        size_of_val(self.facet_source_mesh_faces.as_slice())
            + size_of_val(self.faces.as_slice())
            + 4 * (4 * self.facet_ends.len()
                + self.facet_corner_ends.len()
                + self.facet_corners.len())
    }
}

#[cfg(test)]
mod tests;
