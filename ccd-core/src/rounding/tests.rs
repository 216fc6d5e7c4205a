//! Compares errors of f64 computations with their bounds; the exact values are computed in double-double arithmetic.

mod derivations;
mod distances;
mod worst;

use super::distance_rounding;
use crate::body::piece::ConvexCombination;
use crate::body::pieces::Pieces;
use crate::distance::oracle::{Claim, PiecePair};
use crate::distance::separation;
use crate::math::order::greater;
use crate::motion::Motion;
use crate::problem::Problem;
use crate::query::MovingBody;
use crate::settings::Settings;
use crate::tests::double::{DoubleDouble, DoubleDouble3, place};
use crate::tests::far_ends::{between, ends};
use crate::tests::scene::{
    Pcg64, RngExt, SoupKind, body, random_direction, random_point_in_ball, random_power_of_ten,
    random_rotation, random_triangle_soup, rng,
};
use crate::tests::worst::error_fraction;
use crate::{Body, Pose};
use glam::DVec3;

/// The largest errors found of positions, gaps and distances, as shares of their bounds.
#[derive(Debug, Default)]
struct WorstErrorShares {
    position: f64,
    gap: f64,
    distance: f64,
    /// The number of tested problems that are far from the body's or the world's origin, by a million units or more.
    far_problem_count: usize,
    turning_problem_count: usize,
}

#[test]
fn rounding_of_places_gaps_and_distances_is_allowed_for() {
    let mut rng = rng(5);
    let mut worst = WorstErrorShares::default();
    for _ in 0..4_000 {
        let count = rng.random_range(1..4);
        let size = random_power_of_ten(&mut rng, -6.0, 6.0);
        let bodies: [Body; 2] = std::array::from_fn(|_| far_body(&mut rng, count, size));
        let far = match rng.random_range(0..3) {
            0 => 0.0,
            _ => random_power_of_ten(&mut rng, 0.0, 6.0),
        };
        let world = random_direction(&mut rng) * far;
        let duration = random_power_of_ten(&mut rng, -3.0, 3.0);
        let motions = [(); 2].map(|()| random_motion(&mut rng, world, size, duration));
        worst.far_problem_count +=
            usize::from(far > 1e5 || bodies[0].tree().max_distance_from_origin > 1e5);
        worst.turning_problem_count +=
            usize::from(motions[0].angular_velocity().length() * duration > 100.0);
        let moving = |k: usize| MovingBody::from((&bodies[k], motions[k]));
        let problem =
            Problem::of_moving_bodies(moving(0), moving(1), duration, &Settings::DEFAULT).unwrap();
        for _ in 0..4 {
            let s = rng.random_range(0.0..1.0);
            compare_with_exact(&mut rng, &problem, &motions, duration, s, &mut worst);
        }
    }
    assert!(
        worst.far_problem_count > 500 && worst.turning_problem_count > 500,
        "{worst:?}"
    );
    assert!(worst.position < 1.0, "{worst:?}");
    assert!(worst.gap < 1.0, "{worst:?}");
    assert!(worst.distance < 1.0, "{worst:?}");
}

/// Tests the rounding of positions on motions whose velocities are derived from given poses at both ends.
#[test]
fn rounding_of_motions_between_poses_is_allowed_for() {
    let mut rng = rng(6);
    let mut worst = 0.0f64;
    for _ in 0..4_000 {
        let world = random_direction(&mut rng) * random_power_of_ten(&mut rng, 0.0, 11.9);
        let size = random_power_of_ten(&mut rng, -3.0, 3.0);
        let duration = random_power_of_ten(&mut rng, -3.0, 3.0);
        let bodies: [Body; 2] = std::array::from_fn(|_| far_body(&mut rng, 1, size));
        let ends = [(); 2].map(|()| ends(&mut rng, world, size));
        let motions = ends.map(|ends| between(&ends, duration));
        let moving = |k: usize| MovingBody::from((&bodies[k], motions[k]));
        let problem =
            Problem::of_moving_bodies(moving(0), moving(1), duration, &Settings::DEFAULT).unwrap();
        let origin = DoubleDouble3::from(ends[1].positions[0]);
        for k in 0..2 {
            let s = rng.random_range(0.0..1.0);
            let side = [&problem.a, &problem.b][k];
            for &p in bodies[k].pieces().points() {
                let exact = ends[k].place(DoubleDouble::from(s), p) - origin;
                let off =
                    (DoubleDouble3::from(side.path.frame(s).transform_point(p)) - exact).length();
                worst = greater(worst, off.get() / problem.rounding);
            }
        }
    }
    assert!(worst < 1.0, "{worst}");
}

fn far_body(rng: &mut impl RngExt, count: usize, size: f64) -> Body {
    let look = SoupKind::ALL[rng.random_range(0..5)];
    let offset = match rng.random_range(0..3) {
        0 => 0.0,
        _ => random_power_of_ten(rng, 0.0, 6.0),
    };
    let middle = random_direction(rng) * offset;
    let triangles = random_triangle_soup(rng, look, count, size);
    let moved: Vec<_> = triangles.iter().map(|t| t.map(|p| p + middle)).collect();
    body(&moved)
}

