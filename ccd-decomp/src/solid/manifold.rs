//! The half-edge structure of a closed surface.

use super::error::DecomposeError;
use super::topology::TopologyDefects;
use crate::exact::predicates::{
    Projection, first_underflow_prone_point_index, is_degenerate, side_of_plane,
};
use crate::half_edges::{HalfEdge, twins};
use crate::mesh::TriangleMesh;
use crate::search::TriangleBoxes;
use crate::tally::CountWithExamples;
use ccd_core::glam::DVec3;
use rayon::prelude::*;
use std::cmp::Ordering;
use std::sync::OnceLock;

/// A closed 2-manifold of triangles: every half-edge has exactly one twin.
///
/// # Invariants
/// Equal points are one vertex. No triangle is degenerate. Coordinates are in the range of exact predicates. If the
/// manifold [bounds a solid](super::solid_surface), two triangles meet only in shared vertices and edges, and the
/// solid is behind every triangle, against its normal.
pub(crate) struct Manifold<'m> {
    mesh: &'m TriangleMesh,
    faces: Vec<[u32; 3]>,
    /// For each half-edge, its twin: the half-edge on the same edge in the opposite direction.
    twins: Vec<HalfEdge>,
    /// The search trees over the faces, created on demand.
    boxes: OnceLock<TriangleBoxes>,
}

/// The kind of dihedral angle at an edge.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Dihedral {
    /// The interior angle is less than half a turn.
    Convex,
    /// The faces lie in one plane, on opposite sides of the edge.
    Coplanar,
    /// The interior angle is more than half a turn.
    Reflex,
    /// The faces lie in one plane and on one side of the edge, back to back. A solid has no such edge.
    Folded,
}

impl<'m> Manifold<'m> {
    /// Creates the manifold of a mesh after a check of its edges and areas. Triangles may intersect, and parts may be
    /// inside out. It takes a tenth of the time of [`solid_surface`](super::solid_surface).
    pub(crate) fn without_intersection_check(
        mesh: &'m TriangleMesh,
        topology: &TopologyDefects,
    ) -> Result<Self, DecomposeError> {
        if let Some(vertex) = first_underflow_prone_point_index(mesh.vertices()) {
            return Err(DecomposeError::CoordinateNearZero { vertex });
        }
        if !topology.is_manifold() {
            return Err(DecomposeError::NotManifold {
                topology: Box::new(topology.clone()),
            });
        }
        let mut faces = mesh.welded_faces();
        if topology.is_inside_out() {
            faces.iter_mut().for_each(|face| face.swap(1, 2));
        }
        let is_flat = |&face: &u32| is_degenerate(mesh.triangle(face));
        let flat_faces = (0..faces.len() as u32).into_par_iter().filter(is_flat);
        let mut flat = CountWithExamples::default();
        for face in flat_faces.collect::<Vec<u32>>() {
            flat.add(mesh.face_ids()[face as usize]);
        }
        match twins(&faces) {
            Some(twins) if flat.is_empty() => Ok(Manifold {
                mesh,
                faces,
                twins,
                boxes: OnceLock::new(),
            }),
            _ => Err(DecomposeError::ZeroAreaFaces { faces: flat }),
        }
    }

    /// Returns the mesh from which the manifold was made.
    pub(crate) fn mesh(&self) -> &'m TriangleMesh {
        self.mesh
    }

    /// Returns the vertex numbers of all faces, counter-clockwise seen from outside.
    pub(crate) fn faces(&self) -> &[[u32; 3]] {
        &self.faces
    }

    /// Returns the coordinates of a vertex.
    #[inline]
    pub(crate) fn point(&self, vertex: u32) -> DVec3 {
        self.mesh.vertices()[vertex as usize]
    }

    /// Returns the corner points of a face.
    #[inline]
    pub(crate) fn triangle(&self, face: u32) -> [DVec3; 3] {
        let [a, b, c] = self.faces[face as usize];
        [self.point(a), self.point(b), self.point(c)]
    }

    /// Returns the search trees over the faces, which the first call builds.
    pub(crate) fn boxes(&self) -> &TriangleBoxes {
        self.boxes
            .get_or_init(|| TriangleBoxes::new(self.mesh.vertices(), &self.faces))
    }

    /// Returns the twin of a half-edge: the half-edge on the same edge in the opposite direction.
    #[inline]
    pub(crate) fn twin(&self, half_edge: HalfEdge) -> HalfEdge {
        self.twins[half_edge as usize]
    }

    /// Returns the start and end vertex of a half-edge.
    pub(crate) fn ends(&self, half_edge: HalfEdge) -> [u32; 2] {
        let face = self.faces[half_edge as usize / 3];
        let k = half_edge as usize % 3;
        [face[k], face[(k + 1) % 3]]
    }

    /// Classifies the dihedral angle at an edge, exactly.
    pub(crate) fn classify_dihedral(&self, half_edge: HalfEdge) -> Dihedral {
        let twin = self.twin(half_edge);
        let far = self.faces[twin as usize / 3][(twin as usize % 3 + 2) % 3];
        let (triangle, far) = (self.triangle(half_edge / 3), self.point(far));
        match side_of_plane(triangle, far) {
            Ordering::Less => Dihedral::Convex,
            Ordering::Greater => Dihedral::Reflex,
            Ordering::Equal => {
                let [start, end] = self.ends(half_edge).map(|v| self.point(v));
                let beyond = |plane: Projection| plane.turn(start, end, far) == Ordering::Less;
                if Projection::new(triangle).is_some_and(beyond) {
                    Dihedral::Coplanar
                } else {
                    Dihedral::Folded
                }
            }
        }
    }
}

#[cfg(test)]
mod tests;
