//! Tests the bounds that come from true and from false claims.

use super::sharp::improve_axis;
use super::*;
use crate::body::Body;
use crate::body::piece::ConvexCombination;
use crate::body::piece::Piece;
use crate::body::support::SupportMap;
use crate::distance::oracle::DistanceOracle;
use crate::motion::pose::{Frame, Pose};
use crate::tests::nearest::{Triangle, nearest_points};
use crate::tests::oracle::ExhaustiveOracle;
use crate::tests::scene::{
    self, Pcg64, RngExt, random_point_in_ball, random_power_of_ten, random_rotation, rng,
};

const ROUNDING: f64 = 1e-13;

/// Draws two triangles and the frame between them, and computes their exact distance.
fn random_triangle_pair(rng: &mut Pcg64) -> (Triangle, Triangle, Frame, f64) {
    let pair = scene::two_random_triangles(rng);
    let pose = Pose::new(random_point_in_ball(rng, 0.5), random_rotation(rng)).unwrap();
    let frame = Frame::from(pose);
    let distance = nearest_points(&pair[0], &pair[1].map(|p| frame.transform_point(p))).distance;
    (pair[0], pair[1], frame, distance)
}

fn random_claim(rng: &mut Pcg64) -> Claim {
    let mut numbers = || match rng.random_range(0..6) {
        0 => f64::NAN,
        1 => f64::INFINITY,
        2 => 0.0,
        3 => -1.0,
        4 => random_power_of_ten(rng, -300.0, 300.0),
        _ => rng.random_range(-1.0..1.0),
    };
    let axis = DVec3::new(numbers(), numbers(), numbers());
    let weights: [f64; 6] = std::array::from_fn(|_| numbers());
    let mut combinations = weights.chunks(3).map(|weights| {
        let mut out = ConvexCombination::EMPTY;
        for &weight in weights {
            out.add_weighted_point(rng.random_range(0..4), weight);
        }
        out
    });
    Claim {
        axis,
        a: combinations.next().unwrap(),
        b: combinations.next().unwrap(),
    }
}

#[test]
fn bounds_hold_for_any_claim() {
    let mut rng = rng(1);
    let mut replaced = 0;
    for _ in 0..50_000 {
        let (a, b, b_to_a, distance) = random_triangle_pair(&mut rng);
        let pair = PiecePair {
            a: Piece::from_points(&a),
            b: Piece::from_points(&b),
            b_to_a,
        };
        let claim = random_claim(&mut rng);
        let checked = check_claim(&pair, &claim, ROUNDING);
        assert!(
            checked.lower <= distance,
            "{} > {distance}: {claim:?}",
            checked.lower
        );
        assert!(
            checked.upper >= distance,
            "{} < {distance}: {claim:?}",
            checked.upper
        );
        assert!((checked.axis.length() - 1.0).abs() < 1e-15, "{claim:?}");
        let between = checked.witness_a.distance(checked.witness_b);
        assert!((between - checked.claimed_core_distance).abs() < 1e-14);
        // The features consist of points that exist.
        for (combination, points) in [(checked.claim.a, a), (checked.claim.b, b)] {
            assert!(combination.position(&points).is_some());
        }
        replaced += usize::from(checked.claim.a != claim.a);
    }
    assert!(replaced > 5_000, "{replaced}");
}

#[test]
fn a_true_claim_is_tight() {
    let mut rng = rng(2);
    let (mut apart, mut across) = (0, 0);
    for _ in 0..10_000 {
        let (a, b, b_to_a, distance) = random_triangle_pair(&mut rng);
        let pair = PiecePair {
            a: Piece::from_points(&a),
            b: Piece::from_points(&b),
            b_to_a,
        };
        let claim = ExhaustiveOracle.separation(&pair, &mut ()).unwrap();
        let checked = check_claim(&pair, &claim, ROUNDING);
        assert!(checked.upper <= distance + 3.0 * ROUNDING);
        if distance > 1e-3 {
            assert!(
                checked.lower >= distance - 1e-9,
                "{} {distance}",
                checked.lower
            );
            apart += 1;
        } else {
            across += 1;
        }
    }
    assert!(apart > 5_000 && across > 300, "{apart} {across}");
}

/// Tests that weights whose sum overflows do not make distant pieces touch.
#[test]
fn overflowing_weights_are_a_false_claim() {
    let a = [DVec3::ZERO, DVec3::X, DVec3::Y];
    let b = a.map(|p| p + 5.0 * DVec3::Z);
    let pair = PiecePair {
        a: Piece::from_points(&a),
        b: Piece::from_points(&b),
        b_to_a: Frame::IDENTITY,
    };
    for weight in [f64::MAX, 1e308, 5e-324, 1e-310] {
        let mut lie = ConvexCombination::EMPTY;
        for (index, share) in [(0, 1.0), (1, 0.7), (2, 0.9), (1, 1.0)] {
            lie.add_weighted_point(index, weight * share);
        }
        let claim = Claim {
            axis: DVec3::Z,
            a: lie,
            b: lie,
        };
        let checked = check_claim(&pair, &claim, ROUNDING);
        assert!(checked.upper >= 5.0, "{weight:e}: {}", checked.upper);
        assert!(checked.witness_a.is_finite(), "{weight:e}");
        // The point is in the triangle's hull.
        let at = checked.witness_a;
        assert!(
            at.min_element() >= 0.0 && at.x + at.y <= 1.0 + 1e-12,
            "{weight:e}: {at}"
        );
    }
}

