//! Formats numbers and texts for messages.

use std::fmt;

/// Displays a number with few digits, with an exponent if it is very large or very small.
#[derive(Clone, Copy)]
pub(crate) struct Number(pub(crate) f64);

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

/// Displays a text on one line of a terminal, with control characters escaped.
#[cfg(feature = "command")]
pub(crate) struct Printable<'a>(pub(crate) &'a str);

#[cfg(feature = "command")]
impl fmt::Display for Printable<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        use fmt::Write;
        // Marks of direction would reverse the text after them.
        let turns = |c| matches!(c, '\u{200e}' | '\u{200f}' | '\u{202a}'..='\u{202e}' | '\u{2066}'..='\u{2069}');
        for c in self.0.chars() {
            if c.is_control() || turns(c) {
                write!(f, "{}", c.escape_default())?;
            } else {
                f.write_char(c)?;
            }
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::Number;

    #[cfg(feature = "command")]
    #[test]
    fn nothing_controls_a_terminal() {
        use super::Printable;
        for (text, expected) in [
            ("café 部品 −1", "café 部品 −1"),
            ("\u{1b}[31mred\u{7}", "\\u{1b}[31mred\\u{7}"),
            ("over\rwritten\n\tline", "over\\rwritten\\n\\tline"),
            (
                "\u{9b}2J\u{0}\u{7f}\u{202e}txt.exe",
                "\\u{9b}2J\\u{0}\\u{7f}\\u{202e}txt.exe",
            ),
        ] {
            assert_eq!(Printable(text).to_string(), expected);
        }
    }

    #[test]
    fn numbers_are_short() {
        let numbers = [0.0, -1.0, 0.001, 1e-320, -1e308, 12_345.5, f64::INFINITY];
        let texts = ["0", "-1", "0.001", "1e-320", "-1e308", "12345.5", "inf"];
        assert_eq!(numbers.map(|number| Number(number).to_string()), texts);
    }
}
