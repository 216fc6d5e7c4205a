//! Converts parry's arguments to a cast in double precision.

use super::CONTACT;
use super::convert::{motion, point, pose};
use super::hits::hit;
use super::library::math::{Pose, Real, Vector};
use super::library::query::{NonlinearRigidMotion, ShapeCastHit, ShapeCastOptions};
#[cfg(feature = "record")]
use crate::Recording;
use crate::cast::{Cast, PreparedShape};
use crate::interval::Interval;
use crate::{CastError, Options};
use ccd_core::{InputError, Motion, StartPolicy};
use rigid_ccd::Solver;

/// The arguments of a cast in double precision, without the shapes.
#[derive(Clone, Copy, Debug)]
pub(super) struct Question {
    motions: [Motion; 2],
    /// The time interval of the cast; `None` if it contains no time.
    interval: Option<Interval>,
    target: f64,
    start: StartPolicy,
}

impl Question {
    /// Creates the cast from the arguments of `cast_shapes_nonlinear`.
    pub(super) fn from_nonlinear_cast(
        motions: [&NonlinearRigidMotion; 2],
        [start_time, end_time]: [Real; 2],
        stop_at_penetration: bool,
    ) -> Result<Self, CastError> {
        let [a, b] = motions.map(motion);
        Ok(Question {
            motions: [named_error(1, a)?, named_error(2, b)?],
            interval: Interval::new(f64::from(start_time), f64::from(end_time))?,
            target: 0.0,
            start: policy(stop_at_penetration),
        })
    }

    /// Creates the cast from the arguments of `cast_shapes`.
    pub(super) fn from_linear_cast(
        bodies: [(&Pose, Vector); 2],
        options: ShapeCastOptions,
    ) -> Result<Self, CastError> {
        let slides =
            |(at, velocity): (&Pose, Vector)| Motion::new(pose(at)?, point(velocity), [0.0; 3]);
        let [a, b] = bodies.map(slides);
        Ok(Question {
            motions: [named_error(1, a)?, named_error(2, b)?],
            interval: Interval::new(0.0, f64::from(options.max_time_of_impact))?,
            target: f64::from(options.target_distance),
            start: policy(options.stop_at_penetration),
        })
    }

    /// Runs the cast on two shapes.
    pub(super) fn answer(
        &self,
        shapes: [&PreparedShape; 2],
        options: &Options,
        solver: &mut Solver,
    ) -> Result<Option<ShapeCastHit>, CastError> {
        let Some(interval) = self.interval else {
            return Ok(None);
        };
        let found = self.cast(interval, shapes, options).answer(solver)?;
        Ok(found.as_ref().map(hit))
    }

    /// Records the cast of two shapes for the command `ccd`.
    #[cfg(feature = "record")]
    pub(super) fn record(
        &self,
        shapes: [&PreparedShape; 2],
        options: &Options,
    ) -> Result<Recording, CastError> {
        let interval = self.interval.ok_or(CastError::NoTime)?;
        let cast = self.cast(interval, shapes, options);
        cast.with_scene(|scene| Ok(Recording::new(scene)))
    }

    fn cast<'a>(
        &self,
        interval: Interval,
        shapes: [&'a PreparedShape; 2],
        options: &Options,
    ) -> Cast<'a> {
        Cast {
            shapes,
            motions: self.motions,
            interval,
            target: self.target,
            start: self.start,
            options: *options,
            contact: CONTACT,
        }
    }
}

fn named_error(which: u8, motion: Result<Motion, InputError>) -> Result<Motion, CastError> {
    motion.map_err(|error| CastError::Motion { which, error })
}

fn policy(stop_at_penetration: bool) -> StartPolicy {
    if stop_at_penetration {
        StartPolicy::Report
    } else {
        StartPolicy::Leave
    }
}
