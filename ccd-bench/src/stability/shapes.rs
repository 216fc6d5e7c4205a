//! The bodies of the families.

use crate::scene::model::sphere::sphere;
use crate::scene::model::{Board, Plate, Ring};
use ccd_core::glam::{DVec3, dvec3};
use ccd_decomp::{MeshError, TriangleMesh};
use std::f64::consts::TAU;

/// Returns a box about the origin, by half its extents.
pub(super) fn cuboid(x: f64, y: f64, z: f64) -> Result<TriangleMesh, MeshError> {
    Board {
        half_extents: dvec3(x, y, z),
    }
    .mesh()
}

/// Returns a mesh with its origin elsewhere.
pub(super) fn moved(mesh: &TriangleMesh, by: DVec3) -> Result<TriangleMesh, MeshError> {
    let vertices = mesh.vertices().iter().map(|&p| p + by).collect();
    TriangleMesh::new(vertices, mesh.faces())
}

/// Returns a cube of side 1 about the origin.
pub(super) fn cube() -> Result<TriangleMesh, MeshError> {
    cuboid(0.5, 0.5, 0.5)
}

/// Returns a wide box whose top is at z = 1 and contains all that falls here.
pub(super) fn slab() -> Result<TriangleMesh, MeshError> {
    cuboid(9.0, 9.0, 1.0)
}

/// Returns a ball about the origin with corners at its poles.
pub(super) fn ball(radius: f64, vertices: usize) -> Result<TriangleMesh, MeshError> {
    let (points, faces) = sphere(vertices);
    TriangleMesh::new(points.into_iter().map(|p| radius * p).collect(), &faces)
}

/// Returns an open square across z.
pub(super) fn sheet(half_side: f64) -> Result<TriangleMesh, MeshError> {
    let squares = 4;
    Plate { half_side, squares }.mesh()
}

/// Returns a torus about z.
pub(super) fn torus(radius: f64, tube: f64) -> Result<TriangleMesh, MeshError> {
    Ring {
        segments: 64,
        sides: 24,
        radius,
        tube,
    }
    .mesh()
}

/// Returns a cone that stands on its tip at the origin, with its base at z = 1.
pub(super) fn cone(sides: u32, radius: f64) -> Result<TriangleMesh, MeshError> {
    let rim = |k: u32| {
        let (sin, cos) = (TAU * f64::from(k) / f64::from(sides)).sin_cos();
        dvec3(radius * cos, radius * sin, 1.0)
    };
    let mut vertices = vec![DVec3::ZERO, DVec3::Z];
    vertices.extend((0..sides).map(rim));
    let at = |k: u32| 2 + k % sides;
    let faces = (0..sides).flat_map(|k| [[0, at(k + 1), at(k)], [1, at(k), at(k + 1)]]);
    TriangleMesh::new(vertices, &faces.collect::<Vec<_>>())
}

/// The width of a comb's tooth, as a share of the step from tooth to tooth.
pub(super) const TOOTH: f64 = 0.4;

/// Returns a comb of depth 1 along y: a bar from z = 0 to 1 below teeth that reach to z = 2. The first tooth
/// begins at x = 0, and the steps from tooth to tooth add up to 1.
pub(super) fn comb(teeth: u32) -> Result<TriangleMesh, MeshError> {
    let columns = 2 * teeth - 1;
    let x = |k: u32| (f64::from(k / 2) + TOOTH * f64::from(k % 2)) / f64::from(teeth);
    // Corners of the outline at column border k: at heights 0, 1 and 2, in front and behind.
    let corner = |k: u32, height: u32, back: u32| (k * 3 + height) * 2 + back;
    let vertices = (0..=columns).flat_map(|k| {
        [(0, 0), (0, 1), (1, 0), (1, 1), (2, 0), (2, 1)]
            .map(|(height, back)| dvec3(x(k), f64::from(back), f64::from(height)))
    });
    let mut faces = Vec::new();
    let mut quad = |[a, b, c, d]: [u32; 4]| faces.extend([[a, b, c], [a, c, d]]);
    for k in 0..columns {
        let at = |side: u32, height: u32, back: u32| corner(k + side, height, back);
        let levels = if k % 2 == 0 { 2 } else { 1 };
        for low in 0..levels {
            let high = low + 1;
            quad([at(0, low, 0), at(1, low, 0), at(1, high, 0), at(0, high, 0)]);
            quad([at(1, low, 1), at(0, low, 1), at(0, high, 1), at(1, high, 1)]);
        }
        quad([at(0, 0, 1), at(1, 0, 1), at(1, 0, 0), at(0, 0, 0)]);
        quad([
            at(0, levels, 0),
            at(1, levels, 0),
            at(1, levels, 1),
            at(0, levels, 1),
        ]);
        if k % 2 == 0 {
            // The flanks of a tooth; at the ends of the comb, those of the bar below it too.
            quad([at(0, 1, 1), at(0, 1, 0), at(0, 2, 0), at(0, 2, 1)]);
            quad([at(1, 1, 0), at(1, 1, 1), at(1, 2, 1), at(1, 2, 0)]);
        }
        if k == 0 {
            quad([at(0, 0, 1), at(0, 0, 0), at(0, 1, 0), at(0, 1, 1)]);
        }
        if k + 1 == columns {
            quad([at(1, 0, 0), at(1, 0, 1), at(1, 1, 1), at(1, 1, 0)]);
        }
    }
    TriangleMesh::new(vertices.collect(), &faces)
}

