//! Tests at sampled times that bodies that stop never overlap other bodies, and that no body stops too early.

use super::super::tests::{bodies, parts};
use super::*;
use crate::answer::HitKind;
use crate::scene::tests::random_throw;
use crate::trajectory::Ballistic;
use crate::{Body, Pose, Solver};
use ccd_core::Outcome;
use ccd_core::glam::DVec3;
use ccd_core::order::lesser;
use ccd_core::{Settings, Stretch, Trajectory};
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64;
use std::collections::HashSet;
use std::num::NonZeroUsize;

/// Returns the poses of all bodies at a time; a stopped body has the pose at which it stopped.
fn poses(scene: &Scene<'_>, stops: &[Stop], time: f64) -> Vec<Pose> {
    let pose = |(member, stop): (&super::super::SceneBody<'_>, &Stop)| {
        member.movement.pose(lesser(time, stop.time)).unwrap()
    };
    scene.members.iter().zip(stops).map(pose).collect()
}

/// Returns the pairs of bodies that overlap at the given poses.
fn find_overlapping_pairs(
    scene: &Scene<'_>,
    poses: &[Pose],
    solver: &mut Solver,
) -> HashSet<[usize; 2]> {
    let mut pairs = HashSet::new();
    for b in 0..poses.len() {
        for a in 0..b {
            let still = |k: usize| (scene.members[k].body, Motion::still(poses[k]));
            let hit = solver.first_contact(still(a), still(b), 0.0).unwrap();
            let overlaps = matches!(hit.outcome, Outcome::Overlapping { .. });
            if overlaps {
                pairs.insert([a, b]);
            }
        }
    }
    pairs
}

#[test]
fn bodies_that_stop_never_overlap() {
    let mut rng = Pcg64::seed_from_u64(5);
    let mut solver = Solver::new();
    let (mut stopped, mut moving, mut crossed, mut again) = (0, 0, 0, 0);
    for round in 0..120 {
        let bodies = bodies(&mut rng);
        let parts = parts(&mut rng, bodies.len(), 2 + round % 24);
        let config = Settings {
            margin: [0.0, 0.0, 0.05][round % 3],
            ..Settings::DEFAULT
        };
        let mut scene = Scene::with_threads(NonZeroUsize::MIN).with_settings(config.clone());
        for &(kind, motion, mobility, _) in &parts {
            match mobility {
                Mobility::Fixed => scene.add_fixed(&bodies[kind], motion.start()),
                Mobility::Moving => scene.add(&bodies[kind], motion),
            };
        }
        let stops = scene.find_stops(1.0).unwrap();
        let free = vec![
            Stop {
                time: 1.0,
                stopped_by: None,
                contact: None,
            };
            scene.len()
        ];
        let at_start = find_overlapping_pairs(&scene, &poses(&scene, &free, 0.0), &mut solver);
        let mut through = HashSet::new();
        for step in 0..=40 {
            let time = f64::from(step) / 40.0;
            let now = find_overlapping_pairs(&scene, &poses(&scene, &stops, time), &mut solver);
            assert!(
                now.is_subset(&at_start),
                "{round} {time} {now:?} {at_start:?}"
            );
            through.extend(find_overlapping_pairs(
                &scene,
                &poses(&scene, &free, time),
                &mut solver,
            ));
        }
        crossed += through.difference(&at_start).count();
        // Each body is near the body that stops it, at their poses then.
        for (index, stop) in stops.iter().enumerate() {
            let Some(by) = stop.stopped_by else {
                moving += 1;
                assert_eq!(stop.time, 1.0);
                continue;
            };
            stopped += 1;
            again += usize::from(stops[by].time < stop.time);
            let poses = poses(&scene, &stops, stop.time);
            check_stop_contact(&scene, index, stop, config.margin + config.tolerance);
            let still = |k: usize| (scene.members[k].body, Motion::still(poses[k]));
            // A query of zero duration may ignore half of its tolerance.
            let near = Settings {
                tolerance: 2.2 * config.tolerance,
                ..config.clone()
            };
            let mut solver = Solver::new().with_settings(near);
            let hit = solver.first_contact(still(index), still(by), 0.0);
            assert!(
                hit.unwrap().hit().unwrap().is_some(),
                "{round}: {index} is not near {by}"
            );
        }
    }
    assert!(
        stopped > 100 && moving > 100 && crossed > 50 && again > 5,
        "{stopped} {moving} {crossed} {again}"
    );
}

