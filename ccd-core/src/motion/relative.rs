//! The motion of one body in the frame of another.

use super::kind::MotionKind;
use super::path::Path;
use super::track::sin_cos;
use crate::math::simd::{PackedMatrix, PackedVector, PaddedVec3, pad_vector, padded_columns};
use fearless_simd::Simd;
use glam::{DMat3, DVec3};

/// The motion of one body, the seen body, in the frame of another, the seeing body. It is prepared once for each query.
///
/// If only one of the two turns, the view is a sum of three constant parts: factors of cosine, of sine and of one, as
/// in the rotation of a single [`Path`].
#[derive(Clone, Debug)]
pub(crate) struct RelativePath {
    motion_terms: RelativeMotionTerms,
    /// The center of rotation of the seeing body, in that body's frame.
    center: PaddedVec3,
    other_rotation_center: PaddedVec3,
}

#[derive(Clone, Debug)]
enum RelativeMotionTerms {
    AtMostOneTurns {
        rotation: RotatingQuantity<[PaddedVec3; 3]>,
        /// The vector between the centers of rotation at `s = 0`, in the seeing body's frame over time.
        offset: RotatingQuantity<PaddedVec3>,
        offset_rate: RotatingQuantity<PaddedVec3>,
        acceleration: Option<RotatingQuantity<PaddedVec3>>,
        spin: PaddedVec3,
    },
    /// Both bodies turn; vectors are in the world's frame. Vectors are along the axes of the world.
    BothTurn {
        /// The inverse of the seeing body's rotation.
        inverse: RotatingQuantity<[PaddedVec3; 3]>,
        other_rotation: RotatingQuantity<[PaddedVec3; 3]>,
        offset: PaddedVec3,
        offset_rate: PaddedVec3,
        acceleration: Option<PaddedVec3>,
        spin: PaddedVec3,
    },
}

/// A vector or a matrix that turns at a constant rate: `cos(ω s) P + sin(ω s) Q + K`.
#[derive(Clone, Copy, Debug)]
struct RotatingQuantity<T> {
    angular_speed: f64,
    coefficients: [T; 3],
}

/// The relative motion of two bodies at an instant, in the seeing body's frame.
#[derive(Clone, Copy, Debug)]
pub(crate) struct RelativeState<L: Simd> {
    /// The rotation from the seen body's frame to the seeing body's.
    pub(crate) rotation: PackedMatrix<L>,
    /// The vector from the seeing body's center of rotation to the seen body's.
    pub(crate) offset: PackedVector<L>,
    /// The velocity of the seeing body's center of rotation minus that of the seen body's.
    pub(crate) velocity: PackedVector<L>,
    /// The derivative of `velocity`; `None` if both centers accelerate equally.
    pub(crate) acceleration: Option<PackedVector<L>>,
    /// The angular velocity of the seen body.
    pub(crate) spin: PackedVector<L>,
}

impl RelativePath {
    /// Prepares the motion of `other` in the frame of `own`.
    pub(crate) fn new(own: &Path, other: &Path) -> Self {
        let offset = other.center_at(0.0) - own.center_at(0.0);
        let change = other.velocity - own.velocity;
        let acceleration = other.acceleration - own.acceleration;
        let acceleration = (acceleration != DVec3::ZERO).then_some(acceleration);
        let inverse = own.rotation_coefficients().map(|part| part.transpose());
        let seen = if own.is_turning() && other.is_turning() {
            RelativeMotionTerms::BothTurn {
                inverse: RotatingQuantity::new(own.angular_speed, inverse),
                other_rotation: RotatingQuantity::new(
                    other.angular_speed,
                    other.rotation_coefficients(),
                ),
                offset: pad_vector(offset),
                offset_rate: pad_vector(change),
                acceleration: acceleration.map(pad_vector),
                spin: pad_vector(other.spin),
            }
        } else {
            RelativeMotionTerms::for_at_most_one_turning(
                own,
                other,
                inverse,
                [offset, change],
                acceleration,
            )
        };
        RelativePath {
            motion_terms: seen,
            center: pad_vector(own.center),
            other_rotation_center: pad_vector(other.center),
        }
    }

