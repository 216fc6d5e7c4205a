//! A cell with solvers that reuse memory between questions.

use rigid_ccd::{ParallelSolver, Settings};
use rigid_ccd_robot::{Cell, CellSolver};
use std::num::NonZeroUsize;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::thread::available_parallelism;

type CellSolvers<'c> = ParallelSolver<CellSolver<'c>>;

self_cell::self_cell!(
    /// A cell, and solvers that borrow it.
    struct CellAndSolvers {
        owner: Arc<Cell>,
        #[not_covariant]
        dependent: CellSolvers,
    }
);

/// A cell that may change between questions, and its solvers. A running question delays neither changes nor other
/// questions.
pub(crate) struct CellWithCachedSolvers {
    cell: Mutex<Arc<Cell>>,
    /// The solvers of the last question, or `None` while a question uses them.
    solvers: Mutex<Option<CellAndSolvers>>,
}

impl CellWithCachedSolvers {
    pub(crate) fn new(cell: Cell) -> Self {
        CellWithCachedSolvers {
            cell: Mutex::new(Arc::new(cell)),
            solvers: Mutex::new(None),
        }
    }

    /// Returns the present state of the cell.
    pub(crate) fn cell(&self) -> Arc<Cell> {
        Arc::clone(&lock(&self.cell))
    }

    /// Changes the cell for later questions.
    pub(crate) fn change<T>(&self, change: impl FnOnce(&mut Cell) -> T) -> T {
        change(Arc::make_mut(&mut lock(&self.cell)))
    }

    /// Answers a question about the present state of the cell.
    pub(crate) fn ask<T: Send>(
        &self,
        settings: &Settings,
        question: impl Fn(&mut CellSolver<'_>) -> T + Sync,
    ) -> T {
        let only_question = |solver: &mut CellSolver<'_>, (): &()| {
            solver.set_settings(settings.clone());
            question(solver)
        };
        let mut answers = self.with_solvers(None, |solvers| solvers.map(&[()], only_question));
        answers.remove(0)
    }

    /// Answers many tasks about the present state of the cell, on `threads` threads, or on all cores.
    pub(crate) fn answer_tasks<Q: Sync, T: Send>(
        &self,
        settings: &Settings,
        threads: Option<u16>,
        tasks: &[Q],
        answer: impl Fn(&mut CellSolver<'_>, &Q) -> T + Sync,
    ) -> Vec<T> {
        let threads = threads.and_then(|threads| NonZeroUsize::new(usize::from(threads)));
        let threads = threads
            .or_else(|| available_parallelism().ok())
            .unwrap_or(NonZeroUsize::MIN);
        self.with_solvers(Some(threads), |solvers| {
            solvers.map(tasks, |solver, task| {
                solver.set_settings(settings.clone());
                answer(solver, task)
            })
        })
    }

    /// Calls `work` with solvers for `threads` threads, or for any number of threads. Reuses the solvers of the last
    /// question if they are for the present state of the cell, and makes new ones otherwise.
    fn with_solvers<T>(
        &self,
        threads: Option<NonZeroUsize>,
        work: impl FnOnce(&mut CellSolvers<'_>) -> T,
    ) -> T {
        let cell = self.cell();
        let last = lock(&self.solvers).take();
        let is_usable = |kept: &CellAndSolvers| {
            Arc::ptr_eq(kept.borrow_owner(), &cell)
                && kept.with_dependent(|_, solvers| {
                    threads.is_none_or(|threads| solvers.threads() == threads.get())
                })
        };
        let mut solvers = last.filter(is_usable).unwrap_or_else(|| {
            CellAndSolvers::new(cell, |cell| {
                let threads = threads.unwrap_or(NonZeroUsize::MIN);
                ParallelSolver::with_threads(threads, || cell.solver())
            })
        });
        let answer = solvers.with_dependent_mut(|_, solvers| work(solvers));
        *lock(&self.solvers) = Some(solvers);
        answer
    }
}

/// Locks a value, even if a thread panicked while it held the lock: the value is still valid. A panic in a question
/// leaves no solvers, and a change does not panic.
fn lock<T>(value: &Mutex<T>) -> MutexGuard<'_, T> {
    value.lock().unwrap_or_else(PoisonError::into_inner)
}

/// The number of paths that a thread answers in one task.
const PATHS_PER_TASK: usize = 32;

/// Paths with equal numbers of configurations, one after another.
#[derive(Clone, Copy)]
pub(crate) struct Paths<'a> {
    pub(crate) positions: &'a [f64],
    /// The number of configurations of a path, at least 1.
    pub(crate) configuration_count: usize,
    /// The number of positions of a configuration, at least 1.
    pub(crate) joint_count: usize,
}

impl<'a> Paths<'a> {
    /// Returns the paths in groups, each the positions of several paths.
    pub(crate) fn position_chunks(&self) -> Vec<&'a [f64]> {
        let length = self.configuration_count * self.joint_count;
        self.positions.chunks(PATHS_PER_TASK * length).collect()
    }

    /// Calls `answer` with each path of a group, and returns its results.
    pub(crate) fn map_group<T>(
        &self,
        positions: &[f64],
        mut answer: impl FnMut(&[&[f64]]) -> T,
    ) -> Vec<T> {
        let mut path = Vec::with_capacity(self.configuration_count);
        let paths = positions.chunks_exact(self.configuration_count * self.joint_count);
        let answers = paths.map(|positions| {
            path.clear();
            path.extend(positions.chunks_exact(self.joint_count));
            answer(&path)
        });
        answers.collect()
    }
}
