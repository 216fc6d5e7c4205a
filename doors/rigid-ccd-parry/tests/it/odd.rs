//! Tests casts whose arguments are numbers such as zeros, infinities and NaN, in one precision.

use super::SPECIAL_NUMBERS;
use super::library::math::{Pose, Real, Rotation, Vector};
use super::library::query::{NonlinearRigidMotion, ShapeCastHit, ShapeCastOptions};
use super::library::shape::{Cone, Cuboid, Cylinder, Segment, SharedShape, TriMesh, Triangle};
use super::ours::{try_cast_shapes, try_cast_shapes_nonlinear};
use crate::scenes::{number, seeded_rng};
use rand::RngExt;
use rand_pcg::Pcg64Mcg;

/// Returns a number of `SPECIAL_NUMBERS` with probability `fraction`, and otherwise a number from −2 to 2.
fn maybe_special_number(rng: &mut Pcg64Mcg, fraction: f32) -> Real {
    if rng.random::<f32>() < fraction {
        SPECIAL_NUMBERS[rng.random_range(0..SPECIAL_NUMBERS.len())]
    } else {
        Real::from(number(rng, -2.0, 2.0))
    }
}

fn maybe_special_vector(rng: &mut Pcg64Mcg, fraction: f32) -> Vector {
    Vector::new(
        maybe_special_number(rng, fraction),
        maybe_special_number(rng, fraction),
        maybe_special_number(rng, fraction),
    )
}

fn maybe_special_pose(rng: &mut Pcg64Mcg, fraction: f32) -> Pose {
    let [x, y, z, w] = std::array::from_fn(|_| maybe_special_number(rng, fraction));
    Pose::from_parts(
        maybe_special_vector(rng, fraction),
        Rotation::from_xyzw(x, y, z, w),
    )
}

fn maybe_special_motion(rng: &mut Pcg64Mcg, fraction: f32) -> NonlinearRigidMotion {
    NonlinearRigidMotion::new(
        maybe_special_pose(rng, fraction),
        maybe_special_vector(rng, fraction),
        maybe_special_vector(rng, fraction),
        maybe_special_vector(rng, fraction),
    )
}

/// Returns a random shape whose sizes may be invalid, because parry does not check them.
fn maybe_invalid_shape(rng: &mut Pcg64Mcg, fraction: f32) -> SharedShape {
    let radius = maybe_special_number(rng, fraction).abs();
    match rng.random_range(0..9) {
        0 => SharedShape::ball(maybe_special_number(rng, fraction)),
        1 => SharedShape::new(Cuboid {
            half_extents: maybe_special_vector(rng, fraction).abs(),
        }),
        2 => SharedShape::capsule(
            maybe_special_vector(rng, fraction),
            maybe_special_vector(rng, fraction),
            radius,
        ),
        3 => SharedShape::new(Segment::new(
            maybe_special_vector(rng, fraction),
            maybe_special_vector(rng, fraction),
        )),
        4 => SharedShape::new(Triangle::new(
            maybe_special_vector(rng, fraction),
            maybe_special_vector(rng, fraction),
            maybe_special_vector(rng, fraction),
        )),
        5 => SharedShape::new(Cylinder {
            half_height: maybe_special_number(rng, fraction),
            radius: maybe_special_number(rng, fraction),
        }),
        6 => SharedShape::new(Cone {
            half_height: maybe_special_number(rng, fraction).abs(),
            radius,
        }),
        7 => {
            let vertices = (0..4)
                .map(|_| maybe_special_vector(rng, 0.3 * fraction))
                .collect();
            let mesh = TriMesh::new(vertices, vec![[0, 1, 2], [0, 2, 3], [1, 1, 3]]);
            SharedShape::new(mesh.expect("triangles"))
        }
        _ => SharedShape::halfspace(maybe_special_vector(rng, fraction)),
    }
}

/// Asserts that a hit is within its interval, has finite points, and has normals of unit length.
fn check(hit: &ShapeCastHit, [start, end]: [Real; 2]) {
    let time = hit.time_of_impact;
    assert!(
        time >= start && time <= end,
        "{hit:?} not from {start} to {end}"
    );
    let vectors = [hit.witness1, hit.witness2, hit.normal1, hit.normal2];
    assert!(vectors.iter().all(|v| v.is_finite()), "{hit:?}");
    let normals = [hit.normal1, hit.normal2].map(|normal| (normal.length() - 1.0).abs());
    assert!(normals.iter().all(|off| *off < 1e-5), "{hit:?}");
}

#[test]
fn odd_numbers_are_answered_or_refused() {
    let (mut hits, mut misses, mut refused) = (0, 0, 0);
    for seed in 0..8_000 {
        let mut rng = seeded_rng(seed);
        let fraction = [0.01, 0.05, 0.3][seed as usize % 3];
        let [a, b] = [0, 1].map(|_| maybe_invalid_shape(&mut rng, fraction));
        let found = match seed % 2 {
            0 => {
                let [m, n] = [0, 1].map(|_| maybe_special_motion(&mut rng, fraction));
                // Millions of turns take long; another test covers the limits.
                let slow = |motion: NonlinearRigidMotion| NonlinearRigidMotion {
                    angvel: motion
                        .angvel
                        .clamp(Vector::splat(-20.0), Vector::splat(20.0)),
                    ..motion
                };
                let times = [
                    maybe_special_number(&mut rng, fraction),
                    maybe_special_number(&mut rng, fraction),
                ];
                let times = times.map(|time| if time.abs() > 1e3 { 2.0 } else { time });
                let found =
                    try_cast_shapes_nonlinear(&slow(m), &*a, &slow(n), &*b, times, seed % 4 == 0);
                found.inspect(|hit| {
                    hit.inspect(|hit| check(hit, times));
                })
            }
            _ => {
                let poses = [0, 1].map(|_| maybe_special_pose(&mut rng, fraction));
                let [v, w] = [0, 1].map(|_| maybe_special_vector(&mut rng, fraction));
                let options = ShapeCastOptions {
                    max_time_of_impact: maybe_special_number(&mut rng, fraction),
                    target_distance: maybe_special_number(&mut rng, fraction).abs(),
                    stop_at_penetration: seed % 4 == 1,
                    compute_impact_geometry_on_penetration: true,
                };
                let found = try_cast_shapes((&poses[0], v, &*a), (&poses[1], w, &*b), options);
                found.inspect(|hit| {
                    hit.inspect(|hit| check(hit, [0.0, options.max_time_of_impact]));
                })
            }
        };
        match found {
            Ok(Some(_)) => hits += 1,
            Ok(None) => misses += 1,
            Err(error) => {
                refused += 1;
                assert!(!error.to_string().is_empty());
            }
        }
    }
    assert!(
        hits > 800 && misses > 800 && refused > 800,
        "{hits} {misses} {refused}"
    );
}
