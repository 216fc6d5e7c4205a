//! Pairs of nodes of two hull trees.

use crate::body::Body;
use crate::body::hierarchy::HierarchyNode;
use crate::body::hull_tree::{FacetClass, HullTree};
use crate::body::piece::{ConvexCombination, Piece};
use crate::distance::oracle::Claim;
use crate::problem::{Problem, WhichBody};

/// The hull trees of both bodies.
#[derive(Clone, Copy, Debug)]
pub(super) struct HullTreePair<'a> {
    pub(super) a: HullTreeOrPiece<'a>,
    pub(super) b: HullTreeOrPiece<'a>,
}

/// Which of the nearest features of two nodes belong to bridges, the facets of a hull that are on no piece.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum FeaturesOnBridges {
    /// Both features belong to pieces.
    BothPieces,
    /// The feature of this body belongs to a bridge.
    OneBridge(WhichBody),
    /// Both features belong to bridges.
    BothBridges,
}

/// The children of a pair of nodes, which replace it.
#[derive(Clone, Copy, Debug)]
pub(super) enum PairChildren {
    /// The pair has no children: both nodes are leaves, with these pieces.
    Pieces([u32; 2]),
    /// Two pairs that together cover this one.
    Pairs([[u32; 2]; 2]),
}

impl<'a> HullTreePair<'a> {
    /// Creates the pair of trees; `None` if a body has more than one piece and no hull tree.
    pub(super) fn from_problem(problem: &Problem<'a>) -> Option<Self> {
        Some(HullTreePair {
            a: HullTreeOrPiece::for_body(problem.a.body)?,
            b: HullTreeOrPiece::for_body(problem.b.body)?,
        })
    }

    pub(super) fn hulls(&self, [a, b]: [u32; 2]) -> [Piece<'a>; 2] {
        [self.a.hull(a), self.b.hull(b)]
    }

    /// Returns which nearest features belong to bridges; `claim` has the nearest points.
    pub(super) fn features_on_bridges(&self, [a, b]: [u32; 2], claim: &Claim) -> FeaturesOnBridges {
        match (
            self.a.is_on_bridge(a, &claim.a),
            self.b.is_on_bridge(b, &claim.b),
        ) {
            (false, false) => FeaturesOnBridges::BothPieces,
            (true, false) => FeaturesOnBridges::OneBridge(WhichBody::A),
            (false, true) => FeaturesOnBridges::OneBridge(WhichBody::B),
            (true, true) => FeaturesOnBridges::BothBridges,
        }
    }

    /// Returns the two pairs that replace a pair when it is split, or its pieces if both nodes are leaves. One node is
    /// replaced by its children: if only one body has a bridge, that body's node, else the larger node, or the one with
    /// children if the other has none.
    pub(super) fn children_of_pair(
        &self,
        [a, b]: [u32; 2],
        near: FeaturesOnBridges,
    ) -> PairChildren {
        use HierarchyNode::{Inner, Leaf};
        let body = match near {
            FeaturesOnBridges::OneBridge(body) => body,
            FeaturesOnBridges::BothPieces | FeaturesOnBridges::BothBridges => {
                self.body_with_larger_node([a, b])
            }
        };
        match (self.a.hierarchy_node(a), self.b.hierarchy_node(b), body) {
            (Leaf(a), Leaf(b), _) => PairChildren::Pieces([a, b]),
            (Inner(left, right), Leaf(_), _) | (Inner(left, right), _, WhichBody::A) => {
                PairChildren::Pairs([[left, b], [right, b]])
            }
            (_, Inner(left, right), _) => PairChildren::Pairs([[a, left], [a, right]]),
        }
    }

    fn body_with_larger_node(&self, [a, b]: [u32; 2]) -> WhichBody {
        if self.b.half_diagonal(b) > self.a.half_diagonal(a) {
            WhichBody::B
        } else {
            WhichBody::A
        }
    }
}

/// The hull tree of a body, or the single piece of a body without a tree.
#[derive(Clone, Copy, Debug)]
pub(super) struct HullTreeOrPiece<'a> {
    body: &'a Body,
    /// The body's hull tree; without one, the body's only piece is the only node.
    tree: Option<&'a HullTree>,
}

impl<'a> HullTreeOrPiece<'a> {
    fn for_body(body: &'a Body) -> Option<Self> {
        let tree = body.hull_tree();
        (tree.is_some() || body.pieces().len() == 1).then_some(HullTreeOrPiece { body, tree })
    }

    fn hull(self, node: u32) -> Piece<'a> {
        match self.tree {
            Some(tree) => tree.hull(node),
            None => self.body.piece(node),
        }
    }

    fn hierarchy_node(self, node: u32) -> HierarchyNode {
        self.tree.map_or(HierarchyNode::Leaf(0), |tree| {
            tree.hierarchy().nodes()[node as usize]
        })
    }

    fn is_on_bridge(self, node: u32, point: &ConvexCombination) -> bool {
        self.tree
            .is_some_and(|tree| tree.facet_class_at(node, point) == FacetClass::Bridge)
    }

    fn half_diagonal(self, node: u32) -> f64 {
        self.tree.map_or(0.0, |tree| tree.half_diagonal(node))
    }
}
