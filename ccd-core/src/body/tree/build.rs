//! Builds the tree with eight children per node from a binary hierarchy.

use super::fit::{NodePoints, PointSample, fit_node};
use super::group::longest_vector_length;
use super::{
    BodyBox, BoxGroup, LANES, Node, NodeChildren, NodeId, Slab, StoredTriangleGroup, Tree,
};
use crate::body::hierarchy::{Hierarchy, HierarchyNode};
use crate::body::piece::Piece;
use crate::body::pieces::Pieces;
use crate::body::threads::{join, parallel_for_each};
use crate::error::InputError;
use crate::math::order::greater;
use glam::DVec3;
use std::ops::Range;

/// The nodes and groups of a wide tree before boxes are fitted to the pieces below them.
#[derive(Default)]
pub(crate) struct TreeLayout {
    nodes: Vec<NodeLayout>,
    node_groups: Vec<ChildNodes>,
    /// The node whose pieces are the triangles of each group.
    triangle_group_nodes: Vec<u32>,
}

/// Returns the largest distance of the pieces' points from the body's origin, rounding radii included.
fn max_distance_from_origin(pieces: &Pieces) -> f64 {
    let farthest = |points: &[DVec3]| longest_vector_length(points.iter().copied());
    if pieces.are_all_triangles() {
        return farthest(pieces.points());
    }
    let reach = |piece: Piece<'_>| farthest(piece.points) + piece.radius;
    pieces.iter().map(reach).fold(0.0, greater)
}

/// The pieces in depth-first order, and the range of each hierarchy node's pieces in that order.
struct PieceRanges {
    order: Vec<u32>,
    /// The range of each hierarchy node's pieces in `order`.
    node_ranges: Vec<Range<u32>>,
}

impl PieceRanges {
    fn new(hierarchy: &Hierarchy, pieces: usize) -> Result<Self, InputError> {
        let nodes = hierarchy.nodes();
        let mut order = Vec::with_capacity(pieces);
        let mut node_ranges = vec![0..0; nodes.len()];
        // Every node is visited twice: on the way down, and after all pieces below it are listed.
        let mut stack = vec![(0u32, false)];
        while let Some((at, listed)) = stack.pop() {
            let range = &mut node_ranges[at as usize];
            if listed {
                range.end = order.len() as u32;
                continue;
            }
            range.start = order.len() as u32;
            match nodes[at as usize] {
                HierarchyNode::Leaf(piece) => {
                    order.push(piece);
                    range.end = order.len() as u32;
                }
                HierarchyNode::Inner(left, right) => {
                    stack.extend([(at, true), (right, false), (left, false)]);
                }
            }
        }
        if order.len() == pieces {
            Ok(PieceRanges { order, node_ranges })
        } else {
            Err(InputError::BadHierarchy { index: order.len() })
        }
    }

    fn piece_count(&self, node: u32) -> usize {
        self.node_ranges[node as usize].len()
    }
}

/// A node of the wide tree before its box is fitted: the range of its pieces, and its children.
struct NodeLayout {
    pieces: Range<usize>,
    children: NodeChildren,
}

/// A group of consecutive nodes that are the children of a node.
struct ChildNodes {
    parent: u32,
    children: Range<u32>,
}

/// The planned capacity of the lowest groups of nodes, in full triangle groups; fewer than eight, as few are full.
///
/// Unit: groups. Less: more memory, as most groups of nodes are at the bottom. More: nodes that
/// just exceed it are split into two.
const TRIANGLE_GROUPS_PER_NODE_GROUP: u64 = 6;

impl TreeLayout {
    /// Arranges the nodes of the wide tree, and returns the layout and the pieces in the tree's order.
    ///
    /// A binary node opens its largest descendants until there are eight. The smallest clusters have up to eight
    /// triangles, or one piece of another kind.
    pub(crate) fn from_hierarchy(
        pieces: &Pieces,
        hierarchy: &Hierarchy,
    ) -> Result<(Self, Pieces), InputError> {
        let ranges = PieceRanges::new(hierarchy, pieces.len())?;
        Ok(join(
            pieces.len(),
            || TreeLayout::build_layout(hierarchy, &ranges, pieces.are_all_triangles()),
            || pieces.with_piece_order(&ranges.order),
        ))
    }

