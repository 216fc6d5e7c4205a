//! Nodes made children first, subtrees beside each other on all cores.

use super::HullTreeError;
use crate::hierarchy::{Hierarchy, HierarchyNode};
use std::num::NonZero;
use std::ops::Range;
use std::panic::resume_unwind;
use std::sync::{Mutex, PoisonError};
use std::thread::{Builder, available_parallelism, scope};

/// What is made of every node, given what is made of its children; leaves are given any two.
///
/// # Guarantee
/// The same for any number of cores, also where it fails: of several errors it is that of the node that
/// comes first when one node is made after the other.
///
/// # Errors
/// Those of making a node.
pub(super) fn bottom_up<T: Default + Send>(
    hierarchy: &Hierarchy,
    make: impl Fn(usize, [&T; 2]) -> Result<T, HullTreeError> + Sync,
) -> Result<Vec<T>, HullTreeError> {
    let cores = available_parallelism().map_or(1, NonZero::get);
    // Several parts for a core, as they are not all of one size.
    let least = hierarchy.nodes().len() / (4 * cores);
    bottom_up_from(least.max(WORTHWHILE), hierarchy, make)
}

/// Subtrees of fewer nodes are made in one go.
fn bottom_up_from<T: Default + Send>(
    least: usize,
    hierarchy: &Hierarchy,
    make: impl Fn(usize, [&T; 2]) -> Result<T, HullTreeError> + Sync,
) -> Result<Vec<T>, HullTreeError> {
    let order = children_first(hierarchy);
    let mut below = vec![1; order.len()];
    for &at in &order {
        if let HierarchyNode::Inner(left, right) = hierarchy.nodes()[at] {
            below[at] += below[left as usize] + below[right as usize];
        }
    }
    let row = Row {
        hierarchy,
        order: &order,
        below: &below,
        least,
        make,
    };
    let mut done: Vec<T> = order.iter().map(|_| T::default()).collect();
    row.fill(0..order.len(), &mut done)?;
    let mut sorted: Vec<T> = order.iter().map(|_| T::default()).collect();
    for (&at, made) in order.iter().zip(done) {
        sorted[at] = made;
    }
    Ok(sorted)
}

/// Nodes in a row, each right after the subtree of its first child and then that of its second.
struct Row<'a, F> {
    hierarchy: &'a Hierarchy,
    order: &'a [usize],
    /// How many nodes each one's subtree has.
    below: &'a [usize],
    /// A subtree of fewer nodes is made in one go.
    least: usize,
    make: F,
}

/// A subtree of fewer nodes is not worth a thread.
const WORTHWHILE: usize = 1024;

impl<F> Row<'_, F> {
    /// Makes a range of the row that is one subtree.
    fn fill<T: Default + Send>(
        &self,
        range: Range<usize>,
        done: &mut [T],
    ) -> Result<(), HullTreeError>
    where
        F: Fn(usize, [&T; 2]) -> Result<T, HullTreeError> + Sync,
    {
        let root = self.order[range.end - 1];
        match self.hierarchy.nodes()[root] {
            HierarchyNode::Inner(left, _) if range.len() >= self.least => {
                let middle = range.start + self.below[left as usize];
                let (first, others) = done.split_at_mut(middle - range.start);
                let (second, _) = others.split_at_mut(range.end - 1 - middle);
                let ranges = [range.start..middle, middle..range.end - 1];
                self.fill_both(ranges, [first, second])?;
                self.fill_one(range.end - 1, range.start, done)
            }
            _ => (range.clone()).try_for_each(|at| self.fill_one(at, range.start, done)),
        }
    }

    /// Makes two subtrees beside each other, or one after the other where there is no thread to be had.
    fn fill_both<T: Default + Send>(
        &self,
        [one, other]: [Range<usize>; 2],
        [first, second]: [&mut [T]; 2],
    ) -> Result<(), HullTreeError>
    where
        F: Fn(usize, [&T; 2]) -> Result<T, HullTreeError> + Sync,
    {
        let waiting = Mutex::new(Some((one, first)));
        let fill_waiting = || {
            let taken = waiting
                .lock()
                .unwrap_or_else(PoisonError::into_inner)
                .take();
            taken.map_or(Ok(()), |(range, done)| self.fill(range, done))
        };
        let (of_first, of_second) = scope(|threads| {
            let thread = Builder::new().spawn_scoped(threads, fill_waiting);
            let of_second = self.fill(other, second);
            let of_first = match thread {
                Ok(thread) => thread.join().unwrap_or_else(|panic| resume_unwind(panic)),
                Err(_) => fill_waiting(),
            };
            (of_first, of_second)
        });
        of_first.and(of_second)
    }

    /// Makes a node of the row once its children are made; what is made starts at a place of the row.
    fn fill_one<T>(&self, at: usize, start: usize, done: &mut [T]) -> Result<(), HullTreeError>
    where
        F: Fn(usize, [&T; 2]) -> Result<T, HullTreeError> + Sync,
    {
        let node = self.order[at];
        let here = at - start;
        let children = match self.hierarchy.nodes()[node] {
            HierarchyNode::Inner(_, right) => [here - 1 - self.below[right as usize], here - 1],
            HierarchyNode::Leaf(_) => [here; 2],
        };
        done[here] = (self.make)(node, children.map(|child| &done[child]))?;
        Ok(())
    }
}

/// All nodes, each after its children, every subtree in one go.
fn children_first(hierarchy: &Hierarchy) -> Vec<usize> {
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
mod tests {
    use super::*;
    use crate::hull_tree::HullFault;

    /// A tree over so many pieces, each node before its children, split unevenly.
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
    fn parts_of_any_size_make_the_same() {
        let hierarchy = hierarchy(5000);
        // Of every node which pieces are below, as they come.
        let make = |at: usize, [left, right]: [&Vec<u32>; 2]| {
            Ok(match hierarchy.nodes()[at] {
                HierarchyNode::Leaf(piece) => vec![piece],
                HierarchyNode::Inner(..) => [&left[..], right].concat(),
            })
        };
        let one = bottom_up_from(usize::MAX, &hierarchy, make).unwrap();
        assert_eq!(one[0], (0..5000).collect::<Vec<u32>>());
        for least in [5000, 1000, 100] {
            assert_eq!(bottom_up_from(least, &hierarchy, make).unwrap(), one);
        }
    }

    #[test]
    fn the_first_error_is_the_same() {
        let hierarchy = hierarchy(5000);
        let fault = |at: usize| HullFault::BadFacet { facet: 7 }.at(at);
        let make = |at: usize, _: [&u32; 2]| match at % 1000 {
            999 => Err(fault(at)),
            _ => Ok(0),
        };
        let one = bottom_up_from(usize::MAX, &hierarchy, make).unwrap_err();
        for least in [5000, 1000, 100] {
            assert_eq!(bottom_up_from(least, &hierarchy, make).unwrap_err(), one);
        }
    }
}
