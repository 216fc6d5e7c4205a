//! Bounds of the displacements of all parts over a stretch of an edge.
//!
//! A part moves with the joints between it and the base. As the frame before a joint sees it, a point has the speed that
//! it has in the frame after the joint, and in addition the joint's rate times the distance from its axis. That distance
//! is at most the one in the middle of the stretch and the displacement since then.

use super::kinematics::Kinematics;
use crate::cell::part::Part;
use rigid_ccd::oracle::Frame;

/// The factor by which bounds are rounded up: they are sums and products of a few values for each joint, of which there
/// are at most some thousands.
const ROUNDED_UP: f64 = 1.0 + 1e-11;

/// For each part and each joint that moves it, a bound of its displacement as the frame before that joint sees it.
#[derive(Clone, Debug, Default)]
pub(crate) struct Displacements {
    /// The joints that move each part, from the nearest one to the one at the base.
    joints: Vec<usize>,
    /// For each part, the start of its joints.
    starts: Vec<usize>,
    bounds: Vec<f64>,
}

impl Displacements {
    pub(crate) fn new(kinematics: &Kinematics, parts: &[Part]) -> Self {
        let mut all = Displacements::default();
        for part in parts {
            all.starts.push(all.joints.len());
            let mut frame = part.frame;
            while frame > 0 {
                all.joints.push(frame - 1);
                frame = kinematics.joints()[frame - 1].parent;
            }
        }
        all.starts.push(all.joints.len());
        all.bounds = vec![0.0; all.joints.len()];
        all
    }

    /// Returns the place of the bound for a part as a frame sees it that is nearer to the base; `None` for the part's own
    /// frame.
    pub(crate) fn slot(
        &self,
        kinematics: &Kinematics,
        part: usize,
        seen_from: usize,
    ) -> Option<u32> {
        let joints = &self.joints[self.starts[part]..self.starts[part + 1]];
        let parent = |joint: usize| kinematics.joints()[joint].parent;
        let step = joints
            .iter()
            .position(|&joint| parent(joint) == seen_from)?;
        Some((self.starts[part] + step) as u32)
    }

    /// Returns the place of the bound for a part as the base sees it; `None` for a part that rests there.
    pub(crate) fn slot_at_base(&self, part: usize) -> Option<u32> {
        let range = self.starts[part]..self.starts[part + 1];
        (!range.is_empty()).then(|| range.end as u32 - 1)
    }

    /// Returns the bound at a place; 0 without one.
    pub(crate) fn bound(&self, slot: Option<u32>) -> f64 {
        slot.map_or(0.0, |slot| self.bounds[slot as usize])
    }

    /// Computes the bounds for the time `half` before and after the one at which the frames are placed, with the absolute
    /// rates of all joints. Errors of the frames move points by at most `rounding`. The centre, the joint's origin and its
    /// axis have such an error each.
    pub(crate) fn update(
        &mut self,
        kinematics: &Kinematics,
        parts: &[Part],
        frames: &[Frame],
        rates: &[f64],
        (half, rounding): (f64, f64),
    ) {
        for (part, bounds) in parts.iter().zip(self.starts.windows(2)) {
            let centre = frames[part.frame].point(part.centre);
            let mut speed = 0.0;
            for slot in bounds[0]..bounds[1] {
                let number = self.joints[slot];
                let joint = &kinematics.joints()[number];
                let distance = if joint.is_prismatic {
                    1.0
                } else {
                    let axis = frames[joint.parent].rotation * joint.axis;
                    let arm = centre - frames[number + 1].translation;
                    axis.cross(arm).length() + part.ball_radius + half * speed + 3.0 * rounding
                };
                speed += rates[number] * distance;
                self.bounds[slot] = half * speed * ROUNDED_UP;
            }
        }
    }
}
