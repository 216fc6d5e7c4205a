//! Makes meshes of surfaces that are periodic in both parameters.

use ccd_core::glam::DVec3;
use ccd_decomp::{MeshError, TriangleMesh};

/// Returns the mesh of `2 · columns · rows` triangles over a surface with period 1 in both `u` and
/// `v`. The product ∂u × ∂v has to point inwards.
pub(super) fn closed_grid_mesh(
    columns: usize,
    rows: usize,
    surface: impl Fn(f64, f64) -> DVec3,
) -> Result<TriangleMesh, MeshError> {
    let index = |i: usize, j: usize| ((i % columns) * rows + j % rows) as u32;
    let mut vertices = Vec::with_capacity(columns * rows);
    let mut faces = Vec::with_capacity(2 * columns * rows);
    for i in 0..columns {
        for j in 0..rows {
            vertices.push(surface(i as f64 / columns as f64, j as f64 / rows as f64));
            let (a, b) = (index(i, j), index(i + 1, j));
            let (c, d) = (index(i, j + 1), index(i + 1, j + 1));
            faces.extend([[a, c, b], [b, c, d]]);
        }
    }
    TriangleMesh::new(vertices, &faces)
}
