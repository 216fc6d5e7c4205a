//! Finds the columns of a table that hold joint positions. A column has the name of its joint, with the suffix `_deg`
//! for degrees.

use rigid_ccd::trajectory::JointKind;
use rigid_ccd_robot::Robot;

/// The suffix of columns in degrees.
const DEGREES_SUFFIX: &str = "_deg";

/// The unit of angles in a column.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum AngleUnit {
    /// Radians.
    Radian,
    /// Degrees.
    Degree,
}

/// The column with a joint's positions.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct JointColumn {
    /// The index of the column.
    pub column: usize,
    /// The unit of its angles. For a prismatic joint, whose positions are lengths, it is [`AngleUnit::Radian`], which
    /// converts nothing.
    pub unit: AngleUnit,
}

/// The reason why no unique column can be found for a joint.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum JointColumnError {
    /// The name of a column fits two joints: `a_deg` may be the joint `a_deg`, or the joint `a` in degrees.
    #[error(
        "`{column}` may be the joint {joint}_deg, or {joint} in degrees; rename one of the joints"
    )]
    Ambiguous {
        /// The name of the column.
        column: String,
        /// The name of one of the joints.
        joint: String,
    },
    /// Two columns fit one joint.
    #[error("two columns for the joint {joint}, {}", columns.join(" and "))]
    Repeated {
        /// The names of the columns.
        columns: [String; 2],
        /// The name of the joint.
        joint: String,
    },
    /// The column of a prismatic joint has the suffix for degrees.
    #[error("`{column}`: the joint {joint} slides, and has no degrees")]
    Slides {
        /// The name of the column.
        column: String,
        /// The name of the joint.
        joint: String,
    },
}

impl AngleUnit {
    /// Converts a position to radians.
    pub fn to_radians(self, position: f64) -> f64 {
        match self {
            AngleUnit::Radian => position,
            AngleUnit::Degree => position.to_radians(),
        }
    }
}

/// Finds the column of a joint, whose name follows `prefix` in the header; `None` if there is none. `unit` is the unit
/// of angles in a column without a suffix.
///
/// # Errors
/// [`JointColumnError`].
pub fn joint_column<N: AsRef<str>>(
    header: &[N],
    robot: &Robot,
    (prefix, joint): (&str, &str),
    unit: AngleUnit,
) -> Result<Option<JointColumn>, JointColumnError> {
    let find = |name: &str| header.iter().position(|column| column.as_ref() == name);
    let turns = robot.joints().iter().any(|candidate| {
        candidate.name == joint && matches!(candidate.geometry.kind(), JointKind::Revolute(_))
    });
    let in_degrees = format!("{joint}{DEGREES_SUFFIX}");
    let names = [joint, &in_degrees].map(|name| format!("{prefix}{name}"));
    let [without_suffix, with_suffix] = names.each_ref().map(|name| find(name));
    let is_other_joint = robot
        .independent_joint_names()
        .any(|other_joint| other_joint == in_degrees);
    let [_, column] = names.clone();
    let joint = joint.to_owned();
    let joint_column = |column, unit| Ok(Some(JointColumn { column, unit }));
    match (without_suffix, with_suffix) {
        (None, Some(_)) if is_other_joint => Err(JointColumnError::Ambiguous { column, joint }),
        (Some(_), Some(_)) if !is_other_joint => Err(JointColumnError::Repeated {
            columns: names,
            joint,
        }),
        (None, Some(_)) if !turns => Err(JointColumnError::Slides { column, joint }),
        (None, Some(column)) => joint_column(column, AngleUnit::Degree),
        (Some(column), _) if turns => joint_column(column, unit),
        (Some(column), _) => joint_column(column, AngleUnit::Radian),
        (None, None) => Ok(None),
    }
}

/// Returns whether a column name is a prefix followed by a joint name, with or without the suffix for degrees.
pub fn names_joint(column: &str, robot: &Robot, prefix: &str) -> bool {
    let Some(name) = column.strip_prefix(prefix) else {
        return false;
    };
    let without_suffix = name.strip_suffix(DEGREES_SUFFIX).unwrap_or(name);
    robot
        .independent_joint_names()
        .any(|joint| joint == name || joint == without_suffix)
}
