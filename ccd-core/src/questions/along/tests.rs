//! Compares answers along trajectories with sampled distances, and with the answers for plain motions.

mod budgets;

mod distances;

use crate::answer::Outcome;
use crate::body::Body;
use crate::engine::answer::EngineSchedule;
use crate::error::InputError;
use crate::math::order::lesser;
use crate::motion::Motion;
use crate::motion::trajectory::{AccelerationBounds, SmoothTrajectory};
use crate::motion::trajectory::{Stretch, Trajectory};
use crate::query::Query;
use crate::schedule::{BestFirst, DepthFirst, Naive, Schedule};
use crate::settings::Settings;
use crate::tests::nearest::{Triangle, nearest_points};
use crate::tests::oracle::ExhaustiveOracle;
use crate::tests::scene::{
    Pcg64, RngExt, SceneKind, SoupKind, body, random_power_of_ten, random_triangle_soup, rng, scene,
};
use crate::tests::trajectories::SwingingTrajectory;
use glam::DVec3;

/// Two bodies that swing back and forth near each other.
struct SwingingBodies {
    soups: [Vec<Triangle>; 2],
    bodies: [Body; 2],
    trajectories: [SwingingTrajectory; 2],
    settings: Settings,
}

impl SwingingBodies {
    fn draw(rng: &mut Pcg64) -> Self {
        let soups = [(); 2].map(|()| {
            let count = rng.random_range(1..6);
            random_triangle_soup(rng, SoupKind::WellShaped, count, 1.0)
        });
        let mut swings = [(); 2].map(|()| SwingingTrajectory::draw(rng, 0.7));
        swings[0].place += 1.2 * DVec3::X;
        SwingingBodies {
            bodies: [body(&soups[0]), body(&soups[1])],
            soups,
            trajectories: swings,
            settings: Settings {
                tolerance: random_power_of_ten(rng, -6.0, -2.0),
                margin: [0.0, 0.1][rng.random_range(0..2)],
                ..Settings::DEFAULT
            },
        }
    }

    fn query(&self) -> Query<'_> {
        let [a, b] = [0, 1].map(|k| (&self.bodies[k], &self.trajectories[k]));
        Query::new(a, b, 1.0, &self.settings).unwrap()
    }

    fn distance(&self, t: f64) -> f64 {
        let [a, b] = [0, 1].map(|k| {
            let pose = self.trajectories[k].pose(t).unwrap();
            let placed = |triangle: &Triangle| triangle.map(|p| pose.transform_point(p));
            self.soups[k].iter().map(placed).collect::<Vec<_>>()
        });
        let pairs = a
            .iter()
            .flat_map(|x| b.iter().map(move |y| nearest_points(x, y).distance));
        pairs.fold(f64::INFINITY, lesser)
    }

    fn first(&self) -> Outcome {
        let answer = BestFirst::default().first_contact(&self.query(), &mut ExhaustiveOracle);
        answer.unwrap().outcome
    }
}

const ROUNDING: f64 = 1e-12;

#[test]
fn first_contacts_hold_at_sampled_times() {
    let mut rng = rng(1);
    let (mut hits, mut misses, mut starts) = (0, 0, 0);
    for number in 0..600 {
        let swings = SwingingBodies::draw(&mut rng);
        let Settings {
            margin, tolerance, ..
        } = swings.settings;
        let (until, least) = match swings.first() {
            Outcome::Contact { time, contact } => {
                hits += 1;
                let near = swings.distance(time);
                assert!(near <= margin + tolerance + ROUNDING, "{number}: {near:e}");
                assert!(contact.separation.lower <= near + ROUNDING);
                assert!(contact.separation.upper <= margin + tolerance + ROUNDING);
                (time, margin)
            }
            Outcome::Free { proven_gap } => {
                misses += 1;
                (1.0, proven_gap)
            }
            Outcome::Touching { .. } | Outcome::Overlapping { .. } => {
                starts += 1;
                assert!(swings.distance(0.0) <= margin + tolerance + ROUNDING);
                continue;
            }
            outcome => panic!("{number}: {outcome:?}"),
        };
        for k in 0..200 {
            let found = swings.distance(until * f64::from(k) / 200.0);
            assert!(
                found >= least - ROUNDING,
                "{number}: {found:e} before {until}"
            );
        }
    }
    assert!(
        hits > 100 && misses > 100 && starts > 5,
        "{hits} {misses} {starts}"
    );
}

