//! Finds the pairs of bodies whose swept boxes meet.

use ccd_core::SweptBox;
use parry3d_f64::bounding_volume::Aabb;
use parry3d_f64::math::Vector;
use parry3d_f64::partitioning::{Bvh, BvhBuildStrategy, BvhWorkspace};

/// Returns the pairs of boxes that meet and that `asked` accepts, in ascending order, each with the lower index first.
///
/// # Guarantee
/// No pair is missed, whatever the tree is like: a box that the tree does not contain is compared with all others.
pub(super) fn overlapping_pairs(
    boxes: &[SweptBox],
    asked: impl Fn([usize; 2]) -> bool,
) -> Vec<[usize; 2]> {
    let corner = |point: ccd_core::glam::DVec3| Vector::from_array(point.to_array());
    let leaf = |swept: &SweptBox| Aabb::new(corner(swept.min), corner(swept.max));
    let leaves: Vec<Aabb> = boxes.iter().map(leaf).collect();
    let tree = Bvh::from_leaves(BvhBuildStrategy::Binned, &leaves);
    let mut pairs = Vec::new();
    tree.traverse_bvtt_single_tree::<false>(&mut BvhWorkspace::default(), &mut |a, b| {
        let pair = in_ascending_order(a as usize, b as usize);
        if asked(pair) {
            pairs.push(pair);
        }
    });
    for (lost, leaf) in leaves.iter().enumerate() {
        if !ancestor_boxes_contain(&tree, lost, leaf) {
            let others = (0..boxes.len()).filter(|&other| other != lost);
            let others = others.map(|other| in_ascending_order(lost, other));
            pairs.extend(others.filter(|&pair| asked(pair)));
        }
    }
    pairs.retain(|&[a, b]| boxes[a].meets(&boxes[b]));
    pairs.sort_unstable();
    pairs.dedup();
    pairs
}

/// Returns whether every ancestor of a leaf in the tree contains the leaf's box. If so, a search for the boxes that
/// meet this box finds all of them.
fn ancestor_boxes_contain(tree: &Bvh, index: usize, leaf: &Aabb) -> bool {
    let mut leaves = tree.leaves(|node| node.contains_aabb(leaf));
    leaves.any(|held| held as usize == index)
}

/// Returns two indices in ascending order.
pub(super) fn in_ascending_order(a: usize, b: usize) -> [usize; 2] {
    if a < b { [a, b] } else { [b, a] }
}

#[cfg(test)]
mod tests;
