//! What rounding comes to.

/// 2⁻⁵³: a float operation is off by at most this share of its result.
pub(super) const UNIT_ROUNDOFF: f64 = f64::EPSILON / 2.0;
/// More than what forty roundings come to, relative to the values that are rounded.
pub(super) const ROUNDED: f64 = 1e-14;
/// The factor that undoes as many roundings down.
pub(super) const ROUNDED_UP: f64 = 1.0 + ROUNDED;

/// The larger of two, NaN where one is: what cannot be bounded excludes nothing.
pub(super) fn larger(a: f64, b: f64) -> f64 {
    if a.is_nan() || a > b { a } else { b }
}