/// Tests that the naive schedule, which knows no accelerations of motions, finds the same first contacts as the
/// best-first schedule, and none of them late.
#[test]
fn every_schedule_finds_first_contacts_along_trajectories() {
    let mut rng = rng(31);
    let (mut hits, mut misses) = (0, 0);
    for number in 0..60 {
        let mut swings = SwingingBodies::draw(&mut rng);
        swings.settings.tolerance = random_power_of_ten(&mut rng, -3.0, -2.0);
        let Settings {
            margin, tolerance, ..
        } = swings.settings;
        let naive = Naive::default().first_contact(&swings.query(), &mut ExhaustiveOracle);
        match (naive.unwrap().outcome, swings.first()) {
            (Outcome::Contact { time, .. }, other) => {
                hits += 1;
                let near = swings.distance(time);
                assert!(near <= margin + tolerance + ROUNDING, "{number}: {near:e}");
                for k in 0..200 {
                    let found = swings.distance(time * f64::from(k) / 200.0);
                    assert!(
                        found >= margin - ROUNDING,
                        "{number}: {found:e} before {time}"
                    );
                }
                let graze = matches!(other, Outcome::Free { proven_gap } if proven_gap <= margin + tolerance);
                assert!(
                    graze || other.hit().is_ok_and(|hit| hit.is_some()),
                    "{number}: {other:?}"
                );
            }
            (Outcome::Free { proven_gap }, _) => {
                misses += 1;
                for k in 0..=200 {
                    let found = swings.distance(f64::from(k) / 200.0);
                    assert!(found >= proven_gap - ROUNDING, "{number}: {found:e}");
                }
            }
            (Outcome::Touching { .. } | Outcome::Overlapping { .. }, _) => {}
            (outcome, _) => panic!("{number}: {outcome:?}"),
        }
    }
    assert!(hits > 10 && misses > 10, "{hits} {misses}");
}

#[test]
fn any_contact_has_the_verdict_of_the_first() {
    let mut rng = rng(2);
    let (mut hits, mut misses, mut grazes) = (0, 0, 0);
    for number in 0..600 {
        let swings = SwingingBodies::draw(&mut rng);
        let within = swings.settings.margin + swings.settings.tolerance;
        let any = DepthFirst::default().any_contact(&swings.query(), &mut ExhaustiveOracle);
        match (any.unwrap().outcome, swings.first()) {
            (Outcome::Free { .. }, Outcome::Free { .. }) => misses += 1,
            (Outcome::Contact { time, .. }, first) => {
                let near = swings.distance(time);
                assert!(near <= within + ROUNDING, "{number}: {near:e}");
                match first {
                    Outcome::Free { .. } => grazes += 1,
                    _ => hits += 1,
                }
            }
            (Outcome::Overlapping { .. }, Outcome::Overlapping { .. }) => {}
            (Outcome::Free { .. }, Outcome::Contact { time, .. }) => {
                grazes += 1;
                assert!(swings.distance(time) > swings.settings.margin);
            }
            (any, first) => panic!("{number}: {any:?}, {first:?}"),
        }
    }
    assert!(
        hits > 100 && misses > 100 && grazes < 10,
        "{hits} {misses} {grazes}"
    );
}

