//! Tests the clipping of needles to the prism of a cube's top, and the overlap of parallel segments.

use super::{clip_to_prism, parameter_of_overlap_middle};
use crate::placed::{Line, PlacedPolytope};
use crate::tests::setting::{
    cube, edge_with_nearest_middle, face_along, needle, pair_with_b_moved,
};
use ccd_core::glam::DVec3;
use rstest::rstest;

/// Clips a needle to the prism of the cube's top, and returns the parameters and the cutting edges of both ends.
fn clip_needle(half: DVec3, at: DVec3) -> Option<[(f64, Option<u32>); 2]> {
    let (cube, needle) = (cube(), needle(half));
    let placed = pair_with_b_moved(&cube, &needle, at);
    let line = placed.b.line(0);
    let end = placed.b.vertex(1);
    let clipped = clip_to_prism(&line, end, &placed.a, face_along(&cube, DVec3::Z))?;
    Some(clipped.map(|cut| (cut.parameter, cut.cutting_edge)))
}

#[test]
fn edges_within_the_prism_are_not_cut() {
    let left = clip_needle(0.5 * DVec3::X, 3.0 * DVec3::Z);
    assert_eq!(left, Some([(0.0, None), (1.0, None)]));
}

#[rstest]
#[case(4.0 * DVec3::X, 3.0 * DVec3::Z, [3.0, 5.0], [-DVec3::X, DVec3::X])]
#[case(4.0 * DVec3::Y, 3.0 * DVec3::Z, [3.0, 5.0], [-DVec3::Y, DVec3::Y])]
#[case(-4.0 * DVec3::X, -3.0 * DVec3::Z, [3.0, 5.0], [DVec3::X, -DVec3::X])]
fn longer_edges_are_cut(
    #[case] half: DVec3,
    #[case] at: DVec3,
    #[case] parameters: [f64; 2],
    #[case] by: [DVec3; 2],
) {
    let by = by.map(|side| Some(edge_with_nearest_middle(&cube(), side + DVec3::Z)));
    let [from, to] = clip_needle(half, at).expect("some is left");
    assert_eq!([from.0, to.0], parameters);
    assert_eq!([from.1, to.1], by);
}

#[rstest]
#[case(0.5 * DVec3::X, DVec3::new(2.0, 0.0, 3.0))]
#[case(DVec3::new(1.0, -1.0, 0.0), DVec3::new(1.5, 1.5, 1.0))]
#[case(DVec3::NAN, DVec3::ZERO)]
fn no_part_is_left_outside_of_the_prism(#[case] half: DVec3, #[case] at: DVec3) {
    if half.is_finite() {
        assert_eq!(clip_needle(half, at), None);
    } else {
        let cube = cube();
        let placed = pair_with_b_moved(&cube, &cube, DVec3::NAN);
        let top = face_along(&cube, DVec3::Z);
        let left = clip_to_prism(&placed.b.line(0), DVec3::NAN, &placed.a, top);
        assert!(left.is_none_or(|[from, _]| from.cutting_edge.is_none()));
    }
}

#[rstest]
#[case(0.0, 1.5)]
#[case(1.0, 2.0)]
#[case(5.0, 3.0)]
#[case(-9.0, 0.0)]
fn overlaps_of_parallel_segments_have_a_middle(#[case] shift: f64, #[case] middle: f64) {
    let line = |start: f64, length: f64| Line {
        start: start * DVec3::X,
        direction: DVec3::X,
        length,
    };
    assert_eq!(
        parameter_of_overlap_middle(&line(0.0, 3.0), &line(shift, 3.0)),
        middle
    );
}
