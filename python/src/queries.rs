//! One query at a time.

use crate::answers::{PyContact, PyDistance};
use crate::body::PyBody;
use crate::errors::{input, query, unresolved};
use crate::motion::{PyMotion, pose_of};
use pyo3::prelude::*;
use rigid_ccd::schedule::ClosestApproach;
use rigid_ccd::{Config, Motion, Moving, Solver};
use std::time::Duration;

/// Settings of a query, as keyword arguments.
fn config(
    tolerance: f64,
    margin: f64,
    budget: Option<u64>,
    deadline: Option<f64>,
) -> PyResult<Config> {
    let deadline = deadline
        .map(Duration::try_from_secs_f64)
        .transpose()
        .map_err(input)?;
    let usual = Config::default();
    Ok(Config {
        tolerance,
        margin,
        budget: budget.unwrap_or(usual.budget),
        deadline,
        ..usual
    })
}

/// Asks a solver about two bodies and their motions, without the GIL.
fn ask<T: Send>(
    py: Python<'_>,
    config: Config,
    bodies: [(&Bound<'_, PyBody>, Option<&Bound<'_, PyMotion>>); 2],
    question: impl FnOnce(&mut Solver, Moving<'_>, Moving<'_>) -> T + Send,
) -> T {
    let [a, b] = bodies.map(|(body, motion)| {
        let motion = motion.map_or(Motion::STILL, |motion| motion.get().motion);
        (&body.get().body, motion)
    });
    py.detach(|| question(&mut Solver::new().with_config(config), a.into(), b.into()))
}

/// Finds the first contact of two moving bodies, from time 0 to `duration`; None when they stay apart.
///
/// Nothing touches before its time, and without a contact nothing touches at all: that is proven, in floating point.
///
/// Args:
///     a, b: the bodies.
///     motion_a, motion_b: their motions; None rests at the world's origin.
///     duration: the end of the motions, in their unit of time.
///     tolerance: a contact is reported at a distance of at most margin + tolerance.
///     margin: a distance to keep.
///     budget: the work after which a query is given up; a million takes about a second.
///     deadline: seconds after which a query is given up.
///
/// Raises:
///     Unresolved: a limit was reached; its `safe_until` is proven.
///     InputError: a number is out of range.
///
/// >>> from rigid_ccd import Body, Motion, first_contact
/// >>> ball = Body.sphere(0.5)
/// >>> hit = first_contact(ball, ball, Motion([-3, 0, 0], velocity=[4, 0, 0]))
/// >>> 0.499 < hit.time <= 0.5
/// True
#[pyfunction]
#[pyo3(signature = (a, b, motion_a = None, motion_b = None, duration = 1.0, *, tolerance = 1e-3, margin = 0.0, budget = None, deadline = None))]
#[allow(clippy::too_many_arguments, reason = "keyword arguments of Python")]
pub(crate) fn first_contact(
    py: Python<'_>,
    a: &Bound<'_, PyBody>,
    b: &Bound<'_, PyBody>,
    motion_a: Option<&Bound<'_, PyMotion>>,
    motion_b: Option<&Bound<'_, PyMotion>>,
    duration: f64,
    tolerance: f64,
    margin: f64,
    budget: Option<u64>,
    deadline: Option<f64>,
) -> PyResult<Option<PyContact>> {
    let config = config(tolerance, margin, budget, deadline)?;
    let found = ask(
        py,
        config,
        [(a, motion_a), (b, motion_b)],
        |solver, a, b| solver.first_contact(a, b, duration),
    );
    match found {
        Ok(hit) => Ok(hit.as_ref().map(PyContact::of)),
        Err(error) => Err(query(py, error)),
    }
}

/// Returns whether two moving bodies stay apart, by more than the margin.
///
/// True is proven. Arguments and exceptions are those of `first_contact`.
#[pyfunction]
#[pyo3(signature = (a, b, motion_a = None, motion_b = None, duration = 1.0, *, tolerance = 1e-3, margin = 0.0, budget = None, deadline = None))]
#[allow(clippy::too_many_arguments, reason = "keyword arguments of Python")]
pub(crate) fn is_free(
    py: Python<'_>,
    a: &Bound<'_, PyBody>,
    b: &Bound<'_, PyBody>,
    motion_a: Option<&Bound<'_, PyMotion>>,
    motion_b: Option<&Bound<'_, PyMotion>>,
    duration: f64,
    tolerance: f64,
    margin: f64,
    budget: Option<u64>,
    deadline: Option<f64>,
) -> PyResult<bool> {
    let config = config(tolerance, margin, budget, deadline)?;
    let found = ask(
        py,
        config,
        [(a, motion_a), (b, motion_b)],
        |solver, a, b| solver.is_free(a, b, duration),
    );
    found.map_err(|error| query(py, error))
}

/// Brackets the least distance of two moving bodies, to within the tolerance.
///
/// Arguments and exceptions are those of `first_contact`, without a margin.
#[pyfunction]
#[pyo3(signature = (a, b, motion_a = None, motion_b = None, duration = 1.0, *, tolerance = 1e-3, budget = None, deadline = None))]
#[allow(clippy::too_many_arguments, reason = "keyword arguments of Python")]
pub(crate) fn closest_approach(
    py: Python<'_>,
    a: &Bound<'_, PyBody>,
    b: &Bound<'_, PyBody>,
    motion_a: Option<&Bound<'_, PyMotion>>,
    motion_b: Option<&Bound<'_, PyMotion>>,
    duration: f64,
    tolerance: f64,
    budget: Option<u64>,
    deadline: Option<f64>,
) -> PyResult<PyDistance> {
    let config = config(tolerance, 0.0, budget, deadline)?;
    let found = ask(
        py,
        config,
        [(a, motion_a), (b, motion_b)],
        |solver, a, b| solver.closest_approach(a, b, duration),
    );
    bracket(py, &found.map_err(input)?.outcome)
}

/// Brackets the distance of two bodies at rest, each at a pose as of `Motion.between`; None is the world's origin.
///
/// >>> from rigid_ccd import Body, distance
/// >>> ball = Body.sphere(0.5)
/// >>> round(distance(ball, ball, ([3, 0, 0], [1, 0, 0, 0])).upper, 3)
/// 2.0
#[pyfunction]
#[pyo3(signature = (a, b, pose_a = None, pose_b = None, *, tolerance = 1e-3))]
pub(crate) fn distance(
    py: Python<'_>,
    a: &Bound<'_, PyBody>,
    b: &Bound<'_, PyBody>,
    pose_a: Option<&Bound<'_, PyAny>>,
    pose_b: Option<&Bound<'_, PyAny>>,
    tolerance: f64,
) -> PyResult<PyDistance> {
    let pose = |pose: Option<&Bound<'_, PyAny>>, what| match pose {
        Some(pose) => pose_of(pose, what),
        None => Ok(rigid_ccd::Pose::IDENTITY),
    };
    let (pose_a, pose_b) = (pose(pose_a, "pose_a")?, pose(pose_b, "pose_b")?);
    let config = config(tolerance, 0.0, None, None)?;
    let (a, b) = (a.get(), b.get());
    let found = py.detach(|| {
        let mut solver = Solver::new().with_config(config);
        solver.distance((&a.body, pose_a), (&b.body, pose_b))
    });
    bracket(py, &found.map_err(input)?.outcome)
}

fn bracket(py: Python<'_>, found: &ClosestApproach) -> PyResult<PyDistance> {
    match found {
        ClosestApproach::Unresolved { reason, .. } => Err(unresolved(py, 0.0, reason)),
        _ => Ok(PyDistance::of(found)),
    }
}
