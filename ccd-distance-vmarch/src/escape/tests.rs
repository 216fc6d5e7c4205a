//! Tests escapes from local minima, for points and needles behind a face of a cube.

use super::{escape_local_minimum, face_farthest_below};
use crate::feature::{Feature, LocalMinimum, MarchStep};
use crate::placed::PlacedPolytope;
use crate::tests::setting::{cube, face_along, needle, pair_with_b_moved, point};
use ccd_core::glam::DVec3;

fn escape_of_point(at: DVec3) -> MarchStep {
    let (cube, point) = (cube(), point());
    let placed = pair_with_b_moved(&cube, &point, at);
    let minimum = LocalMinimum {
        feature: Feature::Vertex(0),
        point: at,
        other_polytope_face: face_along(&cube, DVec3::Z),
    };
    escape_local_minimum(&placed.b, minimum, &placed.a, placed.scale)
}

fn step_to_face(face: u32) -> MarchStep {
    MarchStep::Continue(Feature::Vertex(0), Feature::Face(face))
}

#[test]
fn leads_to_the_face_it_is_highest_above() {
    let below = face_along(&cube(), -DVec3::Z);
    assert_eq!(escape_of_point(-3.0 * DVec3::Z), step_to_face(below));
    let beside = face_along(&cube(), DVec3::X);
    let at = DVec3::new(5.0, 2.0, 0.0);
    assert_eq!(escape_of_point(at), step_to_face(beside));
}

#[test]
fn proves_features_inside() {
    assert!(matches!(
        escape_of_point(DVec3::new(0.2, 0.3, 0.4)),
        MarchStep::CommonPoint(..)
    ));
}

#[test]
fn is_unclear_without_proof_by_exact_signs() {
    // Beyond a face by less than rounding.
    let at = DVec3::new(1.0 + f64::EPSILON, 0.3, 0.4);
    let found = escape_of_point(at);
    assert!(matches!(found, MarchStep::LocalMinimum(..)), "{found:?}");
}

#[test]
fn edges_go_through_or_are_inside() {
    let (cube, short, long) = (cube(), needle(0.5 * DVec3::X), needle(3.0 * DVec3::X));
    for needle in [&short, &long] {
        let placed = pair_with_b_moved(&cube, needle, DVec3::ZERO);
        let minimum = LocalMinimum {
            feature: Feature::Edge(0),
            point: DVec3::ZERO,
            other_polytope_face: face_along(&cube, DVec3::Z),
        };
        let found = escape_local_minimum(&placed.b, minimum, &placed.a, placed.scale);
        let MarchStep::CommonPoint(_, crossing) = found else {
            panic!("{found:?}");
        };
        let corners = crossing
            .edge_ends
            .vertices
            .iter()
            .zip(crossing.edge_ends.weights);
        let named: DVec3 = corners.map(|(&v, w)| w * placed.b.vertex(v)).sum();
        assert!(named.abs().max_element() <= 1.0 + 1e-15);
    }
}

#[test]
fn the_farthest_face_is_found() {
    let cube = cube();
    let placed = pair_with_b_moved(&cube, &cube, DVec3::ZERO);
    for normal in [DVec3::X, -DVec3::Y, DVec3::Z] {
        let found = face_farthest_below(5.0 * normal, &placed.a);
        assert_eq!(found, Some((face_along(&cube, normal), 4.0)));
    }
}
