//! Makes a triangulated unit sphere with any number of evenly spread vertices.

use ccd_core::glam::DVec3;
use std::f64::consts::{PI, TAU};

/// Returns the vertices of a triangulated unit sphere, and its `2 · vertices − 4` triangles, which face outward.
///
/// Circles of latitude at equal spacing hold vertices in proportion to their length, and are joined
/// by strips of triangles. The construction needs about 12 vertices.
pub(crate) fn sphere(vertices: usize) -> (Vec<DVec3>, Vec<[u32; 3]>) {
    let counts = ring_vertex_counts(vertices);
    let mut points = vec![DVec3::Z];
    let mut faces = Vec::with_capacity(2 * vertices);
    let mut above = Ring {
        first_vertex_index: 0,
        vertex_count: 1,
    };
    for (k, &count) in counts.iter().enumerate() {
        let ring = Ring {
            first_vertex_index: points.len() as u32,
            vertex_count: count,
        };
        let (sin, cos) = (PI * (k + 1) as f64 / (counts.len() + 1) as f64).sin_cos();
        points.extend((0..count).map(|i| {
            let (y, x) = (TAU * i as f64 / count as f64).sin_cos();
            DVec3::new(sin * x, sin * y, cos)
        }));
        join_rings(above, ring, &mut faces);
        above = ring;
    }
    let south = Ring {
        first_vertex_index: points.len() as u32,
        vertex_count: 1,
    };
    points.push(DVec3::NEG_Z);
    join_rings(above, south, &mut faces);
    (points, faces)
}

/// A circle of latitude: vertices with consecutive indices, counted eastward; a pole is a circle of one vertex.
#[derive(Clone, Copy)]
struct Ring {
    first_vertex_index: u32,
    vertex_count: usize,
}

impl Ring {
    fn vertex_index(&self, i: usize) -> u32 {
        self.first_vertex_index + (i % self.vertex_count) as u32
    }

    /// Returns the number of edges of the circle; a pole has none.
    fn ring_edge_count(&self) -> usize {
        if self.vertex_count == 1 {
            0
        } else {
            self.vertex_count
        }
    }
}

/// Returns the number of vertices on each circle of latitude from north to south, without the poles.
fn ring_vertex_counts(vertices: usize) -> Vec<usize> {
    let between_poles = vertices.saturating_sub(2) as f64;
    // The height of equilateral triangles of area 4π / (2 · vertices).
    let height = (2.0 * PI * 3f64.sqrt() / vertices as f64).sqrt();
    let rings = ((PI / height).round() as usize).max(2) - 1;
    let length = |k: usize| (PI * (k + 1) as f64 / (rings + 1) as f64).sin();
    let total: f64 = (0..rings).map(length).sum();
    // Rounding the running sum makes the counts add up.
    let (mut sum, mut used) = (0.0, 0);
    (0..rings)
        .map(|k| {
            sum += length(k);
            let upto = (between_poles * sum / total).round() as usize;
            let count = upto - used;
            used = upto;
            count
        })
        .collect()
}

/// Adds the strip of triangles between two neighbouring circles of latitude, the northern one given first. The next
/// step is always the one whose middle comes first, which keeps the triangles well shaped.
fn join_rings(north: Ring, south: Ring, faces: &mut Vec<[u32; 3]>) {
    let (n, s) = (north.ring_edge_count(), south.ring_edge_count());
    let (mut i, mut j) = (0, 0);
    while i < n || j < s {
        // The middles (2i + 1)/2n and (2j + 1)/2s, compared without rounding.
        if j == s || (i < n && (2 * i + 1) * s <= (2 * j + 1) * n) {
            faces.push([
                north.vertex_index(i),
                south.vertex_index(j),
                north.vertex_index(i + 1),
            ]);
            i += 1;
        } else {
            faces.push([
                north.vertex_index(i),
                south.vertex_index(j),
                south.vertex_index(j + 1),
            ]);
            j += 1;
        }
    }
}
