//! Frames with velocities.

use super::Kinematics;
use rigid_ccd::glam::DVec3;
use rigid_ccd::oracle::Frame;

/// A frame and its velocities, relative to another frame.
#[derive(Clone, Copy, Debug)]
pub(crate) struct MovingFrame {
    pub(crate) frame: Frame,
    pub(crate) angular_velocity: DVec3,
    /// The velocity of the frame's origin.
    pub(crate) velocity: DVec3,
}

impl MovingFrame {
    pub(crate) const STATIC: MovingFrame = MovingFrame {
        frame: Frame::IDENTITY,
        angular_velocity: DVec3::ZERO,
        velocity: DVec3::ZERO,
    };

    /// Returns the largest value of `velocity · direction` over all points of a set. `farthest` returns a point of the
    /// set that is farthest along a direction of the frame.
    #[inline(always)]
    pub(crate) fn largest_speed_along(
        &self,
        direction: DVec3,
        farthest: impl FnOnce(DVec3) -> DVec3,
    ) -> f64 {
        // direction · (ω × p) = (direction × ω) · p
        let turning = direction.cross(self.angular_velocity);
        let in_frame = self.frame.inverse_transform_vector(turning);
        direction.dot(self.velocity) + in_frame.dot(farthest(in_frame))
    }

    /// Returns an upper bound of the speed of the points of a ball.
    #[inline(always)]
    pub(crate) fn speed_of_ball(&self, center: DVec3, radius: f64) -> f64 {
        let arm = self.frame.rotation * center;
        let center_velocity = self.velocity + self.angular_velocity.cross(arm);
        center_velocity.length() + self.angular_velocity.length() * radius
    }
}

impl Kinematics {
    /// Returns a frame relative to its ancestor `seen_from`, for the positions and rates of all joints. `joints` are the
    /// joints between both, parents first.
    #[inline(always)]
    pub(crate) fn moving_frame(
        &self,
        joints: &[usize],
        positions: &[f64],
        rates: &[f64],
    ) -> MovingFrame {
        let mut moving = MovingFrame::STATIC;
        for &index in joints {
            let (joint, rate) = (&self.joints[index], rates[index]);
            let axis = moving.frame.rotation * joint.axis;
            let frame = joint.place(&moving.frame, positions[index]);
            let offset = frame.translation - moving.frame.translation;
            moving.velocity += moving.angular_velocity.cross(offset);
            if joint.is_prismatic {
                moving.velocity += axis * rate;
            } else {
                moving.angular_velocity += axis * rate;
            }
            moving.frame = frame;
        }
        moving
    }
}
