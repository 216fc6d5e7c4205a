//! Motions, and the forms that poses and rotations come in.

use crate::arrays::{numbers, shape, vector};
use crate::errors::input;
use pyo3::prelude::*;
use pyo3::types::PyType;
use rigid_ccd::glam::{DMat3, DQuat, DVec3};
use rigid_ccd::{Motion, Pose};

/// How far the columns of a rotation matrix may be from unit and perpendicular.
const ORTHONORMAL: f64 = 1e-9;

/// A motion: a pose at time 0, a constant velocity of a centre, and a constant angular velocity about it.
///
/// Args:
///     position: the place of the body's origin at time 0, three numbers.
///     rotation: a matrix of shape (3, 3), a quaternion (w, x, y, z), or a scipy Rotation; None does not turn it.
///     velocity: of the centre, per unit of time.
///     spin: the angular velocity about the world's axes, in radians per unit of time.
///     center: the centre of rotation in the body's frame.
///
/// >>> from rigid_ccd import Motion
/// >>> Motion(position=[0, 0, 3], velocity=[0, 0, -2])
/// Motion(position=(0, 0, 3), rotation=(1, 0, 0, 0), velocity=(0, 0, -2), spin=(0, 0, 0))
#[pyclass(name = "Motion", module = "rigid_ccd", frozen)]
pub(crate) struct PyMotion {
    pub(crate) motion: Motion,
}

#[pymethods]
impl PyMotion {
    #[new]
    #[pyo3(signature = (position = None, rotation = None, velocity = None, spin = None, center = None))]
    fn new(
        position: Option<&Bound<'_, PyAny>>,
        rotation: Option<&Bound<'_, PyAny>>,
        velocity: Option<&Bound<'_, PyAny>>,
        spin: Option<&Bound<'_, PyAny>>,
        center: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<Self> {
        let given = |values: Option<&Bound<'_, PyAny>>, what| match values {
            Some(values) => vector(values, what),
            None => Ok([0.0; 3]),
        };
        let turned = rotation
            .map(rotation_of)
            .transpose()?
            .unwrap_or(DQuat::IDENTITY);
        let start = Pose::new(given(position, "position")?, turned).map_err(input)?;
        let (velocity, spin) = (given(velocity, "velocity")?, given(spin, "spin")?);
        let motion = Motion::about(start, velocity, spin, given(center, "center")?);
        Ok(PyMotion {
            motion: motion.map_err(input)?,
        })
    }

    /// Makes the motion from one pose to another: the centre moves in a straight line, the body turns the shortest way.
    ///
    /// A pose is a matrix of shape (4, 4), or a pair of a position and a rotation as `Motion` takes them.
    #[classmethod]
    #[pyo3(signature = (start, end, *, duration = 1.0, center = None))]
    fn between(
        _class: &Bound<'_, PyType>,
        start: &Bound<'_, PyAny>,
        end: &Bound<'_, PyAny>,
        duration: f64,
        center: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<Self> {
        let center = center.map_or(Ok([0.0; 3]), |center| vector(center, "center"))?;
        let (start, end) = (pose_of(start, "start")?, pose_of(end, "end")?);
        let motion = Motion::between(start, end, center, duration);
        Ok(PyMotion {
            motion: motion.map_err(input)?,
        })
    }

    /// The pose at a time, as a matrix of shape (4, 4).
    fn pose<'py>(&self, py: Python<'py>, time: f64) -> Bound<'py, numpy::PyArray2<f64>> {
        matrix_of(py, &self.motion.pose(time))
    }

    fn __repr__(&self) -> String {
        let start = self.motion.start();
        let tuple = |v: DVec3| format!("({}, {}, {})", v.x, v.y, v.z);
        let DQuat { x, y, z, w } = start.rotation();
        format!(
            "Motion(position={}, rotation=({w}, {x}, {y}, {z}), velocity={}, spin={})",
            tuple(start.translation()),
            tuple(self.motion.velocity()),
            tuple(self.motion.spin())
        )
    }
}

/// Makes a matrix of shape (4, 4) of a pose.
pub(crate) fn matrix_of<'py>(py: Python<'py>, pose: &Pose) -> Bound<'py, numpy::PyArray2<f64>> {
    let (turned, place) = (DMat3::from_quat(pose.rotation()), pose.translation());
    let row = |k: usize| {
        vec![
            turned.x_axis[k],
            turned.y_axis[k],
            turned.z_axis[k],
            place[k],
        ]
    };
    let matrix = [row(0), row(1), row(2), vec![0.0, 0.0, 0.0, 1.0]];
    numpy::PyArray2::from_vec2(py, &matrix).unwrap_or_else(|_| unreachable!("rows of four numbers"))
}

/// Reads a rotation.
fn rotation_of(value: &Bound<'_, PyAny>) -> PyResult<DQuat> {
    if value.hasattr("as_matrix")? {
        return matrix(&value.call_method0("as_matrix")?, "rotation");
    }
    match shape(value)?[..] {
        [4] => {
            let [w, x, y, z] = numbers(value, "rotation")?;
            Ok(DQuat::from_xyzw(x, y, z, w))
        }
        [3, 3] => matrix(value, "rotation"),
        _ => Err(input(
            "rotation: a matrix of shape (3, 3), four numbers (w, x, y, z) or a scipy Rotation is needed",
        )),
    }
}

fn matrix(value: &Bound<'_, PyAny>, what: &str) -> PyResult<DQuat> {
    let rows: [f64; 9] = numbers(value, what)?;
    let matrix = DMat3::from_cols_array(&rows).transpose();
    let off = (matrix * matrix.transpose() - DMat3::IDENTITY).to_cols_array();
    let is_rotation =
        off.iter().all(|entry| entry.abs() <= ORTHONORMAL) && matrix.determinant() > 0.0;
    match is_rotation {
        true => Ok(DQuat::from_mat3(&matrix)),
        false => Err(input(format!("{what}: the matrix is no rotation"))),
    }
}

/// Reads a pose.
pub(crate) fn pose_of(value: &Bound<'_, PyAny>, what: &str) -> PyResult<Pose> {
    let (place, turned) = match value.extract::<(Bound<'_, PyAny>, Bound<'_, PyAny>)>() {
        Ok((place, turned)) => (vector(&place, what)?, rotation_of(&turned)?),
        Err(_) => {
            let m: [f64; 16] = numbers(value, what)?;
            if m[12..] != [0.0, 0.0, 0.0, 1.0] {
                return Err(input(format!(
                    "{what}: the last row of the matrix is not 0, 0, 0, 1"
                )));
            }
            let rows = [m[0], m[1], m[2], m[4], m[5], m[6], m[8], m[9], m[10]];
            let turned = pyo3::types::PyList::new(value.py(), rows)?;
            ([m[3], m[7], m[11]], matrix(turned.as_any(), what)?)
        }
    };
    Pose::new(place, turned).map_err(input)
}
