//! The Python class `PosePath`.

use crate::arrays::{finite_numbers, flat_numbers, rows};
use crate::errors::input_error;
use crate::motion::{GivenPose, pose_matrix, read_given_pose};
use crate::pickle::{ConstructorCall, Reduced};
use pyo3::prelude::*;
use rigid_ccd::trajectory::{PosePath, Trajectory};

/// A path of a body through poses at given times, for example from a planner or a simulator's log.
///
/// From one pose to the next, the center moves on a straight line, and the body takes the shortest rotation about it.
/// The body is at rest before the first time and after the last one. With `angular_velocities`, it may rotate by any number of
/// turns.
///
/// Args:
///     times: increasing times, one for each pose.
///     poses: one pose for each time, in the forms of `Motion.between`, for instance an array of shape (n, 4, 4).
///     center: the point in the body's frame that moves on straight lines; the body's origin by default.
///     angular_velocities: angular velocities in the world, one from each pose to the next, of shape (n - 1, 3). The rotation
///         that it gives may differ from the next pose by at most a quarter turn; the difference is added as a second
///         rotation. Zeros stand for the shortest rotation.
///
/// >>> import numpy as np
/// >>> from rigid_ccd import PosePath
/// >>> stops = np.tile(np.eye(4), (3, 1, 1))
/// >>> stops[1:, 0, 3] = 1
/// >>> stops[2, 1, 3] = 2
/// >>> path = PosePath([0, 1, 3], stops)
/// >>> path.pose(2)[:3, 3]
/// array([1., 1., 0.])
#[pyclass(name = "PosePath", module = "rigid_ccd", frozen)]
pub(crate) struct PyPath {
    pub(crate) poses: PosePath,
    constructor_call: ConstructorCall,
}

#[pymethods]
impl PyPath {
    #[new]
    #[pyo3(signature = (times, poses, center = None, angular_velocities = None))]
    fn new(
        py: Python<'_>,
        times: &Bound<'_, PyAny>,
        poses: &Bound<'_, PyAny>,
        center: Option<&Bound<'_, PyAny>>,
        angular_velocities: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<Self> {
        let times = flat_numbers(times, "times")?;
        // Reads one pose more than needed, to detect too many poses of an iterator that may have no end.
        let poses = poses.try_iter()?.take(times.len() + 1).enumerate();
        let given_poses: Vec<GivenPose> = poses
            .map(|(k, pose)| read_given_pose(&pose?, &format!("pose {k}")))
            .collect::<PyResult<_>>()?;
        if given_poses.len() != times.len() {
            let is_more = given_poses.len() > times.len();
            return Err(input_error(format!(
                "poses: there are {}{}, but {} times",
                if is_more { "at least " } else { "" },
                given_poses.len(),
                times.len()
            )));
        }
        let center = center.map_or(Ok([0.0; 3]), |center| finite_numbers(center, "center"))?;
        let timed = times.iter().zip(&given_poses).enumerate();
        let timed = timed.map(|(k, (&time, pose))| Ok((time, pose.pose(&format!("pose {k}"))?)));
        let poses = PosePath::new(timed.collect::<PyResult<_>>()?).map_err(input_error)?;
        let mut poses = poses.about(center).map_err(input_error)?;
        let angular_velocities = angular_velocities
            .map(|angular_velocities| rows::<3>(angular_velocities, "angular_velocities"))
            .transpose()?;
        if let Some(angular_velocities) = &angular_velocities {
            poses = poses
                .with_angular_velocities(angular_velocities.clone())
                .map_err(input_error)?;
        }
        Ok(PyPath {
            poses,
            constructor_call: ConstructorCall::new(
                py,
                None,
                (times, given_poses, center, angular_velocities),
            )?,
        })
    }

    fn __reduce__<'py>(slf: &Bound<'py, Self>) -> PyResult<Reduced<'py>> {
        slf.get().constructor_call.reduce_tuple(slf.get_type())
    }

    /// The time of the last pose of the path.
    #[getter]
    fn end(&self) -> f64 {
        self.poses.end_time()
    }

    /// Returns the pose of the body at a time, as a matrix of shape (4, 4).
    fn pose<'py>(&self, py: Python<'py>, time: f64) -> PyResult<Bound<'py, numpy::PyArray2<f64>>> {
        if time.is_nan() {
            return Err(input_error("time: NaN is no time"));
        }
        Ok(pose_matrix(
            py,
            &self.poses.pose(time).map_err(input_error)?,
        ))
    }

    fn __repr__(&self) -> String {
        let (poses, end) = (self.poses.times().count(), self.poses.end_time());
        format!("PosePath({poses} poses, until {end})")
    }
}
