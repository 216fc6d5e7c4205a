//! Tests whether points are found inside, for shells beside and within each other, with random orientations.

use ccd_core::glam::DVec3;
use ccd_core::schedule::{BestFirst, Schedule};
use ccd_core::{Body, Motion, MovingBody, Outcome, Pose, Settings, StartPolicy};
use ccd_decomp::{PatchOrder, PieceChoice, prepare};
use ccd_distance_gjk::Direct;
use ccd_tests::exact::{ConvexCombination, Location, Solid};
use ccd_tests::models::{Mesh, Shape, boulder, cuboid, icosphere, torus};
use ccd_tests::strategies::random_direction;
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64;

const DETAILS: [PieceChoice; 3] = [
    PieceChoice::Triangles,
    PieceChoice::Patches(PatchOrder::Cresting),
    PieceChoice::Auto,
];

/// Returns a random closed shell around the origin that fits into a ball of radius 1 and contains a ball of radius
/// 0.4.
fn random_shell(rng: &mut Pcg64) -> Shape {
    match rng.random_range(0..3) {
        0 => icosphere(1.0, rng.random_range(0..2)),
        1 => boulder(1, 0.3, rng.random()),
        _ => cuboid(DVec3::splat(0.57)),
    }
}

/// Returns groups of nested shells, each shell with the number of shells around it.
fn nested_shells(rng: &mut Pcg64) -> Vec<(Mesh, usize)> {
    let mut shells = Vec::new();
    for k in 0..rng.random_range(1..4) {
        let at = DVec3::new(3.0 * f64::from(k), rng.random(), rng.random());
        let mut size = rng.random_range(0.8..1.2);
        for depth in 0..rng.random_range(1..5) {
            shells.push((random_shell(rng).scaled(size).moved(at).mesh, depth));
            size *= rng.random_range(0.25..0.35);
        }
    }
    shells
}

fn with_random_windings(shells: &[(Mesh, usize)], rng: &mut Pcg64) -> Mesh {
    let mut all = Mesh {
        vertices: Vec::new(),
        faces: Vec::new(),
    };
    for (shell, _) in shells {
        if rng.random() {
            all.append(&shell.clone().with_reversed_faces());
        } else {
            all.append(shell);
        }
    }
    all
}

fn body(mesh: &Mesh, choice: PieceChoice) -> Body {
    let model = prepare(&mesh.to_triangle_mesh(), choice).expect("a body");
    model.body().expect("a body")
}

fn solve(a: &Body, b: &Body, velocity: DVec3, start: StartPolicy) -> Outcome {
    let moving = |body, velocity| {
        MovingBody::from((
            body,
            Motion::new(Pose::IDENTITY, velocity, DVec3::ZERO).unwrap(),
        ))
    };
    let config = Settings {
        tolerance: 1e-6,
        start_policy: start,
        ..Settings::DEFAULT
    };
    let (a, b) = (moving(a, DVec3::ZERO), moving(b, velocity));
    let problem = ccd_core::Query::new(a, b, 1.0, &config).unwrap();
    BestFirst::default()
        .first_contact(&problem, &mut Direct::default())
        .unwrap()
        .outcome
}

/// Tests that a small body overlaps a solid of shells exactly if an odd number of the shells contain it.
#[test]
fn a_body_inside_overlaps_for_any_winding_of_shells() {
    let mut rng = Pcg64::seed_from_u64(1);
    let mut counts = [0; 2];
    for case in 0..40 {
        let shells = nested_shells(&mut rng);
        let mesh = with_random_windings(&shells, &mut rng);
        let solids: Vec<Solid<'_>> = shells.iter().map(|(mesh, _)| Solid::new(mesh)).collect();
        for choice in DETAILS {
            let outer = body(&mesh, choice);
            for _ in 0..10 {
                let (near, _) = &shells[rng.random_range(0..shells.len())];
                let at = near.vertices[0].lerp(near.vertices[1], rng.random())
                    + random_direction(&mut rng) * 0.1;
                let locations = solids
                    .iter()
                    .map(|solid| solid.locate(&ConvexCombination::mean([at])));
                let around = locations.filter(|location| matches!(location, Location::Inside(_)));
                let inside = around.count() % 2 == 1;
                let speck = body(
                    &cuboid(DVec3::splat(1e-7)).moved(at).mesh,
                    PieceChoice::Triangles,
                );
                let outcome = solve(&outer, &speck, DVec3::ZERO, StartPolicy::Report);
                if matches!(outcome, Outcome::Touching { .. }) {
                    continue;
                }
                let overlaps = matches!(outcome, Outcome::Overlapping { .. });
                assert_eq!(overlaps, inside, "case {case} {choice:?} {at} {outcome:?}");
                counts[usize::from(inside)] += 1;
            }
        }
    }
    assert!(counts[0] > 200 && counts[1] > 200, "{counts:?}");
}

