//! Paths of polynomials in time, such as the splines that controllers execute.

mod b_spline;

use crate::error::{CurveError, PathError, RobotError};
use crate::path_point::PathPoint;
use crate::polynomial::{MAX_DEGREE, Polynomial};
use crate::robot::Robot;
use ccd_core::double_double::DoubleDouble;
use ccd_core::order::{greater, lesser};
use rigid_ccd::InputError;
use serde::{Deserialize, Serialize};
use smallvec::SmallVec;

/// The largest accepted jump of a joint between segments, in radians or as a length, in addition to the rounding error
/// of the coefficients. Programs that create splines round their coefficients, which causes small jumps. The positions
/// within such a jump are not checked.
const MAX_JUMP: f64 = 1e-9;

/// The number of halvings of a segment in the search for a point outside the joint limits.
const MAX_LIMIT_HALVINGS: u32 = 20;

/// A path on which each joint follows a piecewise polynomial in time.
///
/// A [`CellSolver`](crate::CellSolver) answers all its questions about curves. A [`PathPoint`] on a curve is a segment
/// index and the elapsed fraction of the segment's duration.
///
/// ```
/// use rigid_ccd_robot::JointCurve;
/// // One joint goes from 0 to 1 in two seconds, and stops there.
/// let curve = JointCurve::cubic_hermite(&[0.0, 2.0], &[[0.0], [1.0]], &[[0.0], [0.0]])?;
/// assert_eq!(curve.positions(1.0), [0.5]);
/// # Ok::<(), rigid_ccd_robot::CurveError>(())
/// ```
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(try_from = "CurveNumbers")]
pub struct JointCurve {
    /// The start time of each segment, and the end time of the last one.
    times: Vec<f64>,
    joint_count: usize,
    degree: usize,
    /// The coefficients, by segment, then by power (lowest first), then by joint. The variable is the elapsed fraction
    /// of the segment's duration.
    coefficients: Vec<f64>,
    /// The rounding error of each coefficient: its exact value minus the f64 in `coefficients`.
    low_coefficients: Vec<f64>,
}

/// The deserialised numbers of a curve, before validation.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct CurveNumbers {
    times: Vec<f64>,
    joint_count: usize,
    degree: usize,
    coefficients: Vec<f64>,
    /// Empty if the curve was stored without them.
    #[serde(default)]
    low_coefficients: Vec<f64>,
}

impl TryFrom<CurveNumbers> for JointCurve {
    type Error = CurveError;

    fn try_from(stored: CurveNumbers) -> Result<Self, CurveError> {
        let CurveNumbers {
            times,
            joint_count,
            degree,
            coefficients,
            mut low_coefficients,
        } = stored;
        if !(1..=MAX_DEGREE).contains(&degree) {
            return Err(CurveError::DegreeTooHigh { degree });
        }
        let segments = times.len().saturating_sub(1);
        check_times(&times, segments)?;
        let expected = (segments * (degree + 1)).saturating_mul(joint_count);
        check_count("coefficients", 0, coefficients.len(), expected)?;
        if low_coefficients.is_empty() {
            low_coefficients.resize(expected, 0.0);
        }
        check_count("low coefficients", 0, low_coefficients.len(), expected)?;
        JointCurve {
            times,
            joint_count,
            degree,
            coefficients,
            low_coefficients,
        }
        .checked()
    }
}

