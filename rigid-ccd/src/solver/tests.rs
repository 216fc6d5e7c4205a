use crate::trajectory::{Ballistic, Curve, OrientationCurve, PosePath, Spline};
use crate::{Body, Motion, Pose, Question, Settings, Solver};
use ccd_core::ClearanceVerdict;
use ccd_core::MovingBody;
use ccd_core::Outcome;
use ccd_core::Unresolved;
use ccd_core::glam::{DQuat, DVec3};

mod enclosures;

fn ball(radius: f64) -> Body {
    Body::sphere(radius).unwrap()
}

fn ballistic_trajectory(at: [f64; 3], velocity: [f64; 3], acceleration: [f64; 3]) -> Ballistic {
    let thrown = Motion::new(Pose::at(at).unwrap(), velocity, [0.0; 3]).unwrap();
    Ballistic::new(thrown, acceleration).unwrap()
}

/// Tests an accelerated ball that starts 0.0001 above a slab: it is reported as touching, not as overlapping.
#[test]
fn bodies_beside_each_other_do_not_overlap() {
    let (ball, slab) = (ball(0.5), Body::cuboid([9.0, 9.0, 1.0]).unwrap());
    let rises = ballistic_trajectory([0.0, 0.0, 1.5001], [0.0; 3], [0.0, 0.0, 1e-3]);
    let (a, b) = ((&ball, &rises), (&slab, &Motion::STILL));
    let closest = Solver::new().closest_approach(a, b, 1.0).unwrap();
    let Outcome::LeastDistance { lower, .. } = closest.outcome else {
        panic!("{closest:?}")
    };
    assert!(lower <= 1e-4 && closest.outcome.upper() >= 1e-4);
    assert_ne!(
        closest.outcome.clearance_verdict(5e-5),
        ClearanceVerdict::Violated
    );
    let hit = Solver::new().first_contact(a, b, 1.0).unwrap();
    assert!(matches!(hit.outcome, Outcome::Touching { .. }), "{hit:?}");
    let deep = ballistic_trajectory([0.0, 0.0, 1.4], [0.0; 3], [0.0, 0.0, 1e-3]);
    let any = Solver::new().any_contact((&ball, &deep), b, 1.0);
    let any = any.unwrap().outcome;
    assert!(matches!(any, Outcome::Overlapping { .. }), "{any:?}");
}

/// Tests that a body that starts inside a solid is never reported as free: the first contact is at time 0, and
/// `any_contact` finds a contact or is undecided.
#[cfg(feature = "meshes")]
#[test]
fn a_body_that_begins_inside_is_never_said_to_be_outside() {
    use ccd_decomp::{PieceChoice, TriangleMesh, body_from_mesh};
    let vertices = [
        [3.0; 3],
        [3.0, -3.0, -3.0],
        [-3.0, 3.0, -3.0],
        [-3.0, -3.0, 3.0],
    ];
    let faces = [[0, 1, 2], [0, 3, 1], [0, 2, 3], [1, 3, 2]];
    let mesh = TriangleMesh::new(vertices.map(DVec3::from_array).to_vec(), &faces).unwrap();
    for radius in [0.0, 0.05] {
        for choice in [PieceChoice::Triangles, PieceChoice::Auto] {
            let solid = body_from_mesh(&mesh, choice).unwrap().body;
            let flies = ballistic_trajectory([0.0; 3], [2.0, 0.6, 0.4], [8.0, -8.0, 0.0]);
            let (ball, still) = (ball(radius), Motion::STILL);
            let (a, b) = ((&ball, &flies), (&solid, &still));
            let any = Solver::new().any_contact(a, b, 1.0).unwrap().outcome;
            match any {
                Outcome::Contact { .. } | Outcome::Overlapping { .. } => {}
                Outcome::Unresolved(Unresolved {
                    safe_until,
                    limit: reason,
                    ..
                }) => {
                    assert_eq!(
                        (safe_until, reason),
                        (0.0, crate::answer::Limit::OverlapUndecided)
                    );
                }
                _ => panic!("{any:?}"),
            }
            let first = Solver::new().first_contact(a, b, 1.0).unwrap();
            assert_eq!(first.hit().unwrap().unwrap().time, 0.0);
        }
    }
}

/// Tests that a path and a motion choose the same direction for a rotation by half a turn.
#[test]
fn half_turns_go_the_way_of_motions() {
    let turns: [f64; 4] = [
        0.737_161_821_595_896_7,
        -0.660_750_235_249_299_2,
        -0.141_426_926_005_675_97,
        0.0,
    ];
    let end = Pose::new([0.0; 3], DQuat::from_array(turns)).unwrap();
    let motion = Motion::between(Pose::IDENTITY, end, [0.0; 3], 1.0).unwrap();
    let path = PosePath::new(vec![(0.0, Pose::IDENTITY), (1.0, end)]).unwrap();
    // A rod along z, whose tip meets a ball on its way.
    let rod = Body::capsule(0.02, 1.0).unwrap();
    let meets = motion.pose(0.5).transform_point(DVec3::Z);
    let stands = Motion::still(Pose::at(meets).unwrap());
    let ball = ball(0.1);
    let mut solver = Solver::new();
    assert!(
        !solver
            .is_free((&rod, motion), (&ball, stands), 1.0)
            .unwrap()
    );
    assert!(
        !solver
            .is_free((&rod, &path), (&ball, &stands), 1.0)
            .unwrap()
    );
}

