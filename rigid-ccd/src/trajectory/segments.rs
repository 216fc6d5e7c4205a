//! The segments of a trajectory, which follow each other and meet at knots.

use ccd_core::glam::DVec3;
use ccd_core::order::greater;
use std::iter::once;

/// The part of a trajectory between two times.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Segment<T> {
    pub(super) from: f64,
    pub(super) to: f64,
    pub(super) curve: T,
}

/// The segments of a trajectory in order of time, each starting where the one before it ends. The body rests before the
/// first one and after the last.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Segments<T>(pub(super) Vec<Segment<T>>);

/// Returns the greater of two bounds; infinity if `bound` is NaN.
pub(super) fn greater_bound(most: f64, bound: f64) -> f64 {
    if bound.is_nan() {
        f64::INFINITY
    } else {
        greater(most, bound)
    }
}

impl<T> Segments<T> {
    /// Returns the first segment that does not end before a time; `None` after the last one.
    pub(super) fn segment_at(&self, time: f64) -> Option<&Segment<T>> {
        let next = self.0.partition_point(|segment| segment.to < time);
        self.0.get(next)
    }

    /// Returns the segments that overlap an interval of time, or touch it.
    pub(super) fn segments_overlapping_interval(&self, from: f64, to: f64) -> &[Segment<T>] {
        let first = self.0.partition_point(|segment| segment.to < from);
        let rest = &self.0[first..];
        &rest[..rest.partition_point(|segment| segment.from <= to)]
    }

    /// Returns a knot strictly between two times, preferably near the middle; `None` if no knot is between them.
    pub(super) fn knot_between(&self, from: f64, to: f64) -> Option<f64> {
        let segments = self.segments_overlapping_interval(from, to);
        let middle = segments.get(segments.len() / 2)?.from;
        let ends = [segments.first(), segments.last()].into_iter().flatten();
        let ends = ends.flat_map(|segment| [segment.from, segment.to]);
        let mut knots = once(middle).chain(ends);
        knots.find(|knot| *knot > from && *knot < to)
    }

    /// Returns the greatest value of `bound` over the segments that overlap an interval of time; infinity if a value is
    /// NaN.
    pub(super) fn greatest_bound(
        &self,
        from: f64,
        to: f64,
        bound: impl Fn(&Segment<T>) -> f64,
    ) -> f64 {
        let segments = self.segments_overlapping_interval(from, to).iter();
        segments.map(bound).fold(0.0, greater_bound)
    }

    /// Returns an acceleration by which a motion deviates at least as far as by the jumps of the velocity at knots
    /// strictly inside an interval.
    pub(super) fn acceleration_covering_jumps(
        &self,
        from: f64,
        to: f64,
        velocity: impl Fn(&Segment<T>, f64) -> DVec3,
    ) -> f64 {
        let segments = self.segments_overlapping_interval(from, to);
        let before = segments.iter().map(|segment| velocity(segment, segment.to));
        let after = segments
            .iter()
            .map(|segment| (segment.from, velocity(segment, segment.from)));
        let end = segments.last().map(|segment| (segment.to, DVec3::ZERO));
        let knots = once(DVec3::ZERO).chain(before).zip(after.chain(end));
        let jumps: f64 = knots
            .filter(|&(_, (knot, _))| knot > from && knot < to)
            .map(|(before, (_, after))| before.distance(after))
            .sum();
        if jumps > 0.0 {
            2.0 * jumps / (0.5 * (to - from))
        } else {
            0.0
        }
    }
}
