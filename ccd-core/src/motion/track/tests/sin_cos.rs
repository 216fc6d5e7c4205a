use crate::limits::MAX_ROTATION_ANGLE;
use crate::math::order::greater;
use crate::motion::track::sin_cos;
use crate::rounding::UNIT_ROUNDOFF_F64;
use crate::tests::double::DoubleDouble;
use crate::tests::worst::{WorstCaseSearch, error_fraction};

#[test]
fn agrees_with_the_standard_library() {
    let mut worst = 0.0f64;
    for k in 0..2_000_000u32 {
        // The angles are dense near 0, and spread evenly on a logarithmic scale up to the largest turn.
        let angle = MAX_ROTATION_ANGLE.powf(f64::from(k) / 2e6 * 1.5 - 0.5);
        let (sin, cos) = sin_cos(angle);
        let (s, c) = angle.sin_cos();
        worst = greater(greater(worst, (sin - s).abs()), (cos - c).abs());
    }
    // At best each function is off by half a unit in the last place.
    assert!(
        worst <= 2.0 * UNIT_ROUNDOFF_F64,
        "{}",
        worst / UNIT_ROUNDOFF_F64
    );
    assert_eq!(sin_cos(0.0), (0.0, 1.0));
}

/// Tests that `sin_cos` is off by at most 2u, at angles next to multiples of a right angle and elsewhere.
#[test]
fn worst_sine_and_cosine() {
    let found = WorstCaseSearch::new("sin_cos: 2u", 40_000).search(|tape| {
        let angle = match tape.index_below(2) {
            0 => tape.size(-30..=19),
            _ => {
                tape.index_below(600_000) as f64
                    * std::f64::consts::FRAC_PI_2
                    * (1.0 + tape.any_number(-53..=-20))
            }
        };
        let (sin, cos) = sin_cos(angle.abs());
        let exact = DoubleDouble::from(angle.abs()).sin_cos();
        let off =
            |rounded: f64, exact: DoubleDouble| (DoubleDouble::from(rounded) - exact).get().abs();
        Some(error_fraction(
            greater(off(sin, exact.0), off(cos, exact.1)),
            2.0 * UNIT_ROUNDOFF_F64,
        ))
    });
    found.assert_tight_bound(3.0);
}
