//! The space of attempts: draws one, and moves from one to a neighbour.

use super::attempt::{Attempt, Body};
use crate::scene::model::sphere::sphere;
use crate::scene::model::{Board, Ring};
use crate::scene::unit_vector;
use ccd_core::glam::DVec3;
use ccd_decomp::{MeshError, TriangleMesh};
use rand::seq::IndexedRandom;
use rand::{Rng, RngExt};

/// The tolerances that are drawn.
const TOLERANCES: [f64; 4] = [1e-2, 1e-3, 1e-4, 1e-6];

/// Draws an attempt: body B rests, and body A is aimed at a point of it.
///
/// # Errors
/// If a mesh is invalid.
pub(super) fn draw(rng: &mut impl Rng) -> Result<Attempt, MeshError> {
    let mut a = body(rng)?;
    let mut b = body(rng)?;
    b.motion.turned = DVec3::ZERO;
    if rng.random_bool(0.7) {
        a.motion.spin = log(rng, 0.1, 30.0) * unit_vector(rng);
    }
    if rng.random_bool(0.3) {
        b.motion.spin = log(rng, 0.1, 10.0) * unit_vector(rng);
    }
    if rng.random_bool(0.3) {
        a.motion.centre = log(rng, 0.1, 3.0) * unit_vector(rng);
    }
    let target = inside(rng, &b);
    let meets_at = rng.random_range(0.05..0.95);
    a.motion.velocity = log(rng, 1.0, 30.0) * unit_vector(rng);
    a.motion.at = target - meets_at * a.motion.velocity;
    let tolerance = *TOLERANCES.choose(rng).unwrap_or(&TOLERANCES[0]);
    Ok(Attempt {
        bodies: [a, b],
        tolerance,
    })
}

/// Draws a body of up to 60 triangles.
fn body(rng: &mut impl Rng) -> Result<Body, MeshError> {
    let mesh = match rng.random_range(0..7) {
        0 => soup(rng, 1)?,
        1 => {
            let count = rng.random_range(2..6);
            soup(rng, count)?
        }
        2 => tetrahedron(rng)?,
        3 => {
            let half_extents = DVec3::from_array([(); 3].map(|()| log(rng, 0.02, 1.0)));
            Board { half_extents }.mesh()?
        }
        4 => {
            let (vertices, faces) = sphere(rng.random_range(6..32));
            TriangleMesh::new(vertices, &faces)?
        }
        5 => {
            let ring = Ring {
                segments: rng.random_range(3..8),
                sides: rng.random_range(3..5),
                radius: 1.0,
                tube: rng.random_range(0.05..0.4),
            };
            ring.mesh()?
        }
        _ => needle(rng)?,
    };
    Ok(Body::new(&mesh))
}

/// Draws triangles of corners in a ball, each on its own.
fn soup(rng: &mut impl Rng, count: u32) -> Result<TriangleMesh, MeshError> {
    let vertices = (0..3 * count).map(|_| unit_vector(rng)).collect();
    let faces: Vec<[u32; 3]> = (0..count).map(|k| [0, 1, 2].map(|j| 3 * k + j)).collect();
    TriangleMesh::new(vertices, &faces)
}

fn tetrahedron(rng: &mut impl Rng) -> Result<TriangleMesh, MeshError> {
    let vertices: Vec<DVec3> = (0..4).map(|_| unit_vector(rng)).collect();
    TriangleMesh::new(vertices, &[[0, 2, 1], [0, 1, 3], [1, 2, 3], [0, 3, 2]])
}

/// Draws a triangle of which one side is short.
fn needle(rng: &mut impl Rng) -> Result<TriangleMesh, MeshError> {
    let tip = unit_vector(rng);
    let end = unit_vector(rng);
    let beside = end + log(rng, 1e-9, 1e-1) * unit_vector(rng);
    TriangleMesh::new(vec![tip, end, beside], &[[0, 1, 2]])
}

