//! Tests that scenes agree with queries on every pair.

use super::*;
use crate::answer::{HitKind, Limit};
use crate::body::{Pieces, Solidity};
use crate::trajectory::Ballistic;
use crate::{Error, Hit, Solver, StartPolicy};
use ccd_core::Trajectory;
use ccd_core::Unresolved;
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64;
use std::collections::BTreeMap;
use std::sync::Arc;
use std::sync::atomic::AtomicBool;
use std::sync::atomic::Ordering;
use std::time::Duration;

/// A body's index, its motion, whether it is fixed, and its groups.
pub(super) type SceneMember = (usize, Motion, Mobility, Groups);

/// Returns bodies of all kinds; the last one is a wide terrain.
pub(super) fn bodies(rng: &mut Pcg64) -> Vec<Body> {
    let mut bodies = vec![
        Body::sphere(0.4).unwrap(),
        Body::cuboid([0.3, 0.5, 0.2]).unwrap(),
        Body::capsule(0.1, 0.9).unwrap(),
    ];
    let mut soup = |triangles: usize, size: f64, spread: f64| {
        let mut any =
            |size: f64| DVec3::from_array(std::array::from_fn(|_| rng.random_range(-size..size)));
        let points: Vec<DVec3> = (0..triangles)
            .flat_map(|_| {
                let middle = any(spread) * DVec3::new(1.0, 1.0, 0.05);
                [(); 3].map(|()| middle + any(size))
            })
            .collect();
        let faces: Vec<[u32; 3]> = (0..triangles as u32)
            .map(|k| [3 * k, 3 * k + 1, 3 * k + 2])
            .collect();
        let ids: Vec<u32> = (0..triangles as u32).collect();
        Body::new(
            &Pieces::from_triangles(&points, &faces, &ids).unwrap(),
            Solidity::Surface,
        )
        .unwrap()
    };
    bodies.push(soup(20, 0.3, 0.4));
    bodies.push(soup(200, 0.5, 8.0));
    bodies
}

pub(super) fn parts(rng: &mut Pcg64, kinds: usize, count: usize) -> Vec<SceneMember> {
    let any = |rng: &mut Pcg64, size: f64| {
        DVec3::from_array(std::array::from_fn(|_| rng.random_range(-size..=size)))
    };
    (0..count)
        .map(|k| {
            let mobility = match k % 7 {
                0 => Mobility::Fixed,
                _ => Mobility::Moving,
            };
            let kind = if k == 0 {
                kinds - 1
            } else {
                rng.random_range(0..kinds - 1)
            };
            let pose = Pose::at(any(rng, 4.0)).unwrap();
            let speed = [0.0, 3.0, 20.0][rng.random_range(0..3)];
            let motion = match mobility {
                Mobility::Fixed => Motion::still(pose),
                Mobility::Moving => {
                    Motion::new(pose, any(rng, speed), any(rng, 0.5 * speed)).unwrap()
                }
            };
            let groups = match rng.random_range(0..5) {
                0 => Groups {
                    memberships: rng.random_range(0..4),
                    filter: rng.random_range(0..4),
                },
                _ => Groups::ALL,
            };
            (kind, motion, mobility, groups)
        })
        .collect()
}

fn scene<'a>(
    bodies: &'a [Body],
    parts: &[SceneMember],
    threads: usize,
    config: &Settings,
) -> Scene<'a> {
    let mut scene = Scene::with_threads(NonZeroUsize::new(threads).unwrap())
        .with_settings(config.clone())
        .with_filter(|a, b| (a + b) % 11 != 3);
    for &(kind, motion, mobility, groups) in parts {
        let index = match mobility {
            Mobility::Fixed => scene.add_fixed(&bodies[kind], motion.start()),
            Mobility::Moving => scene.add(&bodies[kind], motion),
        };
        scene.set_groups(index, groups);
    }
    scene
}

