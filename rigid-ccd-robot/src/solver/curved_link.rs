//! The trajectory of a link whose joints follow a curve.

use super::pair_chain::PairChain;
use crate::path::joint_path::JointPath;
use rigid_ccd::InputError;
use rigid_ccd::trajectory::{Stretch, Trajectory};
use smallvec::SmallVec;

/// Up to this number of joints in a chain, evaluating a trajectory allocates no memory.
const INLINE_JOINT_COUNT: usize = 24;

/// A section of one segment of a path.
#[derive(Clone, Copy)]
pub(crate) struct PathSection<'a> {
    pub(crate) path: &'a JointPath,
    pub(crate) segment: usize,
    pub(crate) from: f64,
    pub(crate) to: f64,
}

impl PathSection<'_> {
    pub(crate) fn ends(&self) -> [f64; 2] {
        [self.from, self.to]
    }
}

/// The trajectory of a link over a section of a path, which takes one unit of time.
///
/// Between two times, joints at constant rates approximate the trajectory, with bounds of the joints' deviations.
pub(crate) struct CurvedLink<'a> {
    pub(crate) pair_chain: &'a PairChain,
    pub(crate) section: PathSection<'a>,
}

impl Trajectory for CurvedLink<'_> {
    fn stretch_between(&self, from: f64, to: f64) -> Result<Stretch, InputError> {
        let PathSection { path, segment, .. } = self.section;
        // Subtracts the segment's index first, so that a fraction of a late segment is not rounded more.
        let [start, end] = self.section.ends().map(|at| at - segment as f64);
        let ends = [from, to].map(|time| start + time * (end - start));
        let positions = |fraction| self.values(|joint| path.position(segment, fraction, joint));
        let [first, last] = ends.map(positions);
        let deviations = self.values(|joint| path.chord_deviation_bound(segment, ends, joint));
        let time = to - from;
        // An empty interval has no rates.
        let duration = if time > 0.0 { time } else { 1.0 };
        let chain = &self.pair_chain.chain;
        let link = chain.link(first.len(), &first, &last, duration)?;
        link.with_joint_deviations(&deviations)?
            .stretch_between(0.0, time)
    }
}

impl CurvedLink<'_> {
    /// Returns a value for each joint of the chain: the result of `of_moving` for a moving joint, 0 for a fixed joint.
    fn values(&self, of_moving: impl Fn(usize) -> f64) -> SmallVec<[f64; INLINE_JOINT_COUNT]> {
        let joints = self.pair_chain.moving_joint_indices.iter();
        joints.map(|joint| joint.map_or(0.0, &of_moving)).collect()
    }
}

#[cfg(test)]
mod tests;
