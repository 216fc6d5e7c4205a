//! Makes the mesh of a box with two triangles per side.

use ccd_core::glam::DVec3;
use ccd_decomp::{MeshError, TriangleMesh};

/// The triangles of a box, two per side, in the order −x, +x, −y, +y, −z, +z. Corner `k` has a positive x, y, z if bit
/// 2, 1, 0 of `k` is set.
const BOX_TRIANGLES: [[u32; 3]; 12] = [
    [0, 1, 3],
    [0, 3, 2],
    [4, 6, 7],
    [4, 7, 5],
    [0, 4, 5],
    [0, 5, 1],
    [2, 3, 7],
    [2, 7, 6],
    [0, 2, 6],
    [0, 6, 4],
    [1, 5, 7],
    [1, 7, 3],
];

/// Returns a box about the origin, given by its half extents.
///
/// # Errors
/// If an extent is not finite or too large.
pub fn cuboid(x: f64, y: f64, z: f64) -> Result<TriangleMesh, MeshError> {
    let sign = |corner: u32, bit: u32| if corner >> bit & 1 == 1 { 1.0 } else { -1.0 };
    let corner = |k| DVec3::new(x * sign(k, 2), y * sign(k, 1), z * sign(k, 0));
    TriangleMesh::new((0..8).map(corner).collect(), &BOX_TRIANGLES)
}
