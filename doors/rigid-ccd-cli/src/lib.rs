//! The command `ccd`: options, files, progress and exit codes.
//!
//! | folder | content |
//! |---|---|
//! | `commands` | the subcommands, one file each |
//! | `options` | values that options take |
//! | `bodies` | bodies and scenes, as options and tables describe them |
//! | `robots` | robots, their cells and paths |
//! | `rows` | rows answered one by one: resumed, counted, certified, timed |
//! | `picture` | answers drawn as a page |
//! | `files` | input tables and outputs |
//! | `console` | messages, progress, and how a run ends |
//!
//! This is a library only because `ccd-bench` shares it. Its interface is not stable: depend on `rigid-ccd` instead.

mod bodies;
mod commands;
mod console;
mod files;
mod options;
pub mod picture;
mod robots;
mod rows;

pub use commands::{main, print_error_and_get_exit_code};
pub use console::{Progress, RunOutcome, TotalWork, print_error};
pub use files::output::OutputError;
pub use files::table::TableWriter;
pub use files::{input_name, is_same_file, open_motions, refuse_overwriting_input};
pub use options::numbers::{parse_seconds, tolerance};
pub use options::solver_kind::{BoundKind, OracleKind, ScheduleKind, Solve, SolverKind};
pub use rows::bad_rows::BadRowCounter;
