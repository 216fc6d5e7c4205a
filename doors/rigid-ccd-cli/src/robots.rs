//! Robots, their cells and paths, as files, options and tables describe them.

mod cell_file;
pub(crate) mod joint_values;
pub(crate) mod loading;
pub(crate) mod page;
pub(crate) mod path_table;
pub(crate) mod robot_paths;

pub(crate) use joint_values::{JointsArgs, length};
pub(crate) use loading::CellArgs;
pub(crate) use page::RobotPainter;
pub(crate) use path_table::PathTable;
pub(crate) use robot_paths::{RobotPaths, SelectedPaths};

/// The default tolerance of questions about robots, in metres.
pub(crate) const DEFAULT_PATH_TOLERANCE: f64 = 1e-4;
