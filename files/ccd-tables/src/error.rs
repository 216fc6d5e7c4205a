//! Errors of a table of motions or paths.

use super::position::RowPosition;
use crate::excerpt::Excerpt;
use ccd_core::InputError;
use rigid_ccd::text::Number;

/// An error that makes a whole table unusable.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum TableError {
    /// The table cannot be read.
    #[error("cannot be read: {0}")]
    Unreadable(String),
    /// The file has another format.
    #[error("is {other_format}, not CSV; export it as CSV, in UTF-8")]
    NotCsv {
        /// The name of the other format.
        other_format: &'static str,
    },
    /// The file is Parquet, and this build reads CSV alone.
    #[error(
        "is Parquet, which this build does not read; build it with `--features parquet`, or export the table as CSV, in UTF-8"
    )]
    ParquetNotBuilt,
    /// A Parquet file is damaged, or stored in a way that cannot be read.
    #[error("{0}")]
    Parquet(ParquetProblem),
    /// Parquet comes from a stream.
    #[error("is Parquet, which is read from a file, not from a stream; give the file's path")]
    ParquetStream,
    /// A column of a Parquet file has values of a type that cannot be read.
    #[error("header: column `{column}` holds {found}; convert them to numbers or to text")]
    ColumnType {
        /// The name of the column.
        column: String,
        /// The type of the column's values, as text.
        found: String,
    },
    /// The file is a Git LFS pointer.
    #[error("is a Git LFS pointer, not the table itself; run `git lfs pull` to fetch the table")]
    LfsPointer,
    /// A quoted cell is not closed, and so extends to the end of the file.
    #[error(
        "{} (line {line}): a quote opens a cell here and is never closed; close it or remove it",
        .row.map_or("header".to_owned(), |row| format!("row {row}"))
    )]
    UnclosedQuote {
        /// The row of the cell, from 0; `None` for the header.
        row: Option<usize>,
        /// The line of the opening quotation mark, counted from 1.
        line: u64,
    },
    /// The first line has numbers instead of names.
    #[error(
        "header: `{}` is a number: the first line must name the columns, such as id,a_px,a_vx; {known_columns}",
        Excerpt(.first_number_in_header)
    )]
    NoHeader {
        /// The first number in that line.
        first_number_in_header: String,
        /// The known columns, as text.
        known_columns: &'static str,
    },
    /// The header is not valid UTF-8.
    #[error("is not text in UTF-8; export it as CSV, in UTF-8")]
    HeaderNotText,
    /// The cells are not separated by commas.
    #[error(
        "header: cells are separated by {found:?}; use commas, and numbers with a decimal point: {}",
        Excerpt(.header)
    )]
    WrongSeparator {
        /// The character that separates the cells.
        found: char,
        /// The header line, as in the file.
        header: String,
    },
    /// The header has a column that is not known. If it were ignored, a part of a motion could be lost silently.
    #[error(
        "header: unknown column `{}`; {}",
        Excerpt(.column),
        .most_similar_column.as_ref().map_or((*.known_columns).to_owned(), |nearest| format!("did you mean `{nearest}`?"))
    )]
    UnknownColumn {
        /// The unknown name, as in the header.
        column: String,
        /// The known columns, as text.
        known_columns: &'static str,
        /// The known column with the most similar name.
        most_similar_column: Option<String>,
    },
    /// A column is named like an angle, but orientations are quaternions.
    #[error(
        "header: column `{column}` is named like an angle, and orientations are quaternions: columns {prefix}qw {prefix}qx \
         {prefix}qy {prefix}qz, w first; in scipy, Rotation.from_euler(…).as_quat(scalar_first=True) computes them from angles"
    )]
    AngleColumn {
        /// The name that looks like the name of an angle.
        column: String,
        /// The prefix of the body's columns.
        prefix: &'static str,
    },
    /// A column has no name, like the index of a pandas frame.
    #[error(
        "header: column `{column}` has no name; pandas writes its index like this: write the table with index=False, \
         or drop the column"
    )]
    PandasIndex {
        /// The empty name, or the placeholder that pandas writes in its place.
        column: String,
    },
    /// A column appears twice in the header.
    #[error("header: column `{}` appears twice", Excerpt(.column))]
    RepeatedColumn {
        /// The name that appears twice.
        column: String,
    },
    /// A column is missing that another one requires.
    #[error("header: no column `{missing_column}`, but column `{present_column}` needs it")]
    MissingColumn {
        /// The column that the header has.
        present_column: String,
        /// The column that the header lacks.
        missing_column: String,
    },
    /// The table has no header.
    #[error("is empty: the first line must name the columns")]
    Empty,
}

impl From<csv::Error> for TableError {
    fn from(error: csv::Error) -> Self {
        TableError::Unreadable(error.to_string())
    }
}

/// The problem of a Parquet file, and its place.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error(
    "cannot be read as Parquet: {}{}{problem}",
    .row_group.map_or(String::new(), |group| format!("row group {group}: ")),
    .column.as_ref().map_or(String::new(), |column| format!("column `{column}`: "))
)]
pub struct ParquetProblem {
    /// The row group, counted from 0; `None` for the whole file.
    pub row_group: Option<usize>,
    /// The name of the column; `None` for all of them.
    pub column: Option<String>,
    /// The problem, as text.
    pub problem: String,
}

