//! Tests which planes give the free time of two pieces, and how the work is counted.

use super::super::*;
use crate::answer::Effort;
use crate::body::Body;
#[cfg(feature = "hull-tree")]
use crate::body::polytope::Polytope;
use crate::distance::oracle::{Claim, DistanceOracle, GiveUpReason, PiecePair};
use crate::engine::meter::Meter;
use crate::math::order::greater;
use crate::motion::Motion;
use crate::motion::pose::Pose;
use crate::settings::Settings;
use crate::tests::oracle::ExhaustiveOracle;
use crate::tests::scene::{
    Pcg64, RngExt, SceneKind, body, random_direction, random_point_in_ball, random_power_of_ten,
    random_rotation, rng, scene,
};
use crate::tuning::ASSUMED_ORACLE_STEPS;
use glam::DQuat;

/// An oracle that counts its steps.
struct CountingOracle {
    steps: u64,
}

impl DistanceOracle for CountingOracle {
    type Cache = ();

    fn separation(&mut self, pair: &PiecePair<'_>, cache: &mut ()) -> Result<Claim, GiveUpReason> {
        self.steps += 5;
        ExhaustiveOracle.separation(pair, cache)
    }

    fn effort(&self) -> Effort {
        Effort {
            steps: self.steps,
            ..Effort::default()
        }
    }
}

/// An oracle that always gives up.
struct FailingOracle;

impl DistanceOracle for FailingOracle {
    type Cache = ();

    fn separation(&mut self, _: &PiecePair<'_>, _: &mut ()) -> Result<Claim, GiveUpReason> {
        Err(GiveUpReason::TooManyPoints)
    }
}

#[test]
fn looks_of_an_oracle_are_its_steps_or_else_points() {
    let scene = scene(&mut rng(4), SceneKind::RandomMotion, 1);
    let problem = scene.problem();
    let placed = PlacedPair::new(&problem, [0, 0], 0.5);
    let mut meter = Meter::new(&problem);
    assert!(
        placed
            .query_oracle(&mut ExhaustiveOracle, &mut (), &mut meter)
            .is_some()
    );
    assert_eq!(
        meter.stats.point_evaluations,
        ASSUMED_ORACLE_STEPS * placed.pieces.points_per_support_search()
    );
    let mut meter = Meter::new(&problem);
    let mut telling = CountingOracle { steps: 7 };
    assert!(
        placed
            .query_oracle(&mut telling, &mut (), &mut meter)
            .is_some()
    );
    assert_eq!(meter.stats.point_evaluations, ASSUMED_ORACLE_STEPS * 5);
    assert_eq!((meter.stats.oracle_calls, meter.stats.give_ups), (1, 0));
    assert!(
        placed
            .query_oracle(&mut FailingOracle, &mut (), &mut meter)
            .is_none()
    );
    assert_eq!((meter.stats.oracle_calls, meter.stats.give_ups), (2, 1));
}

/// Converts a free time to a number; up to the end, an unbounded time, becomes infinity.
fn free_time_or_infinity(free: FreeTime) -> f64 {
    free.bounded().unwrap_or(f64::INFINITY)
}

