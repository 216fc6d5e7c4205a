//! What the prover, which computes in binary64, allows for rounding: its own, and that of the checker.

/// The share of the largest length that heights and distances may lose here for each link, and for each part as if it were one more: it
/// is placed by less than 200 operations on numbers that are no larger, and each loses 2⁻⁵³ at most.
pub(crate) const ROUNDING: f64 = 2e-14;

/// The factor by which bounds of second derivatives are increased: they are made of fewer than 1,000 operations on numbers that are not
/// negative, here and in the checker, which rounds each up by less than a unit besides.
pub(crate) const LENGTHS: f64 = 1.0 + 1e-12;

/// The largest sum of turns in half of a stretch, in radians. The checker has a limit of 2 for sums that it has rounded up.
pub(crate) const MOST_TURN: f64 = 1.999;

/// What placing a corner by a pose is off by at most, as a share of the lengths of the corner and of the translation.
///
/// With u = 2⁻⁵³: the quaternion is off by less than 8 u from one of unit length, so the rotation scales by less than 1 + 16 u.
/// Its 30 operations round to within 40 u in each coordinate, the sum to within u: in all less than 2⁷ u.
pub(crate) const PLACING: f64 = 1.0 / (1u64 << 46) as f64;

/// What a position of a joint at the end of a certificate is off by at most from the one that the rule of the joint gives, as a share
/// of the numbers that both are made of, for each joint that is followed.
///
/// With u = 2⁻⁵³: the position that is followed, and the one that follows, are sums of a start and a rate, which are off by less than
/// 3 u of both ends. The rule is a product and a sum for each joint that is followed, of less than 4 u. In all less than 2⁴ u.
pub(crate) const POSITION: f64 = 1.0 / (1u64 << 49) as f64;