#[test]
fn settings_at_their_limits_are_answered() {
    let (a, b) = (ball(0.5), ball(0.5));
    let passes = ballistic_trajectory([-3.0, 1.3, 0.0], [6.0, 0.0, 0.0], [0.0, 1e-3, 0.0]);
    let least = Settings {
        tolerance: ccd_core::limits::LEAST_TOLERANCE,
        ..Settings::DEFAULT
    };
    let mut solver = Solver::new().with_settings(least);
    assert!(
        solver
            .is_free((&a, &passes), (&b, &Motion::STILL), 1.0)
            .unwrap()
    );
    let wide = Settings {
        margin: 1e12,
        ..Settings::DEFAULT
    };
    solver.set_settings(wide);
    let closest = solver.closest_approach((&a, &passes), (&b, &Motion::STILL), 1.0);
    let closest = closest.unwrap().outcome;
    assert!(
        closest.lower() > 0.29 && closest.upper() - closest.lower() <= 1e-3,
        "{closest:?}"
    );
}

#[test]
fn queries_after_the_end_of_a_trajectory_are_answered() {
    let (a, b) = (ball(0.5), ball(0.5));
    let points = [[1e11, 1.3, 0.0], [1e11 - 1.0, 1.3, 0.0]];
    let stops = Spline::new(Curve::bezier(&points, 1.0).unwrap(), OrientationCurve::NONE);
    let stands = Motion::still(Pose::at([1e11, 0.0, 0.0]).unwrap());
    let hit = Solver::new().first_contact((&a, &stops), (&b, &stands), 2.0);
    assert_eq!(hit.unwrap().hit(), Ok(None));
    let rests = points.map(|at| Pose::at(at).unwrap());
    let rests = PosePath::new(vec![(0.0, rests[0]), (1.0, rests[1])]).unwrap();
    let hit = Solver::new().first_contact((&a, &rests), (&b, &stands), 2.0);
    assert_eq!(hit.unwrap().hit(), Ok(None));
}

/// Tests that a ball hits a cylinder and a cone from all sides no later than it would hit the true shapes. The contact
/// is earlier by at most the excess and the tolerance.
#[test]
fn round_bodies_are_touched_when_the_true_shapes_are() {
    let (radius, half_height, ball_radius) = (1.5, 2.0, 0.25);
    let ball = ball(ball_radius);
    let config = Settings {
        tolerance: 1e-9,
        ..Settings::DEFAULT
    };
    let mut solver = Solver::new().with_settings(config);
    // The slant of the cone, and the part of it that is across the axis.
    let slant = f64::hypot(2.0 * half_height, radius);
    let across = 2.0 * half_height / slant;
    for k in 0..60 {
        let (sine, cosine) = (0.1047 * f64::from(k)).sin_cos();
        let height = 0.1 * f64::from(k % 7);
        let start = Pose::at([8.0 * cosine, 8.0 * sine, height]).unwrap();
        let flies = Motion::new(start, [-cosine, -sine, 0.0], [0.0; 3]).unwrap();
        let of_cone = (ball_radius * slant + radius * (half_height - height)) / (2.0 * half_height);
        for (body, reach, share) in [
            (
                Body::cylinder(radius, half_height),
                radius + ball_radius,
                1.0,
            ),
            (Body::cone(radius, half_height), of_cone, across),
        ] {
            let body = body.unwrap();
            let hit = solver.first_contact((&ball, flies), (&body, Motion::STILL), 10.0);
            let time = hit.unwrap().hit().unwrap().expect("it flies at it").time;
            let early = (8.0 - reach) - time;
            let most = (radius / 4096.0 + 1e-9) / share;
            assert!(
                (-1e-14..=most).contains(&early),
                "{k}: early by {early:e} of {most:e}"
            );
        }
    }
}

/// Tests that a distance is that at the start, whatever moves the bodies, and not the least one of the motion.
#[test]
fn a_distance_is_that_at_the_start() {
    let ball = ball(0.5);
    let (start, velocity) = ([-3.0, 0.0, 0.0], [6.0, 0.0, 0.0]);
    let flies = Motion::new(Pose::at(start).unwrap(), velocity, [0.0; 3]).unwrap();
    let thrown = ballistic_trajectory(start, velocity, [0.0, 0.0, -1.0]);
    let mut solver = Solver::new();
    let mut measure = |question, moving: MovingBody<'_>| {
        let answer = solver.answer(question, moving, (&ball, Motion::STILL), 1.0);
        let outcome = answer.unwrap().outcome;
        [outcome.lower(), outcome.upper()]
    };
    for moving in [(&ball, flies).into(), (&ball, &thrown).into()] {
        let [lower, upper] = measure(Question::Distance, moving);
        assert!(
            lower <= 2.0 && 2.0 <= upper && upper - lower < 1e-3,
            "{lower} {upper}"
        );
        let [_, upper] = measure(Question::ClosestApproach, moving);
        assert!(upper < 0.5, "{upper}");
    }
}

#[test]
fn questions_are_found_by_their_names() {
    for question in Question::ALL {
        assert_eq!(Question::from_name(question.name()), Some(question));
    }
    assert_eq!(Question::from_name("any-contact"), None);
}
