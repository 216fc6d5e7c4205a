//! Bounds how far two links move relative to each other within a box of joint positions.
//!
//! Let `k` joints lie between two parts A and B. In the frame of the link after the first `s` joints, these joints
//! move A and the other joints move B. Every `s` from 0 to `k` gives a valid bound, and the best is used. If a joint
//! near A turns, A moves less than B, which is far from the axis.
//!
//! There are two bounds. Let `δ` be the largest deviation of a joint's position from the center of the box:
//!
//! - The *displacement* of a part is at most the sum of the displacements that the joints cause one by one, from the
//!   position at the center: a chord about a revolute axis, or a distance along a prismatic one.
//! - Along a *fixed direction* `n`, a point `x` moves by `Σ δ |n × ω · (x - o)|` to first order, for joint axes with
//!   directions `ω` through points `o`. The remainder is at most half of `Σ Σ δ δ |n · ∂²x|`. The second derivative by
//!   joint `i`, and by joint `j` that is nearer to the part or the same, is `ω_i × (ω_j × (x - o_j))`. Along `n` it is
//!   at most `|n × ω_i|` times the distance of `x` from the axis of `j`. The displacements bound both factors over the
//!   box.

use crate::cell::part::HullPart;
use crate::cell::rounding::PoseRounding;
use crate::kinematics::Kinematics;
use crate::solver::displacement::{ROUNDING_FACTOR, chord_upper_bound};
use ccd_core::order::{greater, lesser};
use rigid_ccd::glam::DVec3;
use rigid_ccd::oracle::Frame;

/// The joints between two links at the center of a box, and motion bounds for a pair of their parts.
#[derive(Debug, Default)]
pub(super) struct BoxMotion {
    axes: Vec<JointAxis>,
    rounding: PoseRounding,
    /// For either part and each joint, the largest distance of the part's points from the axis. The rounding ball is
    /// left out, because it stays a ball. 1 for a prismatic joint.
    arms: [Vec<f64>; 2],
    /// For either part and each joint, the largest displacement of a point by this joint alone.
    displacements: [Vec<f64>; 2],
    /// Scratch memory of [`BoxMotion::gap_lower_bound`]: for each `s`, the lowest height of B and the highest of A.
    heights: [Vec<f64>; 2],
}

/// The axis of a joint at the center of a box.
#[derive(Clone, Copy, Debug)]
struct JointAxis {
    direction: DVec3,
    /// A point of the axis.
    origin: DVec3,
    /// The largest deviation of the joint's position from the center.
    deviation: f64,
    /// The largest displacement of a point at distance 1 from the axis; 0 for a prismatic joint.
    chord: f64,
    is_prismatic: bool,
}

/// A bound of the relative displacement of two parts.
#[derive(Clone, Copy, Debug)]
pub(super) struct Displacement {
    pub(super) bound: f64,
    /// The number `s` of joints that move the first part in this bound.
    split: usize,
}

impl BoxMotion {
    /// Sets the joints from the link of A to the link of B, at the center of a box, each with the largest deviation of
    /// its position.
    pub(super) fn place(
        &mut self,
        kinematics: &Kinematics,
        frames: &[Frame],
        rounding: PoseRounding,
        joints: impl Iterator<Item = (usize, f64)>,
    ) {
        self.rounding = rounding;
        self.axes.clear();
        self.axes.extend(joints.map(|(index, deviation)| {
            let joint = &kinematics.joints()[index];
            JointAxis {
                direction: frames[joint.parent].rotation * joint.axis,
                origin: frames[index + 1].translation,
                deviation,
                chord: if joint.is_prismatic {
                    0.0
                } else {
                    chord_upper_bound(deviation)
                },
                is_prismatic: joint.is_prismatic,
            }
        }));
    }

