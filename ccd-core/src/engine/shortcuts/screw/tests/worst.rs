//! Compares the computed screw motion of a body with its exact motion, in double-double arithmetic.

use crate::math::vector::length;
use crate::motion::Motion;
use crate::motion::path::Path;
use crate::motion::pose::Pose;
use crate::rounding::SCREW_VELOCITY_ERROR_F64;
use crate::tests::double::{DoubleDouble, DoubleDouble3};
use crate::tests::worst::{WorstCaseSearch, error_fraction};
use glam::DVec3;

#[test]
fn worst_advance() {
    let found = WorstCaseSearch::new("ADVANCE_F64", 40_000).search(|tape| {
        let spin = DVec3::from(tape.vector(-10..=6));
        let advance = tape.any_number(-10..=4);
        let velocity = spin * advance + DVec3::from(tape.vector(-70..=-5));
        let motion = Motion::new(Pose::IDENTITY, velocity, spin).ok()?;
        let path = Path::new(&motion, DVec3::ZERO, 1.0);
        if !path.is_turning() {
            return None;
        }
        // The advance is along the axis, and the rest of the velocity is drift, as in a screw.
        let along = path.velocity.dot(path.axis);
        let drift = length(path.velocity - along * path.axis);
        let per_radian = along / path.angular_speed;
        let [v, w] = [velocity, spin].map(DoubleDouble3::from);
        let exact = v - w.scale(DoubleDouble::from(per_radian));
        let lost = exact.length() - DoubleDouble::from(drift);
        Some(error_fraction(
            lost.get(),
            SCREW_VELOCITY_ERROR_F64 * length(velocity),
        ))
    });
    found.assert_tight_bound(40.0);
}
