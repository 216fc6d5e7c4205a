//! The status that calls return, and the message of the last failure of a thread.

use std::cell::RefCell;
use std::ffi::{CStr, CString, c_char};
use std::fmt::Display;
use std::panic::{AssertUnwindSafe, catch_unwind};

/// The status of a call.
#[repr(i32)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RccdStatus {
    /// Success. A query that reaches a limit also succeeds: its outcome is unresolved.
    Ok = 0,
    /// An argument is null but must not be, or is not a value of its type.
    InvalidArgument = 1,
    /// A number, such as a radius or a duration, is out of range.
    InvalidInput = 2,
    /// The mesh or file does not give a body.
    InvalidBody = 3,
    /// A defect of this library. Afterwards the objects passed to the call may only be freed.
    Panic = 4,
}

/// The reason why a call failed.
#[derive(Debug)]
pub(crate) struct Failure {
    status: RccdStatus,
    message: String,
}

impl Failure {
    pub(crate) fn argument(message: impl Into<String>) -> Self {
        Failure {
            status: RccdStatus::InvalidArgument,
            message: message.into(),
        }
    }

    pub(crate) fn input(error: impl Display) -> Self {
        Failure {
            status: RccdStatus::InvalidInput,
            message: error.to_string(),
        }
    }

    pub(crate) fn body(error: impl Display) -> Self {
        Failure {
            status: RccdStatus::InvalidBody,
            message: error.to_string(),
        }
    }
}

thread_local! {
    /// The message of this thread's last failed call.
    static MESSAGE: RefCell<CString> = RefCell::default();
}

/// Runs the body of a function of the interface. Converts a failure or a panic to a status, and keeps its message.
pub(crate) fn status_of(call: impl FnOnce() -> Result<(), Failure>) -> RccdStatus {
    // A query that panics leaves its solver in an undefined state. `RCCD_STATUS_PANIC` forbids any use of it except
    // freeing.
    let failure = match catch_unwind(AssertUnwindSafe(call)) {
        Ok(Ok(())) => return RccdStatus::Ok,
        Ok(Err(failure)) => failure,
        Err(panic) => Failure {
            status: RccdStatus::Panic,
            message: panic_message(&*panic),
        },
    };
    let text = failure.message.replace('\0', " ");
    // This fails while the thread ends, because its message is already destroyed. Then there is no message.
    let _ = MESSAGE.try_with(|message| message.replace(CString::new(text).unwrap_or_default()));
    failure.status
}

fn panic_message(panic: &dyn std::any::Any) -> String {
    let text = panic.downcast_ref::<&str>().map(|text| (*text).to_owned());
    let text = text.or_else(|| panic.downcast_ref::<String>().cloned());
    text.unwrap_or_else(|| "a panic".to_owned())
}

/// The version of this crate, as a text for C.
const VERSION: &CStr =
    match CStr::from_bytes_with_nul(concat!(env!("CARGO_PKG_VERSION"), "\0").as_bytes()) {
        Ok(version) => version,
        Err(_) => c"",
    };

/// Returns the version of the library, such as `0.1.0`.
#[unsafe(no_mangle)]
pub extern "C" fn rccd_version() -> *const c_char {
    VERSION.as_ptr()
}

/// Returns the message of this thread's last failed call, in UTF-8; empty if no call has failed. The text is valid until
/// this thread's next failed call. Call this in a separate statement after the failed call.
#[unsafe(no_mangle)]
pub extern "C" fn rccd_last_error() -> *const c_char {
    let message = MESSAGE.try_with(|message| message.borrow().as_ptr());
    message.unwrap_or(c"".as_ptr())
}
