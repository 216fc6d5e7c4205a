//! Free times in f64 of flat nodes that approach each other face to face.
//!
//! In f32 the rounding of the gap between two large plates is that of their size. For a finer tolerance all of their
//! nodes would be split before a single pair of pieces is near enough. Their slabs are known in f64.

use super::placed::{ApproachRateBounds, PlacedNode};
use crate::body::tree::{NodeId, NodeOrTriangle, Slab};
use crate::math::order::greater;
use crate::math::vector::{length, unit};
use crate::problem::{BodyWithPath, Problem};
use crate::rounding::{GAP_ERROR_PER_RADIUS_F32, RATE_ERROR_F64};
use crate::tuning::{CLOSED_GAP_TOLERANCE_SHARE, F64_FALLBACK_THRESHOLD, MIN_ROTATION_GAP_SHARE};
use glam::DVec3;

/// Returns a time, from clock `s` on, for which a flat node of A and a flat node of B certainly keep the required gap.
/// The time is 0 if the nodes are not flat, if f32 is fine enough for them, or if rotation uses up more of the gap than
/// their approach.
pub(crate) fn free_time(problem: &Problem<'_>, [a, b]: [NodeId; 2], s: f64) -> f64 {
    let sides = [(&problem.a, a), (&problem.b, b)];
    let [Some(radius_a), Some(radius_b)] = sides.map(|(side, id)| radius_if_flat(side, id)) else {
        return 0.0;
    };
    let rounding = f64::from(GAP_ERROR_PER_RADIUS_F32) * (radius_a + radius_b);
    if !(rounding > F64_FALLBACK_THRESHOLD * problem.kept_node_gap()) {
        return 0.0;
    }
    let [Some(a), Some(b)] = sides.map(|(side, id)| PlacedFlatNode::new(side, id, s)) else {
        return 0.0;
    };
    let along = |n: DVec3| free_time_along(problem, &a, &b, n, s);
    greater(along(a.normal), along(b.normal))
}

/// Returns the radius of a single triangle, or of a node whose box is thin enough for all its triangles to lie in one
/// plane; `None` for other nodes.
fn radius_if_flat(side: &BodyWithPath<'_>, id: NodeId) -> Option<f64> {
    match side.body.tree().get(id) {
        NodeOrTriangle::Node(node) => node.is_thin().then_some(f64::from(node.radius)),
        NodeOrTriangle::Triangle(piece) => {
            let corners = side.body.pieces().triangle(piece as usize);
            let center = (corners[0] + corners[1] + corners[2]) / 3.0;
            let squares = corners.map(|corner| corner.distance_squared(center));
            Some(squares.into_iter().fold(0.0, greater).sqrt())
        }
    }
}

/// A flat node or a single triangle, placed where its body is at a given clock, in the problem's coordinates. All
/// triangles of a flat node lie in one plane, up to rounding.
struct PlacedFlatNode {
    node: PlacedNode,
    /// Half the thickness of the node along its normal; `None` for a triangle, whose corners are known.
    half_thickness: Option<f64>,
    /// The unit normal of the node's plane.
    normal: DVec3,
}

impl PlacedFlatNode {
    fn new(side: &BodyWithPath<'_>, id: NodeId, s: f64) -> Option<Self> {
        let node = PlacedNode::new(side, id, s);
        let tree = side.body.tree();
        let (normal, half) = match tree.get(id) {
            NodeOrTriangle::Node(_) => {
                let &Slab {
                    normal,
                    half_thickness: half,
                } = tree.flat_node_slab(id)?;
                (normal, Some(half))
            }
            NodeOrTriangle::Triangle(piece) => {
                let [a, b, c] = side.body.pieces().triangle(piece as usize);
                (unit((b - a).cross(c - a))?, None)
            }
        };
        Some(PlacedFlatNode {
            normal: node.rotate_vector(normal),
            node,
            half_thickness: half,
        })
    }

    /// Returns `max n·(x − center)` over the node's points `x`, for a unit vector `n`.
    fn extent_along(&self, n: DVec3) -> f64 {
        match self.half_thickness {
            Some(half) => {
                let along = self.normal.dot(n).abs();
                let across = length(n.cross(self.normal));
                half * along + self.node.bounding_radius * (across + RATE_ERROR_F64)
            }
            None => self.node.extent_along(n),
        }
    }
}

/// Returns a time for which a fixed plane perpendicular to `n` certainly keeps the nodes apart; `n` may have either
/// sign.
fn free_time_along(
    problem: &Problem<'_>,
    a: &PlacedFlatNode,
    b: &PlacedFlatNode,
    n: DVec3,
    s: f64,
) -> f64 {
    let way = b.node.center - a.node.center;
    let n = if n.dot(way) < 0.0 { -n } else { n };
    let kept = problem.rounding + problem.kept_node_gap();
    let gap = n.dot(way) - a.extent_along(n) - b.extent_along(-n) - kept;
    // Written so that NaN gives no time.
    if !(gap > CLOSED_GAP_TOLERANCE_SHARE * problem.tolerance) {
        return 0.0;
    }
    let approach =
        ApproachRateBounds::approach_rate_bounds_along_axis(problem, [&a.node, &b.node], n, s);
    let free = approach.free_time(gap);
    // The share of the gap that the nodes' turning uses up shrinks as they are split. Written so that NaN gives no
    // time.
    if free >= 1.0 - s
        || approach.center_approach_rate * free >= (1.0 - MIN_ROTATION_GAP_SHARE) * gap
    {
        free
    } else {
        0.0
    }
}

#[cfg(test)]
mod tests;
