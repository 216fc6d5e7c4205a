//! Curves in joint space: paths whose joints follow polynomials in time.

use crate::arguments::{array, free, give};
use crate::status::{Failure, RccdStatus, status_of};
use rigid_ccd_robot::JointCurve;

/// A curve in joint space: the path of a robot whose joints follow polynomials in time. Many questions and threads may
/// share it.
pub struct RccdJointCurve(pub(crate) JointCurve);

/// Makes a curve through configurations at ascending times, with the velocity at each of them. Segments are cubic
/// polynomials. If `accelerations` is not null, they are quintic, and also have these accelerations.
///
/// # Safety
/// `times` is null or points to `count` numbers; `positions`, `velocities` and `accelerations` are null or point to
/// `count · joint_count` numbers, configuration by configuration; `out` is null or points to memory for a handle.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn rccd_joint_curve_through(
    times: *const f64,
    positions: *const f64,
    velocities: *const f64,
    accelerations: *const f64,
    count: usize,
    joint_count: usize,
    out: *mut *mut RccdJointCurve,
) -> RccdStatus {
    status_of(|| {
        let sizes = [count, joint_count];
        // SAFETY: the contract of this function.
        let (times, positions, velocities) = unsafe {
            (
                array("times", times, count)?,
                rows("positions", positions, sizes)?,
                rows("velocities", velocities, sizes)?,
            )
        };
        let curve = if accelerations.is_null() {
            JointCurve::cubic_hermite(times, &positions, &velocities)
        } else {
            // SAFETY: the contract of this function.
            let accelerations = unsafe { rows("accelerations", accelerations, sizes) }?;
            JointCurve::quintic_hermite(times, &positions, &velocities, &accelerations)
        };
        let curve = curve.map_err(Failure::input)?;
        // SAFETY: the contract of this function.
        unsafe { give(out, RccdJointCurve(curve)) }
    })
}

/// Makes a curve from polynomials in the time since each segment's start. The degree is at most 9. `coefficients` has
/// `degree + 1` numbers for each joint of each segment, lowest power first. `times` has the start of each segment, then
/// the end of the last one.
///
/// # Safety
/// `times` is null or points to `segment_count + 1` numbers; `coefficients` is null or points to `segment_count ·
/// joint_count · (degree + 1)` numbers; `out` is null or points to memory for a handle.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn rccd_joint_curve_from_polynomials(
    times: *const f64,
    coefficients: *const f64,
    segment_count: usize,
    joint_count: usize,
    degree: usize,
    out: *mut *mut RccdJointCurve,
) -> RccdStatus {
    status_of(|| {
        let sizes = [segment_count, joint_count, degree].map(|size| size.checked_add(1));
        let [Some(time_count), Some(_), Some(coefficient_count)] = sizes else {
            return Err(Failure::argument("the counts of the curve are too large"));
        };
        // SAFETY: the contract of this function.
        let times = unsafe { array("times", times, time_count) }?;
        let row_count = segment_count.checked_mul(joint_count);
        let row_count = row_count.ok_or_else(|| {
            Failure::argument(format!(
                "coefficients is too long: {segment_count} segments of {joint_count} joints"
            ))
        })?;
        // SAFETY: the contract of this function.
        let joints = unsafe { rows("coefficients", coefficients, [row_count, coefficient_count]) }?;
        let segments = joints.chunks(joint_count.max(1));
        let segments: Vec<Vec<Vec<f64>>> = segments
            .map(|joints| {
                joints
                    .iter()
                    .map(|polynomial| polynomial.to_vec())
                    .collect()
            })
            .collect();
        let curve = JointCurve::from_polynomials(times, &segments).map_err(Failure::input)?;
        // SAFETY: the contract of this function.
        unsafe { give(out, RccdJointCurve(curve)) }
    })
}

/// Frees a curve. Does nothing for null.
///
/// # Safety
/// The handle is null, or comes from this library, is not in use, and has not been freed.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn rccd_joint_curve_free(curve: *mut RccdJointCurve) {
    // SAFETY: the contract of this function.
    unsafe { free(curve) }
}

/// Returns the rows of a matrix.
///
/// # Safety
/// The pointer is null, or points to `row_count · row_length` numbers that nobody changes during the call.
unsafe fn rows<'a>(
    name: &str,
    numbers: *const f64,
    [row_count, row_length]: [usize; 2],
) -> Result<Vec<&'a [f64]>, Failure> {
    let total = row_count.checked_mul(row_length);
    let total = total.ok_or_else(|| {
        Failure::argument(format!(
            "{name} is too long: {row_count} rows of {row_length} numbers"
        ))
    })?;
    // SAFETY: the contract of this function.
    let numbers = unsafe { array(name, numbers, total) }?;
    Ok(numbers.chunks_exact(row_length.max(1)).collect())
}
