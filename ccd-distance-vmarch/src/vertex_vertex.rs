//! The V-Clip step from a pair of two vertices to the next pair of features `[VCLIP98 §3.2]`.

use crate::feature::Certainty::{Sure, Tied};
use crate::feature::{Feature, MarchStep};
use crate::placed::{PlacedPolytope, RoundingScale};
use ccd_core::glam::DVec3;

/// Tests each corner against the other's vertex-edge planes, and continues with the edge behind the most violated
/// plane.
///
/// No slack is needed: [`vertex_edge`](crate::vertex_edge) tests the same plane by the same product
/// of the same numbers, so that no pair returns from there.
#[inline]
pub(crate) fn next<X: PlacedPolytope, Y: PlacedPolytope>(
    x: &X,
    v: u32,
    y: &Y,
    w: u32,
    scale: RoundingScale,
) -> MarchStep {
    let offset = y.vertex(w) - x.vertex(v);
    let rounding = scale.rounding();
    if offset.length_squared() <= rounding * rounding {
        return MarchStep::Stop(Tied);
    }
    let from_x = steepest_edge(x, v, offset);
    if from_x.slope > 0.0 {
        return MarchStep::Continue(Feature::Edge(from_x.edge), Feature::Vertex(w));
    }
    let from_y = steepest_edge(y, w, -offset);
    if from_y.slope > 0.0 {
        return MarchStep::Continue(Feature::Vertex(v), Feature::Edge(from_y.edge));
    }
    let clear = from_x.slope < -rounding && from_y.slope < -rounding;
    MarchStep::Stop(if clear { Sure } else { Tied })
}

/// An edge at a corner, and the scalar product of its unit direction with a given vector.
pub(crate) struct SteepestEdge {
    pub(crate) edge: u32,
    pub(crate) slope: f64,
}

/// Returns the edge at a corner whose unit direction has the largest scalar product with a vector.
#[inline(always)]
pub(crate) fn steepest_edge<P: PlacedPolytope>(
    polytope: &P,
    v: u32,
    offset: DVec3,
) -> SteepestEdge {
    let mut best = SteepestEdge {
        edge: 0,
        slope: f64::NEG_INFINITY,
    };
    for spoke in polytope.shape().outgoing_edges_of(v) {
        let slope = polytope.vector(spoke.edge_direction).dot(offset);
        if slope > best.slope {
            best = SteepestEdge {
                edge: spoke.edge,
                slope,
            };
        }
    }
    best
}

#[cfg(test)]
mod tests;
