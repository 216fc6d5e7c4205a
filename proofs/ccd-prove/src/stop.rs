//! The stop flag: another thread sets it to end long work early.

use std::cmp::Ordering;
use std::convert::Infallible;
use std::sync::atomic::{self, AtomicBool};

/// A stop condition, which long work checks regularly.
pub(crate) trait Stop: Copy {
    /// The error of stopped work. For work that is never stopped this type has no values.
    type Stopped;

    /// Returns an error if the work has to stop.
    fn check(self) -> Result<(), Self::Stopped>;
}

/// The stop condition of work that is never stopped.
#[derive(Clone, Copy)]
pub(crate) struct Never;

impl Stop for Never {
    type Stopped = Infallible;

    fn check(self) -> Result<(), Infallible> {
        Ok(())
    }
}

/// The error of work that another thread has stopped.
pub(crate) struct Stopped;

impl Stop for &AtomicBool {
    type Stopped = Stopped;

    fn check(self) -> Result<(), Stopped> {
        if self.load(atomic::Ordering::Relaxed) {
            Err(Stopped)
        } else {
            Ok(())
        }
    }
}

/// The number of elements to sort between two checks of the stop condition.
const SORTED_AT_ONCE: usize = 1 << 14;

/// Sorts elements. The sort is stable.
pub(crate) fn sort<T, S: Stop>(
    elements: &mut [T],
    compare: impl Fn(&T, &T) -> Ordering,
    stop: S,
) -> Result<(), S::Stopped> {
    let mut length = SORTED_AT_ONCE;
    loop {
        for chunk in elements.chunks_mut(length) {
            stop.check()?;
            // Each chunk consists of two sorted runs, which the stable sort merges in a single pass.
            chunk.sort_by(&compare);
        }
        if length >= elements.len() {
            return Ok(());
        }
        length = length.saturating_mul(2);
    }
}

#[cfg(test)]
mod tests;
