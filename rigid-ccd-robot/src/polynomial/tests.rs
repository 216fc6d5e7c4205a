//! Tests the bounds of polynomials against exact arithmetic, in the worst cases found by a search, and against
//! samples.

use super::*;
use crate::rational::exact_fraction;
use crate::worst::{RandomCase, WorstCaseSearch, error_fraction};
use dashu_ratio::Relaxed;
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64;

const U: f64 = 0.5 * f64::EPSILON;

fn random_polynomial(random: &mut Pcg64) -> Polynomial {
    let degree = random.random_range(0..=MAX_DEGREE);
    let coefficients: Vec<f64> = (0..=degree)
        .map(|_| random.random_range(-2.0..2.0))
        .collect();
    Polynomial::new(degree, |power| coefficients[power].into())
}

/// Returns a polynomial with random coefficients, or one whose coefficients cancel.
fn polynomial_of_case(case: &mut RandomCase) -> Polynomial {
    let degree = case.index_below(MAX_DEGREE + 1);
    if case.index_below(2) == 0 {
        let coefficients = [(); MAX_DEGREE + 1].map(|()| case.any_number(-30..=10));
        let low = [(); MAX_DEGREE + 1].map(|()| case.any_number(-110..=-54));
        return Polynomial::new(degree, |power| {
            let high = coefficients[power];
            DoubleDouble::from(high) + DoubleDouble::from(high * low[power])
        });
    }
    let scale = case.any_number(-10..=10);
    let chebyshev = chebyshev(degree.max(1));
    Polynomial::new(degree.max(1), |power| {
        DoubleDouble::product(scale, chebyshev.coefficient(power))
    })
}

/// Returns the exact value at a fraction of the segment.
fn exact_value(polynomial: &Polynomial, fraction: f64) -> Relaxed {
    let fraction = exact_fraction(fraction);
    let exact = |own: &DoubleDouble| {
        let [high, low] = own.parts().map(exact_fraction);
        high + low
    };
    let all = polynomial.coefficients.iter().rev().map(exact);
    all.fold(Relaxed::ZERO, |sum, own| own + &fraction * sum)
}

fn size_of(exact: &Relaxed) -> f64 {
    exact.to_f64().value().abs()
}

/// Returns the allowed rounding error of values. Deviations have an additional one.
fn allowance(polynomial: &Polynomial, exact: &Relaxed) -> f64 {
    U * size_of(exact) + EXTENDED_PRECISION_ERROR * polynomial.coefficient_magnitude_sum()
}

/// Tests that the rounding error of a value is relative to the value, not to the coefficients, also after expansion
/// about another point.
#[test]
fn worst_values_are_within_their_rounding() {
    let search = WorstCaseSearch::new("value of a polynomial", 5_000);
    let worst = search.search(|case| {
        let polynomial = polynomial_of_case(case);
        // Differences of these fractions are exact.
        let [fraction, other] = [(); 2].map(|()| (case.next_word() >> 44) as f64 * 0.5f64.powi(20));
        let exact = exact_value(&polynomial, fraction);
        let values = [
            polynomial.value(fraction),
            polynomial.expanded_about(fraction).constant(),
            polynomial.expanded_about(other).value(fraction - other),
        ];
        let errors = values.map(|value| size_of(&(exact_fraction(value) - &exact)));
        let error = errors.into_iter().fold(0.0, greater);
        Some(error_fraction(error, allowance(&polynomial, &exact)))
    });
    worst.assert_tight_bound(2.0);
}

/// Returns the midpoint of a range, half its length, and a point in it. Their sums and differences are exact.
fn range_and_fraction(case: &mut RandomCase) -> [f64; 3] {
    let fraction = |case: &mut RandomCase| (case.next_word() >> 44) as f64 * 0.5f64.powi(20);
    let [middle, half] = [(); 2].map(|()| fraction(case));
    let half = lesser(half, lesser(middle, 1.0 - middle)) * 0.5f64.powi(case.index_below(3) as i32);
    let along = (case.index_below(17) as f64 - 8.0) / 8.0;
    [middle, half, along]
}

