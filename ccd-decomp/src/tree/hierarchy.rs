//! Hierarchies over pieces, built through `obvhs`.

use crate::bounds::Bounds;
use crate::tolerance::{AGGLOMERATED_PIECES, REINSERTED_SHARE, SEARCH_DEPTH};
use ccd_core::glam::{DVec3, Vec3A};
use ccd_core::{Hierarchy, HierarchyNode, InputError, Pieces};
use obvhs::Boundable;
use obvhs::aabb::Aabb;
use obvhs::bvh2::Bvh2;
use obvhs::bvh2::node::Bvh2Node;
use obvhs::bvh2::reinsertion::ReinsertionOptimizer;
use obvhs::ploc::{PlocBuilder, PlocSearchDistance, SortPrecision};

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
    let boxes = unit_boxes(pieces);
    let mut tree = split(&boxes);
    ReinsertionOptimizer::default().run(&mut tree, REINSERTED_SHARE, None);
    let node = |node: &Bvh2Node| match node.is_leaf() {
        true => HierarchyNode::Leaf(node.first_index),
        false => HierarchyNode::Inner(node.first_index, node.first_index + 1),
    };
    Hierarchy::new(tree.nodes.iter().map(node).collect(), pieces.len())
}

struct PieceBox(Aabb);

impl Boundable for PieceBox {
    fn aabb(&self) -> Aabb {
        self.0
    }
}

/// Computes the boxes of all pieces in single precision, moved and scaled so that the whole fills a unit: single
/// precision would not separate pieces that are far from the origin, or tiny.
fn unit_boxes(pieces: &Pieces) -> Vec<PieceBox> {
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
    boxes
        .iter()
        .map(|piece| PieceBox(Aabb::new(unit(piece.lo), unit(piece.hi))))
        .collect()
}

/// Splits the boxes at medians of their centres down to clusters, and agglomerates these.
fn split(boxes: &[PieceBox]) -> Bvh2 {
    let centre = |piece: u32| boxes[piece as usize].0.center();
    let mut order: Vec<u32> = (0..boxes.len() as u32).collect();
    let mut nodes = vec![Bvh2Node::default()];
    let mut inner = Vec::new();
    let mut stack = vec![(0usize, 0usize, boxes.len())];
    while let Some((node, start, end)) = stack.pop() {
        let range = &mut order[start..end];
        if range.len() <= AGGLOMERATED_PIECES {
            agglomerate(boxes, range, &mut nodes, node);
            continue;
        }
        let mut spread = Aabb::empty();
        for &piece in range.iter() {
            spread.extend(centre(piece));
        }
        let axis = spread.largest_axis();
        let half = range.len() / 2;
        range.select_nth_unstable_by(half, |&a, &b| {
            let order = centre(a)[axis].total_cmp(&centre(b)[axis]);
            order.then(a.cmp(&b))
        });
        let left = nodes.len();
        nodes.extend([Bvh2Node::default(); 2]);
        nodes[node].first_index = left as u32;
        inner.push(node);
        stack.extend([(left, start, start + half), (left + 1, start + half, end)]);
    }
    for &node in inner.iter().rev() {
        let left = nodes[node].first_index as usize;
        let union = nodes[left].aabb().union(nodes[left + 1].aabb());
        nodes[node].set_aabb(union);
    }
    Bvh2 {
        nodes,
        primitive_indices: (0..boxes.len() as u32).collect(),
        children_are_ordered_after_parents: true,
        ..Bvh2::default()
    }
}

/// Agglomerates some pieces: puts the root of their tree at a node, and its other nodes at the end.
fn agglomerate(boxes: &[PieceBox], pieces: &[u32], nodes: &mut Vec<Bvh2Node>, root: usize) {
    let members: Vec<PieceBox> = pieces
        .iter()
        .map(|&piece| PieceBox(boxes[piece as usize].0))
        .collect();
    let tree = PlocBuilder::with_capacity(members.len()).build(
        PlocSearchDistance::Low,
        &members,
        (0..members.len() as u32).collect(),
        SortPrecision::U64,
        SEARCH_DEPTH,
    );
    // Node k > 0 of the small tree becomes node k + offset of the large one.
    let offset = nodes.len() as u32 - 1;
    let moved = |node: &Bvh2Node| {
        let mut node = *node;
        node.first_index = match node.is_leaf() {
            true => pieces[tree.primitive_indices[node.first_index as usize] as usize],
            false => node.first_index + offset,
        };
        node
    };
    let mut all = tree.nodes.iter().map(moved);
    nodes[root] = all.next().unwrap_or_default();
    nodes.extend(all);
}

#[cfg(test)]
mod tests;
