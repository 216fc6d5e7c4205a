//! Tests the accepted inputs of a query, and the conversion to its internal units.

use super::*;
use crate::limits::LEAST_TOLERANCE;
use crate::motion::pose::Pose;
use crate::query::MovingBody;
use crate::settings::Settings;

fn problem_tolerance(motion: Motion, duration: f64, config: &Settings) -> Result<f64, InputError> {
    let ball = Body::sphere(1.0).unwrap();
    let moving = |motion| MovingBody::from((&ball, motion));
    let still = Motion::still(Pose::IDENTITY);
    Problem::of_moving_bodies(moving(motion), moving(still), duration, config).map(|p| p.tolerance)
}

fn assert_refused(result: Result<f64, InputError>) -> &'static str {
    match result {
        Err(InputError::OutOfRange { quantity: what, .. }) => what,
        other => panic!("{other:?}"),
    }
}

#[test]
fn quantities_out_of_range_are_refused_by_name() {
    let still = Motion::still(Pose::IDENTITY);
    let config = Settings::DEFAULT;
    for bad in [-1.0, f64::NAN, f64::INFINITY] {
        assert_eq!(
            assert_refused(problem_tolerance(still, bad, &config)),
            "duration"
        );
        let margin = Settings {
            margin: bad,
            ..config.clone()
        };
        assert_eq!(
            assert_refused(problem_tolerance(still, 1.0, &margin)),
            "margin"
        );
    }
    for bad in [0.0, -1e-3, f64::NAN, f64::INFINITY] {
        let tolerance = Settings {
            tolerance: bad,
            ..config.clone()
        };
        assert_eq!(
            assert_refused(problem_tolerance(still, 1.0, &tolerance)),
            "tolerance"
        );
    }
    let new = |velocity, spin| Motion::new(Pose::IDENTITY, velocity, spin).unwrap();
    let fast = new(1e10 * DVec3::X, DVec3::ZERO);
    assert!(problem_tolerance(fast, 1.0, &config).is_ok());
    assert_eq!(
        assert_refused(problem_tolerance(fast, 1e3, &config)),
        "travel"
    );
    assert_eq!(
        assert_refused(problem_tolerance(fast, f64::MAX, &config)),
        "travel"
    );
    let turning = new(DVec3::ZERO, 1e5 * DVec3::Y);
    assert!(problem_tolerance(turning, 1.0, &config).is_ok());
    assert_eq!(
        assert_refused(problem_tolerance(turning, 11.0, &config)),
        "turn"
    );
    assert_eq!(
        assert_refused(problem_tolerance(turning, f64::MAX, &config)),
        "turn"
    );
}

#[test]
fn coordinates_are_accepted_up_to_one_limit_and_refused_beyond() {
    let config = Settings::DEFAULT;
    let pose = |at: f64| Pose::at(at * DVec3::Z).unwrap();
    let refusal = |motion| assert_refused(problem_tolerance(motion, 1.0, &config));
    let good = |motion| problem_tolerance(motion, 1.0, &config).is_ok();
    let about = |start, center| Motion::about(start, DVec3::ZERO, DVec3::Y, center).unwrap();
    for sign in [1.0, -1.0] {
        let (most, beyond) = (sign * MAX_COORDINATE, sign * 1e13);
        assert!(good(Motion::still(pose(most))));
        assert_eq!(refusal(Motion::still(pose(beyond))), "position");
        assert!(good(about(Pose::IDENTITY, most * DVec3::X)));
        assert_eq!(refusal(about(Pose::IDENTITY, beyond * DVec3::X)), "center");
        // The coordinates are also out of range if they cancel.
        let cancelled = about(pose(beyond), -beyond * DVec3::Z);
        assert_eq!(refusal(cancelled), "position");
        let between = |end| Motion::between(pose(0.0), pose(end), DVec3::ZERO, 1.0).unwrap();
        assert!(good(between(most)));
        assert_eq!(refusal(between(beyond)), "travel");
    }
    // Both positions are in range, but too far apart.
    let body = Body::sphere(1.0).unwrap();
    let still = |at: f64| MovingBody::from((&body, Motion::still(pose(at))));
    let apart = |at: f64| {
        Problem::of_moving_bodies(still(at), still(-at), 1.0, &config).map(|p| p.tolerance)
    };
    assert!(apart(0.5 * MAX_COORDINATE).is_ok());
    assert_eq!(assert_refused(apart(0.6 * MAX_COORDINATE)), "travel");
    // Bodies side by side are as exact as anywhere, whatever their position.
    let side_by_side =
        Problem::of_moving_bodies(still(1e12), still(1e12 - 4.0), 1.0, &config).unwrap();
    assert_eq!(side_by_side.tolerance, config.tolerance);
    for large in [MAX_COORDINATE, 1e13] {
        let is_good = large <= MAX_COORDINATE;
        let margin = Settings {
            margin: large,
            ..config.clone()
        };
        assert_eq!(
            problem_tolerance(Motion::still(pose(3.0)), 1.0, &margin).is_ok(),
            is_good
        );
        let tolerance = Settings {
            tolerance: large,
            ..config.clone()
        };
        assert_eq!(
            problem_tolerance(Motion::still(pose(3.0)), 1.0, &tolerance).is_ok(),
            is_good
        );
        assert_eq!(Body::sphere(large).is_ok(), is_good);
    }
}

