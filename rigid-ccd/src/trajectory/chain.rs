//! A serial chain of links connected by joints.

use super::joint::Joint;
use ccd_core::Pose;

/// A serial chain: joint `k` connects link `k` to link `k + 1`, and link 0 is the base.
///
/// A body that hangs on a link has its origin at the joint. Where its own origin is elsewhere, such as the middle of
/// a box, a [fixed](Joint::fixed) joint more takes it there.
///
/// ```
/// use rigid_ccd::trajectory::{Chain, Joint, Trajectory};
/// use rigid_ccd::Pose;
/// let shoulder = Joint::revolute(Pose::IDENTITY, [0.0, 0.0, 1.0])?;
/// let elbow = Joint::revolute(Pose::at([1.0, 0.0, 0.0])?, [0.0, 0.0, 1.0])?;
/// let arm = Chain::new(Pose::IDENTITY, vec![shoulder, elbow]);
/// // Where the joints are at time 0, and where they are 2 units of time later: positions, not rates.
/// let (from, to) = ([0.3, 0.5], [1.3, -1.5]);
/// let forearm = arm.link(2, &from, &to, 2.0)?;
/// assert_eq!(forearm.pose(0.0)?, arm.pose(2, &from)?);
/// assert_eq!(forearm.pose(2.0)?, arm.pose(2, &to)?);
/// // In between the forearm's origin stays on a circle. As the upper arm sees it, it only turns.
/// assert!((forearm.pose(0.7)?.translation().length() - 1.0).abs() < 1e-15);
/// assert_eq!(forearm.seen_from(1)?.pose(0.7)?.translation().x, 1.0);
/// # Ok::<(), rigid_ccd::InputError>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Chain {
    base: Pose,
    joints: Vec<Joint>,
}

impl Chain {
    /// Creates a chain from the pose of its base and its joints.
    pub fn new(base: Pose, joints: Vec<Joint>) -> Self {
        Chain { base, joints }
    }

    /// Returns the pose of link 0.
    pub fn base(&self) -> Pose {
        self.base
    }

    /// Returns the joints, in order from the base.
    pub fn joints(&self) -> &[Joint] {
        &self.joints
    }
}
