//! Touching, overlapping, inside of: what holds at the start decides.

use ccd_core::glam::{DQuat, DVec3};
use ccd_core::{Config, Outcome, Overlap};
use ccd_tests::backends::for_each_setup;
use ccd_tests::models::{Shape, cuboid, icosphere, torus};
use ccd_tests::query::{Actor, Query};

fn query(a: Shape, b: Shape, at: DVec3) -> Query {
    Query {
        a: Actor::still(a, DVec3::ZERO),
        b: Actor::moving(b, at, 0.1 * DVec3::X, DVec3::Z),
        duration: 1.0,
    }
}

fn outcomes(query: &Query, check: impl Fn(Outcome) -> bool) {
    for_each_setup(query, &Config::default(), |_, setup, answer| {
        assert!(check(answer.outcome), "{setup:?}\n{answer:?}");
    });
}

fn overlaps(outcome: Outcome) -> bool {
    matches!(
        outcome,
        Outcome::Overlapping {
            overlap: Overlap::Pieces(_)
        }
    )
}

fn cube(half: f64) -> Shape {
    cuboid(DVec3::splat(half))
}

#[test]
fn faces_edges_and_corners_that_meet_are_touching() {
    let touching = |o| matches!(o, Outcome::Touching { .. });
    for at in [
        DVec3::X,
        DVec3::new(1.0, 0.3, 0.2),
        DVec3::new(1.0, 1.0, 0.0),
        DVec3::ONE,
    ] {
        outcomes(&query(cube(0.5), cube(0.5), at * (1.0 + 1e-6)), touching);
    }
}

#[test]
fn surfaces_that_cross_overlap() {
    for at in [
        DVec3::new(0.9, 0.2, 0.1),
        DVec3::new(0.5, 0.4, 0.3),
        DVec3::splat(0.99),
    ] {
        outcomes(&query(cube(0.5), cube(0.5), at), overlaps);
        outcomes(&query(cube(0.5), icosphere(1.0, 1), at), overlaps);
    }
}

#[test]
fn flush_boxes_overlap_or_touch() {
    // No triangle crosses another: all that meets is flush.
    outcomes(&query(cube(0.5), cube(0.5), 0.9 * DVec3::X), |outcome| {
        matches!(
            outcome,
            Outcome::Overlapping { .. } | Outcome::Touching { .. }
        )
    });
}

#[test]
fn equal_bodies_in_the_same_place_overlap_or_touch() {
    // Every face lies in its twin: triangles touch without crossing.
    outcomes(&query(cube(0.5), cube(0.5), DVec3::ZERO), |outcome| {
        matches!(
            outcome,
            Outcome::Overlapping { .. } | Outcome::Touching { .. }
        )
    });
}

#[test]
fn a_solid_inside_of_a_solid_overlaps() {
    let (small, big) = (
        || Shape::closed(cube(0.5).mesh),
        || Shape::closed(cube(2.0).mesh),
    );
    outcomes(
        &query(big(), small(), 0.3 * DVec3::ONE),
        |outcome| match outcome {
            Outcome::Overlapping {
                overlap: Overlap::BInsideA(p),
            } => p.abs().max_element() < 2.0,
            _ => false,
        },
    );
    outcomes(
        &query(small(), big(), 0.3 * DVec3::ONE),
        |outcome| match outcome {
            Outcome::Overlapping {
                overlap: Overlap::AInsideB(p),
            } => p.abs().max_element() <= 0.5,
            _ => false,
        },
    );
}

#[test]
fn a_surface_inside_of_a_solid_overlaps_but_not_in_a_surface() {
    let (small, big) = (Shape::open(cube(0.5).mesh), cube(2.0).mesh);
    let inside = |o| {
        matches!(
            o,
            Outcome::Overlapping {
                overlap: Overlap::BInsideA(_)
            }
        )
    };
    outcomes(
        &query(Shape::closed(big.clone()), small.clone(), DVec3::ZERO),
        inside,
    );
    outcomes(&query(Shape::open(big), small, DVec3::ZERO), |o| {
        matches!(o, Outcome::Free { .. })
    });
}

#[test]
fn the_hole_of_a_torus_is_outside() {
    let ring = torus(1.0, 0.25, 16, 8);
    let ball = |r| Shape::closed(icosphere(r, 1).mesh);
    let free = |o| matches!(o, Outcome::Free { .. });
    outcomes(&query(ring.clone(), ball(0.3), DVec3::ZERO), free);
    let inside = |o| {
        matches!(
            o,
            Outcome::Overlapping {
                overlap: Overlap::BInsideA(_)
            }
        )
    };
    outcomes(&query(ring, ball(0.1), DVec3::X), inside);
}

#[test]
fn the_second_of_two_shells_is_found_inside() {
    let two = Shape {
        volume: ccd_core::Volume::Solid,
        ..Shape::union([
            Shape::closed(cube(0.2).mesh).moved(9.0 * DVec3::X),
            Shape::closed(cube(0.2).mesh),
        ])
    };
    let inside = |o| {
        matches!(
            o,
            Outcome::Overlapping {
                overlap: Overlap::BInsideA(_)
            }
        )
    };
    outcomes(
        &query(Shape::closed(cube(1.0).mesh), two, DVec3::ZERO),
        inside,
    );
}

#[test]
fn nothing_moves() {
    let at = |x: f64| Query {
        a: Actor::still(cube(0.5), DVec3::ZERO),
        b: Actor::still(
            cube(0.5).placed(DQuat::from_rotation_z(0.3), DVec3::ZERO),
            x * DVec3::X,
        ),
        duration: 1.0,
    };
    outcomes(&at(3.0), |o| matches!(o, Outcome::Free { .. }));
    outcomes(&at(0.9), overlaps);
}

#[test]
fn no_time_passes() {
    let mut query = query(cube(0.5), cube(0.5), 3.0 * DVec3::X);
    query.duration = 0.0;
    outcomes(&query, |o| matches!(o, Outcome::Free { .. }));
}
