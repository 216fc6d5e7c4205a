//! Trajectories with velocities that change: poses, throws and curves.

use crate::arguments::{array, free, give, reference};
use crate::motion::{RccdMotion, RccdPose};
use crate::status::{Failure, RccdStatus, status_of};
use rigid_ccd::InputError;
use rigid_ccd::trajectory::{Ballistic, Curve, OrientationCurve, PosePath, Spline, Trajectory};

/// The trajectory of a body. Many queries and threads may share it.
pub struct RccdTrajectory(Box<dyn Trajectory + Send + Sync>);

impl RccdTrajectory {
    pub(crate) fn as_dyn(&self) -> &dyn Trajectory {
        &*self.0
    }
}

/// Makes a trajectory through poses at ascending times. Between two poses the body's origin moves on a straight line,
/// and the body takes the shortest rotation. The body is at rest before the first pose and after the last one.
///
/// # Safety
/// `times` and `poses` are null or point to `count` values; `out` is null or points to memory for a handle.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn rccd_trajectory_pose_path(
    times: *const f64,
    poses: *const RccdPose,
    count: usize,
    out: *mut *mut RccdTrajectory,
) -> RccdStatus {
    status_of(|| {
        // SAFETY: the contract of this function.
        let (times, poses) =
            unsafe { (array("times", times, count)?, array("poses", poses, count)?) };
        let timed_poses = times.iter().zip(poses);
        let timed_poses: Result<Vec<_>, _> = timed_poses
            .map(|(&time, pose)| Ok((time, pose.to_pose()?)))
            .collect();
        let path = timed_poses
            .and_then(PosePath::new)
            .map_err(Failure::input)?;
        // SAFETY: the contract of this function.
        unsafe { give(out, RccdTrajectory(Box::new(path))) }
    })
}

/// Makes the trajectory of a body in free fall: `thrown` with a constant acceleration of its center.
///
/// # Safety
/// `thrown` is null or points to a motion, `acceleration` is null or points to three numbers, and `out` is null or
/// points to memory for a handle.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn rccd_trajectory_ballistic(
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
        let trajectory = Ballistic::new(thrown, acceleration).map_err(Failure::input)?;
        // SAFETY: the contract of this function.
        unsafe { give(out, RccdTrajectory(Box::new(trajectory))) }
    })
}

/// The rotation of a body whose origin follows a curve: rotations at ascending times. Between two rotations the
/// body takes the shortest rotation at a constant rate.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct RccdRotations {
    /// The times.
    pub times: *const f64,
    /// A quaternion for each time, in the order x, y, z, w.
    pub rotations: *const f64,
    /// The number of times.
    pub count: usize,
}

/// Makes the trajectory of a body whose origin follows a Bézier curve of any degree from time 0 to `duration`. `points`
/// are the control points, three numbers each. If `rotations` is null, the body does not rotate.
///
/// # Safety
/// `points` is null or points to `3 · count` numbers; `rotations` is null or points to rotations, whose times and
/// quaternions are null or point to as many numbers as their count says; `out` is null or points to memory for a handle.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn rccd_trajectory_bezier(
    points: *const f64,
    count: usize,
    duration: f64,
    rotations: *const RccdRotations,
    out: *mut *mut RccdTrajectory,
) -> RccdStatus {
    let curve = |points: &[[f64; 3]]| Curve::bezier(points, duration);
    // SAFETY: the contract of this function.
    unsafe { give_spline(points, count, curve, rotations, out) }
}

/// Makes the trajectory of a body whose origin follows a uniform cubic B-spline from time 0 to `duration`. `points` are
/// at least four control points, three numbers each. The curve begins near the second point and ends near
/// the last but one. If `rotations` is null, the body does not rotate.
///
/// # Safety
/// As for `rccd_trajectory_bezier`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn rccd_trajectory_b_spline(
    points: *const f64,
    count: usize,
    duration: f64,
    rotations: *const RccdRotations,
    out: *mut *mut RccdTrajectory,
) -> RccdStatus {
    let curve = |points: &[[f64; 3]]| Curve::b_spline(points, duration);
    // SAFETY: the contract of this function.
    unsafe { give_spline(points, count, curve, rotations, out) }
}

/// Frees a trajectory. Does nothing for null.
///
/// # Safety
/// The handle is null, or comes from this library, is not in use, and has not been freed.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn rccd_trajectory_free(trajectory: *mut RccdTrajectory) {
    // SAFETY: the contract of this function.
    unsafe { free(trajectory) }
}

/// # Safety
/// As for [`rccd_trajectory_bezier`].
unsafe fn give_spline(
    points: *const f64,
    count: usize,
    curve: impl FnOnce(&[[f64; 3]]) -> Result<Curve, InputError>,
    rotations: *const RccdRotations,
    out: *mut *mut RccdTrajectory,
) -> RccdStatus {
    status_of(|| {
        // SAFETY: the contract of this function.
        let points = unsafe { array("points", points.cast::<[f64; 3]>(), count) }?;
        let curve = curve(points).map_err(Failure::input)?;
        let rotations = if rotations.is_null() {
            OrientationCurve::NONE
        } else {
            // SAFETY: the contract of this function.
            unsafe { reference("rotations", rotations)?.to_curve() }?
        };
        // SAFETY: the contract of this function.
        unsafe { give(out, RccdTrajectory(Box::new(Spline::new(curve, rotations)))) }
    })
}

impl RccdRotations {
    /// # Safety
    /// `times` is null or points to `count` numbers, and `rotations` to four times as many.
    unsafe fn to_curve(self) -> Result<OrientationCurve, Failure> {
        // SAFETY: the contract of this function.
        let (times, rotations) = unsafe {
            (
                array("times of rotations", self.times, self.count)?,
                array("rotations", self.rotations.cast::<[f64; 4]>(), self.count)?,
            )
        };
        let keys = times.iter().copied().zip(rotations.iter().copied());
        let keys: Vec<(f64, [f64; 4])> = keys.collect();
        OrientationCurve::piecewise_slerp(&keys).map_err(Failure::input)
    }
}