    /// Bounds the relative displacement of two parts with the given centers.
    pub(super) fn displacement(
        &mut self,
        parts: [&HullPart; 2],
        centers: [DVec3; 2],
    ) -> Displacement {
        for side in 0..2 {
            let (part, center) = (parts[side], centers[side]);
            self.arms[side].clear();
            self.displacements[side].clear();
            for axis in &self.axes {
                let arm = if axis.is_prismatic {
                    1.0
                } else {
                    let from_axis = axis.direction.cross(center - axis.origin).length();
                    let core_radius = part.ball_radius - part.radius;
                    from_axis + core_radius + 3.0 * self.rounding.of_points
                };
                self.arms[side].push(arm);
                self.displacements[side].push(axis.displacement(arm) * ROUNDING_FACTOR);
            }
        }
        let [of_a, of_b] = &self.displacements;
        let mut bound: f64 = of_b.iter().sum();
        let mut best = Displacement { bound, split: 0 };
        for (joint, (a, b)) in of_a.iter().zip(of_b).enumerate() {
            bound += a - b;
            // Written so that a NaN replaces the bound: a NaN proves nothing.
            if !(bound >= best.bound) {
                best = Displacement {
                    bound,
                    split: joint + 1,
                };
            }
        }
        // Sums again, because the running sum of differences has larger rounding errors.
        let (a, b) = (&of_a[..best.split], &of_b[best.split..]);
        best.bound = a.iter().chain(b).sum::<f64>() * ROUNDING_FACTOR;
        best
    }

    /// Returns the index of the joint that contributes most to a displacement; `None` without joints.
    pub(super) fn main_joint(&self, displacement: Displacement) -> Option<usize> {
        let [of_a, of_b] = &self.displacements;
        let fraction = |joint: usize| {
            if joint < displacement.split {
                of_a[joint]
            } else {
                of_b[joint]
            }
        };
        (0..self.axes.len()).max_by(|&a, &b| fraction(a).total_cmp(&fraction(b)))
    }

    /// Returns a lower bound of the distance of two parts over the whole box, along a unit direction from A to B. The
    /// parts must be those of the last call of [`BoxMotion::displacement`]. Returns negative infinity if the
    /// second-order remainder exceeds the gap at the center.
    pub(super) fn gap_lower_bound(
        &mut self,
        direction: DVec3,
        parts: [&HullPart; 2],
        frames: [&Frame; 2],
        gap_in_middle: f64,
    ) -> f64 {
        let count = self.axes.len();
        let remainders: Vec<f64> = (0..=count)
            .map(|split| self.remainder(direction, split))
            .collect();
        let least = remainders.iter().copied().fold(f64::INFINITY, lesser);
        // Written so that NaN proves nothing.
        if !(least < gap_in_middle) {
            return f64::NEG_INFINITY;
        }
        self.measure_heights(direction, parts, frames);
        let [of_a, of_b] = &self.heights;
        let mut best = f64::NEG_INFINITY;
        for split in 0..=count {
            best = greater(best, of_b[split] - of_a[split] - remainders[split]);
        }
        // The heights have the errors of two points. A first-order term is a deviation times an arm; the error of its
        // direction is that of two unit vectors.
        let terms: f64 = (0..2).map(|side| self.first_order_sum(side)).sum();
        let allowance = 4.0 * (self.rounding.of_points + self.rounding.of_directions * terms);
        best - parts[0].radius - parts[1].radius - allowance
    }

    /// Bounds the second-order remainder of both parts' motions along a direction.
    fn remainder(&self, direction: DVec3, split: usize) -> f64 {
        let to_b = self.side_remainder(direction, 1, &(split..self.axes.len()));
        let to_a = self.side_remainder(direction, 0, &(0..split).rev());
        (to_a + to_b) * ROUNDING_FACTOR
    }

