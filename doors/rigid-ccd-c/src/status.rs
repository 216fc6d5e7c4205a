//! What calls return: a status, and a message that the thread can read.

use std::cell::RefCell;
use std::ffi::{CStr, CString, c_char};
use std::fmt::Display;
use std::panic::{AssertUnwindSafe, catch_unwind};

/// Whether a call has worked.
#[repr(i32)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RccdStatus {
    /// The call has worked. A query that reached a limit has worked too: its answer is unresolved.
    Ok = 0,
    /// An argument is null, or no value of its type.
    InvalidArgument = 1,
    /// A number, such as a radius or a duration, is out of range.
    InvalidInput = 2,
    /// A body cannot be made from the mesh or file.
    InvalidBody = 3,
    /// A defect of this library. The objects of the call may be freed, and nothing else.
    Panic = 4,
}

/// The reason why a call has not worked.
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
    /// The message of the last failed call of this thread.
    static MESSAGE: RefCell<CString> = RefCell::default();
}

/// Runs the body of a function of the interface, and turns a failure or a panic into a status with a message.
pub(crate) fn status_of(call: impl FnOnce() -> Result<(), Failure>) -> RccdStatus {
    // A query that panics leaves its solver with memory of no use; the status forbids to use it again.
    let failure = match catch_unwind(AssertUnwindSafe(call)) {
        Ok(Ok(())) => return RccdStatus::Ok,
        Ok(Err(failure)) => failure,
        Err(panic) => Failure {
            status: RccdStatus::Panic,
            message: panic_message(&*panic),
        },
    };
    let text = failure.message.replace('\0', " ");
    // A thread that ends has no place for a message any more.
    let _ = MESSAGE.try_with(|message| message.replace(CString::new(text).unwrap_or_default()));
    failure.status
}

fn panic_message(panic: &dyn std::any::Any) -> String {
    let text = panic.downcast_ref::<&str>().map(|text| (*text).to_owned());
    let text = text.or_else(|| panic.downcast_ref::<String>().cloned());
    text.unwrap_or_else(|| "a panic".to_owned())
}

/// The version of this crate.
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

/// Returns the message of the last call of this thread that has not worked, in UTF-8; it is empty before. The text is valid
/// until the next call of this thread that does not work: ask for it after the call, in a statement of its own.
#[unsafe(no_mangle)]
pub extern "C" fn rccd_last_error() -> *const c_char {
    let message = MESSAGE.try_with(|message| message.borrow().as_ptr());
    message.unwrap_or(c"".as_ptr())
}
