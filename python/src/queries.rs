//! One query at a time.

use crate::answers;
use crate::body::{body_of, warn_of_tolerance};
use crate::course::{Course, Moved, Pair};
use crate::errors::{fault, input, query, unresolved_distance, warn};
use crate::motion::pose_of;
use crate::polled::polled;
use crate::settings::{OF_APPROACHES, OF_CONTACTS, OF_DISTANCES, config};
use pyo3::prelude::*;
use pyo3::types::PyDict;
use rigid_ccd::schedule::{ClosestApproach, GreatestDistance};
use rigid_ccd::{Answer, Config, Error, Limit, Solver};
use std::cell::Cell;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::time::{Duration, Instant};

/// The work of about a tenth of a second. A query with more to do is asked again on a thread of its own, while this one
/// looks for Ctrl-C.
const SHORT: u64 = 100_000;

/// The time of that, as a path has a budget for each of its parts.
const MOMENT: Duration = Duration::from_millis(200);

thread_local! {
    /// The solver of this thread, which keeps its memory from query to query. A panic leaves a new one.
    static SOLVER: Cell<Solver> = Cell::new(Solver::new());
}

/// What ended a query, and how far it had come: until what time, or to what distance, nothing touches.
type Reached = Option<(Limit, f64)>;

/// Asks a solver, without the GIL. Ctrl-C ends it.
fn ask<T: Send>(
    py: Python<'_>,
    config: Config,
    reached: impl Fn(&T) -> Reached,
    question: impl Fn(&mut Solver) -> T + Send + Sync,
) -> PyResult<T> {
    let begin = Instant::now();
    let short = Config {
        budget: config.budget.min(SHORT),
        deadline: Some(
            config
                .deadline
                .map_or(MOMENT, |deadline| deadline.min(MOMENT)),
        ),
        ..config
    };
    let first = py.detach(|| {
        catch_unwind(AssertUnwindSafe(|| {
            let mut solver = SOLVER.take();
            solver.set_config(short);
            let found = question(&mut solver);
            SOLVER.set(solver);
            found
        }))
    });
    let first = first.map_err(|panic| fault(panic.as_ref()))?;
    let until = match reached(&first) {
        Some((Limit::Budget, until)) if config.budget > SHORT => until,
        Some((Limit::Deadline, until))
            if config.deadline.is_none_or(|deadline| deadline > MOMENT) =>
        {
            until
        }
        _ => return Ok(first),
    };
    let left = config
        .deadline
        .map(|deadline| deadline.saturating_sub(begin.elapsed()));
    let whole = Config {
        deadline: left,
        ..config
    };
    let (found, seen) = polled(
        py,
        |stop| question(&mut Solver::new().with_config(whole).with_stop(stop)),
        |_| Ok(()),
    )?;
    seen?;
    // With little time left, the first answer may have come farther.
    Ok(match reached(&found) {
        Some((_, farther)) if until > farther => first,
        _ => found,
    })
}

fn safe_until<T>(found: &Result<T, Error>) -> Reached {
    match found {
        Err(Error::Unresolved { reason, safe_until }) => Some((*reason, *safe_until)),
        _ => None,
    }
}

fn pair<'c>(
    (a, motion_a): (&'c Bound<'_, PyAny>, Option<&'c Bound<'_, PyAny>>),
    (b, motion_b): (&'c Bound<'_, PyAny>, Option<&'c Bound<'_, PyAny>>),
) -> PyResult<Pair<'c>> {
    Ok(Pair {
        a: (body_of(a, "a")?, Course::of(motion_a, "motion_a")?),
        b: (body_of(b, "b")?, Course::of(motion_b, "motion_b")?),
    })
}

