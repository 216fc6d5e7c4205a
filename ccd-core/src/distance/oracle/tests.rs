//! Tests combinations of points, and oracles with a fallback.

use super::*;
use crate::tests::oracle::ConstantOracle;
use crate::tests::scene::{RngExt, random_point_in_ball, rng};

#[test]
fn terms_are_merged_dropped_and_capped() {
    let mut out = ConvexCombination::EMPTY;
    for weight in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        out.add_weighted_point(0, weight);
    }
    assert_eq!(out, ConvexCombination::EMPTY);
    assert!(out.point_indices().is_empty());
    for (index, weight) in [(4, 1.0), (7, 2.0), (4, 3.0), (0, 1.0), (1, 1.0), (9, 1.0)] {
        out.add_weighted_point(index, weight);
    }
    // The fifth distinct index was dropped.
    assert_eq!(out.point_indices(), [4, 7, 0, 1]);
    assert_eq!(ConvexCombination::from_single_point(3).point_indices(), [3]);
    assert_eq!(
        ConvexCombination::of_two_points([3, 5], 0.0).point_indices(),
        [3]
    );
    assert_eq!(
        ConvexCombination::of_two_points([3, 5], 1.0).point_indices(),
        [5]
    );
    assert_eq!(
        ConvexCombination::of_two_points([3, 3], 0.5).point_indices(),
        [3]
    );
}

#[test]
fn a_combination_names_a_point_of_the_hull() {
    let mut rng = rng(1);
    for _ in 0..1_000 {
        let points = [(); 4].map(|()| random_point_in_ball(&mut rng, 1e6));
        let weights = [(); 4].map(|()| rng.random_range(1e-3..1.0));
        let mut out = ConvexCombination::EMPTY;
        for (k, weight) in weights.into_iter().enumerate() {
            out.add_weighted_point(k as u32, weight);
        }
        let sum: f64 = weights.iter().sum();
        let exact: DVec3 = points
            .iter()
            .zip(weights)
            .map(|(&p, w)| p * (w / sum))
            .sum();
        assert!(out.position(&points).unwrap().distance(exact) < 1e-8);
        let half = ConvexCombination::of_two_points([0, 1], 0.5)
            .position(&points)
            .unwrap();
        assert!(half.distance(points[0].midpoint(points[1])) < 1e-9);
    }
    let points = [DVec3::ONE];
    assert_eq!(
        ConvexCombination::from_single_point(0).position(&points),
        Some(DVec3::ONE)
    );
    assert_eq!(
        ConvexCombination::from_single_point(1).position(&points),
        None
    );
    assert_eq!(
        ConvexCombination::of_two_points([0, 1], 0.5).position(&points),
        None
    );
    assert_eq!(ConvexCombination::EMPTY.position(&points), None);
}

fn ask<O: DistanceOracle>(oracle: &mut O) -> Result<Claim, GiveUpReason> {
    let points = [DVec3::ZERO];
    let piece = Piece::from_points(&points);
    let pair = PiecePair {
        a: piece,
        b: piece,
        b_to_a: Frame::IDENTITY,
    };
    oracle.separation(&pair, &mut O::Cache::default())
}

#[test]
fn the_second_oracle_is_asked_where_the_first_gives_up() {
    let claim = |axis| Claim {
        axis,
        a: ConvexCombination::from_single_point(0),
        b: ConvexCombination::from_single_point(0),
    };
    let (first, second) = (claim(DVec3::X), claim(DVec3::Y));
    let mut sure = ConstantOracle(Ok(first)).or_else(ConstantOracle(Ok(second)));
    assert_eq!(ask(&mut sure), Ok(first));
    assert_eq!(sure.fallbacks(), 0);
    let mut unsure = ConstantOracle(Err(GiveUpReason::Cycle)).or_else(ConstantOracle(Ok(second)));
    assert_eq!(ask(&mut unsure), Ok(second));
    assert_eq!(ask(&mut unsure), Ok(second));
    assert_eq!(unsure.fallbacks(), 2);
    let mut hopeless = ConstantOracle(Err(GiveUpReason::Cycle))
        .or_else(ConstantOracle(Err(GiveUpReason::StepCap)));
    assert_eq!(ask(&mut hopeless), Err(GiveUpReason::StepCap));
    // This is a chain of three oracles.
    let mut chain = ConstantOracle(Err(GiveUpReason::Cycle))
        .or_else(ConstantOracle(Err(GiveUpReason::StepCap)))
        .or_else(ConstantOracle(Ok(first)));
    assert_eq!(ask(&mut chain), Ok(first));
}
