use super::super::agglomerate::agglomerate;
use super::super::nodes::{AabbF32, Node, NodeContent};
use super::{Tree, reinsert_subtrees};
use ccd_core::glam::Vec3A;
use proptest::prelude::*;

fn leaf_list_strategy() -> impl Strategy<Value = Vec<Node>> {
    let point = || prop::array::uniform3(0.0f32..1.0).prop_map(Vec3A::from);
    let cuboid = (point(), 0.0f32..0.2).prop_map(|(lo, size)| AabbF32 { lo, hi: lo + size });
    prop::collection::vec(cuboid, 2..120).prop_map(|cuboids| {
        let leaves = cuboids.into_iter().zip(0..);
        leaves
            .map(|(cuboid, piece)| Node::leaf(piece, cuboid))
            .collect()
    })
}

fn total_half_area(nodes: &[Node]) -> f64 {
    nodes
        .iter()
        .map(|node| f64::from(node.cuboid.half_area()))
        .sum()
}

/// Checks that every node except the root has one parent, and that every box is the union of its children's boxes.
/// Returns the pieces of the leaves.
fn check_nodes_and_collect_pieces(nodes: &[Node]) -> Vec<u32> {
    let mut pieces = Vec::new();
    let mut stack = vec![0];
    let mut seen = 0;
    while let Some(node) = stack.pop() {
        seen += 1;
        let Node {
            cuboid,
            content: below,
        } = nodes[node as usize];
        match below {
            NodeContent::Piece(piece) => pieces.push(piece),
            NodeContent::Children(first) => {
                let [left, right] = [first, first + 1].map(|k| nodes[k as usize].cuboid);
                assert_eq!(cuboid, left.union(right));
                stack.extend([first, first + 1]);
            }
        }
    }
    assert_eq!(seen, nodes.len());
    pieces.sort_unstable();
    pieces
}

/// Returns half the total area of all boxes after the subtree `from` becomes the sibling of `to`.
fn total_half_area_after_move(nodes: &[Node], from: u32, to: u32) -> f64 {
    let mut copy = nodes.to_vec();
    Tree::new(&mut copy).move_beside(from, to);
    check_nodes_and_collect_pieces(&copy);
    total_half_area(&copy)
}

proptest! {
    #[test]
    fn trees_stay_trees_and_their_boxes_shrink(leaves in leaf_list_strategy()) {
        let mut nodes = agglomerate(&leaves);
        let before = total_half_area(&nodes);
        reinsert_subtrees(&mut nodes);
        prop_assert_eq!(check_nodes_and_collect_pieces(&nodes), (0..leaves.len() as u32).collect::<Vec<_>>());
        prop_assert!(total_half_area(&nodes) <= before * (1.0 + 1e-6));
    }

    #[test]
    fn the_best_move_is_the_best_of_all(leaves in leaf_list_strategy()) {
        let mut nodes = agglomerate(&leaves);
        let all = nodes.clone();
        let before = total_half_area(&all);
        let tree = Tree::new(&mut nodes);
        for from in (1..all.len() as u32).step_by(7) {
            let is_above = |upper: u32, mut node: u32| {
                while node != upper && node != 0 {
                    node = tree.parents[node as usize];
                }
                node == upper
            };
            let beside = super::sibling(from);
            let targets = (1..all.len() as u32)
                .filter(|&to| to != beside && !is_above(from, to) && !is_above(to, from));
            let gains = targets.map(|to| before - total_half_area_after_move(&all, from, to));
            let best = gains.fold(0.0, ccd_core::order::greater);
            let found = tree.best_reinsertion(from, &mut Vec::new()).map_or(0.0, |best| f64::from(best.area_reduction));
            prop_assert!((found - best).abs() <= 1e-4, "{from}: {found} instead of {best}");
        }
    }
}
