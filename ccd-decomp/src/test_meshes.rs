//! Small closed meshes for tests.

use crate::mesh::TriangleMesh;
use ccd_core::glam::{DVec3, dvec3};
use std::collections::HashMap;

/// The faces of a cube, oriented outward. The bits of a corner's number are its coordinates, x the lowest.
pub(crate) const CUBE_FACES: [[u32; 3]; 12] = [
    [0, 4, 6],
    [0, 6, 2],
    [1, 3, 7],
    [1, 7, 5],
    [0, 1, 5],
    [0, 5, 4],
    [2, 6, 7],
    [2, 7, 3],
    [0, 2, 3],
    [0, 3, 1],
    [4, 5, 7],
    [4, 7, 6],
];

/// Returns the surface of a union of unit cubes, given by their lowest corners. Every square is two triangles.
pub(crate) fn cubes(cells: &[[i32; 3]]) -> TriangleMesh {
    let filled = |c: [i32; 3]| cells.contains(&c);
    let (mut numbers, mut vertices, mut faces) = (HashMap::new(), Vec::new(), Vec::new());
    for &cell in cells {
        for axis in 0..3 {
            for up in [0, 1] {
                let mut beyond = cell;
                beyond[axis] += 2 * up - 1;
                if filled(beyond) {
                    continue;
                }
                let corners = [(0, 0), (1, 0), (1, 1), (0, 1)].map(|(s, t)| {
                    let mut corner = cell;
                    corner[axis] += up;
                    corner[(axis + 1) % 3] += s;
                    corner[(axis + 2) % 3] += t;
                    *numbers.entry(corner).or_insert_with(|| {
                        let [x, y, z] = corner.map(f64::from);
                        vertices.push(dvec3(x, y, z));
                        vertices.len() as u32 - 1
                    })
                });
                let [a, b, c, d] = corners;
                match up {
                    1 => faces.extend([[a, b, c], [a, c, d]]),
                    _ => faces.extend([[a, c, b], [a, d, c]]),
                }
            }
        }
    }
    mesh(vertices, &faces)
}

/// Returns the lowest corners of all unit cubes of a block.
pub(crate) fn block_cells([x, y, z]: [i32; 3]) -> Vec<[i32; 3]> {
    let columns = (0..x).flat_map(move |i| (0..y).map(move |j| (i, j)));
    columns
        .flat_map(|(i, j)| (0..z).map(move |k| [i, j, k]))
        .collect()
}

/// Returns the tetrahedron of the origin and the three unit vectors, oriented outward.
pub(crate) fn tetrahedron() -> TriangleMesh {
    mesh(
        vec![DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::Z],
        &[[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]],
    )
}

/// Merges several meshes into one.
pub(crate) fn merged_meshes(parts: &[&TriangleMesh]) -> TriangleMesh {
    TriangleMesh::merge(parts.iter().copied()).unwrap()
}

/// Scales a mesh, then moves it. A negative scale turns it inside out.
pub(crate) fn scaled_and_moved(part: &TriangleMesh, scale: f64, offset: DVec3) -> TriangleMesh {
    let vertices = part.vertices().iter().map(|&p| scale * p + offset);
    mesh(vertices.collect(), part.faces())
}

/// Returns the mesh with every face reversed, which turns it inside out.
pub(crate) fn mesh_with_reversed_faces(part: &TriangleMesh) -> TriangleMesh {
    let faces: Vec<[u32; 3]> = part.faces().iter().map(|&[a, b, c]| [a, c, b]).collect();
    mesh(part.vertices().to_vec(), &faces)
}

/// Creates a mesh from vertices and faces; panics if they are invalid.
pub(crate) fn mesh(vertices: Vec<DVec3>, faces: &[[u32; 3]]) -> TriangleMesh {
    TriangleMesh::new(vertices, faces).unwrap()
}

/// Returns two cones over a star, with apices above and below. The corners of the star are alternately at radius 1
/// and at radius `inner`.
pub(crate) fn star_bipyramid(corners: u32, inner: f64) -> TriangleMesh {
    let corner = |k: u32| {
        let angle = std::f64::consts::TAU * f64::from(k) / f64::from(corners);
        let radius = if k.is_multiple_of(2) { 1.0 } else { inner };
        dvec3(radius * angle.cos(), radius * angle.sin(), 0.0)
    };
    let mut vertices: Vec<DVec3> = (0..corners).map(corner).collect();
    vertices.extend([DVec3::Z, -DVec3::Z]);
    let side = |k: u32| {
        let next = (k + 1) % corners;
        [[k, next, corners], [next, k, corners + 1]]
    };
    mesh(vertices, &(0..corners).flat_map(side).collect::<Vec<_>>())
}

