//! Certified collision checks of robots and mechanisms: trees of links and joints, from URDF, MJCF and SRDF files or from code.
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
//!     geometry: hinge,
//!     position_rule: PositionRule::Independent,
//! }];
//! let robot = Robot::new(links, joints)?;
//! assert_eq!(robot.independent_joint_names().collect::<Vec<_>>(), ["hinge"]);
//! assert_eq!(robot.pose("arm", &[0.5])?.translation().z, 1.0);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! | to … | use |
//! |---|---|
//! | load a robot from a URDF or MJCF file | [`RobotFile::from_path`], [`RobotFile::read`] |
//! | build a robot in code | [`Link`], [`Joint`], [`Robot::new`] |
//! | compute the pose of a link | [`Robot::pose`] |
//! | combine arms, grippers, moving bases and moving obstacles | [`Robot::combine`] |
//! | select the pairs of links to check, also from an SRDF file | [`RobotFile::link_pairs`], [`LinkPairs`] |
//! | find out which links can touch at all, and write an SRDF file | [`Robot::classify_link_contacts`], [`Robot::to_srdf`] |
//! | set up a planning scene | [`Cell::new`], [`Cell::add_obstacle`], [`Cell::add_plane`] |
//! | pick up an object and put it down | [`Cell::attach`], [`Cell::detach`], [`Cell::allow_contact`] |
//! | keep distances | [`Cell::set_padding`], [`Cell::set_clearance`]; the margin of the settings |
//! | check a configuration, an edge or a path | [`Cell::solver`], [`CellSolver::is_free`] |
//! | check a trajectory of polynomials or B-splines | [`JointCurve`], then [`CellSolver::is_free`] |
//! | find the first contact, and its time on a curve | [`CellSolver::first_contact`], [`JointCurve::time`] |
//! | bound the least distance on a path | [`CellSolver::closest_approach`] |
//! | bound the distance along a path, range by range | [`CellSolver::distance_curve`] |
//! | find where a path keeps or violates clearances | [`CellSolver::clearance_ranges`] |
//! | check many paths on all cores | [`rigid_ccd::ParallelSolver`] with [`Cell::solver`] |
//! | move one link in the frame of another in any other query | [`Robot::chain_between`] |
//! | see what is checked, and probable mistakes | [`Cell::check_summary`], [`Cell::remarks`] |
//! | record an answer as evidence, and replay it | [`evidence::Evidence`] |
//!
//! # Terms
//! - A *cell* is a planning scene: a robot among static obstacles.
//! - A joint is *independent* unless it is fixed or follows another joint. A *configuration* lists the positions of all
//!   independent joints. An *edge* is a pair of configurations; between them all joints move at constant rates.
//! - A *pair* is checked unless its links are adjacent, do not move relative to each other, or are allowed to touch:
//!   [`LinkPairs`] is the allowed collision matrix.
//! - A pair is in *contact* if its distance is at most margin + *tolerance*. The *margin* is a distance to keep, 0 by
//!   default.
//!
//! # Guarantee
//! On a free path all checked pairs stay farther apart than the margin at every configuration, not only at sampled
//! ones. The proof includes all rounding errors. A search that reaches a limit returns an error or an unresolved
//! outcome, never a free path.

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

pub use cell::{AttachedBody, Cell, Item};
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

/// Runs the README's examples as doctests.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct ReadmeDoctests;
