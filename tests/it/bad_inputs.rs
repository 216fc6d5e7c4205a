//! Tests that invalid numbers give a typed error that names the quantity and its range, and that nothing panics.
//!
//! The tests of `ccd-core` have the other variants of `InputError`, except `TooManyPieces`: it needs a billion points.

use ccd_core::glam::DVec3;
use ccd_core::limits::MAX_COORDINATE;
use ccd_core::{Body, InputError, Motion, MovingBody, Pieces, Pose, Settings};

const NON_FINITE_NUMBERS: [f64; 3] = [f64::NAN, f64::INFINITY, f64::NEG_INFINITY];

/// Invalid times and lengths, each with its text in error messages.
const OUT_OF_RANGE_NUMBERS: [(f64, &str); 5] = [
    (-1.0, "-1"),
    (-1e-300, "-1e-300"),
    (f64::NAN, "NaN"),
    (f64::INFINITY, "inf"),
    (f64::NEG_INFINITY, "-inf"),
];

fn cube() -> Body {
    Body::cuboid(DVec3::ONE).expect("a cube")
}

#[test]
fn durations_tolerances_and_margins_have_their_range() {
    let body = cube();
    let still = MovingBody::from((&body, Motion::still(Pose::IDENTITY)));
    let good = Settings::DEFAULT;
    let refused = |duration: f64, config: Settings, message: &str| {
        let error = ccd_core::Query::new(still, still, duration, &config).expect_err("bad input");
        assert!(matches!(error, InputError::OutOfRange { .. }), "{error:?}");
        assert_eq!(error.to_string(), message);
    };
    for (bad, text) in OUT_OF_RANGE_NUMBERS {
        let message = format!("duration is {text}, but must be at least 0 and finite");
        refused(bad, good.clone(), &message);
        let config = Settings {
            tolerance: bad,
            ..good.clone()
        };
        let message = format!("tolerance is {text}, but must be from 1e-100 to 1e12");
        refused(1.0, config, &message);
        let config = Settings {
            margin: bad,
            ..good.clone()
        };
        let message = format!("margin is {text}, but must be at least 0 and at most 1e12");
        refused(1.0, config, &message);
    }
    let config = Settings {
        tolerance: 0.0,
        ..good.clone()
    };
    refused(
        1.0,
        config,
        "tolerance is 0, but must be from 1e-100 to 1e12",
    );
    assert!(ccd_core::Query::new(still, still, 0.0, &good).is_ok());
    for (duration, text) in OUT_OF_RANGE_NUMBERS.into_iter().chain([(0.0, "0")]) {
        let motion = Motion::between(Pose::IDENTITY, Pose::IDENTITY, DVec3::ZERO, duration);
        let message = format!("duration is {text}, but must be positive and finite");
        assert_eq!(motion.expect_err("no duration").to_string(), message);
    }
}

#[test]
fn motions_have_a_range() {
    let body = cube();
    let problem = |velocity: DVec3, spin: DVec3| {
        let far = Pose::at(10.0 * DVec3::X).expect("finite");
        let fast = MovingBody::from((&body, Motion::new(far, velocity, spin).expect("finite")));
        let still = MovingBody::from((&body, Motion::still(Pose::IDENTITY)));
        ccd_core::Query::new(fast, still, 1.0, &Settings::DEFAULT)
    };
    for (speed, text) in [
        (1e12, "1.00000000001e12"),
        (1e100, "1e100"),
        (1e300, "1e300"),
    ] {
        let travel = problem(-speed * DVec3::X, speed * DVec3::ONE);
        let message = format!("travel is {text}, but must be at most 1e12 from the other body");
        assert_eq!(travel.expect_err("too far").to_string(), message);
        let turn = problem(DVec3::ZERO, speed * DVec3::X);
        let message = format!("turn is {speed:e}, but must be at most 1e6 radians");
        assert_eq!(turn.expect_err("too many turns").to_string(), message);
    }
    let allowed = problem(-1e11 * DVec3::X, 1e5 * DVec3::ONE).expect("within the range");
    let answer = ccd_tests::backends::Backend::DEFAULT.solve(&allowed);
    let free = matches!(answer.outcome, ccd_core::Outcome::Free { .. });
    assert!(!free, "{answer:?}");
}

#[test]
fn faces_have_as_many_numbers() {
    let triangle = [DVec3::ZERO, DVec3::X, DVec3::Y];
    let unnumbered = Pieces::from_triangles(&triangle, &[[0, 1, 2]], &[]).map(drop);
    assert_eq!(
        unnumbered,
        Err(InputError::FaceIdCountMismatch {
            faces: 1,
            id_count: 0
        })
    );
}

/// Tests that an invalid length of a shape gives an error with the name of that length. Boxes with a negative side
/// would be inside out, and capsules would have another height.
#[test]
fn shapes_name_the_bad_length() {
    type Shape = fn(f64) -> Result<Body, InputError>;
    let shapes: [(&str, Shape); 6] = [
        ("radius", Body::sphere),
        ("radius", |bad| Body::capsule(bad, 1.0)),
        ("half height", |bad| Body::capsule(1.0, bad)),
        ("half extent x", |bad| Body::cuboid([bad, 1.0, 1.0])),
        ("half extent y", |bad| Body::cuboid([1.0, bad, 1.0])),
        ("half extent z", |bad| Body::cuboid([1.0, 1.0, bad])),
    ];
    let negative = [-1.0, -f64::MIN_POSITIVE, -5e-324, 2.0 * MAX_COORDINATE];
    for (name, shape) in shapes {
        for bad in negative.into_iter().chain(NON_FINITE_NUMBERS) {
            match shape(bad).map(drop) {
                Err(InputError::OutOfRange {
                    quantity: what,
                    value,
                    ..
                }) => {
                    assert_eq!((what, value.to_bits()), (name, bad.to_bits()));
                }
                other => panic!("{name} {bad}: {other:?}"),
            }
        }
        // A point, a disc and a rod of no width are shapes.
        for good in [0.0, -0.0, 5e-324, MAX_COORDINATE] {
            assert!(shape(good).is_ok(), "{name} {good}");
        }
    }
}
