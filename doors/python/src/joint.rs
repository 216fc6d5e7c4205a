//! The Python class `Joint`: a revolute, prismatic or fixed joint of a robot.

use crate::arrays::{finite_numbers, numbers};
use crate::errors::input_error;
use crate::motion::{GivenPose, read_given_pose};
use crate::pickle::{ConstructorCall, Reduced};
use pyo3::prelude::*;
use pyo3::types::PyType;
use rigid_ccd::{InputError, Pose, trajectory};
use rigid_ccd_robot::{Joint, PositionRule};

/// A joint of a `Robot`, as in URDF. It connects the link `child` to the link `parent`. Make one with `Joint.revolute`,
/// `Joint.prismatic` or `Joint.fixed`.
#[pyclass(name = "Joint", module = "rigid_ccd", frozen)]
pub(crate) struct PyJoint {
    pub(crate) joint: Joint,
    kind: &'static str,
    constructor_call: ConstructorCall,
}

/// The rule by which a joint follows another one: the name of the other joint, the multiplier and the offset.
type Mimic = (String, f64, f64);

/// Makes a joint from the pose of its frame and its axis.
type MakeJoint = fn(Pose, [f64; 3]) -> Result<trajectory::Joint, InputError>;

/// The optional arguments of a joint with a degree of freedom: origin, axis, limits and mimic.
type MovingJointArgs<'a, 'py> = (
    Option<&'a Bound<'py, PyAny>>,
    Option<&'a Bound<'py, PyAny>>,
    Option<&'a Bound<'py, PyAny>>,
    Option<Mimic>,
);

#[pymethods]
impl PyJoint {
    /// Makes a joint that rotates about an axis. Its position is an angle in radians.
    ///
    /// Args:
    ///     name, parent, child: the names of the joint and of both links.
    ///     origin: the pose of the joint's frame in the parent's frame, in the forms of `Motion.between`; None is the
    ///         identity.
    ///     axis: the axis in the joint's frame. It need not be normalised. None is z.
    ///     limits: the least and the greatest position; None is no limits.
    ///     mimic: the name of the joint that this one follows, the multiplier and the offset.
    #[classmethod]
    #[pyo3(signature = (name, parent, child, origin = None, axis = None, limits = None, mimic = None))]
    #[expect(clippy::too_many_arguments, reason = "arguments with names")]
    fn revolute(
        class: &Bound<'_, PyType>,
        name: &str,
        parent: &str,
        child: &str,
        origin: Option<&Bound<'_, PyAny>>,
        axis: Option<&Bound<'_, PyAny>>,
        limits: Option<&Bound<'_, PyAny>>,
        mimic: Option<Mimic>,
    ) -> PyResult<Self> {
        let arguments = (origin, axis, limits, mimic);
        let make = |pose, axis: [f64; 3]| trajectory::Joint::revolute(pose, axis);
        PyJoint::moving_joint(
            class.py(),
            ("revolute", make),
            [name, parent, child],
            arguments,
        )
    }

    /// Makes a joint that slides along an axis. Its position is a length. The arguments are those of `revolute`.
    #[classmethod]
    #[pyo3(signature = (name, parent, child, origin = None, axis = None, limits = None, mimic = None))]
    #[expect(clippy::too_many_arguments, reason = "arguments with names")]
    fn prismatic(
        class: &Bound<'_, PyType>,
        name: &str,
        parent: &str,
        child: &str,
        origin: Option<&Bound<'_, PyAny>>,
        axis: Option<&Bound<'_, PyAny>>,
        limits: Option<&Bound<'_, PyAny>>,
        mimic: Option<Mimic>,
    ) -> PyResult<Self> {
        let arguments = (origin, axis, limits, mimic);
        let make = |pose, axis: [f64; 3]| trajectory::Joint::prismatic(pose, axis);
        PyJoint::moving_joint(
            class.py(),
            ("prismatic", make),
            [name, parent, child],
            arguments,
        )
    }

    /// Makes a joint without a degree of freedom. Configurations have no position for it.
    #[classmethod]
    #[pyo3(signature = (name, parent, child, origin = None))]
    fn fixed(
        class: &Bound<'_, PyType>,
        name: &str,
        parent: &str,
        child: &str,
        origin: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<Self> {
        let origin = read_origin(origin)?;
        let joint = trajectory::Joint::fixed(origin.pose("origin")?);
        let names = [name, parent, child];
        Ok(PyJoint {
            joint: build_joint(names, joint, None),
            kind: "fixed",
            constructor_call: ConstructorCall::new(
                class.py(),
                Some("fixed"),
                (name, parent, child, origin),
            )?,
        })
    }

    /// The name of the joint, unique in a robot.
    #[getter]
    fn name(&self) -> &str {
        &self.joint.name
    }

    /// The least and the greatest allowed position of the joint.
    #[getter]
    fn limits(&self) -> (f64, f64) {
        let limits = self.joint.geometry.limits();
        (*limits.start(), *limits.end())
    }

    fn __reduce__<'py>(slf: &Bound<'py, Self>) -> PyResult<Reduced<'py>> {
        slf.get().constructor_call.reduce_tuple(slf.get_type())
    }

    fn __repr__(&self) -> String {
        let Joint {
            name,
            parent,
            child,
            ..
        } = &self.joint;
        format!("Joint.{}('{name}', '{parent}', '{child}')", self.kind)
    }
}

impl PyJoint {
    /// Makes a revolute or prismatic joint with a constructor. Python calls the constructor `kind`.
    fn moving_joint(
        py: Python<'_>,
        (kind, make): (&'static str, MakeJoint),
        names: [&str; 3],
        (origin, axis, limits, mimic): MovingJointArgs<'_, '_>,
    ) -> PyResult<Self> {
        let origin = read_origin(origin)?;
        let pose = origin.pose("origin")?;
        let axis = axis.map_or(Ok([0.0, 0.0, 1.0]), |axis| finite_numbers(axis, "axis"))?;
        let mut joint = make(pose, axis).map_err(input_error)?;
        let limits: Option<[f64; 2]> =
            limits.map(|limits| numbers(limits, "limits")).transpose()?;
        if let Some([low, high]) = limits {
            // The comparison is written so that NaN is refused.
            if !(low <= high && low < f64::INFINITY && high > f64::NEG_INFINITY) {
                let text = format!("limits: no position is between {low} and {high}");
                return Err(input_error(text));
            }
            joint = joint.with_limits(low..=high);
        }
        let [name, parent, child] = names;
        let arguments = (name, parent, child, origin, axis, limits, mimic.clone());
        Ok(PyJoint {
            joint: build_joint(names, joint, mimic),
            kind,
            constructor_call: ConstructorCall::new(py, Some(kind), arguments)?,
        })
    }
}

fn read_origin(origin: Option<&Bound<'_, PyAny>>) -> PyResult<GivenPose> {
    origin.map_or(Ok(GivenPose::IDENTITY), |origin| {
        read_given_pose(origin, "origin")
    })
}

fn build_joint(names: [&str; 3], joint: trajectory::Joint, mimic: Option<Mimic>) -> Joint {
    let [name, parent, child] = names.map(str::to_owned);
    let position = match mimic {
        Some((joint, multiplier, offset)) => PositionRule::Follows {
            joint,
            multiplier,
            offset,
        },
        None => PositionRule::Independent,
    };
    Joint {
        name,
        parent,
        child,
        geometry: joint,
        position_rule: position,
    }
}
