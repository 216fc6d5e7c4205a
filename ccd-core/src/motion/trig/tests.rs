use super::sin_cos;
use crate::limits::MAX_TURN;
use crate::math::order::greater;
use crate::tolerance::U64;

#[test]
fn agrees_with_the_standard_library() {
    let mut worst = 0.0f64;
    for k in 0..2_000_000u32 {
        // Dense near 0, spread evenly on a scale of ratios up to the largest turn.
        let angle = MAX_TURN.powf(f64::from(k) / 2e6 * 1.5 - 0.5);
        let (sin, cos) = sin_cos(angle);
        let (s, c) = angle.sin_cos();
        worst = greater(greater(worst, (sin - s).abs()), (cos - c).abs());
    }
    // Either is off by half a unit in the last place at best.
    assert!(worst <= 2.0 * U64, "{}", worst / U64);
    assert_eq!(sin_cos(0.0), (0.0, 1.0));
}
