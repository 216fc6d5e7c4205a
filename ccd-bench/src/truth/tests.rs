mod distances;
mod enclosures;
mod exact;
mod intervals;
mod sampled;
mod tables;

use super::{Surface, Truth, TruthSolver};
use crate::scene::model;
use ccd_core::glam::{DQuat, DVec3};
use ccd_core::{Motion, Pose};
use ccd_decomp::TriangleMesh;
use ccd_tables::motions::Motions;
use rand::{Rng, RngExt};

/// Returns the surface of a box about the origin with the given half extents.
fn cuboid(x: f64, y: f64, z: f64) -> Surface {
    Surface::new(&model::cuboid(x, y, z).unwrap())
}

fn still_motion(x: f64, y: f64, z: f64) -> Motion {
    Motion::still(pose_at(DVec3::new(x, y, z), DQuat::IDENTITY))
}

fn pose_at(position: DVec3, rotation: DQuat) -> Pose {
    Pose::new(position, rotation).unwrap()
}

fn query(a: Motion, b: Motion, duration: f64) -> Motions {
    Motions {
        id: "query".to_owned(),
        a,
        b,
        duration,
    }
}

fn judge([a, b]: [&Surface; 2], query: &Motions) -> Truth {
    TruthSolver::new(a, b).first_contact(query)
}

fn random_vector(rng: &mut impl Rng, reach: f64) -> DVec3 {
    let mut coordinate = || rng.random_range(-reach..reach);
    DVec3::new(coordinate(), coordinate(), coordinate())
}

/// Returns random triangles in a cube, which may intersect each other.
fn triangle_soup(rng: &mut impl Rng, triangles: u32) -> TriangleMesh {
    let vertices = (0..3 * triangles).map(|_| random_vector(rng, 1.0));
    let faces: Vec<_> = (0..triangles)
        .map(|i| [3 * i, 3 * i + 1, 3 * i + 2])
        .collect();
    TriangleMesh::new(vertices.collect(), &faces).unwrap()
}

fn random_motion(rng: &mut impl Rng, from: DVec3, velocity: DVec3, spin: f64) -> Motion {
    let turn = DQuat::from_scaled_axis(random_vector(rng, 3.0));
    let spin = random_vector(rng, spin);
    Motion::about(pose_at(from, turn), velocity, spin, random_vector(rng, 0.5)).unwrap()
}
