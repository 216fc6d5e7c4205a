//! Generates a screw and its nut.

use super::{Line, Mesh, Shape, grid_faces};
use ccd_core::glam::DVec3;
use std::f64::consts::TAU;

/// The height of one turn of the thread, in units of length.
pub const PITCH: f64 = 0.5;

/// The number of segments of the coarsest thread, around the axis and along it for each pitch.
const SEGMENTS: usize = 16;
const ROWS_PER_PITCH: usize = 6;

/// Returns the screw's surface about z: four pitches of a wavy thread of mean radius 1, depth 0.1.
/// The number of triangles grows as the square of `fineness`.
pub fn screw(fineness: usize) -> Shape {
    Shape::open(thread(4, 0.0, fineness))
}

/// Returns the nut's inner surface, one pitch high, its bottom one pitch above the origin, with `clearance` to the
/// screw everywhere.
pub fn nut(clearance: f64, fineness: usize) -> Shape {
    Shape::open(thread(1, clearance, fineness)).moved(PITCH * DVec3::Z)
}

/// Returns a helical surface, which a rotation by an angle and a lift by the same fraction of the pitch map to itself,
/// up to its facets.
fn thread(pitches: usize, clearance: f64, fineness: usize) -> Mesh {
    let (segments, rows_per_pitch) = (SEGMENTS * fineness, ROWS_PER_PITCH * fineness);
    let rows = pitches * rows_per_pitch + 1;
    let vertex = |i: usize, j: usize| {
        let turn = j as f64 / segments as f64;
        let z = PITCH * i as f64 / rows_per_pitch as f64;
        let r = 1.0 + clearance + 0.1 * (TAU * (z / PITCH - turn)).cos();
        DVec3::new(r * (TAU * turn).cos(), r * (TAU * turn).sin(), z)
    };
    Mesh {
        vertices: (0..rows)
            .flat_map(|i| (0..segments).map(move |j| vertex(i, j)))
            .collect(),
        faces: grid_faces(Line::Open(rows), Line::Closed(segments)),
    }
}
