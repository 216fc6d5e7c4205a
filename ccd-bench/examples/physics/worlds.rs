//! Worlds in which fast bodies pass through each other without continuous collision detection.

use crate::Method;
use crate::bunny::bunny;
use anyhow::Result;
use ccd_core::glam::DVec3;
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64;
use rapier3d_f64::prelude::{
    ColliderBuilder, PhysicsWorld, Pose as At, RigidBodyBuilder, RigidBodyHandle, Rotation,
    SharedShape, SphericalJointBuilder, Vector,
};
use rigid_ccd::Body;
use std::f64::consts::FRAC_PI_2;

/// A rapier world with its bodies, and the forces on them.
pub(crate) struct World {
    pub(crate) name: &'static str,
    pub(crate) physics: PhysicsWorld,
    pub(crate) bodies: Vec<Simulated>,
    /// The pairs of bodies joined to each other, which may overlap.
    pub(crate) joined: Vec<[usize; 2]>,
    /// The length of the thinnest part of any body, in metres.
    pub(crate) thinnest: f64,
    act: fn(&mut World, u32),
    rng: Pcg64,
}

pub(crate) struct Simulated {
    pub(crate) handle: RigidBodyHandle,
    pub(crate) body: Body,
    pub(crate) shape: SharedShape,
    pub(crate) is_fixed: bool,
}

/// The distance that rapier keeps around each body, in metres. Bodies that rest on each other are farther apart than
/// those that are stopped.
const CONTACT_SKIN: f64 = 0.002;

/// The number of steps after which the bodies are thrown again.
const STEPS_PER_ROUND: u32 = 60;

impl World {
    /// The number of different worlds.
    pub(crate) const COUNT: usize = 3;

    /// Creates a world by its number.
    pub(crate) fn new(number: usize, method: Method) -> Result<World> {
        match number {
            0 => bullets(method),
            1 => bunnies(method),
            _ => chain(method),
        }
    }

    /// Applies forces to the bodies, or throws them again, before a step.
    pub(crate) fn apply_forces(&mut self, step: u32) {
        (self.act)(self, step);
    }

    fn empty(name: &'static str, method: Method, thinnest: f64, act: fn(&mut World, u32)) -> Self {
        let mut physics = PhysicsWorld::new();
        physics.gravity = -9.81 * Vector::Z;
        if method != Method::Rapier {
            physics.integration_parameters.max_ccd_substeps = 0;
        }
        World {
            name,
            physics,
            bodies: Vec::new(),
            joined: Vec::new(),
            thinnest,
            act,
            rng: Pcg64::seed_from_u64(3),
        }
    }

    fn add(&mut self, builder: RigidBodyBuilder, shape: SharedShape, body: Body) -> usize {
        let collider = ColliderBuilder::new(shape.clone()).contact_skin(CONTACT_SKIN);
        let (handle, _) = self.physics.insert(builder, collider);
        self.bodies.push(Simulated {
            handle,
            body,
            shape,
            is_fixed: self.physics.bodies[handle].is_fixed(),
        });
        self.bodies.len() - 1
    }

    fn slab(&mut self, place: DVec3, half: DVec3) -> Result<()> {
        let shape = SharedShape::cuboid(half.x, half.y, half.z);
        let fixed = RigidBodyBuilder::fixed().translation(vector(place));
        self.add(fixed, shape, Body::cuboid(half)?);
        Ok(())
    }

    fn any(&mut self) -> DVec3 {
        DVec3::from_array(std::array::from_fn(|_| self.rng.random_range(-1.0..1.0)))
    }

    /// Places a body, and sets its velocity.
    fn throw(&mut self, index: usize, place: DVec3, velocity: DVec3) {
        let (turn, spin) = (3.0 * self.any(), 5.0 * self.any());
        let body = &mut self.physics.bodies[self.bodies[index].handle];
        body.set_translation(vector(place), true);
        body.set_rotation(Rotation::from_scaled_axis(vector(turn)), true);
        body.set_linvel(vector(velocity), true);
        body.set_angvel(vector(spin), true);
    }
}

fn vector(v: DVec3) -> Vector {
    Vector::from_array(v.to_array())
}

fn dynamic(method: Method) -> RigidBodyBuilder {
    RigidBodyBuilder::dynamic()
        .ccd_enabled(method == Method::Rapier)
        .can_sleep(false)
}

/// The number of sheets of paper, which are 1 mm thick.
const SHEETS: usize = 5;

