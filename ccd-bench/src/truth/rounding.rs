//! Bounds on the rounding errors of the referee's computations in floats.

/// 2⁻⁵³: the largest relative error of a float operation.
pub(super) const UNIT_ROUNDOFF: f64 = f64::EPSILON / 2.0;
/// A bound on the relative error of up to forty roundings.
pub(super) const FORTY_ROUNDINGS_ERROR: f64 = 1e-14;
/// The factor by which a computed upper bound is raised so that it holds in spite of up to forty roundings.
pub(super) const ROUND_UP_FACTOR: f64 = 1.0 + FORTY_ROUNDINGS_ERROR;

/// Returns the larger of two numbers, or NaN if one is NaN, so that an undefined bound never proves anything.
pub(super) fn nan_propagating_max(a: f64, b: f64) -> f64 {
    if a.is_nan() || a > b { a } else { b }
}