fn random_motion(rng: &mut impl RngExt, world: DVec3, size: f64, duration: f64) -> Motion {
    let start = Pose::new(
        world + random_point_in_ball(rng, size),
        random_rotation(rng),
    )
    .unwrap();
    let turn = match rng.random_range(0..4) {
        0 => 0.0,
        1 => random_power_of_ten(rng, -9.0, 0.0),
        2 => random_power_of_ten(rng, 0.0, 2.0),
        _ => random_power_of_ten(rng, 2.0, 6.0),
    };
    let travel = random_power_of_ten(rng, -3.0, 3.0) * size;
    let off = random_power_of_ten(rng, -1.0, 3.0) * size;
    Motion::about(
        start,
        random_direction(rng) * travel / duration,
        random_direction(rng) * turn / duration * 0.999,
        random_point_in_ball(rng, off),
    )
    .unwrap()
}

/// Compares positions, a support gap and a distance at one clock with the exact values, and records the largest errors
/// in `worst`.
fn compare_with_exact(
    rng: &mut Pcg64,
    problem: &Problem<'_>,
    motions: &[Motion; 2],
    duration: f64,
    s: f64,
    worst: &mut WorstErrorShares,
) {
    let of = error_shares(rng, problem, motions, duration, s);
    worst.position = greater(worst.position, of.position_error_share);
    worst.gap = greater(worst.gap, of.gap);
    worst.distance = greater(worst.distance, of.distance);
}

/// The errors of a position, a gap and a distance in one comparison with exact values, as shares of their bound.
#[derive(Clone, Copy, Debug, Default)]
struct ErrorShares {
    position_error_share: f64,
    gap: f64,
    distance: f64,
}

/// Returns the errors of positions, a support gap and a distance at one clock, as shares of the bound
/// [`distance_rounding`].
fn error_shares(
    rng: &mut impl RngExt,
    problem: &Problem<'_>,
    motions: &[Motion; 2],
    duration: f64,
    s: f64,
) -> ErrorShares {
    let mut shares = ErrorShares::default();
    let sides = [&problem.a, &problem.b];
    let frames = sides.map(|side| side.path.frame(s));
    let origin = DoubleDouble3::from(motions[1].start().translation());
    let pieces = sides.map(|side| {
        let all: &Pieces = side.body.pieces();
        let last = all.len() - 1;
        all.get(rng.random_range(0..=last))
    });
    let exact: [Vec<DoubleDouble3>; 2] = std::array::from_fn(|k| {
        let points = pieces[k].points.iter();
        points
            .map(|&p| place(&motions[k], duration, s, p) - origin)
            .collect()
    });
    for k in 0..2 {
        for (&p, &exact) in pieces[k].points.iter().zip(&exact[k]) {
            let off = (DoubleDouble3::from(frames[k].transform_point(p)) - exact).length();
            shares.position_error_share = greater(
                shares.position_error_share,
                error_fraction(off.get(), problem.rounding),
            );
        }
    }
    let pair = PiecePair {
        a: pieces[0],
        b: pieces[1],
        b_to_a: frames[0].transform_from(&frames[1]),
    };
    let [i, j] = [0, 1].map(|_| rng.random_range(0..3u32));
    let claim = Claim {
        axis: random_direction(rng),
        a: ConvexCombination::from_single_point(i),
        b: ConvexCombination::from_single_point(j),
    };
    let checked = separation::check_claim(&pair, &claim, problem.rounding);
    // A bound holds along any axis: the axis of this bound is the image of the claimed one in A's rounded frame.
    let along = |column: DVec3, by: f64| DoubleDouble3::from(column).scale(DoubleDouble::from(by));
    let (turn, n) = (frames[0].rotation, checked.axis);
    let axis = along(turn.x_axis, n.x) + along(turn.y_axis, n.y) + along(turn.z_axis, n.z);
    let axis = axis.unit();
    let heights = |points: &[DoubleDouble3]| -> Vec<DoubleDouble> {
        points.iter().map(|&p| axis.dot(p)).collect()
    };
    let lowest = heights(&exact[1])
        .into_iter()
        .reduce(DoubleDouble::min)
        .unwrap();
    let highest = heights(&exact[0])
        .into_iter()
        .reduce(DoubleDouble::max)
        .unwrap();
    let gap = (lowest - highest).get();
    let rounded = checked.lower + problem.rounding;
    shares.gap = error_fraction((rounded - gap).abs(), problem.rounding);
    let distance = (exact[1][j as usize] - exact[0][i as usize]).length();
    let rounded = DoubleDouble::from(checked.upper - problem.rounding);
    let off = (rounded - distance).get().abs();
    shares.distance = error_fraction(off, problem.rounding);
    shares
}

#[test]
fn rounding_grows_with_spans_turns_and_the_way_between() {
    let base = distance_rounding([1.0, 1.0], [0.0, 0.0], 1.0);
    assert!(base > 0.0 && base < 1e-13);
    for more in [
        distance_rounding([2.0, 1.0], [0.0, 0.0], 1.0),
        distance_rounding([1.0, 1.0], [0.0, 1.0], 1.0),
        distance_rounding([1.0, 1.0], [0.0, 0.0], 2.0),
    ] {
        assert!(more > base);
    }
}
