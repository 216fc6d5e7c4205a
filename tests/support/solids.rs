//! Generates random simple solids, and computes their distances by the referee's code.

use crate::models::{Mesh, cuboid};
use crate::referee::{Face, distance_squared};
use ccd_core::glam::DVec3;
use ccd_core::order::{greater, lesser};
use ccd_core::{Body, Pieces, Pose, Solidity};
use rand::RngExt;
use rand_pcg::Pcg64;

/// A simple solid: the convex hull of a few points, grown by a radius.
#[derive(Clone, Debug)]
pub enum Solid {
    /// A ball, by its radius.
    Ball(f64),
    /// A capsule along z, by its radius and half the length of its axis.
    Capsule(f64, f64),
    /// A cuboid, by its half extents.
    Cuboid(DVec3),
    /// A tetrahedron as a mesh, by its corners.
    Tetrahedron([DVec3; 4]),
    /// A cuboid as a mesh of twelve triangles, by its half extents.
    CuboidMesh(DVec3),
}

/// The vertex numbers of a tetrahedron's faces. They are counterclockwise from outside if its determinant is positive.
const TETRAHEDRON_FACES: [[u32; 3]; 4] = [[0, 2, 1], [0, 1, 3], [1, 2, 3], [0, 3, 2]];

impl Solid {
    /// Returns a random solid of size about `size`.
    pub fn draw(rng: &mut Pcg64, size: f64) -> Self {
        let mut length = || size * rng.random_range(0.05..1.0);
        let (x, y, z) = (length(), length(), length());
        match rng.random_range(0..16) {
            0..5 => Solid::Ball(x),
            5..9 => Solid::Capsule(0.5 * x, y),
            9..14 => Solid::Cuboid(DVec3::new(x, y, z)),
            14 => Solid::CuboidMesh(DVec3::new(x, y, z)),
            _ => {
                let (x, y, z) = (DVec3::X * x, DVec3::Y * y, DVec3::Z * z);
                Solid::Tetrahedron([-x - y, x - y, y - z, y + z].map(|p| p + 0.3 * (x + z)))
            }
        }
    }

    /// Builds the engine's body of the solid.
    ///
    /// # Panics
    /// If the engine refuses the body.
    pub fn body(&self) -> Body {
        let mesh = |corners: &[DVec3], faces: &[[u32; 3]]| {
            let names: Vec<_> = (0..faces.len() as u32).collect();
            let pieces = Pieces::from_triangles(corners, faces, &names).expect("a few triangles");
            Body::new(&pieces, Solidity::Solid).expect("a solid")
        };
        match *self {
            Solid::Ball(radius) => Body::sphere(radius).expect("a ball"),
            Solid::Capsule(radius, half) => Body::capsule(radius, half).expect("a capsule"),
            Solid::Cuboid(half) => Body::cuboid(half).expect("a cuboid"),
            Solid::Tetrahedron(corners) => mesh(&corners, &TETRAHEDRON_FACES),
            Solid::CuboidMesh(half) => {
                let Mesh { vertices, faces } = cuboid(half).mesh;
                mesh(&vertices, &faces)
            }
        }
    }

    /// Returns the solid at a pose.
    pub fn placed(&self, pose: &Pose) -> PlacedSolid {
        let at = |p: DVec3| pose.rotation() * p + pose.translation();
        let hull = |corners: &[DVec3], faces: &[[u32; 3]]| {
            let face = |face: &[u32; 3]| Face::new(face.map(|k| at(corners[k as usize])));
            (faces.iter().map(face).collect(), 0.0)
        };
        let (faces, radius) = match *self {
            // A point and a segment are represented as degenerate triangles.
            Solid::Ball(radius) => (vec![Face::new([at(DVec3::ZERO); 3])], radius),
            Solid::Capsule(radius, half) => {
                let core = [-half, half, half].map(|z| at(z * DVec3::Z));
                (vec![Face::new(core)], radius)
            }
            Solid::Cuboid(half) | Solid::CuboidMesh(half) => {
                let Mesh { vertices, faces } = cuboid(half).mesh;
                hull(&vertices, &faces)
            }
            Solid::Tetrahedron(corners) => hull(&corners, &TETRAHEDRON_FACES),
        };
        PlacedSolid { faces, radius }
    }
}

/// A solid at a pose, as a polyhedron grown by a radius. The faces are counterclockwise from outside. A point or a
/// segment is a degenerate polyhedron.
pub struct PlacedSolid {
    faces: Vec<Face>,
    radius: f64,
}

impl PlacedSolid {
    /// Returns the distance of two placed solids; 0 if they overlap.
    pub fn distance(&self, other: &PlacedSolid) -> f64 {
        if self.contains_first_corner(other) || other.contains_first_corner(self) {
            return 0.0;
        }
        let pairs = self.faces.iter().flat_map(|a| {
            let others = other.faces.iter();
            others.map(move |b| distance_squared(a, b))
        });
        let cores = pairs.fold(f64::INFINITY, lesser).sqrt();
        greater(0.0, cores - self.radius - other.radius)
    }

    /// Returns true if the polyhedron contains the first corner of the other one.
    fn contains_first_corner(&self, other: &PlacedSolid) -> bool {
        let [p, ..] = other.faces[0].corners;
        let below = |Face {
                         corners: [a, b, c], ..
                     }: &Face| { (*b - *a).cross(*c - *a).dot(p - *a) <= 0.0 };
        self.faces.len() > 1 && self.faces.iter().all(below)
    }
}