#[test]
fn brackets_hold_the_least_of_sampled_distances_and_are_narrow() {
    let mut rng = rng(3);
    let (mut apart, mut touching) = (0, 0);
    for number in 0..400 {
        let swings = SwingingBodies::draw(&mut rng);
        let answer = DepthFirst::default().closest_approach(&swings.query(), &mut ExhaustiveOracle);
        let answer = answer.unwrap();
        let (lower, upper) = (answer.outcome.lower(), answer.outcome.upper());
        match answer.outcome {
            Outcome::LeastDistance { time, .. } => {
                assert!(
                    upper - lower <= swings.settings.tolerance,
                    "{number}: {answer:?}"
                );
                assert!(
                    swings.distance(time) <= upper + ROUNDING,
                    "{number}: {answer:?}"
                );
            }
            Outcome::Overlapping { .. } => {}
            _ => panic!("{number}: {answer:?}"),
        }
        for k in 0..=200 {
            let found = swings.distance(f64::from(k) / 200.0);
            assert!(
                found >= lower - ROUNDING,
                "{number}: {found:e} in {answer:?}"
            );
        }
        if lower > 0.0 {
            apart += 1;
        } else {
            touching += 1;
        }
    }
    assert!(apart > 60 && touching > 60, "{apart} {touching}");
}

/// A motion with constant velocities that implements [`SmoothTrajectory`], as a user's trajectory does.
struct MotionAsSmoothTrajectory(Motion);

/// A motion with constant velocities that is queried as a [`Trajectory`], so that the query is answered stretch by
/// stretch.
struct MotionAsTrajectory(Motion);

impl Trajectory for MotionAsTrajectory {
    fn stretch_between(&self, from: f64, to: f64) -> Result<Stretch, InputError> {
        self.0.stretch_between(from, to)
    }
}

impl SmoothTrajectory for MotionAsSmoothTrajectory {
    fn tangent_motion(&self, time: f64) -> Result<Motion, InputError> {
        let (velocity, spin, center) = (
            self.0.velocity(),
            self.0.angular_velocity(),
            self.0.center(),
        );
        Motion::about(self.0.pose(time), velocity, spin, center)
    }

    fn acceleration_bounds(&self, _: f64, _: f64) -> AccelerationBounds {
        AccelerationBounds::default()
    }
}

#[test]
fn plain_motions_have_their_own_answers() {
    let mut rng = rng(4);
    let (mut hits, mut misses) = (0, 0);
    for number in 0..1_000 {
        let scene = scene(
            &mut rng,
            [SceneKind::RandomMotion, SceneKind::NearRim][number % 2],
            8,
        );
        let problem = scene.problem();
        let unknown = scene.motions.map(MotionAsTrajectory);
        let [a, b] = [0, 1].map(|k| (&scene.bodies[k], &unknown[k]));
        let query = Query::new(a, b, 1.0, &scene.settings).unwrap();
        let answer = BestFirst::default().answer_first_contact(&problem, &mut ExhaustiveOracle);
        let along = BestFirst::default().first_contact(&query, &mut ExhaustiveOracle);
        assert_eq!(along.unwrap().outcome, answer.outcome, "{number}");
        match answer.outcome {
            Outcome::Free { .. } => misses += 1,
            _ => hits += 1,
        }
    }
    assert!(hits > 30 && misses > 200, "{hits} {misses}");
}

#[test]
fn a_motion_as_a_trajectory_of_ones_own_has_the_same_answer_within_the_tolerance() {
    let mut rng = rng(5);
    let (mut hits, mut misses, mut grazes) = (0, 0, 0);
    for number in 0..1_000 {
        let scene = scene(
            &mut rng,
            [SceneKind::RandomMotion, SceneKind::NearRim][number % 2],
            8,
        );
        let problem = scene.problem();
        let own = scene.motions.map(MotionAsSmoothTrajectory);
        let [a, b] = [0, 1].map(|k| (&scene.bodies[k], &own[k]));
        let query = Query::new(a, b, 1.0, &scene.settings).unwrap();
        let answer = BestFirst::default().answer_first_contact(&problem, &mut ExhaustiveOracle);
        let along = BestFirst::default().first_contact(&query, &mut ExhaustiveOracle);
        match (answer.outcome, along.unwrap().outcome) {
            (Outcome::Contact { time, .. }, Outcome::Contact { time: other, .. }) => {
                hits += 1;
                let within = problem.contact_distance() + 1e-9;
                for time in [time, other] {
                    let near = crate::tests::scene::distance(&problem, time);
                    assert!(near <= within * (1.0 + 1e-9), "{number}: {near:e}");
                }
            }
            (Outcome::Free { .. }, Outcome::Free { .. }) => misses += 1,
            (Outcome::Touching { .. }, Outcome::Touching { .. })
            | (Outcome::Overlapping { .. }, Outcome::Overlapping { .. }) => {}
            // The coordinates are too large for the tolerance on this path.
            (_, Outcome::Unresolved(_)) => grazes += 1,
            (answer, along) => {
                grazes += 1;
                assert!(grazes < 20, "{number}: {answer:?}, {along:?}");
            }
        }
    }
    assert!(hits > 30 && misses > 200, "{hits} {misses} {grazes}");
}

