//! Tests casts against half-spaces: linear casts by comparison with parry, and casts of rotating bodies.

use crate::double::library::math::{Pose, Vector};
use crate::double::library::query::{self, NonlinearRigidMotion, ShapeCastOptions};
use crate::double::library::shape::{HalfSpace, Shape};
use crate::double::make;
use crate::scenes::{number, random_motions, random_shape, seeded_rng, turn};
use ccd_core::order::lesser;
use rigid_ccd_parry::f64::{cast_shapes, cast_shapes_nonlinear};

/// Returns the height of the lowest point of a shape above a plane.
fn height(plane: &Pose, normal: Vector, at: &Pose, shape: &dyn Shape) -> f64 {
    let map = shape.as_support_map().expect("convex");
    let inner = plane.inv_mul(at);
    map.support_point(&inner, -normal).dot(normal)
}

#[test]
fn straight_casts_are_parrys() {
    let (mut hits, mut misses) = (0, 0);
    for seed in 0..400 {
        let mut rng = seeded_rng(seed);
        let kind = [0, 1, 2, 3, 4, 5, 7, 8][seed as usize % 8];
        let body = make::shape(&random_shape(&mut rng, kind));
        let [x, y, z, _] = turn(&mut rng).map(f64::from);
        let plane = HalfSpace::new(Vector::new(x, y, z).normalize());
        let moves = random_motions(&mut rng);
        let [p, q] = moves.map(|moves| make::pose(moves.place, moves.turned));
        let [v, w] = moves.map(|moves| make::vector(moves.velocity));
        // Half of the bodies fly away.
        let v = [1.0, -1.0][seed as usize / 4 % 2] * v;
        // Every second time the interval has no end: the bodies pass the plane at some time or never.
        let max_time_of_impact = [2.0, f64::MAX][seed as usize % 2];
        let options = ShapeCastOptions {
            target_distance: [0.0, 0.3][seed as usize / 2 % 2],
            ..ShapeCastOptions::with_max_time_of_impact(max_time_of_impact)
        };
        let theirs = query::cast_shapes(&p, v, &*body, &q, w, &plane, options).expect("supported");
        let ours = cast_shapes(&p, v, &*body, &q, w, &plane, options).expect("served");
        match (theirs, ours) {
            (Some(theirs), Some(ours)) => {
                hits += 1;
                let (late, early) = (ours.time_of_impact, theirs.time_of_impact);
                assert!(
                    late <= early * (1.0 + 1e-12) + 1e-14,
                    "seed {seed}: {late} {early}"
                );
                let normal = plane.normal.dot(ours.normal2);
                assert!(normal > 0.999999 || late == 0.0, "seed {seed}: {normal}");
            }
            (None, None) => misses += 1,
            other => panic!("seed {seed}: {other:?}"),
        }
    }
    assert!(hits > 100 && misses > 60, "{hits} {misses}");
}

#[test]
fn turning_bodies_stay_above_until_they_are_hit() {
    let (mut hits, mut misses) = (0, 0);
    for seed in 0..300 {
        let mut rng = seeded_rng(seed);
        let kind = [1, 3, 5, 8][seed as usize % 4];
        let body = make::shape(&random_shape(&mut rng, kind));
        let plane = HalfSpace::new(Vector::Y);
        let [mut moves, mut ground] = random_motions(&mut rng);
        moves.place[1] = number(&mut rng, 1.0, 2.0);
        // The ground tilts in half of the cases.
        let tilt = [0.0, 0.3][seed as usize / 4 % 2];
        ground.spin = ground.spin.map(|w| tilt * w);
        ground.turned = [0.0, 0.0, 0.0, 1.0];
        let [m, n] = [moves, ground].map(|moves| make::motion(&moves));
        let hit = cast_shapes_nonlinear(&m, &*body, &n, &plane, 0.0, 1.0, true).expect("served");
        let end = hit.map_or(1.0, |hit| hit.time_of_impact);
        let at = |time: f64| {
            let (above, ground) = (m.position_at_time(time), n.position_at_time(time));
            height(&ground, Vector::Y, &above, &*body)
        };
        let least = (0..200)
            .map(|k| at(end * f64::from(k) / 200.0))
            .fold(f64::INFINITY, lesser);
        assert!(
            least > 0.0 || end == 0.0,
            "seed {seed}: {least:e} before {end}"
        );
        match hit {
            Some(hit) => {
                hits += 1;
                assert!(at(hit.time_of_impact) < 1e-8, "seed {seed}");
            }
            None => misses += 1,
        }
    }
    assert!(hits > 60 && misses > 60, "{hits} {misses}");
}

#[test]
fn a_wheel_that_rolls_without_end_is_above_the_ground_for_ever() {
    let (wheel, ground) = (
        crate::double::library::shape::Cuboid::new(Vector::splat(0.3)),
        HalfSpace::new(Vector::Y),
    );
    let start = Pose::translation(0.0, 1.0, 0.0);
    let rolls = NonlinearRigidMotion::new(start, Vector::ZERO, Vector::ZERO, Vector::Z);
    let rests = NonlinearRigidMotion::identity();
    let cast = |motion: &NonlinearRigidMotion| {
        cast_shapes_nonlinear(motion, &wheel, &rests, &ground, 0.0, f64::INFINITY, true)
            .expect("served")
    };
    assert!(cast(&rolls).is_none());
    let rises = NonlinearRigidMotion::new(start, Vector::ZERO, 1e-3 * Vector::Y, Vector::Z);
    assert!(cast(&rises).is_none());
    // The body comes down so slowly that it rotates 86 times before.
    let sinks = NonlinearRigidMotion::new(start, Vector::ZERO, -1e-3 * Vector::Y, Vector::Z);
    let hit = cast(&sinks).expect("it comes down");
    assert!(
        hit.time_of_impact > 400.0 && hit.time_of_impact < 700.0,
        "{hit:?}"
    );
}

#[test]
fn two_half_spaces_are_refused() {
    let (ground, rests) = (HalfSpace::new(Vector::Y), NonlinearRigidMotion::identity());
    assert!(cast_shapes_nonlinear(&rests, &ground, &rests, &ground, 0.0, 1.0, true).is_err());
}
