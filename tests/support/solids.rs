//! Small solids whose distances are a few lines of arithmetic, which nothing else uses.

use crate::models::{Kind, Mesh, Shape};
use crate::referee::{edge_edge_squared, pierces, point_segment, point_triangle};
use ccd_core::glam::DVec3;
use ccd_core::order::lesser;
use ccd_core::{Body, Pose};
use rand::RngExt;
use rand_pcg::Pcg64;

/// A solid: the hull of a few points, grown by a radius.
#[derive(Clone, Debug)]
pub enum Solid {
    /// A ball of a radius.
    Ball(f64),
    /// A capsule along z: its radius, and half of its core's length.
    Capsule(f64, f64),
    /// A cuboid of half extents.
    Cuboid(DVec3),
    /// A tetrahedron as a mesh.
    Tetrahedron([DVec3; 4]),
    /// A cuboid of half extents, as a mesh of twelve triangles.
    Crate(DVec3),
}

/// The corners of the faces of a tetrahedron, from outside counterclockwise if its determinant is positive.
const SIDES: [[usize; 3]; 4] = [[0, 2, 1], [0, 1, 3], [1, 2, 3], [0, 3, 2]];

/// The corners of the faces of a cuboid; corner `k` is on the positive side of x, y and z where bit 0, 1 and 2 of
/// `k` are set.
const CRATE: [[usize; 3]; 12] = [
    [0, 2, 3],
    [0, 3, 1],
    [4, 5, 7],
    [4, 7, 6],
    [0, 1, 5],
    [0, 5, 4],
    [2, 6, 7],
    [2, 7, 3],
    [0, 4, 6],
    [0, 6, 2],
    [1, 3, 7],
    [1, 7, 5],
];

impl Solid {
    /// Draws a solid about as large as `size`.
    pub fn draw(rng: &mut Pcg64, size: f64) -> Self {
        let mut length = || size * rng.random_range(0.05..1.0);
        let (x, y, z) = (length(), length(), length());
        match rng.random_range(0..16) {
            0..5 => Solid::Ball(x),
            5..9 => Solid::Capsule(0.5 * x, y),
            9..14 => Solid::Cuboid(DVec3::new(x, y, z)),
            14 => Solid::Crate(DVec3::new(x, y, z)),
            _ => {
                let (x, y, z) = (DVec3::X * x, DVec3::Y * y, DVec3::Z * z);
                Solid::Tetrahedron([-x - y, x - y, y - z, y + z].map(|p| p + 0.3 * (x + z)))
            }
        }
    }

    /// Makes the body.
    ///
    /// # Panics
    /// If the engine refuses it.
    pub fn body(&self) -> Body {
        let mesh = |corners: &[DVec3], faces: &[[usize; 3]]| {
            let faces = faces.iter().map(|face| face.map(|k| k as u32));
            let mesh = Mesh {
                vertices: corners.to_vec(),
                faces: faces.collect(),
            };
            Shape::closed(mesh).body(Kind::Triangles)
        };
        match *self {
            Solid::Ball(radius) => Body::ball(radius).expect("a ball"),
            Solid::Capsule(radius, half) => Body::capsule(radius, half).expect("a capsule"),
            Solid::Cuboid(half) => Body::cuboid(half).expect("a cuboid"),
            Solid::Tetrahedron(corners) => mesh(&corners, &SIDES),
            Solid::Crate(half) => mesh(&corners_of(half), &CRATE),
        }
    }

    /// Returns the solid in its place.
    pub fn placed(&self, pose: &Pose) -> Placed {
        let at = |p: DVec3| pose.rotation() * p + pose.translation();
        match *self {
            Solid::Ball(radius) => Placed::Rod([at(DVec3::ZERO); 2], radius),
            Solid::Capsule(radius, half) => {
                Placed::Rod([-half, half].map(|z| at(z * DVec3::Z)), radius)
            }
            Solid::Cuboid(half) | Solid::Crate(half) => {
                let corners = corners_of(half).map(at);
                Placed::Faces(CRATE.map(|face| face.map(|k| corners[k])).to_vec())
            }
            Solid::Tetrahedron(corners) => {
                let corners = corners.map(at);
                Placed::Faces(SIDES.map(|face| face.map(|k| corners[k])).to_vec())
            }
        }
    }
}

fn corners_of(half: DVec3) -> [DVec3; 8] {
    std::array::from_fn(|k| {
        let sign = |axis: usize| if k >> axis & 1 == 1 { 1.0 } else { -1.0 };
        half * DVec3::new(sign(0), sign(1), sign(2))
    })
}

/// A solid in its place.
#[derive(Clone, Debug)]
pub enum Placed {
    /// A segment, or a point twice, grown by a radius.
    Rod([DVec3; 2], f64),
    /// The faces of a convex solid, counterclockwise from outside.
    Faces(Vec<[DVec3; 3]>),
}

impl Placed {
    /// Returns the distance of two solids; 0 if they overlap.
    pub fn distance(&self, other: &Placed) -> f64 {
        let apart = match (self, other) {
            (Placed::Rod(p, r), Placed::Rod(q, s)) => edge_edge(*p, *q) - r - s,
            (Placed::Rod(core, radius), Placed::Faces(faces))
            | (Placed::Faces(faces), Placed::Rod(core, radius)) => {
                let inside = core.iter().any(|p| is_inside(*p, faces));
                let to = faces.iter().map(|face| edge_face(*core, *face));
                to.fold(f64::INFINITY, lesser) * f64::from(u8::from(!inside)) - radius
            }
            (Placed::Faces(a), Placed::Faces(b)) => {
                if is_inside(a[0][0], b) || is_inside(b[0][0], a) {
                    return 0.0;
                }
                let pairs = a.iter().flat_map(|x| b.iter().map(move |y| (x, y)));
                pairs
                    .map(|(x, y)| face_face(*x, *y))
                    .fold(f64::INFINITY, lesser)
            }
        };
        if apart > 0.0 { apart } else { 0.0 }
    }
}

fn edges([a, b, c]: [DVec3; 3]) -> [[DVec3; 2]; 3] {
    [[a, b], [b, c], [c, a]]
}

/// Returns whether a point is in a convex solid.
fn is_inside(p: DVec3, faces: &[[DVec3; 3]]) -> bool {
    let height = |[a, b, c]: &[DVec3; 3]| (*b - *a).cross(*c - *a).dot(p - *a);
    faces.iter().all(|face| height(face) <= 0.0)
}

fn edge_edge(e: [DVec3; 2], f: [DVec3; 2]) -> f64 {
    match (e[0] == e[1], f[0] == f[1]) {
        (true, true) => e[0].distance(f[0]),
        (true, false) => point_segment(e[0], f).distance(e[0]),
        (false, true) => point_segment(f[0], e).distance(f[0]),
        (false, false) => edge_edge_squared(e, f).sqrt(),
    }
}

fn edge_face(e: [DVec3; 2], face: [DVec3; 3]) -> f64 {
    if pierces(e, face) {
        return 0.0;
    }
    let ends = e.map(|p| point_triangle(p, face).distance(p));
    let sides = edges(face).map(|side| edge_edge(e, side));
    ends.into_iter().chain(sides).fold(f64::INFINITY, lesser)
}

fn face_face(a: [DVec3; 3], b: [DVec3; 3]) -> f64 {
    let one = edges(a).map(|side| edge_face(side, b));
    let other = edges(b).map(|side| edge_face(side, a));
    one.into_iter().chain(other).fold(f64::INFINITY, lesser)
}
