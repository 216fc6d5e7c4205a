//! Tests the state that is reported at the start: touching, overlapping, or one body inside the other.

use ccd_core::glam::{DQuat, DVec3};
use ccd_core::{Outcome, Overlap, Settings};
use ccd_tests::backends::{default_backend_answer, for_each_setup};
use ccd_tests::models::{
    Mesh, PieceKind, Shape, boulder, cuboid, disjoint_solids, hollow, icosphere, torus,
};
use ccd_tests::query::{MovingShape, Query};
use std::cell::Cell;

fn query(a: Shape, b: Shape, at: DVec3) -> Query {
    Query::new(
        MovingShape::still(a, DVec3::ZERO),
        MovingShape::moving(b, at, 0.1 * DVec3::X, DVec3::Z),
    )
}

fn check_outcomes(query: &Query, check: impl Fn(Outcome) -> bool) {
    check_outcomes_by_kind(query, |_, outcome| check(outcome));
}

fn check_outcomes_by_kind(query: &Query, check: impl Fn([PieceKind; 2], Outcome) -> bool) {
    for_each_setup(query, &Settings::DEFAULT, |_, setup, answer| {
        assert!(
            check(setup.piece_kinds, answer.outcome),
            "{setup:?}\n{answer:?}"
        );
    });
}

/// Returns true if `check` accepts the reported overlap. If pieces may fill the inside of a body, an overlap of pieces
/// is also right.
fn is_accepted_overlap(
    kinds: [PieceKind; 2],
    outcome: Outcome,
    check: impl Fn(Overlap) -> bool,
) -> bool {
    match outcome {
        Outcome::Overlapping {
            overlap: Overlap::Pieces(_),
            ..
        } => kinds.into_iter().any(PieceKind::may_fill_interior),
        Outcome::Overlapping { overlap, .. } => check(overlap),
        _ => false,
    }
}

fn is_accepted_b_in_a(kinds: [PieceKind; 2], outcome: Outcome) -> bool {
    is_accepted_overlap(kinds, outcome, |o| matches!(o, Overlap::BInsideA(_)))
}

fn is_overlap_of_pieces(outcome: Outcome) -> bool {
    matches!(
        outcome,
        Outcome::Overlapping {
            overlap: Overlap::Pieces(_),
            ..
        }
    )
}

fn cube(half: f64) -> Shape {
    cuboid(DVec3::splat(half))
}

#[test]
fn touching_faces_edges_and_corners_are_reported() {
    let touching = |o| matches!(o, Outcome::Touching { .. });
    for at in [
        DVec3::X,
        DVec3::new(1.0, 0.3, 0.2),
        DVec3::new(1.0, 1.0, 0.0),
        DVec3::ONE,
    ] {
        check_outcomes(&query(cube(0.5), cube(0.5), at * (1.0 + 1e-6)), touching);
    }
}

#[test]
fn surfaces_that_cross_overlap() {
    for at in [
        DVec3::new(0.9, 0.2, 0.1),
        DVec3::new(0.5, 0.4, 0.3),
        DVec3::splat(0.99),
    ] {
        check_outcomes(&query(cube(0.5), cube(0.5), at), is_overlap_of_pieces);
        check_outcomes(
            &query(cube(0.5), icosphere(1.0, 1), at),
            is_overlap_of_pieces,
        );
    }
}

fn is_any_overlap(outcome: Outcome) -> bool {
    matches!(outcome, Outcome::Overlapping { .. })
}

/// Tests that solids with coplanar faces overlap, although no triangle crosses another one.
#[test]
fn flush_solids_overlap() {
    let inscribed = octahedron(0.5);
    for (b, at) in [
        (cube(0.5), 0.9 * DVec3::X),
        (cube(0.5), 0.5 * DVec3::X),
        (cube(0.5), DVec3::ZERO),
        (cube(0.25), 0.25 * DVec3::ONE),
        (inscribed, DVec3::ZERO),
    ] {
        check_outcomes(&query(cube(0.5), b, at), is_any_overlap);
    }
}

