//! The transition of the march from an edge against a face. The march never ends at such a pair `[VCLIP98 §3.2]`.

use crate::clip;
use crate::edge_edge;
use crate::feature::{Feature, LocalMinimum, MarchStep, WhichPolytope};
use crate::penetration;
use crate::placed::{Line, PlacedPolytope, RoundingScale};

/// Computes the march's next step from an edge and a face, at the edge's lowest point within the face's prism. The step
/// leads to the edge's end, or to the side of the face that clips the edge there. An edge outside the prism leads to
/// the nearest side.
///
/// An edge that has points on both sides of the plane goes through the face if exact signs say so
/// ([`penetration`]); otherwise it passes by the nearest side, however close.
#[inline]
pub(crate) fn next<X: PlacedPolytope, Y: PlacedPolytope>(
    x: &X,
    e: u32,
    y: &Y,
    f: u32,
    scale: RoundingScale,
) -> MarchStep {
    let line = x.line(e);
    let ends = x.shape().edge(e).ends;
    let end = x.vertex(ends[1]);
    let Some([from, to]) = clip::clip_to_prism(&line, end, y, f) else {
        return step_to_nearest_side(e, &line, y, f);
    };
    let normal = y.vector(y.shape().face(f).normal);
    let Some(side) = y.shape().sides_of(f).first() else {
        return step_to_nearest_side(e, &line, y, f);
    };
    // The same product, to the bit, as the slope of the corner's edges in `vertex_face`.
    let slope = line.direction.dot(normal);
    let base = normal.dot(line.start - y.transform_point(side.start));
    let rounding = scale.rounding();
    let falls = slope < 0.0;
    let (low, high) = if falls { (to, from) } else { (from, to) };
    let height = |parameter: f64| base + slope * parameter;
    if height(high.parameter) < -rounding {
        return MarchStep::LocalMinimum(
            WhichPolytope::PolytopeX,
            LocalMinimum {
                feature: Feature::Edge(e),
                point: line.point_at_parameter(high.parameter),
                other_polytope_face: f,
            },
        );
    }
    if height(low.parameter) < rounding {
        if let Some(crossing) = penetration::edge_face_crossing(x, e, y, f) {
            return MarchStep::CommonPoint(WhichPolytope::PolytopeX, crossing);
        }
        if height(low.parameter) < -rounding {
            return step_to_nearest_side(e, &line, y, f);
        }
    }
    match low.cutting_edge {
        None => MarchStep::Continue(Feature::Vertex(ends[usize::from(falls)]), Feature::Face(f)),
        Some(edge) => MarchStep::Continue(Feature::Edge(e), Feature::Edge(edge)),
    }
}

/// Returns the step to the side of the face that is nearest to the given edge.
fn step_to_nearest_side<Y: PlacedPolytope>(e: u32, line: &Line, y: &Y, f: u32) -> MarchStep {
    let sides = y.shape().sides_of(f);
    let (mut least, mut nearest) = (f64::INFINITY, sides.first().map_or(0, |side| side.edge));
    for side in sides {
        let other = y.line(side.edge);
        let [s, t] = edge_edge::nearest_parameters(line, &other).parameters;
        let square = line
            .point_at_parameter(s)
            .distance_squared(other.point_at_parameter(t));
        if square < least {
            (least, nearest) = (square, side.edge);
        }
    }
    MarchStep::Continue(Feature::Edge(e), Feature::Edge(nearest))
}

#[cfg(test)]
mod tests;
