//! Searches the features around the pair at which the march ended for a nearer pair. It does so if rounding hides the
//! direction in which the distance decreases.

use crate::edge_edge;
use crate::feature::{Feature, Pair};
use crate::placed::{PlacedPair, PlacedPolytope};
use crate::tolerance::MAX_TIE_EDGE_PAIRS;
use ccd_core::glam::DVec3;

/// Searches the features of the faces around a pair for the nearest pair, and returns it if it is nearer than
/// `distance` by more than rounding.
///
/// Every local minimum of the distance of convex sets is global: if no neighbouring pair is nearer, no pair is. Unlike
/// a march, this does not compare directions of decreasing distance, which are rounding at a tie, but distances, which
/// are accurate.
pub(crate) fn nearer_pair(placed: &PlacedPair<'_>, pair: Pair, distance: f64) -> Option<Pair> {
    let (a, b) = (
        SurroundingFeatures::new(&placed.a, pair.a),
        SurroundingFeatures::new(&placed.b, pair.b),
    );
    if a.edges.len() * b.edges.len() > MAX_TIE_EDGE_PAIRS {
        return None;
    }
    let mut best = NearestPair {
        distance: distance - placed.scale.rounding(),
        pair: None,
    };
    for &e in &a.edges {
        let one = placed.a.line(e);
        for &f in &b.edges {
            let other = placed.b.line(f);
            let [s, t] = edge_edge::nearest_parameters(&one, &other).parameters;
            let ends = (
                vertex_or_edge_at(&placed.a, e, s),
                vertex_or_edge_at(&placed.b, f, t),
            );
            best.keep_if_nearer(one.point_at(s).distance(other.point_at(t)), ends.0, ends.1);
        }
    }
    for &v in &a.vertices {
        let point = placed.a.vertex(v);
        for &f in &b.edges {
            let line = placed.b.line(f);
            let t = line.nearest_parameter(point);
            let end = vertex_or_edge_at(&placed.b, f, t);
            best.keep_if_nearer(line.point_at(t).distance(point), Feature::Vertex(v), end);
        }
        for &f in &b.faces {
            let height = height_above_face(point, &placed.b, f);
            best.keep_if_nearer(height, Feature::Vertex(v), Feature::Face(f));
        }
    }
    for &w in &b.vertices {
        let point = placed.b.vertex(w);
        for &e in &a.edges {
            let line = placed.a.line(e);
            let s = line.nearest_parameter(point);
            let end = vertex_or_edge_at(&placed.a, e, s);
            best.keep_if_nearer(line.point_at(s).distance(point), end, Feature::Vertex(w));
        }
        for &f in &a.faces {
            let height = height_above_face(point, &placed.a, f);
            best.keep_if_nearer(height, Feature::Face(f), Feature::Vertex(w));
        }
    }
    best.pair
}

/// The nearest pair of features found so far, and its distance; `None` until a pair is nearer than the initial
/// distance.
struct NearestPair {
    distance: f64,
    pair: Option<Pair>,
}

impl NearestPair {
    fn keep_if_nearer(&mut self, distance: f64, a: Feature, b: Feature) {
        if distance < self.distance {
            self.distance = distance;
            self.pair = Some(Pair { a, b });
        }
    }
}

/// The features of all faces that meet in a given feature.
struct SurroundingFeatures {
    vertices: Vec<u32>,
    edges: Vec<u32>,
    faces: Vec<u32>,
}

impl SurroundingFeatures {
    fn new<P: PlacedPolytope>(polytope: &P, feature: Feature) -> Self {
        let shape = polytope.shape();
        let own = shape.edges_at(feature);
        let faces = shape.faces_at(feature, &own);
        let sides = faces.iter().flat_map(|&f| shape.sides_of(f));
        let mut edges: Vec<u32> = sides.map(|side| side.edge).chain(own).collect();
        let mut vertices: Vec<u32> = edges.iter().flat_map(|&e| shape.edge(e).ends).collect();
        if let Feature::Vertex(v) = feature {
            vertices.push(v);
        }
        for list in [&mut vertices, &mut edges] {
            list.sort_unstable();
            list.dedup();
        }
        SurroundingFeatures {
            vertices,
            edges,
            faces,
        }
    }
}

/// Returns the end vertex of an edge that is at a parameter, or the edge itself for a parameter between the ends.
fn vertex_or_edge_at<P: PlacedPolytope>(polytope: &P, e: u32, parameter: f64) -> Feature {
    let end = edge_edge::end_vertex_at(polytope.shape().edge(e), parameter);
    end.map_or(Feature::Edge(e), Feature::Vertex)
}

/// Returns the height of a point above a face; infinite if the point is behind the face or does not project onto it.
fn height_above_face<P: PlacedPolytope>(point: DVec3, polytope: &P, f: u32) -> f64 {
    let mut height = f64::INFINITY;
    let normal = polytope.vector(polytope.shape().face(f).normal);
    for side in polytope.shape().sides_of(f) {
        let from = point - polytope.point(side.start);
        if !(polytope.vector(side.inward_direction).dot(from) >= 0.0) {
            return f64::INFINITY;
        }
        height = normal.dot(from);
    }
    if height >= 0.0 { height } else { f64::INFINITY }
}

#[cfg(test)]
mod tests;
