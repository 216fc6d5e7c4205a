//! Makes the surfaces of simple shapes: triangles, counterclockwise from outside.

use rigid_ccd::Body;
use rigid_ccd::glam::{DVec3, dvec3};
use rigid_ccd::mesh::{MeshError, TriangleMesh};
use std::f64::consts::{PI, TAU};

/// Returns the faces of a body as triangles; the body must not have rounded pieces.
pub(crate) fn faces(body: &Body) -> Result<TriangleMesh, MeshError> {
    let pieces = body.pieces().iter();
    let corners = pieces.flat_map(|piece| {
        let triangles = piece.mesh_triangles().map(|(_, corners)| corners);
        triangles.collect::<Vec<_>>()
    });
    let vertices: Vec<DVec3> = corners.flatten().collect();
    let faces = (0..vertices.len() as u32 / 3).map(|face| [0, 1, 2].map(|k| 3 * face + k));
    let faces: Vec<[u32; 3]> = faces.collect();
    TriangleMesh::new(vertices, &faces)
}

/// Returns the surface of a capsule along z, or a ball if `half` is 0. `half` is from its centre to the centre of
/// either cap.
pub(crate) fn capsule(radius: f64, half: f64) -> Result<TriangleMesh, MeshError> {
    const DIVISIONS_AROUND: u32 = 32;
    const DIVISIONS_ALONG: u32 = 17;
    tubular_grid(
        [DIVISIONS_AROUND, DIVISIONS_ALONG, DIVISIONS_ALONG + 1],
        |[around, along]| {
            let (sine, cosine) = (TAU * around).sin_cos();
            let latitude = PI * (along - 0.5);
            let height = radius * latitude.sin() + if along < 0.5 { -half } else { half };
            let ring = radius * latitude.cos();
            dvec3(ring * cosine, ring * sine, height)
        },
    )
}

/// Returns the surface of a tube along a trefoil knot.
pub(crate) fn knot(size: f64, radius: f64) -> Result<TriangleMesh, MeshError> {
    let curve = |t: f64| {
        let ring = 2.0 + (3.0 * t).cos();
        size / 3.0
            * dvec3(
                ring * (2.0 * t).cos(),
                ring * (2.0 * t).sin(),
                (3.0 * t).sin(),
            )
    };
    tubular_grid([16, 180, 180], |[around, along]| {
        let t = TAU * along;
        let ahead = (curve(t + 1e-4) - curve(t - 1e-4)).normalize();
        let out = ahead.cross(DVec3::Z).normalize();
        let (sine, cosine) = (TAU * around).sin_cos();
        curve(t) + radius * (cosine * out + sine * ahead.cross(out))
    })
}

/// Returns a plate across x with a slot through it; `hole` has the half extents of the slot along y and z.
pub(crate) fn slotted_plate(half: [f64; 3], hole: [f64; 2]) -> Result<TriangleMesh, MeshError> {
    let ring =
        |x: f64, y: f64, z: f64| [(-y, -z), (y, -z), (y, z), (-y, z)].map(|(y, z)| dvec3(x, y, z));
    let [depth, wide, tall] = half;
    let vertices = [
        ring(-depth, wide, tall),
        ring(depth, wide, tall),
        ring(-depth, hole[0], hole[1]),
        ring(depth, hole[0], hole[1]),
    ];
    let faces = (0..4).flat_map(|k| {
        let next = (k + 1) % 4;
        [
            // Behind, in front, without, within.
            [k, 8 + k, 8 + next, next],
            [4 + k, 4 + next, 12 + next, 12 + k],
            [k, next, 4 + next, 4 + k],
            [8 + k, 12 + k, 12 + next, 8 + next],
        ]
    });
    let faces: Vec<[u32; 3]> = faces.flat_map(quad_triangles).collect();
    // The page has it in single precision.
    let vertices = vertices.concat().into_iter();
    let vertices = vertices.map(|vertex| vertex.as_vec3().as_dvec3());
    TriangleMesh::new(vertices.collect(), &faces)
}

/// Returns a tubular grid of quadrilaterals, each split into two triangles. `point` maps the fractions around and along
/// to a point. The ends are joined if there are as many rows of points as cells along.
fn tubular_grid(
    [around, along, rows]: [u32; 3],
    point: impl Fn([f64; 2]) -> DVec3,
) -> Result<TriangleMesh, MeshError> {
    let place = |row, column| {
        point([
            f64::from(column) / f64::from(around),
            f64::from(row) / f64::from(along),
        ])
    };
    let number = |row: u32, column: u32| (row % rows) * around + column % around;
    let cells = (0..along).flat_map(|row| (0..around).map(move |column| (row, column)));
    let faces = cells.flat_map(|(row, column)| {
        quad_triangles([
            number(row, column),
            number(row, column + 1),
            number(row + 1, column + 1),
            number(row + 1, column),
        ])
    });
    let spots = (0..rows).flat_map(|row| (0..around).map(move |column| (row, column)));
    // Sine and cosine may round differently elsewhere: single precision is the same everywhere.
    let vertices = spots.map(|(row, column)| place(row, column).as_vec3().as_dvec3());
    TriangleMesh::new(vertices.collect(), &faces.collect::<Vec<_>>())
}

fn quad_triangles([a, b, c, d]: [u32; 4]) -> [[u32; 3]; 2] {
    [[a, b, c], [a, c, d]]
}
