//! Reinsertion: moves the largest subtrees of a tree to where they make its boxes smallest (`[REINSERT18]`).

use super::nodes::{Below, Node, sibling};
use crate::tolerance::REINSERTED_SHARE;
use rayon::prelude::*;

/// The subtrees that one thread takes at a time: with fewer, sharing takes as long as the work.
const SHARE: usize = 32;

/// Improves a tree in rounds. The first tries a share of the nodes, the later ones ever fewer, nearer to the root.
pub(super) fn reinsert(nodes: &mut [Node]) {
    if nodes.len() < 2 {
        return;
    }
    let mut tree = Tree::new(nodes);
    for share in (1..32).step_by(2).map(|n| 1.0 / n as f32) {
        let count = (tree.nodes.len() as f32 * REINSERTED_SHARE * share) as usize;
        tree.improve(count.clamp(1, tree.nodes.len() - 1));
    }
}

struct Tree<'a> {
    nodes: &'a mut [Node],
    parents: Vec<u32>,
    /// Whether a move of this round has changed a node.
    touched: Vec<bool>,
}

/// A subtree, the node that becomes its sibling, and by how much the areas of all boxes shrink.
struct Move {
    from: u32,
    to: u32,
    gain: f32,
}

impl<'a> Tree<'a> {
    fn new(nodes: &'a mut [Node]) -> Self {
        let mut parents = vec![0; nodes.len()];
        for (node, parent) in nodes.iter().zip(0..) {
            if let Below::Children(first) = node.below {
                parents[first as usize..][..2].fill(parent);
            }
        }
        Tree {
            touched: vec![false; nodes.len()],
            nodes,
            parents,
        }
    }

    /// Tries the largest nodes at other places, and makes the best moves that do not touch each other.
    fn improve(&mut self, count: usize) {
        // The first nodes are near the root, and most of the largest are among them.
        let first = self.nodes.len().min(2 * (count + 1));
        let mut largest: Vec<(f32, u32)> = (1..first as u32).map(|n| (self.area(n), n)).collect();
        let by_area = |a: &(f32, u32), b: &(f32, u32)| b.0.total_cmp(&a.0).then(a.1.cmp(&b.1));
        if count < largest.len() {
            largest.select_nth_unstable_by(count, by_area);
            largest.truncate(count);
        }
        largest.sort_unstable_by(by_area);
        // The tree stays as it is until all places are found, so that they can be searched side by side.
        let mut moves: Vec<Move> = (largest.par_iter().with_min_len(SHARE))
            .map_init(Vec::new, |stack, &(_, node)| self.best_move(node, stack))
            .flatten_iter()
            .collect();
        moves.sort_unstable_by(|a, b| b.gain.total_cmp(&a.gain));
        self.touched.fill(false);
        for Move { from, to, .. } in moves {
            let [old, new] = [from, to].map(|node| self.parents[node as usize]);
            let changed = [to, from, sibling(from), new, old].map(|node| node as usize);
            if !changed.iter().any(|&node| self.touched[node]) {
                for node in changed {
                    self.touched[node] = true;
                }
                self.make(from, to);
            }
        }
    }

    /// Finds the best place for a subtree: climbs to the root, and searches every subtree beside the way. A branch
    /// is left when its boxes grow by more than the best place gains.
    fn best_move(&self, from: u32, stack: &mut Vec<(f32, u32)>) -> Option<Move> {
        let cuboid = self.nodes[from as usize].cuboid;
        let area = cuboid.half_area();
        let parent = self.parents[from as usize];
        let mut best = Move {
            from,
            to: 0,
            gain: 0.0,
        };
        // The boxes above the old place shrink to what is left in them.
        let mut gain = self.area(parent);
        let (mut pivot, mut beside) = (parent, sibling(from));
        let mut left = self.nodes[beside as usize].cuboid;
        loop {
            stack.push((gain, beside));
            while let Some((gain, node)) = stack.pop() {
                if gain - area <= best.gain {
                    continue;
                }
                let Node { cuboid: old, below } = self.nodes[node as usize];
                let gain = gain - old.union(cuboid).half_area();
                if gain > best.gain {
                    best = Move {
                        to: node,
                        gain,
                        ..best
                    };
                }
                if let Below::Children(first) = below {
                    let gain = gain + old.half_area();
                    stack.extend([(gain, first), (gain, first + 1)]);
                }
            }
            if pivot != parent {
                left = left.union(self.nodes[beside as usize].cuboid);
                gain += self.area(pivot) - left.half_area();
            }
            if pivot == 0 {
                break;
            }
            beside = sibling(pivot);
            pivot = self.parents[pivot as usize];
        }
        (best.gain > 0.0).then_some(best)
    }

    /// Makes a subtree the sibling of a node; its old sibling takes the place of its old parent.
    fn make(&mut self, from: u32, to: u32) {
        let (beside, parent) = (sibling(from), self.parents[from as usize]);
        // A sibling is never chosen: it gains nothing, since a box is exactly that of the two below.
        debug_assert_ne!(to, beside);
        let [moved, raised] = [to, beside].map(|node| self.nodes[node as usize]);
        self.nodes[to as usize].below = Below::Children(from.min(beside));
        self.put(moved, beside);
        self.put(raised, parent);
        self.parents[beside as usize] = to;
        self.parents[from as usize] = to;
        self.refit(to);
        self.refit(parent);
    }

    fn put(&mut self, node: Node, index: u32) {
        self.nodes[index as usize] = node;
        if let Below::Children(first) = node.below {
            self.parents[first as usize..][..2].fill(index);
        }
    }

    /// Fits the boxes from a node up to the root.
    fn refit(&mut self, mut node: u32) {
        loop {
            if let Below::Children(first) = self.nodes[node as usize].below {
                let [left, right] = [first, first + 1].map(|child| self.nodes[child as usize]);
                self.nodes[node as usize].cuboid = left.cuboid.union(right.cuboid);
            }
            if node == 0 {
                break;
            }
            node = self.parents[node as usize];
        }
    }

    fn area(&self, node: u32) -> f32 {
        self.nodes[node as usize].cuboid.half_area()
    }
}

#[cfg(test)]
mod tests;
