//! Curves in space: Bézier curves and B-splines.

use super::U;
use super::checks::{check_duration, check_finite_vector};
use super::segments::{self, Segments, greater_bound};
use ccd_core::glam::DVec3;
use ccd_core::order::{greater, lesser};
use ccd_core::vector::length;
use ccd_core::{Acceleration, InputError, check};

/// A curve of Bézier segments, from time 0 to its [duration](Curve::duration). It rests before and after.
///
/// A Bézier curve is within the convex hull of its points, and its derivatives are Bézier curves of the
/// differences of its points. On a part of a segment, the second derivative is that of the middle, give or take
/// the third derivative times half of the part's time, and so on.
///
/// ```
/// use rigid_ccd::trajectory::Curve;
/// let points = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]];
/// let bend = Curve::bezier(&points, 2.0)?;
/// assert_eq!(bend.position(1.0).to_array(), [0.75, 0.5, 0.0]);
/// # Ok::<(), rigid_ccd::InputError>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Curve {
    pub(super) segments: Segments<Vec<DVec3>>,
}

/// The largest number of control points of a Bézier curve. The time for a point of it grows with the square: a deadline is kept
/// to some microseconds.
const MAX_BEZIER_POINTS: usize = 128;

/// A Bézier curve between two times, given by its control points.
type Segment = segments::Segment<Vec<DVec3>>;

impl Curve {
    /// Creates a Bézier curve from its control points, at most 128. A longer path is a [B-spline](Curve::b_spline), of which a
    /// point takes the same time at any length.
    ///
    /// # Errors
    /// [`InputError::NotFinite`], and [`InputError::OutOfRange`] for no points, too many, or a duration that is not
    /// positive.
    pub fn bezier(points: &[[f64; 3]], duration: f64) -> Result<Self, InputError> {
        check(
            "number of points",
            points.len() as f64,
            points.len() <= MAX_BEZIER_POINTS,
            "at most 128, of a Bézier curve",
        )?;
        let points = checked_control_points(points, 1, duration)?;
        Ok(Curve {
            segments: Segments(vec![Segment {
                from: 0.0,
                to: duration,
                curve: points,
            }]),
        })
    }

    /// Creates a uniform cubic B-spline from its control points, at least four. Its acceleration does not jump;
    /// it begins and ends near the second point and the last but one.
    ///
    /// # Errors
    /// [`InputError::NotFinite`], and [`InputError::OutOfRange`] for less than four points or a duration that
    /// is not positive.
    pub fn b_spline(points: &[[f64; 3]], duration: f64) -> Result<Self, InputError> {
        let points = checked_control_points(points, 4, duration)?;
        let count = points.len() - 3;
        let at = |k: usize| duration * (k as f64 / count as f64);
        let segment = |k: usize| {
            let [a, b, c, d] = [points[k], points[k + 1], points[k + 2], points[k + 3]];
            let inner = [(2.0 * b + c) / 3.0, (b + 2.0 * c) / 3.0];
            let ends = [(a + 4.0 * b + c) / 6.0, (b + 4.0 * c + d) / 6.0];
            Segment {
                from: at(k),
                to: at(k + 1),
                curve: vec![ends[0], inner[0], inner[1], ends[1]],
            }
        };
        Ok(Curve {
            segments: Segments((0..count).map(segment).collect()),
        })
    }

    /// Returns the time at which the curve ends.
    pub fn duration(&self) -> f64 {
        self.last_segment().to
    }

    /// Returns the point of the curve at a time.
    pub fn position(&self, time: f64) -> DVec3 {
        let segment = self.segment_at(time);
        segment.derivative(0, segment.share(time))
    }

    /// Returns the velocity along the curve at a time.
    pub fn velocity(&self, time: f64) -> DVec3 {
        if (0.0..=self.duration()).contains(&time) {
            let segment = self.segment_at(time);
            segment.derivative(1, segment.share(time))
        } else {
            DVec3::ZERO
        }
    }

    fn segment_at(&self, time: f64) -> &Segment {
        self.segments
            .segment_at(time)
            .unwrap_or(self.last_segment())
    }

