//! The Python classes of serial chains, such as robot arms.

use crate::arrays::{finite_numbers, flat_numbers, index, numbers};
use crate::errors::{input_error, warn};
use crate::motion::{GivenPose, pose_matrix, read_given_pose};
use crate::pickle::{ConstructorCall, Reduced};
use pyo3::prelude::*;
use pyo3::types::PyType;
use rigid_ccd::trajectory::{Chain, Joint, Link, Trajectory};
use rigid_ccd::{InputError, Remark};

/// A joint of a `Chain`, as in URDF: `Joint.revolute`, `Joint.prismatic` or `Joint.fixed`.
#[pyclass(name = "Joint", module = "rigid_ccd", frozen)]
pub(crate) struct PyJoint {
    joint: Joint,
    kind: JointKind,
    made: ConstructorCall,
}

/// The degree of freedom of a joint, with its axis.
#[derive(Clone, Copy)]
enum JointKind {
    Revolute([f64; 3]),
    Prismatic([f64; 3]),
    Fixed,
}

#[pymethods]
impl PyJoint {
    /// Makes a joint that rotates about an axis; its position is an angle in radians.
    ///
    /// Args:
    ///     origin: the pose of the joint's frame in that of the link before it, as `Motion.between` takes poses.
    ///     axis: in the joint's frame, of any length.
    ///     limits: the least and the greatest position; None allows any.
    #[classmethod]
    #[pyo3(signature = (origin, axis, limits = None))]
    fn revolute(
        _class: &Bound<'_, PyType>,
        origin: &Bound<'_, PyAny>,
        axis: &Bound<'_, PyAny>,
        limits: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<Self> {
        PyJoint::new(
            JointKind::Revolute(finite_numbers(axis, "axis")?),
            origin,
            limits,
        )
    }

    /// Makes a joint that slides along an axis; its position is a length. Arguments are those of `revolute`.
    #[classmethod]
    #[pyo3(signature = (origin, axis, limits = None))]
    fn prismatic(
        _class: &Bound<'_, PyType>,
        origin: &Bound<'_, PyAny>,
        axis: &Bound<'_, PyAny>,
        limits: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<Self> {
        PyJoint::new(
            JointKind::Prismatic(finite_numbers(axis, "axis")?),
            origin,
            limits,
        )
    }

    /// Makes a joint without a degree of freedom. It has a position all the same, which does not matter.
    #[classmethod]
    fn fixed(_class: &Bound<'_, PyType>, origin: &Bound<'_, PyAny>) -> PyResult<Self> {
        PyJoint::new(JointKind::Fixed, origin, None)
    }

    fn __reduce__<'py>(slf: &Bound<'py, Self>) -> PyResult<Reduced<'py>> {
        slf.get().made.reduce_tuple(slf.get_type())
    }

    /// The least and the greatest allowed position of the joint.
    #[getter]
    fn limits(&self) -> (f64, f64) {
        let limits = self.joint.limits();
        (*limits.start(), *limits.end())
    }

    fn __repr__(&self) -> String {
        let (low, high) = self.limits();
        let name = self.kind.name();
        match self.kind {
            JointKind::Revolute([x, y, z]) | JointKind::Prismatic([x, y, z]) => {
                format!("Joint.{name}(axis=({x}, {y}, {z}), limits=({low}, {high}))")
            }
            JointKind::Fixed => format!("Joint.{name}()"),
        }
    }
}

impl JointKind {
    fn name(self) -> &'static str {
        match self {
            JointKind::Revolute(_) => "revolute",
            JointKind::Prismatic(_) => "prismatic",
            JointKind::Fixed => "fixed",
        }
    }
}

