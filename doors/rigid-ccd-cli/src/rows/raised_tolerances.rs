//! Counts answers whose tolerance is larger than the requested one, because of rounding.

use ccd_core::order::greater;
use std::fmt;

/// A count of the answers whose tolerance is larger than the requested one.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct RaisedTolerances {
    /// The tolerance of `--tolerance`, in the scene's unit of length.
    requested: f64,
    pub(crate) count: usize,
    /// The largest tolerance of any answer, in the scene's unit of length.
    pub(crate) largest: f64,
}

impl RaisedTolerances {
    pub(crate) fn new(requested: f64) -> Self {
        RaisedTolerances {
            requested,
            count: 0,
            largest: requested,
        }
    }

    /// Adds the tolerance that an answer meets.
    pub(crate) fn add(&mut self, tolerance: f64) {
        self.count += usize::from(tolerance > self.requested);
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
            self.requested, self.count, self.largest
        )
    }
}