/// Queries every accepted pair alone, and returns the time, the indices and the result of each that is not free.
fn contacts_one_by_one(
    bodies: &[Body],
    parts: &[SceneMember],
    config: &Settings,
    duration: f64,
) -> Vec<(f64, [usize; 2], Result<Hit, Limit>)> {
    let mut solver = Solver::new().with_settings(config.clone());
    let mut found = Vec::new();
    let boxes_meet = |a: usize, b: usize| {
        let swept = |k: usize| {
            let (body, motion, ..) = parts[k];
            let moving = MovingBody::from((&bodies[body], motion));
            moving.swept_box(duration, config).unwrap()
        };
        swept(a).meets(&swept(b))
    };
    for b in 0..parts.len() {
        for a in 0..b {
            let [
                (of_a, motion_a, fixed_a, groups_a),
                (of_b, motion_b, fixed_b, groups_b),
            ] = [parts[a], parts[b]];
            let shares = |x: Groups, y: Groups| x.memberships & y.filter != 0;
            let asked = (fixed_a, fixed_b) != (Mobility::Fixed, Mobility::Fixed)
                && shares(groups_a, groups_b)
                && shares(groups_b, groups_a)
                && (a + b) % 11 != 3;
            if asked {
                let answer = solver.first_contact(
                    (&bodies[of_a], motion_a),
                    (&bodies[of_b], motion_b),
                    duration,
                );
                match answer.unwrap().hit() {
                    Ok(None) => {}
                    Ok(Some(hit)) => found.push((hit.time, [a, b], Ok(hit))),
                    // The boxes separate bodies even without a budget.
                    Err(_) if !boxes_meet(a, b) => {}
                    Err(known) => found.push((known.safe_until, [a, b], Err(known.limit))),
                }
            }
        }
    }
    found.sort_by(|x, y| x.0.total_cmp(&y.0).then(x.1.cmp(&y.1)));
    found
}

fn is_same_result(
    found: &Result<Impact, PairError>,
    expected: &(f64, [usize; 2], Result<Hit, Limit>),
) -> bool {
    let (time, bodies, what) = expected;
    match (found, what) {
        (Ok(impact), Ok(hit)) => impact.bodies == *bodies && impact.hit == *hit,
        (
            Err(PairError {
                bodies: pair,
                error:
                    Error::Unresolved(Unresolved {
                        safe_until,
                        limit: reason,
                        ..
                    }),
            }),
            Err(limit),
        ) => pair == bodies && safe_until == time && reason == limit,
        _ => false,
    }
}

#[test]
fn answers_are_those_of_all_pairs_one_by_one_on_any_number_of_threads() {
    let mut rng = Pcg64::seed_from_u64(1);
    let (mut contacts, mut starts, mut limits, mut none) = (0, 0, 0, 0);
    for round in 0..240 {
        let bodies = bodies(&mut rng);
        let parts = parts(&mut rng, bodies.len(), 2 + round % 50);
        let config = Settings {
            tolerance: 1e-4,
            margin: [0.0, 0.0, 0.2][round % 3],
            start_policy: [StartPolicy::Report, StartPolicy::Leave][round % 2],
            budget: [u64::MAX, 30][usize::from(round % 5 == 4)],
            ..Settings::DEFAULT
        };
        let duration = [1.0, 0.02, 1.0, 1.0][round % 4];
        let expected = contacts_one_by_one(&bodies, &parts, &config, duration);
        for threads in [1, 2, 5] {
            let mut scene = scene(&bodies, &parts, threads, &config);
            // The second call must not depend on the first.
            for _ in 0..2 {
                let all = scene.contacts(duration);
                assert_eq!(all.len(), expected.len(), "{round}");
                assert!(
                    all.iter()
                        .zip(&expected)
                        .all(|(found, expected)| is_same_result(found, expected)),
                    "{round}"
                );

                match (scene.first_contact(duration).transpose(), expected.first()) {
                    (Some(first), Some(expected)) => {
                        assert!(is_same_result(&first, expected), "{round}");
                    }
                    (first, expected) => assert!(first.is_none() && expected.is_none(), "{round}"),
                }

                let mut firsts = BTreeMap::new();
                for event in &expected {
                    for index in event.1 {
                        firsts.entry(index).or_insert(event);
                    }
                }
                let each = scene.first_contact_of_each(duration);
                assert_eq!(each.len(), parts.len());
                for (index, found) in each.into_iter().enumerate() {
                    match (found.transpose(), firsts.get(&index)) {
                        (Some(found), Some(expected)) => {
                            assert!(is_same_result(&found, expected), "{round} {index}");
                        }
                        (found, expected) => {
                            assert!(found.is_none() && expected.is_none(), "{round} {index}");
                            none += 1;
                        }
                    }
                }
            }
        }
        for (_, _, what) in &expected {
            match what {
                Ok(Hit {
                    kind: HitKind::Contact(_),
                    ..
                }) => contacts += 1,
                Ok(_) => starts += 1,
                Err(_) => limits += 1,
            }
        }
    }
    assert!(
        contacts > 500 && starts > 100 && limits > 10 && none > 100,
        "{contacts} {starts} {limits} {none}"
    );
}

