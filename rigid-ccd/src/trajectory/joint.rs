//! A joint of a serial chain, and the motion of the link after it.

use super::screw::unit_axis;
use ccd_core::glam::{DQuat, DVec3};
use ccd_core::order::greater;
use ccd_core::{InputError, Motion, Pose, check};
use std::ops::RangeInclusive;

/// A joint between two links of a serial chain, as in URDF. Its origin is a pose in the frame of the link before the
/// joint. The link after the joint rotates about its axis or slides along it; the axis is given in the joint's frame.
///
/// ```
/// use rigid_ccd::trajectory::Joint;
/// use rigid_ccd::Pose;
/// let hinge = Joint::revolute(Pose::at([0.0, 0.0, 1.0])?, [0.0, 1.0, 0.0])?.with_limits(-1.5..=1.5);
/// // A door that is open by a quarter of a radian opens to 1.25 radians, in two units of time.
/// let opens = hinge.motion(0.25, 1.25, 2.0)?;
/// assert_eq!(opens.angular_velocity().y, 0.5);
/// assert!(hinge.motion(0.25, 3.0, 2.0).is_err());
/// # Ok::<(), rigid_ccd::InputError>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Joint {
    origin: Pose,
    kind: JointKind,
    limits: RangeInclusive<f64>,
    direction: Direction,
}

/// The direction in which a chain passes a joint.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Direction {
    /// The chain passes the joint from the link before it to the link after it.
    Forward,
    /// The chain passes the joint from the link after it to the link before it.
    Backward,
}

/// The degree of freedom of a joint; a rotation or a translation has a unit axis in the joint's frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum JointKind {
    /// The joint has no degree of freedom.
    Fixed,
    /// The joint rotates about an axis.
    Revolute(DVec3),
    /// The joint slides along an axis.
    Prismatic(DVec3),
}

/// The allowed excess of a joint's position over its limits, as a fraction of the limit of greater magnitude. A
/// position between two limits, `a + t (b − a)`, has three roundings, each of at most half an ulp of twice that
/// magnitude.
const LIMIT_ROUNDING_SLACK: f64 = 4.0 * f64::EPSILON;

impl Joint {
    /// Creates a joint without a degree of freedom.
    pub fn fixed(origin: Pose) -> Self {
        Joint {
            origin,
            kind: JointKind::Fixed,
            limits: f64::NEG_INFINITY..=f64::INFINITY,
            direction: Direction::Forward,
        }
    }

    /// Creates a joint that rotates about an axis; its position is an angle in radians, without limits.
    ///
    /// # Errors
    /// [`InputError::NotFinite`] for an axis that is not finite, [`InputError::OutOfRange`] for one without a length.
    pub fn revolute(origin: Pose, axis: impl Into<[f64; 3]>) -> Result<Self, InputError> {
        Ok(Joint {
            kind: JointKind::Revolute(unit_axis(axis)?),
            ..Joint::fixed(origin)
        })
    }

    /// Creates a joint that slides along an axis; its position is a length, without limits.
    ///
    /// # Errors
    /// [`InputError::NotFinite`] for an axis that is not finite, [`InputError::OutOfRange`] for one without a length.
    pub fn prismatic(origin: Pose, axis: impl Into<[f64; 3]>) -> Result<Self, InputError> {
        Ok(Joint {
            kind: JointKind::Prismatic(unit_axis(axis)?),
            ..Joint::fixed(origin)
        })
    }

    /// Returns the joint with a least and a greatest allowed position, in radians or as a length. Positions beyond a
    /// limit by no more than the rounding of an interpolated position are accepted.
    #[must_use]
    pub fn with_limits(self, limits: RangeInclusive<f64>) -> Self {
        Joint { limits, ..self }
    }

    /// Returns the joint for a chain that passes it in the opposite direction: from the link after it to the link
    /// before it. Positions keep their meaning and their limits.
    ///
    /// In the frame of a link on another branch of a tree, a link moves by a chain that passes the joints from that frame
    /// to the common ancestor backward.
    ///
    /// ```
    /// use rigid_ccd::trajectory::{Chain, Joint};
    /// use rigid_ccd::Pose;
    /// let shoulder = |y| Joint::revolute(Pose::at([0.0, y, 0.0])?, [0.0, 0.0, 1.0]);
    /// let (left, right) = (shoulder(1.0)?, shoulder(-1.0)?);
    /// let chain = Chain::new(Pose::IDENTITY, vec![left.reversed(), right]);
    /// // As the left hand sees it, the right shoulder is 2 behind.
    /// assert_eq!(chain.pose(2, &[0.0, 0.0])?.translation().y, -2.0);
    /// # Ok::<(), rigid_ccd::InputError>(())
    /// ```
    #[must_use]
    pub fn reversed(self) -> Self {
        let direction = match self.direction {
            Direction::Forward => Direction::Backward,
            Direction::Backward => Direction::Forward,
        };
        Joint { direction, ..self }
    }

