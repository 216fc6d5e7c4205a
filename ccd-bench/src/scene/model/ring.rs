//! Makes the mesh of a torus. A body can pass through its hole only with methods that do not fill it by a hull.

use super::grid::closed_grid_mesh;
use ccd_core::glam::DVec3;
use ccd_decomp::{MeshError, TriangleMesh};
use std::f64::consts::TAU;

/// Returns the closed mesh of a torus about the z axis, with `segments` cross-sections of `sides` corners each. Either
/// number is at least 3, and the mesh has `2 · segments · sides` triangles. The radius is that from the axis to the
/// middle of the tube.
///
/// # Errors
/// If a number of parts is too small or too large for a mesh.
pub(crate) fn torus_mesh(
    [segments, sides]: [usize; 2],
    radius: f64,
    tube_radius: f64,
) -> Result<TriangleMesh, MeshError> {
    closed_grid_mesh(segments, sides, |u, v| {
        let (sin_u, cos_u) = (TAU * u).sin_cos();
        let (sin_v, cos_v) = (TAU * v).sin_cos();
        let outward = DVec3::new(cos_u, sin_u, 0.0);
        (radius + tube_radius * cos_v) * outward - tube_radius * sin_v * DVec3::Z
    })
}
