//! A mesh with its bounding box tree, and the certificate of the tree.

use crate::stop::{Never, Stop, sort};
use crate::tree::Tree;
use ccd_core::glam::{DVec3, DVec4};
use sha2::{Digest, Sha256};
use std::cmp::Ordering;

/// A mesh of rounded triangles with a bounding box tree, and the bytes of both.
///
/// Each vertex is the center of a ball. A rounded triangle is the convex hull of the balls at its corners. It is flat if the radii of
/// the balls are 0.
#[derive(Clone, Debug)]
pub struct Body {
    pub(crate) tree: Tree,
    mesh: Vec<u8>,
    /// The SHA-256 digest of the bytes of the mesh.
    pub(crate) digest: [u8; 32],
    certificate: Vec<u8>,
}

impl Body {
    /// Creates a body from a mesh of flat triangles.
    ///
    /// # Panics
    /// Panics if the index of a corner is out of range, or if there is no triangle.
    pub fn new(vertices: &[[f64; 3]], faces: &[[u32; 3]]) -> Self {
        let flat: Vec<[f64; 4]> = vertices.iter().map(|&[x, y, z]| [x, y, z, 0.0]).collect();
        Body::rounded(&flat, faces)
    }

    /// Creates a body from a mesh of rounded triangles. A vertex is given as x, y, z and the radius of its ball.
    ///
    /// # Panics
    /// Like [`new`](Self::new).
    pub fn rounded(vertices: &[[f64; 4]], faces: &[[u32; 3]]) -> Self {
        let Ok(body) = Body::build(vertices, faces, Never);
        body
    }

    fn build<S: Stop>(
        vertices: &[[f64; 4]],
        faces: &[[u32; 3]],
        stop: S,
    ) -> Result<Self, S::Stopped> {
        let corner = |v: u32| DVec4::from_array(vertices[v as usize]);
        let triangles: Vec<[DVec4; 3]> = faces.iter().map(|face| face.map(corner)).collect();
        assert!(!triangles.is_empty(), "a body has triangles");
        let mesh = mesh_bytes(vertices, faces);
        let mut hasher = Sha256::new();
        for chunk in mesh.chunks(HASH_CHUNK) {
            stop.check()?;
            hasher.update(chunk);
        }
        let digest: [u8; 32] = hasher.finalize().into();
        let (tree, numbers) = Tree::new(&triangles, stop)?;
        let mut certificate = b"CCDBODY1".to_vec();
        certificate.extend(digest);
        certificate.extend(numbers.iter().flat_map(|number| number.to_le_bytes()));
        Ok(Body {
            tree,
            mesh,
            digest,
            certificate,
        })
    }

    /// Converts a body of the engine. Returns `None` if a piece with more than three points has no mesh triangles.
    ///
    /// A ball becomes a triangle whose three corners are the center. A capsule becomes a triangle along its axis. Vertices and
    /// triangles are sorted, so the bytes of the mesh do not depend on the engine's tree.
    pub fn of(body: &ccd_core::Body) -> Option<Self> {
        let Ok(body) = Body::of_triangles(&triangles_of(body)?, Never);
        Some(body)
    }

    /// Creates a body from triangles. A corner is given as x, y, z and a radius.
    pub(crate) fn of_triangles<S: Stop>(
        triangles: &[[DVec4; 3]],
        stop: S,
    ) -> Result<Self, S::Stopped> {
        let (vertices, faces) = sorted_mesh(triangles, stop)?;
        Body::build(&vertices, &faces, stop)
    }

    /// Returns the bytes of the mesh. A certificate identifies a mesh by the SHA-256 digest of these bytes.
    pub fn mesh(&self) -> &[u8] {
        &self.mesh
    }

    /// Returns the SHA-256 digest of the bytes of the mesh.
    pub fn digest(&self) -> [u8; 32] {
        self.digest
    }

    /// Returns the certificate of the tree.
    pub fn certificate(&self) -> &[u8] {
        &self.certificate
    }
}

/// The number of bytes to hash between two checks of the stop condition.
const HASH_CHUNK: usize = 1 << 20;

/// Returns the triangles of a body of the engine. Returns `None` if a piece with more than three points has no mesh triangles.
pub(crate) fn triangles_of(body: &ccd_core::Body) -> Option<Vec<[DVec4; 3]>> {
    let mut triangles: Vec<[DVec4; 3]> = Vec::new();
    for piece in body.pieces().iter() {
        let rounded = |corners: [DVec3; 3]| corners.map(|corner| corner.extend(piece.radius));
        match piece.points {
            [point] => triangles.push(rounded([*point; 3])),
            [from, to] => triangles.push(rounded([*from, *to, *to])),
            [a, b, c] if piece.mesh_triangles().next().is_none() => {
                triangles.push(rounded([*a, *b, *c]));
            }
            _ => {
                let count = triangles.len();
                let corners = piece.mesh_triangles().map(|(_, corners)| corners);
                triangles.extend(corners.map(rounded));
                if triangles.len() == count {
                    return None;
                }
            }
        }
    }
    Some(triangles)
}

/// The vertices of a mesh, and the indices of the corners of its triangles.
type IndexedMesh = (Vec<[f64; 4]>, Vec<[u32; 3]>);

/// Returns the distinct vertices of triangles, sorted by their coordinates, and the sorted triangles. Each triangle starts with its
/// corner of least index.
fn sorted_mesh<S: Stop>(triangles: &[[DVec4; 3]], stop: S) -> Result<IndexedMesh, S::Stopped> {
    let compare = |a: &[f64; 4], b: &[f64; 4]| {
        let coordinates = a.iter().zip(b).map(|(a, b)| a.total_cmp(b));
        coordinates.fold(Ordering::Equal, Ordering::then)
    };
    let mut vertices: Vec<[f64; 4]> = triangles.iter().flatten().map(|v| v.to_array()).collect();
    sort(&mut vertices, compare, stop)?;
    vertices.dedup_by(|a, b| compare(a, b).is_eq());
    let index = |corner: DVec4| {
        let corner = corner.to_array();
        vertices.partition_point(|v| compare(v, &corner).is_lt()) as u32
    };
    let indices = |corners: &[DVec4; 3]| stop.check().map(|()| corners.map(index));
    let faces = triangles.iter().map(indices);
    let mut faces: Vec<[u32; 3]> = faces.collect::<Result<_, _>>()?;
    for face in &mut faces {
        let least = (0..3).min_by_key(|&k| face[k]).unwrap_or(0);
        face.rotate_left(least);
    }
    sort(&mut faces, Ord::cmp, stop)?;
    Ok((vertices, faces))
}

/// Returns the bytes of a mesh: the counts of vertices and triangles, the vertices, and the indices of the corners.
fn mesh_bytes(vertices: &[[f64; 4]], faces: &[[u32; 3]]) -> Vec<u8> {
    let mut bytes = Vec::new();
    bytes.extend((vertices.len() as u32).to_le_bytes());
    bytes.extend((faces.len() as u32).to_le_bytes());
    bytes.extend(vertices.iter().flatten().flat_map(|x| x.to_le_bytes()));
    bytes.extend(faces.iter().flatten().flat_map(|k| k.to_le_bytes()));
    bytes
}
