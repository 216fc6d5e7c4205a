//! Tests that a march from any pair of features ends at the nearest pair.

use super::march;
use crate::counters::Counters;
use crate::feature::Pair;
use crate::polytope::Polytope;
use crate::termination::MarchEnd;
use crate::tests::setting::{cube, features, needle, pair_with_placed_b, point, prepared_polytope};
use crate::tests::shape;
use crate::witness::Witness;
use ccd_core::glam::{DQuat, DVec3};

fn shapes() -> [Polytope; 9] {
    [
        cube(),
        prepared_polytope(&shape::cuboid(DVec3::new(0.3, 0.8, 1.4)).triangulated()),
        prepared_polytope(&shape::hull(&[DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::Z])),
        prepared_polytope(&shape::prism(5)),
        prepared_polytope(&shape::antiprism(4)),
        prepared_polytope(&shape::polygon(5)),
        prepared_polytope(&shape::shape_of_points(&[DVec3::ZERO, DVec3::X, DVec3::Y])),
        needle(DVec3::new(0.5, 0.3, 0.1)),
        point(),
    ]
}

/// Tests that the march ends at the same distance, whatever pair of features it starts from.
#[test]
fn every_start_leads_to_the_nearest_features() {
    let shapes = shapes();
    let turns = [
        DQuat::IDENTITY,
        DQuat::from_rotation_x(1e-9),
        DQuat::from_rotation_y(0.5 * std::f64::consts::PI),
        DQuat::from_euler(ccd_core::glam::EulerRot::XYZ, 0.3, 0.9, -1.7),
    ];
    let ways = [
        3.5 * DVec3::X,
        DVec3::new(2.0, 2.0, 2.0),
        DVec3::new(0.1, 0.2, -3.1),
        DVec3::new(2.1, -1.0, 2.1),
    ];
    let (mut starts, mut others) = (0, 0);
    for one in &shapes {
        for other in &shapes {
            for (turn, offset) in turns
                .iter()
                .zip(ways)
                .chain(turns.iter().zip(ways.into_iter().rev()))
            {
                let placed = pair_with_placed_b(one, other, *turn, offset);
                let mut least: Option<f64> = None;
                for a in features(one) {
                    for b in features(other) {
                        let mut counters = Counters::default();
                        let end = march(&placed, Pair { a, b }, &mut counters);
                        starts += 1;
                        let MarchEnd::Nearest(pair, _) = end else {
                            // A later step makes a claim for these.
                            others += 1;
                            continue;
                        };
                        let distance = Witness::new(&placed, pair).distance();
                        let first = *least.get_or_insert(distance);
                        assert!(
                            (distance - first).abs() < 1e-14,
                            "{pair:?}: {distance} {first}"
                        );
                    }
                }
                assert!(least.is_some());
            }
        }
    }
    assert!(
        starts > 150_000 && others * 1000 < starts,
        "{others} of {starts}"
    );
}
