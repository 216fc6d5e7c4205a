//! Steps a rapier world so that no body passes through another. This is all the code that a program needs.

use anyhow::Result;
use ccd_core::Trajectory;
use rapier3d_f64::prelude::{
    PhysicsWorld, Pose as At, RigidBody, RigidBodyHandle, Rotation, Vector,
};
use rigid_ccd::scene::Stop;
use rigid_ccd::{Motion, Pose, Scene};

/// Steps a world, and stops each body at its first contact. `moving` are the bodies of the scene that move, by their
/// indices in it. Returns until when each body of the scene moved.
pub(crate) fn step_to_first_contacts(
    world: &mut PhysicsWorld,
    scene: &mut Scene<'_>,
    moving: &[(usize, RigidBodyHandle)],
) -> Result<Vec<Stop>> {
    let duration = world.integration_parameters.dt;
    let starts = moving
        .iter()
        .map(|&(_, body)| body_pose(&world.bodies[body]));
    let starts: Vec<Pose> = starts.collect::<Result<_>>()?;
    world.step();
    for (&(index, body), start) in moving.iter().zip(starts) {
        let motion = motion_since(start, &world.bodies[body], duration)?;
        scene.set_movement(index, motion)?;
    }
    let stops = scene.find_stops(duration)?;
    for &(index, body) in moving {
        if stops[index].stopped_by.is_some() {
            let pose = scene.movement(index).pose(stops[index].time)?;
            world.bodies[body].set_position(to_rapier_pose(pose), true);
        }
    }
    Ok(stops)
}

/// Returns the motion that takes a body from `start` to its present pose in the given duration.
pub(crate) fn motion_since(start: Pose, body: &RigidBody, duration: f64) -> Result<Motion> {
    let center = body.mass_properties().local_mprops.local_com.to_array();
    Ok(Motion::between(start, body_pose(body)?, center, duration)?)
}

/// Converts the pose of a rapier body to this engine's type.
pub(crate) fn body_pose(body: &RigidBody) -> Result<Pose> {
    let at = body.position();
    Ok(Pose::new(
        at.translation.to_array(),
        at.rotation.to_array(),
    )?)
}

/// Converts a pose to rapier's type.
pub(crate) fn to_rapier_pose(pose: Pose) -> At {
    At::from_parts(
        Vector::from_array(pose.translation().to_array()),
        Rotation::from_array(pose.rotation().to_array()),
    )
}
