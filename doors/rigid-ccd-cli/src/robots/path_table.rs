//! Reads a table of edges or paths of a robot, with columns named like its joints.

use super::joint_values::{JointsArgs, check_joints};
use crate::files::open_table;
use crate::rows::resumable::RowSource;
use anyhow::{Result, anyhow, bail};
use ccd_core::order::{greater, lesser};
use ccd_tables::Excerpt;
use ccd_tables::joint_columns::{AngleUnit, JointColumn, joint_column, names_joint};
use ccd_tables::motions::{RowError, RowPosition, RowProblem, TableError};
use ccd_tables::records::{Record, Records};
use ccd_tables::table_records::TableRecords;
use rigid_ccd_robot::{CellRemark, Robot};
use std::collections::HashSet;
use std::path::Path;

/// A path of a table.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct TablePath {
    /// The position of the first row of the path.
    pub(crate) position: RowPosition,
    pub(crate) id: String,
    pub(crate) configurations: Vec<Vec<f64>>,
    /// The times of the configurations, if the table has any.
    pub(crate) times: Option<Vec<f64>>,
}

/// The paths of a table, read one after another.
///
/// A table of edges has columns `from_JOINT` and `to_JOINT`, and a row for each edge. A table of paths has a column for each
/// joint, and a row for each configuration; rows of one `id` follow each other.
pub(crate) struct PathTable {
    records: TableRecords,
    columns: PathColumns,
    /// The row that begins the next path.
    next: Option<RowPosition>,
    path_count: usize,
    known_ids: HashSet<String>,
    /// The largest angle in degrees of the rows so far.
    largest_degrees: f64,
    /// The checksum and the length of the input up to the end of the last path.
    checksum: u32,
    consumed_bytes: u64,
}

/// The columns of a table, and their indices.
struct PathColumns {
    header: Vec<String>,
    id: Option<usize>,
    time: Option<usize>,
    /// The sources of the first configuration of a row, in the order of the robot's joints.
    positions: Vec<PositionCell>,
    /// The sources of the second configuration; `None` in a table of paths.
    end_positions: Option<Vec<PositionCell>>,
}

/// The source of a joint's position: a cell of the row, or a constant.
#[derive(Clone, Copy)]
enum PositionCell {
    Cell(JointColumn),
    AtRest(f64),
}

impl PathTable {
    /// Opens a table. A joint without columns rests where `joints` says.
    ///
    /// # Errors
    /// If the table cannot be read, or a joint has no position.
    pub(crate) fn open(
        option: &str,
        path: &Path,
        robot: &Robot,
        joints: &JointsArgs,
    ) -> Result<(Self, Option<u64>)> {
        let (mut records, length) = open_table(option, path)?;
        let columns = PathColumns::new(records.header()?, robot, joints)?;
        let (checksum, consumed_bytes) = (records.checksum(), records.consumed_bytes());
        let table = PathTable {
            next: records.advance()?,
            records,
            columns,
            path_count: 0,
            known_ids: HashSet::new(),
            largest_degrees: 0.0,
            checksum,
            consumed_bytes,
        };
        Ok((table, length))
    }

    /// Returns a remark if angles in degrees, in the rows so far, are as small as if they were in radians.
    pub(crate) fn remark_on_degrees(&self) -> Option<String> {
        let largest = self.largest_degrees;
        let may_be_radians = largest > 0.0 && largest <= std::f64::consts::TAU;
        may_be_radians.then(|| {
            format!(
                "no angle in degrees is beyond {largest}, which is less than a turn in radians; radians have neither --degrees \
                 nor columns that end in _deg"
            )
        })
    }

    /// Reads the next path; `None` at the end.
    fn read(&mut self) -> Result<Option<Result<TablePath, RowError>>, TableError> {
        let Some(position) = self.next.take() else {
            return Ok(None);
        };
        let given_id = self.columns.id(self.records.current());
        let id = given_id
            .clone()
            .unwrap_or_else(|| self.path_count.to_string());
        let mut path = Ok(TablePath {
            position,
            id: id.clone(),
            configurations: Vec::new(),
            times: self.columns.time.map(|_| Vec::new()),
        });
        if self.columns.end_positions.is_none() && self.columns.id.is_some() {
            path = match &given_id {
                None => Err((position, RowProblem::NoId)),
                Some(id) if !self.known_ids.insert(id.clone()) => {
                    Err((position, RowProblem::PathNotConsecutive { id: id.clone() }))
                }
                Some(_) => path,
            };
        }
        let mut row_position = position;
        loop {
            path = path.and_then(|path| {
                let added = self.columns.add_row(path, self.records.current());
                added.map_err(|problem| (row_position, problem))
            });
            let degrees = self.columns.largest_degrees(self.records.current());
            self.largest_degrees = greater(self.largest_degrees, degrees);
            self.checksum = self.records.checksum();
            self.consumed_bytes = self.records.consumed_bytes();
            self.next = self.records.advance()?;
            match self.next {
                Some(next) if self.columns.continues(&given_id, self.records.current()) => {
                    row_position = next;
                }
                _ => break,
            }
        }
        self.path_count += 1;
        Ok(Some(path.map_err(|(position, problem)| RowError {
            position,
            id,
            problem,
        })))
    }
}