/// Creates twelve bullets at 100 to 390 metres a second, aimed at five sheets of paper.
fn bullets(method: Method) -> Result<World> {
    let mut world = World::empty("bullets and paper", method, 0.001, |world, step| {
        for index in SHEETS..world.bodies.len() {
            // One after the other.
            if step % STEPS_PER_ROUND == 3 * (index - SHEETS) as u32 {
                let aside = 0.4 * world.any();
                let speed = world.rng.random_range(100.0..390.0);
                let place = DVec3::new(-2.0, aside.y, aside.z);
                world.throw(index, place, DVec3::new(speed, 0.02 * speed * aside.x, 0.0));
            }
        }
    });
    for k in 0..SHEETS {
        world.slab(
            DVec3::new(0.3 * k as f64, 0.0, 0.0),
            DVec3::new(0.0005, 0.5, 0.5),
        )?;
    }
    for k in 0..12 {
        let aside = DVec3::new(-4.0 - 0.1 * f64::from(k), 3.0, 0.0);
        let builder = dynamic(method).translation(vector(aside));
        world.add(builder, SharedShape::ball(0.01), Body::sphere(0.01)?);
    }
    Ok(world)
}

/// Creates bunnies that are thrown at each other and at thin walls, at 40 metres a second.
fn bunnies(method: Method) -> Result<World> {
    let mut world = World::empty("bunnies onto bunnies", method, 0.01, |world, step| {
        if step % STEPS_PER_ROUND != 0 {
            return;
        }
        for index in 5..world.bodies.len() {
            let number = (index - 5) as f64;
            let place = DVec3::new(
                0.8 * (number % 3.0) - 0.8,
                0.8 * (number / 3.0).floor() - 1.2,
                1.5,
            );
            let place = place + 0.05 * world.any();
            let velocity =
                -40.0 * (place - DVec3::new(0.0, 0.0, 0.4)).normalize() + 5.0 * world.any();
            world.throw(index, place, velocity);
        }
    });
    world.slab(DVec3::new(0.0, 0.0, -0.005), DVec3::new(2.0, 2.0, 0.005))?;
    for (x, y) in [(1.0, 0.0), (-1.0, 0.0), (0.0, 1.0), (0.0, -1.0)] {
        let half = DVec3::new(
            if x == 0.0 { 2.0 } else { 0.005 },
            if y == 0.0 { 2.0 } else { 0.005 },
            1.0,
        );
        world.slab(DVec3::new(2.0 * x, 2.0 * y, 1.01), half)?;
    }
    let (shape, body) = bunny()?;
    for k in 0..12 {
        let aside = DVec3::new(
            0.8 * f64::from(k % 3) - 0.8,
            0.8 * f64::from(k / 3) - 1.2,
            1.5,
        );
        world.add(
            dynamic(method).translation(vector(aside)),
            shape.clone(),
            body.clone(),
        );
    }
    Ok(world)
}

/// The number of links of the chain.
const LINKS: usize = 14;
/// Half the length of a link, in metres.
const HALF: f64 = 0.06;

/// Creates a chain of fourteen links that is drawn through a slot between two plates, and back, and then placed anew.
fn chain(method: Method) -> Result<World> {
    let mut world = World::empty("chain through a slot", method, 0.004, |world, step| {
        if step.is_multiple_of(4 * STEPS_PER_ROUND) {
            (0..LINKS).for_each(|link| world.lay_out(link));
        }
        let is_back = !(step / STEPS_PER_ROUND).is_multiple_of(2);
        let towards = if is_back { -1.0 } else { 1.0 };
        let aside = 3.0 * world.any();
        let first = &mut world.physics.bodies[world.bodies[2].handle];
        let ahead = first.translation().x * towards;
        let speed = if ahead < 2.0 { 30.0 } else { 0.0 };
        first.set_linvel(Vector::new(towards * speed, aside.y, aside.z), true);
    });
    for side in [-1.0, 1.0] {
        let half = DVec3::new(0.002, 1.0, 2.0);
        world.slab(DVec3::new(0.0, side * 1.04, 0.0), half)?;
    }
    for link in 0..LINKS {
        let shape = SharedShape::capsule_z(HALF, 0.02);
        let index = world.add(dynamic(method), shape, Body::capsule(0.02, HALF)?);
        world.lay_out(link);
        if link > 0 {
            let joint = SphericalJointBuilder::new()
                .local_anchor1(-1.25 * HALF * Vector::Z)
                .local_anchor2(1.25 * HALF * Vector::Z)
                .contacts_enabled(false);
            let [before, this] = [index - 1, index].map(|index| world.bodies[index].handle);
            world.physics.insert_impulse_joint(before, this, joint);
            world.joined.push([index - 1, index]);
        }
    }
    Ok(world)
}

impl World {
    /// Returns a link of the chain to its start, at rest.
    fn lay_out(&mut self, link: usize) {
        let body = &mut self.physics.bodies[self.bodies[2 + link].handle];
        let place = Vector::new(-0.2 - 2.5 * HALF * link as f64, 0.0, 0.0);
        let lying = FRAC_PI_2 * Vector::Y;
        let at = At::from_parts(place, Rotation::from_scaled_axis(lying));
        body.set_position(at, true);
        body.set_linvel(Vector::ZERO, true);
        body.set_angvel(Vector::ZERO, true);
    }
}
