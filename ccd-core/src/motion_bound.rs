//! How far a moving body can advance along a fixed axis.
//!
//! Three bounds, from coarse to exact:
//! - [`published`]: Eq. 5 of the paper, which holds at one moment only and is unsound over a step;
//! - [`sound`]: holds over any later interval `[C2A09]`;
//! - [`Track`]: the exact displacement of a point along an axis, linear plus a sinusoid, which a gap
//!   is followed on to its first crossing.

use crate::order::greater;
use crate::tolerance::{RATE_F64, WORTHWHILE};
use crate::vector::{length, unit};
use glam::DVec3;

/// Constant velocity of a centre and constant angular velocity about it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Velocities {
    /// Of the centre.
    pub linear: DVec3,
    /// About the centre, radians per unit of time.
    pub spin: DVec3,
}

/// Which bound of a body's advance along an axis a schedule divides distances by.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Bound {
    /// [`published`], as it is printed. **Unsound**: times may be late, and contacts missed.
    Published,
    /// [`sound`].
    #[default]
    Sound,
}

/// `maxᵢ (n×ω)·rᵢ + |v·n|`: the fastest advance along `n` at this very moment, over the arms `rᵢ`
/// from the centre, of which `farthest` tells the one that is farthest along a direction
/// `[FAST06 §4.2 Eq. 5]`.
///
/// **Unsound over a step**: the arms turn with the body. It is here to be compared with.
pub fn published(motion: &Velocities, n: DVec3, farthest: impl FnOnce(DVec3) -> DVec3) -> f64 {
    let c = n.cross(motion.spin);
    greater(0.0, c.dot(farthest(c))) + motion.linear.dot(n).abs()
}

/// `v·n + |n×ω| ρ`: an upper bound of the rate of advance along `n` at any time, for points no
/// farther than `reach` from the axis of rotation `[C2A09]`, signed.
///
/// # Guarantee
/// Holds over any interval; exact arithmetic up to a few units in the last place.
pub fn sound(motion: &Velocities, n: DVec3, reach: f64) -> f64 {
    motion.linear.dot(n) + length(n.cross(motion.spin)) * reach
}

/// The height of one moving point along a fixed axis:
/// `height + drift τ + (cos ωτ − 1) p + sin ωτ q`.
///
/// ```
/// use ccd_core::motion_bound::{Track, Velocities};
/// use ccd_core::glam::DVec3;
/// // A point at arm y, turning about z, seen along x: it first swings to −x.
/// let turn = Velocities { linear: DVec3::ZERO, spin: DVec3::Z };
/// let track = Track::new(&turn, DVec3::X, 0.0, DVec3::Y);
/// assert!((track.at(1.0) + 1f64.sin()).abs() < 1e-15);
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Track {
    height: f64,
    drift: f64,
    p: f64,
    q: f64,
    omega: f64,
}

impl Track {
    /// The track along `n` of a point that starts at `height` along it, at arm `arm` from the
    /// motion's centre.
    #[inline]
    pub fn new(motion: &Velocities, n: DVec3, height: f64, arm: DVec3) -> Self {
        let axis = unit(motion.spin).unwrap_or(DVec3::ZERO);
        AxisMotion::new(motion.linear, axis, length(motion.spin), n).track(height, arm)
    }

    /// The height after `tau`.
    pub fn at(&self, tau: f64) -> f64 {
        self.height_at(tau, Angle::new(self.omega * tau))
    }

    #[inline]
    pub(crate) fn height_at(&self, tau: f64, angle: Angle) -> f64 {
        self.height + self.drift * tau + angle.versine * self.p + angle.sin * self.q
    }

    #[inline]
    pub(crate) fn rate_at(&self, angle: Angle) -> f64 {
        self.drift + self.omega * (angle.cos * self.q - angle.sin * self.p)
    }

    /// A bound of the second derivative.
    #[inline]
    pub(crate) fn bend(&self) -> f64 {
        self.omega * self.omega * (self.p * self.p + self.q * self.q).sqrt()
    }
}

/// What all points of a body share when seen along one axis.
#[derive(Clone, Copy, Debug)]
pub(crate) struct AxisMotion {
    drift: f64,
    /// `n` less its part along the axis of rotation.
    across: DVec3,
    /// `n × u`
    beside: DVec3,
    omega: f64,
}

