use super::{Velocities, published_bound, sound_bound};
use crate::math::vector::{length, unit};
use crate::rounding::RATE_ERROR_F64;
use crate::tests::double::{DoubleDouble, DoubleDouble3};
use crate::tests::worst::{WorstCaseSearch, error_fraction};
use glam::DVec3;

/// Tests that the rounding error of [`sound_bound`] is within the allowance for rates.
#[test]
fn worst_sound_bound() {
    let found = WorstCaseSearch::new("RATE_F64, the sound bound", 40_000).search(|tape| {
        let n = unit(tape.vector(-40..=0).into())?;
        let motion = Velocities {
            linear_velocity: DVec3::from(tape.vector(-30..=10)),
            spin: DVec3::from(tape.vector(-30..=10)),
        };
        let reach = tape.size(-20..=10);
        let [n3, v, spin] = [n, motion.linear_velocity, motion.spin].map(DoubleDouble3::from);
        let exact = n3.dot(v) + n3.cross(spin).length() * DoubleDouble::from(reach);
        let lost = exact - DoubleDouble::from(sound_bound(&motion, n, reach));
        let speed = length(motion.linear_velocity) + length(motion.spin) * reach;
        Some(error_fraction(lost.get(), RATE_ERROR_F64 * speed))
    });
    found.assert_tight_bound(16.0);
}

#[test]
fn the_published_bound_is_the_speed_of_the_farthest_arm_at_this_instant() {
    let motion = Velocities {
        linear_velocity: DVec3::new(-1.0, 2.0, 3.0),
        spin: DVec3::new(0.0, 0.0, 2.0),
    };
    // Here n × ω = −2 Y.
    for (arm, expected) in [(-3.0, 1.0 + 6.0), (3.0, 1.0)] {
        let farthest = |along: DVec3| {
            assert_eq!(along, DVec3::new(0.0, -2.0, 0.0));
            DVec3::new(5.0, arm, 7.0)
        };
        assert_eq!(published_bound(&motion, DVec3::X, farthest), expected);
    }
}
