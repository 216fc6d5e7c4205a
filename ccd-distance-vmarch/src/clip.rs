//! Clips edges by the Voronoi planes of a face, and finds the overlap of parallel edges `[VCLIP98 §3.2]`.

use crate::placed::{Line, PlacedPolytope, clamp_parameter};
use ccd_core::glam::DVec3;

/// One end of a clipped edge.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct ClipEnd {
    pub(crate) parameter: f64,
    /// The edge of the face whose Voronoi plane cut the clipped edge; `None` if the clipped edge itself ends here.
    pub(crate) cutting_edge: Option<u32>,
}

/// Clips an edge to the prism above and below a face, and returns both ends of the part inside; `None` if nothing is
/// left.
#[inline]
pub(crate) fn clip_to_prism<Y: PlacedPolytope>(
    line: &Line,
    end: DVec3,
    y: &Y,
    face: u32,
) -> Option<[ClipEnd; 2]> {
    let uncut = |parameter| ClipEnd {
        parameter,
        cutting_edge: None,
    };
    let (mut from, mut to) = (uncut(0.0), uncut(line.length));
    for side in y.shape().sides_of(face) {
        let (start, inward) = (
            y.transform_point(side.start),
            y.vector(side.inward_direction),
        );
        let at_start = (line.start - start).dot(inward);
        let at_end = (end - start).dot(inward);
        if at_start < 0.0 && at_end < 0.0 {
            return None;
        }
        if (at_start < 0.0) == (at_end < 0.0) {
            continue;
        }
        let parameter =
            clamp_parameter(line.length * (at_start / (at_start - at_end)), line.length);
        let cut = ClipEnd {
            parameter,
            cutting_edge: Some(side.edge),
        };
        if at_start < 0.0 && parameter > from.parameter {
            from = cut;
        } else if at_end < 0.0 && parameter < to.parameter {
            to = cut;
        }
    }
    // Written so that no part is left with NaN.
    (from.parameter <= to.parameter).then_some([from, to])
}

/// Returns the middle of the overlap of two parallel segments, or the end of `one` that is nearest to `other`, as a
/// parameter of `one`.
#[inline]
pub(crate) fn parameter_of_overlap_middle(one: &Line, other: &Line) -> f64 {
    let start = one.nearest_parameter(other.start);
    let end = one.nearest_parameter(other.point_at_parameter(other.length));
    0.5 * (start + end)
}

#[cfg(test)]
mod tests;
