//! Generates a screw and its nut.

use super::{GridExtent, Mesh, Shape, grid_faces};
use ccd_core::glam::DVec3;
use std::f64::consts::TAU;

/// The height of one turn of the thread, in units of length.
pub const PITCH: f64 = 0.5;

/// The number of segments around the axis of the coarsest thread.
const SEGMENTS_PER_TURN: usize = 16;
/// The number of segments along the axis of the coarsest thread, for each pitch.
const ROWS_PER_PITCH: usize = 6;

/// Returns the surface of a screw about z: four pitches of a thread with a sine profile, mean radius 1 and amplitude
/// 0.1. The number of triangles grows as the square of `fineness`.
pub fn screw(fineness: usize) -> Shape {
    Shape::from_open_mesh(thread_surface(4, 0.0, fineness))
}

/// Returns the inner surface of the nut: one pitch high, from z = [`PITCH`] on, and wider than the screw by
/// `clearance`.
pub fn nut_thread(clearance: f64, fineness: usize) -> Shape {
    Shape::from_open_mesh(thread_surface(1, clearance, fineness)).moved(PITCH * DVec3::Z)
}

/// Returns a helical surface: a rotation by an angle and a lift by the same fraction of the pitch map it to itself, up
/// to its facets.
fn thread_surface(pitches: usize, clearance: f64, fineness: usize) -> Mesh {
    let (segments, rows_per_pitch) = (SEGMENTS_PER_TURN * fineness, ROWS_PER_PITCH * fineness);
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
        faces: grid_faces(GridExtent::Bounded(rows), GridExtent::Wrapping(segments)),
    }
}
