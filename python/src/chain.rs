//! Serial chains: the links of an arm.

use crate::arrays::vector;
use crate::errors::input;
use crate::motion::{matrix_of, pose_of};
use pyo3::prelude::*;
use pyo3::types::PyType;
use rigid_ccd::Pose;
use rigid_ccd::trajectory::{Chain, Joint, Link, Trajectory};

/// A joint of a `Chain`, as in URDF: `Joint.revolute`, `Joint.prismatic` or `Joint.fixed`.
#[pyclass(name = "Joint", module = "rigid_ccd", frozen)]
pub(crate) struct PyJoint {
    joint: Joint,
    kind: &'static str,
}

#[pymethods]
impl PyJoint {
    /// A joint that turns about an axis; its position is an angle in radians.
    ///
    /// Args:
    ///     origin: the pose of the joint's frame in that of the link before it, as `Motion.between` takes poses.
    ///     axis: in the joint's frame, of any length.
    ///     limits: the least and the greatest position; None allows any.
    #[classmethod]
    #[pyo3(signature = (origin, axis, *, limits = None))]
    fn revolute(
        _class: &Bound<'_, PyType>,
        origin: &Bound<'_, PyAny>,
        axis: &Bound<'_, PyAny>,
        limits: Option<(f64, f64)>,
    ) -> PyResult<Self> {
        let (origin, axis) = (pose_of(origin, "origin")?, vector(axis, "axis")?);
        PyJoint::within(
            "revolute",
            Joint::revolute(origin, axis).map_err(input)?,
            limits,
        )
    }

    /// A joint that slides along an axis; its position is a length. Arguments are those of `revolute`.
    #[classmethod]
    #[pyo3(signature = (origin, axis, *, limits = None))]
    fn prismatic(
        _class: &Bound<'_, PyType>,
        origin: &Bound<'_, PyAny>,
        axis: &Bound<'_, PyAny>,
        limits: Option<(f64, f64)>,
    ) -> PyResult<Self> {
        let (origin, axis) = (pose_of(origin, "origin")?, vector(axis, "axis")?);
        PyJoint::within(
            "prismatic",
            Joint::prismatic(origin, axis).map_err(input)?,
            limits,
        )
    }

    /// A joint without a freedom. It has a position all the same, which does not matter.
    #[classmethod]
    fn fixed(_class: &Bound<'_, PyType>, origin: &Bound<'_, PyAny>) -> PyResult<Self> {
        PyJoint::within("fixed", Joint::fixed(pose_of(origin, "origin")?), None)
    }

    /// The least and the greatest position.
    #[getter]
    fn limits(&self) -> (f64, f64) {
        let limits = self.joint.limits();
        (*limits.start(), *limits.end())
    }

    fn __repr__(&self) -> String {
        let (low, high) = self.limits();
        format!("Joint.{}(limits=({low}, {high}))", self.kind)
    }
}

impl PyJoint {
    fn within(kind: &'static str, joint: Joint, limits: Option<(f64, f64)>) -> PyResult<Self> {
        let joint = match limits {
            // Written so that NaN is refused.
            Some((low, high)) if !(low <= high) => {
                return Err(input(format!("limits: {low} is not at most {high}")));
            }
            Some((low, high)) => joint.within(low..=high),
            None => joint,
        };
        Ok(PyJoint { joint, kind })
    }
}

/// A serial chain of links, as of an arm: joint k connects link k to link k + 1, and link 0 is the base.
///
/// Args:
///     joints: in order from the base.
///     base: the pose of link 0 in the world; None is the world's origin.
///
/// >>> from rigid_ccd import Body, Chain, Joint, first_contact
/// >>> turns = [Joint.revolute(([0, 0, 0], [1, 0, 0, 0]), [0, 0, 1]), Joint.revolute(([1, 0, 0], [1, 0, 0, 0]), [0, 0, 1])]
/// >>> arm = Chain(turns)
/// >>> forearm = arm.link(2, [0, 0], [1, -2])
/// >>> arm.pose(2, [0, 0])[:3, 3]
/// array([1., 0., 0.])
/// >>> ball, post = Body.sphere(0.1), Body.box(0.1, 0.1, 1)
/// >>> first_contact(ball, post, forearm) is None
/// True
#[pyclass(name = "Chain", module = "rigid_ccd", frozen)]
pub(crate) struct PyChain {
    chain: Chain,
}

