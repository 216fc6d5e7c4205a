//! Compares free times by planes that turn with a body with distances at sampled times, and the rounding with
//! double-double arithmetic.

mod worst;

use super::*;
use crate::body::Body;
use crate::body::polytope::Polytope;
use crate::distance::oracle::PiecePair;
use crate::distance::separation::support_gap;
use crate::engine::pieces::placed_pair::PlacedPair;
use crate::engine::pieces::planes::SeparatingPlane;
use crate::math::order::greater;
use crate::motion::Motion;
use crate::motion::pose::Pose;
use crate::problem::Problem;
use crate::query::MovingBody;
use crate::settings::Settings;
use crate::tests::double::{DoubleDouble, DoubleDouble3, place};
use crate::tests::scene::{
    Pcg64, RngExt, Scene, SceneKind, random_direction, random_point_in_ball, random_power_of_ten,
    rng, scene,
};

const SAMPLES: u32 = 48;

/// Counts of the kinds of cases that the test has met.
#[derive(Debug, Default)]
struct CaseCounts {
    bounded_time_count: usize,
    unbounded_time_count: usize,
    /// The number of free times that are nearly as long as possible: at their end most of the slack is used up.
    exhausted_slack_count: usize,
    /// The number of samples in which both bodies turn.
    both_turning_sample_count: usize,
    fast_body_count: usize,
    many_point_piece_count: usize,
}

#[test]
fn a_plane_that_turns_separates_for_as_long_as_it_says() {
    let mut rng = rng(1);
    let mut seen = CaseCounts::default();
    for number in 0..12_000 {
        let kind = [SceneKind::RandomMotion, SceneKind::NearRim][number % 2];
        let scene =
            scene_of_random_polytopes(&mut rng, kind).with_occasional_accelerations(&mut rng);
        let problem = scene.problem();
        let clock = scene.clock * rng.random_range(0.0..1.0);
        for holder in [0, 1] {
            check(&mut rng, &problem, clock, holder, &mut seen);
        }
    }
    assert!(
        seen.bounded_time_count > 10_000 && seen.unbounded_time_count > 1_000,
        "{seen:?}"
    );
    assert!(
        seen.both_turning_sample_count > 3_000 && seen.fast_body_count > 1_000,
        "{seen:?}"
    );
    assert!(seen.many_point_piece_count > 3_000, "{seen:?}");
    assert!(
        4 * seen.exhausted_slack_count > seen.bounded_time_count,
        "{seen:?}"
    );
}

/// Draws a scene with pieces of 1 to 300 points, some of them rounded, with rotations of up to a thousand radians.
fn scene_of_random_polytopes(rng: &mut Pcg64, kind: SceneKind) -> Scene {
    let mut scene = scene(rng, kind, 2);
    for (body, motion) in scene.bodies.iter_mut().zip(&mut scene.motions) {
        let [a, b, c] = body.pieces().triangle(0);
        let spread = b.distance(c) * random_power_of_ten(rng, -3.0, 0.0);
        let mut points = vec![a, b, c];
        points.truncate(rng.random_range(1..=3));
        if rng.random_bool(0.4) {
            let more = random_power_of_ten(rng, 0.0, 2.5) as usize;
            points.extend((0..more).map(|_| {
                let at = a.lerp(b, rng.random_range(0.0..1.0));
                at.lerp(c, rng.random_range(0.0..1.0)) + random_point_in_ball(rng, spread)
            }));
        }
        *body = Body::polytope(Polytope {
            points,
            radius: if rng.random_bool(0.3) { spread } else { 0.0 },
            ..Polytope::default()
        })
        .unwrap();
        if rng.random_bool(0.2) {
            let faster = motion.angular_velocity() * random_power_of_ten(rng, 0.0, 2.0);
            let (start, center) = (motion.start(), motion.center());
            *motion = Motion::about(start, motion.velocity(), faster, center).unwrap();
        }
    }
    scene
}

