//! Computes the relative motion of two bodies at a time, and encloses it over an interval of time.

use crate::method::rival::interval::{Interval, IntervalMat, IntervalVec, SineCosineRange};
use crate::method::rival::{Placement, RivalMotion};
use ccd_core::glam::{DMat3, DVec3};
use std::ops::{Add, Mul};

/// The motion of the first body in the frame of the second, with positions relative to a reference point of each body.
///
/// For a point `x` of the first body relative to its reference point, `rotation(t) x + offset(t)`
/// is the same point relative to the reference point of the second body, along that body's axes.
#[derive(Clone, Copy, Debug)]
pub(super) struct RelativeMotion {
    first_motion: MotionCoefficients,
    second_motion: MotionCoefficients,
}

/// The motion of one body: `rotation(t) = constant_term + cos(ωt) cosine_coefficient + sin(ωt) sine_coefficient`. The
/// reference point moves likewise, plus a straight part.
#[derive(Clone, Copy, Debug)]
struct MotionCoefficients {
    constant_term: DMat3,
    cosine_coefficient: DMat3,
    sine_coefficient: DMat3,
    angular_speed: f64,
    start_center: DVec3,
    velocity: DVec3,
    /// The offset of the reference point from the center, in the body's frame.
    reference_offset: DVec3,
}

/// An enclosure of all placements of one body in the frame of another over an interval of time, or of their rates of
/// change.
#[derive(Clone, Copy, Debug)]
pub(super) struct MotionEnclosure {
    pub(super) rotation: IntervalMat,
    pub(super) offset: IntervalVec,
}

/// An interval of time, from `start` to `end`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct TimeSpan {
    pub(super) start: f64,
    pub(super) end: f64,
}

impl TimeSpan {
    pub(super) fn width(self) -> f64 {
        self.end - self.start
    }

    pub(super) fn middle(self) -> f64 {
        self.start + 0.5 * (self.end - self.start)
    }
}

impl RelativeMotion {
    /// Creates the relative motion of two bodies, each given by its motion and a reference point in its frame.
    pub(super) fn new(first: (&RivalMotion, DVec3), second: (&RivalMotion, DVec3)) -> Self {
        // The axes are those of the second body at the start: a body that does not rotate then needs no
        // inverse rotation.
        let axes = second.0.start_orientation.transpose();
        let mut relative = RelativeMotion {
            first_motion: MotionCoefficients::new(first.0, first.1, axes),
            second_motion: MotionCoefficients::new(second.0, second.1, axes),
        };
        // Only the difference of the linear parts matters; separate parts would be enclosed separately.
        relative.first_motion.start_center -= relative.second_motion.start_center;
        relative.first_motion.velocity -= relative.second_motion.velocity;
        relative.second_motion.start_center = DVec3::ZERO;
        relative.second_motion.velocity = DVec3::ZERO;
        relative
    }

    /// Returns the placement of the first body in the second one's frame at a time.
    pub(super) fn placement_at(&self, time: f64) -> Placement {
        let (first, position_first) = self.first_motion.pose_at(time);
        let (second, position_second) = self.second_motion.pose_at(time);
        let back = second.transpose();
        Placement {
            rotation: back * first,
            translation: back * (position_first - position_second),
        }
    }

    /// Returns an enclosure of all placements between two times.
    pub(super) fn enclosure_over(&self, span: TimeSpan) -> MotionEnclosure {
        let (first, position_first) = self.first_motion.enclosure_over(span);
        if self.second_motion.angular_speed == 0.0 {
            let offset =
                position_first.minus_point(self.second_motion.non_rotating_reference_position());
            return MotionEnclosure {
                rotation: first,
                offset,
            };
        }
        let (second, position_second) = self.second_motion.enclosure_over(span);
        let back = second.transpose();
        MotionEnclosure {
            rotation: back * first,
            offset: back * (position_first - position_second),
        }
    }

    /// Returns an enclosure of all rates of change of the placements between two times.
    pub(super) fn rate_enclosure_over(&self, span: TimeSpan) -> MotionEnclosure {
        let (first_rate, position_first_rate) = self.first_motion.rate_enclosures_over(span);
        if self.second_motion.angular_speed == 0.0 {
            return MotionEnclosure {
                rotation: first_rate,
                offset: position_first_rate,
            };
        }
        let (first, position_first) = self.first_motion.enclosure_over(span);
        let (second, position_second) = self.second_motion.enclosure_over(span);
        let (second_rate, position_second_rate) = self.second_motion.rate_enclosures_over(span);
        let (back, back_rate) = (second.transpose(), second_rate.transpose());
        MotionEnclosure {
            rotation: back_rate * first + back * first_rate,
            offset: back_rate * (position_first - position_second)
                + back * (position_first_rate - position_second_rate),
        }
    }
}

