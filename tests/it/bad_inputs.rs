//! Invalid input is a typed error that names the offending element; nothing panics.
//!
//! `InputError::TooManyPieces` alone is missing: it needs a billion points.

use ccd_core::glam::{DQuat, DVec3};
use ccd_core::limits::MAX_COORDINATE;
use ccd_core::{
    Body, Face, Facet, Hierarchy, HierarchyNode, InputError, Motion, Moving, Origin, Pieces,
    Polytope, Pose, Settings, Volume,
};

const BAD: [f64; 3] = [f64::NAN, f64::INFINITY, f64::NEG_INFINITY];

/// Invalid times and lengths, with their text in messages.
const OUT_OF_RANGE: [(f64, &str); 5] = [
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
fn poses_and_motions_are_finite() {
    for bad in BAD {
        let v = DVec3::new(0.0, bad, 0.0);
        let turned = DQuat::from_xyzw(0.0, 0.0, bad, 1.0);
        let zero = DVec3::ZERO;
        for (what, pose) in [
            ("position", Pose::at(v)),
            ("quaternion", Pose::new(zero, turned)),
        ] {
            assert_eq!(pose, Err(InputError::NotFinite { what }));
        }
        for (what, motion) in [
            ("velocity", Motion::new(Pose::IDENTITY, v, zero)),
            ("angular velocity", Motion::new(Pose::IDENTITY, zero, v)),
            ("centre", Motion::about(Pose::IDENTITY, zero, zero, v)),
        ] {
            assert_eq!(motion, Err(InputError::NotFinite { what }));
        }
    }
}

#[test]
fn a_zero_quaternion_is_refused() {
    let zero = Pose::new(DVec3::ZERO, DQuat::from_xyzw(0.0, -0.0, 0.0, 0.0));
    assert_eq!(zero, Err(InputError::ZeroQuaternion));
    for length in [1e-320, 1e-170, 1e100, 1e300] {
        let long = Pose::new(DVec3::ZERO, [0.0, 0.0, 0.0, length]).expect("a pose");
        assert_eq!(long.rotation(), DQuat::IDENTITY);
    }
}

#[test]
fn durations_tolerances_and_margins_have_their_range() {
    let body = cube();
    let still = Moving::from((&body, Motion::still(Pose::IDENTITY)));
    let good = Settings::DEFAULT;
    let refused = |duration: f64, config: Settings, message: &str| {
        let error = ccd_core::Query::new(still, still, duration, &config).expect_err("bad input");
        assert!(matches!(error, InputError::OutOfRange { .. }), "{error:?}");
        assert_eq!(error.to_string(), message);
    };
    for (bad, text) in OUT_OF_RANGE {
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
    for (duration, text) in OUT_OF_RANGE.into_iter().chain([(0.0, "0")]) {
        let motion = Motion::between(Pose::IDENTITY, Pose::IDENTITY, DVec3::ZERO, duration);
        let message = format!("duration is {text}, but must be positive and finite");
        assert_eq!(motion.expect_err("no duration").to_string(), message);
    }
}

#[test]
fn velocities_that_overflow_are_refused() {
    let end = Pose::at(1e300 * DVec3::X).expect("finite");
    let motion = Motion::between(Pose::IDENTITY, end, DVec3::ZERO, 1e-100);
    assert_eq!(motion, Err(InputError::NotFinite { what: "velocity" }));
}

#[test]
fn motions_have_a_range() {
    let body = cube();
    let problem = |velocity: DVec3, spin: DVec3| {
        let far = Pose::at(10.0 * DVec3::X).expect("finite");
        let fast = Moving::from((&body, Motion::new(far, velocity, spin).expect("finite")));
        let still = Moving::from((&body, Motion::still(Pose::IDENTITY)));
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
fn pieces_name_their_bad_element() {
    let triangle = [DVec3::ZERO, DVec3::X, DVec3::Y];
    let none = Pieces::triangles(&triangle, &[], &[]).map(drop);
    assert_eq!(none, Err(InputError::NoPieces));
    let missing = Pieces::triangles(&triangle, &[[0, 1, 2], [0, 1, 3]], &[0, 1]).map(drop);
    let expected = InputError::VertexOutOfRange {
        face: 1,
        vertex: 3,
        vertices: 3,
    };
    assert_eq!(missing, Err(expected));
    let unnumbered = Pieces::triangles(&triangle, &[[0, 1, 2]], &[]).map(drop);
    assert_eq!(unnumbered, Err(InputError::FaceIds { faces: 1, ids: 0 }));
    for bad in [2.0 * MAX_COORDINATE, -2.0 * MAX_COORDINATE]
        .into_iter()
        .chain(BAD)
    {
        let mut broken = triangle;
        broken[2].z = bad;
        let result = Pieces::triangles(&broken, &[[0, 0, 1], [0, 1, 2]], &[0, 1]).map(drop);
        assert_eq!(result, Err(InputError::BadPoint { piece: 1, point: 2 }));
    }
}

#[test]
fn polytopes_name_their_bad_element() {
    let good = Polytope {
        points: vec![DVec3::ZERO, DVec3::X, DVec3::Y],
        ..Polytope::default()
    };
    let second = |bad: Polytope| Pieces::polytopes(&[good.clone(), bad]).map(drop);
    assert_eq!(Pieces::polytopes(&[]).map(drop), Err(InputError::NoPieces));
    assert_eq!(
        second(Polytope::default()),
        Err(InputError::EmptyPiece { piece: 1 })
    );
    for radius in [-1.0, 2.0 * MAX_COORDINATE].into_iter().chain(BAD) {
        let result = second(Polytope {
            radius,
            ..good.clone()
        });
        assert!(matches!(
            result,
            Err(InputError::BadRadius { piece: 1, .. })
        ));
    }
    for corners in [vec![0, 1], vec![], vec![0, 1, 3]] {
        let facets = vec![Facet {
            origin: Origin::Face(0),
            corners,
        }];
        let result = second(Polytope {
            facets,
            ..good.clone()
        });
        assert_eq!(
            result,
            Err(InputError::FacetOutOfRange { piece: 1, facet: 0 })
        );
    }
    for bad in BAD {
        let face = Face {
            id: 0,
            vertices: [0, 1, 2],
            corners: [DVec3::ZERO, bad * DVec3::X, DVec3::Y],
        };
        let result = second(Polytope {
            faces: vec![face],
            ..good.clone()
        });
        assert_eq!(result, Err(InputError::BadFace { piece: 1, face: 0 }));
    }
}

/// Boxes with a negative side would be inside out, and capsules would have another height.
#[test]
fn shapes_name_the_bad_length() {
    type Shape = fn(f64) -> Result<Body, InputError>;
    let shapes: [(&str, Shape); 6] = [
        ("radius", Body::ball),
        ("radius", |bad| Body::capsule(bad, 1.0)),
        ("half height", |bad| Body::capsule(1.0, bad)),
        ("half extent x", |bad| Body::cuboid([bad, 1.0, 1.0])),
        ("half extent y", |bad| Body::cuboid([1.0, bad, 1.0])),
        ("half extent z", |bad| Body::cuboid([1.0, 1.0, bad])),
    ];
    let negative = [-1.0, -f64::MIN_POSITIVE, -5e-324, 2.0 * MAX_COORDINATE];
    for (name, shape) in shapes {
        for bad in negative.into_iter().chain(BAD) {
            match shape(bad).map(drop) {
                Err(InputError::OutOfRange { what, value, .. }) => {
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

#[test]
fn a_surface_is_a_solid_of_triangles_for_one_piece() {
    let ball = Body::ball(1.0).expect("a ball");
    for (body, surface) in [(cube(), cube()), (ball.clone(), cube()), (cube(), ball)] {
        let result = body.with_surface(surface).map(drop);
        assert_eq!(result, Err(InputError::BadSurface));
    }
}

#[test]
fn a_hierarchy_holds_every_piece_once() {
    use HierarchyNode::{Inner, Leaf};
    let bad = [
        (vec![], 0),
        (vec![Leaf(0)], 1),
        (vec![Inner(1, 2), Leaf(0), Leaf(0)], 0),
        (vec![Inner(1, 2), Leaf(0), Leaf(2)], 2),
        (vec![Inner(1, 1), Leaf(0), Leaf(1)], 1),
        (vec![Inner(0, 1), Leaf(0), Leaf(1)], 0),
        (vec![Inner(1, 7), Leaf(0), Leaf(1)], 7),
        (vec![Inner(1, 2), Leaf(0), Leaf(1), Leaf(1)], 3),
    ];
    for (nodes, at) in bad {
        let result = Hierarchy::new(nodes.clone(), 2).map(drop);
        assert_eq!(result, Err(InputError::BadHierarchy { at }), "{nodes:?}");
    }
    let other = Hierarchy::new(vec![Leaf(0)], 1).expect("a hierarchy of one");
    let triangle = [DVec3::ZERO, DVec3::X, DVec3::Y];
    let pieces = Pieces::triangles(&triangle, &[[0, 1, 2], [0, 2, 1]], &[0, 1]).expect("good");
    let body = Body::with_hierarchy(&pieces, &other, Volume::Surface).map(drop);
    assert_eq!(body, Err(InputError::BadHierarchy { at: 1 }));
}
