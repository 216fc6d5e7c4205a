//! The motion of a link relative to its parent, as in a certificate: a translation along a line and a rotation about an axis, both
//! proportional to one parameter.

use crate::error::NotProven;
use crate::scene::{AxisKind, Joint, Link};
use ccd_core::glam::{DMat3, DQuat, DVec3};
use ccd_core::order::greater;
use ccd_core::{Motion, Pose};

/// The motion of a link relative to its parent. The coordinates of all vectors are along the axes of the parent.
#[derive(Clone, Copy, Debug)]
pub(crate) struct LinkMotion {
    /// The index of the parent. Index 0 is the world.
    pub(crate) parent: usize,
    /// The same motion in the numbers of a certificate.
    pub(crate) encoded: EncodedMotion,
    /// The vector from the center of the parent to the center of the link at time 0.
    pub(crate) link_offset: DVec3,
    /// The velocity of the center of the link.
    pub(crate) velocity: DVec3,
    /// The rotation of the link relative to its parent at time 0.
    pub(crate) rotation: DMat3,
    /// The angular velocity of the link.
    pub(crate) angular_velocity: DVec3,
}

/// Returns the motions of the world and of all links. The certificate's unit of time is 2 to the power of `time_unit`.
///
/// # Errors
/// [`NotProven::TooSmall`].
pub(crate) fn link_motions(links: &[Link], time_unit: i32) -> Result<Vec<LinkMotion>, NotProven> {
    let mut motions = vec![LinkMotion::new(0, EncodedMotion::FIXED)];
    for link in links {
        let number = motions.len();
        let encoded = EncodedMotion::of_joint(&link.joint, time_unit)
            .ok_or(NotProven::TooSmall { link: number })?;
        let mut motion = LinkMotion::new(link.parent, encoded);
        motion.link_offset -= motions[link.parent].encoded.center;
        motions.push(motion);
    }
    Ok(motions)
}

impl LinkMotion {
    /// Returns the motion of a link. Assumes that the parent's center is the origin of its frame.
    fn new(parent: usize, encoded: EncodedMotion) -> LinkMotion {
        let [start, rate] = encoded.start_and_rate();
        LinkMotion {
            parent,
            encoded,
            link_offset: encoded.pose.transform_point(encoded.center) + start.translation,
            velocity: rate.translation,
            rotation: rotation_by(start.rotation_vector)
                * DMat3::from_quat(encoded.pose.rotation()),
            angular_velocity: rate.rotation_vector,
        }
    }
}

/// Returns the rotation of a rotation vector, whose length is the angle in radians.
pub(crate) fn rotation_by(rotation_vector: DVec3) -> DMat3 {
    DMat3::from_quat(DQuat::from_scaled_axis(rotation_vector))
}

/// The motion of a link relative to its parent, in the numbers of a certificate.
///
/// A point y of the link is at `p + R c + s v + exp(s [a]×) R (y − c)` with s = start + t rate. Here p and R are the pose, c the
/// center, v the velocity and a the axis.
#[derive(Clone, Copy, Debug)]
pub(crate) struct EncodedMotion {
    pub(crate) pose: Pose,
    pub(crate) center: DVec3,
    axes: Axes,
    velocity: DVec3,
    axis: DVec3,
    start: f64,
    rate: f64,
}

/// The frame of the coordinates of the velocity and of the axis.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Axes {
    Parent,
    Joint,
}

/// A translation and a rotation vector, or the rates of both.
struct Displacement {
    translation: DVec3,
    rotation_vector: DVec3,
}

impl EncodedMotion {
    /// The motion of a link whose frame is always the frame of its parent.
    pub(crate) const FIXED: EncodedMotion = EncodedMotion {
        pose: Pose::IDENTITY,
        center: DVec3::ZERO,
        axes: Axes::Joint,
        velocity: DVec3::ZERO,
        axis: DVec3::ZERO,
        start: 0.0,
        rate: 0.0,
    };

