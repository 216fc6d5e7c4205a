//! Formats numbers and quotes texts for messages.

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

/// Displays the beginning of a text from a file, with its length if that is not all.
#[derive(Clone, Copy)]
pub struct Excerpt<'a>(pub &'a str);

/// The greatest number of characters of a text that a message quotes.
const MAX_QUOTED_CHARS: usize = 60;

impl fmt::Display for Excerpt<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Excerpt(text) = *self;
        match text.char_indices().nth(MAX_QUOTED_CHARS) {
            Some((end, _)) => write!(f, "{}… ({} bytes)", &text[..end], text.len()),
            None => f.write_str(text),
        }
    }
}

#[cfg(test)]
mod tests;
