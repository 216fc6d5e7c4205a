//! Approximates the motions of both bodies by straight lines within an interval of time, and bounds the error.
//!
//! All is relative to a frame that has B's position and orientation at the instant m, moves along
//! with B's center in a straight line and does not turn. There, for |s| ≤ h,
//!
//! - a point p of A is at a(m) + s ȧ(m) to within ½|ω|²ρh², the deviation of a circle from its
//!   tangent,
//! - and the same holds for a point of B, with q itself at m.
//!
//! For any fixed direction n, n·(a(m) + s ȧ(m)) is linear in s, so over the span it is least at an
//! end. So two sets are apart over the whole span if along one n they are apart at both of its
//! ends, by more than `gap_error_bound`. The direction n need not be exact.

use super::enclosure::{IntervalMatrix, IntervalVector};
use super::interval::{Interval, point_interval};
use super::rounding::{FORTY_ROUNDINGS_ERROR, ROUND_UP_FACTOR, UNIT_ROUNDOFF, nan_propagating_max};
use super::surface::{Node, Triangle};
use super::track::EnclosedMotion;
use ccd_core::glam::{DMat3, DVec3};
use ccd_core::order::greater;

/// An interval of time within the duration of a query.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct TimeSpan {
    pub(super) start: f64,
    pub(super) end: f64,
}

/// The positions and velocities of bodies A and B at the middle of an interval of time, with error bounds for the whole
/// interval.
#[derive(Clone, Debug)]
pub(super) struct LinearizedMotions {
    /// The map from A's body frame to the common frame, at the middle time.
    placement: AffineMap,
    /// The map from a point of A to its velocity, relative to B's center.
    velocity_map_a: AffineMap,
    /// The map from a point of B to its velocity, relative to B's center.
    velocity_map_b: AffineMap,
    /// Half the length of the interval.
    half_duration: f64,
    /// The computed gap above which bodies are certainly apart: it bounds the rounding, and the motion's deviation from
    /// a straight line.
    pub(super) gap_error_bound: f64,
    /// The part of `gap_error_bound` that bounds the motion's deviation from a straight line.
    linearization_error_bound: f64,
    /// The bounds on the extents of two boxes along B's axes; the next field has those along A's axes.
    extent_matrices_along_b: ExtentMatrices,
    extent_matrices_along_a: ExtentMatrices,
    /// The vector from B's center of rotation to A's center of rotation; the next field is its rate of change.
    rotation_center_b_to_a: DVec3,
    center_offset_rate: DVec3,
    /// The sum of the bodies' greatest distances from their centers of rotation.
    radius_sum: f64,
}

/// Two matrices that bound the half extents of two boxes along the axes of a frame over the interval: `a halfₐ + b
/// half_b`.
#[derive(Clone, Copy, Debug)]
struct ExtentMatrices {
    a: DMat3,
    b: DMat3,
}

impl TimeSpan {
    /// Returns the span that has only one time.
    pub(super) fn span_of_instant(time: f64) -> Self {
        TimeSpan {
            start: time,
            end: time,
        }
    }
}

impl LinearizedMotions {
    pub(super) fn new(
        [a, b]: [&EnclosedMotion; 2],
        [size_a, size_b]: [f64; 2],
        span: TimeSpan,
    ) -> Self {
        let time = span.start.midpoint(span.end);
        let half = greater(time - span.start, span.end - time) * ROUND_UP_FACTOR;
        let exactly = IntervalMaps::new(a, b, time);
        let placement = AffineMap::new(&exactly.placement, size_a);
        let rate_a = AffineMap::new(&exactly.velocity_map_a, size_a);
        let rate_b = AffineMap::new(&exactly.velocity_map_b, size_b);
        let motion_slack =
            0.5 * half * half * (a.max_acceleration + b.max_acceleration) * ROUND_UP_FACTOR;
        let errors = placement.image_error_bound
            + half * (rate_a.image_error_bound + rate_b.image_error_bound);
        let sizes = placement.image_length_bound
            + size_b
            + half * (rate_a.image_length_bound + rate_b.image_length_bound);
        let (r, w_a, w_b) = (placement.matrix, rate_a.matrix * half, rate_b.matrix * half);
        let back = r.transpose();
        LinearizedMotions {
            half_duration: half,
            linearization_error_bound: motion_slack,
            gap_error_bound: motion_slack * ROUND_UP_FACTOR
                + errors * ROUND_UP_FACTOR
                + MAX_GAP_ROUNDING_COUNT * UNIT_ROUNDOFF * sizes,
            extent_matrices_along_b: ExtentMatrices {
                a: larger_of_sum_and_difference(r, w_a),
                b: larger_of_sum_and_difference(DMat3::IDENTITY, w_b),
            },
            extent_matrices_along_a: ExtentMatrices {
                a: larger_of_sum_and_difference(back * r, back * w_a),
                b: larger_of_sum_and_difference(back, back * w_b),
            },
            placement,
            velocity_map_a: rate_a,
            velocity_map_b: rate_b,
            rotation_center_b_to_a: exactly.center_offset.midpoint(),
            center_offset_rate: exactly.velocity.midpoint(),
            radius_sum: a.max_distance_from_center + b.max_distance_from_center,
        }
    }