/// Finds the first contact of two moving bodies, from time 0 to `duration`; None when they stay apart.
///
/// Nothing touches before its time, and without a contact nothing touches at all: that is proven, in floating point.
///
/// Args:
///     a, b: the bodies.
///     motion_a, motion_b: a Motion, a Path, or a link of a Chain; None rests at the world's origin.
///     duration: the end, in the motions' unit of time; by default that of a path or a link, else 1.
///     tolerance: a contact is reported at a distance of at most margin + tolerance, in your unit of length; 0.001 by
///         default.
///     margin: a distance to keep; 0 by default.
///     budget: the work after which a query is given up, of a path that between two poses; a million takes about a
///         second.
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
#[pyo3(signature = (a, b, motion_a = None, motion_b = None, duration = None, **settings))]
pub(crate) fn first_contact<'py>(
    py: Python<'py>,
    a: &Bound<'_, PyAny>,
    b: &Bound<'_, PyAny>,
    motion_a: Option<&Bound<'_, PyAny>>,
    motion_b: Option<&Bound<'_, PyAny>>,
    duration: Option<f64>,
    settings: Option<&Bound<'_, PyDict>>,
) -> PyResult<Option<Bound<'py, PyAny>>> {
    let config = config(settings, OF_CONTACTS)?;
    let pair = pair((a, motion_a), (b, motion_b))?;
    let duration = pair.duration(duration)?;
    warn(py, pair.remarks(duration), 1)?;
    warn_of_tolerance([a, b], config.tolerance, 1)?;
    let found = ask(py, config, safe_until, |solver| match pair.moved() {
        Moved::Steadily(a, b) => solver.first_contact(a, b, duration),
        Moved::Along(a, b) => solver.first_contact_along(a, b, duration),
    })?;
    match found {
        Ok(hit) => hit.map(|hit| answers::contact(py, &hit)).transpose(),
        Err(error) => Err(query(py, error)),
    }
}

/// Returns whether two moving bodies stay apart, by more than the margin.
///
/// True is proven. False may also mean that they come within margin + tolerance. Arguments and exceptions are those of
/// `first_contact`.
#[pyfunction]
#[pyo3(signature = (a, b, motion_a = None, motion_b = None, duration = None, **settings))]
pub(crate) fn is_free(
    py: Python<'_>,
    a: &Bound<'_, PyAny>,
    b: &Bound<'_, PyAny>,
    motion_a: Option<&Bound<'_, PyAny>>,
    motion_b: Option<&Bound<'_, PyAny>>,
    duration: Option<f64>,
    settings: Option<&Bound<'_, PyDict>>,
) -> PyResult<bool> {
    let config = config(settings, OF_CONTACTS)?;
    let pair = pair((a, motion_a), (b, motion_b))?;
    let duration = pair.duration(duration)?;
    warn(py, pair.remarks(duration), 1)?;
    warn_of_tolerance([a, b], config.tolerance, 1)?;
    let found = ask(py, config, safe_until, |solver| match pair.moved() {
        Moved::Steadily(a, b) => solver.is_free(a, b, duration),
        Moved::Along(a, b) => solver.is_free_along(a, b, duration),
    })?;
    found.map_err(|error| query(py, error))
}

/// Brackets the least distance of two moving bodies, to within the tolerance.
///
/// Arguments and exceptions are those of `first_contact`, without a margin. `Unresolved` has `lower` and `upper`.
///
/// With a `clearance`, it ends as soon as that is proven to be kept, or seen to be violated: the answer says which, and
/// its bounds are no closer than that takes.
///
/// Bounds are those of the shapes: what the bodies exceed them by, their `sticks_out`, is in the upper one. A clearance is
/// violated only where the shapes certainly come nearer.
///
/// >>> from rigid_ccd import Body, Motion, closest_approach
/// >>> ball, passes = Body.sphere(0.5), Motion([-3, 1.2, 0], velocity=[6, 0, 0])
/// >>> closest_approach(ball, ball, passes, clearance=0.1).clearance
/// 'kept'
#[pyfunction]
#[pyo3(signature = (a, b, motion_a = None, motion_b = None, duration = None, **settings))]
pub(crate) fn closest_approach<'py>(
    py: Python<'py>,
    a: &Bound<'_, PyAny>,
    b: &Bound<'_, PyAny>,
    motion_a: Option<&Bound<'_, PyAny>>,
    motion_b: Option<&Bound<'_, PyAny>>,
    duration: Option<f64>,
    settings: Option<&Bound<'_, PyDict>>,
) -> PyResult<Bound<'py, PyAny>> {
    let config = config(settings, OF_APPROACHES)?;
    let pair = pair((a, motion_a), (b, motion_b))?;
    let duration = pair.duration(duration)?;
    warn(py, pair.remarks(duration), 1)?;
    warn_of_tolerance([a, b], config.tolerance, 1)?;
    measure(py, config, |solver| {
        let found = match pair.moved() {
            Moved::Steadily(a, b) => solver.closest_approach(a, b, duration),
            Moved::Along(a, b) => solver.closest_approach_along(a, b, duration),
        };
        Ok(found?.outcome)
    })
}

