//! The Python class `LinkTrajectory`.

use crate::configurations::read_configurations;
use crate::errors::{input_error, warn};
use crate::motion::pose_matrix;
use crate::pickle::Reduced;
use pyo3::prelude::*;
use rigid_ccd::Remark;
use rigid_ccd::trajectory::{JointKind, LinkTrajectory, Trajectory};
use rigid_ccd_robot::{ChainBetween, Robot};

/// The motion of a link of a `Robot` while all joints move at constant rates. `Robot.link_trajectory` makes it.
///
/// All queries take it in place of a `Motion`. Times and distances are certified, as for a `Motion`. Witness
/// points are accurate to the tolerance.
#[pyclass(name = "LinkTrajectory", module = "rigid_ccd", frozen)]
pub(crate) struct PyLinkTrajectory {
    /// The Python object whose method `link_trajectory` made this trajectory.
    robot: Py<PyAny>,
    arguments: LinkTrajectoryArguments,
    chain: ChainBetween,
    /// The positions of the chain's joints at the start and at the end.
    ends: [Vec<f64>; 2],
}

/// The arguments of `Robot.link_trajectory`.
#[derive(Clone, IntoPyObject)]
pub(crate) struct LinkTrajectoryArguments(String, Vec<f64>, Vec<f64>, f64, Option<String>);

#[pymethods]
impl PyLinkTrajectory {
    /// Returns the pose of the link at a time, as a matrix of shape (4, 4).
    fn pose<'py>(&self, py: Python<'py>, time: f64) -> PyResult<Bound<'py, numpy::PyArray2<f64>>> {
        let pose = Trajectory::pose(&self.link()?, time);
        Ok(pose_matrix(py, &pose.map_err(input_error)?))
    }

    /// The time at which the joints reach their positions in `end`.
    #[getter]
    pub(crate) fn duration(&self) -> f64 {
        self.arguments.3
    }

    fn __reduce__<'py>(slf: &Bound<'py, Self>) -> PyResult<Reduced<'py>> {
        let make = slf.get().robot.bind(slf.py()).getattr("link_trajectory")?;
        Ok((make, slf.get().arguments.clone().into_pyobject(slf.py())?))
    }

    fn __repr__(&self) -> String {
        let LinkTrajectoryArguments(link, start, end, duration, seen_from) = &self.arguments;
        let seen_from_text = seen_from
            .as_ref()
            .map_or_else(String::new, |link| format!(", seen_from='{link}'"));
        format!(
            "LinkTrajectory('{link}', start={start:?}, end={end:?}, duration={duration}{seen_from_text})"
        )
    }
}

impl PyLinkTrajectory {
    /// Makes the motion of a link. Fails if positions are missing, or exceed the limits of their joints.
    pub(crate) fn new(
        robot: &Bound<'_, PyAny>,
        robot_model: &Robot,
        link: String,
        [start, end]: [&Bound<'_, PyAny>; 2],
        duration: f64,
        seen_from: Option<String>,
    ) -> PyResult<Self> {
        let link_index = robot_model.link_number(&link).map_err(input_error)?;
        let reference_index = seen_from
            .as_ref()
            .map_or(Ok(robot_model.base()), |name| robot_model.link_number(name))
            .map_err(input_error)?;
        let chain = robot_model.chain_between(reference_index, link_index);
        let start = read_configurations(start, robot_model, "start")?.values;
        let end = read_configurations(end, robot_model, "end")?.values;
        let positions = |argument_name, configuration: &[f64]| {
            let positions = chain.positions(robot_model, configuration);
            positions.map_err(|error| input_error(format!("{argument_name}: {error}")))
        };
        let ends = [positions("start", &start)?, positions("end", &end)?];
        let joints = chain.chain().joints().iter().enumerate();
        let mut remarks = joints
            .filter(|(_, joint)| matches!(joint.kind(), JointKind::Revolute(_)))
            .flat_map(|(k, _)| [ends[0][k], ends[1][k]])
            .filter_map(Remark::remark_on_joint);
        warn(robot.py(), remarks.next(), 1)?;
        let motion = PyLinkTrajectory {
            robot: robot.clone().unbind(),
            arguments: LinkTrajectoryArguments(link, start, end, duration, seen_from),
            ends,
            chain,
        };
        motion.link()?;
        Ok(motion)
    }

    /// Returns the link's trajectory.
    pub(crate) fn link(&self) -> PyResult<LinkTrajectory<'_>> {
        let [start, end] = &self.ends;
        let link = self
            .chain
            .chain()
            .link(start.len(), start, end, self.duration());
        link.map_err(input_error)
    }
}
