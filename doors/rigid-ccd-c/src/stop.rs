//! Flags that let another thread stop a query.

use crate::arguments::{free, give, reference};
use crate::status::{RccdStatus, status_of};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

/// A flag that stops the queries of all solvers whose settings point to it. Any thread may set or clear it at any time.
pub struct RccdStop(pub(crate) Arc<AtomicBool>);

/// Makes a flag that is not set.
///
/// # Safety
/// `out` is null, or points to memory for a handle.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn rccd_stop_new(out: *mut *mut RccdStop) -> RccdStatus {
    // SAFETY: the contract of this function.
    status_of(|| unsafe { give(out, RccdStop(Arc::default())) })
}

/// Sets the flag. Until it is cleared, running and later queries end as unresolved. Questions that need no search are
/// still answered.
///
/// # Safety
/// `stop` is null or a handle.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn rccd_stop_set(stop: *const RccdStop) -> RccdStatus {
    // SAFETY: the contract of this function.
    unsafe { store_flag(stop, true) }
}

/// Clears the flag.
///
/// # Safety
/// `stop` is null or a handle.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn rccd_stop_clear(stop: *const RccdStop) -> RccdStatus {
    // SAFETY: the contract of this function.
    unsafe { store_flag(stop, false) }
}

/// Frees a flag. Solvers that use it keep its last value. Does nothing for null.
///
/// # Safety
/// The handle is null, or comes from this library, is not in use, and has not been freed.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn rccd_stop_free(stop: *mut RccdStop) {
    // SAFETY: the contract of this function.
    unsafe { free(stop) }
}

/// # Safety
/// `stop` is null or a handle.
unsafe fn store_flag(stop: *const RccdStop, value: bool) -> RccdStatus {
    status_of(|| {
        // SAFETY: the contract of this function.
        let stop = unsafe { reference("stop", stop) }?;
        stop.0.store(value, Ordering::Relaxed);
        Ok(())
    })
}
