//! Points of a piece as convex combinations of the piece's points.

use crate::rounding::WEIGHTS;
use glam::DVec3;

/// A convex combination of up to four points of a piece.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Combination {
    indices: [u32; 4],
    weights: [f64; 4],
    len: u8,
}

impl Combination {
    /// The empty combination, to which terms can be [added](Combination::push). Terms can be
    /// [pushed](Combination::push).
    pub const EMPTY: Combination = Combination {
        indices: [0; 4],
        weights: [0.0; 4],
        len: 0,
    };

    /// Creates the combination that is a single point.
    pub fn point(index: u32) -> Self {
        let mut out = Self::EMPTY;
        out.push(index, 1.0);
        out
    }

    /// Creates the combination `(1 − t) p + t q` of two points.
    pub fn segment(indices: [u32; 2], t: f64) -> Self {
        let mut out = Self::EMPTY;
        out.push(indices[0], 1.0 - t);
        out.push(indices[1], t);
        out
    }

    /// Adds a point with a weight. Weights that are not positive, or outside of [`WEIGHTS`], are dropped. Equal indices
    /// are merged. Terms beyond four distinct indices are dropped.
    pub fn push(&mut self, index: u32, weight: f64) {
        // A NaN is in no range.
        if !WEIGHTS.contains(&weight) {
            return;
        }
        let len = self.len as usize;
        if let Some(k) = self.indices[..len].iter().position(|&i| i == index) {
            self.weights[k] += weight;
        } else if len < 4 {
            self.indices[len] = index;
            self.weights[len] = weight;
            self.len += 1;
        }
    }

    /// Returns the indices of the points in the combination.
    pub fn support(&self) -> &[u32] {
        &self.indices[..self.len as usize]
    }

    /// Returns the position of the combination; `None` if it is empty, or has an index that `points` lacks.
    ///
    /// Weights are divided by their sum, so that the result is in the hull up to rounding.
    pub fn of(&self, points: &[DVec3]) -> Option<DVec3> {
        let (mut sum, mut total) = (DVec3::ZERO, 0.0);
        let first = *points.get(*self.support().first()? as usize)?;
        for (&index, &weight) in self.support().iter().zip(&self.weights) {
            // The sum is relative to the first point, so that its rounding is that of the piece's size.
            sum += weight * (*points.get(index as usize)? - first);
            total += weight;
        }
        Some(first + sum / total)
    }
}
