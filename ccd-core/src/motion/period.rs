//! Finds periods after which two turning bodies are in the same relative pose again, or nearly.
//!
//! After a time `T`, a body that turns at a rate `ω` has its former orientation, turned by `ε = |ω T − 2π p|` for the
//! nearest whole number of turns `p`; after `k` such times, turned by `k ε`. A point at a distance of at most `ρ`
//! from the center of rotation is then within `k ε ρ` of its former place, relative to the center. The center of one
//! body moves relative to the other's by at most `(|v| + |a|) k T` in that time, with `v` and `a` the difference of
//! their velocities and accelerations, and times from 0 to 1. No distance of a point of one body from a point of the
//! other changes by more than the sum, which is `k` times that of a period. A bound of all distances in one period
//! therefore holds for the `k` periods from there, up to that change.
//!
//! If both bodies turn, a period has to be nearly a whole number of turns of each. The best fractions for the ratio
//! of their rates are the convergents of its continued fraction.

use super::path::Path;
use crate::math::vector::length;
use crate::rounding::{RATE_ERROR_F64, TURN_COUNT_WIDENING};
use std::f64::consts::TAU;

/// A time after which all distances of two bodies repeat, or nearly.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Period {
    /// The length of the period, in units of the paths' time.
    pub(crate) length: f64,
    /// A bound of the change of any distance after one period; after `k` periods the bound is `k` times that. The
    /// rounding of the rates comes in addition, see [`position_rounding`](crate::rounding::position_rounding).
    pub(crate) max_distance_change: f64,
}

/// A body's path, with the largest distance of its points from the center of rotation.
#[derive(Clone, Copy, Debug)]
pub(crate) struct PathWithRadius<'p> {
    pub(crate) path: &'p Path,
    pub(crate) reach: f64,
}

impl Period {
    /// Returns the periods that fit twice into the whole time, in ascending order. After longer periods, distances
    /// change less.
    pub(crate) fn periods_up_to_half_duration(
        bodies: [PathWithRadius<'_>; 2],
    ) -> impl Iterator<Item = Period> {
        let [a, b] = bodies;
        let [slow, fast] = if a.path.angular_speed > b.path.angular_speed {
            [b, a]
        } else {
            [a, b]
        };
        let velocity = length(a.path.velocity - b.path.velocity);
        let speed = velocity + length(a.path.acceleration - b.path.acceleration);
        convergents(slow.path.angular_speed / fast.path.angular_speed)
            .map(move |[of_slow, of_fast]| {
                let length = TAU * of_fast / fast.path.angular_speed;
                let off = (slow.path.angular_speed * length - TAU * of_slow).abs();
                Period {
                    length,
                    max_distance_change: (off * slow.reach + speed * length)
                        * (1.0 + RATE_ERROR_F64),
                }
            })
            // Written so that NaN is no period.
            .take_while(|period| period.length <= 0.5)
    }

    /// Returns a time slightly longer than the period, so that whole periods leave no time out.
    pub(crate) fn length_rounded_up(&self) -> f64 {
        self.length * (1.0 + TURN_COUNT_WIDENING)
    }
}

/// Returns the continued fraction convergents of a number from 0 to 1, as numerators and denominators.
fn convergents(number: f64) -> impl Iterator<Item = [f64; 2]> {
    let (mut remainder, mut last, mut before) = (number, [1.0, 0.0], [0.0, 1.0]);
    std::iter::from_fn(move || {
        if !remainder.is_finite() {
            return None;
        }
        let whole = remainder.floor();
        (last, before) = ([0, 1].map(|k| whole * last[k] + before[k]), last);
        remainder = (remainder - whole).recip();
        Some(last)
    })
}

#[cfg(test)]
mod tests;
