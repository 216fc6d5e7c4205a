//! The exact height of a turning point along a fixed axis, as a function of time.

use crate::math::order::lesser;
use crate::math::vector::length;
use crate::rounding::RATE_ERROR_F64;
use glam::DVec3;
use std::f64::consts::{FRAC_2_PI, PI, TAU};

/// The height of a moving point along a fixed axis as a function of time, `height + linear_rate τ + linear_acceleration
/// τ²/2 + (cos ωτ − 1) p + sin ωτ q`.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct HeightFunction {
    height: f64,
    linear_rate: f64,
    linear_acceleration: f64,
    p: f64,
    q: f64,
    angular_speed: f64,
}

impl HeightFunction {
    #[inline]
    pub(crate) fn height_at(&self, tau: f64, angle: AngleSinCos) -> f64 {
        let linear_displacement = (self.linear_rate + 0.5 * self.linear_acceleration * tau) * tau;
        self.height + linear_displacement + angle.cos_minus_one * self.p + angle.sin * self.q
    }

    #[inline]
    pub(crate) fn rate_at(&self, tau: f64, angle: AngleSinCos) -> f64 {
        self.linear_rate
            + self.linear_acceleration * tau
            + self.angular_speed * (angle.cos * self.q - angle.sin * self.p)
    }

    /// Returns a lower bound of the point's height on `[0, horizon]` from rotation alone, without `linear_rate` and
    /// `linear_acceleration`. `end` is the rotation at `horizon`.
    pub(crate) fn least_rotational_height(&self, horizon: f64, end: AngleSinCos) -> f64 {
        let swing = (self.p * self.p + self.q * self.q).sqrt();
        let turn = self.angular_speed * horizon;
        // Written so that NaN is a full turn.
        let turned = if turn < TAU && !self.passes_lowest_point(turn, end) {
            lesser(0.0, end.cos_minus_one * self.p + end.sin * self.q)
        } else {
            -self.p - swing
        };
        // The angle at the end is rounded, too.
        self.height + (turned - RATE_ERROR_F64 * swing * (1.0 + turn))
    }

    /// Returns whether the point passes the lowest point of its circle before the end of a rotation by less than 2π.
    fn passes_lowest_point(&self, turn: f64, end: AngleSinCos) -> bool {
        // The lowest point is at the angle of (−p, −q). It is compared to the start and to the end of the turn.
        let (after_start, before_end) = (-self.q, self.q * end.cos - self.p * end.sin);
        if turn < PI {
            after_start > 0.0 && before_end > 0.0
        } else {
            after_start > 0.0 || before_end > 0.0
        }
    }

    /// Returns an upper bound of the second derivative due to rotation.
    #[inline]
    pub(crate) fn second_derivative_bound(&self) -> f64 {
        self.angular_speed * self.angular_speed * (self.p * self.p + self.q * self.q).sqrt()
    }
}

/// The motion along one axis that all points of a body have in common.
#[derive(Clone, Copy, Debug)]
pub(crate) struct MotionAlongAxis {
    /// The present velocity along the axis, without rotation.
    pub(crate) linear_rate: f64,
    /// The acceleration along the axis, without rotation.
    pub(crate) linear_acceleration: f64,
    /// The component of `n` perpendicular to the axis of rotation.
    normal_part_across_axis: DVec3,
    /// The cross product `n × u`, with the direction `u` of the axis of rotation.
    normal_cross_axis: DVec3,
    angular_speed: f64,
}

impl MotionAlongAxis {
    /// Creates the motion along `n`; `unit` is the direction of the axis of rotation, or zero without rotation.
    #[inline]
    pub(crate) fn new(linear: DVec3, unit: DVec3, omega: f64, n: DVec3) -> Self {
        MotionAlongAxis {
            linear_rate: linear.dot(n),
            linear_acceleration: 0.0,
            normal_part_across_axis: n - n.dot(unit) * unit,
            normal_cross_axis: n.cross(unit),
            angular_speed: omega,
        }
    }

    /// Sets the second derivative that the heights of all points have in common.
    pub(crate) fn with_acceleration(self, linear_acceleration: f64) -> Self {
        MotionAlongAxis {
            linear_acceleration,
            ..self
        }
    }

    /// Returns the displacement along the axis after `tau`, without rotation.
    #[inline]
    pub(crate) fn linear_displacement(&self, tau: f64) -> f64 {
        (self.linear_rate + 0.5 * self.linear_acceleration * tau) * tau
    }

    /// Returns an upper bound of the second derivative of heights due to rotation, for points at most `distance` from
    /// the axis of rotation.
    #[inline]
    pub(crate) fn second_derivative(&self, distance: f64) -> f64 {
        self.angular_speed * self.angular_speed * length(self.normal_part_across_axis) * distance
    }

    #[inline]
    pub(crate) fn height_function_of_point(&self, height: f64, arm: DVec3) -> HeightFunction {
        HeightFunction {
            height,
            linear_rate: self.linear_rate,
            linear_acceleration: self.linear_acceleration,
            p: self.normal_part_across_axis.dot(arm),
            q: self.normal_cross_axis.dot(arm),
            angular_speed: self.angular_speed,
        }
    }
}

/// The sine and cosine of an angle, and the cosine minus one without cancellation.
#[derive(Clone, Copy, Debug)]
pub(crate) struct AngleSinCos {
    sin: f64,
    cos: f64,
    cos_minus_one: f64,
}

