use super::*;

fn interval(start: f64, end: f64) -> Interval {
    Interval::new(start, end)
        .expect("numbers")
        .expect("some time")
}

#[test]
fn times_are_rounded_down_and_stay_within() {
    for start in [0.0, 0.1, -7.3, 1e9, -1e-300] {
        for length in [0.0, 1e-320, 1e-17, 0.1, 3.0, 1e12] {
            let whole = interval(start, start + length);
            // The computed length is not less than the exact one.
            let exact = |after: f64| start + after;
            assert!(whole.length() >= length || exact(whole.length()) >= start + length);
            for fraction in [0.0, 0.3, 0.7, 1.0] {
                let after = fraction * length;
                let time = whole.cast_time_at_offset(after);
                assert!(
                    time >= start && time <= start + length,
                    "{start} {length} {fraction}"
                );
                assert!(
                    time <= exact(after) || time == start,
                    "{start} {length} {fraction}"
                );
            }
        }
    }
}

#[test]
fn from_zero_times_are_exact() {
    let whole = interval(0.0, f64::INFINITY);
    assert_eq!(whole.cast_time_at_offset(0.1), 0.1);
    assert_eq!(whole.length(), f64::INFINITY);
}

#[test]
fn an_end_before_the_start_leaves_no_time() {
    assert_eq!(Interval::new(1.0, 0.9), Ok(None));
    assert_eq!(Interval::new(0.0, f64::NEG_INFINITY), Ok(None));
    assert!(Interval::new(0.0, -0.0).expect("numbers").is_some());
}

#[test]
fn numbers_that_are_none_are_refused_by_name() {
    let named = |start, end| match Interval::new(start, end) {
        Err(CastError::InvalidNumber { what, .. }) => what,
        other => panic!("{other:?}"),
    };
    assert_eq!(named(f64::NAN, 1.0), "the start time");
    assert_eq!(named(f64::NEG_INFINITY, 1.0), "the start time");
    assert_eq!(named(0.0, f64::NAN), "the end time");
}
