//! The relative motion of two bodies: at a time, and enclosed over an interval of time.

use crate::method::rival::interval::{Interval, IntervalMat, IntervalVec, SineCosineRange};
use crate::method::rival::{Placement, RivalMotion};
use ccd_core::glam::{DMat3, DVec3};

/// The motion of the first body in the frame of the second, each about a reference point.
///
/// For a point `x` of the first body relative to its reference point, `rotation(t) x + offset(t)`
/// is the same point relative to the reference point of the second body, along that body's axes.
#[derive(Clone, Copy, Debug)]
pub(super) struct Relative {
    first: BodyMotion,
    second: BodyMotion,
}

/// The motion of one body: `rotation(t) = fixed + cos(ωt) cos + sin(ωt) sin`. The reference point
/// moves likewise, plus a straight part.
#[derive(Clone, Copy, Debug)]
struct BodyMotion {
    fixed: DMat3,
    cos: DMat3,
    sin: DMat3,
    rate: f64,
    start_centre: DVec3,
    velocity: DVec3,
    /// The offset of the reference point from the centre, in the body's frame.
    lever: DVec3,
}

/// An enclosure of all placements of one body in the frame of another over an interval of time, or of their rates of
/// change.
#[derive(Clone, Copy, Debug)]
pub(super) struct Enclosure {
    pub(super) rotation: IntervalMat,
    pub(super) offset: IntervalVec,
}

/// An interval of time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Span {
    pub(super) start: f64,
    pub(super) end: f64,
}

impl Span {
    pub(super) fn width(self) -> f64 {
        self.end - self.start
    }

    pub(super) fn middle(self) -> f64 {
        self.start + 0.5 * (self.end - self.start)
    }
}

impl Relative {
    /// Combines the motions of two bodies, each with its reference point in the body's frame.
    pub(super) fn new(first: (&RivalMotion, DVec3), second: (&RivalMotion, DVec3)) -> Self {
        // The axes are those of the second body at the start: a body that does not rotate then needs no
        // inverse rotation.
        let axes = second.0.orientation.transpose();
        let mut relative = Relative {
            first: BodyMotion::new(first.0, first.1, axes),
            second: BodyMotion::new(second.0, second.1, axes),
        };
        // Only the difference of the linear parts matters; separate parts would be enclosed separately.
        relative.first.start_centre -= relative.second.start_centre;
        relative.first.velocity -= relative.second.velocity;
        relative.second.start_centre = DVec3::ZERO;
        relative.second.velocity = DVec3::ZERO;
        relative
    }

    /// Returns the placement of the first body in the second one's frame at a time.
    pub(super) fn at(&self, time: f64) -> Placement {
        let (first, position_first) = self.first.at(time);
        let (second, position_second) = self.second.at(time);
        let back = second.transpose();
        Placement {
            rotation: back * first,
            translation: back * (position_first - position_second),
        }
    }

    /// Returns an enclosure of all placements between two times.
    pub(super) fn enclosure_over(&self, span: Span) -> Enclosure {
        let (first, position_first) = self.first.over(span);
        if self.second.rate == 0.0 {
            let offset = position_first.minus_point(self.second.still_position());
            return Enclosure {
                rotation: first,
                offset,
            };
        }
        let (second, position_second) = self.second.over(span);
        let back = second.transpose();
        Enclosure {
            rotation: back * first,
            offset: back * (position_first - position_second),
        }
    }

    /// Returns an enclosure of all rates of change of the placements between two times.
    pub(super) fn rates_over(&self, span: Span) -> Enclosure {
        let (first_rate, position_first_rate) = self.first.rates_over(span);
        if self.second.rate == 0.0 {
            return Enclosure {
                rotation: first_rate,
                offset: position_first_rate,
            };
        }
        let (first, position_first) = self.first.over(span);
        let (second, position_second) = self.second.over(span);
        let (second_rate, position_second_rate) = self.second.rates_over(span);
        let (back, back_rate) = (second.transpose(), second_rate.transpose());
        Enclosure {
            rotation: back_rate * first + back * first_rate,
            offset: back_rate * (position_first - position_second)
                + back * (position_first_rate - position_second_rate),
        }
    }
}

