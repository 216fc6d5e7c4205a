//! Searches the features around the pair at which the march ended for a nearer pair. It does so if rounding hides the
//! direction in which the distance decreases.

use crate::edge_edge::{self, vertex_or_edge_at};
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
pub(crate) fn nearer_neighbour_pair(
    placed: &PlacedPair<'_>,
    pair: Pair,
    distance: f64,
) -> Option<Pair> {
    let a = SurroundingFeatures::new(&placed.a, pair.a);
    let b = SurroundingFeatures::new(&placed.b, pair.b);
    if a.edges.len() * b.edges.len() > MAX_TIE_EDGE_PAIRS {
        return None;
    }
    let mut best = (distance - placed.scale.rounding(), None);
    let mut keep_if_nearer = |distance: f64, a: Feature, b: Feature| {
        if distance < best.0 {
            best = (distance, Some(Pair { a, b }));
        }
    };
    for &e in &a.edges {
        let one = placed.a.line(e);
        for &f in &b.edges {
            let other = placed.b.line(f);
            let [s, t] = edge_edge::nearest_parameters(&one, &other).parameters;
            let distance = one
                .point_at_parameter(s)
                .distance(other.point_at_parameter(t));
            let on_a = vertex_or_edge_at(&placed.a, e, s);
            keep_if_nearer(distance, on_a, vertex_or_edge_at(&placed.b, f, t));
        }
    }
    visit_vertex_feature_pairs(&placed.a, &a.vertices, &placed.b, &b, &mut keep_if_nearer);
    visit_vertex_feature_pairs(&placed.b, &b.vertices, &placed.a, &a, |distance, v, w| {
        keep_if_nearer(distance, w, v);
    });
    best.1
}

/// Offers each pair of a vertex of X with an edge or face around a feature of Y, and their distance.
fn visit_vertex_feature_pairs<X: PlacedPolytope, Y: PlacedPolytope>(
    x: &X,
    vertices: &[u32],
    y: &Y,
    around: &SurroundingFeatures,
    mut offer: impl FnMut(f64, Feature, Feature),
) {
    for &v in vertices {
        let point = x.vertex(v);
        for &e in &around.edges {
            let line = y.line(e);
            let t = line.nearest_parameter(point);
            let end = vertex_or_edge_at(y, e, t);
            offer(
                line.point_at_parameter(t).distance(point),
                Feature::Vertex(v),
                end,
            );
        }
        for &f in &around.faces {
            let height = height_above_face(point, y, f);
            offer(height, Feature::Vertex(v), Feature::Face(f));
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
        let own = shape.edges_containing(feature);
        let faces = shape.faces_containing(feature, &own);
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

/// Returns the height of a point above a face; infinite if the point is behind the face or does not project onto it.
fn height_above_face<P: PlacedPolytope>(point: DVec3, polytope: &P, f: u32) -> f64 {
    let mut height = f64::INFINITY;
    let normal = polytope.vector(polytope.shape().face(f).normal);
    for side in polytope.shape().sides_of(f) {
        let from = point - polytope.transform_point(side.start);
        if !(polytope.vector(side.inward_direction).dot(from) >= 0.0) {
            return f64::INFINITY;
        }
        height = normal.dot(from);
    }
    if height >= 0.0 { height } else { f64::INFINITY }
}

#[cfg(test)]
mod tests;