fn check(rng: &mut Pcg64, problem: &Problem<'_>, clock: f64, holder: usize, seen: &mut CaseCounts) {
    let placed = PlacedPair::new(problem, [0, 0], clock);
    let members = placed.moving_pieces();
    let (own, other) = (&members[holder], &members[1 - holder]);
    if !own.body_with_path.path.is_turning() {
        return;
    }
    // The axis is constant in its body's frame.
    let towards = if rng.random_bool(0.5) {
        random_direction(rng)
    } else {
        (other.frame.transform_point(other.piece.points[0])
            - own.frame.transform_point(own.piece.points[0]))
        .normalize()
    };
    let local = own.frame.inverse_transform_vector(towards);
    let gap_at = |s: f64| {
        let PiecePair { a, b, b_to_a } = PlacedPair::new(problem, [0, 0], s).pieces;
        let in_a = match holder {
            0 => local,
            _ => -(b_to_a.rotation * local),
        };
        support_gap(&PiecePair { a, b, b_to_a }, in_a, a.points[0])
    };
    let gap = gap_at(clock);
    let slack = gap.abs() * random_power_of_ten(rng, -3.0, 0.0);
    let free = PieceMotionToTurningPlane::new(own, other, towards, problem.rounding)
        .free_time(slack, 1.0 - clock)
        .bounded();
    let until = free.map_or(1.0, |free| clock + free);
    // Both gaps are rounded.
    let least = gap - slack - 2.0 * problem.rounding;
    for k in 0..=SAMPLES {
        let s = clock + (until - clock) * f64::from(k) / f64::from(SAMPLES);
        let found = gap_at(s);
        assert!(
            found >= least,
            "{found:e} < {least:e} at {s} of {until} from {clock}"
        );
    }
    let turns = own.body_with_path.path.angular_speed + other.body_with_path.path.angular_speed;
    match free {
        None => seen.unbounded_time_count += 1,
        Some(free) if free > 0.0 => {
            seen.bounded_time_count += 1;
            seen.exhausted_slack_count += usize::from(gap_at(until) < gap - 0.5 * slack);
        }
        Some(_) => {}
    }
    seen.both_turning_sample_count += usize::from(other.body_with_path.path.is_turning());
    seen.fast_body_count += usize::from(turns > 50.0);
    seen.many_point_piece_count += usize::from(other.piece.points.len() > 3);
}

#[test]
fn rounding_along_an_axis_that_turns_is_allowed_for() {
    let mut rng = rng(2);
    let (mut height, mut rate) = (0.0f64, 0.0f64);
    for number in 0..3_000 {
        let scene = scene_of_random_polytopes(
            &mut rng,
            [SceneKind::RandomMotion, SceneKind::NearRim][number % 2],
        );
        let problem = scene.problem();
        // Sums of these numbers are exact.
        let grain = f64::from(1 << 20);
        let [clock, tau] =
            [0.5, 0.5].map(|most| (rng.random_range(0.0..most) * grain).floor() / grain);
        let placed = PlacedPair::new(&problem, [0, 0], clock);
        let members = placed.moving_pieces();
        for holder in [0, 1] {
            let (own, other) = (&members[holder], &members[1 - holder]);
            if !own.body_with_path.path.is_turning() {
                continue;
            }
            let normal = random_direction(&mut rng);
            let sweep = PieceMotionToTurningPlane::new(own, other, normal, problem.rounding);
            let motions = [&scene.motions[holder], &scene.motions[1 - holder]];
            let point = other.piece.points[rng.random_range(0..other.piece.points.len())];
            let rises = |tau: f64| {
                let turned = sweep.height_terms_after(tau);
                let arm = point - sweep.reference_point;
                let height = turned.height + turned.axis.dot(arm);
                (height, turned.rate + turned.rate_axis.dot(arm))
            };
            let exact = |tau: f64| exact_height_and_rate(motions, normal, point, clock, tau);
            let (first, second) = (rises(0.0), rises(tau));
            let (start, end) = (exact(0.0), exact(tau));
            let off =
                DoubleDouble::from(second.0) - DoubleDouble::from(first.0) - (end.0 - start.0);
            let (allowed_height, fastest) = sweep.rounding_allowances();
            height = greater(height, off.get().abs() / allowed_height);
            let off = (DoubleDouble::from(second.1) - end.1).get();
            rate = greater(rate, off.abs() / fastest);
        }
    }
    assert!(height < 1.0 && rate < 1.0, "{height} {rate}");
    // An allowance that no sample comes near would be too large.
    assert!(height > 1e-3 && rate > 1e-3, "{height} {rate}");
}

