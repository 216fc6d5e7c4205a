//! Displays numbers in messages with few digits.

use std::fmt;

/// Displays a number with few digits, with an exponent if it is very large or very small.
#[derive(Clone, Copy)]
pub struct Number(pub f64);

impl fmt::Display for Number {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Number(value) = *self;
        // NaN and infinities have no exponent.
        if value == 0.0 || !value.is_finite() || (1e-4..1e7).contains(&value.abs()) {
            write!(f, "{value}")
        } else {
            write!(f, "{value:e}")
        }
    }
}

/// Displays a number rounded to four digits.
#[derive(Clone, Copy)]
pub struct RoundedToFourDigits(pub f64);

impl fmt::Display for RoundedToFourDigits {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let rounded: f64 = format!("{:.3e}", self.0).parse().unwrap_or(self.0);
        write!(f, "{}", Number(rounded))
    }
}

#[cfg(test)]
mod tests;
