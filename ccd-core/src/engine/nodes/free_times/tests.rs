//! Tests that `FreeTimes` returns its lanes in the order of a sorted list.

use super::{FreeTimes, LANE_INDEX_MASK};
use crate::body::tree::LANES;
use crate::math::simd::load;
use crate::settings::VectorInstructions;
use crate::tests::scene::{Pcg64, RngExt, rng};
use crate::vectorize;

/// Draws a free time; many are equal, extreme or NaN.
fn random_free_time(rng: &mut Pcg64) -> f32 {
    match rng.random_range(0..7) {
        0 => 0.0,
        6 => [f32::NAN, -0.0][rng.random_range(0..2)],
        1 => f32::INFINITY,
        2 => f32::MAX,
        3 => f32::from_bits(rng.random_range(0..40)),
        4 => 0.5,
        _ => rng.random_range(0.0..2.0),
    }
}

#[test]
fn times_come_out_in_order_each_lane_once() {
    let mut rng = rng(7);
    let mut many = 0;
    for _ in 0..20_000 {
        let free: [f32; LANES] = std::array::from_fn(|_| random_free_time(&mut rng));
        let used = rng.random();
        let level = VectorInstructions::Best.simd_level();
        let mut times = vectorize!(level, level => FreeTimes::pack(load(level, &free), used));
        let rounded = |lane: usize| {
            if free[lane] > 0.0 {
                f32::from_bits(free[lane].to_bits() & !LANE_INDEX_MASK)
            } else {
                0.0
            }
        };
        let waits = |lane: &usize| used >> lane & 1 == 1 && rounded(*lane) < f32::INFINITY;
        let mut expected: Vec<usize> = (0..LANES).filter(waits).collect();
        expected.sort_by(|&a, &b| rounded(a).total_cmp(&rounded(b)).then(a.cmp(&b)));
        many += usize::from(expected.len() > 2);
        for lane in expected {
            assert_eq!(times.least_time(), rounded(lane), "{free:?} {used:b}");
            assert_eq!(times.finish_least_lane(), lane, "{free:?} {used:b}");
        }
        assert_eq!(times.least_time(), f32::INFINITY, "{free:?} {used:b}");
    }
    assert!(many > 5_000, "{many}");
}
