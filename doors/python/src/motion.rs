//! The Python class `Motion`, and the accepted forms of poses and rotations.

use crate::arrays::{finite_numbers, shape};
use crate::errors::{input_error, warn};
use crate::numbers::read_number;
use crate::pickle::{ConstructorCall, Reduced};
use pyo3::prelude::*;
use pyo3::types::PyType;
use rigid_ccd::glam::{DMat3, DQuat, DVec3};
use rigid_ccd::{Motion, Pose, Remark};

/// The largest accepted entry of M·Mᵀ − I for a rotation matrix M. Products of a few matrices in float32 have errors of
/// this size. The engine uses the rotation of the unit quaternion nearest to the matrix.
const ORTHONORMALITY_TOLERANCE: f64 = 1e-5;

/// A motion: a pose at time 0, a constant velocity of the center of rotation, and a constant angular velocity about it.
///
/// Args:
///     position: the position of the body's origin at time 0, three numbers.
///     rotation: a matrix of shape (3, 3), a quaternion (x, y, z, w), or a scipy Rotation; None is no rotation.
///     velocity: the velocity of the center, per unit of time.
///     angular_velocity: the angular velocity about the world's axes, in radians per unit of time.
///     center: the center of rotation in the body's frame.
///
/// >>> from rigid_ccd import Motion
/// >>> Motion(position=[0, 0, 3], velocity=[0, 0, -2])
/// Motion(position=(0, 0, 3), rotation=(0, 0, 0, 1), velocity=(0, 0, -2), angular_velocity=(0, 0, 0))
#[pyclass(name = "Motion", module = "rigid_ccd", frozen)]
pub(crate) struct PyMotion {
    pub(crate) motion: Motion,
    /// The end of a motion between two poses. It is None for other motions, which have no end.
    #[pyo3(get)]
    pub(crate) end: Option<f64>,
    constructor_call: ConstructorCall,
}

#[pymethods]
impl PyMotion {
    #[new]
    #[pyo3(signature = (position = None, rotation = None, velocity = None, angular_velocity = None, center = None))]
    fn new(
        py: Python<'_>,
        position: Option<&Bound<'_, PyAny>>,
        rotation: Option<&Bound<'_, PyAny>>,
        velocity: Option<&Bound<'_, PyAny>>,
        angular_velocity: Option<&Bound<'_, PyAny>>,
        center: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<Self> {
        let vector = |values: Option<&Bound<'_, PyAny>>, argument_name| match values {
            Some(values) => finite_numbers(values, argument_name),
            None => Ok([0.0; 3]),
        };
        let rotation = rotation.map_or(Ok(DQuat::IDENTITY.to_array()), read_rotation)?;
        let start = GivenPose(vector(position, "position")?, rotation);
        let velocity = vector(velocity, "velocity")?;
        let (angular_velocity, center) = (
            vector(angular_velocity, "angular_velocity")?,
            vector(center, "center")?,
        );
        PyMotion::from_velocities(py, start, velocity, angular_velocity, center)
    }

    /// Makes the motion of a static body. `pose` takes the same forms as in `Motion.between`.
    #[classmethod]
    fn still(class: &Bound<'_, PyType>, pose: &Bound<'_, PyAny>) -> PyResult<Self> {
        let start = read_given_pose(pose, "pose")?;
        PyMotion::from_velocities(class.py(), start, [0.0; 3], [0.0; 3], [0.0; 3])
    }

    /// Makes the motion from one pose to another. The center moves on a straight line, and the body takes the shortest
    /// rotation.
    ///
    /// A pose is a matrix of shape (4, 4), or a pair of a position and a rotation as `Motion` takes them. Questions
    /// about the motion end at its `duration` by default.
    #[classmethod]
    #[pyo3(signature = (start, end, duration = 1.0, center = None))]
    fn between(
        class: &Bound<'_, PyType>,
        start: &Bound<'_, PyAny>,
        end: &Bound<'_, PyAny>,
        #[pyo3(from_py_with = read_number)] duration: f64,
        center: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<Self> {
        let (start, end) = (
            read_given_pose(start, "start")?,
            read_given_pose(end, "end")?,
        );
        let center = center.map_or(Ok([0.0; 3]), |center| finite_numbers(center, "center"))?;
        let motion = Motion::between(start.pose("start")?, end.pose("end")?, center, duration);
        let arguments = (start, end, duration, center);
        Ok(PyMotion {
            motion: motion.map_err(input_error)?,
            end: Some(duration),
            constructor_call: ConstructorCall::new(class.py(), Some("between"), arguments)?,
        })
    }

    /// Returns the pose of the body at a time, as a matrix of shape (4, 4).
    fn pose<'py>(&self, py: Python<'py>, time: f64) -> PyResult<Bound<'py, numpy::PyArray2<f64>>> {
        if !time.is_finite() {
            return Err(input_error(format!("time: {time} is no time")));
        }
        Ok(pose_matrix(py, &self.motion.pose(time)))
    }

    fn __reduce__<'py>(slf: &Bound<'py, Self>) -> PyResult<Reduced<'py>> {
        slf.get().constructor_call.reduce_tuple(slf.get_type())
    }

    fn __repr__(&self) -> String {
        let start = self.motion.start();
        let tuple = |v: DVec3| format!("({}, {}, {})", v.x, v.y, v.z);
        let DQuat { x, y, z, w } = start.rotation();
        format!(
            "Motion(position={}, rotation=({x}, {y}, {z}, {w}), velocity={}, angular_velocity={})",
            tuple(start.translation()),
            tuple(self.motion.velocity()),
            tuple(self.motion.angular_velocity())
        )
    }
}

