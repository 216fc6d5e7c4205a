use super::*;

#[test]
fn numbers_of_many_places_are_told_by_a_power_of_ten() {
    for (value, told) in [
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
            what: "margin",
            value,
            allowed: "small",
        };
        let expected = format!("margin is {told}, but must be small");
        assert_eq!(error.to_string(), expected);
    }
}

#[test]
fn what_is_too_large_is_told_with_the_range() {
    let radius = InputError::BadRadius { piece: 3 };
    assert_eq!(
        radius.to_string(),
        "the radius of piece 3 is not from 0 to 1e12"
    );
    let point = InputError::BadPoint { piece: 3, point: 4 };
    let told = point.to_string();
    assert!(
        told.ends_with("a coordinate that is not within 1e12 of 0"),
        "{told}"
    );
}
