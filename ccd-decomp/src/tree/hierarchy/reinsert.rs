//! Improves a tree by reinsertion: moves the largest subtrees to where they minimise the total area of boxes
//! (`[REINSERT18]`).

use super::nodes::{Node, NodeContent, sibling};
use crate::tolerance::REINSERTION_CANDIDATE_SHARE;
use rayon::prelude::*;

/// The number of subtrees in a parallel task. Smaller tasks cost more than they gain.
const SUBTREES_PER_TASK: usize = 32;

/// Improves a tree by several rounds of reinsertion. Each round has fewer nodes, nearer to the root.
pub(super) fn reinsert_subtrees(nodes: &mut [Node]) {
    if nodes.len() < 2 {
        return;
    }
    let mut tree = Tree::new(nodes);
    for share in (1..32).step_by(2).map(|n| 1.0 / n as f32) {
        let count = (tree.nodes.len() as f32 * REINSERTION_CANDIDATE_SHARE * share) as usize;
        tree.reinsert_largest_nodes(count.clamp(1, tree.nodes.len() - 1));
    }
}

struct Tree<'a> {
    nodes: &'a mut [Node],
    parents: Vec<u32>,
    /// For each node, whether it was changed in this round.
    is_node_changed: Vec<bool>,
}

/// A possible move: the subtree, its new sibling, and the reduction of the total area.
struct Reinsertion {
    subtree_root_index: u32,
    new_sibling_index: u32,
    area_reduction: f32,
}

impl<'a> Tree<'a> {
    fn new(nodes: &'a mut [Node]) -> Self {
        let mut parents = vec![0; nodes.len()];
        for (node, parent) in nodes.iter().zip(0..) {
            if let NodeContent::Children(first) = node.content {
                parents[first as usize..][..2].fill(parent);
            }
        }
        Tree {
            is_node_changed: vec![false; nodes.len()],
            nodes,
            parents,
        }
    }

    /// Finds the best places for the `count` largest nodes, and makes the best moves that do not conflict.
    fn reinsert_largest_nodes(&mut self, count: usize) {
        // The first nodes are near the root, and most of the largest are among them.
        let first = self.nodes.len().min(2 * (count + 1));
        let mut largest: Vec<(f32, u32)> =
            (1..first as u32).map(|n| (self.half_area(n), n)).collect();
        let by_area = |a: &(f32, u32), b: &(f32, u32)| b.0.total_cmp(&a.0).then(a.1.cmp(&b.1));
        if count < largest.len() {
            largest.select_nth_unstable_by(count, by_area);
            largest.truncate(count);
        }
        largest.sort_unstable_by(by_area);
        // The tree is not changed until all places are found, so that the search is parallel.
        let mut moves: Vec<Reinsertion> = (largest.par_iter().with_min_len(SUBTREES_PER_TASK))
            .map_init(Vec::new, |stack, &(_, node)| {
                self.best_reinsertion(node, stack)
            })
            .flatten_iter()
            .collect();
        moves.sort_unstable_by(|a, b| b.area_reduction.total_cmp(&a.area_reduction));
        self.is_node_changed.fill(false);
        for best in moves {
            let (from, to) = (best.subtree_root_index, best.new_sibling_index);
            let [old, new] = [from, to].map(|node| self.parents[node as usize]);
            let changed = [to, from, sibling(from), new, old].map(|node| node as usize);
            if !changed.iter().any(|&node| self.is_node_changed[node]) {
                for node in changed {
                    self.is_node_changed[node] = true;
                }
                self.move_beside(from, to);
            }
        }
    }

    /// Returns the move of a subtree that reduces the total area of the boxes most; `None` if no move reduces it. The
    /// search climbs to the root, and searches every subtree beside the path. A branch is pruned if its boxes grow by
    /// more than the best gain.
    fn best_reinsertion(&self, from: u32, stack: &mut Vec<(f32, u32)>) -> Option<Reinsertion> {
        let cuboid = self.nodes[from as usize].cuboid;
        let area = cuboid.half_area();
        let parent = self.parents[from as usize];
        let mut best = Reinsertion {
            subtree_root_index: from,
            new_sibling_index: 0,
            area_reduction: 0.0,
        };
        // The boxes above the old place shrink.
        let mut gain = self.half_area(parent);
        let (mut pivot, mut beside) = (parent, sibling(from));
        let mut left = self.nodes[beside as usize].cuboid;
        loop {
            stack.push((gain, beside));
            while let Some((gain, node)) = stack.pop() {
                if gain - area <= best.area_reduction {
                    continue;
                }
                let old = self.nodes[node as usize].cuboid;
                let gain = gain - old.union(cuboid).half_area();
                if gain > best.area_reduction {
                    best = Reinsertion {
                        new_sibling_index: node,
                        area_reduction: gain,
                        ..best
                    };
                }
                if let NodeContent::Children(first) = self.nodes[node as usize].content {
                    let gain = gain + old.half_area();
                    stack.extend([(gain, first), (gain, first + 1)]);
                }
            }
            if pivot != parent {
                left = left.union(self.nodes[beside as usize].cuboid);
                gain += self.half_area(pivot) - left.half_area();
            }
            if pivot == 0 {
                break;
            }
            beside = sibling(pivot);
            pivot = self.parents[pivot as usize];
        }
        (best.area_reduction > 0.0).then_some(best)
    }

    /// Makes a subtree the sibling of the node `to`. Its old sibling replaces its old parent.
    fn move_beside(&mut self, from: u32, to: u32) {
        let (beside, parent) = (sibling(from), self.parents[from as usize]);
        // A sibling is never chosen: it gains nothing, because a box is exactly the union of its children's.
        debug_assert_ne!(to, beside);
        let [moved, raised] = [to, beside].map(|node| self.nodes[node as usize]);
        self.nodes[to as usize].content = NodeContent::Children(from.min(beside));
        self.set_node(moved, beside);
        self.set_node(raised, parent);
        self.parents[beside as usize] = to;
        self.parents[from as usize] = to;
        self.refit_ancestors(to);
        self.refit_ancestors(parent);
    }

    fn set_node(&mut self, node: Node, index: u32) {
        self.nodes[index as usize] = node;
        if let NodeContent::Children(first) = node.content {
            self.parents[first as usize..][..2].fill(index);
        }
    }

    /// Recomputes the boxes from a node up to the root.
    fn refit_ancestors(&mut self, mut node: u32) {
        loop {
            if let NodeContent::Children(first) = self.nodes[node as usize].content {
                let [left, right] = [first, first + 1].map(|child| self.nodes[child as usize]);
                self.nodes[node as usize].cuboid = left.cuboid.union(right.cuboid);
            }
            if node == 0 {
                break;
            }
            node = self.parents[node as usize];
        }
    }

    fn half_area(&self, node: u32) -> f32 {
        self.nodes[node as usize].cuboid.half_area()
    }
}

#[cfg(test)]
mod tests;
