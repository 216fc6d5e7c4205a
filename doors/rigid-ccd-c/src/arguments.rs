//! Dereferences the pointers that C passes.

use crate::status::Failure;
use std::ffi::{CStr, c_char};

/// Returns the value that a pointer points to.
///
/// # Safety
/// The pointer is null, or points to a value that nobody changes during the call.
pub(crate) unsafe fn reference<'a, T>(name: &str, pointer: *const T) -> Result<&'a T, Failure> {
    check_aligned(name, pointer)?;
    // SAFETY: the caller's contract; the pointer is aligned.
    unsafe { pointer.as_ref() }.ok_or_else(|| null(name))
}

/// Returns a mutable reference to the value that a pointer points to.
///
/// # Safety
/// The pointer is null, or points to a value that nobody else uses during the call.
pub(crate) unsafe fn exclusive<'a, T>(name: &str, pointer: *mut T) -> Result<&'a mut T, Failure> {
    check_aligned(name, pointer)?;
    // SAFETY: the caller's contract; the pointer is aligned.
    unsafe { pointer.as_mut() }.ok_or_else(|| null(name))
}

/// Returns an array as a slice. The pointer to an empty array may be null.
///
/// # Safety
/// The pointer is null, or points to `count` values that nobody changes during the call.
pub(crate) unsafe fn array<'a, T>(
    name: &str,
    pointer: *const T,
    count: usize,
) -> Result<&'a [T], Failure> {
    if count == 0 {
        return Ok(&[]);
    }
    if pointer.is_null() {
        return Err(null(name));
    }
    check_aligned(name, pointer)?;
    let bytes = count.checked_mul(size_of::<T>());
    if bytes.is_none_or(|bytes| bytes > isize::MAX as usize) {
        let size = size_of::<T>();
        return Err(Failure::argument(format!(
            "{name} is too long: {count} elements of {size} bytes"
        )));
    }
    // SAFETY: the caller's contract; the array is aligned, and its size fits into `isize`.
    Ok(unsafe { std::slice::from_raw_parts(pointer, count) })
}

/// Returns a text, which must be UTF-8.
///
/// # Safety
/// The pointer is null, or points to a text that ends with a zero and that nobody changes during the call.
pub(crate) unsafe fn text<'a>(name: &str, pointer: *const c_char) -> Result<&'a str, Failure> {
    if pointer.is_null() {
        return Err(null(name));
    }
    // SAFETY: the caller's contract.
    let text = unsafe { CStr::from_ptr(pointer) };
    text.to_str()
        .map_err(|_| Failure::argument(format!("{name} is not UTF-8")))
}

/// Returns a text, which must be UTF-8, or `None` for null.
///
/// # Safety
/// As for [`text`].
pub(crate) unsafe fn text_or_none<'a>(
    name: &str,
    pointer: *const c_char,
) -> Result<Option<&'a str>, Failure> {
    if pointer.is_null() {
        return Ok(None);
    }
    // SAFETY: the contract of this function.
    unsafe { text(name, pointer) }.map(Some)
}

/// Moves a value to the heap, and stores its handle in `*out`.
///
/// # Safety
/// `out` is null, or points to memory for a handle.
pub(crate) unsafe fn give<T>(out: *mut *mut T, value: T) -> Result<(), Failure> {
    check_output("out", out)?;
    // SAFETY: the caller's contract; `out` is neither null nor misaligned.
    unsafe { out.write(Box::into_raw(Box::new(value))) };
    Ok(())
}

/// Stores a value in memory that may be uninitialised.
///
/// # Safety
/// `out` is null, or points to memory for the value.
pub(crate) unsafe fn store<T>(name: &str, out: *mut T, value: T) -> Result<(), Failure> {
    check_output(name, out)?;
    // SAFETY: the caller's contract; `out` is neither null nor misaligned.
    unsafe { out.write(value) };
    Ok(())
}

/// Frees a handle made by [`give`]. Does nothing for null.
///
/// # Safety
/// The handle is null, or was made by [`give`] and has not been freed.
pub(crate) unsafe fn free<T>(handle: *mut T) {
    if !handle.is_null() {
        // SAFETY: the caller's contract.
        drop(unsafe { Box::from_raw(handle) });
    }
}

/// Checks that a pointer for output is aligned and not null.
pub(crate) fn check_output<T>(name: &str, out: *mut T) -> Result<(), Failure> {
    if out.is_null() {
        return Err(null(name));
    }
    check_aligned(name, out)
}

fn null(name: &str) -> Failure {
    Failure::argument(format!("{name} is null"))
}

fn check_aligned<T>(name: &str, pointer: *const T) -> Result<(), Failure> {
    if pointer.is_aligned() {
        Ok(())
    } else {
        Err(Failure::argument(format!("{name} is not aligned")))
    }
}