impl BodyMotion {
    fn new(course: &RivalMotion, reference: DVec3, axes: DMat3) -> Self {
        let axis = axes * course.axis;
        let orientation = axes * course.orientation;
        let still = course.rate == 0.0;
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
        BodyMotion {
            fixed,
            cos,
            sin: map_columns(cos, |column| axis.cross(column)),
            rate: course.rate,
            start_centre: axes * course.from,
            velocity: axes * course.velocity,
            lever: reference - course.centre,
        }
    }

    /// Returns the position of the reference point of a body that does not rotate, without its linear motion.
    fn still_position(&self) -> DVec3 {
        self.start_centre + self.fixed * self.lever
    }

    fn at(&self, time: f64) -> (DMat3, DVec3) {
        let (sin, cos) = (self.rate * time).sin_cos();
        let rotation = self.fixed + self.cos * cos + self.sin * sin;
        let position = self.start_centre + self.velocity * time + rotation * self.lever;
        (rotation, position)
    }

    fn over(&self, span: Span) -> (IntervalMat, IntervalVec) {
        let half = 0.5 * span.width();
        let (cos, sin) = self.coefficients_at(span.middle());
        let arc = SineCosineRange::new(self.rate * half);
        let turning = rotation_over(cos, sin, arc);
        let rotation = IntervalMat {
            middle: self.fixed + turning.middle,
            radius: turning.radius,
        };
        let straight = self.start_centre + self.velocity * span.middle() + self.fixed * self.lever;
        let round = vector_rotation_over(cos * self.lever, sin * self.lever, arc);
        let position = IntervalVec {
            middle: straight + round.middle,
            radius: self.velocity.abs() * half + round.radius,
        };
        (rotation, position)
    }

    fn rates_over(&self, span: Span) -> (IntervalMat, IntervalVec) {
        let (cos, sin) = self.coefficients_at(span.middle());
        let arc = SineCosineRange::new(self.rate * 0.5 * span.width());
        let (cos, sin) = (sin * self.rate, cos * -self.rate);
        let round = vector_rotation_over(cos * self.lever, sin * self.lever, arc);
        let velocity = IntervalVec {
            middle: self.velocity + round.middle,
            radius: round.radius,
        };
        (rotation_over(cos, sin, arc), velocity)
    }

    /// Returns the coefficients of cosine and sine for an angle counted from the angle at `time`.
    fn coefficients_at(&self, time: f64) -> (DMat3, DMat3) {
        let (sin, cos) = (self.rate * time).sin_cos();
        (
            self.cos * cos + self.sin * sin,
            self.sin * cos - self.cos * sin,
        )
    }
}

fn map_columns(matrix: DMat3, map: impl Fn(DVec3) -> DVec3) -> DMat3 {
    DMat3::from_cols(map(matrix.x_axis), map(matrix.y_axis), map(matrix.z_axis))
}

/// Returns an enclosure of `cos(φ) cos + sin(φ) sin` for φ in the arc.
fn rotation_over(cos: DMat3, sin: DMat3, arc: SineCosineRange) -> IntervalMat {
    let Interval { middle, radius } = arc.cos;
    IntervalMat {
        middle: cos * middle,
        radius: cos.abs() * radius + sin.abs() * arc.sin,
    }
}

/// Returns an enclosure of `cos(φ) cos + sin(φ) sin` for φ in the arc, for vectors.
fn vector_rotation_over(cos: DVec3, sin: DVec3, arc: SineCosineRange) -> IntervalVec {
    let Interval { middle, radius } = arc.cos;
    IntervalVec {
        middle: cos * middle,
        radius: cos.abs() * radius + sin.abs() * arc.sin,
    }
}