impl PyMotion {
    fn from_velocities(
        py: Python<'_>,
        start: GivenPose,
        velocity: [f64; 3],
        angular_velocity: [f64; 3],
        center: [f64; 3],
    ) -> PyResult<Self> {
        let motion = Motion::about(start.pose("pose")?, velocity, angular_velocity, center);
        let GivenPose(position, rotation) = start;
        let arguments = (position, rotation, velocity, angular_velocity, center);
        Ok(PyMotion {
            motion: motion.map_err(input_error)?,
            end: None,
            constructor_call: ConstructorCall::new(py, None, arguments)?,
        })
    }
}

/// A position and a quaternion as the caller passed them, for pickle: normalisation may change even a normalised
/// quaternion. In Python it is a tuple of both.
#[derive(Clone, Copy, IntoPyObject, IntoPyObjectRef)]
pub(crate) struct GivenPose([f64; 3], [f64; 4]);

impl GivenPose {
    pub(crate) const IDENTITY: GivenPose = GivenPose([0.0; 3], [0.0, 0.0, 0.0, 1.0]);

    /// Returns the normalised pose. Errors name it as `argument_name`.
    pub(crate) fn pose(&self, argument_name: &str) -> PyResult<Pose> {
        Pose::new(self.0, self.1).map_err(|error| input_error(format!("{argument_name}: {error}")))
    }
}

impl<'py> FromPyObject<'_, 'py> for GivenPose {
    type Error = PyErr;

    fn extract(pose: Borrowed<'_, 'py, PyAny>) -> PyResult<Self> {
        read_given_pose(&pose, "pose")
    }
}

/// Converts a pose to a matrix of shape (4, 4).
pub(crate) fn pose_matrix<'py>(py: Python<'py>, pose: &Pose) -> Bound<'py, numpy::PyArray2<f64>> {
    let (rotation, position) = (DMat3::from_quat(pose.rotation()), pose.translation());
    let row = |k: usize| [rotation.row(k).to_array().as_slice(), &[position[k]]].concat();
    let matrix = [row(0), row(1), row(2), vec![0.0, 0.0, 0.0, 1.0]];
    numpy::PyArray2::from_vec2(py, &matrix).unwrap_or_else(|_| unreachable!("rows of four numbers"))
}

/// Reads a rotation from a quaternion, a matrix or a SciPy rotation.
fn read_rotation(value: &Bound<'_, PyAny>) -> PyResult<[f64; 4]> {
    if value.hasattr("as_matrix")? {
        return rotation_from_matrix(&value.call_method0("as_matrix")?, "rotation");
    }
    match shape(value, "rotation")?[..] {
        [4] => {
            let quaternion = finite_numbers(value, "rotation")?;
            let is_zero = quaternion == [0.0; 4];
            let remark = Remark::remark_on_quaternion(quaternion).filter(|_| !is_zero);
            warn(value.py(), remark, 1)?;
            Ok(quaternion)
        }
        [3, 3] => rotation_from_matrix(value, "rotation"),
        _ => Err(input_error(
            "rotation: a matrix of shape (3, 3), four numbers (x, y, z, w) or a scipy Rotation is needed",
        )),
    }
}

fn rotation_from_matrix(value: &Bound<'_, PyAny>, argument_name: &str) -> PyResult<[f64; 4]> {
    quaternion_from_rows(finite_numbers(value, argument_name)?, argument_name)
}

fn quaternion_from_rows(rows: [f64; 9], argument_name: &str) -> PyResult<[f64; 4]> {
    let matrix = DMat3::from_cols_array(&rows).transpose();
    let deviation = (matrix * matrix.transpose() - DMat3::IDENTITY).to_cols_array();
    let error = deviation.iter().map(|entry| entry.abs());
    // The comparison is written so that NaN is refused.
    let is_rotation =
        error.clone().all(|error| error <= ORTHONORMALITY_TOLERANCE) && matrix.determinant() > 0.0;
    if is_rotation {
        Ok(DQuat::from_mat3(&matrix).to_array())
    } else {
        Err(input_error(format!(
            "{argument_name}: the matrix is no rotation: its product with its transpose is off by {:.1e}, and its determinant \
         is {:.1}",
            error.max_by(f64::total_cmp).unwrap_or_default(),
            matrix.determinant()
        )))
    }
}

/// Reads a pose from any of its accepted forms. Errors name it as `argument_name`.
pub(crate) fn read_pose(value: &Bound<'_, PyAny>, argument_name: &str) -> PyResult<Pose> {
    read_given_pose(value, argument_name)?.pose(argument_name)
}

/// Reads a pose without normalising it.
pub(crate) fn read_given_pose(
    value: &Bound<'_, PyAny>,
    argument_name: &str,
) -> PyResult<GivenPose> {
    if let Ok((position, rotation)) = value.extract::<(Bound<'_, PyAny>, Bound<'_, PyAny>)>() {
        return Ok(GivenPose(
            finite_numbers(&position, argument_name)?,
            read_rotation(&rotation)?,
        ));
    }
    if shape(value, argument_name)?[..] != [4, 4] {
        return Err(input_error(format!(
            "{argument_name}: a matrix of shape (4, 4), or a pair of a position and a rotation is needed"
        )));
    }
    let m: [f64; 16] = finite_numbers(value, argument_name)?;
    if m[12..] != [0.0, 0.0, 0.0, 1.0] {
        return Err(input_error(format!(
            "{argument_name}: the last row of the matrix is not 0, 0, 0, 1"
        )));
    }
    let rows = [m[0], m[1], m[2], m[4], m[5], m[6], m[8], m[9], m[10]];
    Ok(GivenPose(
        [m[3], m[7], m[11]],
        quaternion_from_rows(rows, argument_name)?,
    ))
}
