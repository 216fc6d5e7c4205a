//! Builds a tree by agglomeration: mutual best neighbours along a space-filling curve become siblings, pass by pass,
//! until one node is left (`[PLOC18]`).

use super::nodes::{AabbF32, Node, NodeContent};
use crate::tolerance::{ADJACENT_ONLY_PASSES, MORTON_SEARCH_RADIUS};
use ccd_core::glam::DVec3;

/// Builds a binary tree over leaf nodes by agglomeration. The root comes first, then pairs of siblings, parents before
/// children.
///
/// # Complexity
/// O(n log n) if a constant share of the nodes finds a sibling in every pass; O(n²) if only one pair does, as for boxes
/// with a common centre.
pub(super) fn agglomerate(leaves: &[Node]) -> Vec<Node> {
    let Some(&first) = leaves.first() else {
        return Vec::new();
    };
    let mut tree = vec![first; 2 * leaves.len() - 1];
    // The tree is filled from its end.
    let mut free = tree.len();
    let mut row = sorted_along_morton_curve(leaves);
    for pass in 0.. {
        if row.len() == 1 {
            break;
        }
        let reach = if pass < ADJACENT_ONLY_PASSES {
            1
        } else {
            MORTON_SEARCH_RADIUS
        };
        let best = best_neighbour_indices(&row, reach);
        let mut next = Vec::with_capacity(row.len());
        for (index, &node) in row.iter().enumerate() {
            let other = best[index];
            if best[other] != index {
                next.push(node);
            } else if other < index {
                free -= 2;
                (tree[free], tree[free + 1]) = (node, row[other]);
                next.push(Node {
                    cuboid: node.cuboid.union(row[other].cuboid),
                    content: NodeContent::Children(free as u32),
                });
            }
        }
        row = next;
    }
    tree[0] = row[0];
    tree
}

/// Finds the best neighbour of every node in a row: the neighbour with the smallest joint box, or the last of several
/// such neighbours.
fn best_neighbour_indices(row: &[Node], reach: usize) -> Vec<usize> {
    let mut best = Vec::with_capacity(row.len());
    // The costs of pairing a node with later ones.
    let mut prices = vec![[0.0; MORTON_SEARCH_RADIUS]; row.len()];
    for index in 0..row.len() {
        let (mut least, mut other) = (f32::INFINITY, index);
        for before in index.saturating_sub(reach)..index {
            let price = prices[before][index - before - 1];
            if price <= least {
                (least, other) = (price, before);
            }
        }
        for after in index + 1..row.len().min(index + 1 + reach) {
            let price = row[index].cuboid.union(row[after].cuboid).half_area();
            prices[index][after - index - 1] = price;
            if price <= least {
                (least, other) = (price, after);
            }
        }
        best.push(other);
    }
    best
}

/// Returns leaves sorted by the Morton codes of their box centres.
fn sorted_along_morton_curve(leaves: &[Node]) -> Vec<Node> {
    let all = leaves
        .iter()
        .fold(AabbF32::EMPTY, |all, leaf| all.union(leaf.cuboid));
    let code = |leaf: &Node| morton_code(all.relative_centre(leaf.cuboid));
    let mut order: Vec<(u64, u64)> = leaves.iter().map(code).zip(0..).collect();
    order.sort_unstable_by_key(|&(code, _)| code);
    order
        .iter()
        .map(|&(_, leaf)| leaves[leaf as usize])
        .collect()
}

/// Returns the Morton code of a point: the interleaved 21 leading bits of its coordinates in the unit interval.
fn morton_code(point: DVec3) -> u64 {
    let cell = point * f64::from(1 << 21);
    spread_bits(cell.x as u32) | spread_bits(cell.y as u32) << 1 | spread_bits(cell.z as u32) << 2
}

/// Moves bit k of 21 bits to position 3 k.
fn spread_bits(bits: u32) -> u64 {
    let mut x = u64::from(bits) & 0x1f_ffff;
    x = (x | x << 32) & 0x001f_0000_0000_ffff;
    x = (x | x << 16) & 0x001f_0000_ff00_00ff;
    x = (x | x << 8) & 0x100f_00f0_0f00_f00f;
    x = (x | x << 4) & 0x10c3_0c30_c30c_30c3;
    (x | x << 2) & 0x1249_2492_4924_9249
}

#[cfg(test)]
mod tests;
