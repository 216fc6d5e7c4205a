//! Triangle meshes that are read from files or memory, checked and repaired.

pub(crate) mod adjustments;
pub(crate) mod affine;
mod combine;
#[cfg_attr(
    not(any(feature = "collada", feature = "gltf")),
    allow(dead_code, reason = "only scenes of these formats are placed")
)]
mod content;
pub(crate) mod error;
pub(crate) mod format;
pub(crate) mod mesh_file;
mod outline;
mod polygons;
pub(crate) mod remark;
pub(crate) mod repair;
pub(crate) mod unit;

use crate::exact::predicates::has_zero_area;
use ccd_core::glam::DVec3;
use ccd_core::vector::position_bits;
use error::{MeshError, MeshFault};
use format::Format;
use mesh_file::MeshFile;
use polygons::Polygons;
use rayon::prelude::*;
use repair::{Repairs, covered_collapsed_face_flags, duplicate_face_flags};
use std::io::Read;
use std::path::Path;

/// A triangle mesh with finite vertices, which has been checked and repaired. Each triangle has the number of its face
/// in the file.
///
/// # Guarantee
/// The triangles cover every planar polygon of the file and every point of its degenerate faces. There is at
/// least one triangle. Every index names a vertex.
///
/// ```
/// use ccd_decomp::{Format, TriangleMesh};
/// let square = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n";
/// let mesh = TriangleMesh::from_reader(Format::Obj, square.as_bytes()).unwrap();
/// assert_eq!(mesh.faces(), [[0, 1, 2], [0, 2, 3]]);
/// assert_eq!(mesh.face_ids(), [0, 0]);
/// assert_eq!(mesh.repairs().triangulated_polygons.count(), 1);
/// ```
#[derive(Clone, Debug)]
pub struct TriangleMesh {
    vertices: Vec<DVec3>,
    faces: Vec<[u32; 3]>,
    face_ids: Vec<u32>,
    /// For each vertex, the index of the first vertex with exactly the same coordinates.
    welded_index_by_vertex: Vec<u32>,
    /// The number of faces in the file, including those that were dropped.
    file_face_count: u32,
    repairs: Repairs,
}

impl TriangleMesh {
    /// Reads a mesh file in the format that its extension names, with all its parts as one mesh. [`MeshFile`] reads one
    /// part, or each of them, and converts units.
    ///
    /// # Errors
    /// [`MeshError`], which names the file and the element. No bytes panic.
    pub fn read(path: impl AsRef<Path>) -> Result<Self, MeshError> {
        MeshFile::read(path)?.into_mesh()
    }

    /// Reads a mesh in a given format from any reader.
    ///
    /// # Errors
    /// [`MeshError`], which names the element. No bytes panic.
    pub fn from_reader(format: Format, reader: impl Read) -> Result<Self, MeshError> {
        MeshFile::from_reader(format, reader)?.into_mesh()
    }

    /// Creates a mesh from vertices and triangles in memory.
    ///
    /// ```
    /// use ccd_decomp::{PieceChoice, TriangleMesh, body_from_mesh};
    /// let vertices = vec![[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    /// let mesh = TriangleMesh::new(vertices, &[[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]])?;
    /// let body = body_from_mesh(&mesh, PieceChoice::Auto)?.body;
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// [`MeshFault::NotFinite`], [`MeshFault::CoordinateTooLarge`], [`MeshFault::NoSuchVertex`],
    /// [`MeshFault::NoVertices`], [`MeshFault::NoFaces`], [`MeshFault::TooManyElements`].
    pub fn new(vertices: Vec<impl Into<[f64; 3]>>, faces: &[[u32; 3]]) -> Result<Self, MeshError> {
        let vertices = vertices.into_iter().map(|point| DVec3::from(point.into()));
        Ok(TriangleMesh::from_polygons(Polygons {
            vertices: vertices.collect(),
            corners: faces.iter().flatten().map(|&v| i64::from(v)).collect(),
            corner_ends: (1..=faces.len()).map(|k| 3 * k).collect(),
            ..Polygons::default()
        })?)
    }

