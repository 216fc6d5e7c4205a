//! Bounds on rounding errors.

/// 2⁻⁵³: the largest relative error of a float operation.
pub(super) const UNIT_ROUNDOFF: f64 = f64::EPSILON / 2.0;
/// A bound on the relative error of up to forty roundings.
pub(super) const FORTY_ROUNDINGS_ERROR: f64 = 1e-14;
/// The factor that makes a bound valid after up to forty roundings.
pub(super) const ROUND_UP_FACTOR: f64 = 1.0 + FORTY_ROUNDINGS_ERROR;

/// Returns the larger of two numbers, or NaN if one is NaN, so that an unknown value excludes nothing.
pub(super) fn nan_propagating_max(a: f64, b: f64) -> f64 {
    if a.is_nan() || a > b { a } else { b }
}
