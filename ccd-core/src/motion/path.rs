//! Motions in a problem's own units: time runs from 0 to 1, and the origin is near both bodies. Neither a far origin of
//! the world nor a long duration costs digits.

use super::Motion;
use super::bound::Velocities;
use super::pose::Frame;
use super::track::sin_cos;
use crate::math::order::greater;
use crate::math::vector::{length, unit};
use crate::rounding::LEAST_ROTATION;
use glam::{DMat3, DVec3};

/// A motion in a problem's units, with the rotation `R(s) = cos(ω s) A + sin(ω s) B + C` about a center at `start + s ·
/// velocity` `[FAST06 §4.1]`. On a stretch of a trajectory the center is displaced by `s²/2 · acceleration` as well.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Path {
    /// The coefficient of the cosine, `A = R₀ − C`.
    cosine_coefficient: DMat3,
    /// The coefficient of the sine, `B = [u]× R₀`.
    sine_coefficient: DMat3,
    /// The constant part, `C = u uᵀ R₀`.
    constant_part: DMat3,
    /// The center of rotation, in the body's frame.
    pub(crate) center: DVec3,
    /// The center's position at `s = 0`.
    start_position: DVec3,
    /// The center's velocity at `s = 0`, per unit of `s`.
    pub(crate) velocity: DVec3,
    /// The center's acceleration, which is constant; zero except on stretches of trajectories.
    pub(crate) acceleration: DVec3,
    /// The angular velocity per unit of `s`, in the world's frame.
    pub(crate) spin: DVec3,
    /// The angular velocity per unit of `s`, in the body's frame; it is constant.
    pub(crate) local_angular_velocity: DVec3,
    /// The angular speed, `|spin|`.
    pub(crate) angular_speed: f64,
    /// The unit vector along `spin`; zero if the body does not turn.
    pub(crate) axis: DVec3,
}

impl Path {
    pub(crate) fn new(motion: &Motion, origin: DVec3, duration: f64) -> Self {
        let start = Frame::from(motion.start());
        let spin = motion.angular_velocity() * duration;
        // A lesser rotation is lost in any rounding of positions, and that of a part of the path would underflow.
        let turns = length(spin) >= LEAST_ROTATION;
        let spin = if turns { spin } else { DVec3::ZERO };
        let rate = length(spin);
        let axis = unit(spin).unwrap_or(DVec3::ZERO);
        // The rotation of a body that does not turn has only the constant part.
        let [cosine, sine, constant] = if turns {
            let constant = outer_product(axis) * start.rotation;
            let sine = cross_matrix(axis) * start.rotation;
            [start.rotation - constant, sine, constant]
        } else {
            [DMat3::ZERO, DMat3::ZERO, start.rotation]
        };
        let velocity = motion.velocity() * duration;
        Path {
            cosine_coefficient: cosine,
            sine_coefficient: sine,
            constant_part: constant,
            center: motion.center(),
            start_position: (start.translation - origin) + start.rotation * motion.center(),
            velocity,
            acceleration: DVec3::ZERO,
            spin,
            local_angular_velocity: start.inverse_transform_vector(spin),
            angular_speed: rate,
            axis,
        }
    }

    /// Sets the acceleration of the center, per unit of `s` squared.
    pub(crate) fn with_acceleration(self, acceleration: DVec3) -> Self {
        Path {
            acceleration,
            ..self
        }
    }

    /// Returns the part of the path between two times, in units in which that part takes the times from 0 to 1.
    /// Positions are off by [`position_rounding`](crate::rounding::position_rounding) at most.
    pub(crate) fn subpath(&self, [from, to]: [f64; 2]) -> Self {
        let time = to - from;
        let (sin, cos) = sin_cos(self.angular_speed * from);
        Path {
            cosine_coefficient: self.cosine_coefficient * cos + self.sine_coefficient * sin,
            sine_coefficient: self.sine_coefficient * cos - self.cosine_coefficient * sin,
            start_position: self.center_at(from),
            velocity: self.center_velocity_at(from) * time,
            acceleration: self.acceleration * (time * time),
            spin: self.spin * time,
            local_angular_velocity: self.local_angular_velocity * time,
            angular_speed: self.angular_speed * time,
            ..*self
        }
    }