    /// Returns true if the bodies stay apart whatever their rotation, because their centers are far from each other.
    pub(super) fn are_bodies_far_apart(&self) -> bool {
        let (d, w) = (
            self.rotation_center_b_to_a,
            self.half_duration * self.center_offset_rate,
        );
        // The point of the segment from d − w to d + w that is nearest to 0.
        let s = (-d.dot(w) / w.length_squared()).clamp(-1.0, 1.0);
        let nearest = if s.is_nan() { d } else { d + s * w };
        nearest.length() * (1.0 - FORTY_ROUNDINGS_ERROR)
            > (self.radius_sum + self.gap_error_bound - self.linearization_error_bound)
                * ROUND_UP_FACTOR
                + FORTY_ROUNDINGS_ERROR * (d.length() + w.length())
    }

    /// Returns a bound on the relative displacement of two boxes; `None` if one of their six face normals separates them
    /// over the whole interval.
    pub(super) fn travel_bound_unless_apart(&self, a: &Node, b: &Node) -> Option<f64> {
        let apart = self.placement.apply(a.box_center) - b.box_center;
        let moved = self.half_duration
            * (self.velocity_map_a.apply(a.box_center) - self.velocity_map_b.apply(b.box_center));
        let gaps_b = self
            .extent_matrices_along_b
            .axis_gap_lower_bounds(apart, moved, a, b);
        if gaps_b.max_element() > self.gap_error_bound {
            return None;
        }
        let gaps_a = self.extent_matrices_along_a.axis_gap_lower_bounds(
            self.rotate_to_frame_a(apart),
            self.rotate_to_frame_a(moved),
            a,
            b,
        );
        if gaps_a.max_element() > self.gap_error_bound {
            return None;
        }
        Some(moved.length() + self.linearization_error_bound)
    }

    /// Returns a lower bound of the distance of two boxes at the middle time; it does not hold over the interval.
    pub(super) fn box_distance_lower_bound(&self, a: &Node, b: &Node) -> f64 {
        let apart = self.placement.apply(a.box_center) - b.box_center;
        let none = DVec3::ZERO;
        let gaps_b = self
            .extent_matrices_along_b
            .axis_gap_lower_bounds(apart, none, a, b)
            .max(none);
        let gaps_a = self
            .extent_matrices_along_a
            .axis_gap_lower_bounds(self.rotate_to_frame_a(apart), none, a, b)
            .max(none);
        let distance = greater(gaps_b.length(), gaps_a.length());
        distance * (1.0 - FORTY_ROUNDINGS_ERROR) - 2.0 * self.gap_error_bound
    }

    /// Returns the corners of two triangles in the common frame, at both ends of the interval.
    pub(super) fn triangles_at_ends(&self, a: &Triangle, b: &Triangle) -> [[Triangle; 2]; 2] {
        let moved_a = a.map(|p| self.half_duration * self.velocity_map_a.apply(p));
        let moved_b = b.map(|q| self.half_duration * self.velocity_map_b.apply(q));
        let a = a.map(|p| self.placement.apply(p));
        let at = |end: f64, from: &Triangle, moved: &Triangle| {
            [0, 1, 2].map(|i| from[i] + end * moved[i])
        };
        [-1.0, 1.0].map(|end| [at(end, &a, &moved_a), at(end, b, &moved_b)])
    }

    /// Returns the corners of A's triangle in the common frame at the middle time.
    pub(super) fn triangle_of_a_at_middle(&self, a: &Triangle) -> Triangle {
        a.map(|p| self.placement.apply(p))
    }

    fn rotate_to_frame_a(&self, v: DVec3) -> DVec3 {
        self.placement.matrix.transpose() * v
    }
}

impl ExtentMatrices {
    /// Returns, for each axis, a lower bound of the gap of two boxes over the whole interval.
    fn axis_gap_lower_bounds(&self, apart: DVec3, moved: DVec3, a: &Node, b: &Node) -> DVec3 {
        apart.abs() - moved.abs() - self.a * a.half_extents - self.b * b.half_extents
    }
}

