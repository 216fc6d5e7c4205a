//! Tests splines against sums of basis functions in exact fractions.

use super::*;
use crate::rational::exact_fraction;
use dashu_ratio::Relaxed;
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64;

/// Returns the value of a basis function by its recursive definition, with 0/0 = 0.
fn basis_value(knots: &[Relaxed], degree: usize, number: usize, at: &Relaxed) -> Relaxed {
    if degree == 0 {
        let inside = knots[number] <= *at && *at < knots[number + 1];
        return Relaxed::from(u8::from(inside));
    }
    let mut sum = Relaxed::ZERO;
    let rise = &knots[number + degree] - &knots[number];
    if rise > Relaxed::ZERO {
        sum += (at - &knots[number]) / rise * basis_value(knots, degree - 1, number, at);
    }
    let fall = &knots[number + degree + 1] - &knots[number + 1];
    if fall > Relaxed::ZERO {
        let left = &knots[number + degree + 1] - at;
        sum += left / fall * basis_value(knots, degree - 1, number + 1, at);
    }
    sum
}

/// Returns the exact value of a polynomial whose coefficients are double-double numbers.
fn exact_value(curve: &JointCurve, segment: usize, fraction: &Relaxed) -> Relaxed {
    let powers = (0..=curve.degree()).rev();
    powers.fold(Relaxed::ZERO, |value, power| {
        let [high, low] = curve.coefficient(segment, power, 0).parts();
        value * fraction + exact_fraction(high) + exact_fraction(low)
    })
}

/// Tests that values are accurate to 25 digits of the coefficients, far from 0 and with knot distances that differ by
/// a factor of a hundred.
#[test]
fn splines_are_the_sums_of_their_basis_functions() {
    let mut random = Pcg64::seed_from_u64(9);
    for degree in 1..=MAX_DEGREE {
        let count = degree + 4;
        let offset = 10f64.powi(random.random_range(-2..6));
        let coefficients: Vec<f64> = (0..count)
            .map(|_| offset + random.random_range(-1.0..1.0))
            .collect();
        let mut knots = vec![random.random_range(-1e3..1e3)];
        while knots.len() < count + degree + 1 {
            let repeats = random.random_range(0.0..1.0) < 0.2;
            let step = 10f64.powf(random.random_range(-2.0..0.0));
            knots.push(knots[knots.len() - 1] + if repeats { 0.0 } else { step });
        }
        let Ok(curve) =
            JointCurve::from_b_spline(degree, &knots, std::slice::from_ref(&coefficients))
        else {
            // A knot of high multiplicity makes a jump.
            assert!(degree < 3, "degree {degree}");
            continue;
        };
        let exact: Vec<Relaxed> = knots.iter().map(|&knot| exact_fraction(knot)).collect();
        for segment in 0..curve.segment_count() {
            let [from, to] = [segment, segment + 1].map(|k| exact_fraction(curve.times()[k]));
            for fraction in [0.0, 0.123, 0.5, 0.875] {
                let fraction = exact_fraction(fraction);
                let at = &from + (&to - &from) * &fraction;
                let terms = coefficients.iter().enumerate();
                let expected: Relaxed = terms
                    .map(|(k, &own)| exact_fraction(own) * basis_value(&exact, degree, k, &at))
                    .fold(Relaxed::ZERO, |sum, term| sum + term);
                let error = exact_value(&curve, segment, &fraction) - expected;
                let error = error.to_f64().value().abs();
                assert!(error <= 1e-25 * (1.0 + offset), "degree {degree}: {error}");
            }
        }
    }
}

#[test]
fn wrong_splines_are_refused() {
    let refused = |degree, knots: &[f64], count: usize| {
        JointCurve::from_b_spline(degree, knots, &[vec![0.0; count]]).unwrap_err()
    };
    let knots = [0.0, 0.0, 1.0, 2.0, 3.0, 3.0];
    assert!(JointCurve::from_b_spline(1, &knots, &[vec![0.0; 4]]).is_ok());
    assert!(matches!(
        refused(10, &knots, 4),
        CurveError::DegreeTooHigh { degree: 10 }
    ));
    assert!(matches!(
        refused(1, &knots, 5),
        CurveError::WrongCount { .. }
    ));
    assert!(matches!(
        refused(1, &[0.0, 0.0, 2.0, 1.0, 3.0, 3.0], 4),
        CurveError::TimesNotIncreasing { segment: 2 }
    ));
    assert!(matches!(
        refused(1, &[0.0, f64::NAN, 1.0, 2.0, 3.0, 3.0], 4),
        CurveError::TimesNotIncreasing { segment: 0 }
    ));
    assert!(matches!(
        refused(1, &[1.0; 6], 4),
        CurveError::TooFewTimes { .. }
    ));
}