    /// Bounds the second-order remainder of one part's motion along a direction. `joints` are those that move the
    /// part, the nearest to the part last.
    fn side_remainder(
        &self,
        direction: DVec3,
        side: usize,
        joints: &(impl Iterator<Item = usize> + Clone),
    ) -> f64 {
        let (mut inner, mut total) = (0.0, 0.0);
        for (index, joint) in joints.clone().enumerate() {
            let axis = &self.axes[joint];
            let (reach, tilt) = if axis.is_prismatic {
                (1.0, 0.0)
            } else {
                let error = 2.0 * self.rounding.of_directions;
                let before = joints.clone().take(index).map(|other| &self.axes[other]);
                let turned: f64 = before.map(|other| other.turns(axis.direction, error)).sum();
                let tilt = direction.cross(axis.direction).length() + error + turned;
                let after = joints.clone().skip(index + 1);
                let displaced: f64 = after.map(|other| self.displacements[side][other]).sum();
                (self.arms[side][joint] + displaced, lesser(tilt, 1.0))
            };
            total += axis.deviation * reach * (0.5 * axis.deviation * tilt + inner);
            inner += axis.deviation * tilt;
        }
        total
    }

    /// Bounds how far a point of a part moves, to first order, along any direction.
    fn first_order_sum(&self, side: usize) -> f64 {
        let joints = self.axes.iter().zip(&self.arms[side]);
        joints.map(|(axis, arm)| axis.deviation * arm).sum()
    }

    /// Computes for each `s` the lowest height of B and the highest of A along a direction, to first order.
    fn measure_heights(&mut self, direction: DVec3, parts: [&HullPart; 2], frames: [&Frame; 2]) {
        let count = self.axes.len();
        let first_order_sums = [0, 1].map(|side| self.first_order_sum(side));
        let BoxMotion { axes, heights, .. } = self;
        let mut slopes = Vec::with_capacity(count);
        for (side, sign) in [(0, -1.0), (1, 1.0)] {
            let (frame, part, heights) = (frames[side], parts[side], &mut heights[side]);
            let along = frame.inverse_transform_vector(direction) * sign;
            let offset = direction.dot(frame.translation) * sign;
            slopes.clear();
            slopes.extend(axes.iter().map(|axis| axis.slope(direction, frame)));
            heights.clear();
            heights.resize(count + 1, f64::INFINITY);
            let (_, lowest) = part.extremal_corner(along);
            let limit = along.dot(lowest) + 2.0 * first_order_sums[side];
            for &point in part.points() {
                let mut height = along.dot(point);
                // This corner cannot become the lowest one.
                if height > limit {
                    continue;
                }
                height += offset;
                let term = |joint: usize| {
                    let (slope, constant): (DVec3, f64) = slopes[joint];
                    (slope.dot(point) + constant).abs()
                };
                if side == 0 {
                    heights[0] = lesser(heights[0], height);
                    for joint in 0..count {
                        height -= term(joint);
                        heights[joint + 1] = lesser(heights[joint + 1], height);
                    }
                } else {
                    heights[count] = lesser(heights[count], height);
                    for joint in (0..count).rev() {
                        height -= term(joint);
                        heights[joint] = lesser(heights[joint], height);
                    }
                }
            }
        }
        for height in &mut self.heights[0] {
            *height = -*height;
        }
    }
}

impl JointAxis {
    /// Returns the largest displacement of a point at distance `arm` from the axis.
    fn displacement(&self, arm: f64) -> f64 {
        if self.is_prismatic {
            self.deviation
        } else {
            self.chord * arm
        }
    }

    /// Bounds how far the joint turns a unit vector whose angle to the axis has an error.
    fn turns(&self, vector: DVec3, error: f64) -> f64 {
        self.chord * (self.direction.cross(vector).length() + error)
    }

    /// Returns a linear function of points in a frame. Its absolute value is how far a point moves along a direction,
    /// to first order.
    fn slope(&self, direction: DVec3, frame: &Frame) -> (DVec3, f64) {
        if self.is_prismatic {
            return (DVec3::ZERO, self.deviation * direction.dot(self.direction));
        }
        let across = self.deviation * direction.cross(self.direction);
        let constant = across.dot(frame.translation - self.origin);
        (frame.inverse_transform_vector(across), constant)
    }
}
