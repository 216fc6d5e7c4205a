//! How a link moves as a certificate states it: along a line and about an axis, both by one number.

use crate::scene::{AxisKind, Joint};
use ccd_core::glam::{DMat3, DVec3};
use ccd_core::order::greater;
use ccd_core::{Motion, Pose};

/// A point y of the link is at `p + R c + s v + exp(s [a]×) R (y − c)` with s = start + t rate, where p and R are its pose, v the
/// velocity and a the axis.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Screw {
    pub(crate) pose: Pose,
    pub(crate) centre: DVec3,
    axes: Axes,
    velocity: DVec3,
    axis: DVec3,
    start: f64,
    rate: f64,
}

/// What velocity and axis are along.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Axes {
    Parent,
    Joint,
}

impl Screw {
    /// A link that rests where its parent is.
    pub(crate) const REST: Screw = Screw {
        pose: Pose::IDENTITY,
        centre: DVec3::ZERO,
        axes: Axes::Joint,
        velocity: DVec3::ZERO,
        axis: DVec3::ZERO,
        start: 0.0,
        rate: 0.0,
    };

    /// Returns how a joint moves its link. The checker has few bits for start and rate, in a unit of time that is a power of two, and
    /// none for an axis longer than 1: so these take powers of two from each other. `None` if a number is too small for that.
    pub(crate) fn of(joint: &Joint, time_unit: i32) -> Option<Screw> {
        let time_unit = 2f64.powi(time_unit);
        match *joint {
            Joint::Free(motion) => Screw::free(&motion, time_unit),
            Joint::Axis {
                kind,
                pose,
                axis,
                start,
                rate,
            } => {
                let screw = Screw {
                    pose,
                    axis,
                    start,
                    rate,
                    ..Screw::REST
                };
                if kind == AxisKind::Turns {
                    return Some(screw);
                }
                let scale = power_above(greater(start.abs(), rate.abs() * time_unit));
                let [start, rate, _] =
                    exactly(DVec3::new(start, rate, 0.0), 1.0 / scale)?.to_array();
                Some(Screw {
                    velocity: exactly(axis, scale)?,
                    axis: DVec3::ZERO,
                    start,
                    rate,
                    ..screw
                })
            }
        }
    }

    fn free(motion: &Motion, time_unit: f64) -> Option<Screw> {
        let (velocity, spin) = (motion.velocity(), motion.spin());
        let at_rest = Screw {
            pose: motion.start(),
            centre: motion.centre(),
            axes: Axes::Parent,
            ..Screw::REST
        };
        if velocity == DVec3::ZERO && spin == DVec3::ZERO {
            return Some(at_rest);
        }
        let (least, most) = (1.0 / time_unit, spin.abs().max_element());
        let rate = if most > 0.0 {
            greater(power_above(most), least)
        } else {
            least
        };
        Some(Screw {
            velocity: exactly(velocity, 1.0 / rate)?,
            axis: exactly(spin, 1.0 / rate)?,
            rate,
            ..at_rest
        })
    }

    /// Returns by how much the link has moved at time 0, and how much it moves in the unit of time, without signs.
    pub(crate) fn moved(&self, time_unit: i32) -> [f64; 2] {
        [self.start.abs(), self.rate.abs() * 2f64.powi(time_unit)]
    }

    /// Returns by what the centre is moved and the link turned, along the axes of the parent: at time 0, and in a unit of time.
    pub(crate) fn moves(&self) -> [[DVec3; 2]; 2] {
        let rotation = DMat3::from_quat(self.pose.rotation());
        let along = [self.velocity, self.axis].map(|v| match self.axes {
            Axes::Parent => v,
            Axes::Joint => rotation * v,
        });
        [self.start, self.rate].map(|by| along.map(|v| v * by))
    }

    /// Returns the numbers of a certificate: those before the number of the axes, this, and those after it.
    pub(crate) fn numbers(&self) -> (Vec<f64>, u32, Vec<f64>) {
        let before = [
            &self.pose.translation().to_array()[..],
            &self.pose.rotation().to_array(),
            &self.centre.to_array(),
        ];
        let after = [
            &self.velocity.to_array()[..],
            &self.axis.to_array(),
            &[self.start, self.rate],
        ];
        (before.concat(), self.axes as u32, after.concat())
    }
}

/// Returns the least power of two above a number; 1 for 0.
fn power_above(number: f64) -> f64 {
    2f64.powi(exponent_above(number))
}

/// Returns the least exponent of a power of two above a number; 0 for 0.
pub(crate) fn exponent_above(number: f64) -> i32 {
    if number == 0.0 {
        0
    } else {
        number.log2().floor() as i32 + 1
    }
}

/// Returns the product with a power of two, if no bit is lost.
fn exactly(v: DVec3, power: f64) -> Option<DVec3> {
    let scaled = v * power;
    (scaled / power == v).then_some(scaled)
}
