//! Worlds in which fast bodies pass through each other without continuous collision detection.

use anyhow::Result;
use ccd_bench::scene::model::Blob;
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64;
use rapier3d_f64::prelude::{
    ColliderBuilder, PhysicsWorld, Pose, RigidBodyBuilder, RigidBodyHandle, Rotation, SharedShape,
    SphericalJointBuilder, Vector,
};
use rigid_ccd::Body;
use rigid_ccd_parry::Options;
use rigid_ccd_parry::f64::body;
use std::f64::consts::FRAC_PI_2;

/// A rapier world with its bodies, and the function that drives them before each step.
pub(crate) struct World {
    pub(crate) physics: PhysicsWorld,
    pub(crate) bodies: Vec<SimulatedBody>,
    /// The pairs of bodies that a joint connects; they may overlap, so they are not tested.
    pub(crate) joined_pairs: Vec<[usize; 2]>,
    /// The length of the thinnest part of any body, in metres.
    pub(crate) min_thickness: f64,
    /// Throws bodies or sets their velocities; it is called before each step, with the step's number.
    pub(crate) step_action: fn(&mut World, u32),
    rng: Pcg64,
    /// Whether rapier's continuous collision detection is enabled for the moving bodies.
    uses_rapier_ccd: bool,
}

pub(crate) struct SimulatedBody {
    pub(crate) handle: RigidBodyHandle,
    pub(crate) body: Body,
    pub(crate) shape: SharedShape,
    pub(crate) is_fixed: bool,
}

/// A function that creates a world, with rapier's continuous collision detection on or off.
type WorldConstructor = fn(bool) -> Result<World>;

/// The worlds to compare: the name of each in the table, and the function that creates it.
pub(crate) const WORLDS: [(&str, WorldConstructor); 3] = [
    ("bullets and paper", create_bullet_world),
    ("bunnies onto bunnies", create_bunny_world),
    ("chain through a slot", create_chain_world),
];

/// The distance that rapier keeps around each body, in metres. Bodies that rest on each other are farther apart than
/// those that are stopped.
const CONTACT_SKIN: f64 = 0.002;

/// The number of steps after which the bodies are thrown again, or the chain changes its direction.
const STEPS_PER_ROUND: u32 = 60;

impl World {
    fn empty(ccd: bool, thinnest: f64, act: fn(&mut World, u32)) -> Self {
        let mut physics = PhysicsWorld::new();
        physics.gravity = -9.81 * Vector::Z;
        if !ccd {
            physics.integration_parameters.max_ccd_substeps = 0;
        }
        World {
            physics,
            bodies: Vec::new(),
            joined_pairs: Vec::new(),
            min_thickness: thinnest,
            step_action: act,
            rng: Pcg64::seed_from_u64(3),
            uses_rapier_ccd: ccd,
        }
    }

    fn add_body(&mut self, builder: RigidBodyBuilder, shape: SharedShape, body: Body) -> usize {
        let collider = ColliderBuilder::new(shape.clone()).contact_skin(CONTACT_SKIN);
        let (handle, _) = self.physics.insert(builder, collider);
        self.bodies.push(SimulatedBody {
            handle,
            body,
            shape,
            is_fixed: self.physics.bodies[handle].is_fixed(),
        });
        self.bodies.len() - 1
    }

    fn add_fixed_slab(&mut self, place: Vector, [x, y, z]: [f64; 3]) -> Result<()> {
        let fixed = RigidBodyBuilder::fixed().translation(place);
        let (shape, body) = (SharedShape::cuboid(x, y, z), Body::cuboid([x, y, z])?);
        self.add_body(fixed, shape, body);
        Ok(())
    }

    fn add_dynamic_body(&mut self, place: Vector, shape: SharedShape, body: Body) -> usize {
        let builder = RigidBodyBuilder::dynamic().translation(place);
        let builder = builder.ccd_enabled(self.uses_rapier_ccd).can_sleep(false);
        self.add_body(builder, shape, body)
    }

    fn random_vector(&mut self) -> Vector {
        Vector::from_array(std::array::from_fn(|_| self.rng.random_range(-1.0..1.0)))
    }

    fn set_state(&mut self, index: usize, place: Pose, velocity: Vector, spin: Vector) {
        let body = &mut self.physics.bodies[self.bodies[index].handle];
        body.set_position(place, true);
        body.set_linvel(velocity, true);
        body.set_angvel(spin, true);
    }

    /// Throws a body from a place, with a random orientation and spin.
    fn throw_body(&mut self, index: usize, place: Vector, velocity: Vector) {
        let (turn, spin) = (3.0 * self.random_vector(), 5.0 * self.random_vector());
        let place = Pose::from_parts(place, Rotation::from_scaled_axis(turn));
        self.set_state(index, place, velocity, spin);
    }
}

/// The number of sheets of paper, which are 1 mm thick.
const SHEET_COUNT: usize = 5;

