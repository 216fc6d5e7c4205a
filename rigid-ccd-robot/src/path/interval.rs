//! Intervals of a path.

use rigid_ccd::Error;

/// An interval of a path. Its ends are measured in segments: 1.5 is the midpoint of the second segment.
///
/// Intervals are created by halving. An interval that is longer than a segment begins and ends at configurations.
#[derive(Clone, Copy, Debug)]
pub(crate) struct PathInterval {
    pub(crate) from: f64,
    pub(crate) to: f64,
    /// The number of halvings that led to this interval.
    pub(crate) halvings: u32,
}

impl PathInterval {
    /// Returns the interval of a whole path.
    pub(crate) fn whole_path(segments: usize) -> Self {
        PathInterval {
            from: 0.0,
            to: segments as f64,
            halvings: 0,
        }
    }

    /// Returns an interval within a segment of a path, as if halving the path had led to it.
    pub(crate) fn within_segment(from: f64, to: f64, segments: usize) -> Self {
        let halvings = (segments as f64 / (to - from)).log2();
        PathInterval {
            from,
            to,
            halvings: halvings.round() as u32,
        }
    }

    /// Returns the midpoint, in segments. It is rounded down to a configuration if the interval is longer than a
    /// segment.
    pub(crate) fn middle(&self) -> f64 {
        let midpoint = 0.5 * (self.from + self.to);
        if self.to - self.from > 1.0 {
            midpoint.floor()
        } else {
            midpoint
        }
    }

    /// Returns whether the interval lies within one segment.
    pub(crate) fn is_within_segment(&self) -> bool {
        self.to - self.from <= 1.0
    }

    /// Returns the halves before and after the midpoint.
    pub(crate) fn halves(&self) -> [Self; 2] {
        let (midpoint, halvings) = (self.middle(), self.halvings + 1);
        let (from, to) = (self.from, self.to);
        [(from, midpoint), (midpoint, to)].map(|(from, to)| PathInterval { from, to, halvings })
    }
}

/// The result of a search step: an error of the engine, or whether the search continues.
pub(crate) type StepResult = Result<std::ops::ControlFlow<()>, Error>;
