//! The rows of a query: motions or paths.

use super::columns::Columns;
use super::csv_records::CsvRecords;
use super::error::{RowError, TableError};
use super::motions::{MotionRows, Motions};
use super::paths::{Grouping, Path, PathRows};
use super::position::RowPosition;
use super::records::Records;
use crate::Remark;
use ccd_core::{InputError, Pose, Trajectory};
use std::io;

/// The motions or paths of both bodies in one query.
#[derive(Clone, Debug, PartialEq)]
pub enum Course {
    /// Motions at constant velocities.
    Motions(Motions),
    /// Paths from pose to pose.
    Path(Path),
}

impl Course {
    /// Returns the id of the row in the results.
    pub fn id(&self) -> &str {
        match self {
            Course::Motions(Motions { id, .. }) | Course::Path(Path { id, .. }) => id,
        }
    }

    /// Returns the duration of the motions or paths, in their unit of time.
    pub fn duration(&self) -> f64 {
        match *self {
            Course::Motions(Motions { duration, .. }) | Course::Path(Path { duration, .. }) => {
                duration
            }
        }
    }

    /// Returns the table's time that corresponds to the query's time 0.
    pub fn start(&self) -> f64 {
        match self {
            Course::Motions(_) => 0.0,
            Course::Path(path) => path.start,
        }
    }

    /// Returns the trajectories of both bodies.
    pub fn trajectories(&self) -> [&dyn Trajectory; 2] {
        match self {
            Course::Motions(Motions { a, b, .. }) => [a, b],
            Course::Path(Path { a, b, .. }) => [a, b],
        }
    }

    /// Returns the poses of both bodies at a time, measured from the start.
    ///
    /// # Errors
    /// A pose is out of range.
    pub fn poses(&self, time: f64) -> Result<[Pose; 2], InputError> {
        match self {
            Course::Motions(query) => Ok([query.a.pose(time), query.b.pose(time)]),
            Course::Path(path) => path.poses(time),
        }
    }

    /// Converts a time measured from the start to the table's time, rounded down.
    pub fn earliest(&self, time: f64) -> f64 {
        match self {
            Course::Motions(_) => time,
            Course::Path(path) => path.earliest(time),
        }
    }

    /// Converts a time measured from the start to the table's time, rounded up.
    pub fn latest(&self, time: f64) -> f64 {
        match self {
            Course::Motions(_) => time,
            Course::Path(path) => path.latest(time),
        }
    }
}

/// An iterator over the queries in a table of motions or paths.
#[derive(Debug)]
pub enum Courses<S> {
    /// Each row is a query.
    Motions(MotionRows<S>),
    /// All rows with the same id form a query.
    Paths(PathRows<S>),
}

/// The motions or paths of a query with its position in the table, or the error of a bad row.
pub type CourseRow = Result<(RowPosition, Course), RowError>;

impl<R: io::Read> Courses<CsvRecords<R>> {
    /// Reads the header of a CSV table.
    ///
    /// # Errors
    /// The header cannot be read, or has columns that cannot be used.
    pub fn new(input: R, grouping: Grouping) -> Result<Self, TableError> {
        Courses::of(CsvRecords::new(input)?, grouping)
    }
}

impl<S: Records> Courses<S> {
    /// Creates the iterator after the header was read: a table with a column `t` is a table of paths.
    ///
    /// # Errors
    /// The header has columns that cannot be used, or the first row cannot be read.
    pub fn of(records: S, grouping: Grouping) -> Result<Self, TableError> {
        let columns = Columns::of(&records.header()?)?;
        Ok(if columns.are_of_paths() {
            Courses::Paths(PathRows::after_header(records, columns, grouping)?)
        } else {
            Courses::Motions(MotionRows::after_header(records, columns))
        })
    }

    /// Skips rows without parsing them, and returns the number skipped.
    ///
    /// # Errors
    /// [`TableError::Unreadable`], [`TableError::UnclosedQuote`].
    pub fn skip_rows(&mut self, rows: usize) -> Result<usize, TableError> {
        match self {
            Courses::Motions(table) => table.skip_rows(rows),
            Courses::Paths(table) => table.skip_rows(rows),
        }
    }

    /// Returns the number of bytes of the input up to the end of the last row, or of the last path.
    pub fn bytes(&self) -> u64 {
        match self {
            Courses::Motions(table) => table.bytes(),
            Courses::Paths(table) => table.bytes(),
        }
    }

    /// Returns the remarks about the rows so far, one of each kind.
    pub fn remarks(&self) -> Vec<Remark> {
        match self {
            Courses::Motions(table) => table.remarks(),
            Courses::Paths(table) => table.remarks(),
        }
    }

    /// Returns a checksum of the header and of all rows so far.
    pub fn checksum(&self) -> u32 {
        match self {
            Courses::Motions(table) => table.checksum(),
            Courses::Paths(table) => table.checksum(),
        }
    }
}

impl<S: Records> Iterator for Courses<S> {
    type Item = Result<CourseRow, TableError>;

    fn next(&mut self) -> Option<Self::Item> {
        fn valid<T>(
            row: Result<(RowPosition, T), RowError>,
            course: impl Fn(T) -> Course,
        ) -> CourseRow {
            row.map(|(position, row)| (position, course(row)))
        }
        match self {
            Courses::Motions(table) => Some(table.next()?.map(|row| valid(row, Course::Motions))),
            Courses::Paths(table) => Some(table.next()?.map(|row| valid(row, Course::Path))),
        }
    }
}
