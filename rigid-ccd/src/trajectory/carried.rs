//! A body that moves in a moving frame.

use super::bounded::{Bounded, Speeds, of_origin, speeds};
use ccd_core::order::greater;
use ccd_core::vector::length;
use ccd_core::{Accelerations, InputError, Motion, Smooth, Stray};

/// A trajectory in the frame of another one: a tool in a hand, a load on a ship.
///
/// With the carrier's rotation `R`, its angular velocity `ω`, and the vector `q` from its origin to that of what it
/// carries: `ẍ = c̈ + ω̇ × Rq + ω × (ω × Rq) + 2 ω × Rq̇ + Rq̈`, and the angular acceleration is
/// `ω̇ + ω × Rω' + Rω̇'`.
///
/// ```
/// use rigid_ccd::trajectory::{Ballistic, Carried, Steady, Trajectory};
/// use rigid_ccd::{Motion, Pose};
/// // A ball is thrown on a carousel.
/// let carousel = Motion::new(Pose::IDENTITY, [0.0; 3], [0.0, 0.0, 1.0])?;
/// let throw = Motion::new(Pose::at([2.0, 0.0, 0.0])?, [0.0, 0.0, 5.0], [0.0; 3])?;
/// let ball = Carried::new(Steady(carousel), Ballistic::new(throw, [0.0, 0.0, -10.0])?);
/// assert!((ball.pose(0.5)?.translation().z - 1.25).abs() < 1e-15);
/// # Ok::<(), rigid_ccd::InputError>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Carried<C, T> {
    carrier: C,
    inner: T,
}

impl<C, T> Carried<C, T> {
    /// Creates the trajectory of `inner` in the frame of `carrier`.
    pub fn new(carrier: C, inner: T) -> Self {
        Carried { carrier, inner }
    }
}

/// A motion at constant velocities, for use within other trajectories.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Steady(pub Motion);

impl Smooth for Steady {
    fn tangent(&self, time: f64) -> Result<Motion, InputError> {
        let Steady(motion) = self;
        let (velocity, spin) = (motion.velocity(), motion.spin());
        Motion::about(motion.pose(time), velocity, spin, motion.centre())
    }

    fn accelerations(&self, _: f64, _: f64) -> Accelerations {
        Accelerations::default()
    }

    /// Bounds the rounding errors of the rotation since time 0 and of the displacement.
    fn rounding(&self, from: f64, to: f64) -> Stray {
        let Speeds { linear, angular } = speeds(&self.0);
        let time = greater(from.abs(), to.abs());
        let place = length(self.0.start().translation()) + length(self.0.centre());
        Stray {
            shift: 16.0 * super::U * (place + linear * time),
            turn: 8.0 * super::U * angular * time,
        }
    }
}

impl Bounded for Steady {
    fn speeds(&self, _: f64, _: f64) -> Speeds {
        speeds(&self.0)
    }
}

/// Bounds on the motion of a trajectory's origin between two times.
struct OriginBounds {
    /// The motion that has the trajectory's pose and velocities at the middle time.
    tangent: Motion,
    speeds: Speeds,
    accelerations: Accelerations,
    /// A bound on the distance from the origin of the outer frame.
    distance: f64,
}

impl OriginBounds {
    fn new<T: Bounded>(trajectory: &T, from: f64, to: f64) -> Result<Self, InputError> {
        let half = 0.5 * (to - from);
        let tangent = trajectory.tangent(from + half)?;
        let arm = length(tangent.centre());
        let speeds = trajectory.speeds(from, to);
        let origin = speeds.of_origin(arm);
        Ok(OriginBounds {
            accelerations: of_origin(trajectory.accelerations(from, to), speeds, arm),
            distance: length(tangent.start().translation()) + origin.linear * half,
            speeds: origin,
            tangent,
        })
    }
}

impl<C: Bounded, T: Bounded> Carried<C, T> {
    /// Returns the bounds for the carrier and for the carried body; `None` if either has no pose.
    fn origin_bounds(&self, from: f64, to: f64) -> Option<[OriginBounds; 2]> {
        let carrier = OriginBounds::new(&self.carrier, from, to).ok()?;
        let inner = OriginBounds::new(&self.inner, from, to).ok()?;
        Some([carrier, inner])
    }
}

impl<C: Bounded, T: Bounded> Smooth for Carried<C, T> {
    fn tangent(&self, time: f64) -> Result<Motion, InputError> {
        let [carrier, inner] = [self.carrier.tangent(time)?, self.inner.tangent(time)?];
        let turn = carrier.start().rotation();
        let start = carrier.start().compose(&inner.start());
        // The velocity of a tangent's origin is that of its centre, minus the part due to rotation.
        let origin = |motion: &Motion| {
            let arm = motion.start().rotation() * motion.centre();
            motion.velocity() - motion.spin().cross(arm)
        };
        let offset = turn * inner.start().translation();
        let velocity = origin(&carrier) + carrier.spin().cross(offset) + turn * origin(&inner);
        Motion::new(start, velocity, carrier.spin() + turn * inner.spin())
    }

    fn accelerations(&self, from: f64, to: f64) -> Accelerations {
        let Some([carrier, inner]) = self.origin_bounds(from, to) else {
            return Accelerations {
                linear: f64::INFINITY,
                angular: f64::INFINITY,
            };
        };
        let spin = carrier.speeds.angular;
        let turning = carrier.accelerations.angular + spin * spin;
        Accelerations {
            linear: carrier.accelerations.linear
                + turning * inner.distance
                + 2.0 * spin * inner.speeds.linear
                + inner.accelerations.linear,
            angular: carrier.accelerations.angular
                + spin * inner.speeds.angular
                + inner.accelerations.angular,
        }
    }

    fn rounding(&self, from: f64, to: f64) -> Stray {
        let [carrier, inner] = [
            self.carrier.rounding(from, to),
            self.inner.rounding(from, to),
        ];
        let Some([carrier_at, inner_at]) = self.origin_bounds(from, to) else {
            return Stray::NONE;
        };
        let arms = inner_at.distance
            + length(carrier_at.tangent.centre())
            + length(inner_at.tangent.centre());
        Stray {
            shift: carrier.shift
                + inner.shift
                + (carrier.turn + inner.turn) * arms
                + 32.0 * super::U * (carrier_at.distance + arms),
            turn: carrier.turn + inner.turn + 32.0 * super::U,
        }
    }

    fn corner(&self, from: f64, to: f64) -> Option<f64> {
        self.carrier
            .corner(from, to)
            .or_else(|| self.inner.corner(from, to))
    }
}

impl<C: Bounded, T: Bounded> Bounded for Carried<C, T> {
    fn speeds(&self, from: f64, to: f64) -> Speeds {
        match self.origin_bounds(from, to) {
            Some([carrier, inner]) => Speeds {
                linear: carrier.speeds.linear
                    + carrier.speeds.angular * inner.distance
                    + inner.speeds.linear,
                angular: carrier.speeds.angular + inner.speeds.angular,
            },
            None => Speeds {
                linear: f64::INFINITY,
                angular: f64::INFINITY,
            },
        }
    }
}
