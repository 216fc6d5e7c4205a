//! Answers whose tolerance is larger than the given one, because of rounding.

use ccd_core::order::greater;
use std::fmt;

/// Counts the answers whose tolerance is larger than the given one.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct RaisedTolerances {
    /// The tolerance given for the queries, in the scene's unit of length.
    given: f64,
    pub(crate) count: usize,
    /// The largest tolerance of any answer, in the scene's unit of length.
    pub(crate) largest: f64,
}

impl RaisedTolerances {
    pub(crate) fn new(given: f64) -> Self {
        RaisedTolerances {
            given,
            count: 0,
            largest: given,
        }
    }

    /// Adds the tolerance that an answer meets.
    pub(crate) fn add(&mut self, tolerance: f64) {
        self.count += usize::from(tolerance > self.given);
        self.largest = greater(self.largest, tolerance);
    }
}

/// Writes a line that follows a summary, or nothing if no tolerance was raised.
impl fmt::Display for RaisedTolerances {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if self.count == 0 {
            return Ok(());
        }
        write!(
            f,
            "\n--tolerance {:e} cannot be certified at these coordinates: raised for {} rows, to at most {:.2e}",
            self.given, self.count, self.largest
        )
    }
}
