//! The times at which the parts of a trajectory meet.

/// Returns a knot strictly between two times, if there is one, about the middle of all.
pub(super) fn middle_knot(knots: impl Iterator<Item = f64>, from: f64, to: f64) -> Option<f64> {
    let inner: Vec<f64> = knots.filter(|&knot| knot > from && knot < to).collect();
    inner.get(inner.len() / 2).copied()
}

/// Returns the acceleration in half of a stretch by which velocities that jump at knots stray as far.
pub(super) fn spread(jumps: impl Iterator<Item = f64>, from: f64, to: f64) -> f64 {
    let jumps: f64 = jumps.sum();
    match jumps > 0.0 {
        true => 2.0 * jumps / (0.5 * (to - from)),
        false => 0.0,
    }
}
