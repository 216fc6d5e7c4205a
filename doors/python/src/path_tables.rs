//! Answers a question about each of many paths, as a table.

use crate::cell_remarks::{AskedPaths, warn_of_question};
use crate::cell_solver::CellWithCachedSolvers;
use crate::errors::input_error;
use crate::path_answers::question_named;
use crate::path_array::GivenPaths;
use crate::progress::{GivenProgress, results_or_interruption, run_with_progress};
use crate::settings::{names, read, read_thread_count};
use crate::table::{PyTable, path_result_batch};
use ccd_tables::path_rows::PathQuestion;
use ccd_tables::results::ResultRow;
use pyo3::prelude::*;
use pyo3::types::PyDict;
use rigid_ccd::Settings;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};

/// The arguments of a question about many paths, except for the paths.
pub(crate) struct GivenQuestion<'a, 'py> {
    pub(crate) question: &'a str,
    pub(crate) threads: Option<&'a Bound<'py, PyAny>>,
    pub(crate) progress: Option<&'a Bound<'py, PyAny>>,
    pub(crate) settings: Option<&'a Bound<'py, PyDict>>,
}

/// Answers a question about each path on all cores. Ctrl-C ends it with the rows answered so far.
pub(crate) fn answer_paths(
    py: Python<'_>,
    solvers: &CellWithCachedSolvers,
    arguments: GivenQuestion<'_, '_>,
    read_paths: impl FnOnce() -> PyResult<GivenPaths>,
) -> PyResult<PyTable> {
    let question = question_named(arguments.question)?;
    let mut settings = read(arguments.settings, &names(question, &[]))?;
    settings.check().map_err(input_error)?;
    let path_question = PathQuestion {
        question,
        clearance: settings.clearance.take(),
    };
    let cell = solvers.cell();
    cell.check_any_compared().map_err(input_error)?;
    let threads = read_thread_count(arguments.threads)?;
    let paths = read_paths()?;
    warn_of_question(py, &cell, &AskedPaths::Paths(&paths), settings.tolerance)?;
    let progress = GivenProgress {
        progress: arguments.progress,
        total: Some(paths.count()),
    };
    let work = |stop: &Arc<AtomicBool>, done: &AtomicUsize| {
        let settings = settings.stopped_by(stop);
        let task = Task {
            question: path_question,
            settings: &settings,
            stop,
            done,
        };
        task.answer(solvers, threads, &paths)
    };
    let (rows, interruption) = run_with_progress(py, progress, work)?;
    let batch = py.detach(|| path_result_batch(question, &rows));
    let batch = batch.map_err(input_error)?;
    results_or_interruption(py, PyTable { batch }, interruption)
}

/// A question about many paths, which a flag can stop.
struct Task<'a> {
    question: PathQuestion,
    settings: &'a Settings,
    stop: &'a AtomicBool,
    /// The number of paths answered so far.
    done: &'a AtomicUsize,
}

impl Task<'_> {
    /// Answers all paths, and returns the row of each. If the flag `stop` is set meanwhile, returns the first rows only.
    fn answer(
        &self,
        solvers: &CellWithCachedSolvers,
        threads: Option<u16>,
        paths: &GivenPaths,
    ) -> Vec<ResultRow> {
        let groups = match paths {
            GivenPaths::Array(array) => {
                let paths = array.paths();
                let chunks = paths.position_chunks();
                solvers.answer_tasks(self.settings, threads, &chunks, |solver, chunk| {
                    let answer = |path: &[&[f64]]| {
                        self.unless_stopped(|| self.question.answer(solver, path).row)
                    };
                    paths.map_group(chunk, answer)
                })
            }
            GivenPaths::Curves(curves) => {
                solvers.answer_tasks(self.settings, threads, curves, |solver, curve| {
                    let answer = || self.question.answer(solver, curve).row;
                    vec![self.unless_stopped(answer)]
                })
            }
        };
        groups.into_iter().flatten().map_while(|row| row).collect()
    }

    /// Calls `answer`, and returns its row. Returns `None` if the flag `stop` is set when it ends, because the question may have
    /// been stopped.
    fn unless_stopped(&self, answer: impl FnOnce() -> ResultRow) -> Option<ResultRow> {
        let is_stopped = || self.stop.load(Ordering::Relaxed);
        let row = (!is_stopped()).then(answer).filter(|_| !is_stopped())?;
        self.done.fetch_add(1, Ordering::Relaxed);
        Some(row)
    }
}
