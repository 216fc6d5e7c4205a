//! One row of the table, parsed as the motions of two bodies.

use super::Query;
use crate::table::columns::{Columns, DURATION, ID, Quantity, Side, TIME};
use crate::table::error::RowProblem;
use crate::table::records::{Cells, Record};
use ccd_core::glam::{DQuat, DVec3};
use ccd_core::{InputError, Motion, Pose};
use std::ops::Range;

/// Parses a row of a table of motions; `index` is the id of a row without one.
///
/// # Errors
/// What is wrong with the row.
pub fn query<R: Record + ?Sized>(
    columns: &Columns,
    record: &R,
    index: usize,
) -> Result<Query, RowProblem> {
    let row = Row {
        columns,
        cells: record.cells(columns)?,
    };
    // A negative zero is a zero.
    let duration = row.number(DURATION)?.unwrap_or(1.0) + 0.0;
    if duration < 0.0 {
        return Err(RowProblem::BadDuration {
            value: duration,
            allowed: "at least 0",
        });
    }
    Ok(Query {
        id: id(columns, record).unwrap_or_else(|| index.to_string()),
        a: row.motion(Side::A, duration)?,
        b: row.motion(Side::B, duration)?,
        duration,
    })
}

/// The poses of both bodies at a time.
pub(in crate::table) struct Poses {
    pub(in crate::table) time: f64,
    pub(in crate::table) a: Pose,
    pub(in crate::table) b: Pose,
}

/// Parses a row of a path.
pub(in crate::table) fn poses<R: Record + ?Sized>(
    columns: &Columns,
    record: &R,
) -> Result<Poses, RowProblem> {
    let row = Row {
        columns,
        cells: record.cells(columns)?,
    };
    if columns.index(ID).is_some() && id(columns, record).is_none() {
        return Err(RowProblem::NoId);
    }
    Ok(Poses {
        time: row.number(TIME)?.ok_or(RowProblem::NoTime)?,
        a: row.start(Side::A)?,
        b: row.start(Side::B)?,
    })
}

/// Returns the id of a row, which may be unreadable otherwise; none where it has none.
pub(in crate::table) fn id<R: Record + ?Sized>(columns: &Columns, record: &R) -> Option<String> {
    record.text(columns.index(ID)?)
}

struct Row<'a, C> {
    columns: &'a Columns,
    cells: C,
}

impl<C: Cells> Row<'_, C> {
    /// Returns the pose at the start.
    fn start(&self, side: Side) -> Result<Pose, RowProblem> {
        let position = self.vector(side, Quantity::Position)?;
        let orientation = self.quaternion(side, Quantity::Orientation)?;
        Ok(Pose::new(
            position.unwrap_or(DVec3::ZERO),
            orientation.unwrap_or(DQuat::IDENTITY),
        )?)
    }

    fn motion(&self, side: Side, duration: f64) -> Result<Motion, RowProblem> {
        let start = self.start(side)?;
        let velocity = self.vector(side, Quantity::Velocity)?;
        let spin = self.vector(side, Quantity::Spin)?;
        let centre = self.vector(side, Quantity::Centre)?.unwrap_or(DVec3::ZERO);
        self.check_end_or_velocity(side)?;
        let end_position = self.full_vector(side, Quantity::EndPosition)?;
        let end_orientation = self.quaternion(side, Quantity::EndOrientation)?;
        if end_position.is_none() && end_orientation.is_none() {
            let (velocity, spin) = (velocity.unwrap_or_default(), spin.unwrap_or_default());
            return Ok(Motion::about(start, velocity, spin, centre)?);
        }
        let end = Pose::new(
            end_position.unwrap_or(start.translation()),
            end_orientation.unwrap_or(start.rotation()),
        )?;
        Ok(Motion::between(start, end, centre, duration)?)
    }

    /// Refuses an end pose together with velocities.
    fn check_end_or_velocity(&self, side: Side) -> Result<(), RowProblem> {
        let end = self.first_given(side, Quantity::EndPosition, Quantity::EndOrientation);
        let velocity = self.first_given(side, Quantity::Velocity, Quantity::Spin);
        match (end, velocity) {
            (Some(end), Some(velocity)) => Err(RowProblem::EndPoseAndVelocity { end, velocity }),
            _ => Ok(()),
        }
    }

    fn first_given(&self, side: Side, first: Quantity, second: Quantity) -> Option<String> {
        self.columns
            .slots(side, first)
            .chain(self.columns.slots(side, second))
            .find(|&slot| {
                self.columns
                    .index(slot)
                    .is_some_and(|cell| self.cells.is_given(cell))
            })
            .map(|slot| self.columns.name(slot).to_owned())
    }

    /// Returns a vector whose missing components are 0; none when all are missing.
    fn vector(&self, side: Side, quantity: Quantity) -> Result<Option<DVec3>, RowProblem> {
        let parts = self.numbers::<3>(self.columns.slots(side, quantity))?;
        let given = parts.iter().any(Option::is_some);
        Ok(given.then(|| DVec3::from(parts.map(Option::unwrap_or_default))))
    }

    /// Returns a vector with all components or none: 0 is no natural default for an end position.
    fn full_vector(&self, side: Side, quantity: Quantity) -> Result<Option<DVec3>, RowProblem> {
        let parts = self.all_or_none::<3>(self.columns.slots(side, quantity))?;
        Ok(parts.map(DVec3::from))
    }

    /// Returns a quaternion that is not normalised yet, but can be; all four components or none.
    fn quaternion(&self, side: Side, quantity: Quantity) -> Result<Option<DQuat>, RowProblem> {
        let slots = self.columns.slots(side, quantity);
        let Some([w, x, y, z]) = self.all_or_none(slots.clone())? else {
            return Ok(None);
        };
        let quaternion = DQuat::from_xyzw(x, y, z, w);
        match Pose::new(DVec3::ZERO, quaternion) {
            Ok(_) => Ok(Some(quaternion)),
            Err(InputError::ZeroQuaternion) => Err(RowProblem::ZeroQuaternion {
                columns: slots
                    .map(|slot| self.columns.name(slot).to_owned())
                    .collect(),
                value: [w, x, y, z],
            }),
            Err(other) => Err(other.into()),
        }
    }

    fn all_or_none<const N: usize>(
        &self,
        slots: Range<usize>,
    ) -> Result<Option<[f64; N]>, RowProblem> {
        let parts = self.numbers(slots.clone())?;
        let Some(given) = parts.iter().position(Option::is_some) else {
            return Ok(None);
        };
        if let Some(missing) = parts.iter().position(Option::is_none) {
            return Err(RowProblem::MissingColumn {
                given: self.columns.name(slots.start + given).to_owned(),
                missing: self.columns.name(slots.start + missing).to_owned(),
            });
        }
        Ok(Some(parts.map(Option::unwrap_or_default)))
    }

    fn numbers<const N: usize>(&self, slots: Range<usize>) -> Result<[Option<f64>; N], RowProblem> {
        let mut out = [None; N];
        for (number, slot) in out.iter_mut().zip(slots) {
            *number = self.number(slot)?;
        }
        Ok(out)
    }

    fn number(&self, slot: usize) -> Result<Option<f64>, RowProblem> {
        let Some(cell) = self.columns.index(slot) else {
            return Ok(None);
        };
        let found = self.cells.number(cell);
        found.map_err(|value| RowProblem::NotANumber {
            column: self.columns.name(slot).to_owned(),
            value,
        })
    }
}
