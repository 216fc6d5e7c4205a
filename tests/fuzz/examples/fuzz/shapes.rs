//! Generates meshes around the origin, of size about 1.

use crate::case::{MeshClass, Shape};
use crate::draw::{RandomSource, scale_array};
use crate::vector::Vector;

/// Returns a mesh of `count` random triangles.
pub fn soup(draw: &mut RandomSource, count: usize) -> Shape {
    let mut shape = Shape::default();
    for k in 0..count as u32 {
        let (at, size) = (draw.point(), draw.log_uniform(0.05..1.0));
        for _ in 0..3 {
            let corner = scale_array(draw.point(), size);
            shape.vertices.push((Vector(at) * 0.7 + Vector(corner)).0);
        }
        shape.faces.push([3 * k, 3 * k + 1, 3 * k + 2]);
    }
    shape
}

fn shape(vertices: Vec<[f64; 3]>, faces: Vec<[u32; 3]>, form: MeshClass) -> Shape {
    Shape {
        vertices,
        faces,
        mesh_class: form,
    }
}

/// Returns a random tetrahedron, oriented outward.
pub fn tetrahedron(draw: &mut RandomSource) -> Shape {
    let corners = [(); 4].map(|()| Vector(draw.point()));
    let [a, b, c, d] = corners;
    let up = (b - a).cross(c - a).dot(d - a) > 0.0;
    let faces = vec![[0, 2, 1], [0, 1, 3], [1, 2, 3], [0, 3, 2]];
    let out = shape(corners.map(|c| c.0).to_vec(), faces, MeshClass::Convex);
    if up {
        out
    } else {
        Shape {
            mesh_class: MeshClass::Convex,
            ..out.with_reversed_faces()
        }
    }
}

pub fn cuboid(half: [f64; 3]) -> Shape {
    Shape::cuboid(half)
}

/// Returns a closed ring around the z axis, whose quadrilaterals are not flat and are divided into triangles.
pub fn ring(around: u32, across: u32, thickness: f64) -> Shape {
    let turn = |k: u32, n: u32| std::f64::consts::TAU * f64::from(k) / f64::from(n);
    let (mut vertices, mut faces) = (Vec::new(), Vec::new());
    for i in 0..around {
        for j in 0..across {
            let ((s, c), (up, out)) = (turn(i, around).sin_cos(), turn(j, across).sin_cos());
            let r = 1.0 - thickness + thickness * out;
            vertices.push([r * c, r * s, thickness * up]);
            let at = |i: u32, j: u32| (i % around) * across + j % across;
            let quad = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
            faces.push([quad[0], quad[1], quad[2]]);
            faces.push([quad[0], quad[2], quad[3]]);
        }
    }
    shape(vertices, faces, MeshClass::Solid)
}

/// Returns a bipyramid: corners around an axis and two poles, convex or star-shaped.
pub fn bipyramid(draw: &mut RandomSource, corners: u32, waist: f64) -> Shape {
    let mut vertices = vec![
        [0.0, 0.0, draw.uniform(0.2..1.0)],
        [0.0, 0.0, -draw.uniform(0.2..1.0)],
    ];
    let mut faces = Vec::new();
    for k in 0..corners {
        let (s, c) = (std::f64::consts::TAU * f64::from(k) / f64::from(corners)).sin_cos();
        let r = if k % 2 == 1 { waist } else { 1.0 };
        vertices.push([r * c, r * s, 0.0]);
        let (here, next) = (2 + k, 2 + (k + 1) % corners);
        faces.extend([[0, here, next], [1, next, here]]);
    }
    let form = if waist < 1.0 {
        MeshClass::Solid
    } else {
        MeshClass::Convex
    };
    shape(vertices, faces, form)
}

/// Returns the convex hull of random points on a stretched sphere, built point by point.
pub fn hull(draw: &mut RandomSource, count: usize) -> Shape {
    let stretch = [(); 3].map(|()| draw.log_uniform(0.2..1.0));
    let point = |draw: &mut RandomSource| {
        let v = draw.direction();
        [v[0] * stretch[0], v[1] * stretch[1], v[2] * stretch[2]]
    };
    let vertices: Vec<[f64; 3]> = (0..count.max(4)).map(|_| point(draw)).collect();
    let above = |face: [u32; 3], p: u32| {
        let [a, b, c, p] = [face[0], face[1], face[2], p].map(|v| Vector(vertices[v as usize]));
        (b - a).cross(c - a).dot(p - a) > 0.0
    };
    let mut faces: Vec<[u32; 3]> = if above([0, 1, 2], 3) {
        vec![[0, 2, 1], [0, 1, 3], [1, 2, 3], [0, 3, 2]]
    } else {
        vec![[0, 1, 2], [0, 3, 1], [1, 3, 2], [0, 2, 3]]
    };
    for p in 4..vertices.len() as u32 {
        let (seen, kept): (Vec<_>, Vec<_>) = faces.iter().partition(|&&face| above(face, p));
        let edges = |f: &[u32; 3]| [[f[0], f[1]], [f[1], f[2]], [f[2], f[0]]];
        let all: std::collections::HashSet<[u32; 2]> = seen.iter().flat_map(edges).collect();
        let rim = all.iter().filter(|[a, b]| !all.contains(&[*b, *a]));
        faces = kept;
        faces.extend(rim.map(|&[a, b]| [a, b, p]));
    }
    faces.sort_unstable();
    shape(vertices, faces, MeshClass::VertexHull)
}

/// Returns a random shape of this module, with up to about 30 triangles.
pub fn any_shape(draw: &mut RandomSource) -> Shape {
    match draw.count(0..7) {
        0 | 1 => {
            let count = draw.count(1..9);
            soup(draw, count)
        }
        2 => closed_shape(draw),
        3 => {
            let (around, across) = (draw.count(3..6) as u32, draw.count(3..5) as u32);
            let thickness = draw.uniform(0.05..0.45);
            ring(around, across, thickness)
        }
        _ => closed_shape(draw),
    }
}

/// Returns a random tetrahedron, box or bipyramid, all of which are closed.
pub fn closed_shape(draw: &mut RandomSource) -> Shape {
    match draw.count(0..4) {
        0 => tetrahedron(draw),
        1 => {
            let half = [(); 3].map(|()| draw.log_uniform(0.05..1.0));
            cuboid(half)
        }
        2 => {
            let corners = draw.count(3..9) as u32;
            bipyramid(draw, corners, 1.0)
        }
        _ => {
            let (corners, waist) = (2 * draw.count(2..6) as u32, draw.uniform(0.2..0.6));
            bipyramid(draw, corners, waist)
        }
    }
}
