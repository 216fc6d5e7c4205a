//! Tests the step from a vertex and an edge, for points and needles around an edge of a cube.

use super::next;
use crate::feature::Certainty::{Sure, Tied};
use crate::feature::{Feature, MarchStep};
use crate::tests::setting::{
    cube, edge_with_nearest_middle, face_along, nearest_vertex, needle, pair_with_b_moved,
    pair_with_placed_b, point,
};
use ccd_core::glam::{DQuat, DVec3};
use rstest::rstest;

/// Returns the step for a point and the cube's edge along x at y = z = 1, and asserts that their order does not matter.
fn step_of_point(at: DVec3) -> MarchStep {
    let (cube, point) = (cube(), point());
    let placed = pair_with_b_moved(&cube, &point, at);
    let edge = edge_with_nearest_middle(&cube, DVec3::new(0.0, 1.0, 1.0));
    let there = next(&placed.b, 0, &placed.a, edge, placed.scale);
    let back = pair_with_b_moved(&point, &cube, -at);
    assert_eq!(there, next(&back.a, 0, &back.b, edge, back.scale));
    there
}

#[rstest]
#[case(DVec3::new(0.5, 2.0, 2.0), Sure)]
#[case(DVec3::new(-0.9, 1.1, 3.0), Sure)]
// On a face-edge plane, on a vertex-edge plane, on both; on the edge.
#[case(DVec3::new(0.0, 1.0, 2.0), Tied)]
#[case(DVec3::new(1.0, 2.0, 2.0), Sure)]
#[case(DVec3::new(1.0, 1.0, 2.0), Tied)]
#[case(DVec3::new(0.3, 1.0, 1.0), Tied)]
fn points_in_the_edges_region_stop_the_march(
    #[case] at: DVec3,
    #[case] certainty: crate::feature::Certainty,
) {
    assert_eq!(step_of_point(at), MarchStep::Stop(certainty));
}

#[rstest]
#[case(DVec3::new(1.0 + f64::EPSILON, 2.0, 2.0), DVec3::ONE)]
#[case(DVec3::new(-7.0, 2.0, 2.0), DVec3::new(-1.0, 1.0, 1.0))]
fn points_beyond_an_end_continue_to_it(#[case] at: DVec3, #[case] corner: DVec3) {
    let corner = nearest_vertex(&cube(), corner);
    assert_eq!(
        step_of_point(at),
        MarchStep::Continue(Feature::Vertex(0), Feature::Vertex(corner))
    );
}

#[rstest]
#[case(DVec3::new(0.0, 1.0 - f64::EPSILON, 2.0), DVec3::Z)]
#[case(DVec3::new(0.0, -5.0, 2.0), DVec3::Z)]
#[case(DVec3::new(0.0, 2.0, 0.0), DVec3::Y)]
// Behind both faces: the march goes on to the face that it is less far behind.
#[case(DVec3::new(0.0, 0.9, 0.5), DVec3::Y)]
#[case(DVec3::new(0.0, 0.5, 0.9), DVec3::Z)]
fn points_over_a_face_continue_to_it(#[case] at: DVec3, #[case] normal: DVec3) {
    let face = face_along(&cube(), normal);
    assert_eq!(
        step_of_point(at),
        MarchStep::Continue(Feature::Vertex(0), Feature::Face(face))
    );
}

/// Tests that the march goes on to a needle that falls towards the cube's edge, however slowly, and stops at one that
/// rises.
#[rstest]
#[case(-0.5, Some(true))]
#[case(0.5, None)]
#[case(-1e-9, Some(true))]
#[case(1e-9, None)]
#[case(-1e-13, Some(true))]
#[case(1e-13, None)]
fn corners_continue_to_descending_edges(#[case] slope: f64, #[case] falls: Option<bool>) {
    let (cube, needle) = (cube(), needle(0.4 * DVec3::X));
    let turn = DQuat::from_rotation_y(-slope);
    // The needle's first corner is a millionth above the edge's bisector.
    let up = DVec3::new(0.0, 1.0, 1.0) + 1e-6 * DVec3::new(0.0, 1.0, 1.0);
    let placed = pair_with_placed_b(&cube, &needle, turn, up - turn * (-0.4 * DVec3::X));
    let edge = edge_with_nearest_middle(&cube, DVec3::new(0.0, 1.0, 1.0));
    let said = next(&placed.b, 0, &placed.a, edge, placed.scale);
    match falls {
        Some(_) => assert_eq!(
            said,
            MarchStep::Continue(Feature::Edge(0), Feature::Edge(edge))
        ),
        None => assert_eq!(said, MarchStep::Stop(Sure)),
    }
}