impl Iterator for PathTable {
    type Item = Result<Result<TablePath, RowError>, TableError>;

    fn next(&mut self) -> Option<Self::Item> {
        self.read().transpose()
    }
}

impl RowSource for PathTable {
    type Row = Result<TablePath, RowError>;

    fn skip_rows(&mut self, count: usize) -> Result<usize, TableError> {
        for skipped in 0..count {
            if self.read()?.is_none() {
                return Ok(skipped);
            }
        }
        Ok(count)
    }

    fn checksum(&self) -> u32 {
        self.checksum
    }

    fn consumed_bytes(&self) -> u64 {
        self.consumed_bytes
    }
}

impl PathColumns {
    fn new(header: Vec<String>, robot: &Robot, joint_args: &JointsArgs) -> Result<Self> {
        check_joints(robot, &joint_args.joint)?;
        let nearest_zero = robot.configuration_nearest_zero();
        if header.iter().all(String::is_empty) {
            return Err(TableError::Empty.into());
        }
        if let [only] = &header[..]
            && let Some(found) = [';', '\t'].into_iter().find(|mark| only.contains(*mark))
        {
            let header = only.clone();
            return Err(TableError::WrongSeparator { found, header }.into());
        }
        for (k, column) in header.iter().enumerate() {
            if header[..k].contains(column) {
                let column = column.clone();
                return Err(TableError::RepeatedColumn { column }.into());
            }
        }
        let find = |name: &str| header.iter().position(|column| column == name);
        let joints: Vec<&str> = robot.independent_joint_names().collect();
        let is_of_edges = header
            .iter()
            .any(|column| names_joint(column, robot, "from_"));
        let prefixes: &[&str] = if is_of_edges {
            &["from_", "to_"]
        } else {
            &[""]
        };
        let mut missing = Vec::new();
        let mut positions = |prefix: &str| {
            let cell = |(number, joint): (usize, &&str)| {
                let column = joint_column(&header, robot, (prefix, joint), joint_args.unit())
                    .map_err(|error| anyhow!("header: {error}"))?;
                let range = joint_args.joint.iter().find(|range| range.joint == **joint);
                match (column, range) {
                    (Some(_), Some(_)) => {
                        bail!("--joint {joint}: the table has columns for this joint")
                    }
                    (Some(column), None) => Ok(PositionCell::Cell(column)),
                    (None, Some(range)) if range.is_at_rest() => {
                        Ok(PositionCell::AtRest(range.from))
                    }
                    (None, Some(_)) => {
                        bail!("--joint {joint}: give one position, at which the joint rests")
                    }
                    (None, None) if joint_args.rest => {
                        Ok(PositionCell::AtRest(nearest_zero[number]))
                    }
                    (None, None) => {
                        missing.push(format!("{prefix}{joint}"));
                        Ok(PositionCell::AtRest(f64::NAN))
                    }
                }
            };
            let cells = joints.iter().enumerate().map(cell);
            cells.collect::<Result<Vec<_>>>()
        };
        let mut cells_by_prefix = prefixes
            .iter()
            .map(|prefix| positions(prefix))
            .collect::<Result<Vec<_>>>()?;
        if !missing.is_empty() {
            bail!(
                "header: no column {}; a table of edges has from_JOINT and to_JOINT, one of paths a column for each joint, with \
                 the end _deg for degrees, and --joint NAME=POSITION says where a joint rests; --rest lets all others rest at 0, or at their limit nearest to 0",
                missing.join(", ")
            );
        }
        let end_positions = if is_of_edges {
            cells_by_prefix.pop()
        } else {
            None
        };
        let columns = PathColumns {
            id: find("id"),
            time: find("t").filter(|_| !is_of_edges),
            positions: cells_by_prefix.pop().unwrap_or_default(),
            end_positions,
            header,
        };
        columns.refuse_unclear_columns()?;
        Ok(columns)
    }