    fn build_layout(hierarchy: &Hierarchy, ranges: &PieceRanges, triangles: bool) -> Self {
        let opener = ChildChooser {
            hierarchy,
            ranges,
            max_leaf_pieces: if triangles { LANES } else { 1 },
            // Pieces other than triangles form no groups.
            layer_capacities: if triangles {
                layer_capacities(ranges.order.len())
            } else {
                Vec::new()
            },
        };
        let mut layout = TreeLayout::default();
        layout.push_node(ranges, 0);
        let mut waiting = vec![(0u32, 0u32)];
        while let Some((parent, at)) = waiting.pop() {
            layout.nodes[parent as usize].children = if triangles && ranges.piece_count(at) <= LANES
            {
                layout.triangle_group_nodes.push(parent);
                NodeChildren::Triangles(layout.triangle_group_nodes.len() as u32 - 1)
            } else if ranges.piece_count(at) > 1 {
                let (members, count) = opener.choose_children(at);
                let first = layout.nodes.len() as u32;
                let children = first..first + count as u32;
                for (&member, child) in members.iter().zip(children.clone()) {
                    layout.push_node(ranges, member);
                    waiting.push((child, member));
                }
                layout.node_groups.push(ChildNodes { parent, children });
                NodeChildren::Boxes(layout.node_groups.len() as u32 - 1)
            } else {
                NodeChildren::Piece(ranges.node_ranges[at as usize].start)
            };
        }
        layout
    }

    fn push_node(&mut self, ranges: &PieceRanges, at: u32) {
        let Range { start, end } = ranges.node_ranges[at as usize];
        self.nodes.push(NodeLayout {
            pieces: start as usize..end as usize,
            // The group is created when the node is visited.
            children: NodeChildren::Piece(start),
        });
    }

    /// Creates the tree: fits a box and a ball to each node, and fills the groups of children. Each of them depends on
    /// its own pieces alone, so that all can be computed in parallel.
    pub(crate) fn fit_tree(&self, pieces: &Pieces) -> Tree {
        let mut nodes = vec![Node::UNFITTED; self.nodes.len()];
        parallel_for_each(&mut nodes, &PointSample::EMPTY, |sample, k, node| {
            let layout = &self.nodes[k];
            *node = fit_node(&layout.node_points(pieces), layout.children, sample);
        });
        let mut boxes = vec![BoxGroup::default(); self.node_groups.len()];
        parallel_for_each(&mut boxes, &(), |(), k, group| {
            let ChildNodes { parent, children } = &self.node_groups[k];
            let members = &nodes[children.start as usize..children.end as usize];
            *group = BoxGroup::new(members, children.start, nodes[*parent as usize].center);
        });
        // The ids of triangles follow those of the nodes.
        let after = nodes.len() as u32;
        let mut triangles = vec![StoredTriangleGroup::default(); self.triangle_group_nodes.len()];
        parallel_for_each(&mut triangles, &(), |(), k, group| {
            let parent = self.triangle_group_nodes[k] as usize;
            let triangles = &self.nodes[parent].pieces;
            let corners = pieces.points_of(triangles.clone()).as_chunks().0;
            let first = after + triangles.start as u32;
            *group = StoredTriangleGroup::new(corners, first, nodes[parent].center);
        });
        Tree {
            body_box: BodyBox::fit_to(
                &self.nodes[0].node_points(pieces),
                &mut PointSample::EMPTY.clone(),
            ),
            slabs: self.slabs(pieces, &nodes),
            nodes,
            box_groups: boxes,
            triangle_groups: triangles,
            max_distance_from_origin: max_distance_from_origin(pieces),
        }
    }

