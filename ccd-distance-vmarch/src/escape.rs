//! Escapes from local minima: features behind one face, but not behind all `[VCLIP98 §3.3]`.

use crate::feature::{Feature, MarchStep, WhichPolytope};
use crate::penetration;
use crate::placed::{Placed, Scale};
use ccd_core::glam::DVec3;

/// Continues from a feature of X that is behind a face of Y: to the face that `point`, its point least deep behind that
/// face, is farthest in front of. Without one, the feature is inside of Y.
#[cold]
#[inline(never)]
pub(crate) fn escape_local_minimum<X: Placed, Y: Placed>(
    x: &X,
    feature: Feature,
    point: DVec3,
    y: &Y,
    behind: u32,
    scale: Scale,
) -> MarchStep {
    if let Some((face, height)) = farthest(point, y)
        && height > scale.rounding()
        && face != behind
    {
        return MarchStep::Continue(feature, Feature::Face(face));
    }
    let inside = match feature {
        Feature::Vertex(v) => penetration::inner_corner_crossing(x, v, y),
        Feature::Edge(e) => {
            let mut faces = 0..y.shape().faces.len() as u32;
            let through = faces.find_map(|f| penetration::edge_face_crossing(x, e, y, f));
            // An edge with an inner point that does not cross the surface is entirely inside.
            through.or_else(|| penetration::inner_corner_crossing(x, x.shape().edge(e).ends[0], y))
        }
        Feature::Face(_) => None,
    };
    inside.map_or(MarchStep::Unclear, |crossing| {
        MarchStep::CommonPoint(WhichPolytope::X, crossing)
    })
}

/// Returns the face with the largest height of a point above it, and that height.
fn farthest<Y: Placed>(point: DVec3, y: &Y) -> Option<(u32, f64)> {
    let faces = 0..y.shape().faces.len() as u32;
    let heights = faces.filter_map(|f| {
        let start = y.shape().sides_of(f).first()?.start;
        let normal = y.vector(y.shape().face(f).normal);
        Some((f, normal.dot(point - y.point(start))))
    });
    heights.reduce(|best, here| if here.1 > best.1 { here } else { best })
}

#[cfg(test)]
mod tests;
