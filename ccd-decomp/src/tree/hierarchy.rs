//! Hierarchies over pieces: medians split them into clusters, clusters are agglomerated, subtrees reinserted.

mod agglomerate;
mod nodes;
mod reinsert;

use crate::bounds::Bounds;
use crate::tolerance::AGGLOMERATED_PIECES;
use agglomerate::agglomerate;
use ccd_core::glam::{DVec3, Vec3A};
use ccd_core::{Hierarchy, HierarchyNode, InputError, Pieces};
use nodes::{Below, Cuboid, Node};
use reinsert::reinsert;

/// Builds a hierarchy over pieces: splits them at medians into clusters, agglomerates the clusters, and moves the
/// worst subtrees to better places.
///
/// Agglomeration alone (`[PLOC18]`) makes the best trees. On pieces that all have one centre, such as nested or
/// equal ones, it merges a single pair per pass, which takes quadratic time and makes a chain. Clusters bound
/// both.
///
/// # Guarantee
/// The same pieces give the same hierarchy. Every piece appears once; no input panics.
///
/// # Errors
/// [`InputError::TooManyPieces`] when an index cannot name them.
///
/// # Complexity
/// O(n log n) in the number of pieces.
pub fn build_hierarchy(pieces: &Pieces) -> Result<Hierarchy, InputError> {
    if pieces.len() >= u32::MAX as usize / 2 {
        return Err(InputError::TooManyPieces {
            pieces: pieces.len(),
        });
    }
    let mut nodes = split(&unit_leaves(pieces));
    reinsert(&mut nodes);
    let node = |node: &Node| match node.below {
        Below::Piece(piece) => HierarchyNode::Leaf(piece),
        Below::Children(first) => HierarchyNode::Inner(first, first + 1),
    };
    Hierarchy::new(nodes.iter().map(node).collect(), pieces.len())
}

/// Makes leaves of all pieces, with boxes in single precision, moved and scaled so that the whole fills a unit:
/// single precision would not separate pieces that are far from the origin, or tiny.
fn unit_leaves(pieces: &Pieces) -> Vec<Node> {
    let boxes: Vec<Bounds> = pieces
        .iter()
        .map(|piece| {
            let Bounds { lo, hi } = Bounds::of(piece.points.iter().copied());
            Bounds {
                lo: lo - piece.radius,
                hi: hi + piece.radius,
            }
        })
        .collect();
    let Bounds { lo, hi } = Bounds::of(boxes.iter().flat_map(|b| [b.lo, b.hi]));
    // Too short a length has no reciprocal.
    let scale = Some((hi - lo).max_element().recip()).filter(|s| s.is_finite());
    let unit = |p: DVec3| -> Vec3A { ((p - lo) * scale.unwrap_or(1.0)).as_vec3a() };
    let cuboid = |piece: &Bounds| Cuboid {
        lo: unit(piece.lo),
        hi: unit(piece.hi),
    };
    (boxes.iter().zip(0..))
        .map(|(piece, index)| Node::leaf(index, cuboid(piece)))
        .collect()
}

/// Splits leaves at medians of their centres down to clusters, and agglomerates these. Returns the root first.
fn split(leaves: &[Node]) -> Vec<Node> {
    let centre = |piece: u32| leaves[piece as usize].cuboid.centre();
    let mut order: Vec<u32> = (0..leaves.len() as u32).collect();
    let mut nodes = leaves[..1].to_vec();
    let mut inner = Vec::new();
    let mut stack = vec![(0, order.as_mut_slice())];
    while let Some((node, range)) = stack.pop() {
        if range.len() <= AGGLOMERATED_PIECES {
            let cluster: Vec<Node> = range.iter().map(|&piece| leaves[piece as usize]).collect();
            append(&mut nodes, node, &agglomerate(&cluster));
            continue;
        }
        let spread = range.iter().fold(Cuboid::EMPTY, |all, &piece| {
            all.union(Cuboid::of_point(centre(piece)))
        });
        let axis = spread.longest_axis();
        let half = range.len() / 2;
        range.select_nth_unstable_by(half, |&a, &b| {
            let order = centre(a)[axis].total_cmp(&centre(b)[axis]);
            order.then(a.cmp(&b))
        });
        let left = nodes.len();
        nodes.extend_from_slice(&leaves[..2]);
        nodes[node].below = Below::Children(left as u32);
        inner.push(node);
        let (low, high) = range.split_at_mut(half);
        stack.extend([(left, low), (left + 1, high)]);
    }
    for &node in inner.iter().rev() {
        let left = nodes[node].below.index() as usize;
        nodes[node].cuboid = nodes[left].cuboid.union(nodes[left + 1].cuboid);
    }
    nodes
}

/// Puts the root of a small tree at a node of a large one, and the other nodes at its end.
fn append(nodes: &mut Vec<Node>, root: usize, tree: &[Node]) {
    // Node k > 0 of the small tree becomes node k + offset of the large one.
    let offset = nodes.len() as u32 - 1;
    let moved = |node: &Node| Node {
        below: match node.below {
            Below::Children(first) => Below::Children(first + offset),
            leaf => leaf,
        },
        ..*node
    };
    let mut all = tree.iter().map(moved);
    nodes[root] = all.next().unwrap_or(nodes[root]);
    nodes.extend(all);
}

#[cfg(test)]
mod tests;
