//! Generates boxes, and shapes made of boxes.

use super::{GridExtent, Mesh, Shape, grid_faces, icosphere};
use ccd_core::glam::DVec3;
use ccd_core::{Facet, FacetOrigin, MeshFace, Polytope, Solidity};

/// Returns a box around the origin, as a mesh of 12 triangles and as one convex part of six quadrilaterals.
///
/// Corner `k` has a positive x, y, z if bit 0, 1, 2 of `k` is set.
pub fn cuboid(half: DVec3) -> Shape {
    let sign = |k: u32, bit: u32| if k >> bit & 1 == 1 { 1.0 } else { -1.0 };
    let corner = |k| half * DVec3::new(sign(k, 0), sign(k, 1), sign(k, 2));
    let points: Vec<DVec3> = (0..8).map(corner).collect();
    let quads: [[u32; 4]; 6] = [
        [0, 4, 6, 2],
        [1, 3, 7, 5],
        [0, 1, 5, 4],
        [2, 6, 7, 3],
        [0, 2, 3, 1],
        [4, 5, 7, 6],
    ];
    let facet = |quad: &[u32; 4]| Facet {
        origin: FacetOrigin::Faces,
        corners: quad.to_vec(),
    };
    let halves = |q: &[u32; 4]| [[q[0], q[1], q[2]], [q[0], q[2], q[3]]];
    let faces: Vec<[u32; 3]> = quads.iter().flat_map(halves).collect();
    let named = |(id, face): (u32, &[u32; 3])| MeshFace {
        id,
        vertices: *face,
        corners: face.map(|v| points[v as usize]),
    };
    Shape {
        parts: vec![Polytope {
            points: points.clone(),
            facets: quads.iter().map(facet).collect(),
            faces: (0..).zip(&faces).map(named).collect(),
            ..Polytope::default()
        }],
        mesh: Mesh {
            vertices: points,
            faces,
        },
        volume: Solidity::Solid,
    }
}

/// Returns a box, given the coordinates of two opposite corners.
fn box_between(lo: [f64; 3], hi: [f64; 3]) -> Shape {
    let (lo, hi) = (DVec3::from(lo), DVec3::from(hi));
    cuboid(0.5 * (hi - lo)).moved(0.5 * (lo + hi))
}

/// Returns a rod of half length `length` along x, half width 0.3 along y and half thickness `width` along z.
pub fn rod(length: f64, width: f64) -> Shape {
    cuboid(DVec3::new(length, 0.3, width))
}

/// Returns a wall, one unit thick, whose face towards −x is at `x`.
pub fn wall_at(x: f64) -> Shape {
    box_between([x, -4.0, -4.0], [x + 1.0, 4.0, 4.0])
}

/// Returns a triangular post along z. One edge is at the polar coordinates `(radius, angle)` and faces a rod that turns
/// counter-clockwise about the origin.
pub fn post(radius: f64, angle: f64) -> Shape {
    let edge = radius * DVec3::new(angle.cos(), angle.sin(), 0.0);
    // The post extends from the edge along the rod's motion, spread by a quarter turn.
    let along = DVec3::new(-angle.sin(), angle.cos(), 0.0);
    let across = DVec3::new(angle.cos(), angle.sin(), 0.0);
    let corners = [
        edge,
        edge + 0.4 * (along + across),
        edge + 0.4 * (along - across),
    ];
    let vertices = [-2.0, 2.0]
        .iter()
        .flat_map(|z| corners.map(|c| c + z * DVec3::Z));
    Shape::from_convex_mesh(Mesh {
        vertices: vertices.collect(),
        faces: vec![
            [0, 2, 1],
            [3, 4, 5],
            [0, 1, 4],
            [0, 4, 3],
            [1, 2, 5],
            [1, 5, 4],
            [2, 0, 3],
            [2, 3, 5],
        ],
    })
}

/// Returns a mace: a ball of radius 0.1 at the origin, and an arm of half width `width` from the origin to `(0,
/// −length, 0)`.
pub fn mace(length: f64, width: f64) -> Shape {
    let arm = box_between([-width, -length, -width], [width, 0.0, width]);
    Shape::union([icosphere(0.1, 1), arm])
}