/// Returns a prism along z over a polygon. Each cap is the fan about its first corner.
pub(crate) fn prism(outline: &[DVec3]) -> TriangleMesh {
    let fan = (1..outline.len() as u32 - 1).map(|k| [0, k, k + 1]);
    prism_with_caps(outline, &fan.collect::<Vec<_>>())
}

/// Returns a prism along z over a polygon, whose caps consist of given triangles.
fn prism_with_caps(outline: &[DVec3], caps: &[[u32; 3]]) -> TriangleMesh {
    let n = outline.len() as u32;
    let mut vertices = outline.to_vec();
    vertices.extend(outline.iter().map(|&p| p + DVec3::Z));
    let mut faces = Vec::new();
    for k in 0..n {
        let l = (k + 1) % n;
        faces.extend([[k, l, n + l], [k, n + l, n + k]]);
    }
    for &[a, b, c] in caps {
        faces.extend([[a, c, b], [n + a, n + b, n + c]]);
    }
    mesh(vertices, &faces)
}

/// Returns a comb, extruded along z from 0 to 1: a bar along x, with teeth that end at the given heights along y. The
/// caps are a fan for the bar, and two triangles for every tooth.
pub(crate) fn comb(heights: &[f64]) -> TriangleMesh {
    let count = heights.len() as u32;
    let mut outline = vec![DVec3::ZERO, dvec3(f64::from(2 * count + 1), 0.0, 0.0)];
    let mut caps = Vec::new();
    for (tooth, &height) in (1..=count).rev().zip(heights) {
        let [right, left] = [0.0, 1.0].map(|width| f64::from(2 * tooth) - width);
        let base = outline.len() as u32;
        let places = [(right, 1.0), (right, height), (left, height), (left, 1.0)];
        outline.extend(places.map(|(x, y)| dvec3(x, y, 0.0)));
        let [a, b, c, d] = [0, 1, 2, 3].map(|k| base + k);
        caps.extend([[0, base - 1, a], [0, a, d], [a, b, c], [a, c, d]]);
    }
    prism_with_caps(&outline, &caps)
}

/// Returns the outline of a quarter disc with a toothed rim. The first corner is its center. All corners are visible
/// from it, so that the fans of the caps are exact.
pub(crate) fn toothed_quadrant_outline(count: u32) -> Vec<DVec3> {
    let corner = |k: u32| {
        let share = f64::from(k) / f64::from(2 * count - 1);
        let angle = 0.5 * std::f64::consts::PI * share;
        let radius = if k.is_multiple_of(2) { 0.9 } else { 1.0 };
        radius * dvec3(angle.cos(), angle.sin(), 0.0)
    };
    [DVec3::ZERO]
        .into_iter()
        .chain((0..2 * count).map(corner))
        .collect()
}

/// Returns a wide prism with a narrower, longer prism on top: a solid with large caps that is not star-shaped.
pub(crate) fn prism_under_prism(corners: u32) -> TriangleMesh {
    let ring = |radius: f64, z: f64| {
        (0..corners).map(move |k| {
            let angle = std::f64::consts::TAU * f64::from(k) / f64::from(corners);
            dvec3(radius * angle.cos(), radius * angle.sin(), z)
        })
    };
    let rings = [(1.0, 0.0), (1.0, 1.0), (0.3, 1.0), (0.3, 21.0)];
    let vertices = rings.into_iter().flat_map(|(radius, z)| ring(radius, z));
    let mut faces = Vec::new();
    for k in 0..corners {
        let l = (k + 1) % corners;
        for base in [0, corners, 2 * corners] {
            let [a, b, c, d] = [base + k, base + l, base + corners + l, base + corners + k];
            faces.extend([[a, b, c], [a, c, d]]);
        }
    }
    for k in 1..corners - 1 {
        let top = 3 * corners;
        faces.extend([[0, k + 1, k], [top, top + k, top + k + 1]]);
    }
    mesh(vertices.collect(), &faces)
}
