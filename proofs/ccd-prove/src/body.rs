//! A mesh with the tree that its certificate describes.

use crate::stop::{Never, Stop, sort};
use crate::tree::Tree;
use ccd_core::glam::{DVec3, DVec4};
use sha2::{Digest, Sha256};
use std::cmp::Ordering;

/// A mesh of rounded triangles, with a tree of boxes around them, and both as bytes.
///
/// Around each vertex is a ball, and a triangle is the convex hull of the balls of its corners. If their radii are 0 it is flat.
#[derive(Clone, Debug)]
pub struct Body {
    pub(crate) tree: Tree,
    mesh: Vec<u8>,
    /// The SHA-256 digest of the mesh.
    pub(crate) digest: [u8; 32],
    certificate: Vec<u8>,
}

impl Body {
    /// Makes a body of a mesh. Its digest is that of the mesh as bytes: the numbers of vertices and triangles, the coordinates and
    /// radii, the numbers of the corners, all in little endian.
    ///
    /// # Panics
    /// If a triangle has a corner that is no vertex, or if there is no triangle.
    pub fn new(vertices: &[[f64; 3]], faces: &[[u32; 3]]) -> Self {
        let flat: Vec<[f64; 4]> = vertices.iter().map(|&[x, y, z]| [x, y, z, 0.0]).collect();
        Body::rounded(&flat, faces)
    }

    /// Makes a body of a mesh with balls around its vertices: each has its radius after its coordinates.
    ///
    /// # Panics
    /// As [`new`](Self::new).
    pub fn rounded(vertices: &[[f64; 4]], faces: &[[u32; 3]]) -> Self {
        let Ok(body) = Body::of_mesh(vertices, faces, Never);
        body
    }

    fn of_mesh<S: Stop>(
        vertices: &[[f64; 4]],
        faces: &[[u32; 3]],
        stop: S,
    ) -> Result<Self, S::Stopped> {
        let corner = |v: u32| DVec4::from_array(vertices[v as usize]);
        let triangles: Vec<[DVec4; 3]> = faces.iter().map(|face| face.map(corner)).collect();
        assert!(!triangles.is_empty(), "a body has triangles");
        let mesh = mesh_bytes(vertices, faces);
        let mut hasher = Sha256::new();
        for part in mesh.chunks(HASHED_AT_ONCE) {
            stop.check()?;
            hasher.update(part);
        }
        let digest: [u8; 32] = hasher.finalize().into();
        let (tree, written) = Tree::new(&triangles, stop)?;
        let mut certificate = b"CCDBODY1".to_vec();
        certificate.extend(digest);
        certificate.extend(written.iter().flat_map(|number| number.to_le_bytes()));
        Ok(Body {
            tree,
            mesh,
            digest,
            certificate,
        })
    }

    /// Makes a body of the triangles of one of the engine's; `None` if a piece of more than three points has none.
    ///
    /// A ball is a triangle whose corners are its centre, a capsule one that is its axis. Vertices and triangles are sorted, so that
    /// the bytes of the mesh do not depend on the tree that the engine has built.
    pub fn of(body: &ccd_core::Body) -> Option<Self> {
        let Ok(body) = Body::of_triangles(&triangles_of(body)?, Never);
        Some(body)
    }

    pub(crate) fn of_triangles<S: Stop>(
        triangles: &[[DVec4; 3]],
        stop: S,
    ) -> Result<Self, S::Stopped> {
        let (vertices, faces) = canonical(triangles, stop)?;
        Body::of_mesh(&vertices, &faces, stop)
    }

    /// Returns the mesh as the bytes whose digest a certificate states.
    pub fn mesh(&self) -> &[u8] {
        &self.mesh
    }

    /// Returns the SHA-256 digest of the mesh.
    pub fn digest(&self) -> [u8; 32] {
        self.digest
    }

    /// Returns the certificate of the body's tree.
    pub fn certificate(&self) -> &[u8] {
        &self.certificate
    }
}

/// The number of bytes that are hashed without a look at the flag that stops the work.
const HASHED_AT_ONCE: usize = 1 << 20;

/// Returns the triangles of one of the engine's bodies.
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
                let before = triangles.len();
                let corners = piece.mesh_triangles().map(|(_, corners)| corners);
                triangles.extend(corners.map(rounded));
                if triangles.len() == before {
                    return None;
                }
            }
        }
    }
    Some(triangles)
}

/// Vertices, and triangles by the numbers of their corners.
type Canonical = (Vec<[f64; 4]>, Vec<[u32; 3]>);

/// Returns the vertices of triangles in the order of their coordinates, and the triangles in the order of their corners, the
/// least of which comes first.
fn canonical<S: Stop>(triangles: &[[DVec4; 3]], stop: S) -> Result<Canonical, S::Stopped> {
    let compare = |a: &[f64; 4], b: &[f64; 4]| {
        let coordinates = a.iter().zip(b).map(|(a, b)| a.total_cmp(b));
        coordinates.fold(Ordering::Equal, Ordering::then)
    };
    let mut vertices: Vec<[f64; 4]> = triangles.iter().flatten().map(|v| v.to_array()).collect();
    sort(&mut vertices, compare, stop)?;
    vertices.dedup_by(|a, b| compare(a, b).is_eq());
    let number = |corner: DVec4| {
        let corner = corner.to_array();
        vertices.partition_point(|v| compare(v, &corner).is_lt()) as u32
    };
    let numbers = |corners: &[DVec4; 3]| stop.check().map(|()| corners.map(number));
    let faces = triangles.iter().map(numbers);
    let mut faces: Vec<[u32; 3]> = faces.collect::<Result<_, _>>()?;
    for face in &mut faces {
        let least = (0..3).min_by_key(|&k| face[k]).unwrap_or(0);
        face.rotate_left(least);
    }
    sort(&mut faces, Ord::cmp, stop)?;
    Ok((vertices, faces))
}

fn mesh_bytes(vertices: &[[f64; 4]], faces: &[[u32; 3]]) -> Vec<u8> {
    let mut bytes = Vec::new();
    bytes.extend((vertices.len() as u32).to_le_bytes());
    bytes.extend((faces.len() as u32).to_le_bytes());
    bytes.extend(vertices.iter().flatten().flat_map(|x| x.to_le_bytes()));
    bytes.extend(faces.iter().flatten().flat_map(|k| k.to_le_bytes()));
    bytes
}
