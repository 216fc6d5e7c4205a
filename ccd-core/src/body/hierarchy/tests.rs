//! Tests that valid nodes make a balanced or a deep hierarchy, and that invalid nodes are refused.

use super::{Hierarchy, HierarchyNode::Inner, HierarchyNode::Leaf};
use crate::body::{Body, Solidity};
use crate::error::InputError;
use crate::tests::scene::{SoupKind, pieces, random_triangle_soup, rng};

fn assert_refused(nodes: &[super::HierarchyNode], pieces: usize) -> usize {
    match Hierarchy::new(nodes.to_vec(), pieces) {
        Err(InputError::BadHierarchy { index: at }) => at,
        other => panic!("{nodes:?} made {other:?}"),
    }
}

#[test]
fn a_tree_over_all_pieces_is_taken() {
    assert!(Hierarchy::new(vec![Leaf(0)], 1).is_ok());
    assert!(Hierarchy::new(vec![Inner(2, 1), Leaf(0), Leaf(1)], 2).is_ok());
    let deep = vec![Inner(1, 2), Leaf(2), Inner(3, 4), Leaf(0), Leaf(1)];
    assert!(Hierarchy::new(deep, 3).is_ok());
}

#[test]
fn invalid_nodes_are_refused_by_index() {
    // There is no root, and no node for the piece.
    assert_eq!(assert_refused(&[], 1), 0);
    assert_eq!(assert_refused(&[], 0), 0);
    assert_eq!(assert_refused(&[Leaf(0)], 0), 0);
    // A piece is missing, repeated, or out of range.
    assert_eq!(assert_refused(&[Leaf(0)], 2), 1);
    assert_eq!(assert_refused(&[Inner(1, 2), Leaf(1), Leaf(1)], 2), 1);
    assert_eq!(assert_refused(&[Inner(1, 2), Leaf(0), Leaf(9)], 2), 9);
    // A node is reached twice, from itself, never, or is out of range.
    assert_eq!(assert_refused(&[Inner(1, 1), Leaf(0)], 1), 1);
    assert_eq!(assert_refused(&[Inner(0, 1), Leaf(0)], 1), 0);
    assert_eq!(
        assert_refused(&[Inner(1, 2), Leaf(0), Leaf(1), Leaf(2)], 2),
        3
    );
    assert_eq!(assert_refused(&[Inner(1, 7), Leaf(0)], 1), 7);
    assert_eq!(
        assert_refused(&[Inner(1, u32::MAX), Leaf(0)], 1),
        u32::MAX as usize
    );
}

#[test]
fn a_hierarchy_of_other_pieces_is_refused() {
    let mut rng = rng(1);
    let of = |count| {
        Hierarchy::median_split(&pieces(&random_triangle_soup(
            &mut crate::tests::scene::rng(2),
            SoupKind::WellShaped,
            count,
            1.0,
        )))
    };
    let pieces = pieces(&random_triangle_soup(
        &mut rng,
        SoupKind::WellShaped,
        5,
        1.0,
    ));
    for count in [1, 4, 6, 40] {
        let made = Body::with_hierarchy(&pieces, &of(count), Solidity::Surface);
        assert!(
            matches!(made, Err(InputError::BadHierarchy { .. })),
            "{count}"
        );
    }
    assert!(Body::with_hierarchy(&pieces, &of(5), Solidity::Surface).is_ok());
}

#[test]
fn the_median_split_is_a_tree_and_balanced() {
    let mut rng = rng(3);
    for look in SoupKind::ALL {
        for count in [1, 2, 3, 31, 1_000] {
            let pieces = pieces(&random_triangle_soup(&mut rng, look, count, 1.0));
            let hierarchy = Hierarchy::median_split(&pieces);
            let nodes = hierarchy.nodes().to_vec();
            assert_eq!(nodes.len(), 2 * count - 1);
            assert!(Hierarchy::new(nodes.clone(), count).is_ok());
            let depth = depth(&nodes, 0);
            assert!(
                depth <= 1 + count.next_power_of_two().ilog2(),
                "{depth} for {count}"
            );
        }
    }
}

fn depth(nodes: &[super::HierarchyNode], at: u32) -> u32 {
    match nodes[at as usize] {
        Leaf(_) => 1,
        Inner(left, right) => 1 + depth(nodes, left).max(depth(nodes, right)),
    }
}

/// Tests that a tree as deep as its number of pieces is accepted without a stack overflow, and makes a body.
#[test]
fn a_chain_is_a_hierarchy_too() {
    let count = 100_000;
    let mut nodes = Vec::with_capacity(2 * count - 1);
    for piece in 0..count as u32 - 1 {
        let next = 2 * piece + 1;
        nodes.extend([Inner(next, next + 1), Leaf(piece)]);
    }
    nodes.push(Leaf(count as u32 - 1));
    // Node 2k is the k-th inner one: its children are its leaf, and the next inner one.
    assert!(Hierarchy::new(nodes.clone(), count).is_ok());
    let few = 2_000;
    let mut short: Vec<_> = nodes[..2 * few - 2].to_vec();
    short.push(Leaf(few as u32 - 1));
    let hierarchy = Hierarchy::new(short, few).unwrap();
    let pieces = pieces(&random_triangle_soup(
        &mut rng(4),
        SoupKind::WellShaped,
        few,
        1.0,
    ));
    let body = Body::with_hierarchy(&pieces, &hierarchy, Solidity::Surface).unwrap();
    assert_eq!(body.pieces().len(), few);
}
