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

/// The largest size of a mesh for which work takes at most some hundredths of a second, in bytes.
const MAX_BYTES_ON_THIS_THREAD: u64 = 1 << 18;

/// Runs `work` on a new thread, without the GIL, and returns its result. For work that cannot be stopped.
///
/// Meanwhile this thread checks for signals. If a signal raises an exception, returns it at once; the work continues to
/// its end, and its result is dropped. If no thread can be started, or the work panics, returns an exception too.
///
/// If the input has few `bytes`, the work runs on this thread, because starting another one would take longer.
pub(crate) fn run_or_leave<T: Send + 'static>(
    py: Python<'_>,
    bytes: u64,
    work: impl FnOnce() -> T + Send + 'static,
) -> PyResult<T> {
    if bytes < MAX_BYTES_ON_THIS_THREAD {
        return Ok(py.detach(work));
    }
    py.detach(|| {
        let (sender, receiver) = mpsc::channel();
        // If the caller has returned, the receiver is gone, and sending fails.
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
/// Meanwhile this thread checks for signals, and calls `poll`. If either raises an exception, sets the flag that ends the
/// work soon, and returns the exception with the result. If no thread can be started, or the work panics, returns only an
/// exception.
pub(crate) fn run_interruptibly<T: Send>(
    py: Python<'_>,
    work: impl FnOnce(&Arc<AtomicBool>) -> T + Send,
    mut poll: impl FnMut(Python<'_>) -> PyResult<()> + Send,
) -> PyResult<(T, PyResult<()>)> {
    let stop = Arc::new(AtomicBool::new(false));
    py.detach(|| {
        thread::scope(|scope| {
            let (sender, receiver) = mpsc::channel::<()>();
            let worker = Builder::new().spawn_scoped(scope, {
                let stop = &stop;
                move || {
                    // Dropped when the work ends, even by a panic.
                    let _dropped_at_end = sender;
                    work(stop)
                }
            });
            let worker = worker.map_err(no_thread_error)?;
            let mut interruption = Ok(());
            while let Err(RecvTimeoutError::Timeout) = receiver.recv_timeout(POLL_INTERVAL) {
                if interruption.is_ok() {
                    interruption = Python::attach(|py| py.check_signals().and_then(|()| poll(py)));
                    stop.store(interruption.is_err(), Ordering::Relaxed);
                }
            }
            let result = worker.join().map_err(|panic| panic_error(panic.as_ref()))?;
            Ok((result, interruption))
        })
    })
}
