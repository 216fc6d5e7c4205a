//! Tests that common points of needles, tetrahedra and cubes are found or excluded exactly, to the last bit.

use super::{
    barycentric_coordinates, contained_corner_crossing, edge_face_crossing,
    find_edge_face_crossing, segment_crosses_triangle, weights,
};
use crate::placed::PlacedPolytope;
use crate::tests::setting::{cube, face_along, needle, pair_with_b_moved, point};
use crate::tests::shape::{Pcg64, SeedableRng, random_direction, random_magnitude, random_vector};
use ccd_core::glam::DVec3;
use rstest::rstest;

const TRIANGLE: [DVec3; 3] = [DVec3::ZERO, DVec3::X, DVec3::Y];

/// The next f64 above 0.25.
const NEXT_ABOVE_QUARTER: f64 = 0.25 + f64::EPSILON / 4.0;
const NEXT_BELOW_QUARTER: f64 = 0.25 - f64::EPSILON / 8.0;

#[rstest]
// Through the inside, a side, a corner.
#[case(DVec3::new(0.25, 0.25, 1.0), DVec3::new(0.25, 0.25, -1.0), true)]
#[case(DVec3::new(0.5, 0.5, 1.0), DVec3::new(0.5, 0.5, -1.0), true)]
#[case(DVec3::new(0.0, 0.0, 1.0), DVec3::new(0.0, 0.0, -1.0), true)]
// Ending on it, and ending one unit in the last place above.
#[case(DVec3::new(0.25, 0.25, 1.0), DVec3::new(0.25, 0.25, 0.0), true)]
#[case(DVec3::new(0.25, 0.25, 1.0), DVec3::new(0.25, 0.25, 1e-80), false)]
// Past the side x + y = 1/2 + 1/2, by one unit in the last place to either side.
#[case(DVec3::new(0.75, NEXT_ABOVE_QUARTER, 1.0), DVec3::new(0.75, NEXT_ABOVE_QUARTER, -1.0), false)]
#[case(DVec3::new(0.75, NEXT_BELOW_QUARTER, 1.0), DVec3::new(0.75, NEXT_BELOW_QUARTER, -1.0), true)]
// Next to it, and within its plane.
#[case(DVec3::new(2.0, 0.25, 1.0), DVec3::new(2.0, 0.25, -1.0), false)]
#[case(DVec3::new(-1.0, 0.25, 0.0), DVec3::new(2.0, 0.25, 0.0), false)]
fn segments_meet_triangles_exactly(#[case] start: DVec3, #[case] end: DVec3, #[case] meets: bool) {
    for edge in [[start, end], [end, start]] {
        for turn in 0..3 {
            let mut triangle = TRIANGLE;
            triangle.rotate_left(turn);
            assert_eq!(segment_crosses_triangle(edge, triangle), meets);
            triangle.swap(0, 1);
            assert_eq!(segment_crosses_triangle(edge, triangle), meets);
        }
    }
}

/// Tests that the weights of a segment and those of a triangle give the same point, also for very thin triangles.
#[test]
fn both_sides_name_the_same_point() {
    let mut rng = Pcg64::seed_from_u64(1);
    let mut met = 0;
    for _ in 0..20_000 {
        let thin = random_magnitude(&mut rng, -9.0, 0.0);
        let squeeze = DVec3::new(1.0, thin, 1.0);
        let triangle = [(); 3].map(|()| squeeze * random_vector(&mut rng));
        let middle = (triangle[0] + triangle[1] + triangle[2]) / 3.0;
        let offset = random_direction(&mut rng);
        let edge = [middle - 0.7 * offset, middle + 0.4 * offset];
        if !segment_crosses_triangle(edge, triangle) {
            continue;
        }
        met += 1;
        let (along, inside) = weights(edge, triangle);
        let on_edge = along[0] * edge[0] + along[1] * edge[1];
        let on_face = (0..3).map(|k| inside[k] * triangle[k]).sum::<DVec3>();
        assert!(along.iter().chain(&inside).all(|w| (0.0..=1.0).contains(w)));
        assert!(on_edge.distance(on_face) < 3e-15, "{edge:?} {triangle:?}");
    }
    assert!(met > 10_000, "only {met} met");
}

#[test]
fn tetrahedra_enclose_to_the_last_bit() {
    let apex = DVec3::new(0.0, 0.0, -1.0);
    let weights = barycentric_coordinates(DVec3::new(0.25, 0.25, -0.25), apex, TRIANGLE);
    assert_eq!(weights, Some([0.25, 0.25, 0.25, 0.25]));
    assert!(barycentric_coordinates(DVec3::new(0.25, 0.25, 0.0), apex, TRIANGLE).is_some());
    assert_eq!(
        barycentric_coordinates(DVec3::new(0.25, 0.25, 1e-80), apex, TRIANGLE),
        None
    );
    assert_eq!(
        barycentric_coordinates(DVec3::new(0.25, 0.25, -2.0), apex, TRIANGLE),
        None
    );
    // A flat one encloses nothing.
    assert_eq!(
        barycentric_coordinates(DVec3::new(0.25, 0.25, 0.0), DVec3::ZERO, TRIANGLE),
        None
    );
}

#[rstest]
#[case(DVec3::ZERO, true)]
#[case(DVec3::new(0.9, -0.3, 0.99), true)]
#[case(DVec3::new(1.0, 0.5, 0.5), true)]
#[case(DVec3::new(1.0 + f64::EPSILON, 0.5, 0.5), false)]
fn only_inner_corners_have_a_crossing(#[case] at: DVec3, #[case] inside: bool) {
    let (cube, point) = (cube(), point());
    let placed = pair_with_b_moved(&cube, &point, at);
    let found = contained_corner_crossing(&placed.b, 0, &placed.a);
    assert_eq!(found.is_some(), inside);
    if let Some(found) = found {
        let corners = found
            .face_corners
            .vertices
            .iter()
            .zip(found.face_corners.weights);
        let named: DVec3 = corners.map(|(&v, w)| w * placed.a.vertex(v)).sum();
        assert!(named.distance(at) < 1e-15);
    }
}

#[test]
fn faces_are_pierced_anywhere() {
    let (cube, needle) = (cube(), needle(3.0 * DVec3::Z));
    for (x, y) in [(0.0, 0.0), (0.9, -0.9), (-0.5, 0.5), (1.0, 1.0), (0.0, 1.0)] {
        let placed = pair_with_b_moved(&cube, &needle, DVec3::new(x, y, 0.0));
        for normal in [DVec3::Z, -DVec3::Z] {
            let found = edge_face_crossing(&placed.b, 0, &placed.a, face_along(&cube, normal));
            assert!(found.is_some());
        }
        let beside = edge_face_crossing(&placed.b, 0, &placed.a, face_along(&cube, DVec3::X));
        assert!(beside.is_none());
    }
}

#[rstest]
#[case(1.5 * DVec3::ONE, true)]
#[case(DVec3::ZERO, true)]
#[case(DVec3::new(1.9, 0.0, 0.0), true)]
#[case(DVec3::new(2.0 + 1e-15, 0.0, 0.0), false)]
#[case(DVec3::new(9.0, 0.0, 0.0), false)]
fn the_search_finds_common_points(#[case] at: DVec3, #[case] meets: bool) {
    let (one, other) = (cube(), cube());
    let placed = pair_with_b_moved(&one, &other, at);
    let found = find_edge_face_crossing(&placed.a, &placed.b)
        .or_else(|| find_edge_face_crossing(&placed.b, &placed.a));
    assert_eq!(found.is_some(), meets);
}
