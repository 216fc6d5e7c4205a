//! Depth-first search: always examines the newest pair, whatever its clock. It serves questions other than the first
//! contact.

use super::scratch::Scratch;
use super::search::Item;
use super::stack::Stack;
use crate::distance::oracle::DistanceOracle;

/// A schedule that searches depth first, for [any contact](DepthFirst::any_contact) and for the [closest
/// approach](DepthFirst::closest_approach).
///
/// Pairs are split and followed like those of [`BestFirst`](crate::schedule::BestFirst), but the newest is examined
/// next. A search reaches pieces at once, and few pairs wait.
///
/// Keep the value between queries: it owns the memory.
#[derive(Debug)]
pub struct DepthFirst<O: DistanceOracle> {
    pub(crate) stack: Stack<Item<O::Cache>>,
    pub(crate) scratch: Scratch,
}

impl<O: DistanceOracle> Default for DepthFirst<O> {
    fn default() -> Self {
        DepthFirst {
            stack: Stack::default(),
            scratch: None,
        }
    }
}
