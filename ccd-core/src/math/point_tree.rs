//! A tree of points, to find the points in front of a plane.

use super::order::greater;
use crate::rounding::height_rounding;
use glam::DVec3;
use std::ops::Range;

/// A binary tree of bounding boxes over points.
///
/// The tree suits many planes, such as the facets of a hull, if each plane has few of many points in front or on it.
/// Each query takes about O(log n).
///
/// ```
/// use ccd_core::glam::DVec3;
/// use ccd_core::point_tree::PointTree;
/// let tree = PointTree::new(&[DVec3::ZERO, DVec3::Z, -DVec3::Z]);
/// let mut found = Vec::new();
/// tree.for_each_not_behind([DVec3::ZERO, DVec3::X, DVec3::Y], |k| found.push(k));
/// found.sort();
/// assert_eq!(found, [0, 1]);
/// ```
#[derive(Clone, Debug)]
pub struct PointTree {
    /// The origin of all stored coordinates.
    origin: DVec3,
    /// The points in the order of the leaves, with their original indices.
    points: Vec<(DVec3, u32)>,
    /// The nodes in depth-first order: every node comes before its left subtree, and its left subtree before its right
    /// subtree.
    nodes: Vec<Node>,
    /// An upper bound of the absolute value of any coordinate of the boxes, and so of the stored points.
    max_abs_coordinate: f64,
}

#[derive(Clone, Debug)]
struct Node {
    middle: DVec3,
    half_extents: DVec3,
    /// The points of a leaf; empty for an inner node.
    points: Range<u32>,
    /// The index of the first node after this one's subtree.
    next: u32,
}

/// The largest number of points in a leaf.
const LEAF_CAPACITY: usize = 8;

impl PointTree {
    /// Builds the tree of some points, in O(n log n).
    pub fn new(points: &[DVec3]) -> Self {
        let base = points.first().copied().unwrap_or(DVec3::ZERO);
        let mut tree = PointTree {
            origin: base,
            points: points.iter().map(|&p| p - base).zip(0..).collect(),
            nodes: Vec::with_capacity(4 * points.len() / LEAF_CAPACITY + 1),
            max_abs_coordinate: 0.0,
        };
        if !points.is_empty() {
            tree.build_subtree(0..points.len());
        }
        // The bound is that of the boxes, not of the points: heights are computed for corners of boxes.
        let corner = |node: &Node| (node.middle.abs() + node.half_extents).max_element();
        tree.max_abs_coordinate = tree.nodes.iter().map(corner).fold(0.0, greater);
        tree
    }

    /// Builds the subtree of a range of points, by halving the range. The depth is at most the number of bits of the
    /// length.
    fn build_subtree(&mut self, range: Range<usize>) {
        let points = &mut self.points[range.clone()];
        let (mut lo, mut hi) = (points[0].0, points[0].0);
        for &(p, _) in points.iter() {
            (lo, hi) = (lo.min(p), hi.max(p));
        }
        // The box is widened by the rounding of halving. The sum of two products in place of one is within the
        // allowance for heights.
        let (middle, half) = ((lo + hi) / 2.0, (hi - lo) / 2.0);
        let half = half + (lo.abs().max(hi.abs())) * f64::EPSILON;
        let at = self.nodes.len();
        let is_leaf = points.len() <= LEAF_CAPACITY;
        self.nodes.push(Node {
            middle,
            half_extents: half,
            points: if is_leaf {
                range.start as u32..range.end as u32
            } else {
                0..0
            },
            next: 0,
        });
        if !is_leaf {
            let axis = half.max_position();
            let split = points.len() / 2;
            points.select_nth_unstable_by(split, |p, q| p.0[axis].total_cmp(&q.0[axis]));
            self.build_subtree(range.start..range.start + split);
            self.build_subtree(range.start + split..range.end);
        }
        self.nodes[at].next = self.nodes.len() as u32;
    }

    /// Visits every point that is not certainly behind the plane of a triangle. The front is the side from which the
    /// triangle is seen counterclockwise.
    ///
    /// # Guarantee
    /// Skipped points are behind the plane in exact arithmetic. Coordinates are at most
    /// [`MAX_COORDINATE`](crate::limits::MAX_COORDINATE).
    pub fn for_each_not_behind(&self, plane: [DVec3; 3], mut visit: impl FnMut(u32)) {
        let [a, b, c] = plane;
        let (u, v, foot) = (b - a, c - a, a - self.origin);
        let normal = u.cross(v);
        let reach = greater(self.max_abs_coordinate, foot.abs().max_element());
        let least = normal.dot(foot) - height_rounding([u, v], reach);
        let mut at = 0;
        // Every step leads to a later node.
        while let Some(node) = self.nodes.get(at) {
            // Written so that NaN descends.
            if normal.dot(node.middle) + normal.abs().dot(node.half_extents) < least {
                at = node.next as usize;
                continue;
            }
            for &(point, number) in
                &self.points[node.points.start as usize..node.points.end as usize]
            {
                if !(normal.dot(point) < least) {
                    visit(number);
                }
            }
            at += 1;
        }
    }
}

#[cfg(test)]
mod tests;