impl JointCurve {
    /// Creates a curve from polynomials. `segments[i][j]` lists the coefficients of segment `i` and independent joint
    /// `j`, lowest power first. The variable is the time since the start of the segment.
    ///
    /// A joint may jump by up to 1e-9 between segments. The positions within the jump are not checked.
    ///
    /// # Errors
    /// [`CurveError`] for numbers that are not finite, times that do not increase, wrong numbers of segments, joints
    /// or coefficients, a degree above 9, and jumps of more than 1e-9.
    pub fn from_polynomials(times: &[f64], segments: &[Vec<Vec<f64>>]) -> Result<Self, CurveError> {
        let joint_count = segments.first().map_or(0, Vec::len);
        let joints = segments.iter().flatten();
        let degree = joints.map(|powers| powers.len().saturating_sub(1)).max();
        // A constant is stored as a polynomial of degree 1.
        let degree = degree.unwrap_or(0).max(1);
        if degree > MAX_DEGREE {
            return Err(CurveError::DegreeTooHigh { degree });
        }
        check_times(times, segments.len())?;
        let mut coefficients = Vec::new();
        for (segment, (joints, span)) in segments.iter().zip(times.windows(2)).enumerate() {
            check_count("joints", segment, joints.len(), joint_count)?;
            if joints.iter().any(Vec::is_empty) {
                check_count("coefficients", segment, 0, 1)?;
            }
            let duration = DoubleDouble::difference(span[1], span[0]);
            let mut scale = DoubleDouble::from(1.0);
            for power in 0..=degree {
                // Missing higher coefficients are 0.
                coefficients.extend(joints.iter().map(|powers| {
                    let coefficient = powers.get(power).copied().unwrap_or(0.0);
                    DoubleDouble::from(coefficient) * scale
                }));
                scale = scale * duration;
            }
        }
        JointCurve::from_coefficients(times, (joint_count, degree), coefficients)
    }

    /// Creates a piecewise cubic curve from positions and velocities at given times.
    ///
    /// # Errors
    /// The same as [`JointCurve::from_polynomials`].
    pub fn cubic_hermite<Q: AsRef<[f64]>>(
        times: &[f64],
        positions: &[Q],
        velocities: &[Q],
    ) -> Result<Self, CurveError> {
        JointCurve::hermite(times, [positions, velocities], |[[p, v], [q, w]]| {
            let [two, three] = [2.0, 3.0].map(DoubleDouble::from);
            let change = q - p;
            [p, v, three * change - two * v - w, v + w - two * change]
        })
    }

    /// Creates a piecewise quintic curve from positions, velocities and accelerations at given times.
    ///
    /// # Errors
    /// The same as [`JointCurve::from_polynomials`].
    pub fn quintic_hermite<Q: AsRef<[f64]>>(
        times: &[f64],
        positions: &[Q],
        velocities: &[Q],
        accelerations: &[Q],
    ) -> Result<Self, CurveError> {
        let derivatives = [positions, velocities, accelerations];
        JointCurve::hermite(times, derivatives, |[[p, v, a], [q, w, b]]| {
            let times = |factor: f64, derivative| DoubleDouble::from(factor) * derivative;
            let change = q - p;
            [
                p,
                v,
                times(0.5, a),
                times(10.0, change) - times(6.0, v) - times(4.0, w) - times(1.5, a) + times(0.5, b),
                times(-15.0, change) + times(8.0, v) + times(7.0, w) + times(1.5, a) - b,
                times(6.0, change) - times(3.0, v + w) + times(0.5, b - a),
            ]
        })
    }

    /// Creates a curve from the derivatives of all joints at given times. `interpolate` computes a joint's
    /// coefficients from its derivatives at both ends of a segment, taken with respect to the elapsed fraction.
    fn hermite<Q: AsRef<[f64]>, const ORDERS: usize, const COUNT: usize>(
        times: &[f64],
        derivatives: [&[Q]; ORDERS],
        interpolate: impl Fn([[DoubleDouble; ORDERS]; 2]) -> [DoubleDouble; COUNT],
    ) -> Result<Self, CurveError> {
        let joint_count = derivatives[0].first().map_or(0, |row| row.as_ref().len());
        check_times(times, derivatives[0].len().saturating_sub(1))?;
        for rows in derivatives {
            check_count("configurations", 0, rows.len(), times.len())?;
            for (index, row) in rows.iter().enumerate() {
                check_count("joints", index, row.as_ref().len(), joint_count)?;
            }
        }
        let mut coefficients = Vec::new();
        for (segment, span) in times.windows(2).enumerate() {
            let duration = DoubleDouble::difference(span[1], span[0]);
            let by_joint: Vec<[DoubleDouble; COUNT]> = (0..joint_count)
                .map(|joint| {
                    let ends = [segment, segment + 1].map(|row| {
                        let mut scale = DoubleDouble::from(1.0);
                        derivatives.map(|rows| {
                            let by_fraction = DoubleDouble::from(rows[row].as_ref()[joint]) * scale;
                            scale = scale * duration;
                            by_fraction
                        })
                    });
                    interpolate(ends)
                })
                .collect();
            for power in 0..COUNT {
                coefficients.extend(by_joint.iter().map(|powers| powers[power]));
            }
        }
        JointCurve::from_coefficients(times, (joint_count, COUNT - 1), coefficients)
    }

