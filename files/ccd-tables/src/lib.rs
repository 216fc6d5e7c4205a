//! Tables of motions, paths and joints, read from CSV or Parquet and answered row by row.
//!
//! The command `ccd` and the Python package share it. Other programs use `rigid-ccd` directly.
//!
//! | to … | use |
//! |---|---|
//! | read rows of motions | [`motions::MotionTable`] |
//! | read rows of poses at times | [`paths`] |
//! | read rows of motions or of poses | [`movements::Movements`] |
//! | answer rows on all cores | [`batch`] |
//! | write the answers | [`results::ResultRow`], a row for each; [`results::COLUMNS`] |
//! | read any other table | [`table_records::TableRecords`], [`columns`] |
//! | answer about paths of robots, with the feature `robots` | `path_rows`, `joint_columns` |
//!
//! # Features
//! - `robots`: answers about paths of robots, and columns of joints.
//! - `parquet`: tables from Parquet, too. `zstd`: from Parquet that is compressed with zstd, which needs a C compiler.

pub mod batch;
pub mod columns;
pub mod csv_records;
mod error;
mod excerpt;
mod foreign;
#[cfg(feature = "robots")]
pub mod joint_columns;
mod lines;
pub mod motions;
pub mod movements;
#[cfg(feature = "parquet")]
mod parquet_records;
#[cfg(feature = "robots")]
pub mod path_rows;
pub mod paths;
mod position;
pub mod records;
mod remark_collector;
pub mod results;
pub mod table_records;

pub use excerpt::Excerpt;
