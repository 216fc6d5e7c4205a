//! Combines robots to one for `Robot.combined`.

use crate::errors::input_error;
use crate::motion::{GivenPose, read_given_pose};
use crate::robot::PyRobot;
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyMapping};
use rigid_ccd_robot::{CompoundKind, LinkPairs, PlacedRobot, Robot};

/// What was given to `Robot.combined`, robot by robot.
pub(crate) struct GivenRobots(Vec<GivenRobot>);

struct GivenRobot {
    name: String,
    robot: Py<PyRobot>,
    pose: GivenPose,
    base: String,
}

impl GivenRobots {
    /// Reads robots by name, and the poses and kinds of some of their bases.
    pub(crate) fn read(
        robots: &Bound<'_, PyMapping>,
        poses: Option<&Bound<'_, PyMapping>>,
        bases: Option<&Bound<'_, PyMapping>>,
    ) -> PyResult<Self> {
        let mut given = Vec::new();
        for item in robots.items()?.iter() {
            let (name, robot) = item.extract()?;
            given.push(GivenRobot {
                name,
                robot,
                pose: GivenPose::IDENTITY,
                base: "fixed".to_owned(),
            });
        }
        let mut all = GivenRobots(given);
        for (name, pose) in entries(poses)? {
            all.named(&name, "poses")?.pose = read_given_pose(&pose, "poses")?;
        }
        for (name, base) in entries(bases)? {
            all.named(&name, "bases")?.base = base.extract()?;
        }
        Ok(all)
    }

    fn named(&mut self, name: &str, what: &str) -> PyResult<&mut GivenRobot> {
        let found = self.0.iter_mut().find(|given| given.name == name);
        found.ok_or_else(|| input_error(format!("{what}: there is no robot '{name}'")))
    }

    /// Combines the robots.
    pub(crate) fn combine(&self) -> PyResult<(Robot, LinkPairs)> {
        let placed = self.0.iter().map(|given| {
            let robot = given.robot.get();
            Ok(PlacedRobot {
                name: &given.name,
                robot: &robot.robot,
                pairs: &robot.pairs,
                pose: given.pose.pose("poses")?,
                base_motion: base_motion(&given.base)?,
            })
        });
        let placed: Vec<PlacedRobot<'_>> = placed.collect::<PyResult<_>>()?;
        Robot::combine(&placed).map_err(input_error)
    }

    /// Returns the arguments that make the same robot.
    pub(crate) fn arguments<'py>(&self, py: Python<'py>) -> PyResult<[Bound<'py, PyDict>; 3]> {
        let [robots, poses, bases] = [(); 3].map(|()| PyDict::new(py));
        for given in &self.0 {
            robots.set_item(&given.name, given.robot.clone_ref(py))?;
            poses.set_item(&given.name, given.pose)?;
            bases.set_item(&given.name, &given.base)?;
        }
        Ok([robots, poses, bases])
    }
}

type Entries<'py> = Vec<(String, Bound<'py, PyAny>)>;

fn entries<'py>(given: Option<&Bound<'py, PyMapping>>) -> PyResult<Entries<'py>> {
    let items = given.map(|given| given.items()).transpose()?;
    items.iter().flatten().map(|item| item.extract()).collect()
}

fn base_motion(name: &str) -> PyResult<Option<CompoundKind>> {
    match name {
        "fixed" => Ok(None),
        "floating" => Ok(Some(CompoundKind::Floating)),
        "planar" => Ok(Some(CompoundKind::Planar {
            normal: [0.0, 0.0, 1.0],
        })),
        _ => Err(input_error(format!(
            "bases: '{name}' is not fixed, planar or floating"
        ))),
    }
}