#[test]
fn the_plane_of_the_longest_time_counts() {
    let mut rng = rng(5);
    let (mut turning, mut passes, mut at_once) = (0, 0, [0; 2]);
    for number in 0..6_000 {
        let kind = SceneKind::passing(number);
        let scene = scene(&mut rng, kind, 2).with_occasional_accelerations(&mut rng);
        let problem = scene.problem();
        let clock = scene.clock * rng.random_range(0.9..1.0);
        let placed = PlacedPair::new(&problem, [0, 0], clock);
        let mut meter = Meter::new(&problem);
        let checked = placed
            .query_oracle(&mut ExhaustiveOracle, &mut (), &mut meter)
            .unwrap();
        let kept = problem.kept_gap();
        if checked.lower <= kept {
            continue;
        }
        let direct = SeparatingPlane {
            normal: placed.frames[0].rotation * checked.axis,
            gap_excess: checked.lower - kept,
        };
        let passing = placed.plane_of_closest_approach(&checked, kept);
        check_closest_approach_plane(&placed, &checked, kept, passing.as_ref());
        let planes: Vec<&SeparatingPlane> = iter::once(&direct).chain(&passing).collect();
        let along = |plane: &&SeparatingPlane| {
            free_time_or_infinity(placed.fixed_plane_free_time(plane.normal, plane.gap_excess))
        };
        let members = placed.moving_pieces();
        let attached = |plane: &&SeparatingPlane| {
            free_time_or_infinity(placed.turning_plane_free_time(&members, plane, f64::INFINITY))
        };
        let fixed = planes.iter().map(along).fold(0.0, greater);
        let all = planes.iter().map(attached).fold(fixed, greater);
        // A plane that turns is tried only if a body's turning uses up the slack.
        let free = placed.free_time(&checked, kept);
        assert!(
            (fixed..=all).contains(&free_time_or_infinity(free)),
            "{free:?} of {fixed}, {all}"
        );
        turning += usize::from(free_time_or_infinity(free) > fixed);
        passes += usize::from(fixed > along(&&direct));
        let sufficient = |time: &f64| *time >= SUFFICIENT_FIRST_FREE_TIME;
        let at_present_rate = placed.free_time_at_present_rate(&direct);
        let expected = at_present_rate
            .map(free_time_or_infinity)
            .filter(sufficient)
            .or(Some(along(&&direct)).filter(sufficient))
            .unwrap_or(free_time_or_infinity(free));
        let first = free_time_or_infinity(placed.first_visit_free_time(&checked, kept));
        assert_eq!(first, expected, "{:?}", direct.normal);
        at_once[usize::from(first < free_time_or_infinity(free))] += 1;
    }
    assert!(turning > 30 && passes > 300, "{turning} {passes}");
    assert!(at_once.into_iter().all(|count| count > 300), "{at_once:?}");
}

#[test]
fn the_plane_between_rounded_pieces_leaves_room_for_their_radii() {
    let (bar, ball) = (Body::capsule(0.1, 1.0).unwrap(), Body::sphere(0.2).unwrap());
    let mut rng = rng(11);
    let mut planes = 0;
    for _ in 0..500 {
        let place = 2.0 * random_direction(&mut rng);
        let pose = Pose::new(place, random_rotation(&mut rng)).unwrap();
        let motion = Motion::new(
            pose,
            random_point_in_ball(&mut rng, 2.0) - place,
            DVec3::ZERO,
        )
        .unwrap();
        let sides = ((&bar, motion), (&ball, Motion::STILL));
        let problem = Problem::of_moving_bodies(sides.0, sides.1, 1.0, &Settings::DEFAULT).unwrap();
        let placed = PlacedPair::new(&problem, [0, 0], 0.0);
        let mut meter = Meter::new(&problem);
        let checked = placed
            .query_oracle(&mut ExhaustiveOracle, &mut (), &mut meter)
            .unwrap();
        let kept = problem.kept_gap();
        let plane = placed.plane_of_closest_approach(&checked, kept);
        check_closest_approach_plane(&placed, &checked, kept, plane.as_ref());
        planes += usize::from(plane.is_some());
    }
    assert!((100..500).contains(&planes), "{planes}");
}

/// Tests that the allowance for rounding is a share of both bodies' speeds, not of their much lower rate of approach.
#[test]
fn a_fixed_plane_allows_for_the_rounding_of_rates() {
    let [a, b] = [0.5, 0.25].map(|size| body(&[[DVec3::ZERO, size * DVec3::X, size * DVec3::Y]]));
    let mut rng = rng(12);
    for _ in 0..500 {
        let away = random_direction(&mut rng);
        let velocity = 0.1 * random_point_in_ball(&mut rng, 1.0) - 0.3 * away;
        let moving = |place: DVec3, velocity: DVec3| {
            let pose = Pose::new(place, DQuat::IDENTITY).unwrap();
            Motion::new(pose, velocity, DVec3::ZERO).unwrap()
        };
        // A follows B, almost as fast.
        let chased = velocity * rng.random_range(1.0..1.1);
        let sides = ((&a, moving(away, chased)), (&b, moving(-away, velocity)));
        let problem = Problem::of_moving_bodies(sides.0, sides.1, 1.0, &Settings::DEFAULT).unwrap();
        let placed = PlacedPair::new(&problem, [0, 0], 0.0);
        let rate = -away.dot(chased - velocity);
        let slack = 0.1 * rate;
        let free = placed.fixed_plane_free_time(-away, slack);
        let free = free.bounded().unwrap();
        let speed = chased.length() + velocity.length();
        let allowed = (slack / free - rate) / (RATE_ERROR_F64 * speed);
        assert!((0.4..3.0).contains(&allowed), "{allowed} {rate} {speed}");
        let points = placed.pieces.points_per_support_search();
        assert_eq!(placed.height_evaluation_count.get(), 2 * points);
    }
}