/// Returns, entry by entry, the larger of |m + w| and |m − w|, which bounds |m + s w| for all s from −1 to 1.
fn larger_of_sum_and_difference(m: DMat3, w: DMat3) -> DMat3 {
    m.abs() + w.abs()
}

/// The map `p ↦ matrix p + offset` in floats, with a bound of its error.
#[derive(Clone, Copy, Debug)]
struct AffineMap {
    matrix: DMat3,
    offset: DVec3,
    /// An upper bound of the error of a body point's image, as a length.
    image_error_bound: f64,
    /// An upper bound of the length of a body point's image.
    image_length_bound: f64,
}

impl AffineMap {
    /// Rounds the interval coefficients of an affine map to their midpoints, and bounds the error and the length of its
    /// images. Each coordinate of an image is Σⱼ mⱼpⱼ + o with four roundings in sequence. Its error is at most
    /// 4u(|m||p| + |o|), plus √3 rad(m)|p| + rad(o) for the widths of the intervals.
    fn new((matrix, offset): &(IntervalMatrix, IntervalVector), farthest: f64) -> Self {
        let rows = matrix.0.map(|row| IntervalVector(row).midpoint());
        let widest = |width: f64, entry: &Interval| nan_propagating_max(width, entry.radius());
        let width = matrix.0.iter().flatten().fold(0.0, widest);
        let offset_width = offset.0.iter().fold(0.0, widest);
        let offset = offset.midpoint();
        let row = rows.iter().fold(0.0, |longest: f64, row| {
            nan_propagating_max(longest, row.length())
        });
        let coordinate = row * farthest + offset.length();
        let widths = width * SQRT_3_UPPER_BOUND * farthest + offset_width;
        AffineMap {
            matrix: DMat3::from_cols(rows[0], rows[1], rows[2]).transpose(),
            offset,
            image_error_bound: SQRT_3_UPPER_BOUND
                * (widths + 5.0 * UNIT_ROUNDOFF * coordinate)
                * ROUND_UP_FACTOR,
            image_length_bound: SQRT_3_UPPER_BOUND * coordinate * ROUND_UP_FACTOR,
        }
    }

    fn apply(&self, p: DVec3) -> DVec3 {
        self.matrix * p + self.offset
    }
}

/// The affine maps of a snapshot, whose entries are intervals.
pub(super) struct IntervalMaps {
    pub(super) placement: (IntervalMatrix, IntervalVector),
    velocity_map_a: (IntervalMatrix, IntervalVector),
    velocity_map_b: (IntervalMatrix, IntervalVector),
    center_offset: IntervalVector,
    velocity: IntervalVector,
}

impl IntervalMaps {
    pub(super) fn new(a: &EnclosedMotion, b: &EnclosedMotion, time: f64) -> Self {
        let (at_a, at_b) = (a.placement_at(time), b.placement_at(time));
        let back = at_b.rotation.transpose();
        let rotation = &back * &at_a.rotation;
        let centers = &back * &(at_a.center - at_b.center);
        // a = R (p − c_a) + (C_a − C_b) + c_b
        let offset = centers - &rotation * &a.center + b.center;
        let velocity = &back * &(a.velocity - b.velocity);
        // ȧ = v + ω_a × R (p − c_a), ḃ = ω_b × (q − c_b); the constant of B is moved to A's side.
        let swirl_a = &(&back * &a.spin).cross_matrix() * &rotation;
        let swirl_b = (&back * &b.spin).cross_matrix();
        let drift = velocity - &swirl_a * &a.center + &swirl_b * &b.center;
        IntervalMaps {
            placement: (rotation, offset),
            velocity_map_a: (swirl_a, drift),
            velocity_map_b: (swirl_b, IntervalVector([point_interval(0.0); 3])),
            center_offset: centers,
            velocity,
        }
    }
}

/// An upper bound on the number of roundings in a gap, relative to the sizes that enter it. For each of A and B these
/// are the sum of position and motion (3), the dot product with n (3 products and 2 sums: 3 deep) and its difference
/// (1); n itself, of length 1 to 4 roundings; for boxes √3 times the 4 roundings of an extent on each side, and twice
/// as many along A's axes, which are rounded themselves. The total is doubled.
const MAX_GAP_ROUNDING_COUNT: f64 = 96.0;
/// The square root of 3, rounded up.
const SQRT_3_UPPER_BOUND: f64 = 1.732_050_807_568_878;
