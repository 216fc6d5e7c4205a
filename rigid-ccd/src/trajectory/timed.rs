//! A trajectory that is followed at a varying rate.

use super::U;
use super::bounded::{Bounded, Speeds};
use super::checks::{check_duration, out_of_range};
use ccd_core::order::greater;
use ccd_core::{Accelerations, InputError, Motion, Smooth, Stray};
use std::ops::Range;

/// A smooth trajectory whose time is a function of the given time: its time law.
///
/// With the inner time `θ(t)`, the velocity is `v θ̇` and the acceleration `a θ̇² + v θ̈`; rotations alike.
///
/// ```
/// use rigid_ccd::trajectory::{Ballistic, Pace, Timed, Trajectory};
/// use rigid_ccd::{Motion, Pose};
/// let throw = Ballistic::new(Motion::new(Pose::IDENTITY, [1.0, 0.0, 2.0], [0.0; 3])?, [0.0, 0.0, -1.0])?;
/// // Slow motion, that begins and ends at rest.
/// let slow = Timed::new(throw, 0.0..2.0, 10.0, Pace::Eased)?;
/// assert_eq!(slow.pose(5.0)?.translation().x, 1.0);
/// assert!(slow.pose(1.0)?.translation().x < 0.1);
/// # Ok::<(), rigid_ccd::InputError>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Timed<T> {
    inner: T,
    first: f64,
    length: f64,
    duration: f64,
    pace: Pace,
}

/// The time law by which a trajectory is followed between its first and its last time.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Pace {
    /// The trajectory is followed at a constant rate.
    Even,
    /// The trajectory starts and ends at rest: `10 u³ − 15 u⁴ + 6 u⁵` of it is done after a share `u` of the time.
    Eased,
}

/// The maximum first derivative of [`Pace::Eased`], at half the time: `30/16`.
const MOST_EASED_RATE: f64 = 1.875;

/// The maximum second derivative of [`Pace::Eased`]: `10/√3`, rounded up.
const MOST_EASED_CURVATURE: f64 = 5.774;

impl Pace {
    /// Returns the share of the trajectory that is done at a share `u` of the time, and its derivative.
    fn at(self, u: f64) -> [f64; 2] {
        match self {
            Pace::Even => [u, 1.0],
            Pace::Eased => {
                let v = 1.0 - u;
                [
                    u * u * u * (10.0 + u * (6.0 * u - 15.0)),
                    30.0 * u * u * v * v,
                ]
            }
        }
    }

    /// Bounds the first and second derivative of the time law.
    fn derivative_bounds(self) -> [f64; 2] {
        match self {
            Pace::Even => [1.0, 0.0],
            Pace::Eased => [MOST_EASED_RATE, MOST_EASED_CURVATURE],
        }
    }
}

impl<T> Timed<T> {
    /// Follows a trajectory through a range of its times, in a duration. It rests before and after.
    ///
    /// # Errors
    /// [`InputError::OutOfRange`] for times that are not finite, or a duration that is not positive.
    pub fn new(inner: T, times: Range<f64>, duration: f64, pace: Pace) -> Result<Self, InputError> {
        let length = times.end - times.start;
        if !(0.0..=f64::MAX).contains(&length) {
            return Err(out_of_range("length", length, "at least 0"));
        }
        check_duration(duration)?;
        Ok(Timed {
            inner,
            first: times.start,
            length,
            duration,
            pace,
        })
    }

    /// Returns the time of the inner trajectory at a time, and its rate of change.
    fn inner_time(&self, time: f64) -> [f64; 2] {
        let u = time / self.duration;
        if (0.0..=1.0).contains(&u) {
            let [way, rate] = self.pace.at(u);
            [
                self.first + self.length * way,
                self.length / self.duration * rate,
            ]
        } else {
            [self.first + self.length * u.clamp(0.0, 1.0), 0.0]
        }
    }

    /// Returns the times of the inner trajectory at two times.
    fn inner_times(&self, from: f64, to: f64) -> [f64; 2] {
        let [[first, _], [last, _]] = [self.inner_time(from), self.inner_time(to)];
        [first, greater(first, last)]
    }

    /// Bounds the first and second derivative of the inner trajectory's time.
    fn inner_rate_bounds(&self) -> [f64; 2] {
        let [slope, curve] = self.pace.derivative_bounds();
        let rate = self.length / self.duration;
        [rate * slope, rate / self.duration * curve]
    }
}

impl<T: Bounded> Smooth for Timed<T> {
    fn tangent(&self, time: f64) -> Result<Motion, InputError> {
        let [inner, rate] = self.inner_time(time);
        let tangent = self.inner.tangent(inner)?;
        let (velocity, spin) = (tangent.velocity() * rate, tangent.spin() * rate);
        Motion::about(tangent.start(), velocity, spin, tangent.centre())
    }

    fn accelerations(&self, from: f64, to: f64) -> Accelerations {
        if to <= 0.0 || from >= self.duration {
            return Accelerations::default();
        }
        let [first, last] = self.inner_times(from, to);
        let [rate, change] = self.inner_rate_bounds();
        let speeds = self.inner.speeds(first, last);
        let inner = self.inner.accelerations(first, last);
        // With the even time law, the velocity jumps to zero at both ends.
        let jumps = |end: f64| from < end && end < to;
        let jump = if self.pace == Pace::Even && (jumps(0.0) || jumps(self.duration)) {
            2.0 * rate / (0.5 * (to - from))
        } else {
            change
        };
        Accelerations {
            linear: inner.linear * rate * rate + speeds.linear * jump,
            angular: inner.angular * rate * rate + speeds.angular * jump,
        }
    }

    /// Bounds the rounding errors of poses, including that of the inner trajectory's time.
    fn rounding(&self, from: f64, to: f64) -> Stray {
        let [first, last] = self.inner_times(from, to);
        let speeds = self.inner.speeds(first, last);
        let off = 64.0 * U * (self.first.abs() + self.length);
        let inner = self.inner.rounding(first, last);
        Stray {
            shift: inner.shift + speeds.linear * off,
            turn: inner.turn + speeds.angular * off,
        }
    }

    fn corner(&self, from: f64, to: f64) -> Option<f64> {
        let ends = [0.0, self.duration];
        let end = ends.into_iter().find(|&end| end > from && end < to);
        match self.pace {
            Pace::Even => {
                let [first, last] = self.inner_times(from, to);
                let inner = self.inner.corner(first, last);
                let rate = self.duration / self.length;
                inner
                    .map(|corner| (corner - self.first) * rate)
                    .filter(|_| self.length > 0.0)
                    .or(end)
            }
            Pace::Eased => end,
        }
    }
}

impl<T: Bounded> Bounded for Timed<T> {
    fn speeds(&self, from: f64, to: f64) -> Speeds {
        let [first, last] = self.inner_times(from, to);
        let inner = self.inner.speeds(first, last);
        let [rate, _] = self.inner_rate_bounds();
        Speeds {
            linear: inner.linear * rate,
            angular: inner.angular * rate,
        }
    }
}
