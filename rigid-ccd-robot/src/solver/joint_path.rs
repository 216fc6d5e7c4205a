//! The positions of all moving joints along a path: polynomials of the share of each segment.
//!
//! Between two configurations of a path all joints move at constant rates: the polynomials are of degree 1. A
//! [`JointCurve`] has polynomials of a higher degree.

use super::kinematics::Kinematics;
use super::rounding::Magnitude;
use super::stretch::{PathPoint, Stretch};
use crate::joint_curve::{JointCurve, MAX_DEGREE};
use ccd_core::order::{greater, lesser};

/// The positions of all moving joints along a path.
#[derive(Debug, Default)]
pub struct JointPath {
    joint_count: usize,
    segment_count: usize,
    degree: usize,
    /// The coefficients of each segment; for each power of the share, lowest first, those of all joints. A path without
    /// segments has the constant ones.
    coefficients: Vec<f64>,
    /// For each segment and joint, bounds of its positions.
    ranges: Vec<[f64; 2]>,
    /// For each joint, the magnitude of its positions on the path.
    magnitudes: Vec<Magnitude>,
}

impl JointPath {
    /// Replaces the path by one through configurations.
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
            // The last configuration is the end of a segment.
            let end = self.segment_count * 2 * self.joint_count;
            self.coefficients.truncate(end);
        }
    }

    /// Replaces the path by a curve.
    pub(crate) fn set_curve(&mut self, kinematics: &Kinematics, curve: &JointCurve) {
        let (joints, degree) = (kinematics.joints(), curve.degree());
        self.clear(joints.len(), curve.segment_count(), degree);
        for segment in 0..self.segment_count {
            let first = self.coefficients.len();
            for power in 0..=degree {
                let given = curve.coefficients(segment, power);
                let own = joints.iter().map(|joint| match power {
                    0 => joint.source.position(given),
                    _ => joint.source.factor() * given[joint.source.position_index()],
                });
                self.coefficients.extend(own);
            }
            for (number, joint) in joints.iter().enumerate() {
                let polynomial = |power| self.coefficients[first + power * joints.len() + number];
                let polynomial = Polynomial::new(degree, polynomial);
                let magnitudes = (0..=degree)
                    .map(|power| joint.source.magnitude(curve.coefficients(segment, power)));
                let rounding = rounding_factor(degree) * magnitudes.sum::<f64>();
                let range = polynomial.about(0.5).range(0.5, MAX_RANGE_HALVINGS);
                let position = greater(range[0].abs(), range[1].abs());
                let magnitude = &mut self.magnitudes[number];
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

    /// Returns for each joint the magnitude of its positions on the path.
    pub(crate) fn magnitudes(&self) -> impl Iterator<Item = Magnitude> {
        self.magnitudes.iter().copied()
    }

    /// Computes the positions of all joints at a point of the path.
    #[inline(always)]
    pub(crate) fn interpolate(&self, at: f64, positions: &mut Vec<f64>) {
        let segment = PathPoint::from_path_position(at, self.segment_count).segment;
        self.interpolate_in_segment(segment, at, positions);
    }

    /// Computes the positions of all joints at a point of a segment, its ends included.
    #[inline(always)]
    pub(crate) fn interpolate_in_segment(&self, segment: usize, at: f64, positions: &mut Vec<f64>) {
        let share = at - segment as f64;
        positions.clear();
        if share == 0.0 {
            positions.extend_from_slice(self.coefficient_row(segment, 0));
            return;
        }
        // Horner's rule.
        positions.extend_from_slice(self.coefficient_row(segment, self.degree));
        for power in (0..self.degree).rev() {
            let row = self.coefficient_row(segment, power);
            for (position, coefficient) in positions.iter_mut().zip(row) {
                *position = coefficient + share * *position;
            }
        }
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
        if self.segment_count == 0 {
            deviations.resize(self.joint_count, 0.0);
        } else if stretch.is_within_segment() {
            // The middle is at the same distance from both ends.
            let half = 0.5 * (stretch.to - stretch.from);
            let segment = PathPoint::from_path_position(stretch.from, self.segment_count).segment;
            if self.has_constant_rates() {
                let changes = self.coefficient_row(segment, 1).iter();
                deviations.extend(changes.map(|change| half * change.abs()));
            } else {
                let middle = stretch.middle() - segment as f64;
                let joints = 0..self.joint_count;
                deviations.extend(joints.map(|joint| {
                    let polynomial = self.polynomial(segment, joint);
                    polynomial.about(middle).deviation_bound(half)
                }));
            }
        } else {
            deviations.resize(self.joint_count, 0.0);
            for segment in stretch.from as usize..stretch.to as usize {
                let ranges = &self.ranges[segment * self.joint_count..][..self.joint_count];
                for ((largest, range), middle) in deviations.iter_mut().zip(ranges).zip(positions) {
                    for bound in range {
                        // Written so that NaN stays.
                        let deviation = (bound - middle).abs();
                        if !(deviation <= *largest) {
                            *largest = deviation;
                        }
                    }
                }
            }
        }
    }

    /// Returns the position of a joint at a point of a segment.
    pub(crate) fn position(&self, segment: usize, at: f64, joint: usize) -> f64 {
        let share = at - segment as f64;
        self.polynomial(segment, joint).about(share).constant()
    }

    /// Bounds how far a joint is from its position at a constant rate between two points of a segment.
    pub(crate) fn chord_deviation_bound(
        &self,
        segment: usize,
        [from, to]: [f64; 2],
        joint: usize,
    ) -> f64 {
        let half = 0.5 * (to - from);
        let middle = from + half - segment as f64;
        let polynomial = self.polynomial(segment, joint);
        polynomial.about(middle).chord_deviation_bound(half)
    }

    #[inline(always)]
    fn coefficient_row(&self, segment: usize, power: usize) -> &[f64] {
        let start = (segment * (self.degree + 1) + power) * self.joint_count;
        &self.coefficients[start..][..self.joint_count]
    }

    fn polynomial(&self, segment: usize, joint: usize) -> Polynomial {
        Polynomial::new(self.degree, |power| {
            self.coefficient_row(segment, power)[joint]
        })
    }
}

/// The ratio of the bound of a polynomial's range to what is seen of it, up to which the bound is taken.
const MAX_RANGE_WIDTH_RATIO: f64 = 2.0;

/// The number of times that a segment is halved to bound a polynomial's range.
const MAX_RANGE_HALVINGS: u32 = 6;

/// Returns the factor from the sum of a polynomial's coefficients, on a segment, to the magnitude of which its values are
/// rounded.
///
/// Horner's scheme rounds twice for each power, relative to the sum. So are the coefficients about a middle `m`, summed with
/// the powers of a half `h` as a deviation: `Σ |cₙ| (m + h)ⁿ` is at most the sum, because `m + h` is at most 1.
pub(crate) fn rounding_factor(degree: usize) -> f64 {
    (degree + 1) as f64
}

/// The position of a joint as a polynomial of the share of a segment, about some share of it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Polynomial {
    degree: usize,
    /// The coefficients, that of the lowest power first.
    coefficients: [f64; MAX_DEGREE + 1],
}

impl Polynomial {
    pub(crate) fn new(degree: usize, coefficient: impl Fn(usize) -> f64) -> Self {
        let mut coefficients = [0.0; MAX_DEGREE + 1];
        for (power, own) in coefficients[..=degree].iter_mut().enumerate() {
            *own = coefficient(power);
        }
        Polynomial {
            degree,
            coefficients,
        }
    }

    /// Returns the same polynomial about another share: its Taylor series there, by Horner's scheme.
    pub(crate) fn about(mut self, share: f64) -> Self {
        for lowest in 0..self.degree {
            for power in (lowest..self.degree).rev() {
                self.coefficients[power] += share * self.coefficients[power + 1];
            }
        }
        self
    }

    #[cfg(test)]
    pub(crate) fn coefficient(&self, power: usize) -> f64 {
        self.coefficients[power]
    }

    /// Bounds the rounding error of values on the segment.
    pub(crate) fn rounding(&self) -> f64 {
        8.0 * f64::EPSILON * rounding_factor(self.degree) * self.size()
    }

    /// Returns the sum of the absolute values of all coefficients.
    fn size(&self) -> f64 {
        self.coefficients.iter().map(|own| own.abs()).sum()
    }

    /// Bounds the values within a share of the middle to both sides, for the polynomial about the middle. It halves the range
    /// as long as the bound is much wider than the values that are seen.
    fn range(&self, half: f64, halvings: u32) -> [f64; 2] {
        let (middle, deviation) = (self.constant(), self.deviation_bound(half));
        let ends = [-half, half].map(|offset| self.about(offset).constant());
        let seen = greater((ends[0] - middle).abs(), (ends[1] - middle).abs());
        if halvings == 0 || deviation <= MAX_RANGE_WIDTH_RATIO * seen {
            return [middle - deviation, middle + deviation];
        }
        let [first, last] = [-0.5 * half, 0.5 * half]
            .map(|offset| self.about(offset).range(0.5 * half, halvings - 1));
        [lesser(first[0], last[0]), greater(first[1], last[1])]
    }

    /// Returns the value at the share about which the polynomial is.
    pub(crate) fn constant(&self) -> f64 {
        self.coefficients[0]
    }

    /// Bounds how far values are from the one in the middle, within a share of it to both sides: `Σ |cᵢ| hⁱ`.
    pub(crate) fn deviation_bound(&self, half: f64) -> f64 {
        let rest = self.coefficients[1..=self.degree].iter().rev();
        half * rest.fold(0.0, |sum, coefficient| coefficient.abs() + half * sum)
    }

    /// Bounds how far values are from those of the line between both ends, within a share of the middle to both sides.
    ///
    /// A function is at most `(2h)²/8` times its largest second derivative from its chord: `Σ i (i−1)/2 |cᵢ| hⁱ`.
    fn chord_deviation_bound(&self, half: f64) -> f64 {
        let curved = self.coefficients[..=self.degree].iter().enumerate().skip(2);
        let sum = curved.rev().fold(0.0, |sum, (power, coefficient)| {
            let pairs = (power * (power - 1) / 2) as f64;
            pairs * coefficient.abs() + half * sum
        });
        // The square of a short half may be zero; each term has a few roundings.
        half * (half * sum) * (1.0 + 1e-12)
    }
}

#[cfg(test)]
mod tests;
