//! A cell with a solver that keeps its memory from one question to the next.

use rigid_ccd::{ParallelSolver, Settings};
use rigid_ccd_robot::{Cell, CellSolver};
use std::num::NonZeroUsize;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

self_cell::self_cell!(
    /// A cell, and a solver that borrows it.
    struct CellAndSolver {
        owner: Arc<Cell>,
        #[not_covariant]
        dependent: CellSolver,
    }
);

/// A cell that may change between questions, and a solver for it. Changes do not wait for a question.
pub(crate) struct CellWithCachedSolver {
    cell: Mutex<Arc<Cell>>,
    /// The solver of the last question.
    solver: Mutex<Option<CellAndSolver>>,
}

impl CellWithCachedSolver {
    pub(crate) fn new(cell: Cell) -> Self {
        CellWithCachedSolver {
            cell: Mutex::new(Arc::new(cell)),
            solver: Mutex::new(None),
        }
    }

    /// Returns the cell as it is now.
    pub(crate) fn cell(&self) -> Arc<Cell> {
        Arc::clone(&lock(&self.cell))
    }

    /// Changes the cell for the questions that follow.
    pub(crate) fn change<T>(&self, change: impl FnOnce(&mut Cell) -> T) -> T {
        change(Arc::make_mut(&mut lock(&self.cell)))
    }

    /// Asks the solver a question about the cell as it is now.
    pub(crate) fn ask<T>(
        &self,
        settings: Settings,
        question: impl FnOnce(&mut CellSolver<'_>) -> T,
    ) -> T {
        let cell = self.cell();
        let mut kept = lock(&self.solver);
        let is_current = |kept: &CellAndSolver| Arc::ptr_eq(kept.borrow_owner(), &cell);
        let mut solver = match kept.take().filter(is_current) {
            Some(solver) => solver,
            None => CellAndSolver::new(cell, |cell| cell.solver()),
        };
        let answer = solver.with_dependent_mut(|_, solver| {
            solver.set_settings(settings);
            question(solver)
        });
        *kept = Some(solver);
        answer
    }
}

/// Locks a value. After a panic a cell is as it was, and there is no solver.
fn lock<T>(value: &Mutex<T>) -> MutexGuard<'_, T> {
    value.lock().unwrap_or_else(PoisonError::into_inner)
}

/// The number of paths that a thread answers at a time.
const PATHS_PER_TASK: usize = 32;

/// Answers a question about many paths, on `threads` threads, or on all cores.
///
/// `positions` has the paths one after another, each of `length` configurations of `joints` positions.
pub(crate) fn answer_paths<T: Send>(
    cell: &Cell,
    settings: &Settings,
    threads: Option<u16>,
    paths: Paths<'_>,
    question: impl Fn(&mut CellSolver<'_>, &[&[f64]]) -> T + Sync,
) -> Vec<T> {
    let solver = || cell.solver().with_settings(settings.clone());
    let tasks: Vec<&[f64]> = paths.position_chunks().collect();
    let count = threads.and_then(|threads| NonZeroUsize::new(usize::from(threads)));
    let mut solvers = match count {
        Some(count) => ParallelSolver::with_threads(count, solver),
        None => ParallelSolver::new(solver),
    };
    let answers = solvers.map(&tasks, |solver, task| {
        let mut path = Vec::with_capacity(paths.configuration_count);
        let mut answers = Vec::with_capacity(PATHS_PER_TASK);
        for positions in task.chunks_exact(paths.configuration_count * paths.joint_count) {
            path.clear();
            path.extend(positions.chunks_exact(paths.joint_count));
            answers.push(question(solver, &path));
        }
        answers
    });
    answers.into_iter().flatten().collect()
}

/// Paths of equally many configurations, one after another.
#[derive(Clone, Copy)]
pub(crate) struct Paths<'a> {
    pub(crate) positions: &'a [f64],
    /// The number of configurations of a path, at least 1.
    pub(crate) configuration_count: usize,
    /// The number of positions of a configuration, at least 1.
    pub(crate) joint_count: usize,
}

impl<'a> Paths<'a> {
    fn position_chunks(&self) -> impl Iterator<Item = &'a [f64]> {
        self.positions
            .chunks(PATHS_PER_TASK * self.configuration_count * self.joint_count)
    }
}
