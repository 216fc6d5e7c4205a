//! Tests of bounds against the oracle.

use super::*;
use crate::gjk::Gjk;
use ccd_core::{DistanceOracle, Frame, Piece, PiecePair};
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64;

/// Returns random points around a center.
fn random_points(random: &mut Pcg64, center: DVec3) -> Vec<DVec3> {
    let count = random.random_range(1..20);
    let mut coordinate = || random.random_range(-1.0..1.0);
    let mut point = || DVec3::new(coordinate(), coordinate(), coordinate());
    (0..count).map(|_| center + point()).collect()
}

/// Tests on random pairs of hulls that the bounds contain the oracle's distance, and that a search ends with a required
/// bound, or with bounds that are equal up to rounding.
#[test]
fn bounds_contain_the_distance_and_reach_what_is_required() {
    let mut random = Pcg64::seed_from_u64(1);
    let (mut apart, mut near, mut exact) = (0, 0, 0);
    for _ in 0..3000 {
        let shift = random.random_range(0.0..4.0);
        let a = random_points(&mut random, DVec3::ZERO);
        let b = random_points(&mut random, shift * DVec3::X);
        let pair = PiecePair {
            a: Piece::from_points(&a),
            b: Piece::from_points(&b),
            b_to_a: Frame::IDENTITY,
        };
        let claim = Gjk.separation(&pair, &mut Default::default()).unwrap();
        let nearest = [claim.a.position(&a), claim.b.position(&b)].map(Option::unwrap);
        let distance = nearest[0].distance(nearest[1]);
        let support = |direction: DVec3| {
            let (a_index, b_index) = (
                pair.a.extremal_point(direction),
                pair.b.extremal_point(-direction),
            );
            let point = b[b_index as usize] - a[a_index as usize];
            Vertex {
                point,
                a: a_index,
                b: b_index,
            }
        };
        let lower = random.random_range(0.0..3.0);
        let required = TerminationBounds {
            sufficient_lower_bound: lower,
            sufficient_upper_bound: lower * random.random_range(0.0..1.0),
        };
        let first = DVec3::new(1.0, random.random_range(-1.0..1.0), 0.0);
        let found = bound_distance(support, first, |bounds| required.are_met_by(bounds));
        assert!(
            found.lower <= distance + 1e-12 && found.upper >= distance - 1e-12,
            "{found:?} {distance}"
        );
        if found.lower > required.sufficient_lower_bound {
            apart += 1;
        } else if found.upper <= required.sufficient_upper_bound {
            near += 1;
        } else {
            exact += 1;
            let lower = if found.lower > 0.0 { found.lower } else { 0.0 };
            assert!(found.upper - lower < 1e-7, "{found:?} {distance}");
        }
    }
    assert!(
        apart > 500 && near > 500 && exact > 200,
        "{apart} {near} {exact}"
    );
}

/// Tests that an axis without a direction ends the search with bounds that hold.
#[test]
fn an_axis_without_a_direction_gives_bounds_that_hold() {
    for axis in [DVec3::ZERO, DVec3::NAN, DVec3::INFINITY] {
        let support = |_: DVec3| Vertex {
            point: DVec3::X,
            a: 0,
            b: 0,
        };
        let required = TerminationBounds {
            sufficient_lower_bound: 0.5,
            sufficient_upper_bound: 0.0,
        };
        let found = bound_distance(support, axis, |bounds| required.are_met_by(bounds));
        assert!(
            !(found.lower > 1.0) && found.upper >= 1.0,
            "{axis}: {found:?}"
        );
    }
}
