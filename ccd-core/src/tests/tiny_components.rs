//! Tests that a body which approaches a needle keeps the margin, for needles so thin that the squares of their widths
//! underflow.

use super::nearest::nearest_points;
use super::oracle::ExhaustiveOracle;
use super::scene::{
    Pcg64, RngExt, body, random_direction, random_point_in_ball, random_power_of_ten, rng,
};
use crate::answer::{Outcome, Unresolved};
use crate::body::Body;
use crate::engine::answer::EngineSchedule;
use crate::math::order::lesser;
use crate::math::vector::unit;
use crate::motion::Motion;
use crate::motion::pose::Pose;
use crate::problem::Problem;
use crate::query::MovingBody;
use crate::schedule::BestFirst;
use crate::settings::Settings;
use glam::DVec3;

/// Draws a vector of integers from −2 to 2 that is not zero.
fn random_whole_vector(rng: &mut Pcg64) -> DVec3 {
    let v = DVec3::from_array([(); 3].map(|()| f64::from(rng.random_range(-2..3))));
    if v == DVec3::ZERO { DVec3::X } else { v }
}

/// Draws triangles of tiny width that share a corner, and returns them with the unit normal of the first.
fn random_needles_and_normal(rng: &mut Pcg64) -> (Vec<[DVec3; 3]>, DVec3) {
    let width = random_power_of_ten(rng, -162.0, -161.0);
    let count = rng.random_range(1..4);
    let needle = |rng: &mut Pcg64| {
        let along = random_whole_vector(rng);
        [
            DVec3::ZERO,
            along,
            random_whole_vector(rng).cross(along) * width,
        ]
    };
    let all: Vec<_> = (0..count).map(|_| needle(rng)).collect();
    let normal = unit(all[0][1])
        .zip(unit(all[0][2]))
        .map(|(e, f)| e.cross(f));
    (all, normal.unwrap_or(DVec3::Z))
}

fn distance(problem: &Problem<'_>, s: f64) -> f64 {
    let place = |k: usize| {
        let side = [&problem.a, &problem.b][k];
        let frame = side.path.frame(s);
        let pieces = side.body.pieces();
        let placed = |k: usize| pieces.triangle(k).map(|p| frame.transform_point(p));
        (0..pieces.len()).map(placed).collect::<Vec<_>>()
    };
    let (a, b) = (place(0), place(1));
    let pairs = a
        .iter()
        .flat_map(|x| b.iter().map(|y| nearest_points(x, y).distance));
    pairs.fold(f64::INFINITY, lesser)
}

#[test]
fn margins_are_kept_from_needles_of_widths_that_have_no_square() {
    let mut rng = rng(51);
    let (mut hits, mut misses, mut open) = (0, 0, 0);
    for number in 0..4_000 {
        let (needles, normal) = random_needles_and_normal(&mut rng);
        let size = random_power_of_ten(&mut rng, -2.0, -0.5);
        let passer = [(); 3].map(|()| random_point_in_ball(&mut rng, size));
        let bodies: [Body; 2] = [body(&needles), body(&[passer])];
        let goal = needles[0][1] * rng.random_range(0.0..1.0) + random_point_in_ball(&mut rng, 0.1);
        let way = [normal, random_direction(&mut rng)][rng.random_range(0..2)];
        let start = Pose::at(goal - way * rng.random_range(1.0..3.0)).unwrap();
        let motion = Motion::new(start, way * rng.random_range(1.0..4.0), DVec3::ZERO).unwrap();
        let config = Settings {
            tolerance: random_power_of_ten(&mut rng, -9.0, -3.0),
            margin: random_power_of_ten(&mut rng, -1.0, 0.0),
            ..Settings::DEFAULT
        };
        let moving =
            |k: usize| MovingBody::from((&bodies[k], [Motion::still(Pose::IDENTITY), motion][k]));
        let problem = Problem::of_moving_bodies(moving(0), moving(1), 1.0, &config).unwrap();
        let outcome = BestFirst::default()
            .answer_first_contact(&problem, &mut ExhaustiveOracle)
            .outcome;
        let (until, least) = match outcome {
            Outcome::Contact { time, .. } => {
                hits += 1;
                (time, problem.margin)
            }
            Outcome::Free { proven_gap } => {
                misses += 1;
                (1.0, proven_gap)
            }
            // The slow oracle squares tiny numbers, and returns poor axes.
            Outcome::Unresolved(Unresolved { safe_until, .. }) => {
                open += 1;
                (safe_until, problem.margin)
            }
            Outcome::Touching { .. } => continue,
            outcome => panic!("{number}: {outcome:?}"),
        };
        for k in 0..=64 {
            let found = distance(&problem, until * f64::from(k) / 64.0);
            assert!(
                found >= least - problem.rounding,
                "{number}: {found} {outcome:?}"
            );
        }
    }
    assert!(
        hits > 500 && misses > 500 && open < 400,
        "{hits} {misses} {open}"
    );
}
