//! Computes the pose of a moving body by a formula that the engine does not share.

use ccd_core::Motion;
use ccd_core::glam::{DMat3, DQuat, DVec3};

/// A body's motion in the form that the rivals use: its center moves straight, and the body rotates about it.
#[derive(Clone, Copy, Debug)]
pub struct RivalMotion {
    /// The center of rotation in the body's frame.
    pub center: DVec3,
    /// The position of the center at the start, in the world frame.
    pub start_position: DVec3,
    /// The velocity of the center, in the world frame.
    pub velocity: DVec3,
    /// The orientation of the body at the start.
    pub start_orientation: DMat3,
    /// The unit axis of rotation in the world frame; any axis if the body does not rotate.
    pub axis: DVec3,
    /// The rate of rotation in radians per unit of time.
    pub angular_speed: f64,
}

/// A rigid placement of a body: `x ↦ rotation x + translation`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Placement {
    /// The rotation matrix of the placement.
    pub rotation: DMat3,
    /// The translation of the placement, applied after the rotation.
    pub translation: DVec3,
}

impl RivalMotion {
    /// Converts a motion to the form that the rivals use. Its parameters are read, but no formula is shared.
    pub fn new(motion: &Motion) -> Self {
        let orientation = DMat3::from_quat(motion.start().rotation());
        let rate = motion.angular_velocity().length();
        RivalMotion {
            center: motion.center(),
            start_position: motion.start().translation() + orientation * motion.center(),
            velocity: motion.velocity(),
            start_orientation: orientation,
            axis: motion
                .angular_velocity()
                .try_normalize()
                .unwrap_or(DVec3::Z),
            angular_speed: rate,
        }
    }

    /// Returns the rigid transformation from the body's frame to the world frame at a time.
    pub fn placement_at(&self, time: f64) -> Placement {
        let turn = DMat3::from_quat(DQuat::from_axis_angle(self.axis, self.angular_speed * time));
        let rotation = turn * self.start_orientation;
        Placement {
            rotation,
            translation: self.start_position + time * self.velocity - rotation * self.center,
        }
    }

    /// Returns the placement of the body at a time, in the frame of another body.
    pub fn placement_relative_to(&self, other: &RivalMotion, time: f64) -> Placement {
        self.placement_at(time)
            .relative_to(&other.placement_at(time))
    }
}

impl Placement {
    /// Maps a point from the body's frame to the world frame.
    pub fn apply(&self, point: DVec3) -> DVec3 {
        self.rotation * point + self.translation
    }

    /// Returns this placement in the frame of another: `other⁻¹ ∘ self`.
    pub fn relative_to(&self, other: &Placement) -> Placement {
        let back = other.rotation.transpose();
        Placement {
            rotation: back * self.rotation,
            translation: back * (self.translation - other.translation),
        }
    }
}
