//! Computes the time for which a gap stays open, in f32.

use crate::tolerance::CLOCK_F32;

/// Returns the largest τ with `apart ≥ rate τ + bend τ²/2`; 0 for NaN and for a pair that is not
/// apart by more than `closed`, even if it recedes.
#[inline(always)]
pub(super) fn free_time(apart: f32, closed: f32, rate: f32, bend: f32) -> f32 {
    let root = (rate * rate + 2.0 * bend * apart).sqrt();
    let approaching = 2.0 * apart / (rate + root);
    let receding = (root - rate) / bend;
    let tau = if rate > 0.0 { approaching } else { receding };
    // An overflowed root proves nothing.
    if apart > closed && tau > 0.0 && root <= f32::MAX {
        tau * CLOCK_F32
    } else {
        0.0
    }
}

/// Returns the same on a straight path.
#[inline(always)]
pub(super) fn straight_free_time(apart: f32, closed: f32, rate: f32) -> f32 {
    let tau = apart / rate;
    let tau = if rate > 0.0 { tau } else { f32::INFINITY };
    if apart > closed && tau > 0.0 {
        tau * CLOCK_F32
    } else {
        0.0
    }
}
