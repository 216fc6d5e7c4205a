//! Trajectories that are no motion at constant velocities.

use crate::arguments::{array, free, give, reference};
use crate::motion::{RccdMotion, RccdPose};
use crate::status::{Failure, RccdStatus, status_of};
use rigid_ccd::trajectory::{Ballistic, Poses, Trajectory};

/// A trajectory. Many queries and threads may share it.
pub struct RccdTrajectory(Box<dyn Trajectory + Send + Sync>);

impl RccdTrajectory {
    pub(crate) fn as_dyn(&self) -> &dyn Trajectory {
        &*self.0
    }
}

/// Makes a path through poses, each at its time, in ascending order. Between two poses the body's origin moves straight,
/// and the body takes the shortest rotation. It rests before the first pose and after the last one.
///
/// # Safety
/// `times` and `poses` are null or point to `count` values; `out` is null or points to a place for a handle.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn rccd_trajectory_through_poses(
    times: *const f64,
    poses: *const RccdPose,
    count: usize,
    out: *mut *mut RccdTrajectory,
) -> RccdStatus {
    status_of(|| {
        // SAFETY: the contract of this function.
        let (times, poses) =
            unsafe { (array("times", times, count)?, array("poses", poses, count)?) };
        let timed = times.iter().zip(poses);
        let timed: Result<Vec<_>, _> = timed
            .map(|(&time, pose)| Ok((time, pose.to_pose()?)))
            .collect();
        let path = timed.and_then(Poses::new).map_err(Failure::input)?;
        // SAFETY: the contract of this function.
        unsafe { give(out, RccdTrajectory(Box::new(path))) }
    })
}

/// Makes the trajectory of a thrown body: a motion whose centre accelerates, in free fall for instance.
///
/// # Safety
/// `thrown` is null or points to a motion, `acceleration` is null or points to three numbers, and `out` is null or points to
/// a place for a handle.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn rccd_trajectory_thrown(
    thrown: *const RccdMotion,
    acceleration: *const f64,
    out: *mut *mut RccdTrajectory,
) -> RccdStatus {
    status_of(|| {
        // SAFETY: the contract of this function.
        let thrown = unsafe { reference("thrown", thrown) }?;
        // SAFETY: the contract of this function.
        let acceleration = *unsafe { reference("acceleration", acceleration.cast::<[f64; 3]>()) }?;
        let thrown = thrown.to_motion().map_err(Failure::input)?;
        let falls = Ballistic::new(thrown, acceleration).map_err(Failure::input)?;
        // SAFETY: the contract of this function.
        unsafe { give(out, RccdTrajectory(Box::new(falls))) }
    })
}

/// Frees a trajectory; null is nothing.
///
/// # Safety
/// The handle is null, or comes from this library, is not in use, and has not been freed.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn rccd_trajectory_free(trajectory: *mut RccdTrajectory) {
    // SAFETY: the contract of this function.
    unsafe { free(trajectory) }
}