/// Tests that polytopes overlap if they have too many edge pairs to try all as separating axes. The oracle's claim is
/// used instead, because all pairs would take a thousand times as long.
#[test]
fn polytopes_of_many_facets_overlap() {
    let ball = || icosphere(1.0, 3);
    check_outcomes(&query(ball(), ball(), 0.5 * DVec3::X), is_overlap_of_pieces);
}

/// Returns an octahedron around the origin.
fn octahedron(radius: f64) -> Shape {
    let points: Vec<DVec3> = (0..6)
        .map(|k| DVec3::AXES[k / 2] * if k % 2 == 0 { radius } else { -radius })
        .collect();
    let face = |k: u32| {
        let [x, y, z] = [k & 1, 2 + (k >> 1 & 1), 4 + (k >> 2 & 1)];
        // An odd number of negative corners reverses the face.
        match (k.count_ones()) % 2 {
            0 => [x, y, z],
            _ => [x, z, y],
        }
    };
    Shape::from_convex_mesh(Mesh {
        vertices: points,
        faces: (0..8).map(face).collect(),
    })
}

/// Tests that thin triangles that cross at their middles overlap, although an oracle's common point is accurate to
/// 1e-12 at best.
#[test]
fn needles_that_cross_overlap() {
    let needle = |thickness: f64| {
        let corner = |k: usize| {
            let (sin, cos) = (2.0 * std::f64::consts::FRAC_PI_3 * k as f64).sin_cos();
            DVec3::new(cos, thickness * sin, 0.0)
        };
        Shape::from_open_mesh(Mesh {
            vertices: (0..3).map(corner).collect(),
            faces: vec![[0, 1, 2]],
        })
    };
    for thickness in [1e-2, 1e-3, 1e-4] {
        for k in 0..50 {
            let turn = DQuat::from_axis_angle(
                DVec3::new(1.0, 0.3 * f64::from(k), 0.7).normalize(),
                0.4 + 0.05 * f64::from(k),
            );
            let b = needle(thickness).placed(turn, DVec3::ZERO);
            let query = query(needle(thickness), b, DVec3::ZERO);
            // The needles are triangles: for polytopes without facets the oracle's claim is taken.
            let config = Settings {
                tolerance: 1e-9,
                ..Settings::DEFAULT
            };
            let answer = default_backend_answer(&query, &config);
            assert!(
                is_overlap_of_pieces(answer.outcome),
                "{thickness} {k} {answer:?}"
            );
        }
    }
}

/// Tests that bodies far smaller than the tolerance are answered as touching or in contact.
#[test]
fn bodies_far_smaller_than_the_tolerance_are_answered() {
    for (size, tolerance) in [(3e-5, 1e-3), (1e-6, 1e-3), (1.0, 1e6)] {
        let away = DVec3::new(0.9, 0.01, 0.02) * tolerance;
        let near = Query::new(
            MovingShape::still(octahedron(size), DVec3::ZERO),
            MovingShape::still(octahedron(size), away),
        );
        let head_on = Query {
            b: MovingShape::moving(octahedron(size), 3.0 * away, -4.0 * away, DVec3::Z),
            ..near.clone()
        };
        let config = Settings {
            tolerance,
            ..Settings::DEFAULT
        };
        for_each_setup(&near, &config, |_, setup, answer| {
            let touching = matches!(answer.outcome, Outcome::Touching { .. });
            assert!(touching, "{size} {setup:?}\n{answer:?}");
        });
        for_each_setup(&head_on, &config, |_, setup, answer| {
            let contact = matches!(answer.outcome, Outcome::Contact { .. });
            assert!(contact, "{size} {setup:?}\n{answer:?}");
        });
    }
}

#[test]
fn a_solid_inside_a_solid_overlaps() {
    let (small, big) = (
        || Shape::from_closed_mesh(cube(0.5).mesh),
        || Shape::from_closed_mesh(cube(2.0).mesh),
    );
    let query_of = |a, b| query(a, b, 0.3 * DVec3::ONE);
    check_outcomes_by_kind(&query_of(big(), small()), |kinds, outcome| {
        is_accepted_overlap(kinds, outcome, |overlap| match overlap {
            Overlap::BInsideA(p) => p.abs().max_element() < 2.0,
            _ => false,
        })
    });
    check_outcomes_by_kind(&query_of(small(), big()), |kinds, outcome| {
        is_accepted_overlap(kinds, outcome, |overlap| match overlap {
            Overlap::AInsideB(p) => p.abs().max_element() <= 0.5,
            _ => false,
        })
    });
}

