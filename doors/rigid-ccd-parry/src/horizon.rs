//! Replaces the unlimited duration of a cast by a finite one that decides it.
//!
//! Each body stays within a ball about its center, and centers move in straight lines. After the balls have passed each
//! other, no contact is possible. A periodic relative motion needs to be examined for one period only.

use crate::order::{greater, length, lesser};
use crate::tolerance::{LONGEST_DURATION, ROUNDING_ENLARGEMENT, USED_SHARE_OF_LIMITS};
use ccd_core::Motion;
use ccd_core::glam::DVec3;
use ccd_core::limits::{MAX_COORDINATE, MAX_ROTATION_ANGLE};
use std::f64::consts::TAU;

/// A body's motion, and a ball that contains the body and whose center moves straight.
#[derive(Clone, Copy, Debug)]
pub(crate) struct MotionWithExtent {
    pub(crate) motion: Motion,
    /// A point of the body, in its frame, that moves in a straight line.
    pub(crate) about: DVec3,
    /// The largest distance of the body's points from `about`.
    pub(crate) max_radius: f64,
}

impl MotionWithExtent {
    /// Returns the position of the point `about` at the start, in the world frame.
    pub(crate) fn start_position(&self) -> DVec3 {
        self.motion.start().transform_point(self.about)
    }

    /// Returns the sum of the lengths from which the position is computed, for a bound on its rounding error.
    pub(crate) fn position_magnitude_sum(&self) -> f64 {
        length(self.motion.start().translation()) + length(self.about)
    }
}

/// The duration of the query that stands for a cast.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum QueryDuration {
    /// The duration decides the whole cast: bodies that stay apart for this duration stay apart for the whole requested
    /// time.
    WholeCast(f64),
    /// The duration is a part of the cast: the longest that the engine accepts.
    PartOfCast(f64),
}

impl QueryDuration {
    pub(crate) fn duration(self) -> f64 {
        match self {
            QueryDuration::WholeCast(duration) | QueryDuration::PartOfCast(duration) => duration,
        }
    }

    /// Returns the duration of the engine's query for a cast of two bodies over a duration, with the contact distance `within`.
    pub(crate) fn new(bodies: [MotionWithExtent; 2], within: f64, duration: f64) -> Self {
        let needed = [
            time_when_past_each_other(bodies, within),
            repetition_time(bodies),
        ];
        QueryDuration::for_duration(bodies, needed.into_iter().flatten().fold(duration, lesser))
    }

    /// Returns a query of the duration `needed`, which decides the whole cast, or a query of the longest accepted duration
    /// if that is shorter.
    pub(crate) fn for_duration(bodies: [MotionWithExtent; 2], needed: f64) -> Self {
        let longest = longest_duration(bodies);
        if needed <= longest {
            QueryDuration::WholeCast(needed)
        } else {
            QueryDuration::PartOfCast(longest)
        }
    }
}

/// Returns a time after which the bodies can no longer meet; `None` if their velocities are equal.
fn time_when_past_each_other(bodies: [MotionWithExtent; 2], within: f64) -> Option<f64> {
    let [a, b] = bodies.map(|body| body.motion.velocity());
    let speed = length(b - a);
    (speed > 0.0).then(|| max_relative_displacement(&bodies, within) / speed * ROUNDING_ENLARGEMENT)
}

/// Returns a bound on the relative displacement of the bodies, from the start until contact is no longer possible.
pub(crate) fn max_relative_displacement([a, b]: &[MotionWithExtent; 2], within: f64) -> f64 {
    let rounding =
        (ROUNDING_ENLARGEMENT - 1.0) * (a.position_magnitude_sum() + b.position_magnitude_sum());
    length(b.start_position() - a.start_position())
        + rounding
        + a.max_radius
        + b.max_radius
        + within
}

/// Returns a time after which the relative poses repeat; `None` if the velocities differ, or the bodies rotate
/// differently.
pub(crate) fn repetition_time(bodies: [MotionWithExtent; 2]) -> Option<f64> {
    let [a, b] = bodies.map(|body| body.motion);
    let is_one_still = a.angular_velocity() == DVec3::ZERO || b.angular_velocity() == DVec3::ZERO;
    // Two bodies that both turn repeat their poses if they do so about parallel axes, at one rate.
    let repeats = a.velocity() == b.velocity()
        && (is_one_still || a.angular_velocity() == b.angular_velocity());
    repeats.then(|| {
        greater(
            rotation_period(a.angular_velocity()),
            rotation_period(b.angular_velocity()),
        )
    })
}

/// Returns the time of a whole turn, rounded up; 0 without rotation.
pub(crate) fn rotation_period(angular_velocity: DVec3) -> f64 {
    if angular_velocity == DVec3::ZERO {
        0.0
    } else {
        TAU / length(angular_velocity) * ROUNDING_ENLARGEMENT
    }
}

/// Returns the longest duration for which the engine accepts both motions.
fn longest_duration(bodies: [MotionWithExtent; 2]) -> f64 {
    // The engine's origin is at one of the bodies.
    let origins = bodies.map(|body| body.motion.start().translation());
    let longest_of = |body: &MotionWithExtent| {
        let motion = &body.motion;
        let center = motion.start().transform_point(motion.center());
        let distances = origins.map(|origin| length(center - origin));
        let free_length =
            MAX_COORDINATE * USED_SHARE_OF_LIMITS - greater(distances[0], distances[1]);
        let (speed, rate) = (length(motion.velocity()), length(motion.angular_velocity()));
        let translation_limit = if speed > 0.0 {
            greater(free_length, 0.0) / speed
        } else {
            LONGEST_DURATION
        };
        let rotation_limit = if rate > 0.0 {
            MAX_ROTATION_ANGLE * USED_SHARE_OF_LIMITS / rate
        } else {
            LONGEST_DURATION
        };
        lesser(translation_limit, rotation_limit)
    };
    bodies.iter().map(longest_of).fold(LONGEST_DURATION, lesser)
}

#[cfg(test)]
mod tests;
