//! Poses, and motions at constant velocities.

use crate::arguments::{reference, store};
use crate::status::{Failure, RccdStatus, status_of};
use rigid_ccd::{InputError, Motion, Pose};

/// The pose of a body in the world.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RccdPose {
    /// The position of the body's origin.
    pub position: [f64; 3],
    /// The rotation as a quaternion in the order x, y, z, w. It need not be normalised, but must not be zero.
    pub rotation: [f64; 4],
}

/// A motion at constant velocities: the center of rotation moves on a straight line, and the body rotates about it.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RccdMotion {
    /// The pose at time 0.
    pub start: RccdPose,
    /// The velocity of the center of rotation.
    pub velocity: [f64; 3],
    /// The angular velocity in the world, in radians per unit of time.
    pub angular_velocity: [f64; 3],
    /// The center of rotation, in the body's frame.
    pub center: [f64; 3],
}

impl RccdPose {
    pub(crate) fn to_pose(self) -> Result<Pose, InputError> {
        Pose::new(self.position, self.rotation)
    }
}

impl RccdMotion {
    pub(crate) fn to_motion(self) -> Result<Motion, InputError> {
        Motion::about(
            self.start.to_pose()?,
            self.velocity,
            self.angular_velocity,
            self.center,
        )
    }

    fn from_motion(motion: &Motion) -> Self {
        let start = motion.start();
        RccdMotion {
            start: RccdPose {
                position: start.translation().to_array(),
                rotation: start.rotation().to_array(),
            },
            velocity: motion.velocity().to_array(),
            angular_velocity: motion.angular_velocity().to_array(),
            center: motion.center().to_array(),
        }
    }
}

/// Returns the motion of a static body at the origin. Change its fields to make the body move.
#[unsafe(no_mangle)]
pub extern "C" fn rccd_motion_at_rest() -> RccdMotion {
    RccdMotion::from_motion(&Motion::STILL)
}

/// Computes the motion from one pose at time 0 to another at time `duration`, by the shortest rotation. `center` is the
/// point in the body's frame that moves on a straight line; null stands for the body's origin.
///
/// # Safety
/// `start` and `end` are null or point to poses, `center` is null or points to three numbers, and `out` is null or
/// points to memory for a motion.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn rccd_motion_between(
    start: *const RccdPose,
    end: *const RccdPose,
    center: *const f64,
    duration: f64,
    out: *mut RccdMotion,
) -> RccdStatus {
    status_of(|| {
        // SAFETY: the contract of this function.
        let (start, end) = unsafe { (reference("start", start)?, reference("end", end)?) };
        let center = if center.is_null() {
            [0.0; 3]
        } else {
            // SAFETY: the contract of this function.
            *unsafe { reference("center", center.cast::<[f64; 3]>()) }?
        };
        let poses = start
            .to_pose()
            .and_then(|start| Ok((start, end.to_pose()?)));
        let motion = poses
            .and_then(|(start, end)| Motion::between(start, end, center, duration))
            .map_err(Failure::input)?;
        // SAFETY: the contract of this function.
        unsafe { store("out", out, RccdMotion::from_motion(&motion)) }
    })
}
