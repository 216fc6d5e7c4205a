//! The bounding volume hierarchy over a body's triangles. The certificate of the body describes it.

use crate::bounds::{Bounds, by_coordinate};
use crate::split::split;
use crate::stop::Stop;
use ccd_core::glam::{DVec3, DVec4};
use ccd_core::order::greater;

/// A binary bounding volume hierarchy over triangles. A node with more than one triangle has two children.
#[derive(Clone, Debug)]
pub(crate) struct Tree {
    /// The triangles in the order of the tree. A corner has the coordinates x, y, z and its radius.
    pub(crate) triangles: Vec<[DVec4; 3]>,
    /// The nodes in preorder: a node, then its first child with all descendants, then its second child with all descendants.
    nodes: Vec<Node>,
}

/// The index of a node in a tree. In the documentation of functions, a node stands for the set of its triangles.
pub(crate) type NodeIndex = usize;

#[derive(Clone, Copy, Debug)]
struct Node {
    bounds: Bounds,
    /// The radius of the bounding ball around the center of the box.
    ball_radius: f64,
    /// The index of the first triangle.
    first_triangle: usize,
    /// The second child. `None` for a single triangle.
    second_child: Option<NodeIndex>,
}

impl Tree {
    /// The node with all triangles.
    pub(crate) const ROOT: NodeIndex = 0;

    /// Builds a tree over triangles. Also returns the numbers of the certificate, one for each node in preorder: the index of a
    /// single triangle, or else the number of triangles of the node's first child.
    pub(crate) fn new<S: Stop>(
        triangles: &[[DVec4; 3]],
        stop: S,
    ) -> Result<(Tree, Vec<u32>), S::Stopped> {
        let boxes: Vec<Bounds> = triangles.iter().map(Bounds::of).collect();
        let mut order: Vec<u32> = (0..triangles.len() as u32).collect();
        let mut tree = Tree {
            triangles: Vec::new(),
            nodes: Vec::new(),
        };
        let mut numbers = Vec::new();
        tree.add((triangles, &boxes), (&mut order, 0), &mut numbers, stop)?;
        Ok((tree, numbers))
    }

    /// Adds a node with the triangles of these indices, and all nodes below it.
    fn add<S: Stop>(
        &mut self,
        (triangles, boxes): (&[[DVec4; 3]], &[Bounds]),
        (indices, depth): (&mut [u32], usize),
        numbers: &mut Vec<u32>,
        stop: S,
    ) -> Result<(), S::Stopped> {
        let node = self.nodes.len();
        let corners = indices.iter().flat_map(|&index| triangles[index as usize]);
        self.nodes.push(Node::of(corners, self.triangles.len()));
        if let [index] = *indices {
            numbers.push(index);
            self.triangles.push(triangles[index as usize]);
        } else {
            let count = split(boxes, indices, depth, stop)?;
            numbers.push(count as u32);
            let (first, second) = indices.split_at_mut(count);
            self.add((triangles, boxes), (first, depth + 1), numbers, stop)?;
            self.nodes[node].second_child = Some(self.nodes.len());
            self.add((triangles, boxes), (second, depth + 1), numbers, stop)?;
        }
        Ok(())
    }

    /// Returns the two children of a node. Returns `None` for a single triangle.
    pub(crate) fn children(&self, node: NodeIndex) -> Option<[NodeIndex; 2]> {
        Some([node + 1, self.nodes[node].second_child?])
    }

    /// Returns the least projection of a node onto a direction: the minimum over its corners of the dot product minus the radius.
    pub(crate) fn min_projection(&self, node: NodeIndex, direction: DVec3) -> f64 {
        let infinite = (f64::INFINITY, 0);
        self.min_corner_below(node, direction.extend(-1.0), infinite)
            .0
    }

    /// Returns the index and the position of the corner of a node with the least dot product with a direction. Ignores radii.
    pub(crate) fn min_corner(&self, node: NodeIndex, direction: DVec3) -> (u32, DVec3) {
        let infinite = (f64::INFINITY, 3 * self.nodes[node].first_triangle);
        let (_, index) = self.min_corner_below(node, direction.extend(0.0), infinite);
        let corner = self.triangles[index / 3][index % 3];
        (index as u32, corner.truncate())
    }

