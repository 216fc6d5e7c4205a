//! The motion of a link on its parent in the form of a certificate: along a line and about an axis, by one parameter.

use crate::error::NotProven;
use crate::scene::{AxisKind, Joint, Link};
use ccd_core::glam::{DMat3, DQuat, DVec3};
use ccd_core::order::greater;
use ccd_core::{Motion, Pose};

/// The motion of a link on its parent, with the vectors along the axes of the parent.
#[derive(Clone, Copy, Debug)]
pub(crate) struct LinkMotion {
    /// The index of the parent. Index 0 is the world.
    pub(crate) parent: usize,
    pub(crate) screw: Screw,
    /// The vector from the center of the parent to the center of the link at time 0.
    pub(crate) arm: DVec3,
    /// The velocity of the center of the link.
    pub(crate) velocity: DVec3,
    /// The rotation of the link on its parent at time 0.
    pub(crate) rotation: DMat3,
    /// The angular velocity of the link.
    pub(crate) angular_velocity: DVec3,
}

/// Returns the motions of the world and of all links. The unit of time of the certificate is 2 to the power of `time_unit`.
///
/// # Errors
/// [`NotProven::TooSmall`].
pub(crate) fn link_motions(links: &[Link], time_unit: i32) -> Result<Vec<LinkMotion>, NotProven> {
    let mut motions = vec![LinkMotion::new(0, Screw::FIXED)];
    for link in links {
        let number = motions.len();
        let screw =
            Screw::of_joint(&link.joint, time_unit).ok_or(NotProven::TooSmall { link: number })?;
        let mut motion = LinkMotion::new(link.parent, screw);
        motion.arm -= motions[link.parent].screw.center;
        motions.push(motion);
    }
    Ok(motions)
}

impl LinkMotion {
    /// Returns the motion of a link on a parent whose center is the origin of its frame.
    fn new(parent: usize, screw: Screw) -> LinkMotion {
        let [start, rate] = screw.start_and_rate();
        LinkMotion {
            parent,
            screw,
            arm: screw.pose.transform_point(screw.center) + start.translation,
            velocity: rate.translation,
            rotation: rotation_by(start.rotation) * DMat3::from_quat(screw.pose.rotation()),
            angular_velocity: rate.rotation,
        }
    }
}

/// Returns the rotation about the direction of a rotation vector, by its length in radians.
pub(crate) fn rotation_by(rotation_vector: DVec3) -> DMat3 {
    DMat3::from_quat(DQuat::from_scaled_axis(rotation_vector))
}

/// The motion of a link on its parent, in the numbers of a certificate.
///
/// A point y of the link is at `p + R c + s v + exp(s [a]×) R (y − c)` with s = start + t rate. Here p and R are the pose, c the
/// center, v the velocity and a the axis.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Screw {
    pub(crate) pose: Pose,
    pub(crate) center: DVec3,
    axes: Axes,
    velocity: DVec3,
    axis: DVec3,
    start: f64,
    rate: f64,
}

/// The frame in which the velocity and the axis are given.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Axes {
    Parent,
    Joint,
}

/// A translation and a rotation vector, or the rates of both.
struct Twist {
    translation: DVec3,
    rotation: DVec3,
}

impl Screw {
    /// A link that is fixed at the pose of its parent.
    pub(crate) const FIXED: Screw = Screw {
        pose: Pose::IDENTITY,
        center: DVec3::ZERO,
        axes: Axes::Joint,
        velocity: DVec3::ZERO,
        axis: DVec3::ZERO,
        start: 0.0,
        rate: 0.0,
    };

    /// Returns the motion of a joint. The checker has limits for the parameter s and for the length of the axis. To stay within
    /// them, this scales the one up and the other down by a power of two. Returns `None` if that loses bits of a small number.
    pub(crate) fn of_joint(joint: &Joint, time_unit: i32) -> Option<Screw> {
        let time_unit = 2f64.powi(time_unit);
        match *joint {
            Joint::Free(motion) => Screw::of_motion(&motion, time_unit),
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
                    ..Screw::FIXED
                };
                if kind == AxisKind::Revolute {
                    return Some(screw);
                }
                let scale = power_above(greater(start.abs(), rate.abs() * time_unit));
                let [start, rate, _] =
                    scaled_exactly(DVec3::new(start, rate, 0.0), 1.0 / scale)?.to_array();
                Some(Screw {
                    velocity: scaled_exactly(axis, scale)?,
                    axis: DVec3::ZERO,
                    start,
                    rate,
                    ..screw
                })
            }
        }
    }

    fn of_motion(motion: &Motion, time_unit: f64) -> Option<Screw> {
        let (velocity, angular_velocity) = (motion.velocity(), motion.angular_velocity());
        let fixed = Screw {
            pose: motion.start(),
            center: motion.center(),
            axes: Axes::Parent,
            ..Screw::FIXED
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
        Some(Screw {
            velocity: scaled_exactly(velocity, 1.0 / rate)?,
            axis: scaled_exactly(angular_velocity, 1.0 / rate)?,
            rate,
            ..fixed
        })
    }

    /// Returns the magnitude of the parameter s at time 0, and the magnitude of its change in the unit of time.
    pub(crate) fn parameter_magnitudes(&self, time_unit: i32) -> [f64; 2] {
        [self.start.abs(), self.rate.abs() * 2f64.powi(time_unit)]
    }

    /// Returns the translation of the center and the rotation of the link at time 0, and their rates. All vectors are along the
    /// axes of the parent.
    fn start_and_rate(&self) -> [Twist; 2] {
        let rotation = DMat3::from_quat(self.pose.rotation());
        let [velocity, axis] = [self.velocity, self.axis].map(|v| match self.axes {
            Axes::Parent => v,
            Axes::Joint => rotation * v,
        });
        [self.start, self.rate].map(|factor| Twist {
            translation: velocity * factor,
            rotation: axis * factor,
        })
    }

    /// Returns the numbers of a certificate: those before the code of the axes, the code itself, and those after it.
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

/// Returns the least power of two above a number, and 1 for 0.
fn power_above(number: f64) -> f64 {
    2f64.powi(exponent_above(number))
}

/// Returns the exponent of the least power of two above a number, and 0 for 0.
pub(crate) fn exponent_above(number: f64) -> i32 {
    if number == 0.0 {
        0
    } else {
        number.log2().floor() as i32 + 1
    }
}

/// Returns the vector times a power of two. Returns `None` if a coordinate loses bits.
fn scaled_exactly(v: DVec3, power: f64) -> Option<DVec3> {
    let scaled = v * power;
    (scaled / power == v).then_some(scaled)
}