/// Tests that `stays_apart_despite_rotation` requires exactly the slack that rotation, straight motion and rounding use up.
#[test]
fn points_that_turn_pass_with_all_the_slack_they_need() {
    let mut rng = rng(13);
    let mut counts = [0; 3];
    for number in 0..3_000 {
        let kind = SceneKind::passing(number);
        let mut scene = scene(&mut rng, kind, 2);
        if number % 2 == 0 {
            let (start, velocity) = (scene.motions[0].start(), scene.motions[0].velocity());
            scene.motions[0] = Motion::new(start, velocity, DVec3::ZERO).unwrap();
        }
        let problem = scene.problem();
        let placed = PlacedPair::new(&problem, [0, 0], scene.clock * rng.random_range(0.0..1.0));
        let (horizon, normal) = (placed.time_left(), random_direction(&mut rng));
        let a = Heights::new(
            &problem.a,
            &placed.pieces.a,
            &placed.frames[0],
            -normal,
            placed.clock,
        );
        let b = Heights::new(
            &problem.b,
            &placed.pieces.b,
            &placed.frames[1],
            normal,
            placed.clock,
        );
        let passes = |slack: f64| placed.stays_apart_despite_rotation(&a, &b, slack);
        let descents = a
            .max_rotational_descent_until(horizon)
            .zip(b.max_rotational_descent_until(horizon));
        let Some(descents) = descents.filter(|_| !(a.is_nonrotating() && b.is_nonrotating()))
        else {
            assert!(!passes(f64::MAX));
            counts[0] += 1;
            continue;
        };
        let displacement =
            (a.motion_along_axis.linear_rate + b.motion_along_axis.linear_rate) * horizon;
        let needed = descents.0 + descents.1 - lesser(0.0, displacement);
        let allowance = RATE_ERROR_F64 * (a.speed_bound + b.speed_bound) * horizon;
        let (mut low, mut high) = (0.0, 2.0 * (needed + allowance));
        assert!(!passes(low) && passes(high));
        for _ in 0..200 {
            let middle = 0.5 * (low + high);
            if passes(middle) {
                high = middle;
            } else {
                low = middle;
            }
        }
        let allowed = (high - needed) / allowance;
        assert!(
            (0.5..1.5).contains(&allowed),
            "{allowed} {needed} {allowance}"
        );
        counts[if displacement < 0.0 { 1 } else { 2 }] += 1;
    }
    assert!(counts.iter().all(|&count| count > 100), "{counts:?}");
}

/// Compares `least_linear_displacement` with the least of dense samples.
#[test]
fn a_drift_is_least_at_an_end_or_where_it_turns() {
    let mut rng = rng(14);
    let mut within = [0; 2];
    for _ in 0..4_000 {
        let any =
            |rng: &mut Pcg64| random_power_of_ten(rng, -3.0, 3.0) * rng.random_range(-1.0..1.0);
        let (rate, linear_acceleration) = (any(&mut rng), any(&mut rng));
        let horizon = random_power_of_ten(&mut rng, -2.0, 0.0);
        let way = |tau: f64| (rate + 0.5 * linear_acceleration * tau) * tau;
        let samples = (0..=2_000).map(|k| way(horizon * f64::from(k) / 2e3));
        let sampled = samples.fold(0.0, lesser);
        let least = least_linear_displacement(rate, linear_acceleration, horizon);
        // Next to the least value, a sample is off by half a step at most.
        let missed = linear_acceleration.abs() * (horizon / 2e3) * (horizon / 2e3);
        let rounding = 1e-15 * (rate.abs() + linear_acceleration.abs());
        assert!((-rounding..=missed + rounding).contains(&(sampled - least)));
        within[usize::from(least < lesser(0.0, way(horizon)))] += 1;
    }
    assert!(within.iter().all(|&count| count > 200), "{within:?}");
}