/// Checks that a stop's contact is with the body `stop.by`, and not before the time of the stop. At the contact the
/// witnesses are at most `reach` apart, along the normal.
fn check_stop_contact(scene: &Scene<'_>, index: usize, stop: &Stop, reach: f64) {
    let by = stop.stopped_by.unwrap();
    let Impact { bodies, hit } = stop.contact.expect("no limit was reached");
    assert_eq!(bodies, super::super::pairs::in_ascending_order(index, by));
    assert!(hit.time >= stop.time && hit.time <= 1.0, "{hit:?} {stop:?}");
    let way = if bodies[0] == index {
        hit.witness_b() - hit.witness_a()
    } else {
        hit.witness_a() - hit.witness_b()
    };
    assert!(way.length() <= reach, "{way}");
    let normal = stop.normal().expect("nothing overlaps");
    let rounding = 1e-12 * (1.0 + hit.witness_a().length());
    assert!(
        normal.dot(way) >= way.length() - rounding - 1e-3 * reach,
        "{normal} {way}"
    );
    let span = scene.members[index].body.bounding_radius();
    let mine = if bodies[0] == index {
        hit.witness_a()
    } else {
        hit.witness_b()
    };
    let center = scene.members[index]
        .movement
        .pose(hit.time)
        .unwrap()
        .translation();
    assert!(mine.distance(center) <= span * (1.0 + 1e-12) + rounding);
}

#[test]
fn a_normal_is_from_the_body_to_what_stops_it() {
    let (ball, plate) = (
        Body::sphere(0.5).unwrap(),
        Body::cuboid([5.0, 5.0, 1.0]).unwrap(),
    );
    let falls = Motion::new(
        Pose::at([0.0, 0.0, 2.0]).unwrap(),
        [0.0, 0.0, -3.0],
        [0.0; 3],
    )
    .unwrap();
    let below = Pose::at([0.0, 0.0, -1.0]).unwrap();
    // The order of addition does not matter.
    let mut scene = Scene::new();
    scene.add_fixed(&plate, below);
    let second = scene.add(&ball, falls);
    let stop = scene.find_stops(1.0).unwrap()[second];
    assert!(stop.normal().unwrap().distance(-DVec3::Z) < 1e-12);
    let mut scene = Scene::new();
    let first = scene.add(&ball, falls);
    scene.add_fixed(&plate, below);
    let stops = scene.find_stops(1.0).unwrap();
    assert!(stops[first].normal().unwrap().distance(-DVec3::Z) < 1e-12);
    assert_eq!(stops[first].contact.unwrap().hit.time, stops[first].time);
    // A body without a stop has no contact, nor has one that a limit stops.
    assert_eq!(
        (stops[1].stopped_by, stops[1].contact, stops[1].normal()),
        (None, None, None)
    );
    let spent = Settings {
        budget: 0,
        ..Settings::DEFAULT
    };
    let stop = scene.with_settings(spent).find_stops(1.0).unwrap()[first];
    assert_eq!((stop.stopped_by, stop.contact), (Some(1), None));
}

/// Tests balls in a row that fly at a wall: the wall stops the first ball, and each ball stops the next one.
#[test]
fn a_queue_of_balls_stops_one_behind_the_other() {
    let (ball, wall) = (
        Body::sphere(0.5).unwrap(),
        Body::cuboid([0.1, 5.0, 5.0]).unwrap(),
    );
    let mut scene = Scene::new();
    scene.add_fixed(&wall, Pose::at([10.0, 0.0, 0.0]).unwrap());
    for k in 0..5 {
        let pose = Pose::at([8.0 - 2.0 * f64::from(k), 0.0, 0.0]).unwrap();
        scene.add(
            &ball,
            Motion::new(pose, [20.0, 0.0, 0.0], [0.0; 3]).unwrap(),
        );
    }
    let stops = scene.find_stops(1.0).unwrap();
    for (k, stop) in stops.iter().enumerate().skip(1) {
        assert_eq!(stop.stopped_by, Some(k - 1));
        let place = scene.members[k]
            .movement
            .pose(stop.time)
            .unwrap()
            .translation()
            .x;
        let expected = 9.4 - (k as f64 - 1.0);
        assert!(
            place <= expected && place > expected - 0.001 * k as f64 - 1e-9,
            "{place}"
        );
    }
}