impl MotionCoefficients {
    fn new(course: &RivalMotion, reference: DVec3, axes: DMat3) -> Self {
        let axis = axes * course.axis;
        let orientation = axes * course.start_orientation;
        let still = course.angular_speed == 0.0;
        // The part along the axis is fixed; the rest rotates.
        let along = |column: DVec3| {
            if still {
                column
            } else {
                axis * axis.dot(column)
            }
        };
        let fixed = map_columns(orientation, along);
        let cos = orientation - fixed;
        MotionCoefficients {
            constant_term: fixed,
            cosine_coefficient: cos,
            sine_coefficient: map_columns(cos, |column| axis.cross(column)),
            angular_speed: course.angular_speed,
            start_center: axes * course.start_position,
            velocity: axes * course.velocity,
            reference_offset: reference - course.center,
        }
    }

    /// Returns the start position of the reference point of a body that does not rotate.
    fn non_rotating_reference_position(&self) -> DVec3 {
        self.start_center + self.constant_term * self.reference_offset
    }

    fn pose_at(&self, time: f64) -> (DMat3, DVec3) {
        let (sin, cos) = (self.angular_speed * time).sin_cos();
        let rotation =
            self.constant_term + self.cosine_coefficient * cos + self.sine_coefficient * sin;
        let position = self.start_center + self.velocity * time + rotation * self.reference_offset;
        (rotation, position)
    }

    fn enclosure_over(&self, span: TimeSpan) -> (IntervalMat, IntervalVec) {
        let half = 0.5 * span.width();
        let (cos, sin) = self.rebased_coefficients_at(span.middle());
        let arc = SineCosineRange::new(self.angular_speed * half);
        let (turning, round) = self.enclose_rotation_over_arc(cos, sin, arc);
        let rotation = IntervalMat {
            middle: self.constant_term + turning.middle,
            radius: turning.radius,
        };
        let straight = self.start_center
            + self.velocity * span.middle()
            + self.constant_term * self.reference_offset;
        let position = IntervalVec {
            middle: straight + round.middle,
            radius: self.velocity.abs() * half + round.radius,
        };
        (rotation, position)
    }

    fn rate_enclosures_over(&self, span: TimeSpan) -> (IntervalMat, IntervalVec) {
        let (cos, sin) = self.rebased_coefficients_at(span.middle());
        let arc = SineCosineRange::new(self.angular_speed * 0.5 * span.width());
        let (cos, sin) = (sin * self.angular_speed, cos * -self.angular_speed);
        let (turning_rate, round) = self.enclose_rotation_over_arc(cos, sin, arc);
        let velocity = IntervalVec {
            middle: self.velocity + round.middle,
            radius: round.radius,
        };
        (turning_rate, velocity)
    }

    /// Returns enclosures of a rotation, given by its coefficients, and of the reference point that it rotates, for all
    /// angles in the arc.
    fn enclose_rotation_over_arc(
        &self,
        cos: DMat3,
        sin: DMat3,
        arc: SineCosineRange,
    ) -> (IntervalMat, IntervalVec) {
        let [cos_point, sin_point] = [cos, sin].map(|part| part * self.reference_offset);
        (
            enclose_sinusoid_over_arc(cos, [cos.abs(), sin.abs()], arc),
            enclose_sinusoid_over_arc(cos_point, [cos_point.abs(), sin_point.abs()], arc),
        )
    }

    /// Returns the coefficients of cosine and sine for a rotation angle that is counted from the angle at `time`.
    fn rebased_coefficients_at(&self, time: f64) -> (DMat3, DMat3) {
        let (sin, cos) = (self.angular_speed * time).sin_cos();
        (
            self.cosine_coefficient * cos + self.sine_coefficient * sin,
            self.sine_coefficient * cos - self.cosine_coefficient * sin,
        )
    }
}

fn map_columns(matrix: DMat3, map: impl Fn(DVec3) -> DVec3) -> DMat3 {
    DMat3::from_cols(map(matrix.x_axis), map(matrix.y_axis), map(matrix.z_axis))
}

/// Returns an enclosure of `cos(φ) cos + sin(φ) sin` for all angles φ in the arc, given the coefficients `cos` and
/// `sin`, and the absolute values of both.
#[inline]
fn enclose_sinusoid_over_arc<T>(
    cos: T,
    [cos_abs, sin_abs]: [T; 2],
    arc: SineCosineRange,
) -> Interval<T>
where
    T: Add<Output = T> + Mul<f64, Output = T>,
{
    Interval {
        middle: cos * arc.cos.middle,
        radius: cos_abs * arc.cos.radius + sin_abs * arc.sin_radius,
    }
}
