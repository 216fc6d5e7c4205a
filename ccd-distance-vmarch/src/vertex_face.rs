//! The V-Clip step from a pair of a vertex and a face to the next pair of features `[VCLIP98 §3.2]`.

use crate::feature::Certainty::{Sure, Tied};
use crate::feature::{Feature, LocalMinimum, MarchStep, WhichPolytope};
use crate::placed::{PlacedPolytope, RoundingScale};
use crate::tolerance::DOT_PRODUCT_ERROR_BOUND;
use crate::vertex_vertex::steepest_edge;

/// Tests the corner against all face-edge planes, and continues with the edge of the most violated plane. Above the
/// face, it continues with the corner's edge that falls towards the face most steeply.
///
/// The nearest violated plane would be wrong: its edge need not be nearer.
#[inline]
pub(crate) fn next<X: PlacedPolytope, Y: PlacedPolytope>(
    x: &X,
    v: u32,
    y: &Y,
    f: u32,
    scale: RoundingScale,
) -> MarchStep {
    let corner = x.vertex(v);
    let (mut least, mut outside) = (0.0, None);
    let mut height = 0.0;
    let normal = y.vector(y.shape().face(f).normal);
    for side in y.shape().sides_of(f) {
        let from = corner - y.transform_point(side.start);
        let inside = y.vector(side.inward_direction).dot(from);
        if inside < least {
            (least, outside) = (inside, Some(side.edge));
        }
        height = normal.dot(from);
    }
    if let Some(edge) = outside {
        return MarchStep::Continue(Feature::Vertex(v), Feature::Edge(edge));
    }
    let rounding = scale.rounding();
    if height < -rounding {
        return MarchStep::LocalMinimum(
            WhichPolytope::PolytopeX,
            LocalMinimum {
                feature: Feature::Vertex(v),
                point: corner,
                other_polytope_face: f,
            },
        );
    }
    if height <= rounding {
        return MarchStep::Stop(Tied);
    }
    let falling = steepest_edge(x, v, -normal);
    if falling.slope > DOT_PRODUCT_ERROR_BOUND {
        return MarchStep::Continue(Feature::Edge(falling.edge), Feature::Face(f));
    }
    // The face's normal is accurate up to rounding, however near the corner is.
    MarchStep::Stop(Sure)
}

#[cfg(test)]
mod tests;
