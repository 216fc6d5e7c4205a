//! The V-Clip step from a pair of a vertex and an edge to the next pair of features `[VCLIP98 §3.2]`.

use crate::feature::Certainty::{Sure, Tied};
use crate::feature::{Feature, MarchStep};
use crate::placed::{Line, PlacedPolytope, RoundingScale};
use crate::tolerance::DOT_PRODUCT_ERROR_BOUND;
use ccd_core::glam::DVec3;

/// Tests the corner against the edge's two vertex-edge planes and two face-edge planes, then the edge against the
/// corner's vertex-edge planes.
///
/// V-Clip cuts the edge with those planes and computes the direction of decreasing distance at both
/// ends of the rest. The distance decreases towards the corner's foot on the edge. The foot is
/// within the rest exactly when it is on the inner side of every plane. Therefore the planes are
/// tested with the foot, which needs no quotient and is exact up to rounding even if an edge meets
/// a plane at a small angle.
#[inline]
pub(crate) fn next<X: PlacedPolytope, Y: PlacedPolytope>(
    x: &X,
    v: u32,
    y: &Y,
    e: u32,
    scale: RoundingScale,
) -> MarchStep {
    let corner = x.vertex(v);
    let edge = y.shape().edge(e);
    let line = y.line(e);
    let from_start = corner - line.start;
    let parameter = from_start.dot(line.direction);
    if parameter < 0.0 {
        return MarchStep::Continue(Feature::Vertex(v), Feature::Vertex(edge.ends[0]));
    }
    if (corner - y.vertex(edge.ends[1])).dot(line.direction) > 0.0 {
        return MarchStep::Continue(Feature::Vertex(v), Feature::Vertex(edge.ends[1]));
    }
    let offset = line.point_at_parameter(parameter) - corner;
    let rounding = scale.rounding();
    if offset.length_squared() <= rounding * rounding {
        return MarchStep::Stop(Tied);
    }
    let inward = y.inward_components(edge, from_start);
    if let Some(face) = face_towards_point(y, edge.faces, inward, from_start) {
        return MarchStep::Continue(Feature::Vertex(v), Feature::Face(face));
    }
    let approach = steepest_edge_towards(x, v, &line, offset, scale);
    if approach.scaled_decrease_rate > 0.0 {
        return MarchStep::Continue(Feature::Edge(approach.edge_at_vertex), Feature::Edge(e));
    }
    let clear = edge.is_outside_voronoi_planes(inward, rounding) && !approach.is_descent_uncertain;
    MarchStep::Stop(if clear { Sure } else { Tied })
}

/// Returns the face of an edge that a point projects towards; of two such faces, the one that the point is higher
/// above. `None` if the point is outside of both face-edge planes.
#[inline(always)]
pub(crate) fn face_towards_point<Y: PlacedPolytope>(
    y: &Y,
    faces: [u32; 2],
    inward: [f64; 2],
    from_edge: DVec3,
) -> Option<u32> {
    match inward.map(|into| into > 0.0) {
        [false, false] => None,
        [true, false] => Some(faces[0]),
        [false, true] => Some(faces[1]),
        [true, true] => {
            let height = faces.map(|f| y.vector(y.shape().face(f).normal).dot(from_edge));
            Some(faces[usize::from(height[1] > height[0])])
        }
    }
}

/// The edge at a corner along which the distance to a given line decreases most.
struct ApproachingEdge {
    edge_at_vertex: u32,
    /// The distance times its rate of decrease along the edge, less an allowance for rounding.
    scaled_decrease_rate: f64,
    /// Whether rounding hides, for some edge at the corner, if the distance decreases along it.
    is_descent_uncertain: bool,
}

/// Finds the edge at a corner along which the distance to a line decreases most; `offset` leads from the corner to the
/// line.
///
/// A step along the corner's edge is matched by one along the line, so only the edge's part across
/// the line counts. It is small for nearly parallel edges, and the allowance for rounding has to be
/// small as well; otherwise their slow approach would be missed.
#[inline(always)]
fn steepest_edge_towards<X: PlacedPolytope>(
    x: &X,
    v: u32,
    line: &Line,
    offset: DVec3,
    scale: RoundingScale,
) -> ApproachingEdge {
    let mut out = ApproachingEdge {
        edge_at_vertex: 0,
        scaled_decrease_rate: 0.0,
        is_descent_uncertain: false,
    };
    let rounding = scale.rounding();
    for spoke in x.shape().outgoing_edges_of(v) {
        let along = x.vector(spoke.edge_direction);
        let slope = along.dot(offset);
        // Written so that NaN is a tie.
        if slope < -rounding {
            continue;
        }
        let across = slope - along.dot(line.direction) * offset.dot(line.direction);
        let sine = along.cross(line.direction).length();
        let slack = rounding * sine + DOT_PRODUCT_ERROR_BOUND * offset.length();
        if across - slack > out.scaled_decrease_rate {
            out.edge_at_vertex = spoke.edge;
            out.scaled_decrease_rate = across - slack;
        }
        out.is_descent_uncertain |= !(across < -slack);
    }
    out
}

#[cfg(test)]
mod tests;
