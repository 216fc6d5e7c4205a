//! Why a run failed: each cause once, and in words.

/// What is told of an error and of its causes, from the outermost inward.
pub(super) fn in_words(error: &anyhow::Error) -> String {
    let mut told = String::new();
    for cause in error.chain() {
        let cause = without_numbers(&cause.to_string());
        // Most errors tell their cause in their own words.
        if told.contains(&cause) {
            continue;
        }
        if !told.is_empty() {
            told += ": ";
        }
        told += &cause;
    }
    told
}

/// What stands before the number that the system has for an error.
const NUMBER: &str = " (os error ";

/// Without the numbers of the system's errors, beside which there are their words.
fn without_numbers(text: &str) -> String {
    let mut parts = text.split(NUMBER);
    let mut out = parts.next().unwrap_or_default().to_owned();
    for part in parts {
        let digits = part.trim_start_matches(|c: char| c.is_ascii_digit());
        match digits.strip_prefix(')') {
            Some(rest) if digits.len() < part.len() => out += rest,
            _ => {
                out += NUMBER;
                out += part;
            }
        }
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::command::files::CannotWrite;
    use anyhow::{Context, anyhow};
    use std::io;

    #[test]
    fn every_cause_is_told_once() {
        let source = io::Error::from_raw_os_error(2);
        let words = without_numbers(&source.to_string());
        assert!(!words.contains("os error"), "{words}");
        let place = "out.csv".to_owned();
        let error = anyhow::Error::from(CannotWrite { place, source });
        assert_eq!(in_words(&error), format!("cannot write out.csv: {words}"));
        let error = Err::<(), _>(anyhow!("inner")).context("outer").unwrap_err();
        assert_eq!(in_words(&error), "outer: inner");
    }

    #[test]
    fn only_numbers_of_errors_are_left_out() {
        for (text, expected) in [
            ("gone (os error 2); look", "gone; look"),
            ("a (os error 2): b (os error 13)", "a: b"),
            ("a (os error x)", "a (os error x)"),
            ("a (os error )", "a (os error )"),
        ] {
            assert_eq!(without_numbers(text), expected);
        }
    }
}
