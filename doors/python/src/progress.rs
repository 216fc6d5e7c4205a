//! Runs long work that Ctrl-C can interrupt, and reports its progress to Python.

use crate::errors::interruption_error;
use crate::interruptible::run_interruptibly;
use pyo3::prelude::*;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};

/// The argument `progress` of a call, and the total amount of work, if known.
#[derive(Clone, Copy)]
pub(crate) struct GivenProgress<'a, 'py> {
    pub(crate) progress: Option<&'a Bound<'py, PyAny>>,
    pub(crate) total: Option<usize>,
}

/// Runs `work` as [`run_interruptibly`] does. `work` increases a counter; this function reports the counter meanwhile
/// and at the end.
pub(crate) fn run_with_progress<T: Send>(
    py: Python<'_>,
    GivenProgress { progress, total }: GivenProgress<'_, '_>,
    work: impl FnOnce(&Arc<AtomicBool>, &AtomicUsize) -> T + Send,
) -> PyResult<(T, PyResult<()>)> {
    let done = AtomicUsize::new(0);
    let Some(progress) = progress else {
        return run_interruptibly(py, |stop| work(stop, &done), |_| Ok(()));
    };
    let make = py.import("rigid_ccd._progress")?.getattr("reporter")?;
    let (report, close): (Option<Py<PyAny>>, Py<PyAny>) = make.call1((progress,))?.extract()?;
    let mut reported = None;
    let mut report_progress = |py: Python<'_>| {
        let now = done.load(Ordering::Relaxed);
        match &report {
            Some(report) if reported.replace(now) != Some(now) => {
                report.call1(py, (now, total)).map(drop)
            }
            _ => Ok(()),
        }
    };
    let found = run_interruptibly(py, |stop| work(stop, &done), &mut report_progress);
    let found =
        found.map(|(found, interruption)| (found, interruption.and_then(|()| report_progress(py))));
    close.call0(py)?;
    found
}

/// Returns the results of work. If it was interrupted, returns an exception with the results so far.
pub(crate) fn results_or_interruption<'py, T: IntoPyObject<'py>>(
    py: Python<'py>,
    results: T,
    interruption: PyResult<()>,
) -> PyResult<T> {
    match interruption {
        Ok(()) => Ok(results),
        Err(cause) => Err(interruption_error(py, cause, results)),
    }
}