/// Returns an L-shaped prism of two bars, as one closed surface of 20 triangles, many of them coplanar.
pub fn l_prism() -> Shape {
    let outline: [[f64; 2]; 6] = [
        [0.0, 0.0],
        [2.0, 0.0],
        [2.0, 1.0],
        [1.0, 1.0],
        [1.0, 2.0],
        [0.0, 2.0],
    ];
    let vertices = [-0.5, 0.5]
        .iter()
        .flat_map(|&z| outline.map(|[x, y]| DVec3::new(x, y, z)))
        .collect();
    let cap = [[0, 1, 2], [0, 2, 3], [0, 3, 5], [3, 4, 5]];
    let mut faces: Vec<[u32; 3]> = cap.iter().map(|&[a, b, c]| [a, c, b]).collect();
    faces.extend(cap.iter().map(|t| t.map(|v| v + 6)));
    for k in 0..6u32 {
        let next = (k + 1) % 6;
        faces.extend([[k, next, next + 6], [k, next + 6, k + 6]]);
    }
    Shape::from_closed_mesh(Mesh { vertices, faces })
}

/// Returns a plate in the xy-plane with a square hole of half width `hole`, made of four boxes.
pub fn frame_plate(hole: f64) -> Shape {
    let (outer, z) = (hole + 1.0, 0.25);
    Shape::union([
        box_between([-outer, -outer, -z], [-hole, outer, z]),
        box_between([hole, -outer, -z], [outer, outer, z]),
        box_between([-hole, -outer, -z], [hole, -hole, z]),
        box_between([-hole, hole, -z], [hole, outer, z]),
    ])
}

/// Returns a wall between `x = 0` and `x = 0.5` with a slit `|z| < half_height`, made of two boxes.
pub fn slit_plate(half_height: f64) -> Shape {
    Shape::union([
        box_between([0.0, -3.0, half_height], [0.5, 3.0, half_height + 2.0]),
        box_between([0.0, -3.0, -half_height - 2.0], [0.5, 3.0, -half_height]),
    ])
}

/// Returns a U-shaped hook open towards −z: a base along x, centered at the origin, and two legs of length `length`.
pub fn u_hook(bar: f64, gap: f64, length: f64) -> Shape {
    let (half, inner) = (0.5 * bar, 0.5 * gap);
    let outer = inner + bar;
    Shape::union([
        box_between([-outer, -half, -half], [outer, half, half]),
        box_between([-outer, -half, -length], [-inner, half, -half]),
        box_between([inner, -half, -length], [outer, half, -half]),
    ])
}

/// Returns a comb: a base below z = 0, and `teeth` teeth of height 1 and width 0.4, one unit from tooth to tooth along
/// x.
pub fn comb(teeth: usize) -> Shape {
    let tooth = |k: usize| box_between([k as f64, -0.2, 0.0], [k as f64 + 0.4, 0.2, 1.0]);
    let base = box_between([-1.0, -0.2, -0.3], [teeth as f64 + 1.0, 0.2, 0.0]);
    Shape::union((0..teeth).map(tooth).chain([base]))
}

/// Returns the square plate `[0, 1]²` at z = 0, divided into `2·cells²` triangles.
pub fn square_plate(cells: usize) -> Shape {
    let at = |k: usize| k as f64 / cells as f64;
    let line = GridExtent::Bounded(cells + 1);
    Shape::from_open_mesh(Mesh {
        vertices: (0..=cells)
            .flat_map(|i| (0..=cells).map(move |j| DVec3::new(at(i), at(j), 0.0)))
            .collect(),
        faces: grid_faces(line, line),
    })
}

/// Returns upright triangles of length 1 and width `width`, in a row along x from 0 to 1, with their tips down at z =
/// 0.
pub fn needles(count: usize, width: f64) -> Shape {
    let mut mesh = Mesh {
        vertices: Vec::new(),
        faces: Vec::new(),
    };
    for k in 0..count {
        let foot = DVec3::new((k as f64 + 0.5) / count as f64, 0.5, 0.0);
        let base = mesh.vertices.len() as u32;
        mesh.vertices
            .extend([foot, foot + DVec3::Z, foot + DVec3::Z + width * DVec3::Y]);
        mesh.faces.push([base, base + 1, base + 2]);
    }
    Shape::from_open_mesh(mesh)
}
