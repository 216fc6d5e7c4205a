//! Makes polytopes whose facets carry the numbers of the mesh faces that lie in them.

use crate::solid::manifold::Manifold;
use ccd_core::{Facet, FacetOrigin, MeshFace, Polytope};

/// A facet of a polytope, and the faces of the mesh that lie in it.
pub(super) struct FacetWithFaces {
    /// The vertex numbers of the corners, counter-clockwise seen from outside.
    pub(super) corners: Vec<u32>,
    pub(super) mesh_faces: Vec<u32>,
    /// Whether the faces of the mesh cover the whole facet.
    pub(super) is_facet_covered_by_mesh: bool,
}

/// Creates a polytope from its facets and the mesh faces that lie in them. Its points are the mesh vertices at the
/// corners.
pub(super) fn polytope(manifold: &Manifold<'_>, facets: &[FacetWithFaces]) -> Polytope {
    let mut vertices: Vec<u32> = facets.iter().flat_map(|f| &f.corners).copied().collect();
    vertices.sort_unstable();
    vertices.dedup();
    let id = |face: u32| manifold.mesh().face_ids()[face as usize];
    let mut polytope = Polytope::default();
    for facet in facets {
        let origin = match (&facet.mesh_faces[..], facet.is_facet_covered_by_mesh) {
            ([], _) | (_, false) => FacetOrigin::Virtual,
            (&[face], true) => FacetOrigin::Face(id(face)),
            (_, true) => FacetOrigin::Faces,
        };
        if !matches!(origin, FacetOrigin::Face(_)) {
            polytope
                .faces
                .extend(facet.mesh_faces.iter().map(|&face| MeshFace {
                    id: id(face),
                    vertices: manifold.faces()[face as usize],
                    corners: manifold.triangle(face),
                }));
        }
        let local = |v: &u32| vertices.partition_point(|w| w < v) as u32;
        polytope.facets.push(Facet {
            origin,
            corners: facet.corners.iter().map(local).collect(),
        });
    }
    polytope.points = vertices.iter().map(|&v| manifold.point(v)).collect();
    polytope.vertex_ids = vertices;
    polytope
}
