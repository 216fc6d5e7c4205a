//! Tests the features of claims, the refused pieces, and the common points of intersecting triangles.

use super::ClosedForm;
use super::nearest::{Corners, NearestPoints};
use super::pierce::nearest_with_edge_plane_intersections;
use ccd_core::glam::DVec3;
use ccd_core::schedule::VectorInstructions;
use ccd_core::{Claim, DistanceOracle, Frame, GiveUpReason, Piece, PiecePair};
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64;
use rstest::rstest;

const BASE_TRIANGLE: [DVec3; 3] = [
    DVec3::ZERO,
    DVec3::new(4.0, 0.0, 0.0),
    DVec3::new(0.0, 4.0, 0.0),
];

fn claim(a: &[DVec3], b: &[DVec3]) -> Result<Claim, GiveUpReason> {
    let pair = PiecePair {
        a: Piece::from_points(a),
        b: Piece::from_points(b),
        b_to_a: Frame::IDENTITY,
    };
    ClosedForm::default().separation(&pair, &mut ())
}

fn nearest_points(p: &Corners, q: &Corners) -> NearestPoints {
    super::nearest_points(VectorInstructions::Best.simd_level(), p, q)
}

fn vector(x: f64, y: f64, z: f64) -> DVec3 {
    DVec3::new(x, y, z)
}

/// Tests that claims use only the points of the nearest features, for instance a single point for a corner.
#[rstest]
#[case::corner_above_face([vector(1.0, 1.0, 1.0), vector(1.0, 2.0, 3.0), vector(2.0, 1.0, 3.0)], &[0, 1, 2], &[0])]
#[case::corner_beside_edge([vector(1.0, -1.0, 0.0), vector(1.0, -2.0, 1.0), vector(2.0, -2.0, 1.0)], &[0, 1], &[0])]
#[case::corner_beside_corner([vector(6.0, -1.0, 1.0), vector(7.0, -2.0, 1.0), vector(7.0, -1.0, 2.0)], &[1], &[0])]
#[case::crossed_edges([vector(1.0, -1.0, -1.0), vector(1.0, -1.0, 1.0), vector(1.0, -4.0, 0.0)], &[0, 1], &[0, 1])]
fn claims_name_the_nearest_features(
    #[case] b: [DVec3; 3],
    #[case] of_a: &[u32],
    #[case] of_b: &[u32],
) {
    let claim = claim(&BASE_TRIANGLE, &b).expect("triangles");
    let sorted = |support: &[u32]| {
        let mut support = support.to_vec();
        support.sort_unstable();
        support
    };
    assert_eq!(sorted(claim.a.point_indices()), of_a);
    assert_eq!(sorted(claim.b.point_indices()), of_b);
}

/// Tests that claims about segments and points use the indices of the pieces' own points.
#[test]
fn segments_and_points_keep_their_indices() {
    let segment = [vector(1.0, 1.0, 2.0), vector(1.0, 1.0, 1.0)];
    let claim = claim(&segment, &[vector(1.0, 1.0, 0.0)]).expect("a segment and a point");
    assert_eq!(
        (claim.a.point_indices(), claim.b.point_indices()),
        (&[1][..], &[0][..])
    );
    assert_eq!(claim.axis, -DVec3::Z);
}

#[test]
fn refuses_other_numbers_of_points() {
    let four = [DVec3::ZERO; 4];
    assert_eq!(
        claim(&four, &BASE_TRIANGLE),
        Err(GiveUpReason::TooManyPoints)
    );
    assert_eq!(
        claim(&BASE_TRIANGLE, &four),
        Err(GiveUpReason::TooManyPoints)
    );
    assert_eq!(claim(&BASE_TRIANGLE, &[]), Err(GiveUpReason::TooManyPoints));
}

/// Tests that a common point is found for triangles that intersect although their boundaries are far apart.
#[test]
fn finds_the_point_where_an_edge_passes_through() {
    let spear = [
        vector(1.0, 1.0, 5.0),
        vector(1.0, 1.0, -5.0),
        vector(1.1, 1.1, 5.0),
    ];
    let near = nearest_points(&BASE_TRIANGLE, &spear);
    assert!(near.separation_vector(&BASE_TRIANGLE, &spear).length() > 0.9);
    let common = nearest_with_edge_plane_intersections(&BASE_TRIANGLE, &spear, near);
    assert!(common.separation_vector(&BASE_TRIANGLE, &spear).length() < 1e-15);
    // From either side.
    let near = nearest_points(&spear, &BASE_TRIANGLE);
    let common = nearest_with_edge_plane_intersections(&spear, &BASE_TRIANGLE, near);
    assert!(common.separation_vector(&spear, &BASE_TRIANGLE).length() < 1e-15);
}

/// Tests that no common point is found for a triangle that crosses the other triangle's plane outside of the face.
#[test]
fn does_not_pierce_outside_of_the_face() {
    let spear = [
        vector(9.0, 9.0, 5.0),
        vector(9.0, 9.0, -5.0),
        vector(9.1, 9.1, 5.0),
    ];
    let near = nearest_points(&BASE_TRIANGLE, &spear);
    let before = near.separation_vector(&BASE_TRIANGLE, &spear).length();
    let after = nearest_with_edge_plane_intersections(&BASE_TRIANGLE, &spear, near)
        .separation_vector(&BASE_TRIANGLE, &spear)
        .length();
    assert!((after - before).abs() < 1e-14);
}

#[test]
fn all_instructions_give_the_same_bits() {
    let mut rng = Pcg64::seed_from_u64(1);
    let mut near = 0;
    for _ in 0..20_000 {
        // Some pairs touch, or lie in one plane: the axis is then computed from features.
        let flat = rng.random_bool(0.2);
        let mut triangle = |height: f64| {
            [(); 3].map(|()| {
                let [x, y, z] = [(); 3].map(|()| rng.random_range(-1.0..1.0));
                vector(x, y, if flat { height } else { z + height })
            })
        };
        let (a, b) = (triangle(0.0), triangle(if flat { 1e-13 } else { 1.0 }));
        let pair = PiecePair {
            a: Piece::from_points(&a),
            b: Piece::from_points(&b),
            b_to_a: Frame::IDENTITY,
        };
        let claim = |set| ClosedForm::new(set).separation(&pair, &mut ());
        let best = claim(VectorInstructions::Best).expect("triangles");
        assert_eq!(Ok(best), claim(VectorInstructions::Baseline));
        near += usize::from(best.axis.length() < 1e-6 || flat);
    }
    assert!(near > 2_000, "{near}");
}
