//! Standard output, which fails if it was closed when the program started.

use std::io::{self, StdoutLock};

/// Returns standard output.
///
/// # Errors
/// It was closed when the program started. Rust's runtime then opens the null device in its place, where a table would be lost.
pub(crate) fn lock() -> io::Result<StdoutLock<'static>> {
    if start::was_closed() {
        return Err(io::Error::other("it is closed"));
    }
    Ok(io::stdout().lock())
}

#[cfg(unix)]
mod start {
    use std::sync::atomic::{AtomicBool, Ordering};

    static WAS_CLOSED: AtomicBool = AtomicBool::new(false);

    ctor::declarative::ctor! {
        /// Runs before Rust's runtime opens anything.
        #[ctor(unsafe)]
        fn record_whether_closed() {
            let is_closed = rustix::io::fcntl_getfd(rustix::stdio::stdout()).is_err();
            WAS_CLOSED.store(is_closed, Ordering::Relaxed);
        }
    }

    pub(crate) fn was_closed() -> bool {
        WAS_CLOSED.load(Ordering::Relaxed)
    }
}

#[cfg(not(unix))]
mod start {
    pub(crate) fn was_closed() -> bool {
        false
    }
}
