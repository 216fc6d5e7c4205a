//! The rim of a fan: edges, in a tree of boxes that lie as the edges do.

use ccd_core::glam::DVec3;
use ccd_core::order::greater;
use ccd_core::tolerance::U64;
use ccd_core::vector::unit;
use std::ops::Range;

/// The edge of a face across from its hub.
#[derive(Clone, Copy, Debug)]
pub(super) struct Edge {
    pub(super) ends: [DVec3; 2],
    pub(super) face: u32,
}

/// Edges in a binary tree.
pub(super) struct Rim {
    pub(super) edges: Vec<Edge>,
    /// Every node before those below it.
    nodes: Vec<Node>,
}

struct Node {
    slab: Slab,
    /// The edges of a leaf; none of an inner node.
    edges: Range<u32>,
    /// The first node that is not below it.
    next: u32,
}

/// A box along axes of its own: the centre, and at most so much along each of them, and the slack along
/// the coordinate axes. The slack makes up for all rounding, and for axes that are not quite at right
/// angles or of unit length.
pub(super) struct Slab {
    pub(super) centre: DVec3,
    pub(super) axes: [DVec3; 3],
    pub(super) halves: DVec3,
    pub(super) slack: f64,
}

/// The most edges of a leaf.
const LEAF: usize = 2;

impl Rim {
    /// O(n log n) for at least one edge.
    pub(super) fn new(edges: Vec<Edge>) -> Self {
        let nodes = Vec::with_capacity(2 * edges.len());
        let mut rim = Rim { edges, nodes };
        rim.build(0..rim.edges.len());
        rim
    }

    /// Halves the count each time, so that it is at most as deep as a count has bits.
    fn build(&mut self, range: Range<usize>) {
        let edges = &mut self.edges[range.clone()];
        let slab = Slab::about(edges);
        let at = self.nodes.len();
        let split = edges.len() / 2;
        let is_leaf = edges.len() <= LEAF;
        if !is_leaf {
            let along = slab.axes[slab.halves.max_position()];
            let height = |edge: &Edge| along.dot(edge.ends[0] + edge.ends[1]);
            edges.select_nth_unstable_by(split, |a, b| {
                let order = height(a).total_cmp(&height(b));
                order.then(a.face.cmp(&b.face))
            });
        }
        self.nodes.push(Node {
            slab,
            edges: match is_leaf {
                true => range.start as u32..range.end as u32,
                false => 0..0,
            },
            next: 0,
        });
        if !is_leaf {
            self.build(range.start..range.start + split);
            self.build(range.start + split..range.end);
        }
        self.nodes[at].next = self.nodes.len() as u32;
    }

    /// Calls back with the faces of all edges but those in boxes that are far, until the answer is no.
    pub(super) fn all_but(
        &self,
        is_far: impl Fn(&Slab) -> bool,
        mut holds: impl FnMut(u32) -> bool,
    ) -> bool {
        let mut at = 0;
        // Every step leads to a later node.
        while let Some(node) = self.nodes.get(at) {
            if is_far(&node.slab) {
                at = node.next as usize;
                continue;
            }
            let edges = &self.edges[node.edges.start as usize..node.edges.end as usize];
            if !edges.iter().all(|edge| holds(edge.face)) {
                return false;
            }
            at += 1;
        }
        true
    }
}

impl Slab {
    /// Along the longest of some edges, and across to the end that is farthest from the middle.
    fn about(edges: &[Edge]) -> Self {
        let ends = || edges.iter().flat_map(|edge| edge.ends);
        let centre = ends().sum::<DVec3>() / (2 * edges.len()) as f64;
        let longest = edges
            .iter()
            .map(|edge| edge.ends[1] - edge.ends[0])
            .max_by(|a, b| a.length_squared().total_cmp(&b.length_squared()));
        let first = longest.and_then(unit).unwrap_or(DVec3::X);
        let aside = |p: DVec3| (p - centre).reject_from_normalized(first);
        let farthest = ends()
            .map(aside)
            .max_by(|a, b| a.length_squared().total_cmp(&b.length_squared()));
        let second = farthest.and_then(unit);
        let second = second.unwrap_or_else(|| first.any_orthonormal_vector());
        let axes = [first, second, first.cross(second)];
        let (mut halves, mut slack, mut reach) = (DVec3::ZERO, 0.0, 0.0);
        for p in ends() {
            let way = p - centre;
            let along = DVec3::from_array(axes.map(|axis| axis.dot(way)));
            let rest = way - along.x * first - along.y * second - along.z * axes[2];
            halves = halves.max(along.abs());
            slack = greater(slack, rest.abs().max_element());
            reach = greater(reach, p.abs().max_element());
        }
        Slab {
            centre,
            axes,
            halves,
            // The difference and the three products above round by less than 16 units of the reach.
            slack: slack + 64.0 * U64 * reach,
        }
    }
}
