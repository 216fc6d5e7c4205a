//! A link as a certificate states it.

use crate::cursor::Cursor;
use ccd_core::glam::DVec3;
use ccd_core::order::greater;

/// A link, and how it moves on the one that carries it: a point y is at `p + R c + s v + exp(s [a]×) R (y − c)` with
/// s = start + t rate, where p is the position, R the rotation of the quaternion, c the centre, v the velocity, a the axis.
#[derive(Clone, Debug, PartialEq)]
pub struct StatedLink {
    /// The number of the link that carries it, counted from 1; 0 is the world.
    pub parent: u32,
    /// The position.
    pub position: [f64; 3],
    /// The quaternion x, y, z, w.
    pub quaternion: [f64; 4],
    /// The point of the link about which it turns.
    pub centre: [f64; 3],
    /// What velocity and axis are along: 0 the axes of the parent, 1 those of the joint, so that v and a are R times them.
    pub axes: u32,
    /// The velocity, by which the centre moves.
    pub velocity: [f64; 3],
    /// The axis, about which it turns.
    pub axis: [f64; 3],
    /// What it has moved by at time 0.
    pub start: f64,
    /// What it moves by in a unit of time.
    pub rate: f64,
}

impl StatedLink {
    pub(crate) fn read(at: &mut Cursor<'_>) -> Option<Self> {
        Some(StatedLink {
            parent: at.u32()?,
            position: at.numbers()?,
            quaternion: at.numbers()?,
            centre: at.numbers()?,
            axes: at.u32()?,
            velocity: at.numbers()?,
            axis: at.numbers()?,
            start: at.f64()?,
            rate: at.f64()?,
        })
    }

    /// Returns the link with the numbers that its motion was given with, if they differ by a power of two from those of the
    /// certificate: a free motion with its velocity and spin in a unit of time, a joint with an axis whose largest coordinate is
    /// above 1/2, and at most 1. It is the same motion.
    #[must_use]
    pub fn as_given(&self) -> Self {
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
        let as_given = StatedLink {
            velocity: (velocity * factor).to_array(),
            axis: (axis * factor).to_array(),
            start: self.start / factor,
            rate: self.rate / factor,
            ..self.clone()
        };
        let back = |v: [f64; 3]| (DVec3::from_array(v) / factor).to_array();
        let is_same = is_power_of_two(factor)
            && (back(as_given.velocity), back(as_given.axis)) == (self.velocity, self.axis)
            && (as_given.start * factor, as_given.rate * factor) == (self.start, self.rate);
        if is_same { as_given } else { self.clone() }
    }

    /// Returns all numbers of the link, as it was given, for comparison.
    pub(crate) fn numbers(&self) -> Vec<u64> {
        let given = self.as_given();
        let numbers = [
            &given.position[..],
            &given.quaternion,
            &given.centre,
            &given.velocity,
            &given.axis,
            &[given.start, given.rate],
        ];
        let counts = [self.parent, self.axes].map(u64::from);
        // Both zeros are one number.
        let numbers = numbers.concat().into_iter().map(|x| (x + 0.0).to_bits());
        counts.into_iter().chain(numbers).collect()
    }

    /// Returns by what start and rate of the same joint at other positions are to be multiplied, from which a power of two may have
    /// been taken; `None` if that is another joint.
    pub(crate) fn scale(&self, other: &StatedLink) -> Option<f64> {
        let is_fixed = self.axes == 0;
        let [own, theirs] = [self.velocity, other.velocity].map(DVec3::from_array);
        let largest = own.abs().max_position();
        let scale = if own == DVec3::ZERO {
            1.0
        } else {
            own[largest] / theirs[largest]
        };
        let as_theirs = StatedLink {
            velocity: (own / scale).to_array(),
            start: if is_fixed { self.start } else { other.start },
            rate: if is_fixed { self.rate } else { other.rate },
            ..self.clone()
        };
        (is_power_of_two(scale) && as_theirs == *other).then_some(1.0 / scale)
    }
}

fn is_power_of_two(number: f64) -> bool {
    number.is_normal() && number > 0.0 && number.to_bits() << 12 == 0
}

/// Returns the least power of two that is not below a number, from its bits: a logarithm would be rounded.
fn power_not_below(number: f64) -> f64 {
    let is_between = number.to_bits() << 12 != 0;
    f64::from_bits(((number.to_bits() >> 52) + u64::from(is_between)) << 52)
}

#[cfg(test)]
mod tests;
