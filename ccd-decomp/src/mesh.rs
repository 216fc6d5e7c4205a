//! A mesh that is fit to be made a body of.

pub(crate) mod format;
mod outline;
pub(crate) mod repair;

use crate::error::{MeshError, MeshFault};
use crate::exact::predicates::is_without_area;
use crate::mesh::format::Format;
use crate::mesh::repair::{Repairs, collapsed_faces, duplicate_faces};
use ccd_core::glam::DVec3;
use ccd_core::tolerance::MAX_COORDINATE;
use std::collections::HashMap;
use std::fs;
use std::io::Read;
use std::path::Path;

/// Triangles over finite vertices, each with the number of the file's face it is part of.
///
/// # Guarantee
/// The triangles cover every planar polygon of the file and every point of its degenerate faces. At
/// least one triangle; every index names a vertex.
///
/// ```
/// use ccd_decomp::{Format, TriangleMesh};
/// let square = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n";
/// let mesh = TriangleMesh::from_reader(Format::Obj, square.as_bytes()).unwrap();
/// assert_eq!(mesh.faces(), [[0, 1, 2], [0, 2, 3]]);
/// assert_eq!(mesh.face_ids(), [0, 0]);
/// assert_eq!(mesh.repairs().polygons.count(), 1);
/// ```
#[derive(Clone, Debug)]
pub struct TriangleMesh {
    vertices: Vec<DVec3>,
    faces: Vec<[u32; 3]>,
    face_ids: Vec<u32>,
    positions: Vec<u32>,
    repairs: Repairs,
}

/// What a reader found in a file, as it stands there.
#[derive(Debug, Default)]
pub(crate) struct Polygons {
    pub(crate) vertices: Vec<DVec3>,
    /// The vertices of all faces, numbered from 0, perhaps out of range.
    pub(crate) corners: Vec<i64>,
    /// Where the corners of each face end.
    pub(crate) ends: Vec<usize>,
    /// The lines of the vertices and of the faces, from 1; empty where the format has none.
    pub(crate) vertex_lines: Vec<usize>,
    pub(crate) face_lines: Vec<usize>,
}

impl TriangleMesh {
    /// Reads a mesh from a file, in the format that its extension tells.
    ///
    /// # Errors
    /// [`MeshError`], naming the file and the element; never panics, whatever the bytes.
    pub fn read(path: impl AsRef<Path>) -> Result<Self, MeshError> {
        let path = path.as_ref();
        let read = || {
            if path.is_dir() {
                return Err(MeshFault::Folder);
            }
            let format = Format::from_path(path)?;
            let bytes = fs::read(path).map_err(MeshFault::Unreadable)?;
            TriangleMesh::from_polygons(format.parse(&bytes)?)
        };
        read().map_err(|fault| fault.in_file(path))
    }

    /// Reads a mesh in a given format.
    ///
    /// # Errors
    /// As [`TriangleMesh::read`].
    pub fn from_reader(format: Format, mut reader: impl Read) -> Result<Self, MeshError> {
        let mut bytes = Vec::new();
        reader
            .read_to_end(&mut bytes)
            .map_err(MeshFault::Unreadable)?;
        Ok(TriangleMesh::from_polygons(format.parse(&bytes)?)?)
    }

    /// Takes the triangles of a mesh made by code.
    ///
    /// # Errors
    /// [`MeshFault::NotFinite`], [`MeshFault::TooLarge`], [`MeshFault::NoSuchVertex`],
    /// [`MeshFault::NoVertices`], [`MeshFault::NoFaces`], [`MeshFault::TooMany`].
    pub fn new(vertices: Vec<DVec3>, faces: &[[u32; 3]]) -> Result<Self, MeshError> {
        Ok(TriangleMesh::from_polygons(Polygons {
            vertices,
            corners: faces.iter().flatten().map(|&v| i64::from(v)).collect(),
            ends: (1..=faces.len()).map(|k| 3 * k).collect(),
            ..Polygons::default()
        })?)
    }

    fn from_polygons(polygons: Polygons) -> Result<Self, MeshFault> {
        polygons.check()?;
        let positions = weld(&polygons.vertices);
        let mut repairs = Repairs::default();
        let (all_faces, all_ids) = polygons.triangulate(&mut repairs);
        let drop_duplicate = duplicate_faces(&all_faces, &positions);
        let drop_collapsed = collapsed_faces(&all_faces, &positions);
        let (mut faces, mut face_ids) = (Vec::new(), Vec::new());
        faces.reserve_exact(all_faces.len());
        face_ids.reserve_exact(all_faces.len());
        for (k, (face, id)) in all_faces.into_iter().zip(all_ids).enumerate() {
            if drop_duplicate[k] {
                repairs.duplicates.add(id);
            } else if drop_collapsed[k] {
                repairs.collapsed.add(id);
            } else {
                let [a, b, c] = face.map(|v| polygons.vertices[v as usize]);
                if is_without_area([a, b, c]) {
                    repairs.zero_area.add(id);
                }
                faces.push(face);
                face_ids.push(id);
            }
        }
        repairs.note_unreferenced(polygons.vertices.len(), &polygons.corners);
        Ok(TriangleMesh {
            vertices: polygons.vertices,
            faces,
            face_ids,
            positions,
            repairs,
        })
    }

    /// The file's vertices in its own order, unreferenced ones too.
    pub fn vertices(&self) -> &[DVec3] {
        &self.vertices
    }

    /// The triangles, as indices into the vertices.
    pub fn faces(&self) -> &[[u32; 3]] {
        &self.faces
    }

    /// The file's number of the face that each triangle is part of.
    pub fn face_ids(&self) -> &[u32] {
        &self.face_ids
    }