    /// Refuses unknown columns, and columns with two meanings.
    fn refuse_unclear_columns(&self) -> Result<()> {
        let mut known_columns: Vec<usize> = self.id.into_iter().chain(self.time).collect();
        for cell in self.cells() {
            if let PositionCell::Cell(JointColumn { column, .. }) = *cell {
                if known_columns.contains(&column) {
                    let name = &self.header[column];
                    bail!(
                        "header: `{name}` may be the column {name} of a path, or the joint of this name; rename the joint"
                    );
                }
                known_columns.push(column);
            }
        }
        match (0..self.header.len()).find(|column| !known_columns.contains(column)) {
            None => Ok(()),
            Some(unknown) => bail!(
                "header: unknown column `{}`; known are id, t and the joints: of edges from_JOINT and to_JOINT; angles are in \
                 radians, with the end _deg in degrees, and lengths in metres",
                Excerpt(&self.header[unknown])
            ),
        }
    }

    /// Returns where the positions of a row come from.
    fn cells(&self) -> impl Iterator<Item = &PositionCell> {
        let ends = self.end_positions.iter().flatten();
        self.positions.iter().chain(ends)
    }

    fn id(&self, record: &impl Record) -> Option<String> {
        self.id.and_then(|column| record.text(column))
    }

    /// Returns whether a row continues the path of the rows before it, whose id is `id`.
    fn continues(&self, id: &Option<String>, record: &impl Record) -> bool {
        self.end_positions.is_none() && self.id(record) == *id
    }

    /// Returns the largest angle in degrees of a row; 0 without columns in degrees.
    fn largest_degrees(&self, record: &impl Record) -> f64 {
        let angles = self.cells().filter_map(|cell| match *cell {
            PositionCell::Cell(JointColumn {
                column,
                unit: AngleUnit::Degree,
            }) => record.number(column).ok()?,
            _ => None,
        });
        angles.map(f64::abs).fold(0.0, greater)
    }

    fn add_row(&self, mut path: TablePath, record: &impl Record) -> Result<TablePath, RowProblem> {
        record.check(&self.header)?;
        for positions in [Some(&self.positions), self.end_positions.as_ref()]
            .into_iter()
            .flatten()
        {
            let configuration = positions.iter().map(|cell| match *cell {
                PositionCell::Cell(JointColumn { column, unit }) => self
                    .number(record, column)
                    .map(|position| unit.to_radians(position)),
                PositionCell::AtRest(position) => Ok(position),
            });
            path.configurations
                .push(configuration.collect::<Result<_, _>>()?);
        }
        if let (Some(column), Some(times)) = (self.time, &mut path.times) {
            let time = self.number(record, column)?;
            if let Some(&previous_time) = times.last()
                && !(time > previous_time)
            {
                return Err(RowProblem::TimeNotLater {
                    time,
                    previous_time,
                });
            }
            times.push(time);
        }
        Ok(path)
    }

    fn number(&self, record: &impl Record, column: usize) -> Result<f64, RowProblem> {
        record.required_number(column, &self.header[column])
    }
}

impl TablePath {
    /// Returns an edge between two configurations that are in no table. An edge without motion has one configuration.
    pub(crate) fn between([from, to]: [Vec<f64>; 2]) -> Self {
        let rests = from == to;
        let mut configurations = vec![from];
        if !rests {
            configurations.push(to);
        }
        TablePath {
            position: RowPosition { row: 0, line: None },
            id: String::new(),
            configurations,
            times: None,
        }
    }

    /// Returns a remark on the first position that seems to be in degrees where radians are meant.
    pub(crate) fn remark(&self, robot: &Robot) -> Option<CellRemark> {
        let mut configurations = self.configurations.iter();
        configurations.find_map(|configuration| robot.remark_on_configuration(configuration))
    }

    /// Converts the time of a path whose segments take one unit of time each to the time of the table, rounded down; without
    /// times, it stays as it is.
    pub(crate) fn table_time_rounded_down(&self, time: f64) -> f64 {
        self.table_time(time, -1.0)
    }

    /// As [`TablePath::table_time_rounded_down`], rounded up.
    pub(crate) fn table_time_rounded_up(&self, time: f64) -> f64 {
        self.table_time(time, 1.0)
    }

    /// Converts a time to the table's time, shifted by a bound on its rounding error times `sign`. Times of rows stay exact.
    fn table_time(&self, time: f64, sign: f64) -> f64 {
        let Some(times) = &self.times else {
            return time;
        };
        let last = times.len() - 1;
        let segment = (time as usize).min(last);
        let fraction = time - segment as f64;
        if segment == last || fraction == 0.0 {
            return times[segment];
        }
        let (from, to) = (times[segment], times[segment + 1]);
        // The bound covers the rounding here, and the bits that the number of the segment takes from the fraction.
        let time_error = 4.0 * f64::EPSILON * (from.abs() + to.abs() + time * (to - from));
        lesser(
            to,
            greater(from, from + fraction * (to - from) + sign * time_error),
        )
    }
}

#[cfg(test)]
mod tests;
