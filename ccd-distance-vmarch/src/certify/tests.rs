//! Tests that every march that ended without a certain result is certified afterwards.

use super::certify_march_end;
use crate::counters::Counters;
use crate::feature::{Certainty, Feature, Pair};
use crate::placed::{PlacedPair, PlacedPolytope};
use crate::termination::MarchEnd;
use crate::tests::setting::{
    cube, features, needle, pair_with_b_moved, pair_with_placed_b, point, prepared_polytope,
};
use crate::tests::shape;
use crate::tolerance::MIN_CERTAIN_DISTANCE_RATIO;
use crate::witness::Witness;
use ccd_core::GiveUpReason;
use ccd_core::glam::{DQuat, DVec3};

/// Checks that a march that ends in any way, at any pair of features, is certified at the distance `truth`.
fn certifies(placed: &PlacedPair<'_>, a: &shape::Shape, b: &shape::Shape, truth: f64) {
    let place = |p: DVec3| {
        placed
            .b
            .transform_point(p - placed.b.shape().origin_in_piece)
    };
    for one in features(placed.a.0) {
        for other in features(placed.b.shape()) {
            if matches!((one, other), (Feature::Face(_), Feature::Face(_))) {
                continue;
            }
            let pair = Pair { a: one, b: other };
            // A stop is only examined if rounding could hide a nearer pair.
            let close = Witness::new(placed, pair).distance()
                < MIN_CERTAIN_DISTANCE_RATIO * placed.scale.size;
            let tie = close.then_some(MarchEnd::Nearest(pair, Certainty::Tied));
            let ends = [
                MarchEnd::Cycle(pair),
                MarchEnd::StepLimit(pair),
                MarchEnd::Unclear(pair),
            ];
            for end in ends.into_iter().chain(tie) {
                let mut counters = Counters::default();
                let answer = certify_march_end(placed, end, &mut counters);
                let (_, claim) = answer.unwrap_or_else(|why| panic!("{why:?} from {end:?}"));
                let on_a =
                    claim.a.position(&a.points).expect("a point of A") - placed.a.0.origin_in_piece;
                let on_b = place(claim.b.position(&b.points).expect("a point of B"));
                let distance = on_a.distance(on_b);
                assert!(
                    (distance - truth).abs() < 1e-14,
                    "{distance}, not {truth}, from {end:?}"
                );
            }
        }
    }
}

#[test]
fn every_end_is_certified() {
    let shapes = [shape::cuboid(DVec3::ONE), shape::antiprism(3)];
    let truths = [
        (DVec3::new(3.0, 0.0, 0.0), 1.0),
        (DVec3::new(3.0, 4.0, 0.0), 5f64.sqrt()),
    ];
    let cube = prepared_polytope(&shapes[0]);
    for (at, truth) in truths {
        let placed = pair_with_b_moved(&cube, &cube, at);
        certifies(&placed, &shapes[0], &shapes[0], truth);
    }
    // Intersecting: one point.
    let other = prepared_polytope(&shapes[1]);
    let placed = pair_with_placed_b(
        &cube,
        &other,
        DQuat::from_rotation_x(0.4),
        DVec3::new(1.2, 0.3, 0.1),
    );
    certifies(&placed, &shapes[0], &shapes[1], 0.0);
}

#[test]
fn positions_that_are_not_finite_are_given_up() {
    let (cube, needle, point) = (cube(), needle(DVec3::X), point());
    for polytope in [&cube, &needle, &point] {
        let placed = pair_with_b_moved(&cube, polytope, DVec3::NAN);
        let pair = Pair {
            a: Feature::Vertex(0),
            b: Feature::Vertex(0),
        };
        let mut counters = Counters::default();
        let cycle = certify_march_end(&placed, MarchEnd::Cycle(pair), &mut counters);
        let cap = certify_march_end(&placed, MarchEnd::StepLimit(pair), &mut counters);
        assert!(matches!(cycle.err(), None | Some(GiveUpReason::Cycle)));
        assert!(matches!(cap.err(), None | Some(GiveUpReason::StepCap)));
        // An end reported as a cycle is counted as one.
        for end in [
            MarchEnd::Unclear(pair),
            MarchEnd::Nearest(pair, Certainty::Tied),
        ] {
            let mut counters = Counters::default();
            let why = certify_march_end(&placed, end, &mut counters).err();
            assert!(why != Some(GiveUpReason::Cycle) || counters.detected_cycles > 0);
        }
    }
}
