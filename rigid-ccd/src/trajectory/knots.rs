//! The times at which the segments of a trajectory meet.

/// Returns the segments that overlap an interval of time; segments are consecutive.
pub(super) fn overlapping<P>(
    parts: &[P],
    times: impl Fn(&P) -> [f64; 2],
    from: f64,
    to: f64,
) -> &[P] {
    let first = parts.partition_point(|part| times(part)[1] < from);
    let rest = &parts[first..];
    &rest[..rest.partition_point(|part| times(part)[0] <= to)]
}

/// Returns a knot strictly between two times, about the middle of the knots of `parts`; `None` without one.
pub(super) fn middle_knot<P>(
    parts: &[P],
    times: impl Fn(&P) -> [f64; 2],
    from: f64,
    to: f64,
) -> Option<f64> {
    let inside = |knot: &f64| *knot > from && *knot < to;
    let middle = times(parts.get(parts.len() / 2)?)[0];
    let ends = [parts.first(), parts.last()].map(|part| part.map(&times));
    let others = ends.into_iter().flatten().flatten();
    std::iter::once(middle).chain(others).find(inside)
}

/// Returns the acceleration whose deviation over half of a segment equals that of velocity jumps at knots.
pub(super) fn spread(jumps: impl Iterator<Item = f64>, from: f64, to: f64) -> f64 {
    let jumps: f64 = jumps.sum();
    if jumps > 0.0 {
        2.0 * jumps / (0.5 * (to - from))
    } else {
        0.0
    }
}
