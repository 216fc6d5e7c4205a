//! Tests the bounds of polynomials against samples.

use super::*;
use ccd_core::order::greater;
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64;

fn random_polynomial(random: &mut Pcg64) -> Polynomial {
    let degree = random.random_range(0..=MAX_DEGREE);
    let coefficients: Vec<f64> = (0..=degree)
        .map(|_| random.random_range(-2.0..2.0))
        .collect();
    Polynomial::new(degree, |power| coefficients[power])
}

/// Returns the value at a share, power by power.
fn value(polynomial: &Polynomial, share: f64) -> f64 {
    let powers = polynomial.coefficients.iter().enumerate();
    powers
        .map(|(power, coefficient)| coefficient * share.powi(power as i32))
        .sum()
}

/// Tests that a polynomial about another share has the same values, within the error that its size allows.
#[test]
fn a_polynomial_about_another_share_is_the_same() {
    let mut random = Pcg64::seed_from_u64(31);
    let mut largest_share = 0.0;
    for _ in 0..2000 {
        let polynomial = random_polynomial(&mut random);
        let share = random.random_range(0.0..1.0);
        let about = polynomial.about(share);
        let allowed = 2.0 * f64::EPSILON * rounding_factor(polynomial.degree) * polynomial.size();
        let error = (about.constant() - value(&polynomial, share)).abs();
        largest_share = greater(largest_share, error / allowed);
        let other = random.random_range(0.0..1.0);
        let there = value(&about, other - share);
        let error = (there - value(&polynomial, other)).abs();
        largest_share = greater(largest_share, error / allowed);
    }
    assert!(
        largest_share < 1.0 && largest_share > 1e-3,
        "{largest_share}"
    );
}

/// Tests that no sample is farther from the middle, or from the chord, than the bounds say, and that straight lines and
/// parabolas reach them.
#[test]
fn deviations_are_within_their_bounds() {
    let mut random = Pcg64::seed_from_u64(32);
    let [mut from_middle, mut from_chord] = [0.0; 2];
    for _ in 0..3000 {
        let polynomial = random_polynomial(&mut random);
        let middle: f64 = random.random_range(0.01..0.99);
        let half = random.random_range(0.001..1.0) * lesser(middle, 1.0 - middle);
        let about = polynomial.about(middle);
        let (deviation, chord) = (
            about.deviation_bound(half),
            about.chord_deviation_bound(half),
        );
        let ends = [middle - half, middle + half].map(|share| value(&polynomial, share));
        for k in 0..=16 {
            let along = f64::from(k) / 16.0;
            let here = value(&polynomial, middle - half + 2.0 * half * along);
            let moved = (here - about.constant()).abs();
            assert!(
                moved <= deviation * (1.0 + 1e-9) + 1e-12,
                "{moved} {deviation}"
            );
            let line = ends[0] + along * (ends[1] - ends[0]);
            let curved = (here - line).abs();
            assert!(curved <= chord + 1e-12, "{curved} {chord}");
            if deviation > 1e-6 {
                from_middle = greater(from_middle, moved / deviation);
            }
            if chord > 1e-6 {
                from_chord = greater(from_chord, curved / chord);
            }
        }
    }
    assert!(
        from_middle > 0.99 && from_chord > 0.99,
        "{from_middle} {from_chord}"
    );
}

/// Tests that no value is outside of a range, and that ranges are narrow even if coefficients cancel.
#[test]
fn ranges_enclose_all_values_and_fit() {
    let mut random = Pcg64::seed_from_u64(33);
    let mut widest: f64 = 0.0;
    for number in 0..500 {
        // Half of them are Chebyshev polynomials: values up to 1, coefficients up to a million.
        let polynomial = if number % 2 == 0 {
            random_polynomial(&mut random)
        } else {
            chebyshev(random.random_range(1..=MAX_DEGREE))
        };
        let range = polynomial.range();
        let values = (0..=200).map(|k| value(&polynomial, f64::from(k) / 200.0));
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

/// Returns the Chebyshev polynomial of a degree on shares from 0 to 1, by its recurrence.
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
    Polynomial::new(degree, |power| last[1][power])
}
