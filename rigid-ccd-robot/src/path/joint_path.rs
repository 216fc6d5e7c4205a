//! The positions of all moving joints along a path, as polynomials on each segment.
//!
//! Between two configurations joints move at constant rates, so the polynomials have degree 1. The polynomials of a
//! [`JointCurve`] may have higher degrees. The variable of a polynomial is the elapsed fraction of the segment.

use super::interval::PathInterval;
use crate::cell::rounding::U;
use crate::joint_curve::JointCurve;
use crate::kinematics::joint_arms::JointMotion;
use crate::kinematics::magnitude::Magnitude;
use crate::kinematics::{Kinematics, MovingJoint};
use crate::path_point::PathPoint;
use crate::polynomial::{EXTENDED_PRECISION_ERROR, Polynomial};
use ccd_core::double_double::DoubleDouble;
use ccd_core::order::{greater, lesser};

/// The positions of all moving joints along a path.
#[derive(Debug, Default)]
pub struct JointPath {
    joint_count: usize,
    segment_count: usize,
    degree: usize,
    /// The coefficients, by segment, then by power (lowest first), then by joint. A path without segments has constant
    /// terms only.
    coefficients: Vec<f64>,
    /// The rounding errors of the coefficients of a curve: exact value minus f64. Empty for other paths.
    low_coefficients: Vec<f64>,
    /// For each segment and joint, lower and upper bounds of its positions.
    ranges: Vec<[f64; 2]>,
    /// For each joint, the magnitude of its positions on the path.
    magnitudes: Vec<Magnitude>,
}

impl JointPath {
    /// Replaces the path by a sequence of configurations.
    pub(crate) fn set_configurations<Q: AsRef<[f64]>>(
        &mut self,
        kinematics: &Kinematics,
        configurations: &[Q],
    ) {
        let joints = kinematics.joints();
        self.clear(joints.len(), configurations.len().saturating_sub(1), 1);
        for (k, start) in configurations.iter().enumerate() {
            let start = start.as_ref();
            for (joint, magnitude) in joints.iter().zip(&mut self.magnitudes) {
                let rounding = joint.source.magnitude(start);
                *magnitude = magnitude.or_larger(Magnitude {
                    position: rounding,
                    rounding,
                });
                self.coefficients.push(joint.source.position(start));
            }
            let Some(end) = configurations.get(k + 1) else {
                break;
            };
            for joint in joints {
                let [from, to] = [start, end.as_ref()].map(|at| joint.source.position(at));
                self.coefficients.push(to - from);
                self.ranges.push([lesser(from, to), greater(from, to)]);
            }
        }
        if self.segment_count > 0 {
            // The last configuration starts no segment.
            let end = self.segment_count * 2 * self.joint_count;
            self.coefficients.truncate(end);
        }
    }

    /// Replaces the path by a curve.
    pub(crate) fn set_curve(&mut self, kinematics: &Kinematics, curve: &JointCurve) {
        let (joints, degree) = (kinematics.joints(), curve.degree());
        self.clear(joints.len(), curve.segment_count(), degree);
        for segment in 0..self.segment_count {
            for power in 0..=degree {
                for MovingJoint { source, .. } in joints {
                    let coefficient = curve.coefficient(segment, power, source.position_index);
                    let [high, low] = source.polynomial_coefficient(power, coefficient).parts();
                    self.coefficients.push(high);
                    self.low_coefficients.push(low);
                }
            }
            for (joint_index, joint) in joints.iter().enumerate() {
                let polynomial = self.polynomial(segment, joint_index);
                let range = polynomial.range();
                let position = greater(range[0].abs(), range[1].abs());
                let product = position + joint.source.offset.abs();
                let rounding = joint.source.magnitude_of_product(product)
                    + EXTENDED_PRECISION_ERROR / U * polynomial.coefficient_magnitude_sum();
                let magnitude = &mut self.magnitudes[joint_index];
                *magnitude = magnitude.or_larger(Magnitude { position, rounding });
                self.ranges.push(range);
            }
        }
    }

    fn clear(&mut self, joint_count: usize, segment_count: usize, degree: usize) {
        self.joint_count = joint_count;
        self.segment_count = segment_count;
        self.degree = degree;
        self.coefficients.clear();
        self.low_coefficients.clear();
        self.ranges.clear();
        self.magnitudes.clear();
        self.magnitudes.resize(joint_count, Magnitude::default());
    }

    /// Returns the number of segments.
    pub(crate) fn segment_count(&self) -> usize {
        self.segment_count
    }

    /// Returns whether all joints move at constant rates within each segment.
    pub(crate) fn has_constant_rates(&self) -> bool {
        self.degree <= 1
    }

    /// Returns where each joint starts in a segment with constant rates, and how far it moves.
    #[inline(always)]
    pub(crate) fn starts_and_changes(&self, segment: usize) -> (&[f64], &[f64]) {
        (
            self.coefficient_row(segment, 0),
            self.coefficient_row(segment, 1),
        )
    }

    /// Returns, for each joint, the magnitude of its positions on the path.
    pub(crate) fn magnitudes(&self) -> impl Iterator<Item = Magnitude> + Clone {
        self.magnitudes.iter().copied()
    }

    /// Computes the positions of all joints at a point of the path.
    #[inline(always)]
    pub(crate) fn interpolate(&self, at: f64, positions: &mut Vec<f64>) {
        let segment = PathPoint::from_path_position(at, self.segment_count).segment;
        self.interpolate_in_segment(segment, at, positions);
    }