#[test]
fn radii_are_subtracted_and_witnesses_are_on_the_surface() {
    let (a, b) = ([DVec3::ZERO], [3.0 * DVec3::X]);
    let ball = |points, radius| Piece {
        radius,
        ..Piece::from_points(points)
    };
    let pair = PiecePair {
        a: ball(&a, 1.0),
        b: ball(&b, 0.5),
        b_to_a: Frame::IDENTITY,
    };
    let claim = Claim {
        axis: DVec3::X,
        a: ConvexCombination::from_single_point(0),
        b: ConvexCombination::from_single_point(0),
    };
    let checked = check_claim(&pair, &claim, 0.0);
    assert_eq!((checked.lower, checked.upper), (1.5, 1.5));
    assert_eq!(checked.witness_a, DVec3::X);
    assert_eq!(checked.witness_b, 2.5 * DVec3::X);
    assert_eq!(checked.claimed_core_distance, 3.0);
}

/// Checks that `improve_axis` raises the lower bound of a tilted claim to the distance, and returns whether the bound
/// was poor before.
fn check_axis_improvement(pair: &PiecePair<'_>, tilted: &Claim, distance: f64) -> bool {
    let checked = check_claim(pair, tilted, ROUNDING);
    let CheckedClaim {
        lower,
        axis,
        witness_a,
        ..
    } = improve_axis(pair, &checked, ROUNDING);
    // The bound was computed along this axis.
    assert_eq!(support_gap(pair, axis, witness_a) - ROUNDING, lower);
    assert!(lower <= distance, "{lower} {distance}");
    assert!(lower >= distance - 2.0 * ROUNDING, "{:e}", distance - lower);
    checked.lower < distance - 10.0 * ROUNDING
}

/// Tests that features give better axes than the rounded vector between nearest points, for large triangles close to
/// each other.
#[test]
fn features_have_better_axes_than_near_points() {
    let mut rng = rng(3);
    let floor = [[-8.0, -8.0, 0.0], [8.0, -8.0, 0.0], [0.0, 8.0, 0.0]].map(DVec3::from);
    let corner = [[0.0, 0.0, 0.0], [8.0, 1.0, 16.0], [-8.0, 1.0, 16.0]].map(DVec3::from);
    let edge = [[-8.0, 0.0, 0.0], [8.0, 0.0, 0.0], [0.0, 0.0, 16.0]].map(DVec3::from);
    let below = |triangle: Triangle| triangle.map(|p| DVec3::new(p.y, p.x, -p.z));
    let couples = [(floor, corner), (below(edge), edge), (below(corner), floor)];
    let mut poor = 0;
    for k in 0..3_000 {
        let distance = random_power_of_ten(&mut rng, -4.0, -1.0);
        let (a, b) = couples[k % 3];
        let b_to_a = Frame::from(Pose::new(DVec3::ZERO, random_rotation(&mut rng)).unwrap());
        let b = b.map(|p| b_to_a.inverse_transform_vector(p + distance * DVec3::Z));
        let pair = PiecePair {
            a: Piece::from_points(&a),
            b: Piece::from_points(&b),
            b_to_a,
        };
        let claim = ExhaustiveOracle.separation(&pair, &mut ()).unwrap();
        let tilted = Claim {
            axis: DVec3::Z + random_point_in_ball(&mut rng, 1e-11),
            ..claim
        };
        poor += usize::from(check_axis_improvement(&pair, &tilted, distance));
    }
    assert!(poor > 2_000, "{poor}");
}

