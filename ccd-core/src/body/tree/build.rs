//! Builds the wide tree from a binary hierarchy.

use super::fit::{Cloud, fit};
use super::{Below, BoxGroup, LANES, Node, Tree, TriangleGroup};
use crate::body::hierarchy::{Hierarchy, HierarchyNode};
use crate::body::pieces::Pieces;
use crate::error::InputError;
use crate::math::order::greater;
use crate::math::vector::length;
use glam::DVec3;

impl Tree {
    /// Builds the tree, and sorts the pieces into its order.
    ///
    /// A binary node opens its largest descendants until there are eight. The smallest clusters
    /// have up to eight triangles, or one other piece.
    pub(crate) fn build(
        pieces: &Pieces,
        hierarchy: &Hierarchy,
    ) -> Result<(Tree, Pieces), InputError> {
        let ranges = Ranges::new(hierarchy, pieces.len())?;
        let pieces = pieces.reordered(&ranges.order);
        let mut builder = Builder {
            nodes: Vec::new(),
            boxes: Vec::new(),
            triangles: Vec::new(),
            hierarchy,
            ranges: &ranges,
            pieces: &pieces,
            whole: if pieces.all_triangles() { LANES } else { 1 },
        };
        builder.push_node(0);
        let mut waiting = vec![(0usize, 0u32)];
        while let Some((id, at)) = waiting.pop() {
            builder.fill(id, at, &mut waiting);
        }
        // Ids of triangles follow those of the nodes, whose number is known only now.
        let nodes = builder.nodes.len() as u32;
        for group in &mut builder.triangles {
            group.members.first += nodes;
        }
        let reach = |k: usize| {
            let piece = pieces.get(k);
            let farthest = piece.points.iter().map(|&p| length(p)).fold(0.0, greater);
            farthest + piece.radius
        };
        let tree = Tree {
            span: (0..pieces.len()).map(reach).fold(0.0, greater),
            nodes: builder.nodes,
            boxes: builder.boxes,
            triangles: builder.triangles,
        };
        Ok((tree, pieces))
    }
}

/// The range of each node's pieces in a depth-first list.
struct Ranges {
    order: Vec<u32>,
    /// Start and end in `order`, by node of the hierarchy.
    of: Vec<(u32, u32)>,
}

impl Ranges {
    fn new(hierarchy: &Hierarchy, pieces: usize) -> Result<Self, InputError> {
        let nodes = hierarchy.nodes();
        let mut order = Vec::with_capacity(pieces);
        let mut of = vec![(0, 0); nodes.len()];
        // Every node is met twice: on the way down, and after all pieces below it are listed.
        let mut stack = vec![(0u32, false)];
        while let Some((at, listed)) = stack.pop() {
            let range = &mut of[at as usize];
            if listed {
                range.1 = order.len() as u32;
                continue;
            }
            range.0 = order.len() as u32;
            match nodes[at as usize] {
                HierarchyNode::Leaf(piece) => {
                    order.push(piece);
                    range.1 = order.len() as u32;
                }
                HierarchyNode::Inner(left, right) => {
                    stack.extend([(at, true), (right, false), (left, false)]);
                }
            }
        }
        if order.len() == pieces {
            Ok(Ranges { order, of })
        } else {
            Err(InputError::BadHierarchy { at: order.len() })
        }
    }

    fn len(&self, node: u32) -> usize {
        let (start, end) = self.of[node as usize];
        (end - start) as usize
    }
}

struct Builder<'a> {
    nodes: Vec<Node>,
    boxes: Vec<BoxGroup>,
    triangles: Vec<TriangleGroup>,
    hierarchy: &'a Hierarchy,
    ranges: &'a Ranges,
    /// The pieces in the order of the ranges.
    pieces: &'a Pieces,
    /// Nodes of up to this many pieces are not opened.
    whole: usize,
}

impl Builder<'_> {
    /// Fits a node of the tree to a node of the hierarchy; its children are filled in later.
    fn push_node(&mut self, at: u32) {
        let (start, end) = self.ranges.of[at as usize];
        let range = start as usize..end as usize;
        let radii = range.clone().map(|k| self.pieces.get(k).radius);
        let cloud = Cloud {
            points: self.pieces.points_of(range),
            radius: radii.fold(0.0, greater),
            triangles: self.pieces.all_triangles(),
        };
        let single = self.whole == 1 && self.ranges.len(at) == 1;
        let below = match single {
            true => Below::Piece(start),
            false => Below::Boxes(u32::MAX),
        };
        self.nodes.push(fit(&cloud, below));
    }

    /// Makes the group below a node, and lists its nodes that need a group of their own.
    fn fill(&mut self, id: usize, at: u32, waiting: &mut Vec<(usize, u32)>) {
        let origin = self.nodes[id].centre;
        let (start, end) = self.ranges.of[at as usize];
        if self.pieces.all_triangles() && self.ranges.len(at) <= LANES {
            let corners: Vec<[DVec3; 3]> = (start..end)
                .map(|k| self.pieces.triangle(k as usize))
                .collect();
            self.nodes[id].below = Below::Triangles(self.triangles.len() as u32);
            self.triangles
                .push(TriangleGroup::new(&corners, start, origin));
        } else if self.ranges.len(at) > 1 {
            let members = self.open(at);
            let first = self.nodes.len();
            for (k, &member) in members.iter().enumerate() {
                self.push_node(member);
                waiting.push((first + k, member));
            }
            self.nodes[id].below = Below::Boxes(self.boxes.len() as u32);
            self.boxes
                .push(BoxGroup::new(&self.nodes[first..], first as u32, origin));
        }
    }

    /// Returns the descendants that become a node's children: repeatedly opens the one with the
    /// most pieces.
    fn open(&self, at: u32) -> Vec<u32> {
        let mut members = vec![at];
        while members.len() < LANES {
            let largest = (0..members.len()).max_by_key(|&k| self.ranges.len(members[k]));
            let Some(k) = largest.filter(|&k| self.ranges.len(members[k]) > self.whole) else {
                break;
            };
            let HierarchyNode::Inner(left, right) = self.hierarchy.nodes()[members[k] as usize]
            else {
                break;
            };
            members[k] = left;
            members.push(right);
        }
        members
    }
}