    fn from_polygons(mut polygons: Polygons) -> Result<Self, MeshFault> {
        polygons.check()?;
        let mut repairs = Repairs {
            remarks: std::mem::take(&mut polygons.remarks),
            ..Repairs::default()
        };
        let triangles = polygons.triangulate(&mut repairs);
        repairs.note_unreferenced_vertices(polygons.vertices.len(), &polygons.corners);
        let face_count = polygons.corner_ends.len() as u32;
        let vertices = std::mem::take(&mut polygons.vertices);
        // Freed early: it may be larger than the mesh.
        drop(polygons);
        Ok(TriangleMesh::from_triangles(
            vertices, triangles, face_count, repairs,
        ))
    }

    /// Creates a mesh from triangles with valid indices, each with the number of its face in the file. Drops duplicate
    /// and collapsed triangles.
    fn from_triangles(
        vertices: Vec<DVec3>,
        (all_faces, all_ids): (Vec<[u32; 3]>, Vec<u32>),
        face_count: u32,
        mut repairs: Repairs,
    ) -> Self {
        let positions = weld_index_by_vertex(&vertices);
        let drop_duplicate = duplicate_face_flags(&all_faces, &positions);
        let drop_collapsed = covered_collapsed_face_flags(&all_faces, &positions);
        let is_flat = |face: &[u32; 3]| has_zero_area(face.map(|v| vertices[v as usize]));
        let is_flat: Vec<bool> = all_faces.par_iter().map(is_flat).collect();
        let mut faces = Vec::with_capacity(all_faces.len());
        let mut face_ids = Vec::with_capacity(all_faces.len());
        for (k, (face, id)) in all_faces.into_iter().zip(all_ids).enumerate() {
            if drop_duplicate[k] {
                repairs.duplicate_faces.add(id);
            } else if drop_collapsed[k] {
                repairs.collapsed_faces.add(id);
            } else {
                if is_flat[k] {
                    repairs.zero_area_faces.add(id);
                }
                faces.push(face);
                face_ids.push(id);
            }
        }
        TriangleMesh {
            vertices,
            faces,
            face_ids,
            welded_index_by_vertex: positions,
            file_face_count: face_count,
            repairs,
        }
    }

    /// Returns the vertices in the file's order, including those that no face uses.
    pub fn vertices(&self) -> &[DVec3] {
        &self.vertices
    }

    /// Returns the triangles, each as three indices into the vertices.
    pub fn faces(&self) -> &[[u32; 3]] {
        &self.faces
    }

    /// Returns, for each triangle, the number of its face in the file.
    pub fn face_ids(&self) -> &[u32] {
        &self.face_ids
    }

    /// Returns a copy of the mesh in which the given triangles have the reverse orientation.
    pub(crate) fn with_reversed_faces(&self, faces: &[u32]) -> Self {
        let mut mesh = self.clone();
        for &face in faces {
            mesh.faces[face as usize].swap(1, 2);
        }
        mesh
    }

    /// Returns the faults of the mesh that were found and repaired.
    pub fn repairs(&self) -> &Repairs {
        &self.repairs
    }

    /// Returns the corner points of a triangle.
    pub(crate) fn triangle(&self, face: u32) -> [DVec3; 3] {
        self.faces[face as usize].map(|v| self.vertices[v as usize])
    }

    /// Returns a triangle's corners after welding: each corner is the index of the first vertex at exactly the same
    /// point.
    pub(crate) fn welded_face(&self, face: u32) -> [u32; 3] {
        self.faces[face as usize].map(|v| self.welded_index_by_vertex[v as usize])
    }

    /// Returns the [welded](TriangleMesh::welded_face) corners of all triangles.
    pub(crate) fn welded_faces(&self) -> Vec<[u32; 3]> {
        let faces = 0..self.faces.len() as u32;
        faces.map(|face| self.welded_face(face)).collect()
    }
}

/// Returns, for each vertex, the index of the first vertex at exactly the same point; 0 and −0 are equal.
fn weld_index_by_vertex(vertices: &[DVec3]) -> Vec<u32> {
    let with_position = |(vertex, &point): (usize, &DVec3)| (position_bits(point), vertex as u32);
    let vertices = vertices.par_iter().enumerate();
    let mut by_position: Vec<([u64; 3], u32)> = vertices.map(with_position).collect();
    by_position.par_sort_unstable();
    let mut first = vec![0; by_position.len()];
    for at_one_point in by_position.chunk_by(|one, next| one.0 == next.0) {
        for &(_, vertex) in at_one_point {
            first[vertex as usize] = at_one_point[0].1;
        }
    }
    first
}

#[cfg(test)]
mod tests;