/// Tests that a facet of a box gives the best axis towards a corner above it. The claim names the nearest point of the
/// box by two corners across the face, which are no edge, or as one of the face's corners, which is a corner of other
/// faces too.
#[test]
fn facets_have_better_axes_than_corners_across_them() {
    let mut rng = rng(4);
    let base = Body::cuboid([4.0, 4.0, 1.0]).unwrap();
    let base = base.pieces().get(0);
    let top = |x: f64| base.points.iter().position(|p| *p == DVec3::new(x, x, 1.0));
    let [low, high] = [-4.0, 4.0].map(|x| top(x).unwrap() as u32);
    let mut poor = 0;
    let claims: [&[u32]; 2] = [&[low, high], &[low]];
    for corners in claims.repeat(500) {
        let distance = random_power_of_ten(&mut rng, -4.0, 1.0);
        let tip = [[0.0, 0.0, 0.0], [8.0, 1.0, 4.0], [-8.0, 1.0, 4.0]].map(DVec3::from);
        let tip = tip.map(|p| p + (1.0 + distance) * DVec3::Z);
        let a_to_b = Frame::from(Pose::new(DVec3::ZERO, random_rotation(&mut rng)).unwrap());
        let turned = base
            .points
            .iter()
            .map(|&p| a_to_b.inverse_transform_vector(p));
        let turned: Vec<DVec3> = turned.collect();
        let b = Piece {
            points: &turned,
            ..base
        };
        let pair = PiecePair {
            a: Piece::from_points(&tip),
            b,
            b_to_a: a_to_b,
        };
        let mut across = ConvexCombination::default();
        for &corner in corners {
            across.add_weighted_point(corner, 1.0 / corners.len() as f64);
        }
        let tilted = Claim {
            axis: -DVec3::Z + random_point_in_ball(&mut rng, 1e-9),
            a: ConvexCombination::from_single_point(0),
            b: across,
        };
        poor += usize::from(check_axis_improvement(&pair, &tilted, distance));
    }
    assert!(poor > 900, "{poor}");
}

/// Tests that the search for extremal points of large pieces gives the same gap as a scan of all points.
#[test]
fn searches_for_extremal_points_change_no_gap() {
    let mut rng = rng(5);
    let round = |rng: &mut Pcg64| -> Vec<DVec3> {
        let middle = random_point_in_ball(rng, 2.0);
        (0..100)
            .map(|_| middle + scene::random_direction(rng))
            .collect()
    };
    let mut apart = 0;
    for _ in 0..500 {
        let points = [round(&mut rng), round(&mut rng)];
        let supports = [0, 1].map(|k| SupportMap::from_points(&points[k]));
        let pose = Pose::new(
            random_point_in_ball(&mut rng, 3.0),
            random_rotation(&mut rng),
        )
        .unwrap();
        let pair = |is_searched: bool| {
            let [a, b] = [0, 1].map(|k| Piece {
                support_map: is_searched.then_some(&supports[k]),
                ..Piece::from_points(&points[k])
            });
            let b_to_a = Frame::from(pose);
            PiecePair { a, b, b_to_a }
        };
        let [n, from] = [
            scene::random_direction(&mut rng),
            random_point_in_ball(&mut rng, 3.0),
        ];
        let scanned = support_gap(&pair(false), n, from);
        let searched = support_gap(&pair(true), n, from);
        assert!(
            (scanned - searched).abs() < ROUNDING,
            "{scanned} {searched}"
        );
        apart += usize::from(scanned > 0.0);
    }
    assert!(apart > 20, "{apart}");
}

/// Tests that a claim has a good lower bound even if either its axis or its points are wrong.
#[test]
fn the_better_one_of_axis_and_way_counts() {
    let mut rng = rng(6);
    let mut apart = 0;
    for _ in 0..2_000 {
        let (a, b, b_to_a, distance) = random_triangle_pair(&mut rng);
        if distance < 1e-2 {
            continue;
        }
        apart += 1;
        let radius = 0.1 * distance;
        let round = |points| Piece {
            radius,
            ..Piece::from_points(points)
        };
        let pair = PiecePair {
            a: round(&a),
            b: round(&b),
            b_to_a,
        };
        let right = ExhaustiveOracle.separation(&pair, &mut ()).unwrap();
        let corner = ConvexCombination::from_single_point(0);
        let axis = scene::random_direction(&mut rng);
        let wrong_axis = check_claim(&pair, &Claim { axis, ..right }, ROUNDING);
        let points = Claim {
            a: corner,
            b: corner,
            ..right
        };
        let wrong_points = check_claim(&pair, &points, ROUNDING);
        // An axis that proves half of the distance is good enough.
        for (checked, share) in [(wrong_axis, 0.5), (wrong_points, 1.0)] {
            assert!(checked.lower >= share * distance - 2.0 * radius - 1e-9);
            // The witnesses are on the surfaces, on the line between the points, whatever the axis.
            let between = checked.witness_a.distance(checked.witness_b);
            assert!((between - (checked.claimed_core_distance - 2.0 * radius)).abs() < 1e-13);
        }
    }
    assert!(apart > 500, "{apart}");
}

/// Tests that the witnesses of coinciding nearest points lie on the rounded surfaces, along the claimed axis.
#[test]
fn witnesses_of_coinciding_points_are_along_the_axis() {
    let points = [DVec3::ZERO];
    let round = Piece {
        radius: 2.0,
        ..Piece::from_points(&points)
    };
    let pair = PiecePair {
        a: round,
        b: round,
        b_to_a: Frame::IDENTITY,
    };
    let claim = Claim {
        axis: 3.0 * DVec3::Y,
        a: ConvexCombination::from_single_point(0),
        b: ConvexCombination::from_single_point(0),
    };
    let checked = check_claim(&pair, &claim, ROUNDING);
    assert_eq!(checked.witness_a, 2.0 * DVec3::Y);
    assert_eq!(checked.witness_b, -2.0 * DVec3::Y);
}
