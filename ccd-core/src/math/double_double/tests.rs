//! Tests that products and differences keep the digits that f64 alone would lose.

use super::*;

#[test]
fn digits_that_cancel_are_kept() {
    // (2²⁷ + 1)² − 2⁵⁴ = 2²⁸ + 1; f64 loses the 1.
    let x = DoubleDouble::from(134_217_729.0);
    let square = DoubleDouble::from(18_014_398_509_481_984.0);
    assert_eq!((x * x - square).value(), 268_435_457.0);
    // The same without the last bit of the product's parts.
    let [high, low] = (x * x).parts();
    assert_eq!((DoubleDouble::from_parts([high, low]) - x * x).value(), 0.0);
}
