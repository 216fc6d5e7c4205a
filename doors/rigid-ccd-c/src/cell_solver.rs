//! Solvers for paths of a robot in a cell.

use crate::arguments::{exclusive, free, give, reference};
use crate::cell::{RccdCell, joint_count};
use crate::growing;
use crate::path::{PathMemory, RccdPath};
use crate::path_answer::RccdPathAnswer;
use crate::settings::RccdSettings;
use crate::solver::read_settings;
use crate::status::{Failure, RccdStatus, status_of};
use rigid_ccd::Question;
use rigid_ccd_robot::{Cell, CellSolver, Path};
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};

/// A solver for paths in a cell. It reuses memory between questions. Each thread needs a solver of its own. After a change
/// of the cell, all questions to the solver fail.
pub struct RccdCellSolver {
    /// Borrows `cell`. As the first field it is dropped before `cell`.
    solver: CellSolver<'static>,
    cell: Arc<Cell>,
    /// The number of changes of the cell so far.
    changes: Arc<AtomicU64>,
    /// The number of changes when the solver was made.
    changes_before: u64,
    path: PathMemory,
}

/// Makes a solver for a cell. If `settings` is null, it uses the defaults. The margin is the distance at which bodies
/// count as touching. The deadline is for a whole question. A cell without a pair to check is an error: links that are
/// connected by a joint are not checked, unless `rccd_cell_set_clearance` is called for them. `contact_normals` has no effect.
///
/// With the start policy `RCCD_START_POLICY_LEAVE`, pairs in contact at the start may separate or slide, but not come
/// nearer. This applies to questions about the first or any contact. `rccd_cell_closest_approach` fails with this policy.
///
/// # Safety
/// `cell` is null or a handle; `settings` is null or points to settings, whose flag is null or a handle; `out` is null
/// or points to memory for a handle.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn rccd_cell_solver_new(
    cell: *const RccdCell,
    settings: *const RccdSettings,
    out: *mut *mut RccdCellSolver,
) -> RccdStatus {
    status_of(|| {
        // SAFETY: the contract of this function.
        let RccdCell { cell, changes, .. } = unsafe { reference("cell", cell) }?;
        let (cell, changes) = (Arc::clone(cell), Arc::clone(changes));
        // SAFETY: the contract of this function.
        let settings = unsafe { read_settings(settings) }?;
        cell.check_any_compared().map_err(Failure::input)?;
        // SAFETY: the cell does not move while this struct holds it, and a shared cell never changes. The solver is the
        // first field, so it is dropped before the cell.
        let borrowed: &'static Cell = unsafe { &*Arc::as_ptr(&cell) };
        let mut solver = borrowed.solver().with_settings(settings);
        solver.prepare();
        let solver = RccdCellSolver {
            solver,
            cell,
            changes_before: changes.load(Ordering::Acquire),
            changes,
            path: PathMemory::default(),
        };
        // SAFETY: the contract of this function.
        unsafe { give(out, solver) }
    })
}

/// Changes the settings of later questions. If `settings` is null, sets the defaults.
///
/// # Safety
/// `solver` is null or a handle that no other call uses; `settings` is null or points to settings, whose flag is null or a handle.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn rccd_cell_solver_set_settings(
    solver: *mut RccdCellSolver,
    settings: *const RccdSettings,
) -> RccdStatus {
    status_of(|| {
        // SAFETY: the contract of this function.
        let settings = unsafe { read_settings(settings) }?;
        // SAFETY: the contract of this function.
        unsafe { exclusive("solver", solver) }?
            .solver
            .set_settings(settings);
        Ok(())
    })
}

/// Frees a solver. Does nothing for null.
///
/// # Safety
/// The handle is null, or comes from this library, is not in use, and has not been freed.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn rccd_cell_solver_free(solver: *mut RccdCellSolver) {
    // SAFETY: the contract of this function.
    unsafe { free(solver) }
}

/// Finds the first contact on a path. Nothing touches before it. If a limit is reached, nothing touches before the
/// segment and fraction in the answer.
///
/// # Safety
/// `solver` is null or a handle that no other call uses; `path` is null or points to a path, whose configurations are null or
/// point to as many numbers as the robot has independent joints for each configuration, and whose curve is null or a handle; `answer`
/// is null or points to an answer whose `size` is set.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn rccd_cell_first_contact(
    solver: *mut RccdCellSolver,
    path: *const RccdPath,
    answer: *mut RccdPathAnswer,
) -> RccdStatus {
    // SAFETY: the contract of this function.
    unsafe { ask(Question::FirstContact, solver, path, answer) }
}

/// Finds some contact on a path, not necessarily the first one, or proves that there is none. Planners ask this about
/// edges. If a limit is reached, nothing is known about the path.
///
/// # Safety
/// As for `rccd_cell_first_contact`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn rccd_cell_any_contact(
    solver: *mut RccdCellSolver,
    path: *const RccdPath,
    answer: *mut RccdPathAnswer,
) -> RccdStatus {
    // SAFETY: the contract of this function.
    unsafe { ask(Question::AnyContact, solver, path, answer) }
}

/// Computes bounds of the least distance of all checked pairs on a path, to within the tolerance. The margin, paddings and
/// clearances have no effect.
///
/// # Safety
/// As for `rccd_cell_first_contact`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn rccd_cell_closest_approach(
    solver: *mut RccdCellSolver,
    path: *const RccdPath,
    answer: *mut RccdPathAnswer,
) -> RccdStatus {
    // SAFETY: the contract of this function.
    unsafe { ask(Question::ClosestApproach, solver, path, answer) }
}

/// Answers a question about a path, and stores the answer.
///
/// # Safety
/// As for [`rccd_cell_first_contact`].
unsafe fn ask(
    question: Question,
    solver: *mut RccdCellSolver,
    path: *const RccdPath,
    out: *mut RccdPathAnswer,
) -> RccdStatus {
    status_of(|| {
        // SAFETY: the contract of this function.
        let RccdCellSolver {
            solver,
            cell,
            changes,
            changes_before,
            path: memory,
        } = unsafe { exclusive("solver", solver) }?;
        if changes.load(Ordering::Acquire) != *changes_before {
            return Err(Failure::input(
                "the cell was changed after the solver was made: make a new solver",
            ));
        }
        // SAFETY: the contract of this function.
        let size = unsafe { growing::caller_size("the answer", out) }?;
        let call = |path: &dyn Path| {
            let answer = solver.answer(question, path).map_err(Failure::input)?;
            Ok(RccdPathAnswer::new(question, &answer))
        };
        // SAFETY: the contract of this function.
        let answer = unsafe { memory.with_path(path, joint_count(cell), call) }?;
        // SAFETY: the contract of this function.
        unsafe { growing::store(out, size, &answer) };
        Ok(())
    })
}
