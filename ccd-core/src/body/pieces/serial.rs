//! Serialises a list of pieces as triangles or as polytopes. Pieces that are read are checked like pieces that are
//! built.

use super::{PieceShapes, Pieces};
use crate::body::polytope::Polytope;
use crate::error::InputError;
use glam::DVec3;
use serde::{Deserialize, Serialize};

#[derive(Serialize, Deserialize)]
pub(super) enum StoredPieces {
    Triangles {
        corners: Vec<DVec3>,
        vertex_ids: Vec<u32>,
        face_ids: Vec<u32>,
    },
    Polytopes(Vec<Polytope>),
}

impl From<Pieces> for StoredPieces {
    fn from(pieces: Pieces) -> Self {
        match pieces.shape {
            PieceShapes::Triangles { face_ids } => StoredPieces::Triangles {
                corners: pieces.points,
                vertex_ids: pieces.vertex_ids,
                face_ids,
            },
            PieceShapes::Polytopes(_) => {
                StoredPieces::Polytopes((0..pieces.len()).map(|k| pieces.polytope(k)).collect())
            }
        }
    }
}

impl TryFrom<StoredPieces> for Pieces {
    type Error = InputError;

    fn try_from(stored: StoredPieces) -> Result<Self, InputError> {
        let (points, vertex_ids, face_ids) = match stored {
            StoredPieces::Polytopes(polytopes) => return Pieces::from_polytopes(&polytopes),
            StoredPieces::Triangles {
                corners,
                vertex_ids,
                face_ids,
            } => (corners, vertex_ids, face_ids),
        };
        let triangles = face_ids.len();
        // Each triangle has three corners, and every corner has a number.
        if points.len() % 3 != 0 || points.len() / 3 != triangles {
            return Err(InputError::FaceIdCountMismatch {
                faces: points.len() / 3,
                id_count: triangles,
            });
        }
        if vertex_ids.len() != points.len() {
            return Err(InputError::VertexOutOfRange {
                face: vertex_ids.len() / 3,
                vertex: vertex_ids.len() as u32,
                vertices: points.len(),
            });
        }
        Pieces::new_unvalidated(points, vertex_ids, PieceShapes::Triangles { face_ids })
            .into_validated()
    }
}
