//! Reads the table of paths: CSV with a row for each pose of two bodies, grouped by id.

#[cfg(test)]
mod tests;

use super::columns::Columns;
use super::error::{RowError, RowProblem, TableError};
use super::motions::MotionRows;
use super::motions::row::{self, BodyPose, TimedBodyPoses};
use super::position::RowPosition;
use super::records::Records;
use ccd_core::glam::DVec3;
use ccd_core::{InputError, Pose, Question, Trajectory};
use rigid_ccd::trajectory;
use std::collections::HashSet;
use std::hash::{BuildHasher, RandomState};

/// The paths of two bodies over the same time.
#[derive(Clone, Debug, PartialEq)]
pub struct PathPair {
    /// The id of the row in the results.
    pub id: String,
    /// The path of body A, from time 0.
    pub a: trajectory::PosePath,
    /// The path of body B, from time 0.
    pub b: trajectory::PosePath,
    /// The time in the table's column `t` that corresponds to the query's time 0.
    pub start_time: f64,
    /// The time in the table's column `t` at which the path ends.
    pub end: f64,
    /// The duration of the paths: `end − start`, rounded.
    pub duration: f64,
}

/// The rule by which rows of a table form paths.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Grouping {
    /// All consecutive rows with the same id form a path.
    ById,
    /// Each row alone is a query of two bodies at rest.
    QueryPerRow,
}

impl Grouping {
    /// Returns which rows of a table of paths a question treats as one path.
    pub fn of_question(question: Question) -> Self {
        match question {
            Question::Distance => Grouping::QueryPerRow,
            _ => Grouping::ById,
        }
    }
}

/// The state of a reader of a table of paths, between two paths.
///
/// Columns are identified by their names, in any order: `id`, `t`, poses and centers as in a table of motions, and
/// angular velocities until the next row. Rows of one path follow each other, in the order of their times.
#[derive(Debug)]
pub(super) struct PathReader {
    grouping: Grouping,
    /// The number of paths read.
    path_count: usize,
    /// The position of the current record, if it begins the next path.
    next: Option<RowPosition>,
    /// The checksum of the header and of all rows of the paths read.
    pub(super) checksum: u32,
    /// The number of bytes of the input up to the end of the paths read.
    pub(super) byte_count: u64,
    /// The hashes of the ids of the paths read, to find ids that appear again.
    known_id_hashes: HashSet<u64>,
    id_hasher: RandomState,
}

/// The paths of both bodies of a query, with the place of their first row in the table, or the error of a bad row.
pub(super) type PathRow = Result<(RowPosition, PathPair), RowError>;

impl PathReader {
    /// Starts to read the paths of a table after its header.
    ///
    /// # Errors
    /// The first row cannot be read.
    pub(super) fn new(records: &mut impl Records, grouping: Grouping) -> Result<Self, TableError> {
        let (checksum, bytes) = (records.checksum(), records.consumed_bytes());
        Ok(PathReader {
            next: records.advance()?,
            grouping,
            path_count: 0,
            checksum,
            byte_count: bytes,
            known_id_hashes: HashSet::new(),
            id_hasher: RandomState::new(),
        })
    }

    /// Skips paths without parsing their poses, and returns the number skipped.
    pub(super) fn skip_paths<S: Records>(
        &mut self,
        rows: &mut MotionRows<S>,
        paths: usize,
    ) -> Result<usize, TableError> {
        for skipped in 0..paths {
            if self.read(rows, |_, _, _| ())?.is_none() {
                return Ok(skipped);
            }
        }
        Ok(paths)
    }

    /// Reads the rows of a path, and returns the path's id and the position of its first row; `None` at the end.
    fn read<S: Records>(
        &mut self,
        MotionRows { records, columns }: &mut MotionRows<S>,
        mut row: impl FnMut(RowPosition, &Columns, &S::Record),
    ) -> Result<Option<FirstRow>, TableError> {
        let Some(position) = self.next.take() else {
            return Ok(None);
        };
        let id = row::id(columns, records.current());
        let has_repeated_id = match (self.grouping, &id) {
            (Grouping::ById, Some(id)) => !self.known_id_hashes.insert(self.id_hasher.hash_one(id)),
            // Consecutive rows without an id form one path.
            (Grouping::ById, None) | (Grouping::QueryPerRow, _) => false,
        };
        let mut row_position = position;
        loop {
            row(row_position, columns, records.current());
            self.checksum = records.checksum();
            self.byte_count = records.consumed_bytes();
            self.next = records.advance()?;
            let same = |next| match self.grouping {
                Grouping::ById => row::id(columns, next) == id,
                Grouping::QueryPerRow => false,
            };
            match self.next {
                Some(next) if same(records.current()) => row_position = next,
                _ => break,
            }
        }
        let index = self.path_count;
        self.path_count += 1;
        Ok(Some(FirstRow {
            row_position: position,
            id: id.unwrap_or_else(|| index.to_string()),
            has_repeated_id,
        }))
    }

