//! Caches of anything, and the table of directions.

use super::{Cache, SQUARES, Starts, extremal, middle_of, square_of};
use crate::feature::{Feature, Pair};
use crate::tests::setting::{cube, face, moved, point, prepared, vertex};
use crate::tests::shape::{self, Pcg64, SeedableRng, direction};
use ccd_core::glam::DVec3;
use ccd_core::order::greater;
use rstest::rstest;

#[rstest]
#[case(Feature::Vertex(8), Feature::Vertex(0))]
#[case(Feature::Vertex(0), Feature::Edge(12))]
#[case(Feature::Face(6), Feature::Vertex(0))]
#[case(Feature::Face(0), Feature::Face(0))]
#[case(Feature::Edge(u32::MAX), Feature::Vertex(u32::MAX))]
fn what_is_no_state_is_not_begun_with(#[case] a: Feature, #[case] b: Feature) {
    let cube = cube();
    let places = moved(&cube, &cube, DVec3::new(3.0, 2.5, 2.2));
    let corners = Pair {
        a: Feature::Vertex(vertex(&cube, DVec3::ONE)),
        b: Feature::Vertex(vertex(&cube, -DVec3::ONE)),
    };
    assert_eq!(Cache::default().start(&places), corners);
    let mut cache = Cache::default();
    cache.keep(&places, Pair { a, b }, DVec3::ONE);
    assert_eq!(cache.start(&places), corners);
}

/// What one polytope is no more, the other one may be still.
#[test]
fn a_part_is_begun_with_along_the_last_axis() {
    let (cube, point) = (cube(), point());
    let mut cache = Cache::default();
    let [far, near] = [DVec3::new(9.0, 0.1, 0.2), DVec3::new(2.0, 0.1, 0.2)];
    let pair = Pair {
        a: Feature::Face(face(&cube, DVec3::X)),
        b: Feature::Vertex(3),
    };
    cache.keep(&moved(&cube, &cube, far), pair, DVec3::X);
    let to_point = cache.start(&moved(&cube, &point, near));
    assert_eq!((to_point.a, to_point.b), (pair.a, Feature::Vertex(0)));
    let from_point = cache.start(&moved(&point, &cube, near));
    assert_eq!((from_point.a, from_point.b), (Feature::Vertex(0), pair.b));
    let larger = prepared(&shape::cuboid(DVec3::splat(1.5)));
    let start = cache.start(&moved(&larger, &larger, near));
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
fn what_was_nearest_is_begun_with() {
    let cube = cube();
    let places = moved(&cube, &cube, 3.0 * DVec3::X);
    let pair = Pair {
        a: Feature::Face(3),
        b: Feature::Vertex(2),
    };
    let mut cache = Cache::default();
    cache.keep(&places, pair, DVec3::X);
    assert_eq!(cache.start(&places), pair);
    assert!(size_of::<Cache>() <= 64);
}

#[test]
fn directions_are_in_the_square_whose_middle_is_near() {
    for square in 0..6 * SQUARES * SQUARES {
        for scale in [1e-150, 1.0, 1e150] {
            assert_eq!(square_of(middle_of(square) * scale), square);
        }
    }
    let mut rng = Pcg64::seed_from_u64(1);
    for _ in 0..10_000 {
        let look = direction(&mut rng);
        let angle = look.angle_between(middle_of(square_of(look)));
        // Half the diagonal of a square in the middle of a side.
        assert!(angle <= 0.36, "{angle}");
    }
    for nonsense in [DVec3::NAN, DVec3::ZERO, DVec3::INFINITY] {
        assert!(square_of(nonsense) < 6 * SQUARES * SQUARES);
    }
}

#[test]
fn climbing_from_the_table_finds_the_extremal_corner() {
    let mut rng = Pcg64::seed_from_u64(2);
    for shape in [
        shape::globe(9, 16),
        shape::prism(40),
        shape::random_hull(&mut rng, 40),
    ] {
        let polytope = prepared(&shape);
        assert!(polytope.starts.is_some());
        for _ in 0..2_000 {
            let look = direction(&mut rng);
            let height = |v: &crate::polytope::Vertex| look.dot(v.point);
            let highest = polytope.vertices.iter().map(height).fold(f64::MIN, greater);
            let found = polytope.vertex(polytope.extremal(look));
            assert!(height(found) >= highest - 1e-15);
        }
    }
    assert!(Starts::new(&cube()).0.iter().all(|&v| v < 8));
}

#[test]
fn axes_are_turned_into_bs_frame() {
    let (one, other) = (cube(), prepared(&shape::cuboid(DVec3::new(0.5, 0.6, 0.7))));
    let turn = ccd_core::glam::DQuat::from_rotation_z(1.2);
    let places = crate::tests::setting::turned(&one, &other, turn, 4.0 * DVec3::X);
    let axis = DVec3::new(1.0, 0.4, 0.2);
    let pair = extremal(&places, axis);
    let Feature::Vertex(b) = pair.b else {
        panic!("{pair:?}")
    };
    let height = |v: u32| axis.dot(turn * other.vertex(v).point);
    assert!((0..8).all(|v| height(b) <= height(v)));
}
