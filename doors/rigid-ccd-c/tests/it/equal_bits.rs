//! Tests that answers through the interface have the same bits as in Rust.

use crate::support::{Handle, Random, default_settings, moving, ok};
use rigid_ccd::answer::ClearanceVerdict;
use rigid_ccd::trajectory::{Ballistic, Curve, OrientationCurve, PosePath, Spline};
use rigid_ccd::{
    Answer, Body, ContactNormals, Motion, Outcome, Pose, Settings, Solver, StartPolicy,
};
use rigid_ccd_c::*;
use std::ptr::null;

type Question = unsafe extern "C" fn(
    *mut RccdSolver,
    *const RccdMovingBody,
    *const RccdMovingBody,
    f64,
    *mut RccdAnswer,
) -> RccdStatus;

/// Returns the answer of the interface to a question.
fn ask(
    solver: &Handle<RccdSolver>,
    bodies: [RccdMovingBody; 2],
    duration: f64,
    question: Question,
) -> RccdAnswer {
    let mut answer = crate::support::empty_answer();
    // SAFETY: all pointers are to values that live here.
    ok(unsafe {
        question(
            solver.pointer(),
            &bodies[0],
            &bodies[1],
            duration,
            &mut answer,
        )
    });
    answer
}

fn assert_equal(c: &RccdAnswer, rust: &Answer, what: &str) {
    let bits = |number: f64| number.to_bits();
    let outcome = &rust.outcome;
    let time = outcome.time().unwrap_or(f64::NAN);
    assert_eq!(bits(c.time), bits(time), "{what}: {c:?} {rust:?}");
    assert_eq!(bits(c.lower), bits(outcome.lower()), "{what}");
    assert_eq!(bits(c.upper), bits(outcome.upper()), "{what}");
    assert_eq!(bits(c.tolerance), bits(rust.tolerance), "{what}");
    assert_eq!(c.work, rust.stats.budgeted_work(), "{what}");
    if let Some((_, contact)) = outcome.nearest_contact() {
        let seen = contact.separation;
        for (ours, theirs) in [
            (c.normal, seen.normal),
            (c.witness_a, seen.witness_a),
            (c.witness_b, seen.witness_b),
        ] {
            assert_eq!(
                ours.map(f64::to_bits),
                theirs.to_array().map(f64::to_bits),
                "{what}"
            );
        }
        assert_ne!(c.feature_a.kind, RccdFeatureKind::None);
    }
    let kind = match outcome {
        Outcome::Free { .. } => RccdOutcome::Free,
        Outcome::Contact { .. } => RccdOutcome::Contact,
        Outcome::Touching { .. } => RccdOutcome::Touching,
        Outcome::Overlapping { .. } => RccdOutcome::Overlapping,
        Outcome::Interval { .. } => RccdOutcome::Interval,
        Outcome::LeastDistance { .. } => RccdOutcome::LeastDistance,
        Outcome::Unresolved(_) => RccdOutcome::Unresolved,
    };
    assert_eq!(c.outcome, kind, "{what}");
}

