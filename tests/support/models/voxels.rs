//! Generates solids made of unit cubes.

use super::{Mesh, Shape, lumps::seeded_rng};
use ccd_core::glam::DVec3;
use rand::RngExt;
use std::collections::HashMap;

/// Returns a pile of unit cubes in a corner, in columns of random heights up to `size` that decrease away from the
/// corner. Its sides are coplanar regions of any outline. No two cubes touch each other at an edge.
pub fn pile(size: usize, seed: u64) -> Shape {
    let mut rng = seeded_rng(seed);
    let mut heights = vec![vec![0; size]; size];
    for x in 0..size {
        for y in 0..size {
            let before = |h: Option<usize>| h.unwrap_or(size);
            let left = before(x.checked_sub(1).map(|x| heights[x][y]));
            let behind = before(y.checked_sub(1).map(|y| heights[x][y]));
            let most = left.min(behind);
            let least = usize::from(x + y == 0);
            heights[x][y] = rng.random_range(least.min(most)..=most);
        }
    }
    let full = |[x, y, z]: [i64; 3]| {
        let index = |k: i64| usize::try_from(k).ok().filter(|&k| k < size);
        match (index(x), index(y), index(z)) {
            (Some(x), Some(y), Some(z)) => z < heights[x][y],
            _ => false,
        }
    };
    cubes(size as i64, full)
}

/// Returns the surface of the filled cubes of a grid, with two triangles for each square.
fn cubes(size: i64, full: impl Fn([i64; 3]) -> bool) -> Shape {
    let mut numbers = HashMap::new();
    let mut mesh = Mesh {
        vertices: Vec::new(),
        faces: Vec::new(),
    };
    let all = (0..size * size * size).map(|k| [k % size, k / size % size, k / size / size]);
    for cube in all.filter(|&cube| full(cube)) {
        for axis in 0..3 {
            for up in [false, true] {
                let mut beyond = cube;
                beyond[axis] += if up { 1 } else { -1 };
                if full(beyond) {
                    continue;
                }
                // Counter-clockwise seen from where the axis points.
                let quad = [[0, 0], [1, 0], [1, 1], [0, 1]].map(|[u, v]| {
                    let mut corner = cube;
                    corner[axis] += i64::from(up);
                    corner[(axis + 1) % 3] += u;
                    corner[(axis + 2) % 3] += v;
                    *numbers.entry(corner).or_insert_with(|| {
                        let [x, y, z] = corner.map(|k| k as f64);
                        mesh.vertices.push(DVec3::new(x, y, z));
                        mesh.vertices.len() as u32 - 1
                    })
                });
                let [a, b, c, d] = quad;
                mesh.faces.extend(if up {
                    [[a, b, c], [a, c, d]]
                } else {
                    [[a, c, b], [a, d, c]]
                });
            }
        }
    }
    Shape::from_closed_mesh(mesh)
}