    /// Returns the least dot product of a corner of a node with a direction, and the index of the corner. Returns `least` if no dot
    /// product is smaller.
    fn min_corner_below(
        &self,
        node: NodeIndex,
        direction: DVec4,
        least: (f64, usize),
    ) -> (f64, usize) {
        let Some(children) = self.children(node) else {
            let triangle = self.nodes[node].first_triangle;
            let corners = self.triangles[triangle].iter().enumerate();
            return corners.fold(least, |least, (k, corner)| {
                let projection = direction.dot(*corner);
                if projection < least.0 {
                    (projection, 3 * triangle + k)
                } else {
                    least
                }
            });
        };
        let mut children =
            children.map(|child| (self.nodes[child].bounds.min_projection(direction), child));
        if children[1].0 < children[0].0 {
            children.swap(0, 1);
        }
        children.into_iter().fold(least, |least, (bound, child)| {
            if bound < least.0 {
                self.min_corner_below(child, direction, least)
            } else {
                least
            }
        })
    }

    /// Returns the number of boxes and triangles that the checker visits to confirm that the least projection of a node onto
    /// `direction` is at least `limit`.
    pub(crate) fn projection_visits(&self, node: NodeIndex, direction: DVec3, limit: f64) -> usize {
        let bounds = &self.nodes[node].bounds;
        let is_box_below = bounds.min_projection(direction.extend(-1.0)) < limit;
        let children = self.children(node).filter(|_| is_box_below);
        let visits = |children: [NodeIndex; 2]| {
            children.map(|child| self.projection_visits(child, direction, limit))
        };
        1 + children.map_or(0, |children| visits(children).iter().sum())
    }

    /// Returns the center and the radius of the bounding ball of a node.
    pub(crate) fn ball(&self, node: NodeIndex) -> (DVec3, f64) {
        let node = &self.nodes[node];
        (node.bounds.center(), node.ball_radius)
    }

    /// Returns the number of boxes that the checker visits to confirm that all points of a node are farther than `limit` from
    /// `point`. Returns `None` if the box of a triangle is nearer.
    pub(crate) fn distance_visits(
        &self,
        node: NodeIndex,
        point: DVec3,
        limit: f64,
    ) -> Option<usize> {
        let Bounds { least, greatest } = &self.nodes[node].bounds;
        let point4 = point.extend(0.0);
        let offset = by_coordinate(*least - point4, point4 - *greatest, greater);
        let offset = by_coordinate(offset, DVec4::ZERO, greater).truncate();
        if offset.length() > limit + greatest.w {
            return Some(1);
        }
        let [first, second] = self.children(node)?;
        let visits = self.distance_visits(first, point, limit)?;
        Some(1 + visits + self.distance_visits(second, point, limit)?)
    }

    /// Returns an upper bound of the distance from `point` to any point of a node.
    pub(crate) fn max_distance(&self, node: NodeIndex, point: DVec3) -> f64 {
        let (center, radius) = self.ball(node);
        center.distance(point) + radius
    }

    /// Returns the largest radius of a corner.
    pub(crate) fn largest_radius(&self) -> f64 {
        self.nodes[Tree::ROOT].bounds.greatest.w
    }

    /// Returns half of the diagonal of a node's box. Returns 0 for a single triangle, as it cannot be split.
    pub(crate) fn radius(&self, node: NodeIndex) -> f64 {
        let node = &self.nodes[node];
        let size = (node.bounds.greatest - node.bounds.least).truncate();
        node.second_child.map_or(0.0, |_| 0.5 * size.length())
    }
}

impl Node {
    fn of(corners: impl Iterator<Item = DVec4> + Clone, first_triangle: usize) -> Node {
        let bounds = Bounds::around(corners.clone());
        let squares = corners.map(|corner| corner.truncate().distance_squared(bounds.center()));
        Node {
            bounds,
            ball_radius: squares.fold(0.0, greater).sqrt() + bounds.greatest.w,
            first_triangle,
            second_child: None,
        }
    }
}
