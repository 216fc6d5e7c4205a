//! Parts of triangles in a tree of boxes that lie as the parts do.

use super::Bounds;
use super::nearest::distance_to;
use super::slab::Slab;
use crate::work::Work;
use ccd_core::glam::DVec3;
use ccd_core::order::greater;
use std::ops::Range;

/// What is searched of a face: all of it, or one edge, of which an end is there twice.
#[derive(Clone, Copy, Debug)]
pub(super) struct Part {
    pub(super) corners: [DVec3; 3],
    pub(super) face: u32,
}

/// Parts in a binary tree.
pub(super) struct Slabs {
    pub(super) parts: Vec<Part>,
    /// Every node before those below it.
    nodes: Vec<Node>,
}

struct Node {
    bounds: Bounds,
    slab: Slab,
    /// The parts of a leaf; none of an inner node.
    parts: Range<u32>,
    /// The first node that is not below it.
    next: u32,
}

/// The most parts of a leaf.
const LEAF: usize = 2;

impl Part {
    pub(super) fn middle(&self) -> DVec3 {
        let bounds = Bounds::of(self.corners);
        0.5 * bounds.lo + 0.5 * bounds.hi
    }
}

impl Slabs {
    /// O(n log n).
    pub(super) fn new(parts: Vec<Part>) -> Self {
        let nodes = Vec::with_capacity(2 * parts.len());
        let mut slabs = Slabs { parts, nodes };
        if !slabs.parts.is_empty() {
            slabs.build(0..slabs.parts.len());
        }
        slabs
    }

    /// The smallest box along the coordinate axes that holds all; none of nothing.
    pub(super) fn bounds(&self) -> Option<Bounds> {
        self.nodes.first().map(|node| node.bounds)
    }

    /// Halves the count each time, so that it is at most as deep as a count has bits.
    fn build(&mut self, range: Range<usize>) {
        let parts = &mut self.parts[range.clone()];
        let slab = Slab::about(parts);
        let at = self.nodes.len();
        let split = parts.len() / 2;
        let is_leaf = parts.len() <= LEAF;
        if !is_leaf {
            let along = slab.widest(parts);
            let height = |part: &Part| along.dot(part.middle());
            parts.select_nth_unstable_by(split, |a, b| {
                let order = height(a).total_cmp(&height(b));
                order.then(a.face.cmp(&b.face))
            });
        }
        self.nodes.push(Node {
            bounds: Bounds::of(parts.iter().flat_map(|part| part.corners)),
            slab,
            parts: match is_leaf {
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

    /// Calls back with the faces of all parts but those in boxes that are far, until the answer is no,
    /// or the work is spent.
    pub(super) fn all_but(
        &self,
        is_far: impl Fn(&Bounds, &Slab) -> bool,
        work: &Work,
        mut holds: impl FnMut(u32) -> bool,
    ) -> bool {
        self.all_parts_but(is_far, work, |part| holds(part.face))
    }

    /// The same with the parts themselves.
    pub(super) fn all_parts_but(
        &self,
        is_far: impl Fn(&Bounds, &Slab) -> bool,
        work: &Work,
        mut holds: impl FnMut(&Part) -> bool,
    ) -> bool {
        let mut at = 0;
        // Every step leads to a later node.
        while let Some(node) = self.nodes.get(at) {
            if !work.spend(1) {
                return false;
            }
            if is_far(&node.bounds, &node.slab) {
                at = node.next as usize;
                continue;
            }
            let parts = &self.parts[node.parts.start as usize..node.parts.end as usize];
            if !parts.iter().all(&mut holds) {
                return false;
            }
            at += 1;
        }
        true
    }

    /// The parts of a leaf, or the two nodes below an inner one.
    pub(super) fn below(&self, at: usize) -> (&[Part], Option<[usize; 2]>) {
        let Some(node) = self.nodes.get(at) else {
            return (&[], None);
        };
        let parts = &self.parts[node.parts.start as usize..node.parts.end as usize];
        let left = at + 1;
        let below = parts
            .is_empty()
            .then(|| [left, self.nodes[left].next as usize]);
        (parts, below)
    }

    /// At most the distance of a point from what is in a node, up to rounding.
    pub(super) fn distance(&self, at: usize, point: DVec3) -> f64 {
        let node = &self.nodes[at];
        greater(distance_to(&node.bounds, point), node.slab.distance(point))
    }
}