/// Tests that no value deviates from the midpoint's by more than the bound, and that straight lines reach it.
#[test]
fn worst_deviations_are_within_their_bounds() {
    let search = WorstCaseSearch::new("deviation of a polynomial", 5_000);
    let worst = search.search(|case| {
        let polynomial = polynomial_of_case(case);
        let [middle, half, along] = range_and_fraction(case);
        let about = polynomial.expanded_about(middle);
        let at = |fraction| exact_value(&polynomial, fraction);
        let moved = at(middle + along * half) - at(middle);
        let bound = about.deviation_bound(half) + allowance(&polynomial, &Relaxed::ZERO);
        Some(error_fraction(size_of(&moved), bound))
    });
    worst.assert_tight_bound(1.01);
}

/// Tests that no value deviates from the chord by more than the bound, and that parabolas reach it.
#[test]
fn worst_deviations_from_a_chord_are_within_their_bounds() {
    let search = WorstCaseSearch::new("deviation of a polynomial from a chord", 5_000);
    let worst = search.search(|case| {
        let polynomial = polynomial_of_case(case);
        let [middle, half, along] = range_and_fraction(case);
        let about = polynomial.expanded_about(middle);
        let at = |fraction| exact_value(&polynomial, fraction);
        let [first, last] = [middle - half, middle + half].map(at);
        let fraction = exact_fraction(0.5 + 0.5 * along);
        let line = &first + fraction * (&last - &first);
        let curved = at(middle + along * half) - line;
        let bound = about.chord_deviation_bound(half) + allowance(&polynomial, &Relaxed::ZERO);
        Some(error_fraction(size_of(&curved), bound))
    });
    worst.assert_tight_bound(1.01);
}

/// Tests that no derivative exceeds the bound.
#[test]
fn worst_rates_are_within_their_bounds() {
    let search = WorstCaseSearch::new("rate of a polynomial", 5_000);
    let worst = search.search(|case| {
        let polynomial = polynomial_of_case(case);
        let [middle, half, along] = range_and_fraction(case);
        let (from, to) = (middle - half, middle + along * half);
        let change = exact_value(&polynomial, to) - exact_value(&polynomial, from);
        let rate = polynomial.expanded_about(middle).rate_bound(half);
        let bound = rate * (to - from) + allowance(&polynomial, &Relaxed::ZERO);
        Some(error_fraction(size_of(&change), bound))
    });
    worst.assert_tight_bound(1.01);
}

/// Tests that ranges contain all values, and that they are narrow even if coefficients cancel.
#[test]
fn ranges_enclose_all_values_and_fit() {
    let mut random = Pcg64::seed_from_u64(33);
    let mut widest: f64 = 0.0;
    for number in 0..500 {
        // Half of them are Chebyshev polynomials, with values up to 1 and coefficients up to a million.
        let polynomial = if number % 2 == 0 {
            random_polynomial(&mut random)
        } else {
            chebyshev(random.random_range(1..=MAX_DEGREE))
        };
        let range = polynomial.range();
        let values = (0..=200).map(|k| polynomial.value(f64::from(k) / 200.0));
        let (mut min, mut max) = (f64::INFINITY, f64::NEG_INFINITY);
        for value in values {
            (min, max) = (lesser(min, value), greater(max, value));
        }
        assert!(
            range[0] <= min + 1e-9 && max <= range[1] + 1e-9,
            "{range:?} {min} {max}"
        );
        widest = greater(widest, (range[1] - range[0]) / (max - min));
    }
    assert!(widest > 1.0 && widest < 5.0, "{widest}");
}

/// Returns a Chebyshev polynomial on [0, 1], by its recurrence.
fn chebyshev(degree: usize) -> Polynomial {
    let mut last = [vec![1.0], vec![-1.0, 2.0]];
    for _ in 1..degree {
        let [before, now] = &last;
        let mut next = vec![0.0; now.len() + 1];
        for (power, coefficient) in now.iter().enumerate() {
            next[power] -= 2.0 * coefficient;
            next[power + 1] += 4.0 * coefficient;
        }
        for (power, coefficient) in before.iter().enumerate() {
            next[power] -= coefficient;
        }
        last = [now.clone(), next];
    }
    Polynomial::new(degree, |power| last[1][power].into())
}