#[test]
fn a_step_begins_where_the_last_one_ended() {
    let ball = Body::sphere(0.5).unwrap();
    let mut scene = Scene::new();
    scene.add_fixed(&ball, Pose::IDENTITY);
    let falls = |height: f64| {
        Motion::new(
            Pose::at([0.0, 0.0, height]).unwrap(),
            [0.0, 0.0, -1.0],
            [0.0; 3],
        )
        .unwrap()
    };
    let falling = scene.add(&ball, falls(3.0));
    assert!(scene.first_contact(1.0).unwrap().is_none());
    scene.set_movement(falling, falls(2.0)).unwrap();
    assert!(scene.first_contact(0.5).unwrap().is_none());
    let time = scene.first_contact(1.0).unwrap().unwrap().hit.time;
    assert!(time <= 1.0 && time > 0.998, "{time}");
    scene.clear();
    assert!(scene.is_empty() && scene.first_contact(1.0).unwrap().is_none());
    assert!(scene.first_contact_of_each(1.0).is_empty() && scene.contacts(1.0).is_empty());
}

#[test]
fn motions_out_of_range_are_errors_of_their_pairs_only() {
    let ball = Body::sphere(0.5).unwrap();
    let mut scene = Scene::new();
    let flies = |x: f64, speed: f64| {
        Motion::new(
            Pose::at([x, 0.0, 0.0]).unwrap(),
            [speed, 0.0, 0.0],
            [0.0; 3],
        )
        .unwrap()
    };
    scene.add(&ball, flies(0.0, 2.0));
    scene.add(&ball, flies(2.0, 0.0));
    let too_fast = scene.add(&ball, flies(9.0, 1e13));
    let contacts = scene.contacts(1.0);
    let (wrong, right): (Vec<_>, Vec<_>) = contacts.into_iter().partition(Result::is_err);
    assert_eq!((wrong.len(), right.len()), (2, 1));
    for error in wrong.into_iter().filter_map(Result::err) {
        assert!(
            error.bodies.contains(&too_fast) && matches!(error.error, Error::Input(_)),
            "{error}"
        );
        assert!(
            error.to_string().contains("bodies") && error.to_string().contains("travel"),
            "{error}"
        );
    }
    assert!(scene.first_contact(-1.0).is_err() && scene.first_contact(f64::NAN).is_err());
    // With a duration of 0, only the start is examined.
    assert!(scene.first_contact(0.0).unwrap().is_none());
    scene.add(&ball, flies(2.5, 0.0));
    assert_eq!(scene.first_contact(0.0).unwrap().unwrap().bodies, [1, 3]);
}

#[test]
fn durations_of_any_length_end() {
    let (ball, wall) = (
        Body::sphere(0.5).unwrap(),
        Body::cuboid([0.1, 99.0, 99.0]).unwrap(),
    );
    for duration in [5e-324, 1e-300, 1e-9, 1.0, 1e9, 1e300] {
        let mut scene = Scene::new();
        scene.add_fixed(&wall, Pose::IDENTITY);
        for k in 0..40 {
            let pose = Pose::at([-3.0, 0.0, f64::from(k) * 1.5]).unwrap();
            let velocity = [4.0 / duration, 0.0, 0.0].map(|x: f64| x.clamp(-1e300, 1e300));
            scene.add(&ball, Motion::new(pose, velocity, [0.0; 3]).unwrap());
        }
        // Velocities are finite, so that nothing meets in the shortest durations.
        let gets_there = duration > 1e-290;
        let first = scene.first_contact(duration).unwrap();
        assert_eq!(first.is_some(), gets_there, "{duration:e}");
    }
}