#[test]
fn a_tolerance_that_cannot_be_certified_is_raised() {
    let near = Motion::still(Pose::at(3.0 * DVec3::X).unwrap());
    let far = Motion::still(Pose::at(3e9 * DVec3::X).unwrap());
    let fine = Settings {
        tolerance: 1e-15,
        ..Settings::DEFAULT
    };
    let (low, high) = (
        problem_tolerance(near, 1.0, &fine).unwrap(),
        problem_tolerance(far, 1.0, &fine).unwrap(),
    );
    assert!(low > 1e-15 && low < 1e-12, "{low:e}");
    assert!(high > 1e3 * low && high < 1e-3, "{high:e}");
    assert_eq!(problem_tolerance(near, 1.0, &Settings::DEFAULT), Ok(1e-3));
}

#[test]
fn clocks_are_times_that_are_never_late() {
    let ball = Body::sphere(1.0).unwrap();
    let still = MovingBody::from((&ball, Motion::still(Pose::IDENTITY)));
    for duration in [0.0, 1e-300, 0.1, 1.0, 7.0, 1e300] {
        let problem =
            Problem::of_moving_bodies(still, still, duration, &Settings::DEFAULT).unwrap();
        assert_eq!(problem.time_of_clock(0.0), 0.0);
        assert_eq!(problem.time_of_clock(1.0), duration);
        assert_eq!(problem.time_of_clock(f64::INFINITY), duration);
        let mut last = 0.0;
        for k in 1..100 {
            let s = f64::from(k) / 100.0;
            let time = problem.time_of_clock(s);
            assert!(time >= last && time <= s * duration, "{s} of {duration:e}");
            last = time;
        }
    }
}

#[test]
fn ranges_are_named_as_they_are() {
    let named = |result: Result<f64, InputError>, limit: f64| {
        let words = result.unwrap_err().to_string();
        assert!(words.contains(&format!("{limit:e}")), "{words}: {limit:e}");
    };
    let (still, config) = (Motion::STILL, Settings::DEFAULT);
    let tolerance = |tolerance| Settings {
        tolerance,
        ..config.clone()
    };
    named(
        problem_tolerance(still, 1.0, &tolerance(0.0)),
        LEAST_TOLERANCE,
    );
    named(
        problem_tolerance(still, 1.0, &tolerance(0.0)),
        MAX_COORDINATE,
    );
    let margin = Settings {
        margin: -1.0,
        ..config.clone()
    };
    named(problem_tolerance(still, 1.0, &margin), MAX_COORDINATE);
    let far = Motion::still(Pose::at([2.0 * MAX_COORDINATE, 0.0, 0.0]).unwrap());
    named(problem_tolerance(far, 1.0, &config), MAX_COORDINATE);
    let travels = Motion::new(Pose::IDENTITY, [2.0 * MAX_COORDINATE, 0.0, 0.0], [0.0; 3]);
    named(
        problem_tolerance(travels.unwrap(), 1.0, &config),
        MAX_COORDINATE,
    );
    let turns = Motion::new(
        Pose::IDENTITY,
        [0.0; 3],
        [2.0 * MAX_ROTATION_ANGLE, 0.0, 0.0],
    );
    named(
        problem_tolerance(turns.unwrap(), 1.0, &config),
        MAX_ROTATION_ANGLE,
    );
}
