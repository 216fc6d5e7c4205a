//! Solvers, and the questions about two moving bodies.

use crate::answer::RccdAnswer;
use crate::arguments::{exclusive, free, give, reference};
use crate::body::RccdBody;
use crate::growing;
use crate::motion::RccdMotion;
use crate::settings::RccdSettings;
use crate::status::{Failure, RccdStatus, status_of};
use crate::trajectory::RccdTrajectory;
use ccd_core::MovingBody;
use rigid_ccd::{Answer, InputError, Motion, Question, Settings, Solver};

/// A solver: settings, and memory that it reuses from query to query. Each thread needs its own.
pub struct RccdSolver {
    solver: Solver,
    settings: Settings,
}

/// A body and what moves it: a motion or a trajectory. With neither the body rests at the origin.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct RccdMovingBody {
    /// The body.
    pub body: *const RccdBody,
    /// Its motion, or null.
    pub motion: *const RccdMotion,
    /// Its trajectory, or null.
    pub trajectory: *const RccdTrajectory,
}

/// Makes a solver with these settings; null stands for the default ones.
///
/// # Safety
/// `settings` is null or points to settings, whose flag is null or a handle; `out` is null or points to a place for a handle.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn rccd_solver_new(
    settings: *const RccdSettings,
    out: *mut *mut RccdSolver,
) -> RccdStatus {
    status_of(|| {
        // SAFETY: the contract of this function.
        let settings = unsafe { read_settings(settings) }?;
        let solver = RccdSolver {
            solver: Solver::new().with_settings(settings.clone()),
            settings,
        };
        // SAFETY: the contract of this function.
        unsafe { give(out, solver) }
    })
}

/// Changes the settings of the queries that follow; null stands for the default ones.
///
/// # Safety
/// `solver` is null or a handle that no other call uses; `settings` is null or points to settings, whose flag is null or a handle.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn rccd_solver_set_settings(
    solver: *mut RccdSolver,
    settings: *const RccdSettings,
) -> RccdStatus {
    status_of(|| {
        // SAFETY: the contract of this function.
        let solver = unsafe { exclusive("solver", solver) }?;
        // SAFETY: the contract of this function.
        solver.settings = unsafe { read_settings(settings) }?;
        solver.solver.set_settings(solver.settings.clone());
        Ok(())
    })
}

/// Frees a solver; null is nothing.
///
/// # Safety
/// The handle is null, or comes from this library, is not in use, and has not been freed.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn rccd_solver_free(solver: *mut RccdSolver) {
    // SAFETY: the contract of this function.
    unsafe { free(solver) }
}

/// Finds the first contact of two moving bodies, from time 0 to `duration`. Nothing touches before it.
///
/// # Safety
/// `solver` is null or a handle that no other call uses; `a` and `b` are null or point to moving bodies whose pointers are
/// null or point to values of their types; `answer` is null or points to an answer whose `size` is set.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn rccd_first_contact(
    solver: *mut RccdSolver,
    a: *const RccdMovingBody,
    b: *const RccdMovingBody,
    duration: f64,
    answer: *mut RccdAnswer,
) -> RccdStatus {
    // SAFETY: the contract of this function.
    unsafe { ask(Question::FirstContact, solver, [a, b], duration, answer) }
}

/// Finds some contact of two moving bodies, perhaps not the first one, or proves that there is none. For bodies that touch
/// it costs less than the first contact.
///
/// # Safety
/// That of `rccd_first_contact`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn rccd_any_contact(
    solver: *mut RccdSolver,
    a: *const RccdMovingBody,
    b: *const RccdMovingBody,
    duration: f64,
    answer: *mut RccdAnswer,
) -> RccdStatus {
    // SAFETY: the contract of this function.
    unsafe { ask(Question::AnyContact, solver, [a, b], duration, answer) }
}

/// Finds when two moving bodies first and last touch. They do not touch before the first time nor after the last.
///
/// # Safety
/// That of `rccd_first_contact`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn rccd_contact_interval(
    solver: *mut RccdSolver,
    a: *const RccdMovingBody,
    b: *const RccdMovingBody,
    duration: f64,
    answer: *mut RccdAnswer,
) -> RccdStatus {
    // SAFETY: the contract of this function.
    unsafe { ask(Question::ContactInterval, solver, [a, b], duration, answer) }
}

/// Brackets the least distance of two moving bodies to within the tolerance. With a duration of 0 it is the distance at the
/// start.
///
/// # Safety
/// That of `rccd_first_contact`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn rccd_closest_approach(
    solver: *mut RccdSolver,
    a: *const RccdMovingBody,
    b: *const RccdMovingBody,
    duration: f64,
    answer: *mut RccdAnswer,
) -> RccdStatus {
    // SAFETY: the contract of this function.
    unsafe { ask(Question::ClosestApproach, solver, [a, b], duration, answer) }
}

