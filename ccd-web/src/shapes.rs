//! Makes the surfaces of simple shapes.

use rigid_ccd::Body;
use rigid_ccd::glam::{DVec3, dvec3};
use std::f64::consts::{PI, TAU};

/// The triangles of a surface, counterclockwise from outside.
#[derive(Clone, Debug)]
pub(crate) struct Surface {
    pub(crate) vertices: Vec<DVec3>,
    pub(crate) faces: Vec<[u32; 3]>,
}

/// Returns the faces of a body without rounded pieces.
pub(crate) fn faces(body: &Body) -> Surface {
    let pieces = body.pieces().iter();
    let corners = pieces.flat_map(|piece| {
        let triangles = piece.mesh_triangles().map(|(_, corners)| corners);
        triangles.collect::<Vec<_>>()
    });
    let vertices: Vec<DVec3> = corners.flatten().collect();
    let faces = (0..vertices.len() as u32 / 3).map(|face| [0, 1, 2].map(|k| 3 * face + k));
    Surface {
        faces: faces.collect(),
        vertices,
    }
}

/// Returns the surface of a capsule along z, or a ball if `half` is 0. `half` is from its centre to the centre of
/// either cap.
pub(crate) fn capsule(radius: f64, half: f64) -> Surface {
    const AROUND: u32 = 32;
    const ALONG: u32 = 17;
    sheet([AROUND, ALONG], Ends::Open, |[around, along]| {
        let (sine, cosine) = (TAU * around).sin_cos();
        let latitude = PI * (along - 0.5);
        let height = radius * latitude.sin() + if along < 0.5 { -half } else { half };
        let ring = radius * latitude.cos();
        dvec3(ring * cosine, ring * sine, height)
    })
}

/// Returns the surface of a tube along a trefoil knot.
pub(crate) fn knot(size: f64, radius: f64) -> Surface {
    let curve = |t: f64| {
        let ring = 2.0 + (3.0 * t).cos();
        size / 3.0
            * dvec3(
                ring * (2.0 * t).cos(),
                ring * (2.0 * t).sin(),
                (3.0 * t).sin(),
            )
    };
    sheet([16, 180], Ends::Joined, |[around, along]| {
        let t = TAU * along;
        let ahead = (curve(t + 1e-4) - curve(t - 1e-4)).normalize();
        let out = ahead.cross(DVec3::Z).normalize();
        let (sine, cosine) = (TAU * around).sin_cos();
        curve(t) + radius * (cosine * out + sine * ahead.cross(out))
    })
}

/// Returns a plate across x with a slot, whose half extents are along y and z.
pub(crate) fn slot(half: [f64; 3], hole: [f64; 2]) -> Surface {
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
    Surface {
        vertices: vertices.concat(),
        faces: faces.flat_map(halves).collect(),
    }
}

/// Whether the ends of a tube are joined to each other or left open.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Ends {
    Joined,
    Open,
}

/// Returns a tubular grid of quadrilaterals, each split into two triangles. `point` maps the fractions around and along
/// to a point.
fn sheet([around, along]: [u32; 2], ends: Ends, point: impl Fn([f64; 2]) -> DVec3) -> Surface {
    let rows = match ends {
        Ends::Joined => along,
        Ends::Open => along + 1,
    };
    let place = |row, column| {
        point([
            f64::from(column) / f64::from(around),
            f64::from(row) / f64::from(along),
        ])
    };
    let number = |row: u32, column: u32| (row % rows) * around + column % around;
    let cells = (0..along).flat_map(|row| (0..around).map(move |column| (row, column)));
    let faces = cells.flat_map(|(row, column)| {
        halves([
            number(row, column),
            number(row, column + 1),
            number(row + 1, column + 1),
            number(row + 1, column),
        ])
    });
    Surface {
        vertices: (0..rows)
            .flat_map(|row| (0..around).map(move |column| (row, column)))
            // Sine and cosine may round differently elsewhere: single precision is the same everywhere.
            .map(|(row, column)| place(row, column).as_vec3().as_dvec3())
            .collect(),
        faces: faces.collect(),
    }
}

fn halves([a, b, c, d]: [u32; 4]) -> [[u32; 3]; 2] {
    [[a, b, c], [a, c, d]]
}
