//! The times at which the parts of a trajectory meet.

/// Returns the parts that hold at some time from one to another; parts follow each other in time.
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

/// Returns a knot strictly between two times, if there is one, about the middle of all knots of these parts,
/// which overlap that time.
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

/// Returns the acceleration in half of a stretch by which velocities that jump at knots stray as far.
pub(super) fn spread(jumps: impl Iterator<Item = f64>, from: f64, to: f64) -> f64 {
    let jumps: f64 = jumps.sum();
    if jumps > 0.0 {
        2.0 * jumps / (0.5 * (to - from))
    } else {
        0.0
    }
}
