use super::*;

#[test]
fn numbers_with_many_digits_are_printed_with_an_exponent() {
    for (value, printed) in [
        (0.0, "0"),
        (-2.5, "-2.5"),
        (9_999_999.0, "9999999"),
        (-1e308, "-1e308"),
        (1.5e13, "1.5e13"),
        (5e-324, "5e-324"),
        (f64::NAN, "NaN"),
        (f64::NEG_INFINITY, "-inf"),
    ] {
        let error = InputError::OutOfRange {
            quantity: "margin",
            value,
            allowed: "small",
        };
        let expected = format!("margin is {printed}, but must be small");
        assert_eq!(error.to_string(), expected);
    }
}

#[test]
fn too_large_numbers_are_reported_with_the_range() {
    let radius = InputError::BadRadius {
        piece: 3,
        radius: -1.0,
    };
    assert_eq!(
        radius.to_string(),
        "the radius of piece 3 is -1, but must be from 0 to 1e12"
    );
    let point = InputError::BadPoint { piece: 3, point: 4 };
    let printed = point.to_string();
    assert!(
        printed.ends_with("a coordinate that is not within 1e12 of 0"),
        "{printed}"
    );
}
