//! The time interval of a cast.

use crate::CastError;
use crate::order::{greater, lesser};

/// The time interval of a cast, in parry's unit of time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Interval {
    pub(crate) start: f64,
    end: f64,
}

impl Interval {
    /// Creates an interval; `None` if its end is before its start.
    ///
    /// # Errors
    /// [`CastError::InvalidNumber`] for NaN, and for a start that is infinite.
    pub(crate) fn new(start: f64, end: f64) -> Result<Option<Self>, CastError> {
        let invalid_number = |what, value, allowed| CastError::InvalidNumber {
            what,
            value,
            allowed,
        };
        if !start.is_finite() {
            return Err(invalid_number("the start time", start, "finite"));
        }
        if end.is_nan() {
            return Err(invalid_number("the end time", end, "a number"));
        }
        Ok((start <= end).then_some(Interval { start, end }))
    }

    /// Returns the length of the interval, rounded up.
    pub(crate) fn length(self) -> f64 {
        if self.start == 0.0 {
            self.end
        } else {
            (self.end - self.start).next_up()
        }
    }

    /// Returns the sum of the start and `offset`, rounded down and clamped to the interval.
    pub(crate) fn cast_time_at_offset(self, offset: f64) -> f64 {
        let time = if self.start == 0.0 {
            offset
        } else {
            (self.start + offset).next_down()
        };
        lesser(greater(self.start, time), self.end)
    }
}

#[cfg(test)]
mod tests;