/// Creates twelve bullets at 100 to 390 metres a second, aimed at five sheets of paper.
fn create_bullet_world(ccd: bool) -> Result<World> {
    let mut world = World::empty(ccd, 0.001, |world, step| {
        for index in SHEET_COUNT..world.bodies.len() {
            // One after the other.
            if step % STEPS_PER_ROUND == 3 * (index - SHEET_COUNT) as u32 {
                let aside = 0.4 * world.random_vector();
                let speed = world.rng.random_range(100.0..390.0);
                let place = Vector::new(-2.0, aside.y, aside.z);
                let velocity = Vector::new(speed, 0.02 * speed * aside.x, 0.0);
                world.throw_body(index, place, velocity);
            }
        }
    });
    for k in 0..SHEET_COUNT {
        world.add_fixed_slab(0.3 * k as f64 * Vector::X, [0.0005, 0.5, 0.5])?;
    }
    for k in 0..12 {
        let aside = Vector::new(-4.0 - 0.1 * f64::from(k), 3.0, 0.0);
        world.add_dynamic_body(aside, SharedShape::ball(0.01), Body::sphere(0.01)?);
    }
    Ok(world)
}

/// The number of slabs that form the box; the bunnies follow them in the list of bodies.
const BOX_SIDE_COUNT: usize = 5;

/// Creates twelve bunnies in a box with thin walls, which are thrown towards one point at 40 metres a second.
fn create_bunny_world(ccd: bool) -> Result<World> {
    let mut world = World::empty(ccd, 0.01, |world, step| {
        if step % STEPS_PER_ROUND != 0 {
            return;
        }
        for index in BOX_SIDE_COUNT..world.bodies.len() {
            let place = bunny_start_position(index - BOX_SIDE_COUNT) + 0.05 * world.random_vector();
            let towards = (place - Vector::new(0.0, 0.0, 0.4)).normalize();
            let velocity = -40.0 * towards + 5.0 * world.random_vector();
            world.throw_body(index, place, velocity);
        }
    });
    world.add_fixed_slab(Vector::new(0.0, 0.0, -0.005), [2.0, 2.0, 0.005])?;
    for side in [Vector::X, -Vector::X, Vector::Y, -Vector::Y] {
        let half = |along: f64| if along == 0.0 { 2.0 } else { 0.005 };
        let place = 2.0 * side + 1.01 * Vector::Z;
        world.add_fixed_slab(place, [half(side.x), half(side.y), 1.0])?;
    }
    let mesh = Blob::BUNNY.mesh(400)?;
    let vertices = mesh.vertices().iter();
    let vertices: Vec<Vector> = vertices
        .map(|&vertex| Vector::from_array((0.25 * vertex).to_array()))
        .collect();
    let shape = SharedShape::convex_decomposition(&vertices, mesh.faces());
    let body = body(&*shape, &Options::default())?.body().clone();
    for number in 0..12 {
        world.add_dynamic_body(bunny_start_position(number), shape.clone(), body.clone());
    }
    Ok(world)
}

fn bunny_start_position(number: usize) -> Vector {
    let [x, y] = [number % 3, number / 3].map(|k| 0.8 * k as f64);
    Vector::new(x - 0.8, y - 1.2, 1.5)
}

/// The number of links of the chain.
const LINK_COUNT: usize = 14;
/// Half the length of a link, in metres.
const LINK_HALF_LENGTH: f64 = 0.06;

/// Creates a chain of fourteen links that is drawn back and forth through a slot between two plates.
fn create_chain_world(ccd: bool) -> Result<World> {
    let mut world = World::empty(ccd, 0.004, |world, step| {
        if step.is_multiple_of(4 * STEPS_PER_ROUND) {
            (0..LINK_COUNT).for_each(|link| world.reset_link(link));
        }
        let is_back = !(step / STEPS_PER_ROUND).is_multiple_of(2);
        let towards = if is_back { -1.0 } else { 1.0 };
        let aside = 3.0 * world.random_vector();
        let first = &mut world.physics.bodies[world.bodies[2].handle];
        let ahead = first.translation().x * towards;
        let speed = if ahead < 2.0 { 30.0 } else { 0.0 };
        first.set_linvel(Vector::new(towards * speed, aside.y, aside.z), true);
    });
    for side in [-1.0, 1.0] {
        world.add_fixed_slab(side * 1.04 * Vector::Y, [0.002, 1.0, 2.0])?;
    }
    for link in 0..LINK_COUNT {
        let shape = SharedShape::capsule_z(LINK_HALF_LENGTH, 0.02);
        let index =
            world.add_dynamic_body(Vector::ZERO, shape, Body::capsule(0.02, LINK_HALF_LENGTH)?);
        world.reset_link(link);
        if link > 0 {
            let joint = SphericalJointBuilder::new()
                .local_anchor1(-1.25 * LINK_HALF_LENGTH * Vector::Z)
                .local_anchor2(1.25 * LINK_HALF_LENGTH * Vector::Z)
                .contacts_enabled(false);
            let [before, this] = [index - 1, index].map(|index| world.bodies[index].handle);
            world.physics.insert_impulse_joint(before, this, joint);
            world.joined_pairs.push([index - 1, index]);
        }
    }
    Ok(world)
}

impl World {
    /// Puts a link of the chain back to its start pose, at rest.
    fn reset_link(&mut self, link: usize) {
        let place = Vector::new(-0.2 - 2.5 * LINK_HALF_LENGTH * link as f64, 0.0, 0.0);
        let place = Pose::from_parts(place, Rotation::from_scaled_axis(FRAC_PI_2 * Vector::Y));
        self.set_state(2 + link, place, Vector::ZERO, Vector::ZERO);
    }
}