#[test]
fn deadlines_and_flags_end_scenes_with_safe_times() {
    let mut rng = Pcg64::seed_from_u64(3);
    let bodies = bodies(&mut rng);
    let parts = parts(&mut rng, bodies.len(), 60);
    let config = Settings {
        deadline: Some(Duration::ZERO),
        ..Settings::DEFAULT
    };
    let whole = contacts_one_by_one(&bodies, &parts, &Settings::DEFAULT, 1.0);
    let first = whole[0].0;
    for error in scene(&bodies, &parts, 2, &config)
        .contacts(1.0)
        .into_iter()
        .filter_map(Result::err)
    {
        let Error::Unresolved(Unresolved {
            safe_until,
            limit: reason,
            ..
        }) = error.error
        else {
            panic!("{error}")
        };
        assert!(
            reason == Limit::Deadline
                && whole
                    .iter()
                    .all(|(time, pair, _)| *pair != error.bodies || safe_until <= *time)
        );
    }
    let stop = Arc::new(AtomicBool::new(true));
    let settings = Settings {
        stop: Some(Arc::clone(&stop)),
        ..Settings::DEFAULT
    };
    let mut stopped = scene(&bodies, &parts, 2, &settings);
    let error = stopped.first_contact(1.0).expect_err("stopped at once");
    assert!(
        matches!(error.error, Error::Unresolved(Unresolved { safe_until, limit: Limit::Stopped, .. }) if safe_until <= first)
    );
    stop.store(false, Ordering::Relaxed);
    assert!(stopped.first_contact(1.0).is_ok());
}

/// Tests that a body inside a solid has its contact at the start, so that its event comes first.
#[test]
fn a_body_inside_a_solid_is_first() {
    let shell = crate::load("tests/data/knot216.obj").unwrap();
    let (ball, grain) = (Body::sphere(0.5).unwrap(), Body::sphere(1e-3).unwrap());
    let mut scene = Scene::with_threads(NonZeroUsize::MIN);
    // The other bodies are far from the knot, and meet soon.
    let far = |x: f64| Pose::at([x, 100.0, 0.0]).unwrap();
    scene.add_fixed(&ball, far(0.0));
    scene.add(
        &ball,
        Motion::new(far(1.01), [-9.0, 0.0, 0.0], [0.0; 3]).unwrap(),
    );
    scene.add_fixed(&shell, Pose::IDENTITY);
    let inside = point_inside_tube(&shell);
    let grain = scene.add(
        &grain,
        Motion::new(Pose::at(inside).unwrap(), [1.0, 0.0, 0.0], [0.0; 3]).unwrap(),
    );
    let first = scene.first_contact(1.0).unwrap().unwrap();
    assert_eq!((first.bodies, first.hit.time), ([2, grain], 0.0));
    assert!(matches!(first.hit.kind, HitKind::Overlapping(_)));
    assert_eq!(scene.contacts(1.0).len(), 2);
}

/// Returns a point inside a solid tube, behind one of its triangles.
fn point_inside_tube(body: &Body) -> DVec3 {
    let piece = body.pieces().get(0);
    let [a, b, c] = [0, 1, 2].map(|k| piece.points[k]);
    let outwards = (b - a).cross(c - a).normalize();
    (a + b + c) / 3.0 - 0.02 * outwards
}

/// Tests that queries end for durations from 1 to 99 times the least positive number.
#[test]
fn the_shortest_durations_end() {
    let size = 1e-20;
    let ball = Body::sphere(0.5 * size).unwrap();
    let rod = Body::cuboid([0.1 * size, 0.1 * size, 2.0 * size]).unwrap();
    let config = Settings {
        tolerance: 1e-3 * size,
        ..Settings::DEFAULT
    };
    let mut met = 0;
    for units in 1..100u64 {
        let duration = f64::from_bits(units);
        let mut scene = Scene::with_threads(NonZeroUsize::MIN).with_settings(config.clone());
        for k in 0..4 {
            let height = 3.0 * size * f64::from(k);
            let pose = |x: f64, y: f64| Pose::at([x * size, height + y * size, 0.0]).unwrap();
            let flies = |speed: f64| [speed * size / duration, 0.0, 0.0];
            scene.add(
                &ball,
                Motion::new(pose(-2.0, 0.0), flies(4.0), [0.0; 3]).unwrap(),
            );
            scene.add(
                &rod,
                Motion::new(pose(2.0, 0.4), flies(-2.0), [0.0; 3]).unwrap(),
            );
        }
        met += usize::from(scene.first_contact(duration).unwrap().is_some());
        assert_eq!(scene.first_contact_of_each(duration).len(), 8);
    }
    assert!(met > 50, "{met}");
}

