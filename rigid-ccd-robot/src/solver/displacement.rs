//! Bounds the displacements of all parts over an interval of a path.
//!
//! The joints between the base and a part move the part. Take the displacement of one of its points relative to the
//! frame after a joint. Relative to the frame before the joint, this vector is rotated, which does not change its
//! length, and the displacement by the joint itself is added: a chord about a revolute axis, or a distance along a
//! prismatic axis. The chord starts at the point's position at the interval's midpoint. So a bound only needs the
//! distances of points from joint axes at the midpoint.

use crate::cell::part::HullPart;
use crate::kinematics::Kinematics;
use rigid_ccd::oracle::Frame;

/// Enlarges bounds to allow for rounding. A bound takes a few sums and products for each joint; the factor suffices
/// for thousands of joints.
pub(crate) const ROUNDING_FACTOR: f64 = 1.0 + 1e-11;

/// For each part, and for each joint between the part and the base, an upper bound of the part's displacement relative
/// to the frame before the joint.
#[derive(Clone, Debug, Default)]
pub(crate) struct DisplacementBounds {
    /// For each part, the joints between it and the base, the nearest to the part first.
    joints: Vec<usize>,
    /// For each part, the index of its first joint in `joints`.
    joint_start_by_part: Vec<usize>,
    bounds: Vec<f64>,
}

impl DisplacementBounds {
    pub(crate) fn new(kinematics: &Kinematics, parts: &[HullPart]) -> Self {
        let mut all = DisplacementBounds::default();
        for part in parts {
            all.joint_start_by_part.push(all.joints.len());
            let mut frame = part.frame;
            while frame > 0 {
                all.joints.push(frame - 1);
                frame = kinematics.joints()[frame - 1].parent;
            }
        }
        all.joint_start_by_part.push(all.joints.len());
        all.bounds = vec![0.0; all.joints.len()];
        all
    }

    /// Returns the index of the bound of a part's displacement relative to an ancestor frame; `None` for the part's
    /// own frame.
    pub(crate) fn bound_index_seen_from(
        &self,
        kinematics: &Kinematics,
        part: usize,
        seen_from: usize,
    ) -> Option<u32> {
        let joints =
            &self.joints[self.joint_start_by_part[part]..self.joint_start_by_part[part + 1]];
        let parent = |joint: usize| kinematics.joints()[joint].parent;
        let step = joints
            .iter()
            .position(|&joint| parent(joint) == seen_from)?;
        Some((self.joint_start_by_part[part] + step) as u32)
    }

    /// Returns the index of the bound of a part's displacement relative to the base; `None` for a static part.
    pub(crate) fn bound_index_seen_from_base(&self, part: usize) -> Option<u32> {
        let range = self.joint_start_by_part[part]..self.joint_start_by_part[part + 1];
        (!range.is_empty()).then(|| range.end as u32 - 1)
    }

    /// Returns the bound at an index; 0 for `None`.
    pub(crate) fn bound(&self, index: Option<u32>) -> f64 {
        index.map_or(0.0, |index| self.bounds[index as usize])
    }

    /// Computes the bounds for an interval, given the frames at its midpoint. Within the interval, joint positions
    /// deviate from the midpoint by at most `deviations`. Points computed with the frames have errors of at most
    /// `rounding`. This is so for the part's center, the joint's origin and the joint's axis.
    #[inline(always)]
    pub(crate) fn update(
        &mut self,
        kinematics: &Kinematics,
        parts: &[HullPart],
        frames: &[Frame],
        deviations: &[f64],
        rounding: f64,
    ) {
        for (part, bounds) in parts.iter().zip(self.joint_start_by_part.windows(2)) {
            let center = frames[part.frame].transform_point(part.center);
            let mut displacement = 0.0;
            for index in bounds[0]..bounds[1] {
                let joint_index = self.joints[index];
                let joint = &kinematics.joints()[joint_index];
                displacement += if joint.is_prismatic {
                    deviations[joint_index]
                } else {
                    let axis = frames[joint.parent].rotation * joint.axis;
                    let arm = center - frames[joint_index + 1].translation;
                    let distance = axis.cross(arm).length() + part.ball_radius + 3.0 * rounding;
                    chord_upper_bound(deviations[joint_index]) * distance
                };
                self.bounds[index] = displacement * ROUNDING_FACTOR;
            }
        }
    }
}

/// Returns an upper bound of the chord of an angle on the unit circle: `2 sin(angle/2)`, or 2 for large angles.
#[inline(always)]
pub(crate) fn chord_upper_bound(angle: f64) -> f64 {
    // Written so that a NaN is returned.
    if angle >= 3.0 {
        return 2.0;
    }
    // The Taylor series alternates, so a partial sum that ends with a positive term is an upper bound.
    let square = angle * angle;
    angle * (1.0 - square * (1.0 / 24.0 - square * (1.0 / 1920.0)))
}
