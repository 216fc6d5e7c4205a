//! Runs one step of rapier's simulation in double precision over the whole query, with continuous collision detection.

use crate::method::peer::contact_claim_at;
use crate::method::peer::parry::double::shapes::{pose_at, to_parry_vector, to_tri_mesh};
use crate::method::solver::{ContactClaim, Reply, Solver};
use anyhow::Result;
use ccd_core::Motion;
use ccd_core::glam::{DQuat, DVec3};
use ccd_decomp::TriangleMesh;
use ccd_tables::motions::Motions;
use rapier3d_f64::prelude::{
    ColliderBuilder, MassProperties, PhysicsWorld, Pose, RigidBodyBuilder, RigidBodyHandle,
    SharedShape, Vector,
};

/// A rapier world in which A moves and B is fixed; the contact is where one step of the simulation stops A.
///
/// The engine does not sweep meshes, only convex bodies and compounds of them. A is therefore a compound
/// of its triangles here; B stays a mesh. Each triangle is swept against B's by [parry's
/// sweeps](crate::method::peer::parry::double::sweep), from the start pose to the end pose, the shorter
/// way and not at a constant rate. A turn of more than half a circle becomes another motion. Large turns
/// are rough, since the step of a game is expected to be short. The time is that of the whole step.
///
/// # Tolerance
/// `allowed_linear_error`. The sweeps stop at a gap of up to 1.25 times that.
///
/// # Guarantee
/// None. A triangle that overlaps one of B's at the start is swept as a small ball about its center.
pub struct TwoBodySimulation {
    world: PhysicsWorld,
    a: RigidBodyHandle,
    b: RigidBodyHandle,
}

/// The largest distance at which a hit is reported, as a multiple of the allowed error.
const MAX_HIT_DISTANCE_PER_ERROR: f64 = 1.25;
/// The fraction of A's motion from which a step counts as not stopped; it is below 1 because poses are rounded.
const MIN_COMPLETE_FRACTION: f64 = 1.0 - 1e-9;

impl TwoBodySimulation {
    /// Creates a rapier world with the triangles of A as one free body, and the mesh of B as a fixed body.
    ///
    /// # Errors
    /// If parry refuses a mesh.
    pub fn new(a: &TriangleMesh, b: &TriangleMesh) -> Result<Self> {
        let mut world = PhysicsWorld::new();
        world.gravity = Vector::ZERO;
        let triangles = to_tri_mesh(a)?
            .triangles()
            .map(|t| (Pose::IDENTITY, SharedShape::triangle(t.a, t.b, t.c)))
            .collect();
        // The density is zero: the mass is set for each query, about its center.
        let flying = ColliderBuilder::new(SharedShape::compound(triangles)).density(0.0);
        let fixed = ColliderBuilder::new(SharedShape::new(to_tri_mesh(b)?));
        let (a, _) = world.insert(RigidBodyBuilder::dynamic().can_sleep(false), flying);
        let (b, _) = world.insert(RigidBodyBuilder::fixed(), fixed);
        Ok(TwoBodySimulation { world, a, b })
    }

    /// Sets the start poses of both bodies, the velocity of A relative to B, and the allowed error.
    fn set_query(&mut self, query: &Motions, tolerance: f64) {
        let parameters = &mut self.world.integration_parameters;
        parameters.dt = query.duration;
        parameters.normalized_allowed_linear_error = tolerance / MAX_HIT_DISTANCE_PER_ERROR;
        self.world.bodies[self.b].set_position(pose_at(&query.b, 0.0), true);
        let a = &mut self.world.bodies[self.a];
        let center = to_parry_vector(query.a.center());
        // The inertia is equal about all axes, so that the axis of rotation stays fixed.
        let mass = MassProperties::new(center, 1.0, Vector::splat(1.0));
        a.set_additional_mass_properties(mass, true);
        a.recompute_mass_properties_from_colliders(&self.world.colliders);
        a.set_position(pose_at(&query.a, 0.0), true);
        let velocity = query.a.velocity() - query.b.velocity();
        a.set_linvel(to_parry_vector(velocity), true);
        a.set_angvel(to_parry_vector(query.a.angular_velocity()), true);
    }
}

impl Solver for TwoBodySimulation {
    fn answer(&mut self, query: &Motions, tolerance: f64) -> Reply {
        let turns = query.b.angular_velocity() != DVec3::ZERO;
        if turns || !(query.duration > 0.0) {
            let claim = ContactClaim::Refused;
            return Reply::new(claim, 0);
        }
        self.set_query(query, tolerance);
        self.world.step();
        let end = self.world.bodies[self.a].position();
        let claim = match completed_motion_fraction(query, end) {
            fraction if fraction >= MIN_COMPLETE_FRACTION => ContactClaim::NoContact,
            fraction => contact_claim_at(fraction * query.duration, query.duration),
        };
        Reply::new(claim, 1)
    }
}

/// Returns the fraction of A's motion that a step has completed; 1 if there is no motion. It is NaN if the squared
/// displacement underflows.
fn completed_motion_fraction(query: &Motions, end: &Pose) -> f64 {
    let motion = &query.a;
    let way = query.duration * (motion.velocity() - query.b.velocity());
    if way == DVec3::ZERO {
        return completed_rotation_fraction(motion, query.duration, end);
    }
    let center = DVec3::from(
        end.transform_point(to_parry_vector(motion.center()))
            .to_array(),
    );
    let start = motion.start().transform_point(motion.center());
    (center - start).dot(way) / way.length_squared()
}

/// Returns the fraction of its rotation that a step has completed, for a body that does not translate. A sweep mixes
/// two orientations, the shorter way.
fn completed_rotation_fraction(motion: &Motion, duration: f64, end: &Pose) -> f64 {
    let turn_to = |rotation: DQuat| {
        let turn = rotation * motion.start().rotation().conjugate();
        let shorter = if turn.w < 0.0 { -turn } else { turn };
        shorter.to_scaled_axis()
    };
    let whole = turn_to(motion.pose(duration).rotation());
    let angle = whole.length();
    // A whole number of turns ends in the same orientation, except for rounding.
    if angle < 1e-12 {
        return 1.0;
    }
    let turned = turn_to(DQuat::from_array(end.rotation.to_array())).dot(whole) / angle;
    0.5 * (1.0 + (0.5 * (turned - 0.5 * angle)).tan() / (0.25 * angle).tan())
}