#[pymethods]
impl PyChain {
    #[new]
    #[pyo3(signature = (joints, base = None))]
    fn new(joints: Vec<Py<PyJoint>>, base: Option<&Bound<'_, PyAny>>) -> PyResult<Self> {
        let base = base.map_or(Ok(Pose::IDENTITY), |base| pose_of(base, "base"))?;
        let joints = joints.iter().map(|joint| joint.get().joint.clone());
        Ok(PyChain {
            chain: Chain::new(base, joints.collect()),
        })
    }

    fn __len__(&self) -> usize {
        self.chain.joints().len()
    }

    /// The pose of a link at some positions of the joints, as a matrix of shape (4, 4).
    fn pose<'py>(
        &self,
        py: Python<'py>,
        link: usize,
        positions: Vec<f64>,
    ) -> PyResult<Bound<'py, numpy::PyArray2<f64>>> {
        Ok(matrix_of(
            py,
            &self.chain.pose(link, &positions).map_err(input)?,
        ))
    }

    /// A link while all joints move at constant rates: an edge of a planner.
    ///
    /// It stands for a `Motion` in all queries: the proof is about the link's own curve, not about steps of it.
    ///
    /// Args:
    ///     link: its number; link k + 1 is after joint k.
    ///     start, end: a position for each joint, fixed ones included.
    ///     duration: the time from one to the other.
    ///
    /// Raises:
    ///     InputError: a position is outside of its joint's limits, or there are more or fewer than joints.
    #[pyo3(signature = (link, start, end, *, duration = 1.0))]
    fn link(
        slf: Bound<'_, Self>,
        link: usize,
        start: Vec<f64>,
        end: Vec<f64>,
        duration: f64,
    ) -> PyResult<PyLink> {
        let link = PyLink {
            chain: slf.unbind(),
            link,
            seen_from: None,
            start,
            end,
            duration,
        };
        link.link()?;
        Ok(link)
    }
}

/// A moving link of a `Chain`; `Chain.link` makes it.
#[pyclass(name = "Link", module = "rigid_ccd", frozen)]
pub(crate) struct PyLink {
    chain: Py<PyChain>,
    link: usize,
    seen_from: Option<usize>,
    start: Vec<f64>,
    end: Vec<f64>,
    duration: f64,
}

#[pymethods]
impl PyLink {
    /// The same link in the frame of another, nearer to the base: ask about it against that link's body at rest.
    fn seen_from(&self, py: Python<'_>, link: usize) -> PyResult<Self> {
        let seen = PyLink {
            chain: self.chain.clone_ref(py),
            link: self.link,
            seen_from: Some(link),
            start: self.start.clone(),
            end: self.end.clone(),
            duration: self.duration,
        };
        seen.link()?;
        Ok(seen)
    }

    /// The pose at a time, as a matrix of shape (4, 4).
    fn pose<'py>(&self, py: Python<'py>, time: f64) -> PyResult<Bound<'py, numpy::PyArray2<f64>>> {
        let pose = Trajectory::pose(&self.link()?, time);
        Ok(matrix_of(py, &pose.map_err(input)?))
    }

    fn __repr__(&self) -> String {
        let seen = self
            .seen_from
            .map_or_else(String::new, |link| format!(", seen_from={link}"));
        format!(
            "Link({}, start={:?}, end={:?}{seen})",
            self.link, self.start, self.end
        )
    }
}

impl PyLink {
    /// Returns the trajectory.
    pub(crate) fn link(&self) -> PyResult<Link<'_>> {
        let chain = &self.chain.get().chain;
        let link = chain
            .link(self.link, &self.start, &self.end, self.duration)
            .map_err(input)?;
        match self.seen_from {
            Some(from) => link.seen_from(from).map_err(input),
            None => Ok(link),
        }
    }
}