    #[inline(always)]
    pub(crate) fn state_at<L: Simd, K: MotionKind>(&self, level: L, s: f64) -> RelativeState<L> {
        match &self.motion_terms {
            RelativeMotionTerms::AtMostOneTurns {
                rotation,
                offset,
                offset_rate: change,
                acceleration,
                spin,
            } => {
                // Without rotation, the sine and the cosine are those of 0.
                let angle = if K::SPLIT_BODY.is_possible() || K::OTHER_BODY.is_possible() {
                    sin_cos(rotation.angular_speed * s)
                } else {
                    (0.0, 1.0)
                };
                let acceleration = acceleration
                    .filter(|_| K::MAY_ACCELERATE)
                    .map(|change| change.vector_at_angle(level, angle));
                let [travel, change] = displacement_and_velocity(
                    change.vector_at_angle(level, angle),
                    acceleration,
                    s,
                );
                RelativeState {
                    rotation: rotation.matrix(level, angle),
                    offset: offset.vector_at_angle(level, angle) + travel,
                    velocity: -change,
                    acceleration: acceleration.map(|acceleration| -acceleration),
                    spin: PackedVector::load(level, spin),
                }
            }
            RelativeMotionTerms::BothTurn {
                inverse,
                other_rotation: other,
                offset,
                offset_rate: change,
                acceleration,
                spin,
            } if K::SPLIT_BODY.is_possible() && K::OTHER_BODY.is_possible() => {
                let inverse = inverse.matrix(level, sin_cos(inverse.angular_speed * s));
                let other = other.matrix(level, sin_cos(other.angular_speed * s));
                let acceleration = acceleration
                    .filter(|_| K::MAY_ACCELERATE)
                    .map(|change| PackedVector::load(level, &change));
                let [travel, change] =
                    displacement_and_velocity(PackedVector::load(level, change), acceleration, s);
                RelativeState {
                    rotation: inverse * other,
                    offset: inverse * (PackedVector::load(level, offset) + travel),
                    velocity: inverse * -change,
                    acceleration: acceleration.map(|acceleration| inverse * -acceleration),
                    spin: inverse * PackedVector::load(level, spin),
                }
            }
            RelativeMotionTerms::BothTurn { .. } => unreachable!("one body turns at most"),
        }
    }

    /// Returns the center of rotation of the body in whose frame the motion is seen.
    #[inline(always)]
    pub(crate) fn rotation_center<L: Simd>(&self, level: L) -> PackedVector<L> {
        PackedVector::load(level, &self.center)
    }

    /// Returns the center of rotation of the seen body, in its frame.
    #[inline(always)]
    pub(crate) fn other_rotation_center<L: Simd>(&self, level: L) -> PackedVector<L> {
        PackedVector::load(level, &self.other_rotation_center)
    }
}

impl RelativeMotionTerms {
    /// Prepares the relative motion if at most one of the bodies turns. The rotation of the other one has only the
    /// constant part.
    fn for_at_most_one_turning(
        own: &Path,
        other: &Path,
        inverse: [DMat3; 3],
        offset: [DVec3; 2],
        acceleration: Option<DVec3>,
    ) -> Self {
        let others = other.rotation_coefficients();
        let rate = if other.is_turning() {
            other.angular_speed
        } else {
            own.angular_speed
        };
        let rotation = [0, 1, 2].map(|k| {
            if other.is_turning() {
                inverse[2] * others[k]
            } else {
                inverse[k] * others[2]
            }
        });
        let seen = |v: DVec3| RotatingQuantity {
            angular_speed: rate,
            coefficients: inverse.map(|part| pad_vector(part * v)),
        };
        let [offset, change] = offset.map(seen);
        RelativeMotionTerms::AtMostOneTurns {
            rotation: RotatingQuantity::new(rate, rotation),
            offset,
            offset_rate: change,
            acceleration: acceleration.map(seen),
            spin: pad_vector(inverse[2] * other.spin),
        }
    }
}

impl RotatingQuantity<[PaddedVec3; 3]> {
    fn new(rate: f64, parts: [DMat3; 3]) -> Self {
        RotatingQuantity {
            angular_speed: rate,
            coefficients: parts.map(padded_columns),
        }
    }

    #[inline(always)]
    fn matrix<L: Simd>(&self, level: L, angle: (f64, f64)) -> PackedMatrix<L> {
        let [p, q, k] = &self.coefficients;
        let column = |j: usize| rotating_vector_at(level, [&p[j], &q[j], &k[j]], angle);
        PackedMatrix::new([column(0), column(1), column(2)])
    }
}

impl RotatingQuantity<PaddedVec3> {
    #[inline(always)]
    fn vector_at_angle<L: Simd>(&self, level: L, angle: (f64, f64)) -> PackedVector<L> {
        let [p, q, k] = &self.coefficients;
        rotating_vector_at(level, [p, q, k], angle)
    }
}

/// Returns the displacement until `s`, and the velocity at `s`, for a constant acceleration.
#[inline(always)]
fn displacement_and_velocity<L: Simd>(
    change: PackedVector<L>,
    acceleration: Option<PackedVector<L>>,
    s: f64,
) -> [PackedVector<L>; 2] {
    match acceleration {
        Some(acceleration) => [
            (change + acceleration * (0.5 * s)) * s,
            change + acceleration * s,
        ],
        None => [change * s, change],
    }
}

#[inline(always)]
fn rotating_vector_at<L: Simd>(
    level: L,
    [p, q, k]: [&PaddedVec3; 3],
    (sin, cos): (f64, f64),
) -> PackedVector<L> {
    PackedVector::load(level, p) * cos
        + PackedVector::load(level, q) * sin
        + PackedVector::load(level, k)
}

#[cfg(test)]
mod tests;
