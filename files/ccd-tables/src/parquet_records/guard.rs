//! Turns panics of the Parquet library into errors.
//!
//! The library answers most damage with errors. Some of its decoders panic instead.

use parquet::errors::ParquetError;
use std::cell::Cell;
use std::panic::{self, AssertUnwindSafe};
use std::sync::Once;

thread_local! {
    /// Whether a panic on this thread becomes an error, so that nothing is to be printed about it.
    static IS_GUARDED: Cell<bool> = const { Cell::new(false) };
}

/// Calls the Parquet library, and returns an error if it panics. After a panic, the objects that `call` uses must not
/// be used again.
pub(super) fn guarded<T>(
    call: impl FnOnce() -> Result<T, ParquetError>,
) -> Result<T, ParquetError> {
    silence_guarded_panics();
    IS_GUARDED.set(true);
    let result = panic::catch_unwind(AssertUnwindSafe(call));
    IS_GUARDED.set(false);
    result.unwrap_or_else(|_| Err(ParquetError::General("damaged data".to_owned())))
}

/// Makes the process print nothing about guarded panics. Other panics are printed as before.
fn silence_guarded_panics() {
    static ONCE: Once = Once::new();
    ONCE.call_once(|| {
        let print = panic::take_hook();
        panic::set_hook(Box::new(move |panic| {
            if !IS_GUARDED.get() {
                print(panic);
            }
        }));
    });
}