/// Decides whether two moving bodies keep a distance: the outcome is free if they do, and a contact, at a time at which they are
/// nearer, if they do not. If the bounds of the distance are too far apart to decide, it is the least distance. Bodies that may
/// touch keep no distance, not even 0.
///
/// # Safety
/// That of `rccd_first_contact`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn rccd_keeps_clearance(
    solver: *mut RccdSolver,
    a: *const RccdMovingBody,
    b: *const RccdMovingBody,
    duration: f64,
    clearance: f64,
    answer: *mut RccdAnswer,
) -> RccdStatus {
    let question = |s: &mut RccdSolver, a: MovingBody<'_>, b: MovingBody<'_>| {
        s.solver.set_settings(Settings {
            clearance: Some(clearance),
            ..s.settings.clone()
        });
        let found = s.solver.closest_approach(a, b, duration);
        s.solver.set_settings(s.settings.clone());
        found
    };
    let to_answer = |found: &Answer| RccdAnswer::about_clearance(found, duration, clearance);
    // SAFETY: the contract of this function.
    unsafe { ask_with(solver, [a, b], answer, to_answer, question) }
}

/// Asks a question, and stores the answer.
///
/// # Safety
/// That of [`rccd_first_contact`].
unsafe fn ask(
    question: Question,
    solver: *mut RccdSolver,
    bodies: [*const RccdMovingBody; 2],
    duration: f64,
    out: *mut RccdAnswer,
) -> RccdStatus {
    let to_answer = |found: &Answer| RccdAnswer::new(found, duration);
    // SAFETY: the contract of this function.
    unsafe {
        ask_with(solver, bodies, out, to_answer, |s, a, b| {
            s.solver.answer(question, a, b, duration)
        })
    }
}

/// Asks a question by a function, and stores what another one makes of its answer.
///
/// # Safety
/// That of [`rccd_first_contact`].
unsafe fn ask_with(
    solver: *mut RccdSolver,
    bodies: [*const RccdMovingBody; 2],
    out: *mut RccdAnswer,
    to_answer: impl FnOnce(&Answer) -> RccdAnswer,
    question: impl FnOnce(&mut RccdSolver, MovingBody<'_>, MovingBody<'_>) -> Result<Answer, InputError>,
) -> RccdStatus {
    status_of(|| {
        // SAFETY: the contract of this function.
        let solver = unsafe { exclusive("solver", solver) }?;
        // SAFETY: the contract of this function.
        let [a, b] = unsafe { [moving_body("a", bodies[0])?, moving_body("b", bodies[1])?] };
        // SAFETY: the contract of this function.
        let size = unsafe { growing::size_of_place("the answer", out) }?;
        let found = question(solver, a, b);
        // By reference: an answer is large, and a short question takes little longer than a few copies of it.
        let answer = to_answer(found.as_ref().map_err(Failure::input)?);
        // SAFETY: the contract of this function.
        unsafe { growing::store(out, size, &answer) };
        Ok(())
    })
}

/// Reads a moving body; `name` is for errors.
///
/// # Safety
/// The pointer is null, or points to a moving body whose pointers are null or point to values of their types.
unsafe fn moving_body<'a>(
    name: &str,
    moving: *const RccdMovingBody,
) -> Result<MovingBody<'a>, Failure> {
    // SAFETY: the contract of this function.
    let moving = unsafe { reference(name, moving) }?;
    // SAFETY: the contract of this function.
    let body = &*unsafe { reference("the body", moving.body) }?.0;
    match (moving.motion.is_null(), moving.trajectory.is_null()) {
        (true, true) => Ok((body, Motion::STILL).into()),
        (false, true) => {
            // SAFETY: the contract of this function.
            let motion = unsafe { reference("the motion", moving.motion) }?;
            Ok((body, motion.to_motion().map_err(Failure::input)?).into())
        }
        (true, false) => {
            // SAFETY: the contract of this function.
            let trajectory = unsafe { reference("the trajectory", moving.trajectory) }?;
            Ok((body, trajectory.as_dyn()).into())
        }
        (false, false) => {
            let text = format!("{name} has both a motion and a trajectory");
            Err(Failure::argument(text))
        }
    }
}

/// Reads settings; null stands for the default ones.
///
/// # Safety
/// `settings` is null or points to settings, whose flag is null or a handle.
pub(crate) unsafe fn read_settings(settings: *const RccdSettings) -> Result<Settings, Failure> {
    if settings.is_null() {
        return Ok(Settings::DEFAULT);
    }
    // SAFETY: the contract of this function.
    unsafe { growing::read("settings", settings, RccdSettings::default())?.to_settings() }
}