impl PyJoint {
    fn new(
        kind: JointKind,
        given: &Bound<'_, PyAny>,
        limits: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<Self> {
        let origin = read_given_pose(given, "origin")?;
        let pose = origin.pose("origin")?;
        let joint = match kind {
            JointKind::Revolute(axis) => Joint::revolute(pose, axis),
            JointKind::Prismatic(axis) => Joint::prismatic(pose, axis),
            JointKind::Fixed => Ok(Joint::fixed(pose)),
        };
        let limits = limits.map(|limits| numbers(limits, "limits")).transpose()?;
        let joint = match limits {
            // Written so that NaN is refused.
            Some([low, high]) if !(low <= high) => {
                return Err(input_error(format!("limits: {low} is not at most {high}")));
            }
            Some([low, high]) => joint.map_err(input_error)?.with_limits(low..=high),
            None => joint.map_err(input_error)?,
        };
        let (py, name) = (given.py(), Some(kind.name()));
        let made = match kind {
            JointKind::Revolute(axis) | JointKind::Prismatic(axis) => {
                ConstructorCall::new(py, name, (origin, axis, limits))
            }
            JointKind::Fixed => ConstructorCall::new(py, name, (origin,)),
        };
        Ok(PyJoint {
            joint,
            kind,
            made: made?,
        })
    }
}

/// A serial chain of links, such as an arm: joint k connects link k to link k + 1, and link 0 is the base.
///
/// Args:
///     joints: in order from the base.
///     base: the pose of link 0 in the world; None is the world's origin.
///
/// >>> from rigid_ccd import Body, Chain, Joint, first_contact
/// >>> turns = [Joint.revolute(([0, 0, 0], [1, 0, 0, 0]), [0, 0, 1]), Joint.revolute(([1, 0, 0], [1, 0, 0, 0]), [0, 0, 1])]
/// >>> arm = Chain(turns)
/// >>> forearm = arm.link(2, start=[0.3, 0.5], end=[1.3, -1.5])
/// >>> bool((forearm.pose(1) == arm.pose(2, [1.3, -1.5])).all())
/// True
/// >>> ball, post = Body.sphere(0.1), Body.box(0.1, 0.1, 1)
/// >>> first_contact(ball, post, forearm) is None
/// True
#[pyclass(name = "Chain", module = "rigid_ccd", frozen)]
pub(crate) struct PyChain {
    chain: Chain,
    /// The Python objects of the joints, kept for pickle.
    joints: Vec<Py<PyJoint>>,
    base: GivenPose,
}

#[pymethods]
impl PyChain {
    #[new]
    #[pyo3(signature = (joints, base = None))]
    fn new(joints: &Bound<'_, PyAny>, base: Option<&Bound<'_, PyAny>>) -> PyResult<Self> {
        // Collect one by one, because an object may report a wrong length.
        let joints = joints
            .try_iter()?
            .map(|joint| Ok(joint?.cast_into::<PyJoint>()?.unbind()));
        let joints: Vec<Py<PyJoint>> = joints.collect::<PyResult<_>>()?;
        let base = base.map_or(Ok(GivenPose::IDENTITY), |base| {
            read_given_pose(base, "base")
        })?;
        let of_chain = joints.iter().map(|joint| joint.get().joint.clone());
        Ok(PyChain {
            chain: Chain::new(base.pose("base")?, of_chain.collect()),
            joints,
            base,
        })
    }

    /// The joints of the chain, in order from the base.
    #[getter]
    fn joints(&self, py: Python<'_>) -> Vec<Py<PyJoint>> {
        self.joints
            .iter()
            .map(|joint| joint.clone_ref(py))
            .collect()
    }

    fn __reduce__<'py>(slf: &Bound<'py, Self>) -> (Bound<'py, PyType>, ChainParts) {
        let chain = slf.get();
        (slf.get_type(), (chain.joints(slf.py()), chain.base))
    }

    fn __repr__(&self) -> String {
        let joints = self.joints.iter().map(|joint| joint.get().kind.name());
        let joints: Vec<&str> = joints.collect();
        format!("Chain({} joints: {})", joints.len(), joints.join(", "))
    }

    fn __len__(&self) -> usize {
        self.chain.joints().len()
    }

    /// Returns the pose of a link for given positions of the joints, as a matrix of shape (4, 4).
    fn pose<'py>(
        &self,
        py: Python<'py>,
        link: i64,
        positions: &Bound<'_, PyAny>,
    ) -> PyResult<Bound<'py, numpy::PyArray2<f64>>> {
        let positions = flat_numbers(positions, "positions")?;
        let pose = self.chain.pose(index(link, "link")?, &positions);
        Ok(pose_matrix(py, &pose.map_err(input_error)?))
    }

    /// Returns the motion of a link while each joint moves at a constant rate from its position in `start` to that in
    /// `end`, as along an edge of a motion planner's roadmap.
    ///
    /// It stands for a `Motion` in all queries: the proof is about the link's own curve, not about steps of it.
    ///
    /// Args:
    ///     link: its number; link k + 1 is after joint k.
    ///     start, end: a position for each joint at both ends, fixed ones included; no rates.
    ///     duration: the time from one to the other.
    ///
    /// Raises:
    ///     InputError: a position is outside of its joint's limits, or there are more or fewer than joints.
    #[pyo3(signature = (link, start, end, duration = 1.0))]
    fn link(
        slf: Bound<'_, Self>,
        link: i64,
        start: &Bound<'_, PyAny>,
        end: &Bound<'_, PyAny>,
        duration: f64,
    ) -> PyResult<PyLink> {
        let (start, end) = (flat_numbers(start, "start")?, flat_numbers(end, "end")?);
        let joints = slf.get().joints.iter();
        let turning = joints.map(|joint| matches!(joint.get().kind, JointKind::Revolute(_)));
        let ends = turning.zip(start.iter().zip(&end));
        let mut remarks = ends
            .filter(|(turns, _)| *turns)
            .flat_map(|(_, (start, end))| [*start, *end])
            .filter_map(Remark::remark_on_joint);
        warn(slf.py(), remarks.next(), 1)?;
        let moves = LinkMotion {
            link: index(link, "link")?,
            frame_link: None,
            start,
            end,
            duration,
        };
        PyLink::new(slf.unbind(), moves)
    }
}

