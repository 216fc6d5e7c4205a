//! Tests the step from two vertices, for points around a corner of a cube.

use super::next;
use crate::feature::Certainty::{Sure, Tied};
use crate::feature::{Feature, MarchStep};
use crate::tests::setting::{
    cube, edge_with_nearest_middle, nearest_vertex, pair_with_b_moved, point,
};
use ccd_core::glam::DVec3;
use rstest::rstest;

/// Returns the step for the cube's corner at (1, 1, 1) and a point, and asserts that their order does not matter.
fn step_of_point(at: DVec3) -> MarchStep {
    let (cube, point) = (cube(), point());
    let placed = pair_with_b_moved(&cube, &point, at);
    let corner = nearest_vertex(&cube, DVec3::ONE);
    let there = next(&placed.a, corner, &placed.b, 0, placed.scale);
    // In the other order, it is the point's corner against the cube's.
    let back = pair_with_b_moved(&point, &cube, -at);
    let swapped = next(&back.a, 0, &back.b, corner, back.scale).swapped();
    assert_eq!(there, swapped);
    there
}

#[rstest]
#[case(DVec3::new(2.0, 2.0, 2.0), Sure)]
#[case(DVec3::new(1.5, 9.0, 1.25), Sure)]
// On one vertex-edge plane, on two, on all: ties stay.
#[case(DVec3::new(1.0, 2.0, 2.0), Tied)]
#[case(DVec3::new(1.0, 1.0, 2.0), Tied)]
#[case(DVec3::new(1.0, 1.0, 1.0), Tied)]
// In front of the plane within rounding, and beyond rounding.
#[case(DVec3::new(1.0 + 1e-15, 2.0, 2.0), Tied)]
#[case(DVec3::new(1.0 + 1e-12, 2.0, 2.0), Sure)]
fn points_in_the_corners_region_stop_the_march(
    #[case] at: DVec3,
    #[case] certainty: crate::feature::Certainty,
) {
    assert_eq!(step_of_point(at), MarchStep::Stop(certainty));
}

#[rstest]
#[case(DVec3::new(0.9, 2.0, 2.0), DVec3::new(0.0, 1.0, 1.0))]
#[case(DVec3::new(1.0 - f64::EPSILON, 2.0, 2.0), DVec3::new(0.0, 1.0, 1.0))]
// The more violated one of two planes.
#[case(DVec3::new(0.5, 0.9, 2.0), DVec3::new(0.0, 1.0, 1.0))]
#[case(DVec3::new(0.9, 0.5, 2.0), DVec3::new(1.0, 0.0, 1.0))]
fn points_behind_a_plane_continue_to_its_edge(#[case] at: DVec3, #[case] middle: DVec3) {
    let edge = edge_with_nearest_middle(&cube(), middle);
    assert_eq!(
        step_of_point(at),
        MarchStep::Continue(Feature::Edge(edge), Feature::Vertex(0))
    );
}
