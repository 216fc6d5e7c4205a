//! Structs whose first field is their size, so that later versions of the library can append fields.

use crate::arguments::check_output;
use crate::status::Failure;

/// A struct whose first field is its size in the caller's header. Programs built against an older header keep working:
/// the library does not write the fields that they do not know, and reads them as the defaults.
///
/// # Safety
/// The struct is `repr(C)`, and its first field is a `usize`. The fields within `FIRST_SIZE` never change their offsets.
pub(crate) unsafe trait Growing: Copy {
    /// The size of the struct in the first version of the library.
    const FIRST_SIZE: usize;
}

/// Reads a struct. Fields beyond the caller's size are taken from `default`.
///
/// # Safety
/// `pointer` is null, or points to a struct of the size in its first field, with valid values of all fields.
pub(crate) unsafe fn read<T: Growing>(
    name: &str,
    pointer: *const T,
    default: T,
) -> Result<T, Failure> {
    check_output(name, pointer.cast_mut())?;
    // SAFETY: the caller's contract; the pointer is neither null nor misaligned.
    let size = unsafe { pointer.cast::<usize>().read() };
    if !(T::FIRST_SIZE..=size_of::<T>()).contains(&size) {
        let (first, now) = (T::FIRST_SIZE, size_of::<T>());
        return Err(Failure::argument(format!(
            "size of {name} is {size}, not from {first} to {now}: it is not set, or the header is of a later version"
        )));
    }
    let mut value = default;
    // SAFETY: the struct has `size` bytes, and the copy has at least as many.
    unsafe {
        let to = (&raw mut value).cast::<u8>();
        to.copy_from_nonoverlapping(pointer.cast::<u8>(), size);
    }
    Ok(value)
}

/// Returns the size that the caller has set in the first field of `out`. The other fields may be uninitialised.
///
/// # Safety
/// `out` is null, or points to memory that begins with its size.
pub(crate) unsafe fn caller_size<T: Growing>(name: &str, out: *mut T) -> Result<usize, Failure> {
    check_output(name, out)?;
    // SAFETY: the caller's contract; `out` is neither null nor misaligned.
    let size = unsafe { out.cast::<usize>().read() };
    if size < T::FIRST_SIZE {
        let least = T::FIRST_SIZE;
        return Err(Failure::argument(format!(
            "size of {name} is {size}, and at least {least} are needed: it is not set"
        )));
    }
    Ok(size)
}

/// Stores the fields of a value that fit into `size` bytes. The field with the size in `out` stays unchanged.
///
/// # Safety
/// `out` points to `size` bytes, where `size` comes from [`caller_size`].
pub(crate) unsafe fn store<T: Growing>(out: *mut T, size: usize, value: &T) {
    let begin = size_of::<usize>();
    let count = size.min(size_of::<T>()) - begin;
    // SAFETY: both have at least `count` bytes after their sizes, and they do not overlap.
    unsafe {
        let from = std::ptr::from_ref(value).cast::<u8>().add(begin);
        out.cast::<u8>()
            .add(begin)
            .copy_from_nonoverlapping(from, count);
    }
}

#[cfg(test)]
mod tests {
    use super::{Growing, caller_size, read, store};

    /// The first version of a struct. `Now` is the current one.
    #[repr(C)]
    #[derive(Clone, Copy, Debug, PartialEq)]
    struct First {
        size: usize,
        time: f64,
    }

    #[repr(C)]
    #[derive(Clone, Copy, Debug, PartialEq)]
    struct Now {
        size: usize,
        time: f64,
        work: u64,
    }

    // SAFETY: both structs are `repr(C)`, begin with a `usize`, and have the same first fields.
    unsafe impl Growing for Now {
        const FIRST_SIZE: usize = size_of::<First>();
    }

    const DEFAULT: Now = Now {
        size: 0,
        time: 1.0,
        work: 7,
    };

    #[test]
    fn programs_of_the_first_version_are_served() {
        let mut old = [First {
            size: size_of::<First>(),
            time: 2.0,
        }; 2];
        let place = old.as_mut_ptr().cast::<Now>();
        // SAFETY: the pointer is to a struct of the first version, with its size set.
        unsafe {
            let value = read("settings", place, DEFAULT).ok().unwrap();
            assert_eq!((value.time, value.work), (2.0, 7));
            let size = caller_size("answer", place).ok().unwrap();
            store(
                place,
                size,
                &Now {
                    time: 3.0,
                    ..DEFAULT
                },
            );
        }
        let expected = First {
            size: size_of::<First>(),
            time: 3.0,
        };
        // The memory behind the first struct is unchanged.
        assert_eq!(
            old,
            [
                expected,
                First {
                    time: 2.0,
                    ..expected
                }
            ]
        );
    }

    #[test]
    fn sizes_that_cannot_be_are_refused() {
        for (size, read_works, store_works) in [
            (0, false, false),
            (8, false, false),
            (24, true, true),
            (32, false, true),
        ] {
            let mut now = Now { size, ..DEFAULT };
            // SAFETY: nothing beyond the struct is accessed. Reading refuses a greater size, and storing ends within
            // the struct.
            unsafe {
                assert_eq!(
                    read("settings", &now, DEFAULT).is_ok(),
                    read_works,
                    "{size}"
                );
                assert_eq!(
                    caller_size("answer", &mut now).is_ok(),
                    store_works,
                    "{size}"
                );
            }
        }
    }
}