/// Brackets the greatest distance of two moving bodies, to within the tolerance: that of their nearest points at each time.
///
/// At the `time` of the answer it is at least `lower`, and it is never more than `upper`. Arguments and exceptions are those
/// of `first_contact`, without a margin. What the bodies exceed their shapes by, their `sticks_out`, is in `upper`.
///
/// >>> from rigid_ccd import Body, Motion, greatest_distance
/// >>> ball, leaves = Body.sphere(0.5), Motion([1.5, 0, 0], velocity=[1, 0, 0])
/// >>> round(greatest_distance(ball, ball, leaves).upper, 2)
/// 1.5
#[pyfunction]
#[pyo3(signature = (a, b, motion_a = None, motion_b = None, duration = None, **settings))]
pub(crate) fn greatest_distance<'py>(
    py: Python<'py>,
    a: &Bound<'_, PyAny>,
    b: &Bound<'_, PyAny>,
    motion_a: Option<&Bound<'_, PyAny>>,
    motion_b: Option<&Bound<'_, PyAny>>,
    duration: Option<f64>,
    settings: Option<&Bound<'_, PyDict>>,
) -> PyResult<Bound<'py, PyAny>> {
    let config = config(settings, OF_DISTANCES)?;
    let pair = pair((a, motion_a), (b, motion_b))?;
    let duration = pair.duration(duration)?;
    let reached = |found: &Result<Answer<GreatestDistance>, rigid_ccd::InputError>| {
        let known = found.as_ref().ok()?.outcome;
        match known {
            GreatestDistance::Unresolved { reason, .. } => Some((reason, -known.upper())),
            GreatestDistance::Farthest { .. } => None,
        }
    };
    let found = ask(py, config, reached, |solver| match pair.moved() {
        Moved::Steadily(a, b) => solver.greatest_distance(a, b, duration),
        Moved::Along(a, b) => solver.greatest_distance_along(a, b, duration),
    })?;
    let found = found.map_err(input)?.outcome;
    match found {
        GreatestDistance::Unresolved { reason, .. } => Err(unresolved_distance(
            py,
            [found.lower(), found.upper()],
            reason,
        )),
        _ => answers::greatest(py, &found),
    }
}

/// Brackets the distance of two bodies at rest, each at a pose as of `Motion.between`; None is the world's origin.
///
/// >>> from rigid_ccd import Body, distance
/// >>> ball = Body.sphere(0.5)
/// >>> round(distance(ball, ball, ([3, 0, 0], [1, 0, 0, 0])).upper, 3)
/// 2.0
#[pyfunction]
#[pyo3(signature = (a, b, pose_a = None, pose_b = None, **settings))]
pub(crate) fn distance<'py>(
    py: Python<'py>,
    a: &Bound<'_, PyAny>,
    b: &Bound<'_, PyAny>,
    pose_a: Option<&Bound<'_, PyAny>>,
    pose_b: Option<&Bound<'_, PyAny>>,
    settings: Option<&Bound<'_, PyDict>>,
) -> PyResult<Bound<'py, PyAny>> {
    let pose = |pose: Option<&Bound<'_, PyAny>>, what| match pose {
        Some(pose) => pose_of(pose, what),
        None => Ok(rigid_ccd::Pose::IDENTITY),
    };
    let (pose_a, pose_b) = (pose(pose_a, "pose_a")?, pose(pose_b, "pose_b")?);
    let config = config(settings, OF_DISTANCES)?;
    warn_of_tolerance([a, b], config.tolerance, 1)?;
    let (a, b) = (body_of(a, "a")?, body_of(b, "b")?);
    measure(py, config, |solver| {
        Ok(solver.distance((a, pose_a), (b, pose_b))?.outcome)
    })
}

/// Asks for a bracket of a distance.
fn measure<'py>(
    py: Python<'py>,
    config: Config,
    question: impl Fn(&mut Solver) -> Result<ClosestApproach, rigid_ccd::InputError> + Send + Sync,
) -> PyResult<Bound<'py, PyAny>> {
    let reached = |found: &Result<ClosestApproach, _>| match found {
        Ok(known @ ClosestApproach::Unresolved { reason, .. }) => Some((*reason, known.lower())),
        _ => None,
    };
    let found = ask(py, config, reached, question)?.map_err(input)?;
    let bounds = [found.lower(), found.upper()];
    match found {
        ClosestApproach::Unresolved { reason, .. } => Err(unresolved_distance(py, bounds, reason)),
        _ => answers::distance(py, &found, config.clearance),
    }
}
