use super::*;
use crate::body::hull_tree::HullFault;

/// Creates a tree over `pieces` pieces whose nodes are split at about a third, each node before its children.
fn hierarchy(pieces: usize) -> Hierarchy {
    let mut nodes = vec![HierarchyNode::Leaf(0)];
    let mut stack = vec![(0, 0, pieces)];
    while let Some((at, start, end)) = stack.pop() {
        nodes[at] = HierarchyNode::Leaf(start as u32);
        if end - start > 1 {
            let (left, middle) = (nodes.len(), start + (end - start).div_ceil(3));
            nodes.extend([HierarchyNode::Leaf(0); 2]);
            nodes[at] = HierarchyNode::Inner(left as u32, left as u32 + 1);
            stack.extend([(left, start, middle), (left + 1, middle, end)]);
        }
    }
    Hierarchy::new(nodes, pieces).unwrap()
}

#[test]
fn results_do_not_depend_on_the_number_of_parts() {
    let hierarchy = hierarchy(5000);
    // Collects the pieces below every node, in order.
    let make = |at: usize, [left, right]: [&Vec<u32>; 2]| {
        Ok(match hierarchy.nodes()[at] {
            HierarchyNode::Leaf(piece) => vec![piece],
            HierarchyNode::Inner(..) => [&left[..], right].concat(),
        })
    };
    let one = compute_bottom_up_in_parts(1, &hierarchy, make).unwrap();
    assert_eq!(one[0], (0..5000).collect::<Vec<u32>>());
    for parts in [2, 3, 8, 64] {
        assert_eq!(
            compute_bottom_up_in_parts(parts, &hierarchy, make).unwrap(),
            one
        );
    }
}

/// Tests that a tree as deep as its number of pieces overflows no stack: one child of every inner node is a leaf.
#[test]
fn chains_take_no_more_stack_than_other_trees() {
    const PIECE_COUNT: u32 = 100_000;
    for leaf_first in [true, false] {
        let mut nodes = Vec::new();
        for k in 0..PIECE_COUNT - 1 {
            let (leaf, rest) = (2 * k + 1, 2 * k + 2);
            nodes.push(if leaf_first {
                HierarchyNode::Inner(leaf, rest)
            } else {
                HierarchyNode::Inner(rest, leaf)
            });
            nodes.push(HierarchyNode::Leaf(k));
        }
        nodes.push(HierarchyNode::Leaf(PIECE_COUNT - 1));
        let hierarchy = Hierarchy::new(nodes, PIECE_COUNT as usize).unwrap();
        let count = |at: usize, [left, right]: [&u32; 2]| {
            Ok(match hierarchy.nodes()[at] {
                HierarchyNode::Leaf(_) => 1,
                HierarchyNode::Inner(..) => left + right,
            })
        };
        for parts in [1, 8, 64] {
            assert_eq!(
                compute_bottom_up_in_parts(parts, &hierarchy, count).unwrap()[0],
                PIECE_COUNT
            );
        }
        assert_eq!(
            compute_bottom_up(&hierarchy, count).unwrap()[0],
            PIECE_COUNT
        );
    }
}

#[test]
fn the_first_error_is_the_same() {
    let hierarchy = hierarchy(5000);
    let fault = |at: usize| HullFault::BadFacet { facet: 7 }.at_node(at);
    let make = |at: usize, _: [&u32; 2]| match at % 1000 {
        999 => Err(fault(at)),
        _ => Ok(0),
    };
    let one = compute_bottom_up_in_parts(1, &hierarchy, make).unwrap_err();
    for parts in [2, 3, 8, 64] {
        assert_eq!(
            compute_bottom_up_in_parts(parts, &hierarchy, make).unwrap_err(),
            one
        );
    }
}
