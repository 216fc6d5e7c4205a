//! Makes a ring: a torus, through whose hole a body passes only with exact methods.

use super::grid::closed_grid;
use ccd_core::glam::DVec3;
use ccd_decomp::{MeshError, TriangleMesh};
use std::f64::consts::TAU;

/// A torus about the z axis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ring {
    /// The number of tube cross-sections around the axis, at least 3.
    pub segments: usize,
    /// The number of corners of each cross-section, at least 3.
    pub sides: usize,
    /// The distance from the axis to the middle of the tube.
    pub radius: f64,
    /// The radius of the tube, below `radius`.
    pub tube: f64,
}

impl Ring {
    /// Returns the closed mesh of `2 · segments · sides` triangles.
    ///
    /// # Errors
    /// If a number of parts is too small or too large for a mesh.
    pub fn mesh(&self) -> Result<TriangleMesh, MeshError> {
        closed_grid(self.segments, self.sides, |u, v| {
            let (sin_u, cos_u) = (TAU * u).sin_cos();
            let (sin_v, cos_v) = (TAU * v).sin_cos();
            let outward = DVec3::new(cos_u, sin_u, 0.0);
            (self.radius + self.tube * cos_v) * outward - self.tube * sin_v * DVec3::Z
        })
    }
}
