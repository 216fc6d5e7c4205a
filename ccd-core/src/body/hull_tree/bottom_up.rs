//! A parallel traversal of a binary tree, children before parents.

use super::error::HullTreeError;
use crate::body::hierarchy::{Hierarchy, HierarchyNode};
use crate::body::threads::{MIN_PARALLEL_WORK, join};
use std::num::NonZero;
use std::ops::Range;
use std::thread::available_parallelism;

/// Computes a value for every node of a tree from the values of its two children, in parallel. Leaves receive two
/// arbitrary values.
///
/// # Guarantee
/// The result does not depend on the number of cores. Of several errors, that of the first node in sequential order
/// is returned.
///
/// # Errors
/// The errors of the function that computes a node's value.
pub(super) fn compute_bottom_up<T: Default + Send>(
    hierarchy: &Hierarchy,
    make: impl Fn(usize, [&T; 2]) -> Result<T, HullTreeError> + Sync,
) -> Result<Vec<T>, HullTreeError> {
    let cores = available_parallelism().map_or(1, NonZero::get);
    // Each of many cores gets several parts, as the sizes of the parts differ.
    let parts = if cores > 1 { 4 * cores } else { 1 };
    compute_bottom_up_in_parts(parts, hierarchy, make)
}

fn compute_bottom_up_in_parts<T: Default + Send>(
    parts: usize,
    hierarchy: &Hierarchy,
    make: impl Fn(usize, [&T; 2]) -> Result<T, HullTreeError> + Sync,
) -> Result<Vec<T>, HullTreeError> {
    let order = postorder(hierarchy);
    let mut subtree_sizes = vec![1; order.len()];
    for &at in &order {
        if let HierarchyNode::Inner(left, right) = hierarchy.nodes()[at] {
            subtree_sizes[at] += subtree_sizes[left as usize] + subtree_sizes[right as usize];
        }
    }
    let row = BottomUpComputation {
        hierarchy,
        postorder: &order,
        subtree_sizes: &subtree_sizes,
        compute_value: &make,
    };
    let mut done: Vec<T> = order.iter().map(|_| T::default()).collect();
    row.compute_subtree(0..order.len(), &mut done, parts)?;
    let mut sorted: Vec<T> = order.iter().map(|_| T::default()).collect();
    for (&at, made) in order.iter().zip(done) {
        sorted[at] = made;
    }
    Ok(sorted)
}

/// A function that computes a node's value from its children's values.
type ComputeValue<'a, T> = &'a (dyn Fn(usize, [&T; 2]) -> Result<T, HullTreeError> + Sync);

/// The nodes of a tree in postorder, with the function that computes a node's value from its children's values.
struct BottomUpComputation<'a, T> {
    hierarchy: &'a Hierarchy,
    postorder: &'a [usize],
    /// The number of nodes in each node's subtree.
    subtree_sizes: &'a [usize],
    compute_value: ComputeValue<'a, T>,
}

impl<T: Send> BottomUpComputation<'_, T> {
    /// Computes the values of one subtree, split into at most `parts` parts that run in parallel if they are large
    /// enough and a thread is free. The parts are shared between both children by size. Each child gets fewer of them,
    /// so that the depth of recursion is at most `parts`.
    fn compute_subtree(
        &self,
        range: Range<usize>,
        done: &mut [T],
        parts: usize,
    ) -> Result<(), HullTreeError> {
        let root = self.postorder[range.end - 1];
        match self.hierarchy.nodes()[root] {
            HierarchyNode::Inner(left, _) if parts > 1 && range.len() >= MIN_PARALLEL_WORK => {
                let (of_left, both) = (self.subtree_sizes[left as usize], range.len() - 1);
                let middle = range.start + of_left;
                let (first, second) = done[..both].split_at_mut(of_left);
                let of_first = (parts * of_left / range.len()).clamp(1, parts - 1);
                let (first, second) = join(
                    of_left.min(both - of_left),
                    || self.compute_subtree(range.start..middle, first, of_first),
                    || self.compute_subtree(middle..range.end - 1, second, parts - of_first),
                );
                first.and(second)?;
                self.compute_node(range.end - 1, range.start, done)
            }
            _ => (range.clone()).try_for_each(|at| self.compute_node(at, range.start, done)),
        }
    }

    /// Computes the value of one node from the values of its children, which are computed already. `done` has the
    /// values from position `start` of the postorder on.
    fn compute_node(&self, at: usize, start: usize, done: &mut [T]) -> Result<(), HullTreeError> {
        let node = self.postorder[at];
        let here = at - start;
        let children = match self.hierarchy.nodes()[node] {
            HierarchyNode::Inner(_, right) => {
                [here - 1 - self.subtree_sizes[right as usize], here - 1]
            }
            HierarchyNode::Leaf(_) => [here; 2],
        };
        done[here] = (self.compute_value)(node, children.map(|child| &done[child]))?;
        Ok(())
    }
}

/// Returns all nodes in postorder, so that every subtree is contiguous.
fn postorder(hierarchy: &Hierarchy) -> Vec<usize> {
    let mut order = Vec::with_capacity(hierarchy.nodes().len());
    let mut stack = vec![0];
    while let Some(at) = stack.pop() {
        order.push(at as usize);
        if let HierarchyNode::Inner(left, right) = hierarchy.nodes()[at as usize] {
            stack.extend([left, right]);
        }
    }
    order.reverse();
    order
}

#[cfg(test)]
mod tests;
