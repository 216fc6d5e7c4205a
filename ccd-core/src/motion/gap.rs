//! Computes for how long a gap stays open.

use super::free_time::FreeTime;
use crate::rounding::RATE_ERROR_F64;
use crate::tuning::MIN_NEWTON_GROWTH;

/// A gap that decreases by at most `rate τ + second_derivative τ²/2` within a time `τ`. The second derivative
/// `second_derivative` is negative if the bodies accelerate away from each other.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Gap {
    pub(crate) gap: f64,
    pub(crate) rate: f64,
    pub(crate) second_derivative: f64,
}

impl Gap {
    /// Returns the longest time for which the gap certainly stays open; 0 if it is closed or NaN.
    #[inline]
    pub(crate) fn free_time(&self) -> f64 {
        let (gap, rate, second_derivative) = (self.gap, self.rate, self.second_derivative);
        if rate.is_nan() {
            return 0.0;
        }
        if second_derivative < 0.0 {
            return self.free_time_decelerating();
        }
        let root = (rate * rate + 2.0 * second_derivative * gap).sqrt();
        // If the squares underflow, the root is still at least the rate; NaN stays NaN.
        let root = if root < rate.abs() { rate.abs() } else { root };
        let tau = if rate > 0.0 {
            2.0 * gap / (rate + root)
        } else if second_derivative > 0.0 {
            (root - rate) / second_derivative
        } else {
            f64::INFINITY
        };
        // A pair in contact gets no free time, even if it recedes.
        if gap > 0.0 && tau > 0.0 {
            tau * (1.0 - RATE_ERROR_F64)
        } else {
            0.0
        }
    }

    /// Returns the free time for a negative `second_derivative`. The rate at which the gap closes then decreases, so
    /// that the gap may never close.
    #[cold]
    fn free_time_decelerating(&self) -> f64 {
        let (gap, rate, second_derivative) = (self.gap, self.rate, self.second_derivative);
        let (square, lost) = (rate * rate, -2.0 * second_derivative * gap);
        // A sum that is lost to rounding or to underflow counts as zero.
        let left = (square - lost) + RATE_ERROR_F64 * (square + lost) + f64::MIN_POSITIVE;
        let tau = if rate > 0.0 && left >= 0.0 {
            2.0 * gap / (rate + left.sqrt())
        } else {
            f64::INFINITY
        };
        // Written so that NaN gives no time.
        if gap > 0.0 && tau > 0.0 && lost <= f64::MAX && square <= f64::MAX {
            tau * (1.0 - RATE_ERROR_F64)
        } else {
            0.0
        }
    }
}

/// Returns a time for which a gap certainly stays open, which ends at the first time within `[0, horizon]` at which it may
/// close, or earlier. `free_time(τ)` returns a time for which it stays open from `τ` on.
#[inline]
pub(crate) fn first_possible_crossing(
    horizon: f64,
    rounds: usize,
    free_time: impl Fn(f64) -> f64,
) -> FreeTime {
    let mut tau = 0.0;
    for _ in 0..rounds {
        let step = free_time(tau);
        tau += step;
        if tau >= horizon {
            return FreeTime::ToEnd;
        }
        // Steps shrink from here on, and the rest is not worth another round.
        if step <= tau * MIN_NEWTON_GROWTH {
            break;
        }
    }
    FreeTime::AtLeast(tau)
}

#[cfg(test)]
mod tests;
