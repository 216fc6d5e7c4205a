//! Converts parry's arguments to a cast in double precision.

use super::CONTACT;
use super::convert::{motion, point_from_parry, pose_from_parry};
use super::hits::hit;
use super::library::math::{Pose, Real, Vector};
use super::library::query::{NonlinearRigidMotion, ShapeCastHit, ShapeCastOptions};
use crate::cast::{Cast, PreparedShape};
use crate::interval::Interval;
use crate::{CastError, Options, ShapeError};
use ccd_core::{Motion, StartPolicy};
use rigid_ccd::Solver;

/// Converts the arguments of `cast_shapes_nonlinear` to a cast; `None` if the end time is before the start time.
pub(super) fn nonlinear_cast_from_arguments(
    motions: [&NonlinearRigidMotion; 2],
    times: [Real; 2],
    stop_at_penetration: bool,
    options: &Options,
) -> Result<Option<Cast>, CastError> {
    let motions = CastError::motions_or_error(motions.map(motion))?;
    let interval = times.map(f64::from);
    cast_of_motions(motions, interval, 0.0, stop_at_penetration, options)
}

/// Converts the arguments of `cast_shapes` to a cast; `None` if the maximum time is negative.
pub(super) fn linear_cast_from_arguments(
    bodies: [(&Pose, Vector); 2],
    parry_options: ShapeCastOptions,
    options: &Options,
) -> Result<Option<Cast>, CastError> {
    let translation = |(pose, velocity): (&Pose, Vector)| {
        Motion::new(pose_from_parry(pose)?, point_from_parry(velocity), [0.0; 3])
    };
    let motions = CastError::motions_or_error(bodies.map(translation))?;
    let interval = [0.0, f64::from(parry_options.max_time_of_impact)];
    let target = f64::from(parry_options.target_distance);
    cast_of_motions(
        motions,
        interval,
        target,
        parry_options.stop_at_penetration,
        options,
    )
}

/// Runs a cast on two shapes, and converts the hit to parry's type; without a cast there is no hit.
pub(super) fn run_cast(
    cast: Option<Cast>,
    shapes: [Result<PreparedShape, ShapeError>; 2],
    solver: &mut Solver,
) -> Result<Option<ShapeCastHit>, CastError> {
    let [a, b] = CastError::shapes_or_error(shapes)?;
    let hit_of_cast = cast.map(|cast| cast.answer([&a, &b], solver)).transpose()?;
    Ok(hit_of_cast.flatten().as_ref().map(hit))
}

fn cast_of_motions(
    motions: [Motion; 2],
    [start, end]: [f64; 2],
    target: f64,
    stop_at_penetration: bool,
    options: &Options,
) -> Result<Option<Cast>, CastError> {
    let interval = Interval::new(start, end)?;
    let start_policy = if stop_at_penetration {
        StartPolicy::Report
    } else {
        StartPolicy::Leave
    };
    Ok(interval.map(|interval| Cast {
        motions,
        interval,
        target,
        start_policy,
        options: *options,
        default_tolerance: CONTACT,
    }))
}