#[test]
fn answers_about_motions_have_the_bits_of_rust() {
    let mut random = Random::new(1);
    let (soup, mesh) = crate::support::random_mesh(&mut random, 60);
    let rust_bodies = [
        mesh,
        Body::sphere(0.4).unwrap(),
        Body::cylinder(0.3, 0.5).unwrap(),
    ];
    let c_bodies = [
        soup,
        crate::support::sphere(0.4),
        crate::support::cylinder(0.3, 0.5),
    ];
    let settings = Settings {
        tolerance: 1e-5,
        margin: 0.01,
        start_policy: StartPolicy::Leave,
        contact_normals: ContactNormals::OfPieces,
        ..Settings::DEFAULT
    };
    let c_settings = RccdSettings {
        tolerance: 1e-5,
        margin: 0.01,
        start_policy: RccdStartPolicy::Leave as u32,
        contact_normals: RccdContactNormals::OfPieces as u32,
        ..default_settings()
    };
    let mut rust = Solver::new().with_settings(settings.clone());
    let c = crate::support::solver(Some(&c_settings));
    let mut counts = [0; 7];
    for number in 0..400 {
        let motions = [random.motion(), random.motion()];
        let rust_motions = motions.map(|motion| crate::support::to_rust(&motion));
        let [i, j] = [(); 2].map(|()| random.index(3));
        let [a, b] = [
            (&rust_bodies[i], rust_motions[0]),
            (&rust_bodies[j], rust_motions[1]),
        ];
        let bodies = [
            moving(&c_bodies[i], &motions[0]),
            moving(&c_bodies[j], &motions[1]),
        ];
        let asked: [(&str, Question, Answer); 4] = [
            (
                "first",
                rccd_first_contact,
                rust.first_contact(a, b, 1.0).unwrap(),
            ),
            (
                "any",
                rccd_any_contact,
                rust.any_contact(a, b, 1.0).unwrap(),
            ),
            (
                "interval",
                rccd_contact_interval,
                rust.contact_interval(a, b, 1.0).unwrap(),
            ),
            (
                "closest",
                rccd_closest_approach,
                rust.closest_approach(a, b, 1.0).unwrap(),
            ),
        ];
        for (name, question, answer) in asked {
            let found = ask(&c, bodies, 1.0, question);
            counts[found.outcome as usize] += 1;
            assert_equal(&found, &answer, &format!("{number} {name}"));
        }
        rust.set_settings(Settings {
            clearance: Some(0.2),
            ..settings.clone()
        });
        let answer = rust.closest_approach(a, b, 1.0).unwrap();
        rust.set_settings(settings.clone());
        let mut found = crate::support::empty_answer();
        // SAFETY: all pointers are to values that live here.
        ok(unsafe {
            rccd_keeps_clearance(c.pointer(), &bodies[0], &bodies[1], 1.0, 0.2, &mut found)
        });
        let verdict = answer.outcome.clearance_verdict(0.2);
        let is_kept = found.outcome == RccdOutcome::Free;
        assert_eq!(is_kept, verdict == ClearanceVerdict::Kept, "{number}");
        assert_eq!(found.upper.to_bits(), answer.outcome.upper().to_bits());
    }
    assert!(counts[RccdOutcome::Free as usize] > 50, "{counts:?}");
    assert!(counts[RccdOutcome::Contact as usize] > 50, "{counts:?}");
    assert!(counts[RccdOutcome::Interval as usize] > 50, "{counts:?}");
}

#[test]
fn answers_about_trajectories_have_the_bits_of_rust() {
    let mut random = Random::new(2);
    let (soup, mesh) = crate::support::random_mesh(&mut random, 30);
    let mut rust = Solver::new();
    let c = crate::support::solver(None);
    let mut hits = 0;
    for number in 0..60 {
        let [thrown, first, second] = [(); 3].map(|()| random.motion());
        let poses = [first.start, second.start];
        let pose = |pose: &RccdPose| Pose::new(pose.position, pose.rotation).unwrap();
        let falls = Ballistic::new(crate::support::to_rust(&thrown), [0.0, 0.0, -3.0]).unwrap();
        let path = PosePath::new(vec![(0.0, pose(&poses[0])), (1.0, pose(&poses[1]))]).unwrap();
        let c_falls = crate::support::thrown(&thrown, [0.0, 0.0, -3.0]);
        let c_path = crate::support::pose_path(&[0.0, 1.0], &poses);
        let along = |trajectory: &Handle<RccdTrajectory>| RccdMovingBody {
            body: soup.pointer(),
            motion: null(),
            trajectory: trajectory.pointer(),
        };
        let answer = rust
            .first_contact((&mesh, &falls), (&mesh, &path), 1.0)
            .unwrap();
        let found = ask(
            &c,
            [along(&c_falls), along(&c_path)],
            1.0,
            rccd_first_contact,
        );
        assert_equal(&found, &answer, &number.to_string());
        hits += i32::from(found.outcome == RccdOutcome::Contact);
    }
    assert!(hits > 10, "{hits}");
}

