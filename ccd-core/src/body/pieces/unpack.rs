//! Converts pieces back to polytopes.

use super::{PieceShapes, Pieces};
use crate::body::polytope::{Facet, MeshFace, Polytope};

impl Pieces {
    /// Converts a piece to a polytope, which is an input of [`Pieces::from_polytopes`]; a triangle lists its mesh face.
    ///
    /// # Panics
    /// When `index` is not below [`Pieces::len`].
    pub fn polytope(&self, index: usize) -> Polytope {
        let piece = self.get(index);
        let facets = piece.facets.iter().zip(piece.facets.origins_in_mesh());
        let facet = |(corners, &origin): (&[u32], _)| Facet {
            origin,
            corners: corners.to_vec(),
        };
        Polytope {
            points: piece.points.to_vec(),
            vertex_ids: self.vertex_ids(index).to_vec(),
            facets: facets.map(facet).collect(),
            faces: match &self.shape {
                PieceShapes::Polytopes(_) => piece.facets.mesh_faces.to_vec(),
                PieceShapes::Triangles { face_ids } => vec![MeshFace {
                    id: face_ids[index],
                    vertices: [0, 1, 2].map(|k| self.vertex_ids(index)[k]),
                    corners: self.triangle(index),
                }],
            },
            radius: piece.radius,
        }
    }

    /// Returns the mesh's vertex number of each point, for the points of all pieces.
    pub(crate) fn all_vertex_ids(&self) -> &[u32] {
        &self.vertex_ids
    }

    /// Returns the mesh's vertex number of each point of a piece.
    pub(crate) fn vertex_ids(&self, index: usize) -> &[u32] {
        &self.vertex_ids[self.point_range(index)]
    }
}
