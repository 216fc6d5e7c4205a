//! Reads queries from a table of motions or a table of paths.

use super::columns::Columns;
use super::csv_records::CsvRecords;
use super::error::{RowError, TableError};
use super::motions::{MotionRows, Motions};
use super::paths::{Grouping, PathPair, PathReader};
use super::position::RowPosition;
use super::records::Records;
use ccd_core::{InputError, Pose, Trajectory};
use rigid_ccd::Remark;
use std::io;

/// The motions or paths of both bodies in one query.
#[derive(Clone, Debug, PartialEq)]
pub enum Movements {
    /// Motions at constant velocities.
    Motions(Motions),
    /// Paths from pose to pose.
    Path(PathPair),
}

impl Movements {
    /// Returns the id of the row in the results.
    pub fn id(&self) -> &str {
        match self {
            Movements::Motions(Motions { id, .. }) | Movements::Path(PathPair { id, .. }) => id,
        }
    }

    /// Returns the duration of the motions or paths, in their unit of time.
    pub fn duration(&self) -> f64 {
        match *self {
            Movements::Motions(Motions { duration, .. })
            | Movements::Path(PathPair { duration, .. }) => duration,
        }
    }

    /// Returns the paths of both bodies; `None` for motions, whose times need no conversion to the table's.
    fn path(&self) -> Option<&PathPair> {
        match self {
            Movements::Motions(_) => None,
            Movements::Path(path) => Some(path),
        }
    }

    /// Returns the table's time that corresponds to the query's time 0.
    pub fn start_time(&self) -> f64 {
        self.path().map_or(0.0, |path| path.start_time)
    }

    /// Returns the trajectories of both bodies.
    pub fn trajectories(&self) -> [&dyn Trajectory; 2] {
        match self {
            Movements::Motions(Motions { a, b, .. }) => [a, b],
            Movements::Path(PathPair { a, b, .. }) => [a, b],
        }
    }

    /// Returns the poses of both bodies at a time, measured from the start.
    ///
    /// # Errors
    /// A pose is out of range.
    pub fn poses_at(&self, time: f64) -> Result<[Pose; 2], InputError> {
        match self {
            Movements::Motions(query) => Ok([query.a.pose(time), query.b.pose(time)]),
            Movements::Path(path) => path.poses_at(time),
        }
    }

    /// Converts a time measured from the start to the table's time, rounded down.
    pub fn table_time_rounded_down(&self, time: f64) -> f64 {
        self.path()
            .map_or(time, |path| path.table_time_rounded_down(time))
    }

    /// Converts a time measured from the start to the table's time, rounded up.
    pub fn table_time_rounded_up(&self, time: f64) -> f64 {
        self.path()
            .map_or(time, |path| path.table_time_rounded_up(time))
    }
}

/// An iterator over the queries in a table of motions or of paths. Each row of a table of motions is a query; in a
/// table of paths, all rows with the same id are one query.
#[derive(Debug)]
pub struct MovementRows<S> {
    rows: MotionRows<S>,
    /// The state of reading a table of paths; `None` for a table of motions.
    path_reader: Option<PathReader>,
}

/// The motions or paths of a query with its position in the table, or the error of a bad row.
pub type MovementRow = Result<(RowPosition, Movements), RowError>;

impl<R: io::Read> MovementRows<CsvRecords<R>> {
    /// Creates the iterator, and reads the header of a CSV table.
    ///
    /// # Errors
    /// The header cannot be read, or has columns that cannot be used.
    pub fn new(input: R, grouping: Grouping) -> Result<Self, TableError> {
        MovementRows::of(CsvRecords::new(input)?, grouping)
    }
}

impl<S: Records> MovementRows<S> {
    /// Creates the iterator over the rows of `records`. A table with a column `t` is a table of paths.
    ///
    /// # Errors
    /// The header has columns that cannot be used, or the first row cannot be read.
    pub fn of(mut records: S, grouping: Grouping) -> Result<Self, TableError> {
        let columns = Columns::of(&records.header()?)?;
        let paths = columns.is_path_table();
        let paths = paths.then(|| PathReader::new(&mut records, grouping));
        let paths = paths.transpose()?;
        let rows = MotionRows { records, columns };
        Ok(MovementRows {
            rows,
            path_reader: paths,
        })
    }

    /// Returns whether the table is a table of paths, not of motions.
    pub fn is_path_table(&self) -> bool {
        self.path_reader.is_some()
    }

    /// Skips rows, or paths in a table of paths, without parsing them, and returns the number skipped.
    ///
    /// # Errors
    /// [`TableError::Unreadable`], [`TableError::UnclosedQuote`].
    pub fn skip_rows(&mut self, rows: usize) -> Result<usize, TableError> {
        match &mut self.path_reader {
            None => self.rows.skip_rows(rows),
            Some(paths) => paths.skip_paths(&mut self.rows, rows),
        }
    }

    /// Returns the number of bytes of the input up to the end of the last row, or of the last path.
    pub fn consumed_bytes(&self) -> u64 {
        match &self.path_reader {
            Some(paths) => paths.byte_count,
            None => self.rows.consumed_bytes(),
        }
    }

    /// Returns the remarks about the rows so far, one of each kind.
    pub fn remarks(&self) -> Vec<Remark> {
        self.rows.remarks()
    }

    /// Returns a checksum of the header and of all rows so far.
    pub fn checksum(&self) -> u32 {
        match &self.path_reader {
            Some(paths) => paths.checksum,
            None => self.rows.checksum(),
        }
    }

    fn read(&mut self) -> Result<Option<MovementRow>, TableError> {
        Ok(match &mut self.path_reader {
            None => (self.rows.next().transpose()?)
                .map(|row| row.map(|(position, motions)| (position, Movements::Motions(motions)))),
            Some(paths) => (paths.next(&mut self.rows)?)
                .map(|row| row.map(|(position, path)| (position, Movements::Path(path)))),
        })
    }
}

impl<S: Records> Iterator for MovementRows<S> {
    type Item = Result<MovementRow, TableError>;

    fn next(&mut self) -> Option<Self::Item> {
        self.read().transpose()
    }
}
