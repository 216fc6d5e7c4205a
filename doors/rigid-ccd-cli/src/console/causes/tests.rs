use super::*;
use crate::files::output::OutputError;
use anyhow::{Context, anyhow};
use std::io;

#[test]
fn every_cause_is_reported_once() {
    let source = io::Error::from_raw_os_error(2);
    let words = without_error_numbers(&source.to_string());
    assert!(!words.contains("os error"), "{words}");
    let place = "out.csv".to_owned();
    let error = anyhow::Error::from(OutputError {
        file_or_stream: place,
        source,
    });
    assert_eq!(
        message_with_causes(&error),
        format!("cannot write out.csv: {words}")
    );
    let error = Err::<(), _>(anyhow!("inner")).context("outer").unwrap_err();
    assert_eq!(message_with_causes(&error), "outer: inner");
}

#[test]
fn only_error_numbers_are_removed() {
    for (text, expected) in [
        ("gone (os error 2); look", "gone; look"),
        ("a (os error 2): b (os error 13)", "a: b"),
        ("a (os error x)", "a (os error x)"),
        ("a (os error )", "a (os error )"),
    ] {
        assert_eq!(without_error_numbers(text), expected);
    }
}
