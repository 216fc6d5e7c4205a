//! Tests the step from a vertex and a face, for points and needles around the top of a cube.

use super::next;
use crate::feature::Certainty::{Sure, Tied};
use crate::feature::{Feature, MarchStep, WhichPolytope};
use crate::tests::setting::{
    cube, edge_with_nearest_middle, face_along, needle, pair_with_b_moved, pair_with_placed_b,
    point,
};
use ccd_core::glam::{DQuat, DVec3};
use rstest::rstest;

/// Returns the step for a point and the cube's top face, and asserts that their order does not matter.
fn step_of_point(at: DVec3) -> MarchStep {
    let (cube, point) = (cube(), point());
    let placed = pair_with_b_moved(&cube, &point, at);
    let top = face_along(&cube, DVec3::Z);
    let there = next(&placed.b, 0, &placed.a, top, placed.scale);
    let back = pair_with_b_moved(&point, &cube, -at);
    let again = next(&back.a, 0, &back.b, top, back.scale);
    match (there, again) {
        (MarchStep::LocalMinimum(..), MarchStep::LocalMinimum(..)) => {}
        _ => assert_eq!(there, again),
    }
    there
}

#[rstest]
#[case(DVec3::new(0.0, 0.0, 2.0), Sure)]
#[case(DVec3::new(0.5, -0.9, 1.0 + 1e-12), Sure)]
#[case(DVec3::new(1.0, 1.0, 1.5), Sure)]
#[case(DVec3::new(0.2, 0.3, 1.0), Tied)]
#[case(DVec3::new(0.2, 0.3, 1.0 - f64::EPSILON), Tied)]
fn points_above_the_face_stop_the_march(
    #[case] at: DVec3,
    #[case] certainty: crate::feature::Certainty,
) {
    assert_eq!(step_of_point(at), MarchStep::Stop(certainty));
}

#[rstest]
#[case(DVec3::new(1.0 + f64::EPSILON, 0.0, 2.0), DVec3::new(1.0, 0.0, 1.0))]
// Beyond two planes: the march goes on to the edge of the most violated one.
#[case(DVec3::new(3.0, 2.0, 2.0), DVec3::new(1.0, 0.0, 1.0))]
#[case(DVec3::new(-2.0, -3.0, 2.0), DVec3::new(0.0, -1.0, 1.0))]
#[case(DVec3::new(0.0, 5.0, -9.0), DVec3::new(0.0, 1.0, 1.0))]
fn points_continue_to_the_most_violated_plane(#[case] at: DVec3, #[case] middle: DVec3) {
    let edge = edge_with_nearest_middle(&cube(), middle);
    assert_eq!(
        step_of_point(at),
        MarchStep::Continue(Feature::Vertex(0), Feature::Edge(edge))
    );
}

#[rstest]
#[case(DVec3::new(0.0, 0.0, 0.9))]
#[case(DVec3::new(0.0, 0.0, -7.0))]
fn points_behind_the_face_are_local_minima(#[case] at: DVec3) {
    let MarchStep::LocalMinimum(which, minimum) = step_of_point(at) else {
        panic!("it is below the top");
    };
    let top = face_along(&cube(), DVec3::Z);
    assert_eq!(
        (which, minimum.feature, minimum.other_polytope_face),
        (WhichPolytope::PolytopeX, Feature::Vertex(0), top)
    );
}

/// Tests that the march goes on to an edge that falls towards the face by more than rounding, and stops otherwise.
#[rstest]
#[case(-0.3, true)]
#[case(-1e-14, true)]
#[case(-1e-17, false)]
#[case(0.0, false)]
#[case(1e-14, false)]
fn corners_continue_along_descending_edges(#[case] slope: f64, #[case] falls: bool) {
    let (cube, needle) = (cube(), needle(0.4 * DVec3::X));
    let placed = pair_with_placed_b(
        &cube,
        &needle,
        DQuat::from_rotation_y(-slope),
        1.5 * DVec3::Z,
    );
    let top = face_along(&cube, DVec3::Z);
    let said = next(&placed.b, 0, &placed.a, top, placed.scale);
    if falls {
        assert_eq!(
            said,
            MarchStep::Continue(Feature::Edge(0), Feature::Face(top))
        );
    } else {
        assert_eq!(said, MarchStep::Stop(Sure));
    }
}
