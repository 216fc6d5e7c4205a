//! Generates lumpy solids: random and bumpy ones, dents and cavities.

use super::{Mesh, Shape, cuboid, icosphere};
use ccd_core::glam::DVec3;
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64;

/// Returns a random generator with the given seed.
pub(super) fn seeded_rng(seed: u64) -> Pcg64 {
    Pcg64::seed_from_u64(seed)
}

/// Returns an icosahedron divided `levels` times, whose vertices are at random distances from `1 − roughness` to 1 from
/// the origin.
pub fn boulder(levels: u32, roughness: f64, seed: u64) -> Shape {
    let mut rng = seeded_rng(seed);
    star_shaped_solid(levels, |_| 1.0 - roughness * rng.random_range(0.0..1.0))
}

/// Returns a smooth lump with bumps and two ears.
pub fn blob(levels: u32) -> Shape {
    let ears = [DVec3::new(0.4, 0.2, 1.0), DVec3::new(-0.4, 0.2, 1.0)].map(DVec3::normalize);
    star_shaped_solid(levels, |n| {
        let waves = (5.0 * n.x + 1.0).sin() * (4.0 * n.y).sin() * (6.0 * n.z + 2.0).cos();
        let ear: f64 = ears.iter().map(|e| (40.0 * (n.dot(*e) - 1.0)).exp()).sum();
        0.6 + 0.06 * waves + 0.4 * ear
    })
}

/// Returns a cube with an inverted pyramid cut into its top, of 14 triangles.
pub fn dented_cube(half: f64, depth: f64) -> Shape {
    let mut mesh = cuboid(DVec3::splat(half)).mesh;
    let top = |face: &[u32; 3]| face.iter().all(|&v| v & 4 != 0);
    mesh.faces.retain(|face| !top(face));
    mesh.vertices.push((half - depth) * DVec3::Z);
    mesh.faces
        .extend([[4, 5, 8], [5, 7, 8], [7, 6, 8], [6, 4, 8]]);
    Shape::from_closed_mesh(mesh)
}

/// Returns a solid with a cavity, as two shells of which the inner one is reversed.
pub fn hollow(outer: &Shape, inner: &Shape) -> Shape {
    let mut mesh = outer.mesh.clone();
    mesh.append(&inner.mesh.clone().with_reversed_faces());
    Shape::from_closed_mesh(mesh)
}

/// Returns two solids that do not touch as one mesh.
pub fn disjoint_solids(one: &Shape, other: &Shape) -> Shape {
    let mut mesh = one.mesh.clone();
    mesh.append(&other.mesh);
    Shape::from_closed_mesh(mesh)
}

/// Returns a divided icosahedron whose vertices are at distances from the origin given by `radius`, a function of the
/// direction.
fn star_shaped_solid(levels: u32, mut radius: impl FnMut(DVec3) -> f64) -> Shape {
    let Mesh {
        mut vertices,
        faces,
    } = icosphere(1.0, levels).mesh;
    vertices.iter_mut().for_each(|v| *v *= radius(*v));
    Shape::from_closed_mesh(Mesh { vertices, faces })
}
