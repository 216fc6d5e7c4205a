//! The commands about robots and mechanisms.

mod acm;
mod cell_file;
mod clearance;
mod edges;
mod joint_values;
mod loading;
mod page;
mod path_table;
mod replay;
mod robot_paths;

pub(super) use acm::{AcmArgs, run as run_acm};
pub(super) use clearance::{ClearanceArgs, run as run_clearance};
pub(super) use edges::{DEFAULT_PATH_TOLERANCE, EdgesArgs, run as run_edges};
pub(super) use joint_values::{GivenJoints, JointsArgs, length};
pub(super) use loading::CellArgs;
pub(super) use page::RobotPainter;
pub(super) use path_table::PathTable;
pub(super) use replay::{ReplayArgs, run as run_replay};
pub(super) use robot_paths::{FoundPaths, RobotPaths};