impl AxisMotion {
    /// `unit` is the direction of the axis of rotation, zero if there is none.
    #[inline]
    pub(crate) fn new(linear: DVec3, unit: DVec3, omega: f64, n: DVec3) -> Self {
        AxisMotion {
            drift: linear.dot(n),
            across: n - n.dot(unit) * unit,
            beside: n.cross(unit),
            omega,
        }
    }

    /// Of points that go straight.
    #[inline]
    pub(crate) fn drift(&self) -> f64 {
        self.drift
    }

    /// A bound of the second derivative of the height of points at most so far from the axis of
    /// rotation.
    #[inline]
    pub(crate) fn bend(&self, distance: f64) -> f64 {
        self.omega * self.omega * length(self.across) * distance
    }

    #[inline]
    pub(crate) fn track(&self, height: f64, arm: DVec3) -> Track {
        Track {
            height,
            drift: self.drift,
            p: self.across.dot(arm),
            q: self.beside.dot(arm),
            omega: self.omega,
        }
    }
}

/// Sine, cosine, and cosine less one without cancellation.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Angle {
    sin: f64,
    cos: f64,
    versine: f64,
}

impl Angle {
    pub(crate) const ZERO: Angle = Angle {
        sin: 0.0,
        cos: 1.0,
        versine: 0.0,
    };

    #[inline]
    pub(crate) fn new(theta: f64) -> Self {
        let (s, c) = (0.5 * theta).sin_cos();
        let versine = -2.0 * s * s;
        Angle {
            sin: 2.0 * s * c,
            cos: 1.0 + versine,
            versine,
        }
    }
}

/// A vector that turns about an axis.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Spinning {
    start: DVec3,
    /// The vector less its part along the axis.
    across: DVec3,
    /// `u × v`
    beside: DVec3,
}

impl Spinning {
    /// `unit` is the direction of the axis, zero if there is none.
    #[inline]
    pub(crate) fn new(unit: DVec3, start: DVec3) -> Self {
        Spinning {
            start,
            across: start - start.dot(unit) * unit,
            beside: unit.cross(start),
        }
    }

    #[inline]
    pub(crate) fn at(&self, angle: Angle) -> DVec3 {
        self.start + self.across * angle.versine + self.beside * angle.sin
    }

    /// Its derivative, per radian.
    #[inline]
    pub(crate) fn slope_at(&self, angle: Angle) -> DVec3 {
        self.beside * angle.cos - self.across * angle.sin
    }

    /// The length of the derivative, which does not change.
    #[inline]
    pub(crate) fn slope(&self) -> f64 {
        self.beside.length()
    }
}

/// A gap that closes: at most by `rate τ + bend τ²/2` within `τ`.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Gap {
    pub(crate) gap: f64,
    pub(crate) rate: f64,
    pub(crate) bend: f64,
}

impl Gap {
    /// The longest time for which the gap stays open for certain; 0 when it is not open, NaN
    /// included.
    #[inline]
    pub(crate) fn free_time(&self) -> f64 {
        let (gap, rate, bend) = (self.gap, self.rate, self.bend);
        if rate.is_nan() {
            return 0.0;
        }
        let root = (rate * rate + 2.0 * bend * gap).sqrt();
        // Where the squares underflow, the root is no less than the rate still; NaN stays NaN.
        let root = if root < rate.abs() { rate.abs() } else { root };
        let tau = if rate > 0.0 {
            2.0 * gap / (rate + root)
        } else if bend > 0.0 {
            (root - rate) / bend
        } else {
            f64::INFINITY
        };
        // A pair that is not apart gets no free time, also when it recedes.
        if gap > 0.0 && tau > 0.0 {
            tau * (1.0 - RATE_F64)
        } else {
            0.0
        }
    }
}

/// The first time within `[0, horizon]` at which a gap may close, or a lower bound of it, or none
/// if it stays open; `free_time(τ)` is a time for which it stays open from `τ` on.
#[inline]
pub(crate) fn first_crossing(
    horizon: f64,
    rounds: usize,
    free_time: impl Fn(f64) -> f64,
) -> Option<f64> {
    let mut tau = 0.0;
    for _ in 0..rounds {
        let step = free_time(tau);
        tau += step;
        if tau >= horizon {
            return None;
        }
        // Steps shrink from here on: what is left is not worth a round.
        if step <= tau * WORTHWHILE {
            break;
        }
    }
    Some(tau)
}

#[cfg(test)]
mod tests;