/// The pickled form of a chain: its joints and its base.
type ChainParts = (Vec<Py<PyJoint>>, GivenPose);

/// A moving link of a `Chain`; `Chain.link` makes it.
///
/// Times and distances are as certain as those of a `Motion`. Witnesses are within the tolerance of where they are said
/// to be.
#[pyclass(name = "Link", module = "rigid_ccd", frozen)]
pub(crate) struct PyLink {
    chain: Py<PyChain>,
    moves: LinkMotion,
}

/// The number of a link in its chain, and the motion of the chain's joints.
#[derive(Clone, FromPyObject, IntoPyObject)]
#[pyo3(from_item_all)]
struct LinkMotion {
    link: usize,
    frame_link: Option<usize>,
    start: Vec<f64>,
    end: Vec<f64>,
    duration: f64,
}

#[pymethods]
impl PyLink {
    /// Returns the motion of this link in the frame of another link that is nearer to the base. Query it against that
    /// link's body at rest.
    ///
    /// Witnesses and normals are in that frame, too: `chain.pose(other, ...)` takes them to the world.
    fn seen_from(&self, py: Python<'_>, link: i64) -> PyResult<Self> {
        let moves = LinkMotion {
            frame_link: Some(index(link, "link")?),
            ..self.moves.clone()
        };
        PyLink::new(self.chain.clone_ref(py), moves)
    }

    /// Returns the pose of the link at a time, as a matrix of shape (4, 4).
    fn pose<'py>(&self, py: Python<'py>, time: f64) -> PyResult<Bound<'py, numpy::PyArray2<f64>>> {
        let pose = Trajectory::pose(&self.link()?, time);
        Ok(pose_matrix(py, &pose.map_err(input_error)?))
    }

    /// The time at which the joints reach their positions in `end`.
    #[getter]
    pub(crate) fn duration(&self) -> f64 {
        self.moves.duration
    }

    fn __reduce__<'py>(slf: &Bound<'py, Self>) -> PyResult<Reduced<'py>> {
        let parts = (&slf.get().chain, slf.get().moves.clone());
        let make = slf.get_type().getattr("_from_parts")?;
        Ok((make, parts.into_pyobject(slf.py())?))
    }

    /// Makes a link from its pickled form.
    #[classmethod]
    fn _from_parts(
        _class: &Bound<'_, PyType>,
        chain: Py<PyChain>,
        moves: LinkMotion,
    ) -> PyResult<Self> {
        PyLink::new(chain, moves)
    }

    fn __repr__(&self) -> String {
        let LinkMotion {
            link,
            frame_link,
            start,
            end,
            duration,
        } = &self.moves;
        let seen = frame_link.map_or_else(String::new, |link| format!(", seen_from={link}"));
        format!("Link({link}, start={start:?}, end={end:?}, duration={duration}{seen})")
    }
}

impl PyLink {
    /// Makes a moving link, or an error if positions are missing or outside their joints' limits.
    fn new(chain: Py<PyChain>, moves: LinkMotion) -> PyResult<Self> {
        let joints = chain.get().chain.joints().len();
        for (what, positions) in [("start", &moves.start), ("end", &moves.end)] {
            if positions.len() != joints {
                let positions = positions.len();
                let error = InputError::JointCountMismatch { positions, joints };
                return Err(input_error(format!("{what}: {error}")));
            }
        }
        let link = PyLink { chain, moves };
        link.link()?;
        Ok(link)
    }

    /// Returns the link's trajectory, in the world's frame or in that of the link `seen_from`.
    pub(crate) fn link(&self) -> PyResult<Link<'_>> {
        let chain = &self.chain.get().chain;
        let moves = &self.moves;
        let link = chain
            .link(moves.link, &moves.start, &moves.end, moves.duration)
            .map_err(input_error)?;
        match moves.frame_link {
            Some(from) => link.seen_from(from).map_err(input_error),
            None => Ok(link),
        }
    }
}
