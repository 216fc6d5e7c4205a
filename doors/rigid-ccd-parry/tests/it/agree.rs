//! Tests that casts agree with the engine's answers for bodies that are made by the engine's own constructors.

use crate::double::make;
use crate::scenes::{
    MotionSpec, ShapeSpec, number, random_motions, random_shape, random_vector, seeded_rng,
};
use rigid_ccd::body::{Pieces, Solidity};
use rigid_ccd::glam::DVec3;
use rigid_ccd::{Body, Motion, Pose, Settings, Solver};
use rigid_ccd_parry::f64::cast_shapes_nonlinear;

fn to_f64(v: [f32; 3]) -> [f64; 3] {
    v.map(f64::from)
}

/// Makes a body with the engine's own constructors.
fn body(recipe: &ShapeSpec) -> Body {
    let points = |points: &[[f32; 3]]| -> Vec<DVec3> {
        points
            .iter()
            .map(|p| DVec3::from_array(to_f64(*p)))
            .collect()
    };
    let made = match recipe {
        ShapeSpec::Ball(radius) => Body::sphere(f64::from(*radius)),
        ShapeSpec::Cuboid(half) => Body::cuboid(to_f64(*half)),
        ShapeSpec::Capsule(a, b, radius) => Body::polytope(rigid_ccd::body::Polytope {
            points: points(&[*a, *b]),
            radius: f64::from(*radius),
            ..rigid_ccd::body::Polytope::default()
        }),
        ShapeSpec::Mesh(vertices, faces) => {
            let ids: Vec<u32> = (0..faces.len() as u32).collect();
            let pieces = Pieces::from_triangles(&points(vertices), faces, &ids).expect("triangles");
            Body::new(&pieces, Solidity::Surface)
        }
        _ => unreachable!("made of these alone"),
    };
    made.expect("a body")
}

fn motion(moves: &MotionSpec) -> Motion {
    let start = Pose::new(to_f64(moves.place), moves.turned.map(f64::from)).expect("a pose");
    let about = Motion::about(
        start,
        to_f64(moves.velocity),
        to_f64(moves.spin),
        to_f64(moves.center),
    );
    about.expect("a motion")
}

#[test]
fn casts_are_the_engines_answers() {
    let (mut hits, mut misses, mut near) = (0, 0, 0);
    for seed in 0..600 {
        let mut rng = seeded_rng(seed);
        let kinds = [
            [0, 1, 3, 9][seed as usize % 4],
            [0, 1, 3, 9][seed as usize / 4 % 4],
        ];
        let recipes = kinds.map(|kind| random_shape(&mut rng, kind));
        let moves = random_motions(&mut rng);
        let config = Settings {
            tolerance: 1e-9,
            ..Settings::DEFAULT
        };
        let [a, b] = [0, 1].map(|k| body(&recipes[k]));
        let [m, n] = [0, 1].map(|k| motion(&moves[k]));
        let mut solver = Solver::new().with_settings(config);
        let engine = solver
            .first_contact((&a, m), (&b, n), 2.0)
            .expect("resolved");
        let mut closest = || {
            let closest = solver.closest_approach((&a, m), (&b, n), 2.0);
            closest.expect("a scene").outcome
        };
        let shapes = [0, 1].map(|k| make::shape(&recipes[k]));
        let [p, q] = moves.map(|moves| make::motion(&moves));
        let hit = cast_shapes_nonlinear(&p, &*shapes[0], &q, &*shapes[1], 0.0, 2.0, true);
        match (
            engine.hit().expect("within the budget"),
            hit.expect("served"),
        ) {
            (Some(engine), Some(hit)) => {
                hits += 1;
                // Even a tangential approach crosses tolerances of 1e-9 in that time.
                let apart = (engine.time - hit.time_of_impact).abs();
                assert!(apart < 1e-4, "seed {seed}: {apart:e}");
                near += u32::from(apart > 1e-8);
            }
            (None, None) => {
                misses += 1;
                if seed % 8 == 0 {
                    let lower = closest().lower();
                    assert!(lower > 0.0, "seed {seed}");
                }
            }
            (engine, hit) => {
                near += 1;
                let lower = closest().lower();
                assert!(lower < 2e-9, "seed {seed}: {engine:?} {hit:?} at {lower:e}");
            }
        }
    }
    assert!(
        hits > 250 && misses > 150 && near < 10,
        "{hits} {misses} {near}"
    );
}

#[test]
fn an_interval_is_part_of_the_whole() {
    let mut later = 0;
    for seed in 0..300 {
        let mut rng = seeded_rng(1000 + seed);
        let shapes = [0, 9].map(|kind| make::shape(&random_shape(&mut rng, kind)));
        let moves = random_motions(&mut rng);
        let [p, q] = moves.map(|moves| make::motion(&moves));
        let cast = |from, to| {
            let hit = cast_shapes_nonlinear(&p, &*shapes[0], &q, &*shapes[1], from, to, true);
            hit.expect("served").map(|hit| hit.time_of_impact)
        };
        let first = cast(0.0, 2.0);
        let start = f64::from(number(&mut rng, 0.01, 0.5));
        match (first, cast(start, 2.0)) {
            (Some(first), Some(found)) if first > start => {
                later += 1;
                assert!(
                    (first - found).abs() < 1e-7 && found >= start,
                    "{first} {found}"
                );
                assert_eq!(cast(start, first - 1e-6), None);
            }
            (Some(first), _) if first <= start => {}
            (None, None) => {}
            other => panic!("seed {seed}: {other:?} after {start}"),
        }
    }
    assert!(later > 80, "{later}");
}

#[test]
fn the_order_of_the_shapes_does_not_matter() {
    for seed in 0..200 {
        let mut rng = seeded_rng(2000 + seed);
        let shapes =
            [seed as u32, seed as u32 / 2].map(|kind| make::shape(&random_shape(&mut rng, kind)));
        let [p, q] = random_motions(&mut rng).map(|moves| make::motion(&moves));
        let [a, b] = &shapes;
        let there = cast_shapes_nonlinear(&p, &**a, &q, &**b, 0.0, 2.0, true).expect("served");
        let back = cast_shapes_nonlinear(&q, &**b, &p, &**a, 0.0, 2.0, true).expect("served");
        let times = [there, back].map(|hit| hit.map(|hit| hit.time_of_impact));
        let near = match times {
            [Some(t), Some(u)] => (t - u).abs() < 1e-5,
            [t, u] => t == u,
        };
        assert!(near, "seed {seed}: {times:?}");
        let _ = random_vector(&mut rng, 1.0);
    }
}