    fn from_coefficients(
        times: &[f64],
        (joint_count, degree): (usize, usize),
        coefficients: Vec<DoubleDouble>,
    ) -> Result<Self, CurveError> {
        let high_and_low = coefficients.into_iter().map(DoubleDouble::parts);
        let (coefficients, low_coefficients) = high_and_low.map(|[high, low]| (high, low)).unzip();
        JointCurve {
            times: times.to_vec(),
            joint_count,
            degree,
            coefficients,
            low_coefficients,
        }
        .checked()
    }

    /// Checks that all coefficients are finite and that no joint jumps.
    fn checked(self) -> Result<Self, CurveError> {
        for segment in 0..self.segment_count() {
            for joint in 0..self.joint_count {
                let coefficients =
                    (0..=self.degree).map(|power| self.coefficient(segment, power, joint));
                let mut numbers = coefficients.flat_map(DoubleDouble::parts);
                if !numbers.all(f64::is_finite) {
                    return Err(CurveError::NotFinite { segment, joint });
                }
                self.check_jump(segment, joint, 1.0)?;
            }
        }
        Ok(self)
    }

    /// Checks that a joint of the curve, or a joint that follows it with a multiplier, does not jump at the start of a
    /// segment. The multiplier of the joint itself is 1.
    fn check_jump(&self, segment: usize, joint: usize, multiplier: f64) -> Result<(), CurveError> {
        let Some(previous_segment) = segment.checked_sub(1) else {
            return Ok(());
        };
        let previous = self.polynomial(previous_segment, joint);
        let next = self.polynomial(segment, joint);
        let factor = multiplier.abs();
        let jump = factor * (next.constant() - previous.value(1.0)).abs();
        let rounding =
            factor * (previous.rounding_of_coefficients() + next.rounding_of_coefficients());
        // Written so that NaN is refused.
        if jump <= MAX_JUMP + rounding {
            return Ok(());
        }
        Err(CurveError::Jump {
            segment,
            joint,
            jump,
        })
    }

    /// Returns the number of segments.
    pub fn segment_count(&self) -> usize {
        self.times.len() - 1
    }

    /// Returns the start time of each segment, and the end time of the last one.
    pub fn times(&self) -> &[f64] {
        &self.times
    }

    /// Returns the time of a point, rounded down, so that it is not after the point.
    pub fn time(&self, point: PathPoint) -> f64 {
        let [from, to] = self.time_span(point);
        if point.fraction >= 1.0 {
            return to;
        }
        greater(
            from,
            from + point.fraction * (to - from) - time_rounding([from, to]),
        )
    }

    /// Returns the time of a point, rounded up.
    pub fn latest_time(&self, point: PathPoint) -> f64 {
        let [from, to] = self.time_span(point);
        if point.fraction <= 0.0 {
            return from;
        }
        lesser(
            to,
            from + point.fraction * (to - from) + time_rounding([from, to]),
        )
    }

    /// Returns the start and end times of a point's segment.
    fn time_span(&self, point: PathPoint) -> [f64; 2] {
        let segment = point.segment.min(self.segment_count() - 1);
        [self.times[segment], self.times[segment + 1]]
    }

    /// Returns the positions of all joints at a time. A time outside the curve is clamped to its nearest end.
    pub fn positions(&self, time: f64) -> Vec<f64> {
        let later_starts = &self.times[1..self.segment_count()];
        let segment = later_starts.partition_point(|&start| start <= time);
        let [from, to] = [self.times[segment], self.times[segment + 1]];
        let fraction = ((time - from) / (to - from)).clamp(0.0, 1.0);
        let joints = 0..self.joint_count;
        joints
            .map(|joint| self.polynomial(segment, joint).value(fraction))
            .collect()
    }

    pub(crate) fn degree(&self) -> usize {
        self.degree
    }

    /// Returns the coefficient of one power for a joint in a segment.
    pub(crate) fn coefficient(&self, segment: usize, power: usize, joint: usize) -> DoubleDouble {
        let index = (segment * (self.degree + 1) + power) * self.joint_count + joint;
        DoubleDouble::from_parts([self.coefficients[index], self.low_coefficients[index]])
    }