    /// Computes the positions of all joints at a point of a segment, including its ends.
    #[inline(always)]
    pub(crate) fn interpolate_in_segment(&self, segment: usize, at: f64, positions: &mut Vec<f64>) {
        let fraction = at - segment as f64;
        positions.clear();
        if fraction == 0.0 {
            positions.extend_from_slice(self.coefficient_row(segment, 0));
            return;
        }
        if !self.has_constant_rates() {
            let joints = 0..self.joint_count;
            positions.extend(joints.map(|joint| self.polynomial(segment, joint).value(fraction)));
            return;
        }
        let [starts, changes] = [0, 1].map(|power| self.coefficient_row(segment, power));
        let joints = starts.iter().zip(changes);
        positions.extend(joints.map(|(start, change)| start + fraction * change));
    }

    /// Computes the rates of all joints at a point of a segment.
    #[inline(always)]
    pub(crate) fn rates_in_segment(&self, segment: usize, at: f64, rates: &mut Vec<f64>) {
        rates.clear();
        if self.has_constant_rates() {
            rates.extend_from_slice(self.coefficient_row(segment, 1));
        } else {
            let rate = |joint| self.position_and_rate(segment, at - segment as f64, joint)[1];
            rates.extend((0..self.joint_count).map(rate));
        }
    }

    /// Bounds the motion of a joint in a segment. The position is bounded for the whole path.
    pub(crate) fn joint_motion(&self, segment: usize, joint: usize) -> JointMotion {
        let position = self.magnitudes[joint].position;
        if self.has_constant_rates() {
            return JointMotion {
                position,
                rate: self.coefficient_row(segment, 1)[joint].abs(),
                acceleration: 0.0,
            };
        }
        let expanded = self.polynomial(segment, joint).expanded_about(0.5);
        JointMotion {
            position,
            rate: expanded.rate_bound(0.5),
            acceleration: expanded.second_derivative_bound(0.5),
        }
    }

    /// Computes, for each joint, the largest deviation within an interval from its position at the midpoint, which is
    /// in `positions`.
    #[inline(always)]
    pub(crate) fn max_joint_deviations_from_middle(
        &self,
        interval: &PathInterval,
        positions: &[f64],
        deviations: &mut Vec<f64>,
    ) {
        deviations.clear();
        if self.segment_count == 0 {
            deviations.resize(self.joint_count, 0.0);
        } else if interval.is_within_segment() {
            // The midpoint is equally far from both ends.
            let half = 0.5 * (interval.to - interval.from);
            let segment = PathPoint::from_path_position(interval.from, self.segment_count).segment;
            if self.has_constant_rates() {
                let changes = self.coefficient_row(segment, 1).iter();
                deviations.extend(changes.map(|change| half * change.abs()));
            } else {
                let midpoint = interval.middle() - segment as f64;
                let joints = 0..self.joint_count;
                deviations.extend(joints.map(|joint| {
                    let polynomial = self.polynomial(segment, joint);
                    polynomial.expanded_about(midpoint).deviation_bound(half)
                }));
            }
        } else {
            deviations.resize(self.joint_count, 0.0);
            for segment in interval.from as usize..interval.to as usize {
                let ranges = &self.ranges[segment * self.joint_count..][..self.joint_count];
                for ((largest, range), position) in deviations.iter_mut().zip(ranges).zip(positions)
                {
                    for bound in range {
                        // Written so that NaN stays.
                        let deviation = (bound - position).abs();
                        if !(deviation <= *largest) {
                            *largest = deviation;
                        }
                    }
                }
            }
        }
    }

    /// Returns the position of a joint of a curve at a fraction of a segment.
    pub(crate) fn position(&self, segment: usize, fraction: f64, joint: usize) -> f64 {
        self.polynomial(segment, joint).value(fraction)
    }

    /// Returns the position and the rate of a joint of a curve at a fraction of a segment.
    pub(crate) fn position_and_rate(
        &self,
        segment: usize,
        fraction: f64,
        joint: usize,
    ) -> [f64; 2] {
        self.polynomial(segment, joint).value_and_rate(fraction)
    }

    /// Bounds how far a joint of a curve deviates from a motion at a constant rate between two fractions of a segment.
    /// The bound allows for an error of one ulp of 1 in the fractions.
    pub(crate) fn chord_deviation_bound(
        &self,
        segment: usize,
        [from, to]: [f64; 2],
        joint: usize,
    ) -> f64 {
        let (half, rounding) = (0.5 * (to - from), f64::EPSILON);
        let expanded = self.polynomial(segment, joint).expanded_about(from + half);
        // The midpoint is rounded, too.
        expanded.chord_deviation_bound(half + rounding)
            + rounding * expanded.rate_bound(half + rounding)
    }

    #[inline(always)]
    fn coefficient_row(&self, segment: usize, power: usize) -> &[f64] {
        let start = (segment * (self.degree + 1) + power) * self.joint_count;
        &self.coefficients[start..][..self.joint_count]
    }

    /// Returns the position of a joint of a curve as a polynomial on a segment.
    fn polynomial(&self, segment: usize, joint: usize) -> Polynomial {
        let first = segment * (self.degree + 1) * self.joint_count + joint;
        Polynomial::new(self.degree, |power| {
            let index = first + power * self.joint_count;
            DoubleDouble::from_parts([self.coefficients[index], self.low_coefficients[index]])
        })
    }
}