/// Tests that a fixed body cannot be given a motion, because two fixed bodies are never checked against each other.
#[test]
fn a_fixed_body_takes_no_motion() {
    let ball = Body::sphere(0.5).unwrap();
    let mut scene = Scene::new();
    let fixed = scene.add_fixed(&ball, Pose::IDENTITY);
    let other = scene.add_fixed(&ball, Pose::at([3.0, 0.0, 0.0]).unwrap());
    let pose = Pose::at([0.0, 2.0, 0.0]).unwrap();
    for (velocity, spin) in [([1.0, 0.0, 0.0], [0.0; 3]), ([0.0; 3], [0.0, 0.0, 1e-300])] {
        let moves = Motion::new(pose, velocity, spin).unwrap();
        let refused = scene.set_movement(fixed, moves).unwrap_err();
        assert_eq!(refused, FixedBodyError { index: fixed });
        assert!(refused.to_string().starts_with("body 0 is fixed"));
        assert_eq!(scene.movement(fixed).as_motion(), Some(Motion::STILL));
    }
    // A motion at rest sets the pose of a body.
    scene.set_movement(other, Motion::still(pose)).unwrap();
    assert_eq!(scene.movement(other).as_motion(), Some(Motion::still(pose)));
}

/// Tests that a scene of thrown bodies and a body at rest has the same contacts as queries on each pair alone.
#[test]
fn bodies_on_trajectories_have_the_contacts_of_their_pairs() {
    let mut rng = Pcg64::seed_from_u64(8);
    let (mut contacts, mut none) = (0, 0);
    for round in 0..40 {
        let bodies = bodies(&mut rng);
        let throws: Vec<Ballistic> = (0..12).map(|_| random_throw(&mut rng)).collect();
        let settings = Settings::DEFAULT;
        let mut scene = Scene::with_threads(NonZeroUsize::MIN);
        for (k, throw) in throws.iter().enumerate() {
            scene.add(&bodies[k % 4], throw);
        }
        scene.add(&bodies[0], Motion::STILL);
        let mut expected = Vec::new();
        let mut solver = Solver::new();
        for b in 0..scene.len() {
            for a in 0..b {
                let [of_a, of_b] = [a, b].map(|k| scene.members[k].moving_body());
                let answer = solver.first_contact(of_a, of_b, 1.0).unwrap();
                match answer.hit().unwrap() {
                    Some(hit) => expected.push((hit.time, [a, b], hit)),
                    None => none += 1,
                }
                let swept = |moving: MovingBody<'_>| moving.swept_box(1.0, &settings).unwrap();
                let apart = !swept(of_a).meets(&swept(of_b));
                assert!(
                    !apart || answer.hit().unwrap().is_none(),
                    "{round}: {a} {b}"
                );
            }
        }
        expected.sort_by(|x, y| x.0.total_cmp(&y.0).then(x.1.cmp(&y.1)));
        let found = scene.contacts(1.0);
        assert_eq!(found.len(), expected.len(), "{round}");
        for (found, (_, bodies, hit)) in found.into_iter().zip(&expected) {
            let found = found.unwrap();
            assert_eq!((found.bodies, found.hit), (*bodies, *hit), "{round}");
            contacts += 1;
        }
        let first = scene.first_contact(1.0).unwrap();
        let first = first.map(|impact| impact.bodies);
        assert_eq!(first, expected.first().map(|event| event.1), "{round}");
    }
    assert!(contacts > 100 && none > 1_000, "{contacts} {none}");
}

/// Returns a random throw towards the middle of the scene, under a constant acceleration.
pub(super) fn random_throw(rng: &mut Pcg64) -> Ballistic {
    let mut any =
        |size: f64| DVec3::from_array(std::array::from_fn(|_| rng.random_range(-size..size)));
    let (place, aside) = (any(4.0), any(2.0));
    let pose = Pose::at(place).unwrap();
    let motion = Motion::new(pose, aside - place, any(2.0)).unwrap();
    Ballistic::new(motion, any(6.0)).unwrap()
}
