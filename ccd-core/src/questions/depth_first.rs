//! Depth-first search, which always examines the newest pair, whatever its clock. It serves questions other than the
//! first contact.

use crate::distance::oracle::DistanceOracle;
use crate::engine::capacity::clear_and_shrink;
use crate::engine::queue::{QueueFull, Rank, Worklist};
use crate::engine::scratch::Scratch;
use crate::engine::search::WaitingItem;
use crate::math::order::lesser;

/// A schedule that searches depth first, for [any contact](DepthFirst::any_contact) and for the [closest
/// approach](DepthFirst::closest_approach).
///
/// Pairs are split and followed like those of [`BestFirst`](crate::schedule::BestFirst), but the newest is examined
/// next. A search reaches pieces at once, and few pairs wait.
///
/// Keep the value between queries: it owns the memory.
#[derive(Debug)]
pub struct DepthFirst<O: DistanceOracle> {
    pub(crate) stack: Stack<WaitingItem<O::Cache>>,
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

/// A stack of waiting pairs: the pair added last is examined next, whatever its clock.
#[derive(Debug)]
pub(crate) struct Stack<T> {
    items: Vec<(f64, T)>,
    peak_length: usize,
}

impl<T> Default for Stack<T> {
    fn default() -> Self {
        Stack {
            items: Vec::new(),
            peak_length: 0,
        }
    }
}

impl<T> Stack<T> {
    /// Removes all items, and keeps [a part of the memory](clear_and_shrink) for the next search.
    pub(crate) fn clear(&mut self) {
        clear_and_shrink(&mut self.items);
        self.peak_length = 0;
    }

    /// Returns the least clock of all items, the time until which all of them are proven apart; infinite if there are
    /// none.
    pub(crate) fn least_clock(&self) -> f64 {
        let clocks = self.items.iter().map(|&(clock, _)| clock);
        clocks.fold(f64::INFINITY, lesser)
    }

    /// Returns the largest number of items that waited at the same time.
    pub(crate) fn peak_length(&self) -> u64 {
        self.peak_length as u64
    }

    fn last(&mut self) -> &mut (f64, T) {
        self.items.last_mut().expect("an item waits")
    }
}

impl<T> Worklist<T> for Stack<T> {
    fn push(&mut self, clock: f64, _: Rank, item: T) -> Result<(), QueueFull> {
        self.items.push((clock, item));
        self.peak_length = self.peak_length.max(self.items.len());
        Ok(())
    }

    fn peek_next(&mut self) -> Option<(f64, &mut T)> {
        let (clock, item) = self.items.last_mut()?;
        Some((*clock, item))
    }

    fn postpone(&mut self, clock: f64) {
        self.last().0 = clock;
    }

    fn replace_next(&mut self, clock: f64, _: Rank, item: T) {
        *self.last() = (clock, item);
    }

    fn remove_next(&mut self) {
        self.items.pop();
    }
}
