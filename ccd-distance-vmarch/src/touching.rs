//! Finds separating axes for pieces that have a common point, but possibly only touch there.

use crate::certificate::{Axis, best_axis};
use crate::feature::{CommonPoint, Feature, Pair, WhichPolytope};
use crate::placed::{PlacedPair, PlacedPolytope, RoundingScale};
use crate::polytope::Polytope;
use crate::witness::{self, Witness};
use ccd_core::Claim;

/// Returns the claim about pieces with a proven common point.
///
/// Its axis is the normal of the crossed face or, if the point is on the border of its features, the best separating
/// axis nearby: the pieces may only touch.
pub(crate) fn common_point_claim(
    placed: &PlacedPair<'_>,
    which: WhichPolytope,
    crossing: &CommonPoint,
) -> Claim {
    let claim = witness::common_point_claim(placed, which, crossing);
    let Some(pair) = touching_features(placed, which, crossing) else {
        return claim;
    };
    let normal = Axis::from_direction(placed, claim.axis);
    let best = best_axis(placed, pair, &Witness::new(placed, pair));
    // Written so that NaN changes nothing.
    if best.gap > normal.gap {
        return Claim {
            axis: best.direction,
            ..claim
        };
    }
    claim
}

/// Returns the features that contain a common point; `None` if the interiors certainly meet. They meet if an edge
/// passes through the interior of a face, or a point is inside a polytope.
fn touching_features(
    placed: &PlacedPair<'_>,
    which: WhichPolytope,
    crossing: &CommonPoint,
) -> Option<Pair> {
    let PlacedPair { a, b, scale } = placed;
    let found = match which {
        WhichPolytope::PolytopeX => features(a, b, crossing, *scale),
        WhichPolytope::PolytopeY => features(b, a, crossing, *scale).map(|(x, y)| (y, x)),
    };
    found.map(|(a, b)| Pair { a, b })
}

fn features<X: PlacedPolytope, Y: PlacedPolytope>(
    x: &X,
    y: &Y,
    crossing: &CommonPoint,
    scale: RoundingScale,
) -> Option<(Feature, Feature)> {
    let (on_edge, on_face) = (&crossing.edge_ends, &crossing.face_corners);
    let face = Feature::Face(crossing.face);
    let some = scale.rounding() / scale.size;
    let [start, end] = on_edge.vertices;
    let of_x = match on_edge.weights {
        [_, last] if last <= some || start == end => Feature::Vertex(start),
        [first, _] if first <= some => Feature::Vertex(end),
        _ => edge_between(x.shape(), start, end)?,
    };
    let corners = on_face.vertices.iter().zip(on_face.weights);
    let mut held = corners.filter(|at| at.1 > some).map(|at| *at.0);
    let of_y = match (held.next(), held.next(), held.next(), held.next()) {
        (Some(v), None, ..) => Feature::Vertex(v),
        (Some(v), Some(w), None, _) => edge_between(y.shape(), v, w).unwrap_or(face),
        (_, _, Some(_), None) => face,
        _ => return None,
    };
    if let (Feature::Edge(e), Feature::Face(f)) = (of_x, of_y) {
        let normal = y.vector(y.shape().face(f).normal);
        let line = x.line(e);
        let rise = normal.dot(line.direction).abs() * line.length;
        return (rise <= scale.rounding()).then_some((of_x, of_y));
    }
    Some((of_x, of_y))
}

/// Returns the edge between two vertices, if there is one.
fn edge_between(shape: &Polytope, v: u32, w: u32) -> Option<Feature> {
    let mut spokes = shape.outgoing_edges_of(v).iter();
    let spoke = spokes.find(|spoke| spoke.end_vertex == w)?;
    Some(Feature::Edge(spoke.edge))
}
