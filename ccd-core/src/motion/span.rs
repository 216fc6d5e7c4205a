//! Stretches of time within a query.

/// A stretch of time within a query.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Span {
    pub(crate) from: f64,
    pub(crate) end: f64,
    /// The index of the part of the query, between two corners, that contains the stretch.
    pub(crate) part_index: usize,
}

impl Span {
    /// Returns the stretch of length 0 at the start of this stretch.
    pub(crate) fn empty_span_at_start(self) -> Self {
        Span {
            end: self.from,
            ..self
        }
    }

    pub(crate) fn length(&self) -> f64 {
        self.end - self.from
    }

    /// Returns the time in the middle of the stretch.
    pub(crate) fn middle_time(&self) -> f64 {
        self.from + 0.5 * self.length()
    }
}
