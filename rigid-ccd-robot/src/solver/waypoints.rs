//! The positions of all moving joints along a path of configurations.

use super::kinematics::Kinematics;
use super::stretch::{PathPoint, Stretch};
use ccd_core::order::greater;

/// A path, as positions of all moving joints at its configurations. Between two of them all joints move at constant rates.
#[derive(Debug, Default)]
pub(crate) struct Waypoints {
    joint_count: usize,
    /// The number of configurations.
    count: usize,
    positions: Vec<f64>,
    /// For each joint, a bound of the numbers of which its positions are computed.
    max_abs_position_by_joint: Vec<f64>,
}

impl Waypoints {
    /// Replaces the path.
    pub(crate) fn set<Q: AsRef<[f64]>>(&mut self, kinematics: &Kinematics, path: &[Q]) {
        self.joint_count = kinematics.joints().len();
        self.count = path.len();
        self.positions.clear();
        self.max_abs_position_by_joint.clear();
        self.max_abs_position_by_joint.resize(self.joint_count, 0.0);
        for configuration in path {
            let configuration = configuration.as_ref();
            for (joint, magnitude) in kinematics
                .joints()
                .iter()
                .zip(&mut self.max_abs_position_by_joint)
            {
                self.positions.push(joint.source.position(configuration));
                *magnitude = greater(*magnitude, joint.source.magnitude(configuration));
            }
        }
    }

    /// Returns the number of segments between configurations.
    pub(crate) fn segment_count(&self) -> usize {
        self.count.saturating_sub(1)
    }

    /// Returns for each joint a bound of the numbers of which its positions are computed, also between configurations.
    pub(crate) fn max_abs_positions(&self) -> impl Iterator<Item = f64> {
        self.max_abs_position_by_joint.iter().copied()
    }

    /// Computes the positions of all joints at a point of the path.
    #[inline(always)]
    pub(crate) fn interpolate(&self, at: f64, positions: &mut Vec<f64>) {
        let segment = PathPoint::from_path_position(at, self.segment_count()).segment;
        self.interpolate_in_segment(segment, at, positions);
    }

    /// Computes the positions of all joints at a point of a segment, its ends included.
    #[inline(always)]
    pub(crate) fn interpolate_in_segment(&self, segment: usize, at: f64, positions: &mut Vec<f64>) {
        let share = at - segment as f64;
        positions.clear();
        let from = self.at(segment);
        if share == 0.0 {
            positions.extend_from_slice(from);
            return;
        }
        let ends = from.iter().zip(self.at(segment + 1));
        positions.extend(ends.map(|(from, to)| from + share * (to - from)));
    }

    /// Computes how far each joint is at most from its position in the middle of a stretch, at any point of the stretch.
    #[inline(always)]
    pub(crate) fn max_joint_deviations_from_middle(
        &self,
        stretch: &Stretch,
        positions: &[f64],
        deviations: &mut Vec<f64>,
    ) {
        deviations.clear();
        if self.count < 2 {
            deviations.resize(self.joint_count, 0.0);
        } else if stretch.is_within_segment() {
            // The middle is at the same distance from both ends.
            let half = 0.5 * (stretch.to - stretch.from);
            let segment = PathPoint::from_path_position(stretch.from, self.segment_count()).segment;
            let ends = self.at(segment).iter().zip(self.at(segment + 1));
            deviations.extend(ends.map(|(from, to)| half * (to - from).abs()));
        } else {
            deviations.resize(self.joint_count, 0.0);
            // Between configurations a joint is farthest away at one of them.
            for waypoint in stretch.from as usize..=stretch.to as usize {
                let there = self.at(waypoint).iter().zip(positions);
                for (largest, (there, middle)) in deviations.iter_mut().zip(there) {
                    // Written so that NaN stays.
                    let deviation = (there - middle).abs();
                    if !(deviation <= *largest) {
                        *largest = deviation;
                    }
                }
            }
        }
    }

    fn at(&self, waypoint: usize) -> &[f64] {
        &self.positions[waypoint * self.joint_count..][..self.joint_count]
    }
}