/// Tests that a ball pressed onto a floor never rises, and never sinks below the floor, over 200 steps.
#[test]
fn a_pressed_ball_stays_above_the_floor() {
    let (ball, floor) = (
        Body::sphere(0.5).unwrap(),
        Body::cuboid([5.0, 5.0, 0.1]).unwrap(),
    );
    let mut scene = Scene::new();
    scene.add_fixed(&floor, Pose::at([0.0, 0.0, -0.1]).unwrap());
    let pressed = |height: f64, x: f64| {
        Motion::new(
            Pose::at([x, 0.0, height]).unwrap(),
            [1.0, 0.0, -3.0],
            [0.0; 3],
        )
        .unwrap()
    };
    let (mut height, mut x) = (0.6, 0.0);
    let ball = scene.add(&ball, pressed(height, x));
    for step in 0..200 {
        let motion = pressed(height, x);
        scene.set_movement(ball, motion).unwrap();
        let stop = scene.find_stops(0.01).unwrap()[ball];
        let place = motion.pose(stop.time).translation();
        assert!(
            place.z > 0.5 - 1e-13 && place.z <= height,
            "{step} {:e}",
            place.z - 0.5
        );
        (height, x) = (place.z, place.x);
    }
    assert!(height < 0.501, "{:e}", height - 0.5);
}

#[test]
fn motions_out_of_range_are_errors_and_unresolved_bodies_stop() {
    let ball = Body::sphere(0.5).unwrap();
    let knot = Body::cuboid([0.5, 0.5, 0.5]).unwrap();
    let mut scene = Scene::new().with_settings(Settings {
        budget: 0,
        ..Settings::DEFAULT
    });
    scene.add_fixed(&knot, Pose::IDENTITY);
    let flies = Motion::new(
        Pose::at([-3.0, 0.0, 0.0]).unwrap(),
        [4.0, 0.0, 0.0],
        [0.0; 3],
    )
    .unwrap();
    let flying = scene.add(&ball, flies);
    // Without a budget nothing is proven free.
    let stop = scene.find_stops(1.0).unwrap()[flying];
    assert!(stop.stopped_by == Some(0) && stop.time <= 0.5);
    assert!(scene.find_stops(-1.0).is_err());
    // The start policy of other questions is unchanged.
    let mut scene = scene.with_settings(Settings::DEFAULT);
    let rests = Motion::still(Pose::at([1.0, 0.0, 0.0]).unwrap());
    scene.set_movement(flying, rests).unwrap();
    scene.find_stops(1.0).unwrap();
    let first = scene.first_contact(1.0).unwrap().unwrap();
    assert!(matches!(first.hit.kind, HitKind::Touching(_)), "{first:?}");
}

/// Tests that a ball pressed onto a wide floor keeps 0.4 times the tolerance over 1,000 steps. Rounding errors of
/// distances are large there, and the ball could sink by one of them in each step.
#[test]
fn a_pressed_ball_does_not_sink_by_rounding() {
    let mut rng = Pcg64::seed_from_u64(7);
    let mut any = move || DVec3::from_array(std::array::from_fn(|_| rng.random_range(-1.0..1.0)));
    let ball = Body::sphere(0.5).unwrap();
    for (half, tolerance) in [(5.0, 1e-10), (1e3, 1e-7), (1e4, 1e-6), (1e7, 1e-3)] {
        let floor = Body::cuboid([half, half, 1.0]).unwrap();
        let config = Settings {
            tolerance,
            ..Settings::DEFAULT
        };
        let mut scene = Scene::with_threads(NonZeroUsize::MIN).with_settings(config.clone());
        scene.add_fixed(&floor, Pose::at([0.0, 0.0, -1.0]).unwrap());
        let mut pose = Pose::at([0.3, 0.1, 0.51]).unwrap();
        let index = scene.add(&ball, Motion::still(pose));
        for step in 0..1_000 {
            let way = any();
            let motion = Motion::new(pose, [way.x, way.y, -0.5], any()).unwrap();
            scene.set_movement(index, motion).unwrap();
            pose = motion.pose(scene.find_stops(1.0 / 60.0).unwrap()[index].time);
            let gap = pose.translation().z - 0.5;
            assert!(
                gap > 0.4 * tolerance,
                "{half:e} {tolerance:e}: {gap:e} in step {step}"
            );
        }
        // The body lifts off.
        let lifts = Motion::new(pose, [0.0, 0.0, 0.5], [0.0; 3]).unwrap();
        scene.set_movement(index, lifts).unwrap();
        assert_eq!(scene.find_stops(1.0).unwrap()[index].stopped_by, None);
    }
}

