//! Small solids whose distances are a few lines of arithmetic, which nothing else uses.

use crate::models::{Mesh, cuboid};
use crate::referee::{edge_edge_squared, pierces, point_segment, point_triangle};
use ccd_core::glam::DVec3;
use ccd_core::order::lesser;
use ccd_core::{Body, Pieces, Pose, Volume};
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
const SIDES: [[u32; 3]; 4] = [[0, 2, 1], [0, 1, 3], [1, 2, 3], [0, 3, 2]];

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
        let mesh = |corners: &[DVec3], faces: &[[u32; 3]]| {
            let names: Vec<_> = (0..faces.len() as u32).collect();
            let pieces = Pieces::triangles(corners, faces, &names).expect("a few triangles");
            Body::new(&pieces, Volume::Solid).expect("a solid")
        };
        match *self {
            Solid::Ball(radius) => Body::ball(radius).expect("a ball"),
            Solid::Capsule(radius, half) => Body::capsule(radius, half).expect("a capsule"),
            Solid::Cuboid(half) => Body::cuboid(half).expect("a cuboid"),
            Solid::Tetrahedron(corners) => mesh(&corners, &SIDES),
            Solid::Crate(half) => {
                let Mesh { vertices, faces } = cuboid(half).mesh;
                mesh(&vertices, &faces)
            }
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
                let Mesh { vertices, faces } = cuboid(half).mesh;
                let corners: Vec<DVec3> = vertices.into_iter().map(at).collect();
                Placed::Hull(Hull::new(&corners, &faces))
            }
            Solid::Tetrahedron(corners) => Placed::Hull(Hull::new(&corners.map(at), &SIDES)),
        }
    }
}

/// A solid in its place.
#[derive(Clone, Debug)]
pub enum Placed {
    /// A segment, or a point twice, grown by a radius.
    Rod([DVec3; 2], f64),
    /// A polytope.
    Hull(Hull),
}

/// A convex solid: its corners, its edges, and its faces, counterclockwise from outside.
#[derive(Clone, Debug)]
pub struct Hull {
    corners: Vec<DVec3>,
    edges: Vec<[DVec3; 2]>,
    faces: Vec<[DVec3; 3]>,
}

impl Hull {
    fn new(corners: &[DVec3], faces: &[[u32; 3]]) -> Self {
        let sides = faces.iter().flat_map(|&[a, b, c]| [[a, b], [b, c], [c, a]]);
        // Each edge is a side of two faces, once each way.
        let edges = sides.filter(|[a, b]| a < b);
        Hull {
            edges: edges
                .map(|edge| edge.map(|k| corners[k as usize]))
                .collect(),
            faces: faces
                .iter()
                .map(|face| face.map(|k| corners[k as usize]))
                .collect(),
            corners: corners.to_vec(),
        }
    }

    fn contains(&self, p: DVec3) -> bool {
        let height = |[a, b, c]: &[DVec3; 3]| (*b - *a).cross(*c - *a).dot(p - *a);
        self.faces.iter().all(|face| height(face) <= 0.0)
    }

    fn to_point(&self, p: DVec3) -> f64 {
        let to = self
            .faces
            .iter()
            .map(|face| point_triangle(p, *face).distance(p));
        to.fold(f64::INFINITY, lesser)
    }

    fn to_edge(&self, edge: [DVec3; 2]) -> f64 {
        let to = self.edges.iter().map(|own| edge_edge(*own, edge));
        to.fold(f64::INFINITY, lesser)
    }

    fn is_pierced(&self, edge: [DVec3; 2]) -> bool {
        self.faces.iter().any(|face| pierces(edge, *face))
    }
}

impl Placed {
    /// Returns the distance of two solids; 0 if they overlap.
    pub fn distance(&self, other: &Placed) -> f64 {
        let apart = match (self, other) {
            (Placed::Rod(p, r), Placed::Rod(q, s)) => edge_edge(*p, *q) - r - s,
            (Placed::Rod(core, radius), Placed::Hull(hull))
            | (Placed::Hull(hull), Placed::Rod(core, radius)) => rod_hull(*core, hull) - radius,
            (Placed::Hull(a), Placed::Hull(b)) => hull_hull(a, b),
        };
        if apart > 0.0 { apart } else { 0.0 }
    }
}

fn rod_hull(core: [DVec3; 2], hull: &Hull) -> f64 {
    if hull.contains(core[0]) || hull.is_pierced(core) {
        return 0.0;
    }
    let [first, last] = core.map(|p| hull.to_point(p));
    lesser(hull.to_edge(core), lesser(first, last))
}

fn hull_hull(a: &Hull, b: &Hull) -> f64 {
    let pierced = |one: &Hull, other: &Hull| {
        let mut edges = other.edges.iter();
        one.contains(other.corners[0]) || edges.any(|edge| one.is_pierced(*edge))
    };
    if pierced(a, b) || pierced(b, a) {
        return 0.0;
    }
    let edges = a.edges.iter().map(|edge| b.to_edge(*edge));
    let points = a.corners.iter().map(|p| b.to_point(*p));
    let back = b.corners.iter().map(|p| a.to_point(*p));
    edges.chain(points).chain(back).fold(f64::INFINITY, lesser)
}

fn edge_edge(e: [DVec3; 2], f: [DVec3; 2]) -> f64 {
    match (e[0] == e[1], f[0] == f[1]) {
        (true, true) => e[0].distance(f[0]),
        (true, false) => point_segment(e[0], f).distance(e[0]),
        (false, true) => point_segment(f[0], e).distance(f[0]),
        (false, false) => edge_edge_squared(e, f).sqrt(),
    }
}