/// Returns the exact height of a point of the second body along an axis that turns with the first body, and the rate of
/// this height. The height is measured from the first body's center.
fn exact_height_and_rate(
    motions: [&Motion; 2],
    normal: DVec3,
    point: DVec3,
    clock: f64,
    tau: f64,
) -> (DoubleDouble, DoubleDouble) {
    let s = clock + tau;
    let [own, other] = motions;
    let spin = DoubleDouble3::from(own.angular_velocity());
    let normal =
        DoubleDouble3::from(normal).turned(spin.unit(), spin.length() * DoubleDouble::from(tau));
    let at = place(other, 1.0, s, point);
    let way = at - place(own, 1.0, s, own.center());
    let arm = at - place(other, 1.0, s, other.center());
    let velocity = DoubleDouble3::from(other.velocity()) - DoubleDouble3::from(own.velocity());
    let passing = velocity + DoubleDouble3::from(other.angular_velocity()).cross(arm);
    let rate = spin.cross(normal).dot(way) + normal.dot(passing);
    (normal.dot(way), rate)
}

/// Tests that a plane which turns with a large plate separates it from a small ball for at least nine tenths of the
/// exact time. The plate turns about an axis in its plane, near the ball; its rim is fast, but stays far away.
#[test]
fn a_large_plate_turns_past_a_small_ball_at_once() {
    let corner = |x: f64, y: f64| DVec3::new(x, y, 0.0);
    let plate = Body::polytope(Polytope {
        points: vec![
            corner(-100.0, -100.0),
            corner(100.0, -100.0),
            corner(100.0, 100.0),
            corner(-100.0, 100.0),
        ],
        ..Polytope::default()
    })
    .unwrap();
    let ball = Body::sphere(0.1).unwrap();
    let above = Pose::at(DVec3::new(0.0, 3.0, 0.5)).unwrap();
    let spin = Motion::new(Pose::IDENTITY, DVec3::ZERO, DVec3::Y).unwrap();
    let moving = |body, motion| MovingBody::from((body, motion));
    let (plate, ball) = (moving(&plate, spin), moving(&ball, Motion::still(above)));
    for swapped in [false, true] {
        let (a, b) = if swapped {
            (ball, plate)
        } else {
            (plate, ball)
        };
        let problem = Problem::of_moving_bodies(a, b, 1.0, &Settings::DEFAULT).unwrap();
        let placed = PlacedPair::new(&problem, [0, 0], 0.0);
        let normal = if swapped { -DVec3::Z } else { DVec3::Z };
        let plane = SeparatingPlane {
            normal,
            gap_excess: 0.3,
        };
        let still = placed
            .fixed_plane_free_time(plane.normal, plane.gap_excess)
            .bounded()
            .unwrap();
        assert!(still < 0.01, "{still}");
        // 0.5 (1 − cos τ) uses up 0.3 after 1.16.
        assert_eq!(
            placed.turning_plane_free_time(&placed.moving_pieces(), &plane, still),
            FreeTime::ToEnd
        );
        let closer = SeparatingPlane {
            normal,
            gap_excess: 0.1,
        };
        let free = placed
            .turning_plane_free_time(&placed.moving_pieces(), &closer, still)
            .bounded()
            .unwrap();
        let exact = 0.8f64.acos();
        assert!(free <= exact && free > 0.9 * exact, "{free} {exact}");
    }
}

/// Tests that the free time is 0 if the slack is not positive, or if the slack or the normal is NaN.
#[test]
fn no_slack_is_no_time() {
    let mut rng = rng(3);
    for _ in 0..500 {
        let scene = scene_of_random_polytopes(&mut rng, SceneKind::NearRim);
        let problem = scene.problem();
        let placed = PlacedPair::new(&problem, [0, 0], 0.5);
        let [a, b] = placed.moving_pieces();
        for slack in [0.0, -1.0, f64::NAN, f64::NEG_INFINITY] {
            let free = PieceMotionToTurningPlane::new(
                &a,
                &b,
                random_direction(&mut rng),
                problem.rounding,
            )
            .free_time(slack, 0.5);
            assert_eq!(free, FreeTime::NONE, "{slack}");
        }
        let free = PieceMotionToTurningPlane::new(&a, &b, DVec3::NAN, problem.rounding)
            .free_time(1.0, 0.5);
        assert_eq!(free, FreeTime::NONE);
    }
}
