//! The columns of tables that have the positions of joints. They are named like the joints, with the end `_deg` for degrees.

use rigid_ccd::trajectory::JointKind;
use rigid_ccd_robot::Robot;

/// The end of the name of a column whose positions are in degrees.
const DEGREES_SUFFIX: &str = "_deg";

/// The unit of the positions of a joint that turns.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum AngleUnit {
    /// Radians.
    Radian,
    /// Degrees.
    Degree,
}

/// The column of a joint.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct JointColumn {
    /// The number of the column.
    pub column: usize,
    /// The unit of angles in it; of a joint that slides, it has lengths and the unit is that of radians.
    pub unit: AngleUnit,
}

/// Why columns cannot be those of a joint.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum JointColumnError {
    /// The name of a column may be that of two joints.
    #[error(
        "`{column}` may be the joint {joint}_deg, or {joint} in degrees; rename one of the joints"
    )]
    Ambiguous {
        /// The name of the column.
        column: String,
        /// The name of one of the joints.
        joint: String,
    },
    /// A joint has two columns.
    #[error("two columns for the joint {joint}, {}", columns.join(" and "))]
    Repeated {
        /// The names of the columns.
        columns: [String; 2],
        /// The name of the joint.
        joint: String,
    },
    /// A joint that slides has no degrees.
    #[error("`{column}`: the joint {joint} slides, and has no degrees")]
    Slides {
        /// The name of the column.
        column: String,
        /// The name of the joint.
        joint: String,
    },
}

impl AngleUnit {
    /// Returns a position in radians.
    pub fn to_radians(self, position: f64) -> f64 {
        match self {
            AngleUnit::Radian => position,
            AngleUnit::Degree => position.to_radians(),
        }
    }
}

/// Returns the column that a joint has, with a prefix before its name; `None` if it has none. A column whose name says no unit has
/// angles in `unit`.
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
    let turns = robot.joints().iter().any(|own| {
        own.name == joint && matches!(own.axis_and_limits.kind(), JointKind::Revolute(_))
    });
    let in_degrees = format!("{joint}{DEGREES_SUFFIX}");
    let names = [joint, &in_degrees].map(|name| format!("{prefix}{name}"));
    let [plain, degrees] = names.each_ref().map(|name| find(name));
    let is_other_joint = robot.free_joint_names().any(|own| own == in_degrees);
    let [_, column] = names.clone();
    let joint = joint.to_owned();
    let found = |column, unit| Ok(Some(JointColumn { column, unit }));
    match (plain, degrees) {
        (None, Some(_)) if is_other_joint => Err(JointColumnError::Ambiguous { column, joint }),
        (Some(_), Some(_)) if !is_other_joint => Err(JointColumnError::Repeated {
            columns: names,
            joint,
        }),
        (None, Some(_)) if !turns => Err(JointColumnError::Slides { column, joint }),
        (None, Some(column)) => found(column, AngleUnit::Degree),
        (Some(column), _) if turns => found(column, unit),
        (Some(column), _) => found(column, AngleUnit::Radian),
        (None, None) => Ok(None),
    }
}

/// Returns whether the name of a column is that of a joint, with a prefix before it, and perhaps with the end for degrees.
pub fn names_joint(column: &str, robot: &Robot, prefix: &str) -> bool {
    let Some(name) = column.strip_prefix(prefix) else {
        return false;
    };
    let without_suffix = name.strip_suffix(DEGREES_SUFFIX).unwrap_or(name);
    robot
        .free_joint_names()
        .any(|joint| joint == name || joint == without_suffix)
}