/// Returns a plate from z = −0.1 to 0.1 that reaches to 3, with a square hole about the origin.
pub(super) fn holed_plate(hole: f64) -> Result<TriangleMesh, MeshError> {
    let corners = [(1.0, 1.0), (-1.0, 1.0), (-1.0, -1.0), (1.0, -1.0)];
    // Four rings of four: the hole below and above, the rim below and above.
    let rings = [(hole, -0.1), (hole, 0.1), (3.0, -0.1), (3.0, 0.1)];
    let ring = |(half, z): (f64, f64)| corners.map(|(x, y)| dvec3(half * x, half * y, z));
    let vertices = rings.map(ring).concat();
    let mut faces = Vec::new();
    for k in 0..4 {
        let at = |ring: u32, next: u32| 4 * ring + (k + next) % 4;
        for [from, to] in [[0, 1], [1, 3], [3, 2], [2, 0]] {
            let [a, b, c, d] = [at(from, 0), at(to, 0), at(to, 1), at(from, 1)];
            faces.extend([[a, b, c], [a, c, d]]);
        }
    }
    TriangleMesh::new(vertices, &faces)
}

/// Returns open squares across z, the highest at z = 0, the lowest at z = −0.5.
pub(super) fn layers(count: u32) -> Result<TriangleMesh, MeshError> {
    let step = 0.5 / f64::from(count);
    let corners = [(1.0, 1.0), (-1.0, 1.0), (-1.0, -1.0), (1.0, -1.0)];
    let square = |k: u32| corners.map(|(x, y)| dvec3(x, y, -step * f64::from(k)));
    let vertices: Vec<DVec3> = (0..count).flat_map(square).collect();
    let faces = (0..count).flat_map(|k| [[0, 1, 2], [0, 2, 3]].map(|face| face.map(|v| 4 * k + v)));
    TriangleMesh::new(vertices, &faces.collect::<Vec<_>>())
}

/// Returns a mesh with some of its faces repeated, every other time turned over, and as many without area.
pub(super) fn with_bad_faces(mesh: &TriangleMesh, count: usize) -> Result<TriangleMesh, MeshError> {
    let mut faces = mesh.faces().to_vec();
    let repeated: Vec<[u32; 3]> = faces.iter().copied().cycle().take(count).collect();
    for (k, [a, b, c]) in repeated.into_iter().enumerate() {
        faces.extend([if k % 2 == 0 { [a, b, c] } else { [a, c, b] }, [a, b, a]]);
    }
    TriangleMesh::new(mesh.vertices().to_vec(), &faces)
}

#[cfg(test)]
mod tests {
    use super::*;
    use ccd_decomp::Topology;

    #[test]
    fn bodies_are_closed_and_of_the_volume_that_they_should_have() {
        let third = std::f64::consts::PI / 3.0;
        let cases = [
            (cuboid(1.0, 2.0, 3.0), 48.0, 1e-12),
            (ball(1.0, 5000), 4.0 * third, 0.01),
            (cone(300, 1.0), third, 0.001),
            // The bar ends with the last tooth.
            (comb(3), 1.0 - 0.2 + 0.4, 1e-12),
            (holed_plate(0.5), 0.2 * (36.0 - 1.0), 1e-12),
            (comb(64), 1.0 - 0.6 / 64.0 + 0.4, 1e-12),
        ];
        for (mesh, volume, slack) in cases {
            let topology = Topology::of(&mesh.unwrap());
            assert!(topology.is_solid() && topology.is_manifold(), "{topology}");
            assert!(
                (topology.signed_volume - volume).abs() <= slack,
                "{volume}: {topology:?}"
            );
        }
    }

    #[test]
    fn bad_faces_are_repaired_or_kept_without_moving_the_surface() {
        let cube = cuboid(0.5, 0.5, 0.5).unwrap();
        let bad = with_bad_faces(&cube, 30).unwrap();
        assert_eq!(bad.vertices(), cube.vertices());
        let repairs = bad.repairs();
        assert!(!repairs.collapsed.is_empty() && !repairs.duplicates.is_empty());
    }
}
