//! A point of a path.

/// A point of a path: the number of a segment between two configurations, and the share of the segment that is passed.
#[derive(Clone, Copy, Debug, PartialEq, PartialOrd)]
pub struct PathPoint {
    /// The number of the segment: 0 between the first two configurations.
    pub segment: usize,
    /// The share of the segment that is passed, from 0 to 1.
    pub share: f64,
}

impl PathPoint {
    /// The start of a path.
    pub const START: PathPoint = PathPoint {
        segment: 0,
        share: 0.0,
    };

    /// Returns the time at which a robot is at this point if each segment takes one unit of time: the number of the segment and
    /// the share together.
    pub fn time(self) -> f64 {
        // Exact: the share was computed from this sum.
        self.segment as f64 + self.share
    }

    /// Converts a number of segments; the end of a path belongs to its last segment.
    pub(crate) fn from_path_position(at: f64, segments: usize) -> Self {
        let segment = (at as usize).min(segments.saturating_sub(1));
        PathPoint {
            segment,
            share: at - segment as f64,
        }
    }
}
