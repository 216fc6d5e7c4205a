//! Simulates falling bodies with rapier.

use crate::rounded;
use anyhow::{Context, Result};
use ccd_core::glam::{DQuat, DVec3};
use ccd_decomp::TriangleMesh;
use rand::{Rng, RngExt};
use rapier3d_f64::prelude::{
    ColliderBuilder, PhysicsWorld, Pose as At, RigidBodyBuilder, RigidBodyHandle, Rotation,
    SharedShape, Vector,
};
use std::f64::consts::TAU;

/// The number of steps in which the lower body comes to rest.
const SETTLING_STEPS: usize = 180;
/// The number of steps of a fall and its aftermath: two and a half seconds.
const FALL_STEPS: usize = 150;
/// The height at which the falling body starts.
const HEIGHT: f64 = 3.2;
/// The largest offset of the falling body from the vertical through the resting one.
const ASIDE: f64 = 0.7;
/// The largest initial spin, in radians per second.
const SPIN: f64 = 8.0;
/// The margin around the parts that the simulation keeps free, so that the meshes do not touch in
/// its poses.
const SKIN: f64 = 0.01;
/// The poses of both bodies after each step; the first entry is the initial state.
pub(crate) struct Simulated {
    pub(crate) poses: Vec<[At; 2]>,
    /// The centre of mass, in each body's own frame.
    pub(crate) centre: DVec3,
}

/// Simulates one drop.
pub(crate) fn simulate(shape: &SharedShape, rng: &mut impl Rng) -> Simulated {
    let mut world = PhysicsWorld::new();
    world.gravity = Vector::Z * -9.81;
    let ground = ColliderBuilder::cuboid(20.0, 20.0, 1.0).translation(Vector::Z * -1.0);
    world.insert_collider(ground, None);
    let flat = At::from_parts(Vector::Z * 1.3, rotation(orientation(rng)));
    let lower = insert(&mut world, shape, RigidBodyBuilder::dynamic().pose(flat));
    for _ in 0..SETTLING_STEPS {
        world.step();
    }
    let lies = world.bodies[lower].position().translation;
    let aside = [0; 2].map(|_| rng.random_range(-ASIDE..=ASIDE));
    let from = Vector::new(lies.x + aside[0], lies.y + aside[1], HEIGHT);
    let spin = rng.random_range(0.0..=SPIN) * unit_vector(rng);
    let falling = RigidBodyBuilder::dynamic()
        .pose(At::from_parts(from, rotation(orientation(rng))))
        .angvel(Vector::from_array(spin.to_array()));
    let upper = insert(&mut world, shape, falling);
    let poses = |world: &PhysicsWorld| [upper, lower].map(|body| *world.bodies[body].position());
    let mut recorded = vec![poses(&world)];
    for _ in 0..FALL_STEPS {
        world.step();
        recorded.push(poses(&world));
    }
    let centre = world.bodies[upper].mass_properties().local_mprops.local_com;
    Simulated {
        poses: recorded,
        centre: rounded(DVec3::from_array(centre.to_array())),
    }
}

fn insert(
    world: &mut PhysicsWorld,
    shape: &SharedShape,
    body: RigidBodyBuilder,
) -> RigidBodyHandle {
    let collider = ColliderBuilder::new(shape.clone()).contact_skin(SKIN);
    world.insert(body, collider).0
}

/// Returns the convex parts that rapier's own decomposition makes of a mesh.
pub(crate) fn convex_parts(mesh: &TriangleMesh) -> Result<SharedShape> {
    let vertices: Vec<Vector> = mesh.vertices().iter().map(|&v| vector(v)).collect();
    Ok(SharedShape::convex_decomposition(&vertices, mesh.faces()))
}

/// Returns the hulls of the parts of a mesh in each of many sectors about the z axis, the axis of a
/// ring.
pub(crate) fn sectors(mesh: &TriangleMesh) -> Result<SharedShape> {
    const SECTORS: usize = 24;
    /// Sectors overlap, so that there is no gap between them.
    const OVERLAP: f64 = 0.1;
    let width = TAU / SECTORS as f64;
    let hull = |k: usize| {
        let middle = (k as f64 + 0.5) * width;
        let within = |v: &DVec3| {
            let off = (v.y.atan2(v.x) - middle + 1.5 * TAU).rem_euclid(TAU) - 0.5 * TAU;
            off.abs() <= (0.5 + OVERLAP) * width
        };
        let points: Vec<Vector> = mesh
            .vertices()
            .iter()
            .filter(|v| within(v))
            .map(|&v| vector(v))
            .collect();
        SharedShape::convex_hull(&points).context("a sector of the ring is flat")
    };
    let parts = (0..SECTORS).map(|k| Ok((At::IDENTITY, hull(k)?)));
    Ok(SharedShape::compound(parts.collect::<Result<_>>()?))
}

fn vector(v: DVec3) -> Vector {
    Vector::from_array(v.to_array())
}

fn rotation(q: DQuat) -> Rotation {
    Rotation::from_array(q.to_array())
}

/// Returns a uniformly distributed orientation.
fn orientation(rng: &mut impl Rng) -> DQuat {
    loop {
        let q = [0; 4].map(|_| rng.random_range(-1.0..=1.0));
        let length = DQuat::from_array(q).length();
        if (0.1..=1.0).contains(&length) {
            return DQuat::from_array(q).normalize();
        }
    }
}

/// Returns a uniformly distributed direction.
fn unit_vector(rng: &mut impl Rng) -> DVec3 {
    orientation(rng) * DVec3::Z
}