/// Tests that a triangle that rests on a face may leave on the outer side only. A body of some thickness on the inner
/// side overlaps.
#[test]
fn a_body_resting_on_a_face_may_leave_it_outside_only() {
    let mut rng = Pcg64::seed_from_u64(2);
    let mut released = 0;
    for case in 0..60 {
        let shells = nested_shells(&mut rng);
        let mesh = with_random_windings(&shells, &mut rng);
        let outer = body(&mesh, DETAILS[case % 3]);
        for _ in 0..5 {
            let (shell, depth) = &shells[rng.random_range(0..shells.len())];
            let triangle = shell.triangle(rng.random_range(0..shell.faces.len()));
            let [a, b, c] = triangle;
            // Faces point away from the middle; shells at odd depths bound cavities.
            let normal = (b - a).cross(c - a).normalize();
            let out = if depth % 2 == 0 { normal } else { -normal };
            let middle = (a + b + c) / 3.0;
            let small = triangle.map(|p| middle + 0.3 * (p - middle));
            let size = a.distance(b);
            let sheet = Mesh {
                vertices: small.to_vec(),
                faces: vec![[0, 1, 2]],
            };
            let sheet = body(&sheet, PieceChoice::Triangles);
            let speed = 0.02 * size;
            let solve =
                |b: &Body, way: f64| solve(&outer, b, way * speed * out, StartPolicy::Leave);
            let into = solve(&sheet, -1.0);
            // A resting body may come nearer by a few roundings.
            let at_once = |time: f64| time * speed < 3e-12;
            assert!(
                matches!(into, Outcome::Contact { time, .. } if at_once(time)),
                "case {case} {into:?}"
            );
            let away = solve(&sheet, 1.0);
            assert!(
                !matches!(away, Outcome::Contact { time, .. } if at_once(time)),
                "case {case} {away:?}"
            );
            released += usize::from(matches!(away, Outcome::Free { .. }));
            let thick = |tip: DVec3| solve(&tetrahedron(small, tip, DETAILS[case % 3]), 1.0);
            let outside = thick(middle + 0.01 * size * out);
            assert!(
                !matches!(
                    outside,
                    Outcome::Overlapping { .. } | Outcome::Unresolved(_)
                ),
                "case {case} {outside:?}"
            );
            let inside = thick(middle - 0.01 * size * out);
            assert!(
                matches!(inside, Outcome::Overlapping { .. }),
                "case {case} {inside:?}"
            );
        }
    }
    assert!(released > 200, "{released}");
}

/// Returns the tetrahedron of a triangle and a tip on one side of it.
fn tetrahedron(triangle: [DVec3; 3], tip: DVec3, choice: PieceChoice) -> Body {
    let mesh = Mesh {
        vertices: [triangle.as_slice(), &[tip]].concat(),
        faces: vec![[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]],
    };
    body(&mesh, choice)
}

/// Tests that two equal solids at the same pose overlap, although every corner is on the other body's surface.
#[test]
fn equal_bodies_overlap() {
    for shape in [
        cuboid(DVec3::ONE),
        torus(1.0, 0.3, 12, 8),
        icosphere(1.0, 2),
    ] {
        for one in DETAILS {
            for other in DETAILS {
                let [a, b] = [one, other].map(|choice| body(&shape.mesh, choice));
                let outcome = solve(&a, &b, DVec3::ZERO, StartPolicy::Report);
                let overlaps = matches!(outcome, Outcome::Overlapping { .. });
                assert!(overlaps, "{one:?} {other:?} {outcome:?}");
            }
        }
    }
}

/// Tests that one of many separate parts of a body is found inside another body, although the other parts are outside.
#[test]
fn one_part_of_many_that_is_inside_is_found() {
    let outer = cuboid(DVec3::ONE);
    let mut many = Mesh {
        vertices: Vec::new(),
        faces: Vec::new(),
    };
    for k in 0..400 {
        let at = DVec3::new(1.05 + 0.3 * f64::from(k), 0.0, 0.0);
        many.append(&cuboid(DVec3::splat(0.05)).moved(at).mesh);
    }
    let a = body(&outer.mesh, PieceChoice::Triangles);
    let touching = solve(
        &a,
        &body(&many, PieceChoice::Triangles),
        DVec3::ZERO,
        StartPolicy::Report,
    );
    assert!(matches!(touching, Outcome::Touching { .. }), "{touching:?}");
    // All corners of the last one are on the surface or on edges of it.
    let inner = cuboid(DVec3::new(1.0, 1.0, 1.0)).mesh;
    many.append(&inner);
    let overlapping = solve(
        &a,
        &body(&many, PieceChoice::Triangles),
        DVec3::ZERO,
        StartPolicy::Report,
    );
    assert!(
        matches!(overlapping, Outcome::Overlapping { .. }),
        "{overlapping:?}"
    );
}
