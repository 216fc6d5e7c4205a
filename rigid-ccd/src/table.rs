//! Reads motions and paths from CSV, from Parquet or from columns in memory, and writes tables of results and contacts.
//!
//! Public only because `ccd-bench` and the Python package share them; no stable interface.

pub mod columns;
pub mod courses;
pub mod csv_records;
mod error;
mod foreign;
mod lines;
pub mod motions;
#[cfg(feature = "parquet")]
mod parquet_records;
pub mod paths;
mod position;
pub mod records;
mod remark_collector;
pub mod results;
pub mod table_records;