/// Checks that a plane is perpendicular to the vector between two points on straight paths at their closest approach.
fn check_closest_approach_plane(
    placed: &PlacedPair<'_>,
    checked: &CheckedClaim,
    kept: f64,
    plane: Option<&SeparatingPlane>,
) {
    let Problem { a, b, .. } = placed.problem;
    let [x, y] =
        [checked.witness_a, checked.witness_b].map(|p| placed.frames[0].transform_point(p));
    let [v, w] = [(a, x), (b, y)].map(|(side, p)| side.path.velocity_at(p, placed.clock));
    let way = |tau: f64| (y - x) + (w - v) * tau;
    // The distance of two points on straight paths falls, and then rises.
    let (mut low, mut high) = (0.0, 1.0 - placed.clock);
    for _ in 0..200 {
        let [one, other] = [low + (high - low) / 3.0, high - (high - low) / 3.0];
        if way(one).length() < way(other).length() {
            high = other;
        } else {
            low = one;
        }
    }
    let nearest = way(0.5 * (low + high));
    // If the points are at rest relative to each other, the plane across the axis of the claim is the only one.
    let travel = way(0.0).length() + way(1.0).length();
    if v == w || nearest.length() < 1e-3 * travel {
        return;
    }
    let exact = nearest.normalize();
    // The slack is that along the plane's own normal.
    let normal = plane.map_or(exact, |plane| plane.normal);
    let tilt = 1e-4 + 4.0 * placed.problem.rounding / nearest.length();
    assert!(normal.cross(exact).length() < tilt, "{normal} {exact}");
    let height = |k: usize, p: &DVec3| normal.dot(placed.frames[k].transform_point(*p));
    let top = placed
        .pieces
        .a
        .points
        .iter()
        .map(|p| height(0, p))
        .fold(f64::NEG_INFINITY, greater);
    let foot = placed
        .pieces
        .b
        .points
        .iter()
        .map(|p| height(1, p))
        .fold(f64::INFINITY, lesser);
    let radii = placed.pieces.a.radius + placed.pieces.b.radius;
    let slack = foot - top - radii - kept - placed.problem.rounding;
    let [a, b] = [placed.pieces.a.points, placed.pieces.b.points];
    let points = a
        .iter()
        .map(|p| placed.frames[0].transform_point(*p))
        .chain(b.iter().map(|p| placed.frames[1].transform_point(*p)));
    let size = points.map(DVec3::length).fold(0.0, greater);
    match plane {
        Some(plane) => assert!(
            (plane.gap_excess - slack).abs() <= placed.problem.rounding,
            "{} {slack}",
            plane.gap_excess
        ),
        None => assert!(slack <= 1e-6 * size, "{slack}"),
    }
}

#[cfg(feature = "hull-tree")]
#[test]
fn depth_is_measured_between_the_middles_of_many_points() {
    let mut rng = rng(6);
    let mut inside = 0;
    for _ in 0..200 {
        let mut cloud = |radius: f64| {
            let points: Vec<DVec3> = (0..80)
                .map(|_| random_point_in_ball(&mut rng, radius))
                .collect();
            let polytope = Polytope {
                points,
                radius: 0.05 * radius,
                ..Polytope::default()
            };
            Body::polytope(polytope).unwrap()
        };
        let (a, b) = (cloud(1.0), cloud(0.5));
        let motion = Motion::still(
            Pose::new(
                random_point_in_ball(&mut rng, 2.5),
                random_rotation(&mut rng),
            )
            .unwrap(),
        );
        let sides = ((&a, motion), (&b, Motion::STILL));
        let problem = Problem::of_moving_bodies(sides.0, sides.1, 1.0, &Settings::DEFAULT).unwrap();
        let placed = PlacedPair::new(&problem, [0, 0], 0.0);
        let pair = &placed.pieces;
        let [(from, large), (to, small)] = [
            pair.a.bounding_ball().unwrap(),
            pair.b.bounding_ball().unwrap(),
        ];
        let in_a = |p: DVec3| pair.b_to_a.transform_point(p);
        let axis = (in_a(to) - from).normalize();
        let heights = |p: DVec3| axis.dot(p);
        let top = pair
            .a
            .points
            .iter()
            .map(|&p| heights(p))
            .fold(f64::NEG_INFINITY, greater);
        let foot = pair
            .b
            .points
            .iter()
            .map(|&p| heights(in_a(p)))
            .fold(f64::INFINITY, lesser);
        let expected = (top - foot + 0.075) / lesser(large, small);
        let depth = placed.relative_overlap_along_center_line().unwrap();
        assert!((depth - expected).abs() < 1e-9, "{depth} {expected}");
        inside += usize::from(depth > 0.0);
    }
    assert!((20..180).contains(&inside), "{inside}");
}
