//! Solvers for questions about two moving bodies.

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

/// A solver: settings, and memory that is reused between queries. Each thread needs its own.
pub struct RccdSolver {
    solver: Solver,
    settings: Settings,
}

/// A body with a motion or a trajectory. With neither, the body is static at the origin.
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

/// Makes a solver. If `settings` is null, it uses the defaults.
///
/// # Safety
/// `settings` is null or points to settings, whose flag is null or a handle; `out` is null or points to memory for a
/// handle.
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

/// Changes the settings of later queries. If `settings` is null, sets the defaults.
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

/// Frees a solver. Does nothing for null.
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

/// Finds some contact of two moving bodies, not necessarily the first one, or proves that there is none. If the bodies
/// touch, this takes less work than the first contact.
///
/// # Safety
/// As for `rccd_first_contact`.
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

/// Finds the first and the last contact of two moving bodies. They do not touch before the first time or after the last.
///
/// # Safety
/// As for `rccd_first_contact`.
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

/// Computes bounds of the least distance of two moving bodies, to within the tolerance. With a duration of 0, it is the
/// distance at the start.
///
/// # Safety
/// As for `rccd_first_contact`.
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

/// Decides whether two moving bodies always keep a distance of at least `clearance`. If they do, the outcome is free. If
/// they do not, it is a contact, at a time at which they are nearer. If the bounds are too far apart to decide, it is
/// the least distance. Bodies that possibly touch do not keep a clearance of 0 either.
///
/// # Safety
/// As for `rccd_first_contact`.
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

/// Answers a question about two moving bodies, and stores the answer.
///
/// # Safety
/// As for [`rccd_first_contact`].
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

/// Answers by calling `question`, and stores the answer converted by `to_answer`.
///
/// # Safety
/// As for [`rccd_first_contact`].
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
        // Passes the answer by reference: it is large, and a few copies of it would take about as long as a short
        // query.
        let answer = to_answer(found.as_ref().map_err(Failure::input)?);
        // SAFETY: the contract of this function.
        unsafe { growing::store(out, size, &answer) };
        Ok(())
    })
}

/// Reads a moving body. Errors name it as `name`.
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

/// Reads settings. Null stands for the defaults.
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
