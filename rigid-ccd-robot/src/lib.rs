//! Robots and mechanisms as trees of links and joints, from URDF, MJCF and SRDF or from code, for certified collision checks.
//!
//! ```
//! use rigid_ccd_robot::{Joint, Link, PositionRule, Robot};
//! use rigid_ccd::{Body, Pose, trajectory};
//!
//! let rod = || Body::capsule(0.1, 0.4);
//! let links = vec![Link::named("base"), Link::named("arm").with_body(rod()?, Pose::IDENTITY)];
//! let hinge = trajectory::Joint::revolute(Pose::at([0.0, 0.0, 1.0])?, [0.0, 1.0, 0.0])?;
//! let joints = vec![Joint {
//!     name: "hinge".into(),
//!     parent: "base".into(),
//!     child: "arm".into(),
//!     axis_and_limits: hinge,
//!     position_rule: PositionRule::Independent,
//! }];
//! let robot = Robot::new(links, joints)?;
//! assert_eq!(robot.free_joint_names().collect::<Vec<_>>(), ["hinge"]);
//! assert_eq!(robot.pose("arm", &[0.5])?.translation().z, 1.0);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! | file | what |
//! |---|---|
//! | `robot` | the tree: [`Robot`], [`Link`], [`Joint`]; [`Robot::chain_between`] for the motion of one link in the frame of another |
//! | `combine` | several robots as one, on bases that may move: [`Robot::combine`] |
//! | `cell` | a robot among obstacles: [`Cell`]; `cell/compared` which bodies are compared, `cell/margins` at which distances |
//! | `solver` | one search for all pairs along a path: [`CellSolver`]; `solver/displacement` how far parts move, `solver/search` the search, `solver/engine` what goes to the engine, `solver/start` contacts at the start that may part, `solver/clearance_ranges` where a distance is kept, `solver/distance_curve` the distance over a path |
//! | `kinematics` | the frames of all links in a configuration |
//! | `path`, `joint_curve`, `polynomial`, `path_point` | what a question is about: a [`Path`] through configurations, or a [`JointCurve`] of polynomials |
//! | `path_answer` | what was found: [`PathAnswer`], for all questions |
//! | `link_contacts` | whether two links can ever touch, by branch and bound over their joints: [`Robot::classify_link_contacts`] |
//! | `pairs`, `skip_reason` | which pairs of links are checked, and why others are not: [`LinkPairs`] |
//! | `remark` | what is probably a mistake in a robot or a cell, and what is not checked: [`CellRemark`]; `robot_remarks`, `cell/remarks` and `units` make the remarks |
//! | `check_summary` | what of a robot is checked, in numbers: [`CheckSummary`] |
//! | `robot_file` | a robot from a URDF or MJCF file with its meshes: [`RobotFile`] |
//! | `srdf` | pairs that are not checked, from an SRDF file |
//! | `evidence` | records of answers, to be asked again later: [`evidence::Evidence`] |
//! | `tuning` | numbers that only cost time |

mod cell;
mod check_summary;
mod combine;
mod error;
pub mod evidence;
mod joint_curve;
mod kinematics;
mod link_contacts;
mod pairs;
mod path;
mod path_answer;
mod path_point;
mod polynomial;
#[cfg(test)]
#[allow(dead_code)]
#[path = "../../ccd-core/src/tests/rational.rs"]
mod rational;
mod remark;
mod robot;
mod robot_file;
mod robot_remarks;
mod skip_reason;
mod solver;
mod srdf;
#[cfg(test)]
mod test_robots;
mod tuning;
mod units;
#[cfg(test)]
#[allow(dead_code)]
#[path = "../../ccd-core/src/tests/worst.rs"]
mod worst;

pub use cell::{CarriedBody, Cell, Item};
pub use check_summary::{CheckSummary, Surroundings};
pub use combine::PlacedRobot;
pub use error::{CurveError, NothingCompared, PathError, RobotError};
pub use joint_curve::JointCurve;
pub use link_contacts::{LinkContactClass, LinkContactSettings};
pub use pairs::LinkPairs;
pub use path::Path;
pub use path_answer::{PathAnswer, PathContact, PathOutcome, UnresolvedPath};
pub use path_point::PathPoint;
pub use remark::CellRemark;
pub use robot::{ChainBetween, CompoundKind, Joint, Link, LinkBody, PositionRule, Robot};
pub use robot_file::{
    BodyElements, MeshConversion, MjcfError, RobotFile, RobotFileError, UrdfError,
};
pub use skip_reason::{LeftOutPairs, SkipReason};
pub use solver::{CellSolver, ClearanceRange, DistanceRange, RangeSettings};
pub use srdf::SrdfError;

/// The example in the README, run as a doctest.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct ReadmeDoctests;
