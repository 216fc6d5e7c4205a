//! Bounds of the velocity of a moving body's points along a fixed axis.
//!
//! These bounds are coarser than the exact [`HeightFunction`](super::track::HeightFunction) of a point:
//! - [`published_bound`]: Eq. 5 of the paper, which holds at one instant only and is unsound over a step;
//! - [`sound_bound`]: a bound that holds over any later interval `[C2A09]`.

use crate::math::order::greater;
use crate::math::vector::length;
use glam::DVec3;

/// The constant velocity of a center, and the constant angular velocity about it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Velocities {
    /// The velocity of the center of rotation.
    pub(crate) linear_velocity: DVec3,
    /// The angular velocity about the center, in radians per unit of time.
    pub(crate) spin: DVec3,
}

/// The upper bound of a body's velocity along an axis, by which a schedule divides distances to get its time steps.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum VelocityBound {
    /// The bound as published, `max (n×ω)·r + |v·n|` over the arms r, which holds at one instant only. It is printed in
    /// the paper `[FAST06 §4.2 Eq. 5]`. **Unsound** over a step: times may be late, and contacts missed.
    Published,
    /// The bound `v·n + |n×ω| ρ`, which holds over any interval; ρ is the largest distance from the axis of rotation
    /// `[C2A09]`.
    #[default]
    Sound,
}

/// Returns `maxᵢ (n×ω)·rᵢ + |v·n|`, the fastest velocity along `n` at this instant over the arms `rᵢ` from the center.
/// `farthest` returns the arm that is farthest along a direction `[FAST06 §4.2 Eq. 5]`.
///
/// The bound is **unsound over a step**: the arms turn with the body. It is for comparison only.
pub(crate) fn published_bound(
    motion: &Velocities,
    n: DVec3,
    farthest: impl FnOnce(DVec3) -> DVec3,
) -> f64 {
    let c = n.cross(motion.spin);
    greater(0.0, c.dot(farthest(c))) + motion.linear_velocity.dot(n).abs()
}

/// Returns `v·n + |n×ω| ρ`, a signed upper bound of the velocity along `n` at any time. It holds for points no farther
/// than `reach` from the axis of rotation `[C2A09]`.
///
/// # Guarantee
/// The bound holds over any interval, up to a few units in the last place.
pub(crate) fn sound_bound(motion: &Velocities, n: DVec3, reach: f64) -> f64 {
    motion.linear_velocity.dot(n) + length(n.cross(motion.spin)) * reach
}

#[cfg(test)]
mod tests;