#[test]
fn a_surface_inside_a_solid_overlaps_but_not_inside_a_surface() {
    let (small, big) = (Shape::from_open_mesh(cube(0.5).mesh), cube(2.0).mesh);
    let in_solid = query(
        Shape::from_closed_mesh(big.clone()),
        small.clone(),
        DVec3::ZERO,
    );
    check_outcomes_by_kind(&in_solid, is_accepted_b_in_a);
    check_outcomes(
        &query(Shape::from_open_mesh(big), small, DVec3::ZERO),
        |o| matches!(o, Outcome::Free { .. }),
    );
}

#[test]
fn the_hole_of_a_torus_is_outside() {
    let ring = torus(1.0, 0.25, 16, 8);
    let ball = |r| Shape::from_closed_mesh(icosphere(r, 1).mesh);
    let free = |o| matches!(o, Outcome::Free { .. });
    check_outcomes(&query(ring.clone(), ball(0.3), DVec3::ZERO), free);
    check_outcomes_by_kind(&query(ring, ball(0.1), DVec3::X), is_accepted_b_in_a);
}

#[test]
fn the_second_of_two_shells_is_found_inside() {
    let two = disjoint_solids(&cube(0.2).moved(9.0 * DVec3::X), &cube(0.2));
    let big = Shape::from_closed_mesh(cube(1.0).mesh);
    check_outcomes_by_kind(&query(big, two, DVec3::ZERO), is_accepted_b_in_a);
}

/// Tests that a body in the middle of a solid is reported inside it, although the solid's patches do not fill its
/// middle.
#[test]
fn a_body_inside_a_solid_that_its_patches_do_not_fill_overlaps() {
    let found = Cell::new(0);
    for seed in 0..4 {
        let rough = boulder(2, 0.4, seed);
        let inside_out = Shape::from_closed_mesh(rough.mesh.clone().with_reversed_faces());
        for big in [rough, inside_out] {
            let query = query(big, icosphere(0.05, 0), DVec3::ZERO);
            check_outcomes_by_kind(&query, |kinds, outcome| {
                let by_winding = is_accepted_b_in_a([PieceKind::Triangles; 2], outcome);
                if by_winding && kinds == [PieceKind::Patches; 2] {
                    found.set(found.get() + 1);
                }
                is_accepted_b_in_a(kinds, outcome)
            });
        }
    }
    assert!(found.get() > 0, "the patches fill every solid");
}

#[test]
fn a_cavity_is_outside() {
    let free = |o| matches!(o, Outcome::Free { .. });
    let ball = || icosphere(1.0, 2);
    for outer in [
        hollow(&cube(1.0), &cube(0.5)),
        hollow(&ball(), &icosphere(0.6, 2)),
        hollow(&boulder(2, 0.2, 7), &boulder(1, 0.2, 8).scaled(0.7)),
    ] {
        for inner in [icosphere(0.1, 1), boulder(1, 0.5, 9).scaled(0.2)] {
            check_outcomes(&query(outer.clone(), inner.clone(), DVec3::ZERO), free);
        }
    }
    let wall = query(
        hollow(&cube(1.0), &cube(0.5)),
        icosphere(0.1, 1),
        0.75 * DVec3::Y,
    );
    check_outcomes_by_kind(&wall, is_accepted_b_in_a);
}

#[test]
fn nothing_moves() {
    let at = |x: f64| {
        Query::new(
            MovingShape::still(cube(0.5), DVec3::ZERO),
            MovingShape::still(
                cube(0.5).placed(DQuat::from_rotation_z(0.3), DVec3::ZERO),
                x * DVec3::X,
            ),
        )
    };
    check_outcomes(&at(3.0), |o| matches!(o, Outcome::Free { .. }));
    check_outcomes(&at(0.9), is_overlap_of_pieces);
}

#[test]
fn no_time_passes() {
    let mut query = query(cube(0.5), cube(0.5), 3.0 * DVec3::X);
    query.duration = 0.0;
    check_outcomes(&query, |o| matches!(o, Outcome::Free { .. }));
}