/// An error in one row of a table: which row it is, and why the row cannot be answered.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("{position}: {problem}")]
pub struct RowError {
    /// The numbers of the row and of its line in the file.
    pub position: RowPosition,
    /// The id of the row, or its index if it has none.
    pub id: String,
    /// The reason why the row cannot be answered.
    pub problem: RowProblem,
}

/// The reason why a row of a table cannot be answered.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum RowProblem {
    /// A cell is not text in UTF-8.
    #[error("column {column}: is not text in UTF-8")]
    NotText {
        /// The name of the column that the cell is in.
        column: String,
    },
    /// The row has more or fewer cells than the header.
    #[error("has {cells} cells, but the header has {column_count} columns")]
    WrongCellCount {
        /// The number of cells of the row.
        cells: usize,
        /// The number of columns of the header.
        column_count: usize,
    },
    /// A cell is longer than any number or name.
    #[error("column {}: a cell of {bytes} bytes; {most} are the most", Excerpt(.column))]
    CellTooLong {
        /// The name of the column that the cell is in.
        column: String,
        /// The length of the cell.
        bytes: usize,
        /// The greatest length of a cell.
        most: usize,
    },
    /// A cell is not a finite number.
    #[error("column {column}: `{}` is not a finite number", Excerpt(.value))]
    NotANumber {
        /// The name of the column that the cell is in.
        column: String,
        /// The content of the cell.
        value: String,
    },
    /// A cell is empty.
    #[error("column {column}: no value, and an empty cell has no default")]
    EmptyCell {
        /// The name of the column that the cell is in.
        column: String,
    },
    /// A quaternion is zero.
    #[error(
        "columns {}: ({}) is a zero quaternion, not an orientation",
        .columns.join(" "),
        .value.map(|part| Number(part).to_string()).join(" ")
    )]
    ZeroQuaternion {
        /// The four columns of the quaternion.
        columns: Vec<String>,
        /// The four values of the quaternion.
        value: [f64; 4],
    },
    /// A row gives both the end pose and a velocity of a body.
    #[error(
        "columns {end_pose_column} and {velocity_column}: give either the end pose or the velocities"
    )]
    EndPoseAndVelocity {
        /// A column of the end pose.
        end_pose_column: String,
        /// A column of a velocity.
        velocity_column: String,
    },
    /// The duration is out of range.
    #[error("column duration: {} is not {allowed}", Number(*.value))]
    BadDuration {
        /// The duration that is refused.
        value: f64,
        /// The allowed durations, as text.
        allowed: &'static str,
    },
    /// The times of a path do not increase.
    #[error(
        "column t: {} is not later than {}, the time of the row before; sort the rows of each id by t",
        Number(*.time),
        Number(*.previous_time)
    )]
    TimeNotLater {
        /// The time of the row that is refused.
        time: f64,
        /// The time of the previous row.
        previous_time: f64,
    },
    /// A time is so large relative to the path's first time that it rounds to the time of the row before.
    #[error(
        "column t: {} is so long after {}, the start of the path, that times cannot be distinguished",
        Number(*.time),
        Number(*.first_row_time)
    )]
    TimeNotDistinguishable {
        /// The time of the row that is refused.
        time: f64,
        /// The time of the path's first row.
        first_row_time: f64,
    },
    /// A row has no id, in a table with ids.
    #[error("column id: no value; each row of a path needs its name")]
    NoId,
    /// The rows of a path are not consecutive.
    #[error(
        "path `{}` goes on here after rows of other paths; sort the table by id, then by t",
        Excerpt(.id)
    )]
    PathNotConsecutive {
        /// The id of the path.
        id: String,
    },
    /// A row has another center of rotation than the previous row of its path.
    #[error(
        "columns {body}_cx {body}_cy {body}_cz: differ from the row before; a path has one center of rotation"
    )]
    CenterChanged {
        /// The letter of the body, as in the columns' prefix.
        body: char,
    },
    /// The angular velocity in the previous row does not lead to the orientation in this row.
    #[error(
        "columns {body}_wx {body}_wy {body}_wz: the angular velocity of the row before leads {orientation_mismatch_angle:.3} radians away from this orientation; \
         a quarter turn (1.571) is the most; give more rows, or 0 for the shortest turn"
    )]
    OrientationMismatch {
        /// The letter of the body, as in the columns' prefix.
        body: char,
        /// The angle in radians between the orientation in the row and the one to which the angular velocity leads.
        orientation_mismatch_angle: f64,
    },
    /// Only the default schedule answers this question.
    #[error("needs --schedule best-first")]
    NeedsBestFirst,
    /// The numbers are valid, but the query is not.
    #[error("{0}")]
    InvalidQuery(InputError),
}

impl From<InputError> for RowProblem {
    fn from(error: InputError) -> Self {
        match error {
            InputError::OutOfRange {
                quantity: "duration",
                value,
                allowed,
            } => Self::BadDuration { value, allowed },
            other => Self::InvalidQuery(other),
        }
    }
}
