//! Finds the pieces of two bodies that are near each other, and their near faces, with bounding volume trees.

use super::boxes::{FaceTrees, NearFacePairSearch};
use super::skin::NearSurface;
use crate::body::tree::{NodeChildren, NodeId, NodeOrTriangle, Tree};
use crate::math::order::{greater, lesser};
use crate::math::vector::{length, normal};
use crate::motion::pose::Frame;
use crate::problem::{BodyWithPath, Problem};
use crate::rounding::RAY_BOX_WIDENING_F64;
use glam::DVec3;

/// Returns all pairs of a face of A and a face of B that may be nearer than `reach`. Returns `None` if the search
/// exceeds the problem's budget.
pub(super) fn near_face_pairs(
    problem: &Problem<'_>,
    skins: &mut [NearSurface<'_>; 2],
    b_to_a: &Frame,
    reach: f64,
) -> Option<Vec<[u32; 2]>> {
    let mut trees = <[FaceTrees; 2]>::default();
    let mut near = NearFacePairSearch {
        face_pairs: Vec::new(),
        remaining_budget: problem.budget,
        reach,
    };
    for pieces in near_piece_pairs(problem, b_to_a, reach)? {
        let [a, b] = [0, 1].map(|k| trees[k].root_or_build(&mut skins[k], pieces[k]));
        if let (Some(a), Some(b)) = (a, b) {
            near.add_pairs_below_roots(&trees, [a, b])?;
        }
    }
    Some(near.face_pairs)
}

/// Returns the pairs of pieces that may be nearer than `reach`; `None` if the search exceeds the budget.
fn near_piece_pairs(problem: &Problem<'_>, b_to_a: &Frame, reach: f64) -> Option<Vec<[u32; 2]>> {
    let (a, b) = (problem.a.body.tree(), problem.b.body.tree());
    let (mut near, mut visits) = (Vec::new(), 0);
    let mut stack: Vec<[NodeId; 2]> = vec![[0, 0]];
    while let Some([at_a, at_b]) = stack.pop() {
        let extents = [
            BoundingVolume::new(&problem.a, at_a, &Frame::IDENTITY),
            BoundingVolume::new(&problem.b, at_b, b_to_a),
        ];
        if are_certainly_apart(&extents, reach) {
            continue;
        }
        // As in a schedule, a pair counts when it is split, or examined, not when it is created.
        visits += 1;
        if visits > problem.budget {
            return None;
        }
        match (a.piece(at_a), b.piece(at_b)) {
            (Some(piece_a), Some(piece_b)) => near.push([piece_a, piece_b]),
            (None, Some(_)) => stack.extend(child_ids(a, at_a).map(|at| [at, at_b])),
            (Some(_), None) => stack.extend(child_ids(b, at_b).map(|at| [at_a, at])),
            (None, None) if extents[0].radius >= extents[1].radius => {
                stack.extend(child_ids(a, at_a).map(|at| [at, at_b]));
            }
            (None, None) => stack.extend(child_ids(b, at_b).map(|at| [at_a, at])),
        }
    }
    Some(near)
}

/// Returns the ids of a node's children; empty for a triangle or a node with a single piece.
fn child_ids(tree: &Tree, at: NodeId) -> std::ops::Range<NodeId> {
    match tree.get(at) {
        NodeOrTriangle::Triangle(_) => 0..0,
        NodeOrTriangle::Node(node) => match node.children {
            NodeChildren::Boxes(group) => tree.box_group(group).header.children(),
            NodeChildren::Triangles(group) => tree.triangle_group_header(group).children(),
            NodeChildren::Piece(_) => 0..0,
        },
    }
}

/// The bounding volume of a node or triangle, in A's frame: a ball, with a box or the triangle itself.
struct BoundingVolume {
    center: DVec3,
    radius: f64,
    /// The candidates for a separating axis: the axes of the box, or the normal of the triangle.
    axes: [DVec3; 3],
    shape: BoxOrTriangle,
}

enum BoxOrTriangle {
    /// A box, given by half its extent along each of `axes`.
    Box([f64; 3]),
    Triangle([DVec3; 3]),
}

impl BoundingVolume {
    fn new(side: &BodyWithPath<'_>, at: NodeId, to_a: &Frame) -> Self {
        match side.body.tree().get(at) {
            NodeOrTriangle::Node(node) => {
                let radius = f64::from(node.radius);
                // Axes rounded to f32 are not exactly orthonormal.
                let more = f64::from(node.rounding_radius) + RAY_BOX_WIDENING_F64 * radius;
                BoundingVolume {
                    center: to_a.transform_point(node.center),
                    radius,
                    axes: node.axes.map(|axis| to_a.rotation * axis.as_dvec3()),
                    shape: BoxOrTriangle::Box(node.half_extents.map(|half| f64::from(half) + more)),
                }
            }
            NodeOrTriangle::Triangle(piece) => {
                let corners = side.body.pieces().triangle(piece as usize);
                let corners = corners.map(|corner| to_a.transform_point(corner));
                let center = (corners[0] + corners[1] + corners[2]) / 3.0;
                let arm = |corner: DVec3| corner.distance(center);
                BoundingVolume {
                    center,
                    radius: corners.map(arm).into_iter().fold(0.0, greater),
                    axes: [normal(corners).unwrap_or(DVec3::ZERO); 3],
                    shape: BoxOrTriangle::Triangle(corners),
                }
            }
        }
    }

    /// Returns the interval of the volume's projection on a direction.
    fn projection_interval(&self, n: DVec3) -> [f64; 2] {
        match &self.shape {
            BoxOrTriangle::Box(half) => {
                let reach = |k: usize| half[k] * self.axes[k].dot(n).abs();
                let (middle, reach) = (self.center.dot(n), reach(0) + reach(1) + reach(2));
                [middle - reach, middle + reach]
            }
            BoxOrTriangle::Triangle(corners) => {
                let [a, b, c] = corners.map(|corner| corner.dot(n));
                [lesser(lesser(a, b), c), greater(greater(a, b), c)]
            }
        }
    }
}

/// Returns whether two nodes are certainly farther apart than `reach`. It tries their balls, the axes of both nodes,
/// and the vector between their centers. Written so that NaN counts as near.
fn are_certainly_apart([a, b]: &[BoundingVolume; 2], reach: f64) -> bool {
    let way = b.center - a.center;
    let distance = length(way);
    if distance > a.radius + b.radius + reach {
        return true;
    }
    let separates = |n: DVec3| {
        let ([low_a, high_a], [low_b, high_b]) =
            (a.projection_interval(n), b.projection_interval(n));
        greater(low_b - high_a, low_a - high_b) > reach * length(n)
    };
    let mut axes = a.axes.iter().chain(&b.axes);
    separates(way / distance) || axes.any(|&n| separates(n))
}

#[cfg(test)]
mod tests;
