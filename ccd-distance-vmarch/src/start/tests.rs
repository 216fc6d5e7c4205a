//! Tests which pair of features a march starts from, for valid, invalid and outdated caches.

use super::{Cache, extremal_pair};
use crate::feature::{Feature, Pair};
use crate::tests::setting::{
    cube, face_along, nearest_vertex, pair_with_b_moved, point, prepared_polytope,
};
use crate::tests::shape;
use ccd_core::glam::DVec3;
use rstest::rstest;

#[rstest]
#[case(Feature::Vertex(8), Feature::Vertex(0))]
#[case(Feature::Vertex(0), Feature::Edge(12))]
#[case(Feature::Face(6), Feature::Vertex(0))]
#[case(Feature::Face(0), Feature::Face(0))]
#[case(Feature::Edge(u32::MAX), Feature::Vertex(u32::MAX))]
fn invalid_states_are_no_start(#[case] a: Feature, #[case] b: Feature) {
    let cube = cube();
    let placed = pair_with_b_moved(&cube, &cube, DVec3::new(3.0, 2.5, 2.2));
    let corners = Pair {
        a: Feature::Vertex(nearest_vertex(&cube, DVec3::ONE)),
        b: Feature::Vertex(nearest_vertex(&cube, -DVec3::ONE)),
    };
    assert_eq!(Cache::default().start_features(&placed), corners);
    let mut cache = Cache::default();
    cache.store(&placed, Pair { a, b }, DVec3::ONE);
    assert_eq!(cache.start_features(&placed), corners);
}

/// Tests that a replaced polytope starts at a vertex along the last axis, while the unchanged one reuses its last
/// feature.
#[test]
fn a_part_is_begun_with_along_the_last_axis() {
    let (cube, point) = (cube(), point());
    let mut cache = Cache::default();
    let [far, near] = [DVec3::new(9.0, 0.1, 0.2), DVec3::new(2.0, 0.1, 0.2)];
    let pair = Pair {
        a: Feature::Face(face_along(&cube, DVec3::X)),
        b: Feature::Vertex(3),
    };
    cache.store(&pair_with_b_moved(&cube, &cube, far), pair, DVec3::X);
    let to_point = cache.start_features(&pair_with_b_moved(&cube, &point, near));
    assert_eq!((to_point.a, to_point.b), (pair.a, Feature::Vertex(0)));
    let from_point = cache.start_features(&pair_with_b_moved(&point, &cube, near));
    assert_eq!((from_point.a, from_point.b), (Feature::Vertex(0), pair.b));
    let larger = prepared_polytope(&shape::cuboid(DVec3::splat(1.5)));
    let start = cache.start_features(&pair_with_b_moved(&larger, &larger, near));
    let Pair {
        a: Feature::Vertex(v),
        b: Feature::Vertex(w),
    } = start
    else {
        panic!("{start:?}");
    };
    assert!(larger.vertex(v).point.x > 0.0 && larger.vertex(w).point.x < 0.0);
}

#[test]
fn the_nearest_features_are_the_next_start() {
    let cube = cube();
    let placed = pair_with_b_moved(&cube, &cube, 3.0 * DVec3::X);
    let pair = Pair {
        a: Feature::Face(3),
        b: Feature::Vertex(2),
    };
    let mut cache = Cache::default();
    cache.store(&placed, pair, DVec3::X);
    assert_eq!(cache.start_features(&placed), pair);
    assert!(size_of::<Cache>() <= 64);
}

#[test]
fn axes_are_turned_into_bs_frame() {
    let (one, other) = (
        cube(),
        prepared_polytope(&shape::cuboid(DVec3::new(0.5, 0.6, 0.7))),
    );
    let turn = ccd_core::glam::DQuat::from_rotation_z(1.2);
    let placed = crate::tests::setting::pair_with_placed_b(&one, &other, turn, 4.0 * DVec3::X);
    let axis = DVec3::new(1.0, 0.4, 0.2);
    let pair = extremal_pair(&placed, axis);
    let Feature::Vertex(b) = pair.b else {
        panic!("{pair:?}")
    };
    let height = |v: u32| axis.dot(turn * other.vertex(v).point);
    assert!((0..8).all(|v| height(b) <= height(v)));
}
