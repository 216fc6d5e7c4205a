//! Times of many queries, in memory that does not grow with their number.

use std::collections::BTreeMap;

/// A histogram of times with a relative resolution of a thousandth; its size does not grow with the number of times.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct TimeHistogram {
    /// For each value of a time's leading bits, the number of times. These bits sort as the times do.
    counts: BTreeMap<u64, u64>,
    count: u64,
    total_micros: f64,
}

/// The number of low bits dropped from a time: all except the leading 10 of its fraction.
const DROPPED_LOW_BIT_COUNT: u32 = f64::MANTISSA_DIGITS - 1 - 10;

impl TimeHistogram {
    /// Counts one measured time, in microseconds.
    pub(crate) fn add(&mut self, micros: f64) {
        *self
            .counts
            .entry(micros.to_bits() >> DROPPED_LOW_BIT_COUNT)
            .or_default() += 1;
        self.count += 1;
        self.total_micros += micros;
    }

    /// Returns how many durations were recorded.
    pub(crate) fn count(&self) -> u64 {
        self.count
    }

    /// Returns the mean time; NaN without times.
    pub(crate) fn mean(&self) -> f64 {
        self.total_micros / self.count as f64
    }

    /// Returns the median time, rounded to a thousandth; NaN without times.
    pub(crate) fn median(&self) -> f64 {
        0.5 * (self.time_at_rank(self.count.saturating_sub(1) / 2)
            + self.time_at_rank(self.count / 2))
    }

    /// Returns the time at an index in ascending order of times.
    fn time_at_rank(&self, index: u64) -> f64 {
        let mut count_so_far = 0;
        for (&bits, &count) in &self.counts {
            count_so_far += count;
            if count_so_far > index {
                return f64::from_bits(bits << DROPPED_LOW_BIT_COUNT);
            }
        }
        f64::NAN
    }
}