    /// The same mesh with some faces turned round.
    pub(crate) fn turned(&self, faces: &[u32]) -> Self {
        let mut mesh = self.clone();
        for &face in faces {
            mesh.faces[face as usize].swap(1, 2);
        }
        mesh
    }

    /// What was found amiss, and what became of it.
    pub fn repairs(&self) -> &Repairs {
        &self.repairs
    }

    /// The faces by the first vertex that lies where a corner does.
    pub(crate) fn welded_faces(&self) -> Vec<[u32; 3]> {
        let welded = |face: &[u32; 3]| face.map(|v| self.positions[v as usize]);
        self.faces.iter().map(welded).collect()
    }

    /// For every vertex the first one that lies at exactly the same point.
    pub(crate) fn positions(&self) -> &[u32] {
        &self.positions
    }
}

impl Polygons {
    fn check(&self) -> Result<(), MeshFault> {
        let (vertices, faces) = (self.vertices.len(), self.ends.len());
        let line = |lines: &[usize], k: usize| lines.get(k).copied();
        if vertices == 0 {
            return Err(MeshFault::NoVertices);
        }
        if faces == 0 {
            return Err(MeshFault::NoFaces);
        }
        let limits = [("vertices", vertices), ("corners", self.corners.len())];
        for (what, count) in limits {
            // A fan makes less than one triangle per corner; pieces name corners by u32.
            if count >= u32::MAX as usize / 12 {
                return Err(MeshFault::TooMany { what, count });
            }
        }
        // Written so that NaN fails.
        if let Some(vertex) = self
            .vertices
            .iter()
            .position(|p| !(p.abs().max_element() <= MAX_COORDINATE && p.is_finite()))
        {
            let line = line(&self.vertex_lines, vertex);
            return Err(match self.vertices[vertex].is_finite() {
                true => MeshFault::TooLarge { vertex, line },
                false => MeshFault::NotFinite { vertex, line },
            });
        }
        for (face, corners) in self.faces().enumerate() {
            let line = line(&self.face_lines, face);
            if corners.len() < 3 {
                let corners = corners.len();
                return Err(MeshFault::TooFewCorners {
                    face,
                    line,
                    corners,
                });
            }
            if let Some(&vertex) = corners.iter().find(|&&v| v < 0 || v >= vertices as i64) {
                return Err(MeshFault::NoSuchVertex {
                    face,
                    line,
                    vertex,
                    vertices,
                    base: 0,
                });
            }
        }
        Ok(())
    }

    fn faces(&self) -> impl Iterator<Item = &[i64]> {
        let mut start = 0;
        self.ends.iter().map(move |&end| {
            let corners = &self.corners[start..end];
            start = end;
            corners
        })
    }

    /// Cuts every polygon into the fan about its first corner, or, where that has a triangle without area or
    /// one that lies beyond the polygon, into others within it.
    ///
    /// The signed areas of the fan add up to the polygon's, so that the fan covers a planar polygon
    /// whether or not it is convex; of one that is not it covers more, which is reported where the polygon
    /// cannot be filled either, as it meets itself.
    fn triangulate(&self, repairs: &mut Repairs) -> (Vec<[u32; 3]>, Vec<u32>) {
        let (mut faces, mut ids) = (Vec::new(), Vec::new());
        faces.reserve_exact(self.corners.len() - 2 * self.ends.len());
        ids.reserve_exact(faces.capacity());
        for (face, corners) in self.faces().enumerate() {
            let id = face as u32;
            let start = faces.len();
            for pair in corners[1..].windows(2) {
                faces.push([corners[0], pair[0], pair[1]].map(|v| v as u32));
                ids.push(id);
            }
            if corners.len() > 3 {
                repairs.polygons.add(id);
                let fan = &mut faces[start..];
                let overhangs = overhangs(&self.vertices, fan);
                if !(overhangs || has_flat(&self.vertices, fan)) {
                    continue;
                }
                let points: Vec<DVec3> =
                    corners.iter().map(|&v| self.vertices[v as usize]).collect();
                match outline::fill(&points) {
                    Some(filled) => {
                        for (face, triangle) in fan.iter_mut().zip(filled) {
                            *face = triangle.map(|k| corners[k] as u32);
                        }
                    }
                    None if overhangs => repairs.overhanging.add(id),
                    None => {}
                }
            }
        }
        (faces, ids)
    }
}

/// Whether some triangle of a fan has no area.
fn has_flat(vertices: &[DVec3], fan: &[[u32; 3]]) -> bool {
    fan.iter()
        .any(|face| is_without_area(face.map(|v| vertices[v as usize])))
}

/// Whether some triangle of a fan looks away from where the fan as a whole looks.
fn overhangs(vertices: &[DVec3], fan: &[[u32; 3]]) -> bool {
    let normal = |face: &[u32; 3]| {
        let [a, b, c] = face.map(|v| vertices[v as usize]);
        (b - a).cross(c - a)
    };
    let whole: DVec3 = fan.iter().map(normal).sum();
    fan.iter().any(|face| normal(face).dot(whole) < 0.0)
}

/// For every vertex the first one at exactly the same point; 0 and −0 are the same.
fn weld(vertices: &[DVec3]) -> Vec<u32> {
    let mut first = HashMap::with_capacity(vertices.len());
    let number = |(vertex, point): (usize, &DVec3)| {
        let key = point.to_array().map(|x| (x + 0.0).to_bits());
        *first.entry(key).or_insert(vertex as u32)
    };
    vertices.iter().enumerate().map(number).collect()
}

#[cfg(test)]
mod tests;
