//! Tests the march's step from a needle over, through or next to the top of a cube.

use super::next;
use crate::feature::{Feature, MarchStep, WhichPolytope};
use crate::tests::setting::{
    cube, edge_with_nearest_middle, face_along, needle, pair_with_b_moved,
};
use ccd_core::glam::DVec3;
use rstest::rstest;

/// Returns the march's step from a needle and the cube's top. Checks that moving the cube instead of the needle gives
/// the same step.
fn step_for_needle(half: DVec3, at: DVec3) -> MarchStep {
    let (cube, needle) = (cube(), needle(half));
    let placed = pair_with_b_moved(&cube, &needle, at);
    let top = face_along(&cube, DVec3::Z);
    let there = next(&placed.b, 0, &placed.a, top, placed.scale);
    let back = pair_with_b_moved(&needle, &cube, -at);
    let again = next(&back.a, 0, &back.b, top, back.scale);
    match (there, again) {
        (MarchStep::LocalMinimum(..), MarchStep::LocalMinimum(..))
        | (MarchStep::CommonPoint(..), MarchStep::CommonPoint(..)) => {}
        _ => assert_eq!(there, again),
    }
    there
}

#[rstest]
#[case(DVec3::new(0.5, 0.0, 0.1), 0)]
#[case(DVec3::new(0.5, 0.0, -0.1), 1)]
#[case(DVec3::new(0.5, 0.0, 1e-300), 0)]
fn needles_continue_to_their_lower_end(#[case] half: DVec3, #[case] end: u32) {
    let top = face_along(&cube(), DVec3::Z);
    let said = step_for_needle(half, 2.0 * DVec3::Z);
    assert_eq!(
        said,
        MarchStep::Continue(Feature::Vertex(end), Feature::Face(top))
    );
}

#[rstest]
#[case(DVec3::new(5.0, 0.0, 0.1), -DVec3::X)]
#[case(DVec3::new(5.0, 0.0, -0.1), DVec3::X)]
#[case(DVec3::new(0.1, -5.0, 0.1), DVec3::Y)]
fn needles_continue_to_the_side_that_cuts_them(#[case] half: DVec3, #[case] side: DVec3) {
    let edge = edge_with_nearest_middle(&cube(), side + DVec3::Z);
    let said = step_for_needle(half, 2.0 * DVec3::Z);
    assert_eq!(
        said,
        MarchStep::Continue(Feature::Edge(0), Feature::Edge(edge))
    );
}

#[test]
fn goes_on_to_the_nearest_side_from_outside() {
    let edge = edge_with_nearest_middle(&cube(), DVec3::X + DVec3::Z);
    let said = step_for_needle(DVec3::new(0.0, 0.5, 0.5), DVec3::new(2.0, 0.3, 1.8));
    assert_eq!(
        said,
        MarchStep::Continue(Feature::Edge(0), Feature::Edge(edge))
    );
}

#[rstest]
#[case(DVec3::new(0.1, 0.2, 1.0), DVec3::Z)]
// One end on the face, to the bit.
#[case(DVec3::new(0.0, 0.0, 0.5), DVec3::new(0.25, 0.25, 1.5))]
fn needles_through_a_face_have_a_common_point(#[case] half: DVec3, #[case] at: DVec3) {
    let MarchStep::CommonPoint(which, crossing) = step_for_needle(half, at) else {
        panic!("it goes through the top");
    };
    assert_eq!(
        (which, crossing.face),
        (WhichPolytope::PolytopeX, face_along(&cube(), DVec3::Z))
    );
}

#[test]
fn finds_features_behind() {
    let half = DVec3::new(0.5, 0.0, 0.1);
    let MarchStep::LocalMinimum(which, minimum) = step_for_needle(half, DVec3::ZERO) else {
        panic!("it is below the top");
    };
    assert_eq!(
        (which, minimum.feature),
        (WhichPolytope::PolytopeX, Feature::Edge(0))
    );
    // The end that is higher.
    assert!(minimum.point.distance(half) < 1e-15);
}
