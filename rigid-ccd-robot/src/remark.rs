//! Remarks on robots and cells that are valid, but probably a mistake.

use rigid_ccd::Remark;
use std::fmt;

/// A remark on a robot or a cell that is valid, but probably a mistake. It changes no answer.
///
/// [`Cell::remarks`](crate::Cell::remarks) lists those on a cell. The command prints them, and the Python package warns of them.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum CellRemark {
    /// Something in a robot's file is left out, which another program may take into account.
    LeftOut {
        /// The element, with the name of what it belongs to.
        element: String,
    },
    /// An SRDF disables or enables pairs of links that the robot does not have, and these pairs are left out.
    UnknownLinks {
        /// The names of the links.
        links: Vec<String>,
    },
    /// An SRDF is of a robot with another name.
    OtherRobotName {
        /// The name of the robot.
        robot: String,
        /// The name in the SRDF.
        of_srdf: String,
    },
    /// A link is a hundred times as large as the robot's reach, or something else a hundred times as large as the robot or
    /// a thousandth of it.
    UnlikelySize {
        /// The name of the link, the attached body or the obstacle.
        item: String,
        /// The largest side of its largest body's bounding box.
        size: f64,
        /// The size of the robot, see [`Cell::robot_size`](crate::Cell::robot_size); for a link, that of its joints.
        robot_size: f64,
    },
    /// A number or the tolerance is probably in another unit.
    Input {
        /// The name of what the remark is on.
        item: String,
        /// The remark.
        remark: Remark,
    },
}

impl CellRemark {
    /// Makes a remark on something with a name.
    pub fn on(item: impl Into<String>, remark: Remark) -> Self {
        let item = item.into();
        CellRemark::Input { item, remark }
    }

    /// Returns the remark's text without names and numbers, the same for remarks of one kind.
    pub fn general_text(&self) -> &'static str {
        match self {
            CellRemark::LeftOut { .. } => {
                "something in the robot's file is left out, which other programs may take into account"
            }
            CellRemark::UnknownLinks { .. } => {
                "the SRDF names links that the robot does not have; their pairs are left out"
            }
            CellRemark::OtherRobotName { .. } => {
                "the SRDF is of a robot with another name; are its pairs those of this one?"
            }
            CellRemark::UnlikelySize { .. } => {
                "something has a size that is unlikely beside the robot; is it in the robot's unit of length?"
            }
            CellRemark::Input { remark, .. } => remark.general_text(),
        }
    }

    /// Returns this remark with a robot's name before the names in it.
    pub(crate) fn with_robot_name(&self, prefixed: impl Fn(&str) -> String) -> Self {
        let mut remark = self.clone();
        match &mut remark {
            CellRemark::LeftOut { element: name } => *name = prefixed(name),
            CellRemark::UnlikelySize { item, .. } | CellRemark::Input { item, .. } => {
                *item = prefixed(item);
            }
            CellRemark::OtherRobotName { .. } => {}
            CellRemark::UnknownLinks { links } => {
                for link in links {
                    *link = prefixed(link);
                }
            }
        }
        remark
    }
}

impl fmt::Display for CellRemark {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            CellRemark::LeftOut { element } => write!(f, "{}: {element}", self.general_text()),
            CellRemark::UnknownLinks { links } => {
                write!(f, "{}: {}", self.general_text(), links.join(", "))
            }
            CellRemark::OtherRobotName { robot, of_srdf } => write!(
                f,
                "{}: `{of_srdf}`, and the robot is `{robot}`",
                self.general_text()
            ),
            CellRemark::UnlikelySize {
                item,
                size,
                robot_size,
            } => write!(
                f,
                "{}: {item} is {size:.4} long, and the robot {robot_size:.4}",
                self.general_text()
            ),
            CellRemark::Input { item, remark } => write!(f, "{item}: {remark}"),
        }
    }
}
