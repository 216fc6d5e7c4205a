//! Flags by which another thread stops a query.

use crate::arguments::{free, give, reference};
use crate::status::{RccdStatus, status_of};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

/// A flag that stops the queries of all solvers whose settings name it. Any thread may set and clear it at any time.
pub struct RccdStop(pub(crate) Arc<AtomicBool>);

/// Makes a flag, which is not set.
///
/// # Safety
/// `out` is null, or points to a place for a handle.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn rccd_stop_new(out: *mut *mut RccdStop) -> RccdStatus {
    // SAFETY: the contract of this function.
    status_of(|| unsafe { give(out, RccdStop(Arc::default())) })
}

/// Sets the flag: queries end as unresolved, and further ones do, until it is cleared. A question that takes no search is still answered.
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

/// Frees a flag; null is nothing. Solvers whose settings name it keep it as it is.
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
