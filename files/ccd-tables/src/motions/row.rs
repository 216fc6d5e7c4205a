//! Parses one row of a table as the motions or poses of bodies.

use super::Motions;
use crate::columns::BODY_COLUMN_INDEX;
use crate::columns::{
    Columns, DURATION_COLUMN_INDEX, ID_COLUMN_INDEX, Quantity, Side, TIME_COLUMN_INDEX,
};
use crate::error::RowProblem;
use crate::records::Record;
use ccd_core::glam::{DQuat, DVec3};
use ccd_core::{InputError, Motion, Pose};
use std::ops::Range;

/// Parses a row of a table of motions; `index` is the default id.
///
/// # Errors
/// The problem of the row.
pub fn parse_row<R: Record>(
    columns: &Columns,
    record: &R,
    index: usize,
) -> Result<Motions, RowProblem> {
    let row = Row::new(columns, record)?;
    // Normalise a negative zero.
    let duration = row.number(DURATION_COLUMN_INDEX)?.unwrap_or(1.0) + 0.0;
    if duration < 0.0 {
        return Err(RowProblem::BadDuration {
            value: duration,
            allowed: "at least 0",
        });
    }
    let [a, b] = [
        row.motion(Side::A, duration)?,
        row.motion(Side::B, duration)?,
    ];
    for motion in [&a, &b] {
        columns.remark_collector().note_motion(motion, duration);
    }
    Ok(Motions {
        id: id(columns, record).unwrap_or_else(|| index.to_string()),
        a,
        b,
        duration,
    })
}

/// A body of a scene, as a row of its table gives it.
pub struct BodyRow {
    /// The id of the row; its index by default.
    pub id: String,
    /// The description of the body in the column `body`.
    pub body_text: String,
    /// The motion of the body, from time 0.
    pub motion: Motion,
}

/// Parses a row of the table of a scene, in which all motions end at `duration`; `index` is the default id.
pub fn body_row<R: Record>(
    columns: &Columns,
    record: &R,
    index: usize,
    duration: f64,
) -> Result<BodyRow, RowProblem> {
    let row = Row::new(columns, record)?;
    let motion = row.motion(Side::A, duration)?;
    columns.remark_collector().note_motion(&motion, duration);
    let text = columns
        .index(BODY_COLUMN_INDEX)
        .and_then(|cell| record.text(cell));
    Ok(BodyRow {
        id: id(columns, record).unwrap_or_else(|| index.to_string()),
        body_text: text.unwrap_or_default(),
        motion,
    })
}

/// The time and the poses of both bodies in one row of a table of paths.
pub(crate) struct TimedBodyPoses {
    pub(crate) time: f64,
    pub(crate) a: BodyPose,
    pub(crate) b: BodyPose,
}

/// The pose of a body in one row of a table of paths, with its angular velocity and its center of rotation.
#[derive(Clone, Copy)]
pub(crate) struct BodyPose {
    pub(crate) pose: Pose,
    /// The angular velocity to the next row; zero for the shortest rotation.
    pub(crate) spin: DVec3,
    pub(crate) center: DVec3,
}

/// Parses a row of a table of paths as the poses of both bodies at a time.
pub(crate) fn poses<R: Record>(
    columns: &Columns,
    record: &R,
) -> Result<TimedBodyPoses, RowProblem> {
    let row = Row::new(columns, record)?;
    if columns.index(ID_COLUMN_INDEX).is_some() && id(columns, record).is_none() {
        return Err(RowProblem::NoId);
    }
    Ok(TimedBodyPoses {
        time: row.number(TIME_COLUMN_INDEX)?.ok_or_else(|| {
            let column = columns.name(TIME_COLUMN_INDEX).to_owned();
            RowProblem::EmptyCell { column }
        })?,
        a: row.body_pose(Side::A)?,
        b: row.body_pose(Side::B)?,
    })
}

/// Returns the id of a row, even if other cells are unreadable; `None` without one.
pub(crate) fn id<R: Record>(columns: &Columns, record: &R) -> Option<String> {
    record.text(columns.index(ID_COLUMN_INDEX)?)
}

struct Row<'a, R> {
    columns: &'a Columns,
    record: &'a R,
}

/// The two ways in which a row gives the motion of a body.
enum MotionEncoding {
    EndPose,
    Velocities,
}

impl<'a, R: Record> Row<'a, R> {
    fn new(columns: &'a Columns, record: &'a R) -> Result<Self, RowProblem> {
        record.check(columns.header())?;
        Ok(Row { columns, record })
    }

    /// Returns the pose of a body at the start.
    fn start_pose(&self, side: Side) -> Result<Pose, RowProblem> {
        let position = self.vector(side, Quantity::Position)?;
        let orientation = self.quaternion(side, Quantity::Orientation)?;
        Ok(Pose::new(
            position.unwrap_or_default(),
            orientation.unwrap_or_default(),
        )?)
    }

