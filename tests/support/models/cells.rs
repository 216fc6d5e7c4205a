//! Generates thick plates from grids of quadrilateral cells, some of which are left out. Their tops and bottoms are
//! large regions of coplanar triangles, rarely convex.

use super::{GridExtent, Mesh, Shape, lumps::seeded_rng};
use ccd_core::glam::{DQuat, DVec2, DVec3};
use rand::RngExt;
use std::collections::HashMap;
use std::f64::consts::TAU;

/// Returns a gear about z, with a bore, a hole between neighbouring spokes, and twice as many teeth as spokes.
pub fn gear(spokes: usize) -> Shape {
    let radii = [0.2, 0.35, 0.6, 0.8, 1.0];
    let columns = 8 * spokes;
    let at = |i: usize, j: usize| {
        let angle = TAU * j as f64 / columns as f64;
        radii[i] * DVec2::new(angle.cos(), angle.sin())
    };
    CellGrid {
        rows: GridExtent::Bounded(radii.len()),
        columns: GridExtent::Wrapping(columns),
        is_filled: &|i, j| match i {
            1 => j % 8 < 3,
            3 => j % 4 < 2,
            _ => true,
        },
    }
    .thicken(at, 0.15)
}

/// Returns a plate with `n × m` square holes, which are as wide as the bridges between them.
pub fn perforated_plate(n: usize, m: usize) -> Shape {
    CellGrid {
        rows: GridExtent::Bounded(2 * n + 2),
        columns: GridExtent::Bounded(2 * m + 2),
        is_filled: &|i, j| i % 2 == 0 || j % 2 == 0,
    }
    .thicken(|i, j| 0.25 * DVec2::new(i as f64, j as f64), 0.125)
}

/// Returns the solid of [`l_prism`](super::l_prism) with the tops of its bars divided into `cells²` squares per unit
/// area.
pub fn divided_l_prism(cells: usize) -> Shape {
    let unit = 1.0 / cells as f64;
    CellGrid {
        rows: GridExtent::Bounded(2 * cells + 1),
        columns: GridExtent::Bounded(2 * cells + 1),
        is_filled: &|i, j| i < cells || j < cells,
    }
    .thicken(|i, j| unit * DVec2::new(i as f64, j as f64), 0.5)
}

/// Returns one closed plate with a slit of the given width through its middle.
pub fn slotted_plate(width: f64) -> Shape {
    let (x, y) = (
        [-2.0, -1.5, 1.5, 2.0],
        [-1.0, -0.5 * width, 0.5 * width, 1.0],
    );
    CellGrid {
        rows: GridExtent::Bounded(4),
        columns: GridExtent::Bounded(4),
        is_filled: &|i, j| (i, j) != (1, 1),
    }
    .thicken(|i, j| DVec2::new(x[i], y[j]), 0.25)
}

/// Returns two combs in one mesh, with the teeth of each comb between those of the other.
pub fn interlocking_combs(teeth: usize) -> Shape {
    let x = |i: usize| (i / 2) as f64 + if i % 2 == 1 { 0.4 } else { 0.0 };
    let y = [0.0, 0.3, 1.3];
    let comb = CellGrid {
        rows: GridExtent::Bounded(2 * teeth),
        columns: GridExtent::Bounded(3),
        is_filled: &|i, j| j == 0 || i % 2 == 0,
    }
    .thicken(|i, j| DVec2::new(x(i), y[j]), 0.2);
    // A half turn about z is exact.
    let turn = DQuat::from_xyzw(0.0, 0.0, 1.0, 0.0);
    let other = comb
        .clone()
        .placed(turn, DVec3::new(x(2 * teeth - 1) + 0.5, 1.7, 0.0));
    let mut mesh = comb.mesh;
    mesh.append(&other.mesh);
    Shape::from_closed_mesh(mesh)
}