    /// Returns the coefficients `A`, `B` and `C` of the rotation `cos(ω s) A + sin(ω s) B + C`.
    pub(crate) fn rotation_coefficients(&self) -> [DMat3; 3] {
        [
            self.cosine_coefficient,
            self.sine_coefficient,
            self.constant_part,
        ]
    }

    /// Returns the body's frame at `s`.
    #[inline(always)]
    pub(crate) fn frame(&self, s: f64) -> Frame {
        let rotation = if self.angular_speed > 0.0 {
            let (sin, cos) = sin_cos(self.angular_speed * s);
            self.cosine_coefficient * cos + self.sine_coefficient * sin + self.constant_part
        } else {
            self.constant_part
        };
        Frame {
            rotation,
            translation: self.center_at(s) - rotation * self.center,
        }
    }

    /// Returns the position of the body's point `x` at time 0.
    pub(crate) fn point_at_start(&self, x: DVec3) -> DVec3 {
        self.start_position + (self.cosine_coefficient + self.constant_part) * (x - self.center)
    }

    /// Returns the position of the center of rotation at `s`.
    #[inline(always)]
    pub(crate) fn center_at(&self, s: f64) -> DVec3 {
        self.start_position + (self.velocity + self.acceleration * (0.5 * s)) * s
    }

    /// Returns the velocity of the center of rotation at `s`.
    #[inline(always)]
    pub(crate) fn center_velocity_at(&self, s: f64) -> DVec3 {
        self.velocity + self.acceleration * s
    }

    /// Returns an upper bound of the speed of the center of rotation at any time.
    pub(crate) fn speed_bound(&self) -> f64 {
        length(self.velocity) + length(self.acceleration)
    }

    /// Returns the velocity at `s` of the body's point that is then at the position `x`.
    #[inline]
    pub(crate) fn velocity_at(&self, x: DVec3, s: f64) -> DVec3 {
        self.center_velocity_at(s) + self.spin.cross(x - self.center_at(s))
    }

    /// Returns the center's velocity at `s = 0` and the angular velocity, per unit of `s`. An acceleration is not
    /// included.
    pub(crate) fn velocities(&self) -> Velocities {
        Velocities {
            linear_velocity: self.velocity,
            spin: self.spin,
        }
    }

    /// Returns the largest distance of points of the body from the axis of rotation. It is constant; 0 if the body does
    /// not turn.
    pub(crate) fn max_distance_from_axis(&self, points: &[DVec3]) -> f64 {
        if !self.is_turning() {
            return 0.0;
        }
        let axis = unit(self.local_angular_velocity).unwrap_or(DVec3::ZERO);
        let squares = points
            .iter()
            .map(|&x| axis.cross(x - self.center).length_squared());
        squares.fold(0.0, greater).sqrt()
    }

    pub(crate) fn is_turning(&self) -> bool {
        self.angular_speed > 0.0
    }

    pub(crate) fn moves(&self) -> bool {
        self.is_turning() || self.velocity != DVec3::ZERO || self.accelerates()
    }

    pub(crate) fn accelerates(&self) -> bool {
        self.acceleration != DVec3::ZERO
    }
}

/// Returns the outer product `u uᵀ`.
fn outer_product(u: DVec3) -> DMat3 {
    DMat3::from_cols(u * u.x, u * u.y, u * u.z)
}

/// Returns the cross product matrix `[u]×`.
fn cross_matrix(u: DVec3) -> DMat3 {
    DMat3::from_cols(
        DVec3::new(0.0, u.z, -u.y),
        DVec3::new(-u.z, 0.0, u.x),
        DVec3::new(u.y, -u.x, 0.0),
    )
}

#[cfg(test)]
mod tests;
