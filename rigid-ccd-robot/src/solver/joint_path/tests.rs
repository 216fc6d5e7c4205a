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
