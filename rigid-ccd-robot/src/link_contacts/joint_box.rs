//! Boxes of joint positions: one range for each position.

use ccd_core::order::greater;

/// A box of the positions of the joints between two links.
#[derive(Clone, Debug)]
pub(super) struct JointBox {
    pub(super) ranges: Vec<[f64; 2]>,
    /// The volume as a fraction of the volume of the initial box.
    pub(super) volume_fraction: f64,
}

impl JointBox {
    pub(super) fn new(ranges: Vec<[f64; 2]>) -> Self {
        JointBox {
            ranges,
            volume_fraction: 1.0,
        }
    }

    /// Returns the box that contains a single point.
    pub(super) fn from_point(positions: &[f64]) -> Self {
        JointBox::new(positions.iter().map(|&position| [position; 2]).collect())
    }

    /// Returns the center.
    pub(super) fn center(&self) -> Vec<f64> {
        self.ranges.iter().map(midpoint).collect()
    }

    /// Returns the largest deviation of a position from the center.
    pub(super) fn max_deviation(&self, index: usize) -> f64 {
        let ([low, high], midpoint) = (self.ranges[index], midpoint(&self.ranges[index]));
        greater(high - midpoint, midpoint - low)
    }

    /// Splits the box along a position; `None` if the range is too small to halve.
    pub(super) fn halves(&self, index: usize) -> Option<[Self; 2]> {
        let [low, high] = *self.ranges.get(index)?;
        let midpoint = midpoint(&self.ranges[index]);
        if !(low < midpoint && midpoint < high) {
            return None;
        }
        Some([[low, midpoint], [midpoint, high]].map(|range| {
            let mut half = self.clone();
            half.ranges[index] = range;
            half.volume_fraction *= 0.5;
            half
        }))
    }
}

fn midpoint([low, high]: &[f64; 2]) -> f64 {
    0.5 * low + 0.5 * high
}
