//! Bad input is a typed error that names the offending element; nothing panics.
//!
//! `InputError::TooManyPieces` alone is missing: it takes a billion points.

use ccd_core::glam::{DQuat, DVec3};
use ccd_core::limits::MAX_COORDINATE;
use ccd_core::{
    Body, Config, Facet, Hierarchy, HierarchyNode, InputError, Motion, Moving, Origin, Pieces,
    Polytope, Pose, Problem, Volume,
};

const BAD: [f64; 3] = [f64::NAN, f64::INFINITY, f64::NEG_INFINITY];

fn cube() -> Body {
    Body::cuboid(DVec3::ONE).expect("a cube")
}

#[test]
fn poses_and_motions_are_finite() {
    for bad in BAD {
        let v = DVec3::new(0.0, bad, 0.0);
        let not_finite = |result: Result<(), InputError>| {
            assert!(
                matches!(result, Err(InputError::NotFinite { .. })),
                "{result:?}"
            );
        };
        not_finite(Pose::at(v).map(drop));
        not_finite(Pose::new(DVec3::ZERO, DQuat::from_xyzw(0.0, 0.0, bad, 1.0)).map(drop));
        not_finite(Motion::new(Pose::IDENTITY, v, DVec3::ZERO).map(drop));
        not_finite(Motion::new(Pose::IDENTITY, DVec3::ZERO, v).map(drop));
        not_finite(Motion::about(Pose::IDENTITY, DVec3::ZERO, DVec3::ZERO, v).map(drop));
    }
}

#[test]
fn a_zero_quaternion_is_no_rotation() {
    for tiny in [0.0, 1e-320] {
        let pose = Pose::new(DVec3::ZERO, DQuat::from_xyzw(0.0, tiny, 0.0, 0.0));
        assert_eq!(pose, Err(InputError::ZeroQuaternion));
    }
    let long = Pose::new(DVec3::ZERO, DQuat::from_xyzw(0.0, 0.0, 0.0, 1e100)).expect("a pose");
    assert_eq!(long.rotation(), DQuat::IDENTITY);
}

#[test]
fn durations_tolerances_and_margins_have_their_range() {
    let body = cube();
    let still = Moving {
        body: &body,
        motion: Motion::still(Pose::IDENTITY),
    };
    let good = Config::default();
    let refused = |duration: f64, config: Config| {
        let error = Problem::new(still, still, duration, &config).expect_err("bad input");
        let typed = matches!(
            error,
            InputError::OutOfRange { .. } | InputError::NotFinite { .. }
        );
        assert!(typed, "{duration} {config:?}: {error:?}");
        assert!(!error.to_string().is_empty());
    };
    for bad in [-1.0, -1e-300].into_iter().chain(BAD) {
        refused(bad, good);
        refused(
            1.0,
            Config {
                tolerance: bad,
                ..good
            },
        );
        refused(
            1.0,
            Config {
                margin: bad,
                ..good
            },
        );
    }
    refused(
        1.0,
        Config {
            tolerance: 0.0,
            ..good
        },
    );
    assert!(Problem::new(still, still, 0.0, &good).is_ok());
    for duration in [0.0, -1.0].into_iter().chain(BAD) {
        let motion = Motion::between(Pose::IDENTITY, Pose::IDENTITY, DVec3::ZERO, duration);
        assert!(matches!(
            motion,
            Err(InputError::OutOfRange {
                what: "duration",
                ..
            })
        ));
    }
}

#[test]
fn velocities_that_overflow_are_refused() {
    let end = Pose::at(1e300 * DVec3::X).expect("finite");
    let motion = Motion::between(Pose::IDENTITY, end, DVec3::ZERO, 1e-100);
    assert!(
        matches!(motion, Err(InputError::NotFinite { .. })),
        "{motion:?}"
    );
}

#[test]
fn a_motion_too_fast_to_certify_ends_in_an_answer_or_an_error() {
    let body = cube();
    for speed in [1e12, 1e100, 1e300] {
        let far = Pose::at(10.0 * DVec3::X).expect("finite");
        let motion = Motion::new(far, -speed * DVec3::X, speed * DVec3::ONE).expect("finite");
        let fast = Moving {
            body: &body,
            motion,
        };
        let still = Moving {
            body: &body,
            motion: Motion::still(Pose::IDENTITY),
        };
        if let Ok(problem) = Problem::new(fast, still, 1.0, &Config::default()) {
            let answer = ccd_tests::backends::Backend::DEFAULT.solve(&problem);
            let free = matches!(answer.outcome, ccd_core::Outcome::Free { .. });
            assert!(!free, "{speed}: {answer:?}");
        }
    }
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
        assert_eq!(result, Err(InputError::BadRadius { piece: 1 }));
        assert!(Body::ball(radius).is_err() && Body::capsule(radius, 1.0).is_err());
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
    assert!(Body::cuboid(DVec3::new(1.0, f64::NAN, 1.0)).is_err());
}

#[test]
fn a_hierarchy_holds_every_piece_once() {
    use HierarchyNode::{Inner, Leaf};
    let bad = [
        vec![],
        vec![Leaf(0)],
        vec![Inner(1, 2), Leaf(0), Leaf(0)],
        vec![Inner(1, 2), Leaf(0), Leaf(2)],
        vec![Inner(1, 1), Leaf(0), Leaf(1)],
        vec![Inner(0, 1), Leaf(0), Leaf(1)],
        vec![Inner(1, 7), Leaf(0), Leaf(1)],
        vec![Inner(1, 2), Leaf(0), Leaf(1), Leaf(1)],
    ];
    for nodes in bad {
        let result = Hierarchy::new(nodes.clone(), 2).map(drop);
        assert!(
            matches!(result, Err(InputError::BadHierarchy { .. })),
            "{nodes:?}: {result:?}"
        );
    }
    let other = Hierarchy::new(vec![Leaf(0)], 1).expect("a hierarchy of one");
    let triangle = [DVec3::ZERO, DVec3::X, DVec3::Y];
    let pieces = Pieces::triangles(&triangle, &[[0, 1, 2], [0, 2, 1]], &[0, 1]).expect("good");
    let body = Body::with_hierarchy(&pieces, &other, Volume::Surface).map(drop);
    assert!(
        matches!(body, Err(InputError::BadHierarchy { .. })),
        "{body:?}"
    );
}
