//! Generates round shapes: spheres, tori, knots.

use super::{GridExtent, Mesh, Shape, grid_faces};
use ccd_core::glam::DVec3;
use ccd_core::order::lesser;
use std::collections::HashMap;
use std::f64::consts::TAU;

/// Returns an icosahedron divided `levels` times, with every vertex at distance `radius` from the origin.
pub fn icosphere(radius: f64, levels: u32) -> Shape {
    let g = (1.0 + 5.0_f64.sqrt()) / 2.0;
    let mut vertices = Vec::new();
    for [x, y] in [[-1.0, g], [1.0, g], [-1.0, -g], [1.0, -g]] {
        vertices.push(DVec3::new(x, y, 0.0));
    }
    for [y, z] in [[-1.0, g], [1.0, g], [-1.0, -g], [1.0, -g]] {
        vertices.push(DVec3::new(0.0, y, z));
    }
    for [z, x] in [[-1.0, g], [1.0, g], [-1.0, -g], [1.0, -g]] {
        vertices.push(DVec3::new(x, 0.0, z));
    }
    let mut faces: Vec<[u32; 3]> = vec![
        [0, 11, 5],
        [0, 5, 1],
        [0, 1, 7],
        [0, 7, 10],
        [0, 10, 11],
        [1, 5, 9],
        [5, 11, 4],
        [11, 10, 2],
        [10, 7, 6],
        [7, 1, 8],
        [3, 9, 4],
        [3, 4, 2],
        [3, 2, 6],
        [3, 6, 8],
        [3, 8, 9],
        [4, 9, 5],
        [2, 4, 11],
        [6, 2, 10],
        [8, 6, 7],
        [9, 8, 1],
    ];
    for _ in 0..levels {
        let mut middles = HashMap::new();
        let mut middle = |a: u32, b: u32, vertices: &mut Vec<DVec3>| {
            *middles.entry((a.min(b), a.max(b))).or_insert_with(|| {
                let m = vertices[a as usize] + vertices[b as usize];
                vertices.push(m);
                vertices.len() as u32 - 1
            })
        };
        faces = faces
            .iter()
            .flat_map(|&[a, b, c]| {
                let ab = middle(a, b, &mut vertices);
                let bc = middle(b, c, &mut vertices);
                let ca = middle(c, a, &mut vertices);
                [[a, ab, ca], [b, bc, ab], [c, ca, bc], [ab, bc, ca]]
            })
            .collect();
        vertices.iter_mut().for_each(|v| *v = v.normalize());
    }
    let vertices = vertices.iter().map(|v| radius * v.normalize()).collect();
    Shape::from_convex_mesh(Mesh { vertices, faces })
}

/// Returns the inradius of a convex mesh around the origin: the least distance of a face's plane from the origin.
pub fn inradius(mesh: &Mesh) -> f64 {
    let distance = |face| {
        let [a, b, c] = mesh.triangle(face);
        (b - a).cross(c - a).normalize().dot(a)
    };
    (0..mesh.faces.len())
        .map(distance)
        .fold(f64::INFINITY, lesser)
}

/// Returns a torus about z. It has `rings` sections on a circle of radius `major`, the first of them on +x. Each
/// section has `sides` vertices at distance `minor` from its center, the first of them nearest to the axis.
pub fn torus(major: f64, minor: f64, rings: usize, sides: usize) -> Shape {
    let angle = |k: usize, n: usize| TAU * k as f64 / n as f64;
    let vertex = |i: usize, j: usize| {
        let (u, v) = (angle(i, rings), angle(j, sides));
        let r = major - minor * v.cos();
        DVec3::new(r * u.cos(), r * u.sin(), minor * v.sin())
    };
    let mesh = Mesh {
        vertices: (0..rings)
            .flat_map(|i| (0..sides).map(move |j| vertex(i, j)))
            .collect(),
        faces: grid_faces(GridExtent::Wrapping(rings), GridExtent::Wrapping(sides)),
    };
    Shape::from_closed_mesh(mesh.with_reversed_faces())
}

/// Returns a tube around a trefoil knot, of about unit size, with `rings` sections of `sides` vertices.
pub fn torus_knot(rings: usize, sides: usize) -> Shape {
    let curve = |u: f64| {
        let r = 0.5 + 0.2 * (3.0 * u).cos();
        DVec3::new(
            r * (2.0 * u).cos(),
            r * (2.0 * u).sin(),
            0.2 * (3.0 * u).sin(),
        )
    };
    let mut vertices = Vec::new();
    for i in 0..rings {
        let u = TAU * i as f64 / rings as f64;
        let tangent = (curve(u + 1e-4) - curve(u - 1e-4)).normalize();
        let side = tangent.cross(DVec3::Z).normalize();
        let up = side.cross(tangent);
        for j in 0..sides {
            let v = TAU * j as f64 / sides as f64;
            vertices.push(curve(u) + 0.08 * (v.cos() * side + v.sin() * up));
        }
    }
    let faces = grid_faces(GridExtent::Wrapping(rings), GridExtent::Wrapping(sides));
    Shape::from_closed_mesh(Mesh { vertices, faces })
}