#[test]
fn motions_between_poses_have_the_bits_of_rust() {
    let mut random = Random::new(3);
    for _ in 0..100 {
        let [from, to] = [(); 2].map(|()| random.motion().start);
        let center = [0.1, -0.2, 0.3];
        let pose = |pose: &RccdPose| Pose::new(pose.position, pose.rotation).unwrap();
        let motion = Motion::between(pose(&from), pose(&to), center, 2.0).unwrap();
        let mut found = rccd_motion_at_rest();
        // SAFETY: all pointers are to values that live here.
        ok(unsafe { rccd_motion_between(&from, &to, center.as_ptr(), 2.0, &mut found) });
        assert_eq!(found.velocity, motion.velocity().to_array());
        assert_eq!(found.angular_velocity, motion.angular_velocity().to_array());
        assert_eq!(found.center, center);
    }
}

#[test]
fn answers_about_splines_have_the_bits_of_rust() {
    let mut random = Random::new(5);
    let (soup, mesh) = crate::support::random_mesh(&mut random, 30);
    let mut rust = Solver::new();
    let c = crate::support::solver(None);
    let mut hits = 0;
    for number in 0..60 {
        let points = [(); 5].map(|()| random.vector(1.5));
        let keys = [0.0, 0.4, 1.0].map(|time| (time, [(); 4].map(|()| random.number())));
        let (times, rotations) = (keys.map(|(time, _)| time), keys.map(|(_, turn)| turn));
        let turns = RccdRotations {
            times: times.as_ptr(),
            rotations: rotations.as_ptr().cast(),
            count: 3,
        };
        let is_bezier = number % 2 == 0;
        let curve = if is_bezier {
            Curve::bezier(&points, 1.0)
        } else {
            Curve::b_spline(&points, 1.0)
        };
        let orientation_curve = OrientationCurve::piecewise_slerp(&keys).unwrap();
        let spline = Spline::new(curve.unwrap(), orientation_curve);
        let make = if is_bezier {
            rccd_trajectory_bezier
        } else {
            rccd_trajectory_b_spline
        };
        // SAFETY: the counts are those of the arrays.
        let c_spline = Handle::new(rccd_trajectory_free, |out| unsafe {
            make(points.as_ptr().cast(), 5, 1.0, &turns, out)
        });
        let still = rccd_motion_at_rest();
        let along = RccdMovingBody {
            body: soup.pointer(),
            motion: null(),
            trajectory: c_spline.pointer(),
        };
        let rests = (&mesh, Motion::STILL);
        let answer = rust.first_contact((&mesh, &spline), rests, 1.0).unwrap();
        let found = ask(&c, [along, moving(&soup, &still)], 1.0, rccd_first_contact);
        assert_equal(&found, &answer, &number.to_string());
        hits += i32::from(found.outcome == RccdOutcome::Contact);
    }
    assert!(hits > 10, "{hits}");
    let no_turns = RccdRotations {
        times: null(),
        rotations: null(),
        count: 0,
    };
    let (point, mut out) = ([0.0; 3], std::ptr::null_mut());
    // SAFETY: one point; no turns.
    let refused = unsafe { rccd_trajectory_bezier(point.as_ptr(), 1, 1.0, &no_turns, &mut out) };
    assert_eq!(refused, RccdStatus::InvalidInput);
}

/// Tests that a clearance of static bodies is decided without a search, and that the distance is known.
#[test]
fn clearances_at_rest_are_kept_or_violated() {
    let (ball, rests) = (crate::support::sphere(0.5), rccd_motion_at_rest());
    let mut away = rests;
    away.start.position = [0.0, 0.0, 3.0];
    let c = crate::support::solver(None);
    for duration in [0.0, 1.0] {
        for (clearance, expected) in [(0.5, RccdOutcome::Free), (3.0, RccdOutcome::Contact)] {
            let (a, b) = (moving(&ball, &away), moving(&ball, &rests));
            let mut answer = crate::support::empty_answer();
            // SAFETY: all pointers are to values that live here.
            ok(unsafe {
                rccd_keeps_clearance(c.pointer(), &a, &b, duration, clearance, &mut answer)
            });
            assert_eq!(
                answer.outcome, expected,
                "{duration} {clearance}: {answer:?}"
            );
        }
    }
}
