//! Work that another thread may stop.

use std::cmp::Ordering;
use std::convert::Infallible;
use std::sync::atomic::{self, AtomicBool};

/// What work asks again and again whether it goes on.
pub(crate) trait Stop: Copy {
    /// What stopped work returns; nothing for work that is never stopped.
    type Stopped;

    /// Returns an error once the work is to stop.
    fn check(self) -> Result<(), Self::Stopped>;
}

/// Work goes on to its end.
#[derive(Clone, Copy)]
pub(crate) struct Never;

impl Stop for Never {
    type Stopped = Infallible;

    fn check(self) -> Result<(), Infallible> {
        Ok(())
    }
}

/// Another thread has set the flag of the work.
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

/// The number of elements that are sorted without a look at the flag.
const SORTED_AT_ONCE: usize = 1 << 14;

/// Sorts elements, equal ones in their order.
pub(crate) fn sort<T, S: Stop>(
    elements: &mut [T],
    compare: impl Fn(&T, &T) -> Ordering,
    stop: S,
) -> Result<(), S::Stopped> {
    let mut length = SORTED_AT_ONCE;
    loop {
        for part in elements.chunks_mut(length) {
            stop.check()?;
            // Of two parts that are sorted it makes one in a single pass.
            part.sort_by(&compare);
        }
        if length >= elements.len() {
            return Ok(());
        }
        length = length.saturating_mul(2);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn long_lists_are_sorted_in_the_order_of_equal_elements() {
        for count in [
            0,
            1,
            SORTED_AT_ONCE,
            SORTED_AT_ONCE + 1,
            5 * SORTED_AT_ONCE - 3,
        ] {
            let value = |k: usize| (k.wrapping_mul(2_654_435_761) >> 7) % 1000;
            let mut found: Vec<(usize, usize)> = (0..count).map(|k| (value(k), k)).collect();
            let mut expected = found.clone();
            expected.sort_unstable();
            let Ok(()) = sort(&mut found, |a, b| a.0.cmp(&b.0), Never);
            assert_eq!(found, expected);
        }
    }

    #[test]
    fn a_flag_stops_sorting() {
        let flag = AtomicBool::new(true);
        assert!(sort(&mut [2, 1], Ord::cmp, &flag).is_err());
    }
}
