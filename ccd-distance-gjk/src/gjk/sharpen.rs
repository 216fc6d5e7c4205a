//! Better axes than the difference of the nearest points: those of the features they lie on.

use super::minkowski::{Difference, Exact};
use super::search::Found;
use super::simplex::Vertex;
use crate::tolerance::{KEEP, SHARPEN_CAP};
use ccd_core::glam::DVec3;

/// Looks for an axis that certifies the distance, among those that the difference's vertices near
/// the origin span; the last vertex that was in the way, if there was any.
///
/// An axis in the cone of normals at the nearest vertex f has f as its least vertex. Rounding tilts
/// the nearest point's direction out of that cone when the point is short; so the axis is made
/// perpendicular to one or two of the edges `x − f` that lead to vertices it ran into, again and
/// again, until it runs into none.
pub(crate) fn to_features(exact: &Exact<'_>, found: &mut Found<DVec3>) -> Option<Vertex<DVec3>> {
    let mut fan = Fan::new(found)?;
    if found.axis == DVec3::ZERO {
        // They touched at once: any axis will do to run into the first vertices.
        found.probe(exact, exact.between().try_normalize().unwrap_or(DVec3::X));
    }
    let mut last = None;
    for _ in 0..SHARPEN_CAP {
        let (axis, promise) = fan.best(found.axis);
        // Written so that NaN stops it. What is promised is no less than what the hulls keep.
        if !(promise > found.gap) {
            break;
        }
        let (vertex, _) = found.probe(exact, axis);
        if found.gap > 0.0 && found.gap >= KEEP * found.square.sqrt() || !fan.push(vertex) {
            break;
        }
        last = Some(vertex);
    }
    last
}

/// Tries the faces of a simplex that encloses the origin: the axes of the least way out of it.
pub(crate) fn to_faces(exact: &Exact<'_>, found: &mut Found<DVec3>) {
    let corners = found.simplex.vertices();
    let Ok([a, b, c, d]) = <[Vertex<DVec3>; 4]>::try_from(corners) else {
        return;
    };
    for [a, b, c] in [[a, b, c], [a, b, d], [a, c, d], [b, c, d]] {
        let n = (b.point - a.point).cross(c.point - a.point);
        let inward = if n.dot(a.point) > 0.0 { -n } else { n };
        if let Some(axis) = inward.try_normalize() {
            found.probe(exact, axis);
        }
    }
}

/// Vertices of the difference, as seen from the one that weighs most in the nearest point.
struct Fan {
    /// The nearest point.
    point: DVec3,
    vertices: [DVec3; SHARPEN_CAP],
    len: usize,
}

impl Fan {
    fn new(found: &Found<DVec3>) -> Option<Self> {
        let mut out = Fan {
            point: DVec3::ZERO,
            vertices: [DVec3::ZERO; SHARPEN_CAP],
            len: 0,
        };
        let mut heaviest = (0, f64::NEG_INFINITY);
        for (vertex, weight) in found.simplex.vertices().iter().zip(found.weights) {
            if weight > heaviest.1 {
                heaviest = (out.len, weight);
            }
            out.point += weight * vertex.point;
            out.push(*vertex);
        }
        out.vertices.swap(0, heaviest.0);
        (out.len > 0).then_some(out)
    }

    /// Adds a vertex; `false` if it is there already, or there are too many.
    fn push(&mut self, vertex: Vertex<DVec3>) -> bool {
        let room = self.len < SHARPEN_CAP && !self.vertices[..self.len].contains(&vertex.point);
        if room {
            self.vertices[self.len] = vertex.point;
            self.len += 1;
        }
        room
    }

    /// The axis along which these vertices are farthest from the origin, and how far: the nearest
    /// point, a known axis, or any, as they are or made perpendicular to an edge, or what is
    /// perpendicular to two edges.
    fn best(&self, known: DVec3) -> (DVec3, f64) {
        let centre = self.vertices[0];
        let mut edges = [DVec3::ZERO; SHARPEN_CAP];
        for (edge, vertex) in edges.iter_mut().zip(&self.vertices[1..self.len]) {
            *edge = (vertex - centre).normalize_or_zero();
        }
        let edges = &edges[..self.len - 1];
        let any = match edges.first() {
            Some(e) if e.is_normalized() => e.any_orthonormal_vector(),
            _ => DVec3::X,
        };
        let bases = [self.point, known, any];
        let mut best = (DVec3::ZERO, f64::NEG_INFINITY);
        let mut consider = |axis: DVec3| {
            let axis = axis.normalize_or_zero();
            let low = self.vertices[..self.len]
                .iter()
                .map(|v| axis.dot(*v))
                .fold(f64::INFINITY, f64::min);
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
}
