//! The step of a rapier world in which nothing passes through anything: all that such a program needs.

use anyhow::Result;
use rapier3d_f64::prelude::{
    PhysicsWorld, Pose as At, RigidBody, RigidBodyHandle, Rotation, Vector,
};
use rigid_ccd::{Motion, Pose, Scene, Stop};

/// Steps a world, and stops each body where it touches another one. `moving` are the bodies of the scene that move,
/// with their indices in it. Returns their motions, and where they stop.
pub(crate) fn step(
    world: &mut PhysicsWorld,
    scene: &mut Scene<'_>,
    moving: &[(usize, RigidBodyHandle)],
) -> Result<Vec<(Motion, Stop)>> {
    let duration = world.integration_parameters.dt;
    let poses = moving.iter().map(|&(_, body)| pose(&world.bodies[body]));
    let starts = poses.collect::<Result<Vec<Pose>>>()?;
    world.step();
    let mut motions = Vec::new();
    for (&(index, body), start) in moving.iter().zip(starts) {
        let body = &world.bodies[body];
        let centre = body.mass_properties().local_mprops.local_com;
        let motion = Motion::between(start, pose(body)?, centre.to_array(), duration)?;
        scene.set_motion(index, motion);
        motions.push(motion);
    }
    let stops = scene.stops(duration)?;
    for (&(index, body), motion) in moving.iter().zip(&motions) {
        if stops[index].by.is_some() {
            let stopped = motion.pose(stops[index].time);
            world.bodies[body].set_position(at(stopped), true);
        }
    }
    let stops = moving.iter().map(|&(index, _)| stops[index]);
    Ok(motions.into_iter().zip(stops).collect())
}

/// Returns where a body is.
pub(crate) fn pose(body: &RigidBody) -> Result<Pose> {
    let at = body.position();
    Ok(Pose::new(
        at.translation.to_array(),
        at.rotation.to_array(),
    )?)
}

/// Converts a pose to rapier's.
pub(crate) fn at(pose: Pose) -> At {
    At::from_parts(
        Vector::from_array(pose.translation().to_array()),
        Rotation::from_array(pose.rotation().to_array()),
    )
}
