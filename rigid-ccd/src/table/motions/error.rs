//! What can be wrong with a table of motions.

use super::RowPosition;
use crate::text::Number;
use ccd_core::InputError;
use std::fmt;

/// Why a table cannot be used at all.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum TableError {
    /// It could not be read.
    #[error("cannot be read: {0}")]
    Unreadable(String),
    /// It is something else.
    #[error("is {format}, not CSV; export it as CSV, in UTF-8")]
    NotCsv {
        /// What it is.
        format: &'static str,
    },
    /// Git stands for it with a few lines.
    #[error(
        "is a Git LFS pointer, a few lines that stand for the table; run `git lfs pull` to fetch the table \
         itself"
    )]
    LfsPointer,
    /// A quoted cell has no end: it would hold all rows that follow.
    #[error("{}(line {line}): a quote opens a cell here and nothing closes it; close it, or remove it", RowOrHeader(.row))]
    UnclosedQuote {
        /// The row that the cell is of, from 0; none when it is of the header.
        row: Option<usize>,
        /// The line that the quote opens on, from 1.
        line: u64,
    },
    /// Its first line has numbers where names have to be.
    #[error(
        "header: `{number}` is a number: the first line has to name the columns, such as id,a_px,a_vx; {}",
        Known(None)
    )]
    NoHeader {
        /// The first one.
        number: String,
    },
    /// Its header is no text.
    #[error("is not text in UTF-8; export it as CSV, in UTF-8")]
    NotText,
    /// Its cells are not separated by commas.
    #[error(
        "header: cells are separated by {found:?}; separate them by commas, and have numbers with a decimal point: {header}"
    )]
    Separator {
        /// What separates them.
        found: char,
        /// The header.
        header: String,
    },
    /// A column that means nothing here; left alone it would be a motion silently not made.
    #[error("header: unknown column `{column}`; {}", Known(.nearest.as_deref()))]
    UnknownColumn {
        /// Its name.
        column: String,
        /// The known column that is spelt nearly so.
        nearest: Option<String>,
    },
    /// A column that is there twice.
    #[error("header: column `{column}` appears twice")]
    RepeatedColumn {
        /// Its name.
        column: String,
    },
    /// Not even a header.
    #[error("is empty: the first line has to name the columns")]
    Empty,
}

impl From<csv::Error> for TableError {
    fn from(error: csv::Error) -> Self {
        TableError::Unreadable(error.to_string())
    }
}

struct RowOrHeader<'a>(&'a Option<usize>);

impl fmt::Display for RowOrHeader<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.0 {
            Some(row) => write!(f, "row {row} "),
            None => write!(f, "header "),
        }
    }
}

/// Which columns there are, or which one is meant.
struct Known<'a>(Option<&'a str>);

impl fmt::Display for Known<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.0 {
            Some(nearest) => write!(f, "did you mean `{nearest}`?"),
            None => write!(
                f,
                "known are id, duration, and after a_ or b_: px py pz, qw qx qy qz, vx vy vz, wx wy wz, \
                 end_px end_py end_pz, end_qw end_qx end_qy end_qz, cx cy cz"
            ),
        }
    }
}

/// A row that cannot be asked.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("row {} (line {}): {problem}", .place.row, .place.line)]
pub struct RowError {
    /// Which row.
    pub place: RowPosition,
    /// What the row is called.
    pub id: String,
    /// What is wrong with it.
    pub problem: RowProblem,
}

/// What is wrong with a row.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum RowProblem {
    /// A cell is not text in UTF-8.
    NotText {
        /// Its column.
        column: String,
    },
    /// It has more or fewer cells than the header.
    WrongLength {
        /// Its cells.
        cells: usize,
        /// The header's.
        columns: usize,
    },
    /// A cell holds no finite number.
    NotANumber {
        /// Its column.
        column: String,
        /// What it holds.
        value: String,
    },
    /// A column is given that says nothing without another one.
    MissingColumn {
        /// The one that is there.
        given: String,
        /// The one that is not.
        missing: String,
    },
    /// A quaternion that names no orientation.
    ZeroQuaternion {
        /// Its four columns.
        columns: Vec<String>,
        /// Its four values.
        value: [f64; 4],
    },
    /// Both ways of saying how a body moves.
    EndPoseAndVelocity {
        /// A column of the end pose.
        end: String,
        /// A column of a velocity.
        velocity: String,
    },
    /// A duration that no motion can take.
    BadDuration {
        /// What it is.
        value: f64,
        /// What it would have to be.
        allowed: &'static str,
    },
    /// The numbers are good, the query is not.
    Input(InputError),
}

impl fmt::Display for RowProblem {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NotText { column } => write!(f, "column {column}: is not text in UTF-8"),
            Self::WrongLength { cells, columns } => {
                write!(
                    f,
                    "has {cells} cells where the header names {columns} columns"
                )
            }
            Self::NotANumber { column, value } => {
                write!(f, "column {column}: `{value}` is not a finite number")
            }
            Self::MissingColumn { given, missing } => write!(
                f,
                "column {missing}: no value, but {given} has one and needs it"
            ),
            Self::ZeroQuaternion { columns, value } => write!(
                f,
                "columns {}: ({} {} {} {}) is a quaternion of length zero, it names no orientation",
                columns.join(" "),
                Number(value[0]),
                Number(value[1]),
                Number(value[2]),
                Number(value[3]),
            ),
            Self::EndPoseAndVelocity { end, velocity } => write!(
                f,
                "columns {end} and {velocity}: give the end pose or the velocities, not both"
            ),
            Self::BadDuration { value, allowed } => {
                write!(f, "column duration: {} is not {allowed}", Number(*value))
            }
            Self::Input(error) => write!(f, "{error}"),
        }
    }
}

impl std::error::Error for RowProblem {}

impl From<InputError> for RowProblem {
    fn from(error: InputError) -> Self {
        match error {
            InputError::OutOfRange {
                what: "duration",
                value,
                allowed,
            } => Self::BadDuration { value, allowed },
            other => Self::Input(other),
        }
    }
}
