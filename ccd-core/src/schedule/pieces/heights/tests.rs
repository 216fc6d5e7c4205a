//! Bounds of many points at once against tracks of all of them.

mod worst;

use super::*;
use crate::body::Body;
use crate::body::polytope::Polytope;
use crate::config::Config;
use crate::motion::Motion;
use crate::motion::pose::Pose;
use crate::problem::{Moving, Problem};
use crate::tests::scene::{Pcg64, RngExt, direction, magnitude, rng, rotation, within};

/// 4 to 5,000 points: in space, on a ball, in a plane, on a line.
fn points(rng: &mut Pcg64, kind: usize, size: f64) -> Vec<DVec3> {
    let count = magnitude(rng, 0.6, 3.7) as usize;
    let [u, v] = [direction(rng), direction(rng)];
    let offset = direction(rng) * magnitude(rng, -3.0, 3.0);
    let place = |rng: &mut Pcg64| match kind {
        0 => within(rng, 1.0),
        1 => direction(rng),
        2 => u * rng.random_range(-1.0..1.0) + v * rng.random_range(-1.0..1.0),
        _ => u * rng.random_range(-1.0..1.0),
    };
    (0..count).map(|_| size * (offset + place(rng))).collect()
}

#[test]
fn many_points_are_bounded_like_all_of_them() {
    let mut rng = rng(31);
    let (mut tight, mut many) = ([0; 2], 0);
    for number in 0..600 {
        let size = magnitude(&mut rng, -6.0, 3.0);
        let polytope = Polytope {
            points: points(&mut rng, number % 4, size),
            ..Polytope::default()
        };
        let body = Body::polytope(polytope).unwrap();
        let spin = direction(&mut rng) * [0.0, magnitude(&mut rng, -6.0, 3.0)][number % 2];
        let velocity = direction(&mut rng) * magnitude(&mut rng, -3.0, 2.0) * size;
        let start = Pose::new(size * direction(&mut rng), rotation(&mut rng)).unwrap();
        let motion = Motion::about(start, velocity, spin, size * within(&mut rng, 2.0)).unwrap();
        let ball = Body::ball(0.1).unwrap();
        let (moving, still) = (
            Moving {
                body: &body,
                motion,
            },
            Moving {
                body: &ball,
                motion: Motion::still(Pose::IDENTITY),
            },
        );
        let problem = Problem::new(moving, still, 1.0, &Config::default()).unwrap();
        let side = &problem.a;
        let frame = side.path.frame(rng.random_range(0.0..1.0));
        let normal = direction(&mut rng);
        let piece = body.piece(0);
        let bare = Piece {
            support: None,
            ..piece
        };
        let heights = Heights::new(side, &piece, &frame, normal);
        let twin = Heights::new(side, &bare, &frame, normal);
        many += usize::from(piece.ball().is_some());
        assert!(heights.speed() >= twin.speed() * (1.0 - 1e-15));
        // A ball about the points reaches no farther than that, except by its own slack.
        assert!(
            heights.speed() <= 1.5 * twin.speed(),
            "{} {}",
            heights.speed(),
            twin.speed()
        );
        // Rounding of heights about the centre, and of the positions that they are computed from.
        let span = problem.a.body.tree().span() + side.path.centre.length();
        let slack = 128.0 * crate::tolerance::U64 * (span + velocity.length());
        assert!((heights.least() - twin.least()).abs() <= slack);
        for tau in [0.0, 1e-9, 0.01, 0.3, 1.0] {
            let (bound, all) = (heights.bound(tau), twin.bound(tau));
            if piece.points.len() <= FEW {
                continue;
            }
            assert!(
                bound.height <= all.height + 1e-16 * span,
                "{bound:?} {all:?}"
            );
            assert!(
                bound.rate <= all.rate + 1e-15 * twin.speed(),
                "{bound:?} {all:?}"
            );
            assert!(bound.bend >= all.bend * (1.0 - 1e-14), "{bound:?} {all:?}");
            // Nothing is lost except rounding.
            assert!(
                bound.height >= all.height - 4.0 * slack,
                "{bound:?} {all:?}"
            );
            assert!(bound.rate >= all.rate - 4.0 * slack * (1.0 + side.path.rate));
            let turns = side.path.rate > 0.0;
            tight[usize::from(turns)] += usize::from(bound.bend <= 2.0 * all.bend);
        }
    }
    assert!(many > 200, "{many}");
    assert!(tight.into_iter().all(|count| count > 900), "{tight:?}");
}
