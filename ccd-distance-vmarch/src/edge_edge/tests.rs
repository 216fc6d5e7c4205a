//! Tests the march's step from an edge of a cube and a needle near it, and the nearest points of segments at every
//! angle.

use super::{nearest_parameters, next};
use crate::feature::Certainty::{Sure, Tied};
use crate::feature::{Feature, MarchStep, WhichPolytope};
use crate::placed::Line;
use crate::tests::setting::{
    cube, edge_with_nearest_middle, face_along, nearest_vertex, needle, pair_with_b_moved,
};
use crate::tests::shape::{Pcg64, RngExt, SeedableRng, random_direction, random_magnitude};
use ccd_core::glam::DVec3;
use ccd_core::order::lesser;
use rstest::rstest;

/// Returns the march's step from the cube's edge along x at y = z = 1 and a needle. Checks that exchanging the two
/// gives the same step.
fn step_for_needle(half: DVec3, at: DVec3) -> MarchStep {
    let (cube, needle) = (cube(), needle(half));
    let placed = pair_with_b_moved(&cube, &needle, at);
    let edge = edge_with_nearest_middle(&cube, DVec3::new(0.0, 1.0, 1.0));
    let there = next(&placed.a, edge, &placed.b, 0, placed.scale);
    let back = pair_with_b_moved(&needle, &cube, -at);
    let swapped = next(&back.a, 0, &back.b, edge, back.scale).swapped();
    match (there, swapped) {
        // The same point in two frames.
        (MarchStep::LocalMinimum(one, _), MarchStep::LocalMinimum(other, _)) => {
            assert_eq!(one, other);
        }
        _ => assert_eq!(there, swapped),
    }
    there
}

const CROSSING_NEEDLE_HALF_VECTOR: DVec3 = DVec3::new(0.3, 2.0, -2.0);

#[rstest]
#[case(CROSSING_NEEDLE_HALF_VECTOR, DVec3::new(0.0, 1.5, 1.5), Sure)]
#[case(CROSSING_NEEDLE_HALF_VECTOR, DVec3::new(0.7, 1.0 + 1e-9, 1.0 + 1e-9), Sure)]
// Across and along one face.
#[case(2.0 * DVec3::Y, DVec3::new(0.0, 1.0, 1.5), Tied)]
// Parallel needles, on the bisector and above the border of a face.
#[case(0.5 * DVec3::X, DVec3::new(0.2, 1.5, 1.5), Sure)]
#[case(0.5 * DVec3::X, DVec3::new(0.2, 1.0, 1.5), Tied)]
// Touching.
#[case(CROSSING_NEEDLE_HALF_VECTOR, DVec3::new(0.0, 1.0, 1.0), Tied)]
fn edges_in_both_voronoi_regions_stop_the_march(
    #[case] half: DVec3,
    #[case] at: DVec3,
    #[case] certainty: crate::feature::Certainty,
) {
    assert_eq!(step_for_needle(half, at), MarchStep::Stop(certainty));
}

#[test]
fn goes_on_to_ends() {
    let cube = cube();
    let (e, corner) = (
        edge_with_nearest_middle(&cube, DVec3::new(0.0, 1.0, 1.0)),
        nearest_vertex(&cube, DVec3::ONE),
    );
    let beyond = step_for_needle(CROSSING_NEEDLE_HALF_VECTOR, DVec3::new(2.0, 1.5, 1.5));
    assert_eq!(
        beyond,
        MarchStep::Continue(Feature::Vertex(corner), Feature::Edge(0))
    );
    let above = step_for_needle(DVec3::new(0.0, 0.5, 0.5), DVec3::new(0.1, 1.8, 1.8));
    assert_eq!(
        above,
        MarchStep::Continue(Feature::Edge(e), Feature::Vertex(0))
    );
    let both = step_for_needle(DVec3::new(0.5, 0.5, 0.5), DVec3::new(2.0, 2.0, 2.0));
    assert_eq!(
        both,
        MarchStep::Continue(Feature::Vertex(corner), Feature::Vertex(0))
    );
}

#[test]
fn goes_on_to_the_face_on_whose_side_it_is() {
    let above = step_for_needle(DVec3::new(0.3, 2.0, 1e-3), DVec3::new(0.0, 0.5, 1.5));
    let face = face_along(&cube(), DVec3::Z);
    assert_eq!(
        above,
        MarchStep::Continue(Feature::Face(face), Feature::Edge(0))
    );
}

#[test]
fn finds_edges_below_both_faces() {
    let at = DVec3::new(0.0, 0.9, 0.9);
    let MarchStep::LocalMinimum(which, minimum) = step_for_needle(CROSSING_NEEDLE_HALF_VECTOR, at)
    else {
        panic!("it is within the cube");
    };
    assert_eq!(
        (which, minimum.feature),
        (WhichPolytope::PolytopeY, Feature::Edge(0))
    );
    assert!(minimum.point.distance(at) < 1e-15);
}

/// Tests that no other points of two segments are nearer by more than rounding, for angles from crossing to parallel up
/// to the last bit.
#[test]
fn nearest_points_are_nearest_at_every_angle() {
    let mut rng = Pcg64::seed_from_u64(5);
    for _ in 0..20_000 {
        let along = random_direction(&mut rng);
        let tilt = random_magnitude(&mut rng, -17.0, 0.0);
        let one = Line {
            start: random_direction(&mut rng),
            direction: along,
            length: random_magnitude(&mut rng, -6.0, 0.5),
        };
        let other = Line {
            start: one.point_at_parameter(rng.random_range(-1.0..1.0))
                + random_magnitude(&mut rng, -9.0, 0.0) * random_direction(&mut rng),
            direction: (along + tilt * random_direction(&mut rng)).normalize(),
            length: random_magnitude(&mut rng, -6.0, 0.5),
        };
        let [s, t] = nearest_parameters(&one, &other).parameters;
        let distance = one
            .point_at_parameter(s)
            .distance(other.point_at_parameter(t));
        // Alternating projections from there and from every end, to the limit.
        let mut best = distance;
        for start in [s, 0.0, one.length, 0.5 * one.length] {
            let mut s = start;
            for _ in 0..50 {
                let t = other.nearest_parameter(one.point_at_parameter(s));
                s = one.nearest_parameter(other.point_at_parameter(t));
                best = lesser(
                    best,
                    one.point_at_parameter(s)
                        .distance(other.point_at_parameter(t)),
                );
            }
        }
        assert!(
            distance <= best + 4e-15,
            "{distance:e} {best:e} of {one:?} {other:?}"
        );
    }
}
