//! Runs long work without the GIL, so that Ctrl-C can interrupt it.

use crate::errors::panic_error;
use pyo3::exceptions::PyRuntimeError;
use pyo3::prelude::*;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{self, RecvTimeoutError};
use std::thread::{self, Builder};
use std::time::Duration;

/// The interval between two checks for signals such as Ctrl-C.
const POLL_INTERVAL: Duration = Duration::from_millis(20);

/// The number of bytes of a mesh up to which work on it takes some hundredths of a second.
const FEW_BYTES: u64 = 1 << 18;

/// Runs `work` that has no flag to stop it on a new thread, without the GIL, and returns its result.
///
/// Meanwhile this thread looks for signals. An exception of one comes back at once: the work goes on to its end, and its result is
/// dropped. Without a thread to spare, or after a panic, there is an exception, too.
///
/// Work on a few `bytes` is done on this thread: to start another one would cost more.
pub(crate) fn run_or_leave<T: Send + 'static>(
    py: Python<'_>,
    bytes: u64,
    work: impl FnOnce() -> T + Send + 'static,
) -> PyResult<T> {
    if bytes < FEW_BYTES {
        return Ok(py.detach(work));
    }
    py.detach(|| {
        let (sender, receiver) = mpsc::channel();
        // The receiver of a thread that is left is gone.
        let worker = Builder::new().spawn(move || drop(sender.send(work())));
        let worker = worker.map_err(no_thread_error)?;
        loop {
            match receiver.recv_timeout(POLL_INTERVAL) {
                Ok(result) => return Ok(result),
                Err(RecvTimeoutError::Timeout) => Python::attach(|py| py.check_signals())?,
                Err(RecvTimeoutError::Disconnected) => break,
            }
        }
        let panic = worker.join().err();
        Err(panic.map_or_else(
            || PyRuntimeError::new_err("the work has no result"),
            |panic| panic_error(panic.as_ref()),
        ))
    })
}

fn no_thread_error(error: std::io::Error) -> PyErr {
    PyRuntimeError::new_err(format!("no thread can be started: {error}"))
}

/// Runs `work` on a new thread, without the GIL, and returns its result.
///
/// Meanwhile this thread looks for signals, and calls `look`. An exception of either sets the flag, which ends the work
/// soon; it comes back beside the result. Without a thread to spare, or after a panic, there is an exception alone.
pub(crate) fn run_interruptibly<T: Send>(
    py: Python<'_>,
    work: impl FnOnce(&Arc<AtomicBool>) -> T + Send,
    mut look: impl FnMut(Python<'_>) -> PyResult<()> + Send,
) -> PyResult<(T, PyResult<()>)> {
    let stop = Arc::new(AtomicBool::new(false));
    py.detach(|| {
        thread::scope(|scope| {
            let (sender, receiver) = mpsc::channel::<()>();
            let worker = Builder::new().spawn_scoped(scope, {
                let stop = &stop;
                move || {
                    // Dropped at the end of the work, even by a panic.
                    let _ends = sender;
                    work(stop)
                }
            });
            let worker = worker.map_err(no_thread_error)?;
            let mut seen = Ok(());
            while let Err(RecvTimeoutError::Timeout) = receiver.recv_timeout(POLL_INTERVAL) {
                if seen.is_ok() {
                    seen = Python::attach(|py| py.check_signals().and_then(|()| look(py)));
                    stop.store(seen.is_err(), Ordering::Relaxed);
                }
            }
            let result = worker.join().map_err(|panic| panic_error(panic.as_ref()))?;
            Ok((result, seen))
        })
    })
}