    fn body_pose(&self, side: Side) -> Result<BodyPose, RowProblem> {
        Ok(BodyPose {
            pose: self.start_pose(side)?,
            spin: self.vector_or_zero(side, Quantity::AngularVelocity)?,
            center: self.vector_or_zero(side, Quantity::Center)?,
        })
    }

    fn motion(&self, side: Side, duration: f64) -> Result<Motion, RowProblem> {
        let start = self.start_pose(side)?;
        let center = self.vector_or_zero(side, Quantity::Center)?;
        match self.motion_kind(side)? {
            MotionEncoding::Velocities => {
                let velocity = self.vector_or_zero(side, Quantity::Velocity)?;
                let spin = self.vector_or_zero(side, Quantity::AngularVelocity)?;
                Ok(Motion::about(start, velocity, spin, center)?)
            }
            MotionEncoding::EndPose => {
                let position = self.vector(side, Quantity::EndPosition)?;
                let orientation = self.quaternion(side, Quantity::EndOrientation)?;
                let end = Pose::new(
                    position.unwrap_or(start.translation()),
                    orientation.unwrap_or(start.rotation()),
                )?;
                Ok(Motion::between(start, end, center, duration)?)
            }
        }
    }

    /// Returns whether the row gives a body's motion by an end pose or by velocities; it is an error to give both.
    fn motion_kind(&self, side: Side) -> Result<MotionEncoding, RowProblem> {
        let end = [Quantity::EndPosition, Quantity::EndOrientation];
        let velocities = [Quantity::Velocity, Quantity::AngularVelocity];
        let is_given = |cell| self.record.has_value(cell);
        match (
            self.column_where(side, end, is_given),
            self.column_where(side, velocities, is_given),
        ) {
            (Some(end), Some(velocity)) => Err(RowProblem::EndPoseAndVelocity {
                end_pose_column: self.columns.name(end).to_owned(),
                velocity_column: self.columns.name(velocity).to_owned(),
            }),
            (None, Some(_)) => Ok(MotionEncoding::Velocities),
            // If the table has the columns, reading reports the empty cell.
            (_, None) => match self.column_where(side, end, |_| true) {
                Some(_) => Ok(MotionEncoding::EndPose),
                None => Ok(MotionEncoding::Velocities),
            },
        }
    }

    /// Returns the first column of two quantities whose cell satisfies a condition; `None` without one.
    fn column_where(
        &self,
        side: Side,
        quantities: [Quantity; 2],
        condition: impl Fn(usize) -> bool,
    ) -> Option<usize> {
        let slots = quantities.into_iter();
        let mut slots = slots.flat_map(|quantity| self.columns.known_column_range(side, quantity));
        slots.find(|&slot| self.columns.index(slot).is_some_and(&condition))
    }

    /// Returns a vector of a body, with 0 for missing columns; `None` if all of its columns are missing.
    fn vector(&self, side: Side, quantity: Quantity) -> Result<Option<DVec3>, RowProblem> {
        let components = self.numbers::<3>(self.columns.known_column_range(side, quantity))?;
        let is_given = components.iter().any(Option::is_some);
        Ok(is_given.then(|| DVec3::from(components.map(Option::unwrap_or_default))))
    }

    fn vector_or_zero(&self, side: Side, quantity: Quantity) -> Result<DVec3, RowProblem> {
        Ok(self.vector(side, quantity)?.unwrap_or_default())
    }

    /// Returns a nonzero quaternion of a body as given, not normalised; `None` if the table has no columns for it.
    fn quaternion(&self, side: Side, quantity: Quantity) -> Result<Option<DQuat>, RowProblem> {
        let slots = self.columns.known_column_range(side, quantity);
        // A table has all four columns, or none.
        let [Some(w), Some(x), Some(y), Some(z)] = self.numbers(slots.clone())? else {
            return Ok(None);
        };
        let quaternion = DQuat::from_xyzw(x, y, z, w);
        match Pose::new(DVec3::ZERO, quaternion) {
            Ok(_) => {
                self.columns
                    .remark_collector()
                    .note_quaternion([x, y, z, w]);
                Ok(Some(quaternion))
            }
            Err(InputError::ZeroQuaternion) => Err(RowProblem::ZeroQuaternion {
                columns: slots
                    .map(|slot| self.columns.name(slot).to_owned())
                    .collect(),
                value: [w, x, y, z],
            }),
            Err(other) => Err(other.into()),
        }
    }

    fn numbers<const N: usize>(&self, slots: Range<usize>) -> Result<[Option<f64>; N], RowProblem> {
        let mut out = [None; N];
        for (number, slot) in out.iter_mut().zip(slots) {
            *number = self.number(slot)?;
        }
        Ok(out)
    }

    /// Returns the number in a known column; `None` if the table does not have the column.
    ///
    /// An empty cell is an error: writers of tables leave one for a NaN, and 0 would be another motion.
    fn number(&self, slot: usize) -> Result<Option<f64>, RowProblem> {
        let Some(cell) = self.columns.index(slot) else {
            return Ok(None);
        };
        let column = self.columns.name(slot);
        self.record.required_number(cell, column).map(Some)
    }
}
