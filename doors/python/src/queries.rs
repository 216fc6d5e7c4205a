//! The Python functions that answer single queries.

use crate::answers;
use crate::body::{extract_body, warn_of_large_tolerance};
use crate::errors::{
    bounds_interruption, input_error, panic_error, time_interruption, unresolved_distance_error,
    unresolved_error, warn,
};
use crate::interruptible::run_interruptibly;
use crate::motion::read_pose;
use crate::movement::{GivenBodyAndMotion, Pair};
use crate::numbers::read_optional_number;
use crate::settings::{REPORTING_START, names, read};
use pyo3::prelude::*;
use pyo3::types::PyDict;
use rigid_ccd::Question;
use rigid_ccd::answer::{Limit, Unresolved};
use rigid_ccd::trajectory::MovingBody;
use rigid_ccd::{Answer, Hit, InputError, Outcome, Query, Settings, Solver};
use std::cell::Cell;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::Arc;
use std::time::{Duration, Instant};

/// The budget of a first attempt, about a tenth of a second. A query that needs more is repeated on another thread,
/// while this thread checks for Ctrl-C.
const FIRST_ATTEMPT_BUDGET: u64 = 100_000;

/// The time limit of a first attempt. It is needed because a path has a budget for each of its segments.
const FIRST_ATTEMPT_TIME_LIMIT: Duration = Duration::from_millis(100);

thread_local! {
    /// The solver of this thread. Its memory is reused between queries. After a panic there is a new one.
    static SOLVER: Cell<Solver> = Cell::new(Solver::new());
}

/// Two moving bodies, and a question about them.
struct PairQuestion<'a> {
    question: Question,
    bodies: [MovingBody<'a>; 2],
    duration: f64,
}

impl PairQuestion<'_> {
    fn answer(&self, solver: &mut Solver, settings: &Settings) -> Result<Answer, InputError> {
        let [a, b] = self.bodies;
        let query = Query::new(a, b, self.duration, settings)?;
        solver.answer_query(self.question, &query)
    }

    /// Returns the lower bound of the time or the distance that an unresolved answer proves.
    fn proven_bound(&self, known: &Unresolved) -> f64 {
        match self.question {
            question if question.is_for_a_distance() => known.lower,
            _ => known.safe_until,
        }
    }

    /// Answers the question without the GIL, so that other Python threads run. Ctrl-C ends it.
    fn run(&self, py: Python<'_>, settings: &Settings) -> PyResult<Answer> {
        let begin = Instant::now();
        let deadline = settings.deadline;
        let first_settings = Settings {
            budget: settings.budget.min(FIRST_ATTEMPT_BUDGET),
            deadline: Some(deadline.map_or(FIRST_ATTEMPT_TIME_LIMIT, |deadline| {
                deadline.min(FIRST_ATTEMPT_TIME_LIMIT)
            })),
            ..settings.clone()
        };
        let first = py.detach(|| {
            catch_unwind(AssertUnwindSafe(|| {
                let mut solver = SOLVER.take();
                let answer = self.answer(&mut solver, &first_settings);
                SOLVER.set(solver);
                answer
            }))
        });
        let first = first
            .map_err(|panic| panic_error(panic.as_ref()))?
            .map_err(input_error)?;
        let first_bound = match &first.outcome {
            Outcome::Unresolved(known)
                if known.limit == Limit::Budget && settings.budget > FIRST_ATTEMPT_BUDGET
                    || known.limit == Limit::Deadline
                        && deadline.is_none_or(|deadline| deadline > FIRST_ATTEMPT_TIME_LIMIT) =>
            {
                self.proven_bound(known)
            }
            _ => return Ok(first),
        };
        let remaining_time = deadline.map(|deadline| deadline.saturating_sub(begin.elapsed()));
        let work = |stop: &Arc<_>| {
            let settings = Settings {
                deadline: remaining_time,
                ..settings.clone()
            };
            self.answer(&mut Solver::new(), &settings.stopped_by(stop))
        };
        let (second, interruption) = run_interruptibly(py, work, |_| Ok(()))?;
        interruption.map_err(|cause| self.interruption(py, cause, &second))?;
        let second = second.map_err(input_error)?;
        // If little time is left, the first answer may prove more than the second.
        Ok(match &second.outcome {
            Outcome::Unresolved(known) if first_bound > self.proven_bound(known) => first,
            _ => second,
        })
    }
}

impl PairQuestion<'_> {
    /// Makes the exception for an interrupted question, with the bounds known so far.
    fn interruption(
        &self,
        py: Python<'_>,
        cause: PyErr,
        answer: &Result<Answer, InputError>,
    ) -> PyErr {
        let outcome = answer.as_ref().ok().map(|answer| &answer.outcome);
        match outcome {
            _ if !self.question.is_for_a_distance() => {
                let known = outcome.and_then(|outcome| match outcome {
                    Outcome::Unresolved(known) => Some(known.safe_until),
                    _ => None,
                });
                time_interruption(py, cause, known)
            }
            Some(outcome) => bounds_interruption(py, cause, [outcome.lower(), outcome.upper()]),
            None => bounds_interruption(py, cause, [0.0, f64::INFINITY]),
        }
    }
}

