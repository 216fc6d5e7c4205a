//! Makes a board: two triangles per side, the coarsest closed mesh of a box.

use ccd_core::glam::DVec3;
use ccd_decomp::{MeshError, TriangleMesh};

/// A box about the origin, as 12 triangles.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Board {
    /// Half the length of the box along each axis.
    pub half_extents: DVec3,
}

/// Corner `k` has a positive x, y, z if bit 2, 1, 0 of `k` is set; two triangles per side, for −x,
/// +x, −y, +y, −z, +z.
const FACES: [[u32; 3]; 12] = [
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

impl Board {
    /// Returns the closed mesh of the board.
    ///
    /// # Errors
    /// If an extent is not finite or too large.
    pub fn mesh(&self) -> Result<TriangleMesh, MeshError> {
        let sign = |corner: u32, bit: u32| if corner >> bit & 1 == 1 { 1.0 } else { -1.0 };
        let corner = |k| self.half_extents * DVec3::new(sign(k, 2), sign(k, 1), sign(k, 0));
        TriangleMesh::new((0..8).map(corner).collect(), &FACES)
    }
}
