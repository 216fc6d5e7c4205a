//! Numbers in messages.

use std::fmt;

/// A number displayed in few digits: very large and very small ones with an exponent.
#[derive(Clone, Copy)]
pub(crate) struct Number(pub(crate) f64);

impl fmt::Display for Number {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Number(value) = *self;
        // NaN and infinities have no exponent.
        match value == 0.0 || !value.is_finite() || (1e-4..1e7).contains(&value.abs()) {
            true => write!(f, "{value}"),
            false => write!(f, "{value:e}"),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::Number;

    #[test]
    fn numbers_are_short() {
        let numbers = [0.0, -1.0, 0.001, 1e-320, -1e308, 12_345.5, f64::INFINITY];
        let texts = ["0", "-1", "0.001", "1e-320", "-1e308", "12345.5", "inf"];
        assert_eq!(numbers.map(|number| Number(number).to_string()), texts);
    }
}
