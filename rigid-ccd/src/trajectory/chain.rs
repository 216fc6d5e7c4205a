//! A serial chain of links.

use super::joint::Joint;
use super::link::Link;
use ccd_core::{InputError, Pose, Trajectory};

/// A serial chain: joint `k` connects link `k` to link `k + 1`, and link 0 is the base.
///
/// ```
/// use rigid_ccd::trajectory::{Chain, Joint, Trajectory};
/// use rigid_ccd::Pose;
/// let shoulder = Joint::revolute(Pose::IDENTITY, [0.0, 0.0, 1.0])?;
/// let elbow = Joint::revolute(Pose::at([1.0, 0.0, 0.0])?, [0.0, 0.0, 1.0])?;
/// let arm = Chain::new(Pose::IDENTITY, vec![shoulder, elbow]);
/// // Both joints turn at constant rates; the forearm's origin stays on a circle.
/// let forearm = arm.link(2, &[0.0, 0.0], &[1.0, -2.0], 1.0)?;
/// assert!((forearm.pose(0.7)?.translation().length() - 1.0).abs() < 1e-15);
/// // As the upper arm sees it, it only turns.
/// let bends = arm.link(2, &[0.0, 0.0], &[1.0, -2.0], 1.0)?.seen_from(1);
/// assert!(bends.pose(0.7)?.translation().x == 1.0);
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

    /// The pose of link 0.
    pub fn base(&self) -> Pose {
        self.base
    }

    /// The joints.
    pub fn joints(&self) -> &[Joint] {
        &self.joints
    }

    /// Returns the pose of a link at some positions of the joints.
    ///
    /// # Errors
    /// Those of [`Chain::link`].
    pub fn pose(&self, link: usize, positions: &[f64]) -> Result<Pose, InputError> {
        let rests = self.link(link, positions, positions, 1.0)?;
        Trajectory::pose(&rests, 0.0)
    }

    /// Returns the trajectory of a link while all joints move at constant rates from some positions to others.
    ///
    /// There is a position for each joint, fixed ones included.
    ///
    /// # Errors
    /// [`InputError::OutOfRange`] for a link that does not exist, for another number of positions, for one
    /// outside of its joint's limits, and for a duration that is not positive.
    pub fn link<'c>(
        &'c self,
        link: usize,
        from: &'c [f64],
        to: &'c [f64],
        duration: f64,
    ) -> Result<Link<'c>, InputError> {
        Link::new(self, link, from, to, duration)
    }
}
