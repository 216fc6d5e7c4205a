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
use rigid_ccd::{Motion, Query, Question, Settings, Solver};

/// A solver: settings, and memory that is reused between queries. Each thread needs a solver of its own.
pub struct RccdSolver {
    solver: Solver,
    /// The settings of queries. `solver` does not use its own settings.
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
            solver: Solver::new(),
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
    unsafe {
        ask(
            Question::FirstContact,
            solver,
            [a, b],
            (duration, None),
            answer,
        )
    }
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
    unsafe {
        ask(
            Question::AnyContact,
            solver,
            [a, b],
            (duration, None),
            answer,
        )
    }
}

/// Finds the first and the last contact of two moving bodies. They do not touch before the first contact or after the last
/// one.
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
    unsafe {
        ask(
            Question::ContactInterval,
            solver,
            [a, b],
            (duration, None),
            answer,
        )
    }
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
    unsafe {
        ask(
            Question::ClosestApproach,
            solver,
            [a, b],
            (duration, None),
            answer,
        )
    }
}

/// Decides whether two moving bodies always keep a distance of at least `clearance`. If they do, the outcome is
/// `RCCD_OUTCOME_FREE`. If they do not, it is `RCCD_OUTCOME_CONTACT`, at a time at which they are nearer. If the bounds of
/// the distance do not decide, it is `RCCD_OUTCOME_LEAST_DISTANCE`. Bodies that possibly touch do not keep a clearance of
/// 0.
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
    let question = Question::ClosestApproach;
    let clearance = Some(clearance);
    // SAFETY: the contract of this function.
    unsafe { ask(question, solver, [a, b], (duration, clearance), answer) }
}

/// Answers a question about two moving bodies, and stores the answer. With a clearance, the answer is whether they keep it.
///
/// # Safety
/// As for [`rccd_first_contact`].
unsafe fn ask(
    question: Question,
    solver: *mut RccdSolver,
    bodies: [*const RccdMovingBody; 2],
    (duration, clearance): (f64, Option<f64>),
    out: *mut RccdAnswer,
) -> RccdStatus {
    status_of(|| {
        // SAFETY: the contract of this function.
        let RccdSolver { solver, settings } = unsafe { exclusive("solver", solver) }?;
        // SAFETY: the contract of this function.
        let [a, b] = unsafe { [moving_body("a", bodies[0])?, moving_body("b", bodies[1])?] };
        // SAFETY: the contract of this function.
        let size = unsafe { growing::caller_size("the answer", out) }?;
        let with_clearance = clearance.map(|_| Settings {
            clearance,
            ..settings.clone()
        });
        let settings = with_clearance.as_ref().unwrap_or(settings);
        let query = Query::new(a, b, duration, settings).map_err(Failure::input)?;
        let answer = solver.answer_query(question, &query);
        // The answer is passed by reference: it is large, and a few copies of it would take about as long as a short
        // query.
        let answer = answer.as_ref().map_err(Failure::input)?;
        let answer = match clearance {
            Some(clearance) => RccdAnswer::about_clearance(answer, duration, clearance),
            None => RccdAnswer::new(answer, duration),
        };
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
    moving_body: *const RccdMovingBody,
) -> Result<MovingBody<'a>, Failure> {
    // SAFETY: the contract of this function.
    let RccdMovingBody {
        body,
        motion,
        trajectory,
    } = *unsafe { reference(name, moving_body) }?;
    // SAFETY: the contract of this function.
    let body = &*unsafe { reference("the body", body) }?.0;
    match (motion.is_null(), trajectory.is_null()) {
        (true, true) => Ok((body, Motion::STILL).into()),
        (false, true) => {
            // SAFETY: the contract of this function.
            let motion = unsafe { reference("the motion", motion) }?;
            Ok((body, motion.to_motion().map_err(Failure::input)?).into())
        }
        (true, false) => {
            // SAFETY: the contract of this function.
            let trajectory = unsafe { reference("the trajectory", trajectory) }?;
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
