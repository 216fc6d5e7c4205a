//! The table of motions: CSV in, motions of two bodies out, and back.

mod columns;
mod error;
mod row;
#[cfg(test)]
mod tests;
mod write;

pub use error::{RowError, RowProblem, TableError};
pub use write::write;

use ccd_core::Motion;
use columns::Columns;
use std::io;

/// How two bodies move over one duration.
#[derive(Clone, Debug, PartialEq)]
pub struct Query {
    /// What the row is called in the results.
    pub id: String,
    /// Motion of body A.
    pub a: Motion,
    /// Motion of body B.
    pub b: Motion,
    /// How long, in the motions' unit of time.
    pub duration: f64,
}

/// Where in a table a row stands.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Place {
    /// Counted from 1 below the header.
    pub row: usize,
    /// The line of the file, counted from 1.
    pub line: u64,
}

/// A table of motions, its bad rows set aside.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct MotionTable {
    /// The rows that can be asked.
    pub rows: Vec<(Place, Query)>,
    /// What is wrong with the others.
    pub errors: Vec<RowError>,
}

impl MotionTable {
    /// Reads a table; every row is held against all rules, so that all bad ones are known at once.
    ///
    /// Columns go by name, in any order; those left out, and empty cells, have their defaults: rest
    /// at the identity, for a duration of 1. [`known_columns`] lists them.
    ///
    /// # Errors
    /// [`TableError`] when the header cannot be used; rows that cannot be are listed in
    /// [`MotionTable::errors`] instead.
    pub fn read(input: impl io::Read) -> Result<Self, TableError> {
        let mut reader = csv::ReaderBuilder::new()
            .flexible(true)
            .trim(csv::Trim::All)
            .from_reader(input);
        let columns = Columns::from_header(reader.headers()?)?;
        let mut table = MotionTable::default();
        for (index, record) in reader.records().enumerate() {
            let row = index + 1;
            let line = match &record {
                Ok(record) => record.position().map_or(0, csv::Position::line),
                Err(error) => error.position().map_or(0, csv::Position::line),
            };
            let place = Place { row, line };
            let query = record
                .map_err(|error| RowProblem::Unreadable(error.to_string()))
                .and_then(|record| row::query(&columns, &record, index));
            match query {
                Ok(query) => table.rows.push((place, query)),
                Err(problem) => table.errors.push(RowError { place, problem }),
            }
        }
        Ok(table)
    }
}

/// Every column that a table of motions may have.
pub fn known_columns() -> Vec<String> {
    columns::known()
}