/// Checks the arguments of a question about two moving bodies, warns of likely mistakes, and answers the question.
pub(crate) fn ask(
    py: Python<'_>,
    question: Question,
    bodies: [GivenBodyAndMotion<'_, '_>; 2],
    duration: Option<f64>,
    settings: &Settings,
) -> PyResult<Answer> {
    let pair = Pair::extract(bodies)?;
    let duration = pair.duration(duration)?;
    warn(py, pair.remarks(duration), 1)?;
    warn_of_large_tolerance(bodies.map(|(body, _)| body), settings.tolerance, 1)?;
    let bodies = pair.moving_bodies();
    let pair_question = PairQuestion {
        question,
        bodies,
        duration,
    };
    pair_question.run(py, settings)
}

/// Returns the contact in an answer, or `None` if the bodies stay apart. An unresolved answer is an `UnresolvedError`.
fn hit_of_answer(py: Python<'_>, answer: Answer) -> PyResult<Option<Hit>> {
    answer.hit().map_err(|known| unresolved_error(py, &known))
}

/// Returns the distance in an answer, as a Python object.
fn distance_of_answer<'py>(
    py: Python<'py>,
    answer: &Answer,
    settings: &Settings,
) -> PyResult<Bound<'py, PyAny>> {
    match &answer.outcome {
        Outcome::Unresolved(known) => Err(unresolved_distance_error(py, known)),
        outcome => answers::make_distance(py, outcome, settings.clearance),
    }
}

/// Finds the first contact of two moving bodies, from time 0 to `duration`. Returns None if they stay apart.
///
/// Nothing touches before the time of the contact. If the result is None, nothing touches at all. Both are proven, in
/// floating point.
///
/// Args:
///     a, b: the bodies.
///     motion_a, motion_b: a Motion, a PosePath, or a LinkTrajectory; None is a static body at the world's origin.
///     duration: the end of the query, in the motions' unit of time. The default is the end of a path, a link's motion
///         or `Motion.between`, and 1 for other motions.
///     tolerance: a contact is reported at a distance of at most margin + tolerance, in your unit of length; 0.001 by
///         default.
///     margin: the distance at which bodies count as touching; 0 by default.
///     budget: the largest amount of work; a million takes about a second. Along a path it is for each segment between
///         two poses.
///     deadline: the seconds after which the query ends without an answer.
///
/// Raises:
///     UnresolvedError: a limit was reached. Nothing touches before `safe_until`.
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
    #[pyo3(from_py_with = read_optional_number)] duration: Option<f64>,
    settings: Option<&Bound<'_, PyDict>>,
) -> PyResult<Option<Bound<'py, PyAny>>> {
    let settings = read(settings, &names(Question::FirstContact, REPORTING_START))?;
    let bodies = [(a, motion_a), (b, motion_b)];
    let answer = ask(py, Question::FirstContact, bodies, duration, &settings)?;
    let hit = hit_of_answer(py, answer)?;
    hit.map(|hit| answers::contact(py, &hit)).transpose()
}

/// Returns whether two moving bodies always stay farther apart than the margin.
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
    #[pyo3(from_py_with = read_optional_number)] duration: Option<f64>,
    settings: Option<&Bound<'_, PyDict>>,
) -> PyResult<bool> {
    let settings = read(settings, &names(Question::AnyContact, REPORTING_START))?;
    let bodies = [(a, motion_a), (b, motion_b)];
    let answer = ask(py, Question::AnyContact, bodies, duration, &settings)?;
    Ok(hit_of_answer(py, answer)?.is_none())
}

/// Computes bounds of the least distance of two moving bodies, to within the tolerance.
///
/// Arguments and exceptions are those of `first_contact`, without a margin. `UnresolvedError` has `lower` and `upper`.
///
/// With a `clearance`, the query ends as soon as it is proven that the clearance is kept or violated. The answer tells
/// which. Its bounds are then only as narrow as this decision requires.
///
/// Bounds hold for the shapes: the upper bound includes the `excess` of the bodies over their shapes. A clearance is
/// violated only if the shapes certainly come nearer.
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
    #[pyo3(from_py_with = read_optional_number)] duration: Option<f64>,
    settings: Option<&Bound<'_, PyDict>>,
) -> PyResult<Bound<'py, PyAny>> {
    let settings = read(settings, &names(Question::ClosestApproach, &[]))?;
    let bodies = [(a, motion_a), (b, motion_b)];
    let answer = ask(py, Question::ClosestApproach, bodies, duration, &settings)?;
    distance_of_answer(py, &answer, &settings)
}

/// Computes bounds of the distance of two static bodies. Poses take the same forms as in `Motion.between`; None is the
/// identity.
///
/// >>> from rigid_ccd import Body, distance
/// >>> ball = Body.sphere(0.5)
/// >>> round(distance(ball, ball, ([3, 0, 0], [0, 0, 0, 1])).upper, 3)
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
    let pose = |pose: Option<&Bound<'_, PyAny>>, argument_name| match pose {
        Some(pose) => read_pose(pose, argument_name),
        None => Ok(rigid_ccd::Pose::IDENTITY),
    };
    let (pose_a, pose_b) = (pose(pose_a, "pose_a")?, pose(pose_b, "pose_b")?);
    let settings = read(settings, &names(Question::Distance, &["clearance"]))?;
    warn_of_large_tolerance([a, b], settings.tolerance, 1)?;
    let (a, b) = (extract_body(a, "a")?, extract_body(b, "b")?);
    let pair_question = PairQuestion {
        question: Question::Distance,
        bodies: [(a, pose_a).into(), (b, pose_b).into()],
        duration: 0.0,
    };
    distance_of_answer(py, &pair_question.run(py, &settings)?, &settings)
}