    /// Returns the last segment; there is at least one.
    fn last_segment(&self) -> &Segment {
        &self.segments.0[self.segments.0.len() - 1]
    }

    /// Bounds the magnitude of the acceleration between two times. A velocity that jumps counts as one that changes in
    /// half of the time, by which a curve strays farther.
    pub(super) fn acceleration_bound(&self, from: f64, to: f64) -> f64 {
        let velocity = |segment: &Segment, time| segment.derivative(1, segment.share(time));
        self.derivative_bound(2, from, to)
            + self
                .segments
                .acceleration_covering_jumps(from, to, velocity)
    }

    /// Returns the acceleration at a time, with a bound on its rate of change between two times; `None` if these span
    /// several segments.
    pub(super) fn acceleration_at(&self, time: f64, from: f64, to: f64) -> Option<Acceleration> {
        // A segment that only touches the interval overlaps it, too.
        let mut overlapping = self.segments.segments_overlapping_interval(from, to).iter();
        let segment = overlapping.find(|segment| from >= segment.from && to <= segment.to)?;
        Some(Acceleration {
            acceleration_vector: segment.derivative(2, segment.share(time)),
            jerk_bound: segment.derivative_bound(3, from, to),
        })
    }

    /// Bounds the magnitude of the derivative of the given order between two times, over all segments there.
    fn derivative_bound(&self, order: usize, from: f64, to: f64) -> f64 {
        self.segments.greatest_bound(from, to, |segment| {
            segment.derivative_bound(order, greater(from, segment.from), lesser(to, segment.to))
        })
    }

    /// Bounds the rounding error of a computed position on the curve.
    pub(super) fn rounding(&self) -> f64 {
        let lengths = self.segments.0.iter().flat_map(|segment| {
            let degree = segment.curve.len() as f64;
            segment.curve.iter().map(move |&p| length(p) * degree)
        });
        8.0 * U * lengths.fold(0.0, greater)
    }
}

impl Segment {
    fn share(&self, time: f64) -> f64 {
        ((time - self.from) / (self.to - self.from)).clamp(0.0, 1.0)
    }

    /// Returns the derivative of the given order with respect to time, at a share (0 to 1) of the segment's duration.
    fn derivative(&self, order: usize, share: f64) -> DVec3 {
        let mut points = self.derivative_control_points(order);
        // De Casteljau's algorithm.
        while points.len() > 1 {
            points = points.windows(2).map(|p| p[0].lerp(p[1], share)).collect();
        }
        points.first().copied().unwrap_or(DVec3::ZERO)
    }

    /// Returns the control points of the derivative of the given order with respect to time; empty if it is zero.
    fn derivative_control_points(&self, order: usize) -> Vec<DVec3> {
        let mut points = self.curve.clone();
        for _ in 0..order {
            let factor = points.len().saturating_sub(1) as f64 / (self.to - self.from);
            points = points.windows(2).map(|p| factor * (p[1] - p[0])).collect();
        }
        points
    }

    /// Bounds the magnitude of the derivative of the given order between two times of the segment.
    fn derivative_bound(&self, order: usize, from: f64, to: f64) -> f64 {
        let hull = |order| {
            let points = self.derivative_control_points(order).into_iter();
            points.map(length).fold(0.0, greater_bound)
        };
        let half = 0.5 * (to - from);
        let middle = length(self.derivative(order, self.share(from + half)));
        // Products and sums are rounded.
        lesser(hull(order), middle + half * hull(order + 1)) * (1.0 + 1e-12)
    }
}

fn checked_control_points(
    points: &[[f64; 3]],
    least: usize,
    duration: f64,
) -> Result<Vec<DVec3>, InputError> {
    let allowed = match least {
        1 => "at least 1",
        _ => "at least 4, of a B-spline",
    };
    let count = points.len();
    check("number of points", count as f64, count >= least, allowed)?;
    check_duration(duration)?;
    points
        .iter()
        .map(|&point| check_finite_vector(point, "point"))
        .collect()
}
