//! Makes a flat square of many triangles: two of them that meet flat have contacts everywhere at once.

use ccd_core::glam::DVec3;
use ccd_decomp::{MeshError, TriangleMesh};

/// A square in the plane z = 0 about the origin, cut into small squares of two triangles each.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Plate {
    /// Half the length of a side of the whole square.
    pub half_side: f64,
    /// The number of small squares per side.
    pub squares: u32,
}

impl Plate {
    /// Returns the open mesh of `2 · squares²` triangles.
    ///
    /// # Errors
    /// If it has no squares, or its size is not finite or too large.
    pub fn mesh(&self) -> Result<TriangleMesh, MeshError> {
        let n = self.squares;
        let step = 2.0 * self.half_side / f64::from(n);
        let coordinate = |k: u32| f64::from(k) * step - self.half_side;
        let vertices = (0..=n).flat_map(|i| (0..=n).map(move |j| (i, j)));
        let faces: Vec<[u32; 3]> = (0..n)
            .flat_map(|i| (0..n).map(move |j| i * (n + 1) + j))
            .flat_map(|a| [[a, a + n + 1, a + 1], [a + 1, a + n + 1, a + n + 2]])
            .collect();
        let vertices = vertices.map(|(i, j)| DVec3::new(coordinate(i), coordinate(j), 0.0));
        TriangleMesh::new(vertices.collect(), &faces)
    }
}