/// Returns a unit cube, its top and its bottom divided into `cells²` squares.
pub fn divided_cube(cells: usize) -> Shape {
    let unit = 1.0 / cells as f64;
    CellGrid {
        rows: GridExtent::Bounded(cells + 1),
        columns: GridExtent::Bounded(cells + 1),
        is_filled: &|_, _| true,
    }
    .thicken(|i, j| unit * DVec2::new(i as f64, j as f64), 0.5)
}

/// Returns a block with random heights on its top, and flat sides and bottom.
pub fn terrain(cells: usize, seed: u64) -> Shape {
    let mut rng = seeded_rng(seed);
    let unit = 1.0 / cells as f64;
    let mut heights: HashMap<(usize, usize), f64> = HashMap::new();
    for i in 0..=cells {
        for j in 0..=cells {
            heights.insert((i, j), rng.random_range(0.2..0.5));
        }
    }
    let at = |i: usize, j: usize, z: f64| DVec3::new(unit * i as f64, unit * j as f64, z);
    CellGrid {
        rows: GridExtent::Bounded(cells + 1),
        columns: GridExtent::Bounded(cells + 1),
        is_filled: &|_, _| true,
    }
    .solid_between_sheets(|i, j| at(i, j, 0.0), |i, j| at(i, j, heights[&(i, j)]))
}

/// A grid of four-sided cells, some of which are filled.
struct CellGrid<'a> {
    rows: GridExtent,
    columns: GridExtent,
    is_filled: &'a dyn Fn(usize, usize) -> bool,
}

impl CellGrid<'_> {
    /// Returns the solid that extends by `half` to either side of the filled cells, which are placed in the xy-plane.
    fn thicken(&self, at: impl Fn(usize, usize) -> DVec2, half: f64) -> Shape {
        self.solid_between_sheets(|i, j| at(i, j).extend(-half), |i, j| at(i, j).extend(half))
    }

    /// Returns the solid between two sheets, over the filled cells. Seen from above, rows go to the right and columns
    /// upwards.
    fn solid_between_sheets(
        &self,
        low: impl Fn(usize, usize) -> DVec3,
        high: impl Fn(usize, usize) -> DVec3,
    ) -> Shape {
        let mut numbers = HashMap::new();
        let mut vertices = Vec::new();
        let mut top = Vec::new();
        for i in 0..self.rows.cell_count() {
            for j in (0..self.columns.cell_count()).filter(|&j| (self.is_filled)(i, j)) {
                let corners = [(i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1)];
                // Vertex k + 1 is above vertex k of the bottom.
                let [a, b, c, d] = corners.map(|(i, j)| {
                    let key = (i % self.rows.count(), j % self.columns.count());
                    *numbers.entry(key).or_insert_with(|| {
                        vertices.extend([low(key.0, key.1), high(key.0, key.1)]);
                        vertices.len() as u32 - 1
                    })
                });
                top.extend([[a, b, c], [a, c, d]]);
            }
        }
        let mut faces: Vec<[u32; 3]> = top.iter().map(|&[a, b, c]| [a - 1, c - 1, b - 1]).collect();
        for [v, w] in boundary_edges(&top) {
            faces.extend([[v - 1, w - 1, w], [v - 1, w, v]]);
        }
        faces.extend(top);
        Shape::from_closed_mesh(Mesh { vertices, faces })
    }
}

/// Returns the boundary edges of some faces, in the order of the faces. A boundary edge has no face in the opposite
/// direction.
fn boundary_edges(faces: &[[u32; 3]]) -> Vec<[u32; 2]> {
    let edges = |&[a, b, c]: &[u32; 3]| [[a, b], [b, c], [c, a]];
    let all: Vec<[u32; 2]> = faces.iter().flat_map(edges).collect();
    let set: std::collections::HashSet<[u32; 2]> = all.iter().copied().collect();
    let is_rim = |[v, w]: &[u32; 2]| !set.contains(&[*w, *v]);
    all.into_iter().filter(is_rim).collect()
}
