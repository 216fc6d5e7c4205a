//! Pairs that wait for their clocks, least clock first.

use crate::math::order::greater;
use std::cmp::Reverse;
use std::collections::BinaryHeap;
use std::collections::binary_heap::PeekMut;

/// Items ordered by their clocks. Among equal clocks pairs of pieces come first, then the newest,
/// for a depth-first search.
#[derive(Debug)]
pub(crate) struct Queue<T> {
    heap: BinaryHeap<Reverse<Key>>,
    items: Vec<T>,
    vacant: Vec<u32>,
    serial: u32,
    peak: usize,
}

/// 64 bits of clock (clocks are not negative, so their bits order as the numbers do), 1 bit of
/// rank, 31 bits of age, 32 bits of index.
type Key = u128;

/// The order of items with equal clocks.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Rank {
    PiecePair = 0,
    Siblings = 1,
}

/// The most items that can wait at once.
const MAX_ITEMS: usize = u32::MAX as usize;

/// The error of a queue that holds as many items as its indices allow.
#[derive(Debug)]
pub(crate) struct Full;

impl<T> Default for Queue<T> {
    fn default() -> Self {
        Queue {
            heap: BinaryHeap::new(),
            items: Vec::new(),
            vacant: Vec::new(),
            serial: 0,
            peak: 0,
        }
    }
}

impl<T> Queue<T> {
    /// Removes all items, and keeps the memory.
    pub(crate) fn clear(&mut self) {
        self.heap.clear();
        self.items.clear();
        self.vacant.clear();
        self.serial = 0;
        self.peak = 0;
    }

    /// Adds an item that waits for its clock, which is not negative.
    pub(crate) fn push(&mut self, clock: f64, rank: Rank, item: T) -> Result<(), Full> {
        let index = match self.vacant.pop() {
            Some(index) => {
                self.items[index as usize] = item;
                index
            }
            None if self.items.len() < MAX_ITEMS => {
                self.items.push(item);
                (self.items.len() - 1) as u32
            }
            None => return Err(Full),
        };
        self.serial = self.serial.wrapping_add(1);
        self.heap
            .push(Reverse(key(clock, rank, self.serial, index)));
        self.peak = self.peak.max(self.heap.len());
        Ok(())
    }

    /// Returns the item of the least clock, which stays in the queue until the visit ends.
    pub(crate) fn visit(&mut self) -> Option<Visit<'_, T>> {
        let top = self.heap.peek_mut()?;
        let index = top.0 as u32;
        Some(Visit {
            clock: f64::from_bits((top.0 >> 64) as u64),
            item: &mut self.items[index as usize],
            top,
            vacant: &mut self.vacant,
        })
    }

    /// Returns the largest number of items that waited at once.
    pub(crate) fn peak(&self) -> u64 {
        self.peak as u64
    }
}

/// The first item of a queue.
pub(crate) struct Visit<'q, T> {
    pub(crate) clock: f64,
    pub(crate) item: &'q mut T,
    top: PeekMut<'q, Reverse<Key>>,
    vacant: &'q mut Vec<u32>,
}

impl<T> Visit<'_, T> {
    /// Lets the item wait for a later clock.
    pub(crate) fn postpone(mut self, clock: f64) {
        let low = self.top.0 as u64;
        self.top.0 = u128::from(clock.to_bits()) << 64 | u128::from(low);
    }

    /// Takes the item out.
    pub(crate) fn remove(self) {
        self.vacant.push(self.top.0 as u32);
        PeekMut::pop(self.top);
    }
}

fn key(clock: f64, rank: Rank, serial: u32, index: u32) -> Key {
    let age = u64::from(!serial & (u32::MAX >> 1));
    let low = (rank as u64) << 63 | age << 32 | u64::from(index);
    // `max` also turns a negative zero into a zero, whose bits order first.
    u128::from(greater(0.0, clock).to_bits()) << 64 | u128::from(low)
}

#[cfg(test)]
mod tests;
