//! The prover's allowances for rounding, of its own computations in binary64 and of the checker's.

/// Error bound of a height or distance, as a fraction of the largest length, for each link and for each of both parts.
///
/// Each link and each part takes fewer than 200 operations on numbers below the largest length. Each operation rounds by at most
/// 2⁻⁵³.
pub(crate) const ROUNDING: f64 = 2e-14;

/// Factor that rounds a bound of a second derivative up.
///
/// The bound takes fewer than 1,000 operations on non-negative numbers. The checker also rounds each of these up by less than one
/// unit.
pub(crate) const SECOND_DERIVATIVE_FACTOR: f64 = 1.0 + 1e-12;

/// The largest sum of joint angles over half of an interval, in radians. The checker's limit is 2, after rounding up.
pub(crate) const MAX_ANGLE: f64 = 1.999;

/// Error bound of a point transformed by a pose, as a fraction of the lengths of the point and of the translation.
///
/// With u = 2⁻⁵³, the quaternion differs from unit length by less than 8 u, so the rotation scales by less than 1 + 16 u. Its 30
/// operations round each coordinate by less than 40 u, and the translation by less than u. The sum is below 2⁷ u.
pub(crate) const POSE_ERROR: f64 = 1.0 / (1u64 << 46) as f64;

/// Error bound of a joint position in a certificate against the joint's position rule, for each joint of the chain of rules. It is
/// a fraction of the numbers in the rule.
///
/// With u = 2⁻⁵³, both positions are a start plus a rate, with errors below 3 u of both ends. The rule is one product and one sum
/// for each followed joint, with errors below 4 u. The sum is below 2⁴ u.
pub(crate) const POSITION_ERROR: f64 = 1.0 / (1u64 << 49) as f64;
