//! Meshes to draw, in single precision relative to their centers, each stored once.

use base64::Engine;
use base64::prelude::BASE64_STANDARD;
use ccd_core::glam::DVec3;
use serde::Serialize;

/// The triangles of a body, as a page draws them.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct DrawnMesh {
    /// The positions of the vertices, in the body's frame.
    pub vertices: Vec<DVec3>,
    /// Three vertex numbers for each face.
    pub faces: Vec<[u32; 3]>,
}

/// The meshes of a page; equal meshes are stored only once.
#[derive(Clone, Debug, Default, Serialize)]
pub struct Meshes(Vec<StoredMesh>);

/// A mesh as it is stored in the page: little-endian numbers in base64.
#[derive(Clone, Debug, PartialEq, Serialize)]
struct StoredMesh {
    /// The center of the mesh's bounding box, in the body's frame.
    middle: [f64; 3],
    /// Three `f32` coordinates per vertex, relative to `middle`.
    vertices: String,
    /// Three vertex numbers for each face, as little-endian `u32` in base64.
    faces: String,
}

impl Meshes {
    /// Adds a mesh, or finds an equal one, and returns its number.
    pub fn add(&mut self, mesh: &DrawnMesh) -> usize {
        let stored = StoredMesh::new(mesh);
        let equal_mesh = self.0.iter().position(|mesh| *mesh == stored);
        equal_mesh.unwrap_or_else(|| {
            self.0.push(stored);
            self.0.len() - 1
        })
    }

    /// Returns the center of the bounding box of a mesh, in the body's frame.
    pub fn middle(&self, number: usize) -> DVec3 {
        self.0
            .get(number)
            .map_or(DVec3::ZERO, |mesh| mesh.middle.into())
    }
}

impl StoredMesh {
    fn new(mesh: &DrawnMesh) -> Self {
        let mut vertices = mesh.vertices.iter();
        let first = vertices.next().copied().unwrap_or(DVec3::ZERO);
        let (low, high) =
            vertices.fold((first, first), |(low, high), v| (low.min(*v), high.max(*v)));
        // Halved first, to avoid overflow.
        let middle = 0.5 * low + 0.5 * high;
        let coordinates = (mesh.vertices.iter()).flat_map(|v| (v - middle).as_vec3().to_array());
        let coordinates: Vec<u8> = coordinates.flat_map(f32::to_le_bytes).collect();
        let corners = mesh.faces.iter().flatten();
        let corners: Vec<u8> = corners.flat_map(|corner| corner.to_le_bytes()).collect();
        StoredMesh {
            middle: middle.to_array(),
            vertices: BASE64_STANDARD.encode(coordinates),
            faces: BASE64_STANDARD.encode(corners),
        }
    }
}

#[cfg(test)]
mod tests;
