//! The bounding volume traversal tree with its front `[FAST06 §5.1]`.

use super::hull_pair::{FeaturesOnBridges, HullTreePair, PairChildren};
use crate::engine::capacity::clear_and_shrink;
use crate::engine::pieces::pair::Pair;
use crate::math::order::lesser;

/// A tree of pairs of nodes of two hull trees, from the pair of roots down to the pairs at which a descent stopped. The
/// leaves are the front: together they cover all pairs of pieces. The front is kept between two descents, with the
/// caches of the oracle.
#[derive(Debug, Default)]
pub(super) struct TraversalTree<C> {
    /// All pairs of the tree. The root is the first, and pairs of children are adjacent.
    nodes: Vec<Node<C>>,
    /// The unused slots of `nodes`: the index of the first of every two adjacent slots.
    vacant_slots: Vec<u32>,
    leaf_count: usize,
    peak_leaf_count: usize,
}

/// A pair of nodes of two hull trees, with the results of its last visit.
#[derive(Clone, Debug)]
pub(super) struct Node<C> {
    pub(super) pair: [u32; 2],
    pub(super) traversal_pair: TraversalPair<C>,
    /// The index of the first of two children; `None` for a leaf.
    pub(super) children: Option<u32>,
    /// A lower bound of the pair's distance at its last visit.
    pub(super) distance_lower_bound: f64,
    /// The time until which the pair was certified apart at its last visit; infinite for a pair that stays apart to
    /// the end.
    pub(super) certified_until: f64,
    /// Whether pieces or bridges own the pair's nearest features.
    pub(super) features_on_bridges: FeaturesOnBridges,
    /// The children are joined only while the bodies are nearer than this; each attempt that fails lowers it.
    pub(super) max_join_distance: f64,
}

#[derive(Clone, Debug)]
pub(super) enum TraversalPair<C> {
    /// A pair of which at least one node is an inner node, with the oracle's cache.
    Nodes(C),
    /// A pair of two leaves.
    Pieces(Pair<C>),
}

impl<C: Clone + Default> TraversalTree<C> {
    /// Resets the tree to the pair of roots.
    pub(super) fn reset(&mut self, hulls: HullTreePair<'_>) {
        clear_and_shrink(&mut self.nodes);
        clear_and_shrink(&mut self.vacant_slots);
        self.nodes.push(Node::new(hulls, [0, 0], C::default()));
        (self.leaf_count, self.peak_leaf_count) = (1, 1);
    }

    /// Returns the largest number of pairs that were in the front at once.
    pub(super) fn peak_leaf_count(&self) -> u64 {
        self.peak_leaf_count as u64
    }

    pub(super) fn node(&mut self, at: u32) -> &mut Node<C> {
        &mut self.nodes[at as usize]
    }

    /// Returns the leaves, in the order of the tree.
    pub(super) fn leaf_indices(&self) -> Vec<u32> {
        self.leaves().map(|(at, _)| at).collect()
    }

    /// Returns the least clock among the leaves.
    pub(super) fn least_clock(&self) -> f64 {
        let clocks = self.leaves().map(|(_, node)| node.certified_until);
        clocks.fold(f64::INFINITY, lesser)
    }

    /// Returns the pairs whose children are both leaves and do not stay apart to the end, each with its first child.
    pub(super) fn joinable_pairs(&self) -> Vec<(u32, u32)> {
        let is_open_leaf = |child: &Node<C>| child.children.is_none() && !child.stays_apart();
        let above = self.preorder().filter_map(|(at, node)| {
            let first = node.children?;
            let children = &self.nodes[first as usize..][..2];
            children.iter().all(is_open_leaf).then_some((at, first))
        });
        above.collect()
    }

    /// Splits a leaf into two pairs that cover it, and returns the index of the first; `None` for a pair of pieces.
    pub(super) fn split(&mut self, hulls: HullTreePair<'_>, at: u32) -> Option<u32> {
        let node = &self.nodes[at as usize];
        let PairChildren::Pairs(pairs) =
            hulls.children_of_pair(node.pair, node.features_on_bridges)
        else {
            return None;
        };
        // Nearest points of a covering pair are a good start for the pair. This does not hold for
        // pieces: when they touch, a warm start affects their axis, and so the answer.
        let cache = match &node.traversal_pair {
            TraversalPair::Nodes(cache) => cache.clone(),
            TraversalPair::Pieces(_) => C::default(),
        };
        let children = pairs.map(|pair| Node::new(hulls, pair, cache.clone()));
        let first = match self.vacant_slots.pop() {
            Some(first) => {
                for (child, at) in children.into_iter().zip(first as usize..) {
                    self.nodes[at] = child;
                }
                first
            }
            None => {
                self.nodes.extend(children);
                self.nodes.len() as u32 - 2
            }
        };
        self.nodes[at as usize].children = Some(first);
        self.leaf_count += 1;
        self.peak_leaf_count = self.peak_leaf_count.max(self.leaf_count);
        Some(first)
    }

    /// Removes the two leaves below a pair, so that the pair becomes a leaf.
    pub(super) fn remove_child_leaves(&mut self, at: u32) {
        if let Some(first) = self.nodes[at as usize].children.take() {
            self.vacant_slots.push(first);
            self.leaf_count -= 1;
        }
    }

    fn leaves(&self) -> impl Iterator<Item = (u32, &Node<C>)> {
        self.preorder().filter(|(_, node)| node.children.is_none())
    }

    /// Returns all nodes with their indices, each node before its children, and the first child before the second.
    fn preorder(&self) -> impl Iterator<Item = (u32, &Node<C>)> {
        let mut stack = vec![0];
        std::iter::from_fn(move || {
            let at = stack.pop()?;
            let node = &self.nodes[at as usize];
            if let Some(first) = node.children {
                stack.extend([first + 1, first]);
            }
            Some((at, node))
        })
    }
}

impl<C> Node<C> {
    /// Returns whether the pair is certified apart to the end of the query.
    pub(super) fn stays_apart(&self) -> bool {
        self.certified_until >= 1.0
    }
}

impl<C: Default + Clone> Node<C> {
    fn new(hulls: HullTreePair<'_>, pair: [u32; 2], cache: C) -> Self {
        Node {
            pair,
            traversal_pair: match hulls.children_of_pair(pair, FeaturesOnBridges::BothBridges) {
                PairChildren::Pieces([a, b]) => TraversalPair::Pieces(Pair::new(a, b)),
                PairChildren::Pairs(_) => TraversalPair::Nodes(cache),
            },
            children: None,
            distance_lower_bound: f64::NEG_INFINITY,
            certified_until: 0.0,
            features_on_bridges: FeaturesOnBridges::BothBridges,
            max_join_distance: f64::INFINITY,
        }
    }
}