#[test]
fn no_contact_is_before_the_first_or_after_the_last() {
    let mut rng = rng(8);
    let (mut within, mut early) = (0, 0);
    for number in 0..400 {
        let swings = SwingingBodies::draw(&mut rng);
        let Settings {
            margin, tolerance, ..
        } = swings.settings;
        let answer = BestFirst::default().contact_interval(&swings.query(), &mut ExhaustiveOracle);
        match (answer.unwrap().outcome, swings.first()) {
            (Outcome::Free { .. }, Outcome::Free { .. }) => {}
            (Outcome::Interval { first, last }, first_contact) => {
                within += 1;
                if let Outcome::Contact { time, .. } = first_contact {
                    assert_eq!(first.time, time);
                }
                assert!(first.time <= last.time && last.time <= 1.0);
                early += u32::from(last.time < 1.0);
                let near = swings.distance(last.time);
                assert!(near <= margin + tolerance + ROUNDING, "{number}: {near:e}");
                for k in 1..=100 {
                    let after = last.time + (1.0 - last.time) * f64::from(k) / 100.0;
                    if after > last.time {
                        let found = swings.distance(after);
                        assert!(found >= margin - ROUNDING, "{number}: {found:e} at {after}");
                    }
                }
            }
            (interval, first) => panic!("{number}: {interval:?}, {first:?}"),
        }
    }
    assert!(within > 60 && early > 30, "{within} {early}");
}

#[test]
fn durations_may_be_very_long() {
    let ball = Body::sphere(0.5).unwrap();
    let slow = Motion::new(
        crate::Pose::at(9.0 * DVec3::X).unwrap(),
        1e-60 * DVec3::Y,
        DVec3::ZERO,
    );
    let (slow, config) = (MotionAsTrajectory(slow.unwrap()), Settings::DEFAULT);
    let ask = |duration| Query::new((&ball, &slow), (&ball, &Motion::STILL), duration, &config);
    assert!(ask(1e51).is_err());
    let query = ask(1e50).unwrap();
    let answer = BestFirst::default().first_contact(&query, &mut ExhaustiveOracle);
    assert!(matches!(
        answer.unwrap().outcome,
        Outcome::Free { proven_gap } if proven_gap > 0.0
    ));
}

#[test]
fn no_time_is_a_pose() {
    let mut rng = rng(7);
    for _ in 0..100 {
        let swings = SwingingBodies::draw(&mut rng);
        let [a, b] = [0, 1].map(|k| (&swings.bodies[k], &swings.trajectories[k]));
        let query = Query::new(a, b, 0.0, &swings.settings).unwrap();
        let along = BestFirst::default().first_contact(&query, &mut ExhaustiveOracle);
        let within = swings.settings.margin + swings.settings.tolerance;
        match along.unwrap().outcome {
            Outcome::Free { proven_gap } => assert!(swings.distance(0.0) >= proven_gap - ROUNDING),
            Outcome::Touching { .. } | Outcome::Overlapping { .. } => {
                assert!(swings.distance(0.0) <= within + ROUNDING);
            }
            outcome => panic!("{outcome:?}"),
        }
    }
}
