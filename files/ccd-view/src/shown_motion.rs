//! The motions of bodies on a page.

use ccd_core::glam::{DMat3, DVec3};
use ccd_core::{Motion, Pose};
use serde::Serialize;

/// The motion of a body that a page draws.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(untagged)]
pub enum ShownMotion {
    /// The body moves at constant velocities, by the formula of [`Motion`].
    ConstantVelocity {
        /// The center of rotation, in the body's frame.
        center: [f64; 3],
        /// The position of the center at time 0, in the world frame.
        from: [f64; 3],
        /// The velocity of the center, per unit of time, in the world frame.
        velocity: [f64; 3],
        /// The angular velocity in radians per unit of time, in the world frame.
        spin: [f64; 3],
        /// The rotation matrix at time 0, row by row.
        rotation: [f64; 9],
    },
    /// The body moves from pose to pose: its center in straight lines, and its rotation by each key's rotation vector.
    Keyframes {
        /// The point that moves along straight lines, in the body's frame.
        center: [f64; 3],
        /// The poses, in order of time.
        keys: Vec<Keyframe>,
    },
}

/// The pose of a body at a time.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Keyframe {
    time: f64,
    /// The position of the center, in the world frame.
    place: [f64; 3],
    /// The rotation matrix, row by row.
    rotation: [f64; 9],
    /// The rotation vector to the next key, in the world frame; without it, a rotation by half a turn would be
    /// ambiguous.
    turn: [f64; 3],
}

impl Keyframe {
    /// Creates a key from a pose, the position of the center, and the rotation vector to the next key.
    pub fn new(time: f64, pose: &Pose, place: DVec3, turn: DVec3) -> Self {
        Keyframe {
            time,
            place: place.to_array(),
            rotation: rotation_rows(pose),
            turn: turn.to_array(),
        }
    }
}

impl From<&Motion> for ShownMotion {
    fn from(motion: &Motion) -> Self {
        let from: DVec3 = motion.start().transform_point(motion.center());
        ShownMotion::ConstantVelocity {
            center: motion.center().to_array(),
            from: from.to_array(),
            velocity: motion.velocity().to_array(),
            spin: motion.angular_velocity().to_array(),
            rotation: rotation_rows(&motion.start()),
        }
    }
}

fn rotation_rows(pose: &Pose) -> [f64; 9] {
    // Columns of the transpose.
    DMat3::from_quat(pose.rotation())
        .transpose()
        .to_cols_array()
}