    /// Returns the least and the greatest allowed position.
    pub fn limits(&self) -> &RangeInclusive<f64> {
        &self.limits
    }

    /// Returns the pose of the joint in the frame of the link before it; of a [reversed](Joint::reversed) joint, in the frame
    /// of the link after it.
    pub fn origin(&self) -> &Pose {
        &self.origin
    }

    /// Returns the degree of freedom of the joint.
    pub fn kind(&self) -> JointKind {
        self.kind
    }

    /// Returns true if a chain passes the joint from the link after it to the link before it.
    pub fn is_reversed(&self) -> bool {
        self.direction == Direction::Backward
    }

    /// Returns true if the joint has no degree of freedom: its position is ignored.
    pub fn is_fixed(&self) -> bool {
        self.kind == JointKind::Fixed
    }

    /// Returns the pose of the link after the joint in the frame of the link before it. For a
    /// [reversed](Joint::reversed) joint, it is the inverse: the pose of the link before the joint in the frame of the
    /// link after it.
    ///
    /// # Errors
    /// [`InputError::JointOutOfLimits`] outside of the limits, [`InputError::NotFinite`].
    pub fn pose(&self, position: f64) -> Result<Pose, InputError> {
        self.check_position(position, None)?;
        self.unchecked_pose(position)
    }

    /// Refuses the positions that [`Joint::pose`] refuses, at a small part of its cost.
    ///
    /// # Errors
    /// Those of [`Joint::pose`].
    pub fn check(&self, position: f64) -> Result<(), InputError> {
        self.check_position(position, None)?;
        match self.kind {
            JointKind::Revolute(_) if position.is_finite() => Ok(()),
            _ => self.unchecked_pose(position).map(|_| ()),
        }
    }

    /// Returns the pose as [`Joint::pose`] does, but does not check that the position is within the limits.
    pub(super) fn unchecked_pose(&self, position: f64) -> Result<Pose, InputError> {
        let moved = match self.kind {
            JointKind::Fixed => Pose::IDENTITY,
            JointKind::Revolute(_) if !position.is_finite() => {
                let quantity = "position";
                return Err(InputError::NotFinite { quantity });
            }
            JointKind::Revolute(axis) => {
                Pose::new(DVec3::ZERO, DQuat::from_axis_angle(axis, position))?
            }
            JointKind::Prismatic(axis) => Pose::at(axis * position)?,
        };
        let pose = self.origin.compose(&moved);
        Ok(match self.direction {
            Direction::Forward => pose,
            Direction::Backward => pose.inverse(),
        })
    }

    /// Returns the motion while the joint moves from one position to another in `duration`, at a constant rate. It
    /// starts at the [pose](Joint::pose) of the first position.
    ///
    /// # Errors
    /// [`InputError::JointOutOfLimits`] outside of the limits, [`InputError::OutOfRange`] for a duration that is not
    /// positive and finite, [`InputError::NotFinite`].
    pub fn motion(&self, from: f64, to: f64, duration: f64) -> Result<Motion, InputError> {
        self.check_position(to, None)?;
        let start = self.pose(from)?;
        // A joint at rest may take no time.
        let least = if from == to { 0.0 } else { f64::from_bits(1) };
        let is_allowed = (least..=f64::MAX).contains(&duration);
        check("duration", duration, is_allowed, "positive and finite")?;
        let rate = if from == to {
            0.0
        } else {
            (to - from) / duration
        };
        // The axis in the frame in which the link is seen, and the point on it that keeps its place on the link.
        let (frame, rate, center) = match self.direction {
            Direction::Forward => (self.origin.rotation(), rate, DVec3::ZERO),
            Direction::Backward => (DQuat::IDENTITY, -rate, self.origin.translation()),
        };
        let along = |axis: DVec3| frame * axis * rate;
        match self.kind {
            JointKind::Fixed => Ok(Motion::still(start)),
            JointKind::Revolute(axis) => Motion::about(start, DVec3::ZERO, along(axis), center),
            JointKind::Prismatic(axis) => Motion::new(start, along(axis), DVec3::ZERO),
        }
    }

    /// Returns an error for a position that is outside the joint's limits by more than rounding. The error has the
    /// number `joint` of the joint in its chain.
    pub(super) fn check_position(
        &self,
        position: f64,
        joint: Option<usize>,
    ) -> Result<(), InputError> {
        let (least, greatest) = (*self.limits.start(), *self.limits.end());
        let rounding = match greater(least.abs(), greatest.abs()) {
            scale if scale.is_finite() => LIMIT_ROUNDING_SLACK * scale,
            _ => 0.0,
        };
        // Written so that NaN is refused.
        let allowed = position >= least - rounding && position <= greatest + rounding;
        if self.is_fixed() || allowed {
            Ok(())
        } else {
            Err(InputError::JointOutOfLimits {
                joint,
                joint_position: position,
                limits: [least, greatest],
            })
        }
    }

    pub(super) fn direction(&self) -> Direction {
        self.direction
    }
}