    /// Returns a slab, with the node's id, around each node that is flat enough; an empty list if a piece is no
    /// triangle.
    fn slabs(&self, pieces: &Pieces, nodes: &[Node]) -> Vec<(NodeId, Slab)> {
        if !pieces.are_all_triangles() {
            return Vec::new();
        }
        let thin = (0..).zip(nodes).filter(|(_, node)| node.is_thin());
        thin.filter_map(|(id, node)| {
            let corners = pieces.points_of(self.nodes[id as usize].pieces.clone());
            Some((id, Slab::fit_to(corners, node.center)?))
        })
        .collect()
    }
}

impl NodeLayout {
    /// Returns the points that the node's box has to contain, with the largest radius by which its pieces are rounded.
    fn node_points<'p>(&self, pieces: &'p Pieces) -> NodePoints<'p> {
        let triangles = pieces.are_all_triangles();
        let radii = self.pieces.clone().map(|k| pieces.get(k).radius);
        NodePoints {
            points: pieces.points_of(self.pieces.clone()),
            rounding_radius: if triangles {
                0.0
            } else {
                radii.fold(0.0, greater)
            },
            are_triangles: triangles,
        }
    }
}

/// Chooses the children of the wide tree's nodes among the descendants in the binary hierarchy.
struct ChildChooser<'a> {
    hierarchy: &'a Hierarchy,
    ranges: &'a PieceRanges,
    /// The largest number of pieces of a hierarchy node that becomes a child at the bottom of the wide tree.
    max_leaf_pieces: usize,
    /// The largest number of pieces below a node, for each layer of the wide tree from the bottom.
    layer_capacities: Vec<usize>,
}

/// Returns the largest number of pieces below a node, for each layer of the wide tree from the bottom. The lowest two
/// layers have fixed capacities. The capacities above grow by the least even ratio with which the root holds all
/// pieces.
fn layer_capacities(pieces: usize) -> Vec<usize> {
    let (full, pieces) = (LANES as u64 * TRIANGLE_GROUPS_PER_NODE_GROUP, pieces as u64);
    let mut count = 1;
    while full * (LANES as u64).pow(count) < pieces {
        count += 1;
    }
    // The layers are computed in quarters, so that rounding plays no role.
    let layer = |ratio: u64, k: u32| full * ratio.pow(k) / 4u64.pow(k);
    let most = 4 * LANES as u64;
    let even = (4..most).find(|&ratio| layer(ratio, count) >= pieces);
    let below = (0..count).map(|k| layer(even.unwrap_or(most), k) as usize);
    [LANES].into_iter().chain(below).collect()
}

impl ChildChooser<'_> {
    /// Returns the largest number of pieces that a child may have if its parent has `pieces` pieces.
    fn max_child_pieces(&self, pieces: usize) -> usize {
        let lower = self
            .layer_capacities
            .iter()
            .rev()
            .find(|&&layer| layer < pieces);
        lower.copied().unwrap_or(self.max_leaf_pieces)
    }

    /// Returns the hierarchy nodes that become the children of a wide node, and their number. The one with the most
    /// pieces is replaced by its two children, again and again, until it fits into a lower layer.
    ///
    /// Groups are full at the bottom, where most of the groups are.
    fn choose_children(&self, at: u32) -> ([u32; LANES], usize) {
        let (mut members, mut count) = ([at; LANES], 1);
        let max_leaf_pieces = self.max_child_pieces(self.ranges.piece_count(at));
        while count < LANES {
            let largest = (0..count).max_by_key(|&k| self.ranges.piece_count(members[k]));
            let Some(k) =
                largest.filter(|&k| self.ranges.piece_count(members[k]) > max_leaf_pieces)
            else {
                break;
            };
            let HierarchyNode::Inner(left, right) = self.hierarchy.nodes()[members[k] as usize]
            else {
                break;
            };
            (members[k], members[count]) = (left, right);
            count += 1;
        }
        (members, count)
    }
}

#[cfg(test)]
mod tests;