impl AngleSinCos {
    pub(crate) const ZERO: AngleSinCos = AngleSinCos {
        sin: 0.0,
        cos: 1.0,
        cos_minus_one: 0.0,
    };

    #[inline]
    pub(crate) fn new(theta: f64) -> Self {
        let (s, c) = (0.5 * theta).sin_cos();
        let cos_minus_one = -2.0 * s * s;
        AngleSinCos {
            sin: 2.0 * s * c,
            cos: 1.0 + cos_minus_one,
            cos_minus_one,
        }
    }
}

/// A vector that turns about an axis at a constant rate.
#[derive(Clone, Copy, Debug)]
pub(crate) struct RotatingVector {
    start_vector: DVec3,
    /// The component of the vector perpendicular to the axis.
    perpendicular_part: DVec3,
    /// The cross product `u × v` of the axis and the vector.
    cross_product: DVec3,
}

impl RotatingVector {
    /// Creates a rotating vector from its value at the start; `unit` is the direction of the axis of rotation, or zero if
    /// nothing rotates.
    #[inline]
    pub(crate) fn new(unit: DVec3, start: DVec3) -> Self {
        RotatingVector {
            start_vector: start,
            perpendicular_part: start - start.dot(unit) * unit,
            cross_product: unit.cross(start),
        }
    }

    #[inline]
    pub(crate) fn vector_at(&self, angle: AngleSinCos) -> DVec3 {
        self.start_vector
            + self.perpendicular_part * angle.cos_minus_one
            + self.cross_product * angle.sin
    }

    /// Returns the derivative of the rotating vector with respect to its angle.
    #[inline]
    pub(crate) fn derivative_at_angle(&self, angle: AngleSinCos) -> DVec3 {
        self.cross_product * angle.cos - self.perpendicular_part * angle.sin
    }

    /// Returns the length of the derivative, which is constant.
    #[inline]
    pub(crate) fn derivative_length(&self) -> f64 {
        self.cross_product.length()
    }
}

/// π/2 as a sum of three numbers; products of the first two with an integer below 2²⁰ are exact.
const HALF_PI_PARTS: [f64; 3] = [
    f64::from_bits(0x3ff9_21fb_5440_0000),
    f64::from_bits(0x3dd0_b461_1a60_0000),
    f64::from_bits(0x3ba3_198a_2e03_7073),
];

/// Taylor coefficients of `(sin r − r)/r³` and of `(cos r − 1 + r²/2)/r⁴` in r². On |r| ≤ π/4 the
/// first omitted terms are below 2⁻⁵⁶.
const SINE_COEFFICIENTS: [f64; 7] = [
    -1.0 / 6.0,
    1.0 / 120.0,
    -1.0 / 5_040.0,
    1.0 / 362_880.0,
    -1.0 / 39_916_800.0,
    1.0 / 6_227_020_800.0,
    -1.0 / 1_307_674_368_000.0,
];
const COSINE_COEFFICIENTS: [f64; 7] = [
    1.0 / 24.0,
    -1.0 / 720.0,
    1.0 / 40_320.0,
    -1.0 / 3_628_800.0,
    1.0 / 479_001_600.0,
    -1.0 / 87_178_291_200.0,
    1.0 / 20_922_789_888_000.0,
];

/// Returns the sine and cosine of an angle from 0 up to [`MAX_ROTATION_ANGLE`](crate::limits::MAX_ROTATION_ANGLE).
///
/// # Guarantee
/// Each is off by at most 2u, as [`distance_rounding`](crate::rounding::distance_rounding) counts.
#[inline(always)]
pub(crate) fn sin_cos(angle: f64) -> (f64, f64) {
    // A number beyond 2⁵² has no fraction: the sum rounds to the nearest integer, which is in its lowest bits.
    let sum = angle * FRAC_2_PI + ROUNDING_SUMMAND;
    let (turns, quarter) = (sum.to_bits(), sum - ROUNDING_SUMMAND);
    // The first difference is exact, and the sum off by 2⁻⁶⁷ at most; the last step adds a relative 2⁻⁵³.
    let r = (angle - quarter * HALF_PI_PARTS[0])
        - (quarter * HALF_PI_PARTS[1] + quarter * HALF_PI_PARTS[2]);
    let square = r * r;
    let fourth = square * square;
    // The sum has few dependent steps, since a visit waits for its result.
    let sum = |&[a, b, c, d, e, f, g]: &[f64; 7]| {
        let low = (a + b * square) + (c + d * square) * fourth;
        low + ((e + f * square) + g * fourth) * (fourth * fourth)
    };
    let sine = r + r * square * sum(&SINE_COEFFICIENTS);
    let cosine = 1.0 - (0.5 * square - fourth * sum(&COSINE_COEFFICIENTS));
    let (sine, cosine) = if turns & 1 == 0 {
        (sine, cosine)
    } else {
        (cosine, -sine)
    };
    // Two quarters of a turn change both signs.
    let sign = (turns & 2) << 62;
    (
        f64::from_bits(sine.to_bits() ^ sign),
        f64::from_bits(cosine.to_bits() ^ sign),
    )
}

/// A number to which the addition of another rounds the other to an integer.
const ROUNDING_SUMMAND: f64 = 1.5 * (1u64 << 52) as f64;

#[cfg(test)]
mod tests;