    /// Returns the motion of a joint.
    ///
    /// The checker has limits for the parameter s and for the length of the axis. To keep both, the function divides s by a power of
    /// two, and multiplies the velocity and the axis by it. Returns `None` if this loses bits of a small number.
    pub(crate) fn of_joint(joint: &Joint, time_unit: i32) -> Option<EncodedMotion> {
        let time_unit = 2f64.powi(time_unit);
        match *joint {
            Joint::Free(motion) => EncodedMotion::of_motion(&motion, time_unit),
            Joint::Axis {
                kind,
                pose,
                axis,
                start,
                rate,
            } => {
                let encoded = EncodedMotion {
                    pose,
                    axis,
                    start,
                    rate,
                    ..EncodedMotion::FIXED
                };
                if kind == AxisKind::Revolute {
                    return Some(encoded);
                }
                let scale = power_above(greater(start.abs(), rate.abs() * time_unit));
                let [start, rate, _] =
                    scaled_exactly(DVec3::new(start, rate, 0.0), 1.0 / scale)?.to_array();
                Some(EncodedMotion {
                    velocity: scaled_exactly(axis, scale)?,
                    axis: DVec3::ZERO,
                    start,
                    rate,
                    ..encoded
                })
            }
        }
    }

    fn of_motion(motion: &Motion, time_unit: f64) -> Option<EncodedMotion> {
        let (velocity, angular_velocity) = (motion.velocity(), motion.angular_velocity());
        let fixed = EncodedMotion {
            pose: motion.start(),
            center: motion.center(),
            axes: Axes::Parent,
            ..EncodedMotion::FIXED
        };
        if velocity == DVec3::ZERO && angular_velocity == DVec3::ZERO {
            return Some(fixed);
        }
        let (min_rate, largest) = (1.0 / time_unit, angular_velocity.abs().max_element());
        let rate = if largest > 0.0 {
            greater(power_above(largest), min_rate)
        } else {
            min_rate
        };
        Some(EncodedMotion {
            velocity: scaled_exactly(velocity, 1.0 / rate)?,
            axis: scaled_exactly(angular_velocity, 1.0 / rate)?,
            rate,
            ..fixed
        })
    }

    /// Returns the absolute values of the parameter s at time 0 and of its change in the unit of time.
    pub(crate) fn parameter_magnitudes(&self, time_unit: i32) -> [f64; 2] {
        [self.start.abs(), self.rate.abs() * 2f64.powi(time_unit)]
    }

    /// Returns the displacement of the joint at time 0, and its rate. The coordinates of all vectors are along the axes of the parent.
    fn start_and_rate(&self) -> [Displacement; 2] {
        let rotation = DMat3::from_quat(self.pose.rotation());
        let [velocity, axis] = [self.velocity, self.axis].map(|v| match self.axes {
            Axes::Parent => v,
            Axes::Joint => rotation * v,
        });
        [self.start, self.rate].map(|factor| Displacement {
            translation: velocity * factor,
            rotation_vector: axis * factor,
        })
    }

    /// Returns the numbers of the link in a certificate: the numbers before the code of the axes, the code, and the numbers after it.
    pub(crate) fn numbers(&self) -> (Vec<f64>, u32, Vec<f64>) {
        let before = [
            &self.pose.translation().to_array()[..],
            &self.pose.rotation().to_array(),
            &self.center.to_array(),
        ];
        let after = [
            &self.velocity.to_array()[..],
            &self.axis.to_array(),
            &[self.start, self.rate],
        ];
        (before.concat(), self.axes as u32, after.concat())
    }
}

/// Returns the least power of two that is larger than a number. Returns 1 for 0.
fn power_above(number: f64) -> f64 {
    2f64.powi(exponent_above(number))
}

/// Returns the exponent of the least power of two that is larger than a number. Returns 0 for 0.
pub(crate) fn exponent_above(number: f64) -> i32 {
    if number == 0.0 {
        0
    } else {
        number.log2().floor() as i32 + 1
    }
}

/// Returns a vector times a power of two. Returns `None` if a coordinate loses bits.
fn scaled_exactly(v: DVec3, power: f64) -> Option<DVec3> {
    let scaled = v * power;
    (scaled / power == v).then_some(scaled)
}
