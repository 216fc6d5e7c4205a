//! Bounds of rounding errors, for the prover's computations in binary64 and for the checker's computations in integers.

/// Error bound of a signed distance or of a distance, for each link and for each of both nodes. It is a fraction of the largest
/// length.
///
/// A link or a node takes fewer than 200 operations on numbers below the largest length. An operation has a relative error of at most
/// 2⁻⁵³.
pub(crate) const ROUNDING: f64 = 2e-14;

/// Factor that rounds up an upper bound of a second derivative.
///
/// The bound takes fewer than 1,000 operations on non-negative numbers. The checker also rounds up each of them, by less than one
/// unit.
pub(crate) const SECOND_DERIVATIVE_FACTOR: f64 = 1.0 + 1e-12;

/// The maximum sum of joint angles over half of an interval, in radians. The checker's limit is 2 for the sum rounded up.
pub(crate) const MAX_ANGLE: f64 = 1.999;

/// Error bound of a point transformed by a pose, as a fraction of the length of the point plus the length of the translation.
///
/// Let u = 2⁻⁵³. The length of the quaternion differs from 1 by less than 8 u, so the rotation scales lengths by less than 1 + 16 u.
/// The 30 operations of a rotation have an error below 40 u in each coordinate, and the translation has an error below u. The sum of
/// the errors is below 2⁷ u.
pub(crate) const POSE_ERROR: f64 = 1.0 / (1u64 << 46) as f64;

/// Error bound of the difference between a joint position in a certificate and the position by its mimic rule, for each joint of the
/// chain of rules. It is a fraction of the magnitudes of the numbers in the rule.
///
/// Let u = 2⁻⁵³. Both positions are sums of a start and a rate, with errors below 3 u times both ends. The rule is one product and one
/// sum for each joint of the chain, with errors below 4 u. The sum of the errors is below 2⁴ u.
pub(crate) const POSITION_ERROR: f64 = 1.0 / (1u64 << 49) as f64;
