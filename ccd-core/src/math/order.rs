//! Minimum and maximum by comparison, with a defined result for NaN.
//!
//! `f64::min` and `f64::max` are not used in this project: some compilers lose the last elements of
//! a loop that folds with them (rustc 1.95, LLVM 22.1.2). They compile a comparison and a choice
//! correctly.

/// Returns the lesser of two numbers: the first one, unless the second is less.
///
/// A NaN is never chosen over a first argument that is a number: `fold(f64::INFINITY, lesser)`
/// skips NaN. A NaN as the first argument stays.
///
/// ```
/// use ccd_core::order::lesser;
/// assert_eq!(lesser(2.0, 1.0), 1.0);
/// assert_eq!([3.0, 1.0, 2.0].into_iter().fold(f64::INFINITY, lesser), 1.0);
/// assert_eq!(lesser(2.0, f64::NAN), 2.0);
/// ```
#[inline]
pub fn lesser<T: PartialOrd>(first: T, second: T) -> T {
    if second < first { second } else { first }
}

/// Returns the greater of two numbers: the first one, unless the second is greater; NaN as in [`lesser`].
///
/// ```
/// use ccd_core::order::greater;
/// assert_eq!(greater(2.0, 1.0), 2.0);
/// assert_eq!(greater(2.0, f64::NAN), 2.0);
/// ```
#[inline]
pub fn greater<T: PartialOrd>(first: T, second: T) -> T {
    if second > first { second } else { first }
}
