use super::Gap;
use crate::rounding::RATE_ERROR_F64;
use crate::tests::double::DoubleDouble;
use crate::tests::scene::{RngExt, random_power_of_ten, rng};
use crate::tests::worst::{WorstCaseSearch, error_fraction};

/// Compares free times, without their allowance for rounding, with the exact roots of quadratic equations.
#[test]
fn worst_free_time() {
    let found = WorstCaseSearch::new("RATE_F64, a free time", 40_000).search(|tape| {
        let gap = Gap {
            gap: tape.size(-200..=30),
            rate: tape.any_number(-60..=60),
            second_derivative: tape.size(-60..=60),
        };
        let [apart, rate, second_derivative] =
            [gap.gap, gap.rate, gap.second_derivative].map(DoubleDouble::from);
        let two = DoubleDouble::from(2.0);
        let root = (rate * rate + two * second_derivative * apart).sqrt();
        let exact = if gap.rate > 0.0 {
            two * apart / (rate + root)
        } else {
            (root - rate) / second_derivative
        };
        let free = DoubleDouble::from(gap.free_time()) / DoubleDouble::from(1.0 - RATE_ERROR_F64);
        Some(error_fraction(
            (free / exact - DoubleDouble::from(1.0)).get(),
            RATE_ERROR_F64,
        ))
    });
    found.assert_tight_bound(8.0);
}

/// Tests that the free times of gaps that close ever slower are never late, and nearly exact. If the gap closes at all,
/// the squares may all but cancel.
#[test]
fn a_free_time_of_parting_is_never_late_and_near() {
    let mut rng = rng(1);
    let (mut closes, mut near, mut stays) = (0, 0, 0);
    for _ in 0..100_000 {
        let [gap, rate] = [0; 2].map(|_| random_power_of_ten(&mut rng, -12.0, 6.0));
        // The second derivative is that at which the gap just closes, or any other.
        let just = rate * rate / (2.0 * gap);
        let second_derivative = if rng.random_bool(0.5) {
            just * (1.0 + random_power_of_ten(&mut rng, -16.0, 0.0) * rng.random_range(-1.0..1.0))
        } else {
            random_power_of_ten(&mut rng, -12.0, 6.0)
        };
        let found = Gap {
            gap,
            rate,
            second_derivative: -second_derivative,
        };
        let free = found.free_time();
        let [gap, rate, second_derivative] =
            [gap, rate, -second_derivative].map(DoubleDouble::from);
        let two = DoubleDouble::from(2.0);
        let left = rate * rate + two * second_derivative * gap;
        if left.get() < 0.0 {
            stays += u32::from(free == f64::INFINITY);
            continue;
        }
        closes += 1;
        let exact = two * gap / (rate + left.sqrt());
        let share = (DoubleDouble::from(free) / exact).get();
        assert!(share <= 1.0, "{found:?}: {share}");
        let kept = (left / (rate * rate)).get();
        near += u32::from(kept < 1e-6 || share >= 1.0 - 1e-7);
    }
    assert_eq!(near, closes);
    assert!(closes > 20_000 && stays > 20_000, "{closes} {stays}");
}

#[test]
fn a_gap_that_never_closes_is_free_for_good() {
    let time = |gap: f64, rate: f64, second_derivative: f64| {
        Gap {
            gap,
            rate,
            second_derivative,
        }
        .free_time()
    };
    let forever = f64::INFINITY;
    assert_eq!(time(1.0, -1.0, -1.0), forever);
    assert_eq!(time(1.0, 0.0, -1.0), forever);
    assert_eq!(time(1.0, 1.0, -0.501), forever);
    // The gap closes after 2, ever slower.
    assert!((1.99..=2.0).contains(&time(1.0, 1.0, -0.5)));
    // A value that is NaN, or overflows, has no free time.
    for gap in [0.0, -1.0, f64::NAN] {
        assert_eq!(time(gap, 1.0, -1.0), 0.0);
        assert_eq!(time(gap, -1.0, -1.0), 0.0);
    }
    assert_eq!(time(1.0, f64::NAN, -1.0), 0.0);
    assert_eq!(time(1.0, 1e200, -1.0), 0.0);
    assert_eq!(time(1.0, -1e200, -1.0), 0.0);
    assert_eq!(time(1.0, 1.0, f64::NEG_INFINITY), 0.0);
    assert_eq!(time(f64::INFINITY, 1.0, -1.0), 0.0);
    // Lost squares give no more time than the rate does.
    let lost = time(1e-170, 1e-170, -1e-300);
    assert!((0.0..=1.0).contains(&lost), "{lost}");
}
