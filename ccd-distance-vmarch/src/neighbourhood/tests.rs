//! Tests that the search around a pair of features finds a nearer pair, if there is one.

use super::nearer_neighbour_pair;
use crate::feature::{Feature, Pair};
use crate::tests::setting::{
    cube, edge_with_nearest_middle, face_along, nearest_vertex, pair_with_b_moved,
    pair_with_placed_b, prepared_polytope,
};
use crate::tests::shape;
use crate::witness::Witness;
use ccd_core::glam::{DQuat, DVec3};
use ccd_core::order::lesser;

#[test]
fn the_nearest_pair_has_no_nearer_pair_around() {
    let cube = cube();
    let placed = pair_with_b_moved(&cube, &cube, DVec3::new(3.0, 3.0, 3.0));
    let pair = Pair {
        a: Feature::Vertex(nearest_vertex(&cube, DVec3::ONE)),
        b: Feature::Vertex(nearest_vertex(&cube, -DVec3::ONE)),
    };
    let distance = Witness::new(&placed, pair).distance();
    assert_eq!(nearer_neighbour_pair(&placed, pair, distance), None);
}

/// Tests that the nearer corner is found for two facing cubes that are tilted by 1e-10.
#[test]
fn slow_approaches_are_found() {
    let (one, other) = (cube(), prepared_polytope(&shape::cuboid(DVec3::splat(0.9))));
    let placed = pair_with_placed_b(
        &one,
        &other,
        DQuat::from_rotation_y(1e-10),
        (1.9 + 1e-6) * DVec3::Z,
    );
    // The far end of an edge that falls by 2e-10.
    let high = Pair {
        a: Feature::Face(face_along(&one, DVec3::Z)),
        b: Feature::Vertex(nearest_vertex(&other, DVec3::new(-0.9, 0.9, -0.9))),
    };
    let low = Pair {
        b: Feature::Vertex(nearest_vertex(&other, DVec3::new(0.9, 0.9, -0.9))),
        ..high
    };
    let [far, near] = [high, low].map(|pair| Witness::new(&placed, pair).distance());
    assert!((far - near).abs() > 1e-10);
    let (above, pair) = if far > near { (far, high) } else { (near, low) };
    let found = nearer_neighbour_pair(&placed, pair, above).expect("the other end is nearer");
    let distance = Witness::new(&placed, found).distance();
    assert!((distance - lesser(far, near)).abs() < 1e-15, "{found:?}");
}

#[test]
fn all_kinds_of_features_are_found() {
    let cube = cube();
    let top = Pair {
        a: Feature::Edge(edge_with_nearest_middle(&cube, DVec3::X + DVec3::Z)),
        b: Feature::Vertex(nearest_vertex(&cube, DVec3::new(-1.0, -1.0, -1.0))),
    };
    let placed = pair_with_b_moved(&cube, &cube, DVec3::new(0.5, 0.5, 3.0));
    let found = nearer_neighbour_pair(&placed, top, 9.0).expect("the faces are nearer");
    assert!((Witness::new(&placed, found).distance() - 1.0).abs() < 1e-15);
    let single = prepared_polytope(&shape::shape_of_points(&[DVec3::ZERO]));
    let placed = pair_with_b_moved(&cube, &single, DVec3::new(0.2, 0.1, 3.0));
    let pair = Pair {
        a: Feature::Edge(edge_with_nearest_middle(&cube, DVec3::X + DVec3::Z)),
        b: Feature::Vertex(0),
    };
    let found = nearer_neighbour_pair(&placed, pair, 2.5).expect("the top is nearer");
    assert_eq!(found.a, Feature::Face(face_along(&cube, DVec3::Z)));
}