#[test]
fn settings_at_their_limits_are_taken() {
    let ball = Body::sphere(0.5).unwrap();
    let far = |x: f64| Pose::at([x, 0.0, 0.0]).unwrap();
    for (tolerance, margin) in [(1e-100, 0.0), (1e12, 0.0), (1e-3, 1e12)] {
        let config = Settings {
            tolerance,
            margin,
            ..Settings::DEFAULT
        };
        let mut scene = Scene::new().with_settings(config.clone());
        scene.add_fixed(&ball, far(0.0));
        scene.add(&ball, Motion::still(far(3.0)));
        assert!(scene.find_stops(1.0).is_ok(), "{tolerance:e} {margin:e}");
    }
    // The pose that a body has reached may be out of range for a motion.
    let mut scene = Scene::new();
    let flies = |x: f64, speed: f64| Motion::new(far(x), [speed, 0.0, 0.0], [0.0; 3]).unwrap();
    scene.add(&ball, flies(1e12 - 10.0, 20.0));
    scene.add(&ball, flies(1e12, 1.0));
    scene.add(&ball, flies(1e12 - 30.0, 21.0));
    assert!(scene.find_stops(2.0).is_ok());
}

#[test]
fn bodies_on_trajectories_that_stop_never_overlap() {
    let mut rng = Pcg64::seed_from_u64(9);
    let mut solver = Solver::new();
    let (mut stopped, mut crossed) = (0, 0);
    for round in 0..40 {
        let bodies = bodies(&mut rng);
        let throws: Vec<Ballistic> = (0..12).map(|_| random_throw(&mut rng)).collect();
        let mut scene = Scene::with_threads(NonZeroUsize::MIN);
        for (k, throw) in throws.iter().enumerate() {
            scene.add(&bodies[k % 4], throw);
        }
        scene.add_fixed(&bodies[1], Pose::IDENTITY);
        let stops = scene.find_stops(1.0).unwrap();
        stopped += stops
            .iter()
            .filter(|stop| stop.stopped_by.is_some())
            .count();
        let goes_on = Stop {
            time: 1.0,
            stopped_by: None,
            contact: None,
        };
        let free = vec![goes_on; scene.len()];
        let at_start = find_overlapping_pairs(&scene, &poses(&scene, &free, 0.0), &mut solver);
        let mut through = HashSet::new();
        for step in 0..=40 {
            let time = f64::from(step) / 40.0;
            let now = find_overlapping_pairs(&scene, &poses(&scene, &stops, time), &mut solver);
            assert!(
                now.is_subset(&at_start),
                "{round} {time} {now:?} {at_start:?}"
            );
            through.extend(find_overlapping_pairs(
                &scene,
                &poses(&scene, &free, time),
                &mut solver,
            ));
        }
        crossed += through.difference(&at_start).count();
    }
    assert!(stopped > 100 && crossed > 50, "{stopped} {crossed}");
}

/// A motion whose true poses may differ from its computed poses by a displacement of at most `shift`.
struct UncertainMotion {
    motion: Motion,
    shift: f64,
}

impl Trajectory for UncertainMotion {
    fn stretch_between(&self, from: f64, to: f64) -> Result<Stretch, InputError> {
        let mut stretch = self.motion.stretch_between(from, to)?;
        stretch.deviation_bound.center_deviation += self.shift;
        Ok(stretch)
    }
}

/// Tests that a body that stops at a stopped body keeps a distance of at least the error of the stopped body's pose.
#[test]
fn stopped_bodies_are_as_blurred_as_moving_ones() {
    let (ball, wall) = (
        Body::sphere(0.2).unwrap(),
        Body::cuboid([0.1, 2.0, 2.0]).unwrap(),
    );
    let moving = |from: [f64; 3], velocity: [f64; 3]| {
        Motion::new(Pose::at(from).unwrap(), velocity, [0.0; 3]).unwrap()
    };
    let blurred = UncertainMotion {
        motion: moving([0.0; 3], [4.0, 0.0, 0.0]),
        shift: 0.05,
    };
    let falling = moving([1.64, 3.0, 0.0], [0.0, -2.0, 0.0]);
    let mut scene = Scene::new();
    let wall = scene.add_fixed(&wall, Pose::at([2.0, 0.0, 0.0]).unwrap());
    let [first, second] = [scene.add(&ball, &blurred), scene.add(&ball, falling)];
    let stops = scene.find_stops(2.0).unwrap();
    assert_eq!(
        [first, second].map(|body| stops[body].stopped_by),
        [Some(wall), Some(first)]
    );
    let at = |motion: &Motion, body: usize| motion.pose(stops[body].time).translation();
    let gap = at(&blurred.motion, first).distance(at(&falling, second)) - 0.4;
    assert!((0.05..0.06).contains(&gap), "{gap}");
}