    fn polynomial(&self, segment: usize, joint: usize) -> Polynomial {
        Polynomial::new(self.degree, |power| self.coefficient(segment, power, joint))
    }

    /// Checks that the curve has the robot's number of joints, and that every joint stays within its limits.
    pub(crate) fn check_for_robot(&self, robot: &Robot) -> Result<(), PathError> {
        let start = PathPoint {
            segment: 0,
            fraction: 0.0,
        };
        let error_at = |at: PathPoint, error| Err(PathError::InvalidCurvePoint { at, error });
        if let Err(error) = robot.check_position_count(self.joint_count) {
            return error_at(start, error);
        }
        for segment in 0..self.segment_count() {
            for source in robot.position_sources() {
                self.check_jump(segment, source.position_index, source.multiplier)?;
            }
            for (joint, [low, high]) in robot.limits().enumerate() {
                let polynomial = self.polynomial(segment, joint);
                let Some((fraction, position)) = find_limit_violation(&polynomial, [low, high])
                else {
                    continue;
                };
                let error = InputError::JointOutOfLimits {
                    joint: None,
                    joint_position: position,
                    limits: [low, high],
                };
                let joint = robot
                    .independent_joint_names()
                    .nth(joint)
                    .unwrap_or_default();
                let joint = joint.to_owned();
                let error = RobotError::InvalidPosition { joint, error };
                return error_at(PathPoint { segment, fraction }, error);
            }
        }
        Ok(())
    }
}

/// Bounds the rounding error of a time that is interpolated between two times. A difference, a product and two sums are
/// rounded. Each is at most twice as large as the larger of the two times.
fn time_rounding([from, to]: [f64; 2]) -> f64 {
    4.0 * f64::EPSILON * greater(from.abs(), to.abs())
}

/// Returns a fraction of the segment at which a polynomial exceeds limits by more than its rounding error, and the
/// value there; `None` if none is found. Searches by halving, down to a millionth of the segment. No proof depends on
/// this search.
fn find_limit_violation(polynomial: &Polynomial, [low, high]: [f64; 2]) -> Option<(f64, f64)> {
    let rounding = polynomial.rounding_of_coefficients();
    let [low, high] = [low - rounding, high + rounding];
    for fraction in [0.0, 1.0] {
        let value = polynomial.value(fraction);
        // Written so that NaN is outside the limits.
        if !(low <= value && value <= high) {
            return Some((fraction, value));
        }
    }
    let mut pending_intervals = SmallVec::<[_; MAX_LIMIT_HALVINGS as usize + 1]>::new();
    pending_intervals.push((0.0, 1.0, 0));
    while let Some((from, to, halvings)) = pending_intervals.pop() {
        let midpoint = 0.5 * (from + to);
        let expanded = polynomial.expanded_about(midpoint);
        let (value, deviation) = (
            expanded.constant(),
            expanded.deviation_bound(0.5 * (to - from)),
        );
        // Written so that NaN is outside the limits.
        if !(low <= value && value <= high) {
            return Some((midpoint, value));
        }
        let is_inside = low <= value - deviation && value + deviation <= high;
        if !is_inside && halvings < MAX_LIMIT_HALVINGS {
            pending_intervals
                .extend([(midpoint, to, halvings + 1), (from, midpoint, halvings + 1)]);
        }
    }
    None
}

fn check_times(times: &[f64], segment_count: usize) -> Result<(), CurveError> {
    if times.len() < 2 {
        return Err(CurveError::TooFewTimes { count: times.len() });
    }
    check_count("segments", 0, segment_count, times.len() - 1)?;
    let is_span = |span: &[f64]| span[0] < span[1] && (span[1] - span[0]).is_finite();
    match times.windows(2).position(|span| !is_span(span)) {
        Some(segment) => Err(CurveError::TimesNotIncreasing { segment }),
        None => Ok(()),
    }
}

fn check_count(
    counted_objects: &'static str,
    index: usize,
    count: usize,
    expected: usize,
) -> Result<(), CurveError> {
    if count == expected {
        return Ok(());
    }
    Err(CurveError::WrongCount {
        what: counted_objects,
        index,
        given: count,
        expected,
    })
}

#[cfg(test)]
mod tests;
