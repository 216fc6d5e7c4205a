//! Tests support gaps of cubes, and the axes found if the vector between the nearest points is mostly rounding.

use super::{Axis, best_axis, gap};
use crate::feature::{Feature, Pair};
use crate::tests::setting::{
    cube, edge_with_nearest_middle, nearest_vertex, needle, pair_with_b_moved, pair_with_placed_b,
    prepared_polytope,
};
use crate::tests::shape;
use crate::witness::Witness;
use ccd_core::glam::{DQuat, DVec3};
use rstest::rstest;

#[test]
fn gaps_are_those_of_the_supports() {
    let cube = cube();
    let placed = pair_with_b_moved(&cube, &cube, DVec3::new(3.0, 0.5, 0.0));
    assert_eq!(gap(&placed, DVec3::X), 1.0);
    assert_eq!(gap(&placed, -DVec3::X), -5.0);
    assert_eq!(gap(&placed, DVec3::Y), -1.5);
    let placed = pair_with_placed_b(
        &cube,
        &cube,
        DQuat::from_rotation_z(std::f64::consts::FRAC_PI_4),
        3.0 * DVec3::X,
    );
    assert!((gap(&placed, DVec3::X) - (2.0 - 2f64.sqrt())).abs() < 1e-15);
    let axis = Axis::from_direction(&placed, 7.0 * DVec3::X);
    assert!(axis.certifies(2.0 - 2f64.sqrt(), &placed) && !axis.certifies(0.6, &placed));
    assert!(!axis.certifies(f64::NAN, &placed));
    assert!(!Axis::from_direction(&placed, DVec3::ZERO).certifies(0.0, &placed));
}

/// Tests that a separating axis is found for cubes that touch or nearly touch at a corner, an edge or a face.
#[rstest]
fn touching_features_have_an_axis(
    #[values(
        DVec3::new(2.0, 2.0, 2.0),
        DVec3::new(2.0, 2.0, 0.5),
        DVec3::new(2.0, 0.5, 0.5),
        DVec3::new(2.0, 2.0, 0.0)
    )]
    at: DVec3,
    #[values(0.0, 1e-300, 1e-16, 1e-13)] hair: f64,
) {
    let cube = cube();
    let placed = pair_with_b_moved(&cube, &cube, at + hair * DVec3::new(1.0, 0.3, 0.1));
    let corner = |along: DVec3| Feature::Vertex(nearest_vertex(&cube, along));
    let pair = Pair {
        a: corner(DVec3::ONE),
        b: corner(DVec3::new(-1.0, -1.0, -1.0)),
    };
    let axis = best_axis(&placed, pair, &Witness::new(&placed, pair));
    assert!(axis.gap >= -1e-15, "{axis:?}");
}

#[test]
fn crossing_edges_and_flat_pieces_have_an_axis() {
    let (cube, across) = (cube(), needle(DVec3::new(0.5, 1.0, -1.0)));
    let placed = pair_with_b_moved(&cube, &across, DVec3::new(0.0, 1.0, 1.0));
    let pair = Pair {
        a: Feature::Edge(edge_with_nearest_middle(&cube, DVec3::Y + DVec3::Z)),
        b: Feature::Edge(0),
    };
    let axis = best_axis(&placed, pair, &Witness::new(&placed, pair));
    assert!(axis.gap >= -1e-15, "{axis:?}");
    // Two squares side by side in one plane, and two needles on one line.
    let square = prepared_polytope(&shape::polygon(4));
    let side = std::f64::consts::FRAC_1_SQRT_2;
    let placed = pair_with_b_moved(&square, &square, DVec3::new(side, side, 0.0) * 2f64.sqrt());
    let pair = Pair {
        a: Feature::Edge(edge_with_nearest_middle(&square, DVec3::new(0.5, 0.5, 0.0))),
        b: Feature::Edge(edge_with_nearest_middle(
            &square,
            DVec3::new(-0.5, -0.5, 0.0),
        )),
    };
    let axis = best_axis(&placed, pair, &Witness::new(&placed, pair));
    assert!(axis.gap >= -1e-15, "{axis:?}");
    let line = needle(DVec3::X);
    let placed = pair_with_b_moved(&line, &line, 2.0 * DVec3::X);
    let pair = Pair {
        a: Feature::Vertex(nearest_vertex(&line, DVec3::X)),
        b: Feature::Vertex(nearest_vertex(&line, -DVec3::X)),
    };
    let axis = best_axis(&placed, pair, &Witness::new(&placed, pair));
    assert!(axis.gap >= -1e-15, "{axis:?}");
}
