//! Bounds how far two links move relative to each other within a box of joint positions.
//!
//! Let `k` joints lie between two parts A and B. Choose a reference frame: the link after the first `s` joints from A.
//! Relative to it, the first `s` joints move A and the other joints move B. Every `s` from 0 to `k` gives a valid bound,
//! and the smallest one is used. For example, a revolute joint near A moves A less than B, which is far from the axis.
//!
//! There are two bounds. Let `δ` be the largest deviation of a joint's position from the center of the box:
//!
//! - The *displacement* of a part from its pose at the center of the box is at most the sum of the displacements by each
//!   joint: a chord about a revolute axis, or a distance along a prismatic axis.
//! - Along a *fixed direction* `n`, a point `x` moves by at most `Σ δ |n × ω · (x - o)|` to first order, for joint axes
//!   with directions `ω` through points `o`. The remainder is at most half of `Σ Σ δ δ |n · ∂²x|`. Let joint `j` be
//!   joint `i` or a joint between `i` and the part. The second derivative with respect to both is
//!   `ω_i × (ω_j × (x - o_j))`. Its component along `n` is at most `|n × ω_i|` times the distance of `x` from the axis
//!   of `j`. The displacements bound how much both factors change over the box.

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
    /// For each part and each joint, the largest distance of the part's points from the axis, without the radius of the
    /// rounding ball, because a ball does not change when it rotates. 1 for a prismatic joint.
    lever_arms: [Vec<f64>; 2],
    /// For each part and each joint, the largest displacement of a point by this joint alone.
    displacements: [Vec<f64>; 2],
    /// Scratch memory of [`BoxMotion::gap_lower_bound`]: for each part and each `s`, the extremal coordinate of a point
    /// along the direction, to first order: the largest for A, the least for B.
    extremal_coordinates: [Vec<f64>; 2],
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
    /// Sets the axes of the joints from the link of A to the link of B, at the center of a box of joint positions. Each
    /// comes with the largest deviation of its joint's position from there.
    pub(super) fn set_joint_axes(
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
            self.lever_arms[side].clear();
            self.displacements[side].clear();
            for axis in &self.axes {
                let lever_arm = if axis.is_prismatic {
                    1.0
                } else {
                    let center_distance = axis.direction.cross(center - axis.origin).length();
                    let core_radius = part.ball_radius - part.radius;
                    center_distance + core_radius + 3.0 * self.rounding.of_points
                };
                self.lever_arms[side].push(lever_arm);
                self.displacements[side].push(axis.displacement(lever_arm) * ROUNDING_FACTOR);
            }
        }
        let [displacements_a, displacements_b] = &self.displacements;
        let mut bound: f64 = displacements_b.iter().sum();
        let mut best = Displacement { bound, split: 0 };
        for (joint, (a, b)) in displacements_a.iter().zip(displacements_b).enumerate() {
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
        let (a, b) = (
            &displacements_a[..best.split],
            &displacements_b[best.split..],
        );
        best.bound = a.iter().chain(b).sum::<f64>() * ROUNDING_FACTOR;
        best
    }

    /// Returns the index of the joint that contributes most to a displacement; `None` without joints.
    pub(super) fn main_joint(&self, displacement: Displacement) -> Option<usize> {
        let [displacements_a, displacements_b] = &self.displacements;
        let contribution = |joint: usize| {
            if joint < displacement.split {
                displacements_a[joint]
            } else {
                displacements_b[joint]
            }
        };
        (0..self.axes.len()).max_by(|&a, &b| contribution(a).total_cmp(&contribution(b)))
    }

    /// Returns a lower bound of the distance of two parts over the whole box, along a unit direction from A to B.
    /// [`BoxMotion::displacement`] must have been called for the same parts before. Returns negative infinity if the
    /// second-order remainder is at least the gap at the center.
    pub(super) fn gap_lower_bound(
        &mut self,
        direction: DVec3,
        parts: [&HullPart; 2],
        frames: [&Frame; 2],
        gap_at_center: f64,
    ) -> f64 {
        let count = self.axes.len();
        let remainders: Vec<f64> = (0..=count)
            .map(|split| self.remainder(direction, split))
            .collect();
        let least_remainder = remainders.iter().copied().fold(f64::INFINITY, lesser);
        // Written so that NaN proves nothing.
        if !(least_remainder < gap_at_center) {
            return f64::NEG_INFINITY;
        }
        self.compute_extremal_coordinates(direction, parts, frames);
        let [largest_of_a, least_of_b] = &self.extremal_coordinates;
        let mut best = f64::NEG_INFINITY;
        for split in 0..=count {
            best = greater(
                best,
                least_of_b[split] - largest_of_a[split] - remainders[split],
            );
        }
        // Both coordinates have the error of a point. A first-order term is a deviation times a lever arm, along a
        // direction with the errors of two unit vectors.
        let terms: f64 = (0..2).map(|side| self.first_order_sum(side)).sum();
        let error_bound = 4.0 * (self.rounding.of_points + self.rounding.of_directions * terms);
        best - parts[0].radius - parts[1].radius - error_bound
    }

    /// Bounds the second-order remainder of both parts' motions along a direction.
    fn remainder(&self, direction: DVec3, split: usize) -> f64 {
        let remainder_of_b = self.side_remainder(direction, 1, &(split..self.axes.len()));
        let remainder_of_a = self.side_remainder(direction, 0, &(0..split).rev());
        (remainder_of_a + remainder_of_b) * ROUNDING_FACTOR
    }

    /// Bounds the second-order remainder of one part's motion along a direction. `joints` are the joints that move the
    /// part. The joint nearest to the part comes last.
    fn side_remainder(
        &self,
        direction: DVec3,
        side: usize,
        joints: &(impl Iterator<Item = usize> + Clone),
    ) -> f64 {
        let (mut sum_of_tilts, mut total) = (0.0, 0.0);
        for (index, joint) in joints.clone().enumerate() {
            let axis = &self.axes[joint];
            let (max_lever_arm, tilt) = if axis.is_prismatic {
                (1.0, 0.0)
            } else {
                let error = 2.0 * self.rounding.of_directions;
                let joints_before = joints.clone().take(index).map(|other| &self.axes[other]);
                let max_turn: f64 = joints_before
                    .map(|other| other.max_change_of(axis.direction, error))
                    .sum();
                let tilt = direction.cross(axis.direction).length() + error + max_turn;
                let joints_after = joints.clone().skip(index + 1);
                let max_displacement: f64 = joints_after
                    .map(|other| self.displacements[side][other])
                    .sum();
                (
                    self.lever_arms[side][joint] + max_displacement,
                    lesser(tilt, 1.0),
                )
            };
            total += axis.deviation * max_lever_arm * (0.5 * axis.deviation * tilt + sum_of_tilts);
            sum_of_tilts += axis.deviation * tilt;
        }
        total
    }

    /// Bounds how far a point of a part moves, to first order, along any direction.
    fn first_order_sum(&self, side: usize) -> f64 {
        let joints = self.axes.iter().zip(&self.lever_arms[side]);
        joints
            .map(|(axis, lever_arm)| axis.deviation * lever_arm)
            .sum()
    }

    /// Computes, for each `s`, the largest coordinate of A and the least of B along a direction, to first order.
    fn compute_extremal_coordinates(
        &mut self,
        direction: DVec3,
        parts: [&HullPart; 2],
        frames: [&Frame; 2],
    ) {
        let count = self.axes.len();
        let first_order_sums = [0, 1].map(|side| self.first_order_sum(side));
        let BoxMotion {
            axes,
            extremal_coordinates,
            ..
        } = self;
        let mut slopes = Vec::with_capacity(count);
        for (side, sign) in [(0, -1.0), (1, 1.0)] {
            let (frame, part) = (frames[side], parts[side]);
            let least = &mut extremal_coordinates[side];
            let signed_direction = frame.inverse_transform_vector(direction) * sign;
            let offset = direction.dot(frame.translation) * sign;
            slopes.clear();
            slopes.extend(axes.iter().map(|axis| axis.slope(direction, frame)));
            least.clear();
            least.resize(count + 1, f64::INFINITY);
            let (_, lowest) = part.extremal_corner(signed_direction);
            let limit = signed_direction.dot(lowest) + 2.0 * first_order_sums[side];
            for &point in part.points() {
                let mut coordinate = signed_direction.dot(point);
                // This corner cannot have the least coordinate.
                if coordinate > limit {
                    continue;
                }
                coordinate += offset;
                let term = |joint: usize| {
                    let (slope, constant): (DVec3, f64) = slopes[joint];
                    (slope.dot(point) + constant).abs()
                };
                if side == 0 {
                    least[0] = lesser(least[0], coordinate);
                    for joint in 0..count {
                        coordinate -= term(joint);
                        least[joint + 1] = lesser(least[joint + 1], coordinate);
                    }
                } else {
                    least[count] = lesser(least[count], coordinate);
                    for joint in (0..count).rev() {
                        coordinate -= term(joint);
                        least[joint] = lesser(least[joint], coordinate);
                    }
                }
            }
        }
        for coordinate in &mut self.extremal_coordinates[0] {
            *coordinate = -*coordinate;
        }
    }
}

impl JointAxis {
    /// Returns the largest displacement of a point at the distance `lever_arm` from the axis.
    fn displacement(&self, lever_arm: f64) -> f64 {
        if self.is_prismatic {
            self.deviation
        } else {
            self.chord * lever_arm
        }
    }

    /// Bounds the length by which the joint changes a unit vector. `error` bounds the rounding error of the vector
    /// product with the axis.
    fn max_change_of(&self, vector: DVec3, error: f64) -> f64 {
        self.chord * (self.direction.cross(vector).length() + error)
    }

    /// Returns the slope and the constant of a linear function of the points in a frame. Its absolute value is the
    /// distance by which a point moves along a direction, to first order.
    fn slope(&self, direction: DVec3, frame: &Frame) -> (DVec3, f64) {
        if self.is_prismatic {
            return (DVec3::ZERO, self.deviation * direction.dot(self.direction));
        }
        let moment = self.deviation * direction.cross(self.direction);
        let constant = moment.dot(frame.translation - self.origin);
        (frame.inverse_transform_vector(moment), constant)
    }
}
