//! Converts meshes, poses and motions to the library's types.

use super::library::math::{Pose, Real, Rotation, Vector};
use super::library::query::NonlinearRigidMotion;
use super::library::shape::TriMesh;
use anyhow::{Context, Result};
use ccd_core::Motion;
use ccd_core::glam::{DQuat, DVec3};
use ccd_decomp::TriangleMesh;

/// Converts a mesh to parry's `TriMesh`, with the same triangles in the same order.
pub fn to_tri_mesh(mesh: &TriangleMesh) -> Result<TriMesh> {
    let vertices = mesh
        .vertices()
        .iter()
        .map(|&v| to_parry_vector(v))
        .collect();
    TriMesh::new(vertices, mesh.faces().to_vec()).context("the peer refuses the mesh")
}

/// Converts a motion exactly: the body rotates about a center that moves straight, both at constant rates.
pub fn to_rigid_motion(motion: &Motion) -> NonlinearRigidMotion {
    NonlinearRigidMotion::new(
        pose_at(motion, 0.0),
        to_parry_vector(motion.center()),
        to_parry_vector(motion.velocity()),
        to_parry_vector(motion.angular_velocity()),
    )
}

/// Returns the pose of a moving body at a time, in the library's type.
pub fn pose_at(motion: &Motion, time: f64) -> Pose {
    let pose = motion.pose(time);
    Pose::from_parts(
        to_parry_vector(pose.translation()),
        to_parry_rotation(pose.rotation()),
    )
}

/// Rounds each coordinate to the library's number type.
pub fn to_parry_vector(v: DVec3) -> Vector {
    Vector::new(v.x as Real, v.y as Real, v.z as Real)
}

fn to_parry_rotation(q: DQuat) -> Rotation {
    Rotation::from_xyzw(q.x as Real, q.y as Real, q.z as Real, q.w as Real).normalize()
}
