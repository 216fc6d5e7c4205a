//! Finds separating axes that a few vertices of the Minkowski difference span.

use super::search::SearchResult;
use super::simplex::{Simplex, Vertex};
use crate::tolerance::MAX_AXIS_VERTICES;
use ccd_core::glam::DVec3;
use ccd_core::order::lesser;
use ccd_core::vector::unit;

/// Vertices of the Minkowski difference that span candidates for a separating axis. The first vertex has the largest
/// weight in the nearest point.
pub(crate) struct CandidateAxisVertices {
    /// The point of the difference that is nearest to the origin.
    nearest_point: DVec3,
    vertices: [Vertex; MAX_AXIS_VERTICES],
    len: usize,
}

impl CandidateAxisVertices {
    /// Creates the candidates from the simplex that a search found; `None` if the simplex is empty.
    pub(crate) fn new(found: &SearchResult) -> Option<Self> {
        let held = found.simplex.vertices();
        let mut out = CandidateAxisVertices {
            nearest_point: DVec3::ZERO,
            vertices: [*held.first()?; MAX_AXIS_VERTICES],
            len: 0,
        };
        let mut heaviest = (0, f64::NEG_INFINITY);
        for (vertex, weight) in held.iter().zip(found.weights) {
            if weight > heaviest.1 {
                heaviest = (out.len, weight);
            }
            out.nearest_point += weight * vertex.point;
            out.push(*vertex);
        }
        out.vertices.swap(0, heaviest.0);
        Some(out)
    }

    fn vertices(&self) -> &[Vertex] {
        &self.vertices[..self.len]
    }

    /// Adds a vertex to the candidates, and returns whether the vertex was added. A duplicate is refused, and so is a
    /// vertex beyond [`MAX_AXIS_VERTICES`].
    pub(crate) fn push(&mut self, vertex: Vertex) -> bool {
        let same = |v: &Vertex| v.point == vertex.point;
        let room = self.len < MAX_AXIS_VERTICES && !self.vertices().iter().any(same);
        if room {
            self.vertices[self.len] = vertex;
            self.len += 1;
        }
        room
    }

    /// Returns the unit axis along which the lowest vertex is highest, and the height of that vertex above the origin.
    ///
    /// The candidates are the nearest point, a known axis, and an arbitrary axis, as they are or made perpendicular to
    /// an edge, and the perpendiculars of two edges.
    pub(crate) fn best_axis(&self, known: DVec3) -> (DVec3, f64) {
        let mut edges = [DVec3::ZERO; MAX_AXIS_VERTICES];
        for (edge, vertex) in edges.iter_mut().zip(self.vertices()) {
            *edge = unit(vertex.point - self.vertices[0].point).unwrap_or(DVec3::ZERO);
        }
        // The first vertex has no edge to itself.
        let edges = &edges[1..self.len];
        let any = match edges.first() {
            Some(&e) if e != DVec3::ZERO => e.any_orthonormal_vector(),
            _ => DVec3::X,
        };
        let bases = [self.nearest_point, known, any];
        let mut best = (DVec3::ZERO, f64::NEG_INFINITY);
        let mut consider = |axis: DVec3| {
            let axis = unit(axis).unwrap_or(DVec3::ZERO);
            let heights = self.vertices().iter().map(|v| axis.dot(v.point));
            let low = heights.fold(f64::INFINITY, lesser);
            if axis != DVec3::ZERO && low > best.1 {
                best = (axis, low);
            }
        };
        bases.into_iter().for_each(&mut consider);
        for (k, &e) in edges.iter().enumerate() {
            for base in bases {
                consider(base - base.dot(e) * e);
            }
            for &f in &edges[..k] {
                let n = e.cross(f);
                // Nearly parallel edges leave a product that rounding tilts along them.
                let n = n - n.dot(e) * e;
                consider(n);
                consider(-n);
            }
        }
        best
    }

    /// Returns the simplex of the up to four vertices with the least heights along an axis.
    pub(crate) fn lowest_vertices(mut self, axis: DVec3) -> Simplex {
        let height = |v: &Vertex| axis.dot(v.point);
        self.vertices[..self.len].sort_by(|v, w| height(v).total_cmp(&height(w)));
        let mut out = Simplex::EMPTY;
        for vertex in self.vertices().iter().take(4) {
            out.push(*vertex);
        }
        out
    }
}
