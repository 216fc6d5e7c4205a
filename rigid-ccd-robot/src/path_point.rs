//! A point of a path.

/// A point of a path: the index of a segment, and the elapsed fraction of it.
#[derive(Clone, Copy, Debug, PartialEq, PartialOrd)]
pub struct PathPoint {
    /// The index of the segment. Segment 0 is between the first two configurations.
    pub segment: usize,
    /// The elapsed fraction of the segment, from 0 to 1.
    pub fraction: f64,
}

impl PathPoint {
    /// The start of a path.
    pub const START: PathPoint = PathPoint {
        segment: 0,
        fraction: 0.0,
    };

    /// Returns the time of this point if each segment takes one unit of time: the index plus the fraction.
    pub fn time(self) -> f64 {
        // This is exact, because the fraction was computed from this sum.
        self.segment as f64 + self.fraction
    }

    /// Converts a position in segments. The end of a path belongs to its last segment.
    pub(crate) fn from_path_position(at: f64, segments: usize) -> Self {
        let segment = (at as usize).min(segments.saturating_sub(1));
        PathPoint {
            segment,
            fraction: at - segment as f64,
        }
    }
}
