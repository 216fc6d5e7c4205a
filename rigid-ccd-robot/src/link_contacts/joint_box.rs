//! Boxes of joint positions.

use ccd_core::order::greater;

/// A range for each position of the joints between two links.
#[derive(Clone, Debug)]
pub(super) struct JointBox {
    ranges: Vec<[f64; 2]>,
    /// The share of the volume of the box that was halved first.
    pub(super) volume_share: f64,
}

impl JointBox {
    pub(super) fn new(ranges: Vec<[f64; 2]>) -> Self {
        JointBox {
            ranges,
            volume_share: 1.0,
        }
    }

    /// Returns the box that is a point.
    pub(super) fn at(positions: &[f64]) -> Self {
        JointBox::new(positions.iter().map(|&own| [own; 2]).collect())
    }

    pub(super) fn ranges(&self) -> &[[f64; 2]] {
        &self.ranges
    }

    /// Returns the positions in the middle.
    pub(super) fn middle(&self) -> Vec<f64> {
        self.ranges.iter().map(middle).collect()
    }

    /// Returns how far the position at a index is at most from that in the middle.
    pub(super) fn max_deviation(&self, index: usize) -> f64 {
        let ([low, high], middle) = (self.ranges[index], middle(&self.ranges[index]));
        greater(high - middle, middle - low)
    }

    /// Returns both halves along the position at a index; `None` if its range cannot be halved.
    pub(super) fn halves(&self, index: usize) -> Option<[Self; 2]> {
        let [low, high] = *self.ranges.get(index)?;
        let middle = middle(&self.ranges[index]);
        if !(low < middle && middle < high) {
            return None;
        }
        Some([[low, middle], [middle, high]].map(|range| {
            let mut half = self.clone();
            half.ranges[index] = range;
            half.volume_share *= 0.5;
            half
        }))
    }
}

fn middle([low, high]: &[f64; 2]) -> f64 {
    0.5 * low + 0.5 * high
}
