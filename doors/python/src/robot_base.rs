//! The bases of combined robots: their poses and how they move.

use crate::errors::input_error;
use crate::motion::{GivenPose, read_given_pose};
use pyo3::prelude::*;
use pyo3::types::PyMapping;
use rigid_ccd_robot::CompoundKind;

/// The base of a robot: the link that carries it, its pose, and how it moves.
pub(crate) struct RobotBase {
    /// The link that carries the base; `None` for the world.
    pub(crate) carrier: Option<String>,
    /// The pose in the frame of the carrier.
    pub(crate) pose: GivenPose,
    /// "fixed", "planar" or "floating".
    pub(crate) motion_name: String,
}

impl RobotBase {
    /// Reads the base of each robot in `names`. The dicts have the poses, motions and carriers of some bases.
    pub(crate) fn read_all(
        names: &[String],
        poses: Option<&Bound<'_, PyMapping>>,
        motions: Option<&Bound<'_, PyMapping>>,
        carriers: Option<&Bound<'_, PyMapping>>,
    ) -> PyResult<Vec<Self>> {
        let at_rest = || RobotBase {
            carrier: None,
            pose: GivenPose::IDENTITY,
            motion_name: "fixed".to_owned(),
        };
        let mut bases: Vec<RobotBase> = names.iter().map(|_| at_rest()).collect();
        let robot_index = |name: &str, argument_name: &str| {
            let index = names.iter().position(|other| other == name);
            index.ok_or_else(|| input_error(format!("{argument_name}: there is no robot '{name}'")))
        };
        for (name, pose) in entries(poses)? {
            bases[robot_index(&name, "poses")?].pose = read_given_pose(&pose, "poses")?;
        }
        for (name, motion) in entries(motions)? {
            bases[robot_index(&name, "bases")?].motion_name = motion.extract()?;
        }
        for (name, link) in entries(carriers)? {
            bases[robot_index(&name, "carriers")?].carrier = Some(link.extract()?);
        }
        Ok(bases)
    }

    /// Returns how the base moves, or `None` if it is fixed.
    pub(crate) fn motion(&self) -> PyResult<Option<CompoundKind>> {
        match self.motion_name.as_str() {
            "fixed" => Ok(None),
            "floating" => Ok(Some(CompoundKind::Floating)),
            "planar" => Ok(Some(CompoundKind::Planar {
                normal: [0.0, 0.0, 1.0],
            })),
            other => Err(input_error(format!(
                "bases: '{other}' is not fixed, planar or floating"
            ))),
        }
    }
}

type Entries<'py> = Vec<(String, Bound<'py, PyAny>)>;

fn entries<'py>(mapping: Option<&Bound<'py, PyMapping>>) -> PyResult<Entries<'py>> {
    let items = mapping.map(|mapping| mapping.items()).transpose()?;
    items.iter().flatten().map(|item| item.extract()).collect()
}
