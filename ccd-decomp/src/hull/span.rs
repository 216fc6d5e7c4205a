//! The exact dimension of the span of points.

use crate::exact::predicates::{is_degenerate, lexicographic, side};
use ccd_core::glam::DVec3;
use std::cmp::Ordering;

/// The affine span of points, with indices of points that span it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Span {
    Nothing,
    Point(usize),
    /// The two extreme points.
    Line(usize, usize),
    Plane([usize; 3]),
    Volume,
}

impl Span {
    /// Computes the span of points at different places. O(n).
    pub(super) fn new(points: &[DVec3]) -> Self {
        let at = |k: usize| points[k];
        let by_order = |&v: &usize, &w: &usize| lexicographic(at(v), at(w));
        let first = (0..points.len()).min_by(by_order);
        let last = (0..points.len()).max_by(by_order);
        let (Some(a), Some(b)) = (first, last) else {
            return Span::Nothing;
        };
        if a == b {
            return Span::Point(a);
        }
        // Far points come first, because they make larger simplices; any will do.
        let off_line = |&k: &usize| (at(b) - at(a)).cross(at(k) - at(a)).length_squared();
        let proper = |&k: &usize| !is_degenerate([at(a), at(b), at(k)]);
        let Some(c) = farthest(points.len(), off_line, proper) else {
            return Span::Line(a, b);
        };
        let normal = (at(b) - at(a)).cross(at(c) - at(a));
        let height = |&k: &usize| normal.dot(at(k) - at(a)).abs();
        let side_of = |k: usize| side([at(a), at(b), at(c)], at(k));
        let proper = |&k: &usize| side_of(k) != Ordering::Equal;
        match farthest(points.len(), height, proper) {
            None => Span::Plane([a, b, c]),
            Some(_) => Span::Volume,
        }
    }
}

/// Finds the index of the largest rounded measure if it is proper, else the first proper index.
fn farthest(
    count: usize,
    measure: impl Fn(&usize) -> f64,
    proper: impl Fn(&usize) -> bool,
) -> Option<usize> {
    let far = (0..count).max_by(|v, w| measure(v).total_cmp(&measure(w)));
    far.filter(&proper).or_else(|| (0..count).find(&proper))
}
