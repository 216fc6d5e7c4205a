//! A link in the statement of a certificate.

use crate::cursor::Cursor;
use ccd_core::glam::DVec3;
use ccd_core::order::greater;

/// A link in the statement of a certificate, and its motion relative to its parent.
///
/// At time t a point y of the link is at `p + R c + s v + exp(s [a]×) R (y − c)` with s = start + t rate. Here p is the position, R the
/// rotation of the quaternion, c the center, v the velocity and a the axis.
#[derive(Clone, Debug, PartialEq)]
pub struct StatementLink {
    /// The parent: 0 is the world, 1 the first link.
    pub parent: u32,
    /// The position of the link's frame relative to the parent.
    pub position: [f64; 3],
    /// The rotation of the link's frame relative to the parent, as a quaternion x, y, z, w.
    pub quaternion: [f64; 4],
    /// The point of the link about which it rotates.
    pub center: [f64; 3],
    /// The axes along which `velocity` and `axis` are given: 0 for the parent's axes, 1 for the parent's axes rotated by
    /// `quaternion`. For 1, the formula has R v and R a instead of v and a.
    pub axes: u32,
    /// The velocity of the center, per unit of s.
    pub velocity: [f64; 3],
    /// The axis of rotation. Its length is the angular speed, per unit of s.
    pub axis: [f64; 3],
    /// The parameter s at time 0.
    pub start: f64,
    /// The change of the parameter s per time.
    pub rate: f64,
}

impl StatementLink {
    pub(crate) fn read(cursor: &mut Cursor<'_>) -> Option<Self> {
        Some(StatementLink {
            parent: cursor.u32()?,
            position: cursor.numbers()?,
            quaternion: cursor.numbers()?,
            center: cursor.numbers()?,
            axes: cursor.u32()?,
            velocity: cursor.numbers()?,
            axis: cursor.numbers()?,
            start: cursor.f64()?,
            rate: cursor.f64()?,
        })
    }

    /// Returns the same motion without the prover's scaling by a power of two.
    ///
    /// A free motion then has rate 1, and its velocity and angular velocity are per time. The axis of a joint has a largest coordinate
    /// above 1/2 and at most 1. Returns a copy if the link was not scaled.
    #[must_use]
    pub fn without_scaling(&self) -> Self {
        let [velocity, axis] = [self.velocity, self.axis].map(DVec3::from_array);
        let factor = if self.axes == 0 {
            if self.start == 0.0 { self.rate } else { 1.0 }
        } else {
            let largest = greater(velocity.abs().max_element(), axis.abs().max_element());
            if largest > 0.0 {
                1.0 / power_not_below(largest)
            } else {
                1.0
            }
        };
        let unscaled = StatementLink {
            velocity: (velocity * factor).to_array(),
            axis: (axis * factor).to_array(),
            start: self.start / factor,
            rate: self.rate / factor,
            ..self.clone()
        };
        let scaled_again = |v: [f64; 3]| (DVec3::from_array(v) / factor).to_array();
        let is_same_motion = is_power_of_two(factor)
            && (scaled_again(unscaled.velocity), scaled_again(unscaled.axis))
                == (self.velocity, self.axis)
            && (unscaled.start * factor, unscaled.rate * factor) == (self.start, self.rate);
        if is_same_motion {
            unscaled
        } else {
            self.clone()
        }
    }

    /// Returns the bits of all numbers of the link without the prover's scaling, for comparison.
    pub(crate) fn numbers(&self) -> Vec<u64> {
        let unscaled = self.without_scaling();
        let numbers = [
            &unscaled.position[..],
            &unscaled.quaternion,
            &unscaled.center,
            &unscaled.velocity,
            &unscaled.axis,
            &[unscaled.start, unscaled.rate],
        ];
        let counts = [self.parent, self.axes].map(u64::from);
        // Adding 0 turns −0 into 0.
        let numbers = numbers.concat().into_iter().map(|x| (x + 0.0).to_bits());
        counts.into_iter().chain(numbers).collect()
    }

    /// Compares two links that may have other joint positions and another scaling by a power of two. Returns the factor that undoes the
    /// scaling of the start and the rate of `other`. Returns `None` if `other` is a different joint.
    pub(crate) fn scale(&self, other: &StatementLink) -> Option<f64> {
        let is_fixed = self.axes == 0;
        let [velocity, other_velocity] = [self.velocity, other.velocity].map(DVec3::from_array);
        let largest = velocity.abs().max_position();
        let scale = if velocity == DVec3::ZERO {
            1.0
        } else {
            velocity[largest] / other_velocity[largest]
        };
        let rescaled = StatementLink {
            velocity: (velocity / scale).to_array(),
            start: if is_fixed { self.start } else { other.start },
            rate: if is_fixed { self.rate } else { other.rate },
            ..self.clone()
        };
        (is_power_of_two(scale) && rescaled == *other).then_some(1.0 / scale)
    }
}

fn is_power_of_two(number: f64) -> bool {
    number.is_normal() && number > 0.0 && number.to_bits() << 12 == 0
}

/// Returns the least power of two that is at least a number. Computes it from the bits, because a logarithm would be rounded.
fn power_not_below(number: f64) -> f64 {
    let is_between = number.to_bits() << 12 != 0;
    f64::from_bits(((number.to_bits() >> 52) + u64::from(is_between)) << 52)
}

#[cfg(test)]
mod tests;