    /// Reads the next path; `None` at the end.
    pub(super) fn next<S: Records>(
        &mut self,
        rows: &mut MotionRows<S>,
    ) -> Result<Option<PathRow>, TableError> {
        let mut poses: Result<Vec<TimedBodyPoses>, (RowPosition, RowProblem)> = Ok(Vec::new());
        let first_row = self.read(rows, |position, columns, record| {
            let Ok(earlier_rows) = &mut poses else { return };
            let row =
                row::poses(columns, record).and_then(|row| check_row_follows(earlier_rows, row));
            match row {
                Ok(row) => earlier_rows.push(row),
                Err(problem) => poses = Err((position, problem)),
            }
        })?;
        let Some(FirstRow {
            row_position: position,
            id,
            has_repeated_id,
        }) = first_row
        else {
            return Ok(None);
        };
        if has_repeated_id {
            let problem = RowProblem::PathNotConsecutive { id: id.clone() };
            poses = Err((position, problem));
        }
        let path = poses
            .and_then(|poses| PathPair::new(&id, &poses).map_err(|problem| (position, problem)))
            .map_err(|(position, problem)| RowError {
                position,
                id,
                problem,
            });
        Ok(Some(path.map(|path| (position, path))))
    }
}

/// The first row of a path: its position, and the id of the path.
struct FirstRow {
    row_position: RowPosition,
    id: String,
    /// Whether an earlier path has the same id.
    has_repeated_id: bool,
}

/// Returns `row`, or an error if it cannot follow the rows before it. Its time must be later, also after the first time
/// is subtracted; its orientation and its center of rotation must fit the row before.
fn check_row_follows(
    poses: &[TimedBodyPoses],
    row: TimedBodyPoses,
) -> Result<TimedBodyPoses, RowProblem> {
    let (time, Some(first), Some(previous)) = (row.time, poses.first(), poses.last()) else {
        return Ok(row);
    };
    let [elapsed, elapsed_before] = [time, previous.time].map(|time| time - first.time);
    if time <= previous.time {
        return Err(RowProblem::TimeNotLater {
            time,
            previous_time: previous.time,
        });
    }
    // Written so that NaN is refused.
    if !(elapsed > elapsed_before && elapsed.is_finite()) {
        return Err(RowProblem::TimeNotDistinguishable {
            time,
            first_row_time: first.time,
        });
    }
    check_continuity('a', [previous.a, row.a], elapsed - elapsed_before)?;
    check_continuity('b', [previous.b, row.b], elapsed - elapsed_before)?;
    Ok(row)
}

/// Returns an error if a row's center of rotation or orientation does not fit the previous row. The center must be the
/// same, and the previous row's angular velocity must lead near the orientation.
fn check_continuity(
    body: char,
    [previous, row]: [BodyPose; 2],
    duration: f64,
) -> Result<(), RowProblem> {
    if previous.center != row.center {
        return Err(RowProblem::CenterChanged { body });
    }
    if previous.spin == DVec3::ZERO {
        return Ok(());
    }
    let segment = trajectory::PosePath::new(vec![(0.0, previous.pose), (duration, row.pose)])?;
    match segment.with_angular_velocities(vec![previous.spin.into()]) {
        Ok(_) => Ok(()),
        Err(InputError::OutOfRange { value, .. }) => Err(RowProblem::OrientationMismatch {
            body,
            orientation_mismatch_angle: value,
        }),
        Err(error) => Err(error.into()),
    }
}

impl PathPair {
    /// Creates the paths of both bodies from at least one row.
    fn new(id: &str, rows: &[TimedBodyPoses]) -> Result<Self, RowProblem> {
        let start = rows[0].time;
        let path_of = |body: fn(&TimedBodyPoses) -> BodyPose| {
            let timed = rows.iter().map(|row| (row.time - start, body(row).pose));
            let path = trajectory::PosePath::new(timed.collect())?.about(body(&rows[0]).center)?;
            let spins = rows[..rows.len() - 1].iter().map(|row| body(row).spin);
            if spins.clone().any(|spin| spin != DVec3::ZERO) {
                path.with_angular_velocities(spins.map(DVec3::into).collect())
            } else {
                Ok(path)
            }
        };
        let (a, b) = (path_of(|row| row.a)?, path_of(|row| row.b)?);
        Ok(PathPair {
            id: id.to_owned(),
            duration: a.end_time(),
            a,
            b,
            start_time: start,
            end: rows[rows.len() - 1].time,
        })
    }

    /// Returns the poses of both bodies at a time, measured from the start.
    ///
    /// # Errors
    /// [`InputError`]: a pose is out of range.
    pub fn poses_at(&self, time: f64) -> Result<[Pose; 2], InputError> {
        Ok([self.a.pose(time)?, self.b.pose(time)?])
    }

    /// Returns the times of the rows, measured from the start.
    pub fn times(&self) -> impl Iterator<Item = f64> {
        self.a.times()
    }

    /// Converts a time measured from the start to the table's time, rounded down.
    pub fn table_time_rounded_down(&self, time: f64) -> f64 {
        self.table_time_rounded_towards(time, -1.0)
    }

    /// Converts a time measured from the start to the table's time, rounded up.
    pub fn table_time_rounded_up(&self, time: f64) -> f64 {
        self.table_time_rounded_towards(time, 1.0)
    }

    fn table_time_rounded_towards(&self, time: f64, direction: f64) -> f64 {
        if self.start_time == 0.0 {
            return time;
        }
        // The differences of times from the first one are rounded, and so is this sum.
        let rounding = 4.0 * f64::EPSILON * (self.start_time.abs() + self.duration);
        match self.start_time + time + direction * rounding {
            _ if time >= self.duration => self.end,
            early if early < self.start_time => self.start_time,
            late if late > self.end => self.end,
            within => within,
        }
    }
}
