//! Displays numbers in messages with few digits.

use std::fmt;

#[doc(inline)]
pub use ccd_core::ShortNumber as Number;

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