/// Returns a point of a random triangle of a body.
fn inside(rng: &mut impl Rng, body: &Body) -> DVec3 {
    let Some(face) = body.faces.choose(rng) else {
        return DVec3::ZERO;
    };
    let [a, b, c] = face.map(|corner| body.vertices[corner as usize]);
    let (s, t): (f64, f64) = (rng.random(), rng.random());
    a + s * ((b - a) + t * (c - b))
}

/// Moves an attempt to a neighbour: a small or a large change of one thing.
pub(super) fn neighbour(rng: &mut impl Rng, attempt: &Attempt) -> Attempt {
    let mut next = attempt.clone();
    // Some neighbours are only reached by two changes at once.
    for _ in 0..rng.random_range(1..3) {
        change(rng, &mut next);
    }
    next
}

fn change(rng: &mut impl Rng, attempt: &mut Attempt) {
    let which = rng.random_range(0..2);
    match rng.random_range(0..12) {
        0..3 => change_number(rng, attempt),
        3 => {
            let by = log(rng, 0.1, 10.0);
            attempt.bodies[which].motion.velocity *= by;
        }
        4 => {
            let motion = &mut attempt.bodies[which].motion;
            motion.spin = match rng.random_range(0..3) {
                0 => DVec3::ZERO,
                1 => motion.spin * log(rng, 0.1, 10.0),
                _ => log(rng, 1e-3, 100.0) * unit_vector(rng),
            };
        }
        5 => {
            let motion = &mut attempt.bodies[which].motion;
            motion.at += rng.random_range(-0.1..0.1) * motion.velocity;
        }
        6 => {
            let axis = rng.random_range(0..3);
            let by = log(rng, 1e-3, 1e3);
            for vertex in &mut attempt.bodies[which].vertices {
                vertex[axis] *= by;
            }
        }
        7 => {
            let by = log(rng, 1e-2, 1e2);
            for vertex in &mut attempt.bodies[which].vertices {
                *vertex *= by;
            }
        }
        8 => {
            let by = log(rng, 1.0, 1e8) * unit_vector(rng);
            for body in &mut attempt.bodies {
                body.motion.at += by;
            }
        }
        9 => change_faces(rng, &mut attempt.bodies[which]),
        10 => {
            if let Ok(drawn) = body(rng) {
                let body = &mut attempt.bodies[which];
                body.vertices = drawn.vertices;
                body.faces = drawn.faces;
            }
        }
        _ => {
            if let Some(&tolerance) = TOLERANCES.choose(rng) {
                attempt.tolerance = tolerance;
            }
        }
    }
}

/// Moves one number a little, or makes it equal to another one, its negative, or a round one.
fn change_number(rng: &mut impl Rng, attempt: &mut Attempt) {
    let size = attempt.bodies[0].size() + attempt.bodies[1].size();
    let step = size * log(rng, 1e-15, 1.0);
    let up = rng.random_bool(0.5);
    let how = rng.random_range(0..8);
    let mut numbers = attempt.numbers();
    let from = *numbers[rng.random_range(0..numbers.len())];
    let to = rng.random_range(0..numbers.len());
    let number = &mut *numbers[to];
    *number = match how {
        0 => 0.0,
        1 => from,
        2 => -*number,
        3 => number.round(),
        _ if up => *number + step,
        _ => *number - step,
    };
}

/// Drops, repeats, turns or adds a face.
fn change_faces(rng: &mut impl Rng, body: &mut Body) {
    if body.faces.is_empty() {
        return;
    }
    let at = rng.random_range(0..body.faces.len());
    let [p, q, r] = body.faces[at];
    match rng.random_range(0..4) {
        0 if body.faces.len() > 1 => {
            body.faces.swap_remove(at);
            body.compact();
        }
        1 => body.faces.push([p, q, r]),
        2 => body.faces[at] = [p, r, q],
        _ => {
            let beside = body.vertices[p as usize] + body.size() * unit_vector(rng);
            body.vertices.push(beside);
            body.faces.push([p, q, body.vertices.len() as u32 - 1]);
        }
    }
}

/// Draws a number whose logarithm is uniform.
fn log(rng: &mut impl Rng, least: f64, most: f64) -> f64 {
    (rng.random_range(least.ln()..most.ln())).exp()
}
