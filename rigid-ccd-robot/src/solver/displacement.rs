//! Bounds of the displacements of all parts over an interval of an edge.
//!
//! A part moves with the joints between it and the base. Let a point be displaced by some vector as the frame after a
//! joint sees it. The frame before the joint sees that vector turned, and in addition the displacement of the point's
//! place in the middle of the interval by the joint alone: a chord about the joint's axis, or a distance along it. Only
//! distances from axes in the middle of the interval are needed.

use crate::cell::part::HullPart;
use crate::kinematics::Kinematics;
use rigid_ccd::oracle::Frame;

/// The factor by which bounds are raised, to allow for rounding. A bound takes a few sums and products for each joint;
/// the factor suffices for some thousands of joints.
pub(crate) const ROUNDING_FACTOR: f64 = 1.0 + 1e-11;

/// For each part and each joint that moves it, a bound of its displacement as the frame before that joint sees it.
#[derive(Clone, Debug, Default)]
pub(crate) struct DisplacementBounds {
    /// The joints that move each part, from the nearest one to the one at the base.
    joints: Vec<usize>,
    /// For each part, the start of its joints.
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

    /// Returns the place of the bound for a part as a frame sees it that is nearer to the base; `None` for the part's own
    /// frame.
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

    /// Returns the place of the bound for a part as the base sees it; `None` for a part that rests there.
    pub(crate) fn bound_index_seen_from_base(&self, part: usize) -> Option<u32> {
        let range = self.joint_start_by_part[part]..self.joint_start_by_part[part + 1];
        (!range.is_empty()).then(|| range.end as u32 - 1)
    }

    /// Returns the bound at a place; 0 without one.
    pub(crate) fn bound(&self, index: Option<u32>) -> f64 {
        index.map_or(0.0, |index| self.bounds[index as usize])
    }

    /// Computes the bounds for an interval in whose middle the frames are placed. There and at any other point of the interval
    /// the positions of the joints differ by at most `deviations`. Errors of the frames move points by at most `rounding`.
    /// The centre, the joint's origin and its axis have such an error each.
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
            let centre = frames[part.frame].transform_point(part.centre);
            let mut displacement = 0.0;
            for index in bounds[0]..bounds[1] {
                let number = self.joints[index];
                let joint = &kinematics.joints()[number];
                displacement += if joint.is_prismatic {
                    deviations[number]
                } else {
                    let axis = frames[joint.parent].rotation * joint.axis;
                    let arm = centre - frames[number + 1].translation;
                    let distance = axis.cross(arm).length() + part.ball_radius + 3.0 * rounding;
                    chord_upper_bound(deviations[number]) * distance
                };
                self.bounds[index] = displacement * ROUNDING_FACTOR;
            }
        }
    }
}

/// Returns an upper bound of the chord of an angle on the unit circle: `2 sin(angle/2)`, and 2 beyond half a turn.
#[inline(always)]
pub(crate) fn chord_upper_bound(angle: f64) -> f64 {
    // Written so that NaN stays.
    if angle >= 3.0 {
        return 2.0;
    }
    // The Taylor series alternates, and is exceeded after a positive term.
    let square = angle * angle;
    angle * (1.0 - square * (1.0 / 24.0 - square * (1.0 / 1920.0)))
}
