//! Escapes from local minima, where a feature is behind the plane of one face of the other polytope `[VCLIP98 §3.3]`.

use crate::feature::{Feature, LocalMinimum, MarchStep, WhichPolytope};
use crate::penetration;
use crate::placed::{PlacedPolytope, RoundingScale};
use ccd_core::glam::DVec3;

/// Returns the step out of a local minimum of a feature of X. It leads to the face of Y that the feature is farthest in
/// front of, or to a common point, proven by exact signs, if it is behind all faces. The local minimum itself is
/// returned if the feature is behind all faces up to rounding, but exact signs could not prove a common point.
pub(crate) fn escape_local_minimum<X: PlacedPolytope, Y: PlacedPolytope>(
    x: &X,
    minimum: LocalMinimum,
    y: &Y,
    scale: RoundingScale,
) -> MarchStep {
    if let Some((face, height)) = face_farthest_below(minimum.point, y)
        && height > scale.rounding()
        && face != minimum.other_polytope_face
    {
        return MarchStep::Continue(minimum.feature, Feature::Face(face));
    }
    let inside = match minimum.feature {
        Feature::Vertex(v) => penetration::contained_corner_crossing(x, v, y),
        Feature::Edge(e) => {
            let mut faces = 0..y.shape().faces.len() as u32;
            let through = faces.find_map(|f| penetration::edge_face_crossing(x, e, y, f));
            // An edge with an inner point that does not cross the surface is entirely inside.
            through
                .or_else(|| penetration::contained_corner_crossing(x, x.shape().edge(e).ends[0], y))
        }
        Feature::Face(_) => None,
    };
    match inside {
        Some(crossing) => MarchStep::CommonPoint(WhichPolytope::PolytopeX, crossing),
        None => MarchStep::LocalMinimum(WhichPolytope::PolytopeX, minimum),
    }
}

/// Returns the face whose plane the point is highest above, and the signed height; `None` for a polytope without faces.
fn face_farthest_below<Y: PlacedPolytope>(point: DVec3, y: &Y) -> Option<(u32, f64)> {
    let faces = 0..y.shape().faces.len() as u32;
    let heights = faces.filter_map(|f| {
        let start = y.shape().sides_of(f).first()?.start;
        let normal = y.vector(y.shape().face(f).normal);
        Some((f, normal.dot(point - y.transform_point(start))))
    });
    heights.reduce(|best, here| if here.1 > best.1 { here } else { best })
}

#[cfg(test)]
mod tests;
