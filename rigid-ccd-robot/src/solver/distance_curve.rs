//! Computes the least distance over each of many ranges of a path.

use super::{CellSolver, Goal};
use crate::error::PathError;
use crate::path::Path;
use crate::path::interval::PathInterval;
use crate::path_answer::PathOutcome;
use crate::path_point::PathPoint;

/// Bounds of the least distance over a range of a path.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DistanceRange<'c> {
    /// The start of the range.
    pub from: PathPoint,
    /// The end of the range, where the next range starts.
    pub to: PathPoint,
    /// The least distance of any checked pair in the range.
    pub closest: PathOutcome<'c>,
}

/// The largest number of ranges.
const MAX_RANGE_COUNT: f64 = 1e6;

impl<'c> CellSolver<'c> {
    /// Divides each segment of a path into 2^`halvings` equal ranges, and returns the least distance of any checked
    /// pair in each. The lower bounds form a step function that is never above the distance along the path. A path of
    /// one configuration has one range.
    ///
    /// # Guarantee
    /// Each range has the guarantee of [`closest_approach`](Self::closest_approach). A deadline applies to all ranges
    /// together.
    ///
    /// # Errors
    /// [`PathError`], also for more than a million ranges.
    pub fn distance_curve<P: Path + ?Sized>(
        &mut self,
        path: &P,
        halvings: u32,
    ) -> Result<Vec<DistanceRange<'c>>, PathError> {
        self.set_path_reporting_start(path)?;
        let segments = self.search.segment_count();
        let count = (segments as f64) * f64::from(halvings).exp2();
        if count > MAX_RANGE_COUNT {
            return Err(PathError::InvalidRangeSetting {
                name: "number of ranges",
                value: count,
                allowed: "at most a million",
            });
        }
        let whole = self.search.whole_path_interval();
        if segments == 0 {
            return Ok(vec![self.distance_range(whole)?]);
        }
        let mut intervals = Vec::new();
        for segment in 0..segments {
            let (from, to) = (segment as f64, (segment + 1) as f64);
            push_halves(PathInterval { from, to, ..whole }, halvings, &mut intervals);
        }
        let ranges = intervals
            .into_iter()
            .map(|interval| self.distance_range(interval));
        ranges.collect()
    }

    fn distance_range(&mut self, interval: PathInterval) -> Result<DistanceRange<'c>, PathError> {
        self.search.answer_question(Goal::LeastDistance, interval)?;
        let segments = self.search.segment_count();
        Ok(DistanceRange {
            from: PathPoint::from_path_position(interval.from, segments),
            to: PathPoint::from_path_position(interval.to, segments),
            closest: self.measured_distance()?,
        })
    }
}

/// Halves an interval repeatedly, and appends the resulting intervals in order.
fn push_halves(interval: PathInterval, halvings: u32, intervals: &mut Vec<PathInterval>) {
    if halvings == 0 {
        intervals.push(interval);
        return;
    }
    for half in interval.halves() {
        push_halves(half, halvings - 1, intervals);
    }
}

#[cfg(test)]
mod tests;
