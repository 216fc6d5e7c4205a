//! A priority queue of pairs, ordered by clock.

use super::capacity::clear_and_shrink;
use crate::math::order::{greater, lesser};

/// A priority queue of items by their clocks. Among equal clocks pairs of pieces come first, then the newest item, for
/// a depth-first search.
///
/// It is a radix heap `[AMOT90]` with digits of six bits: an item is in the bucket of the highest digit in which its
/// clock differs from the floor, which is the clock of the next item. The clocks of a search never decrease, so that
/// items only move to lower buckets as the floor rises. An item is added without a comparison, and most items are never
/// moved.
#[derive(Debug)]
pub(crate) struct Queue<T> {
    items: Vec<T>,
    /// The clock and the list of each item.
    links: Vec<Link>,
    /// The list of vacant slots.
    vacant: u32,
    /// The bits of a clock. No item has an earlier one.
    floor: u64,
    /// The list of the pairs of pieces whose clock is the floor, the newest first.
    pieces_at_floor: u32,
    /// The lists of the other items, the newest first: for each place of the highest digit in which the clock differs
    /// from the floor, and for each value of that digit. Items at the floor are in the lists of the lowest digit.
    ///
    /// They are absent until an item is added, and lie beside the queue: a scene moves the searches of its pairs, each
    /// with a queue.
    buckets: Option<Box<Buckets>>,
    /// The values that occur for each digit, as bits.
    occupied_values: [u64; DIGIT_COUNT],
    /// The digits that occur, as bits.
    occupied_digits: u16,
}

/// The place of an item in the queue.
#[derive(Clone, Copy, Debug)]
struct Link {
    /// The clock as bits. Clocks are not negative, so their bits have the order of the numbers.
    clock_bits: u64,
    /// The next slot of the same list, or [`END`].
    next: u32,
    rank: Rank,
}

/// The number of bits of a digit.
const DIGIT_BITS: usize = 6;
const RADIX: usize = 1 << DIGIT_BITS;
const DIGIT_COUNT: usize = (u64::BITS as usize).div_ceil(DIGIT_BITS);

/// The list of each digit and value.
type Buckets = [[u32; RADIX]; DIGIT_COUNT];

/// The end of a list.
const END: u32 = u32::MAX;

impl<T> Default for Queue<T> {
    fn default() -> Self {
        Queue {
            items: Vec::new(),
            links: Vec::new(),
            vacant: END,
            floor: 0,
            pieces_at_floor: END,
            buckets: None,
            occupied_values: [0; DIGIT_COUNT],
            occupied_digits: 0,
        }
    }
}

impl<T> Queue<T> {
    /// Removes all items, and keeps [some of the memory](clear_and_shrink).
    pub(crate) fn clear(&mut self) {
        clear_and_shrink(&mut self.items);
        clear_and_shrink(&mut self.links);
        self.vacant = END;
        self.floor = 0;
        self.pieces_at_floor = END;
        while let Some((digit, value)) = self.lowest_bucket() {
            self.take_bucket(digit, value);
        }
    }

    /// Returns the largest number of items that waited at once.
    pub(crate) fn peak_length(&self) -> u64 {
        self.items.len() as u64
    }

    /// Adds an item to the list of its clock and rank.
    #[inline]
    fn insert(&mut self, slot: u32, clock_bits: u64, rank: Rank) {
        let differing_bits = clock_bits ^ self.floor;
        let list = if differing_bits == 0 && rank == Rank::PiecePair {
            &mut self.pieces_at_floor
        } else {
            let digit = (differing_bits | 1).ilog2() as usize / DIGIT_BITS;
            let value = digit_value(clock_bits, digit);
            self.occupied_digits |= 1 << digit;
            self.occupied_values[digit] |= 1 << value;
            &mut buckets(&mut self.buckets)[digit][value]
        };
        self.links[slot as usize] = Link {
            clock_bits,
            next: *list,
            rank,
        };
        *list = slot;
    }

    /// Adds an item whose clock may be before all others.
    #[inline]
    fn insert_any(&mut self, slot: u32, clock: f64, rank: Rank) {
        // This also turns a negative zero into a zero, whose bits come first in the order.
        let clock_bits = greater(0.0, clock).to_bits();
        if clock_bits < self.floor {
            self.lower_floor(clock_bits);
        }
        self.insert(slot, clock_bits, rank);
    }

    /// Returns the digit and its value of the bucket with the least clocks; `None` if all are empty.
    #[inline]
    fn lowest_bucket(&self) -> Option<(usize, usize)> {
        if self.occupied_digits == 0 {
            return None;
        }
        let digit = self.occupied_digits.trailing_zeros() as usize;
        let value = self.occupied_values[digit].trailing_zeros() as usize % RADIX;
        Some((digit, value))
    }

    /// Empties a bucket, and returns its list.
    #[inline]
    fn take_bucket(&mut self, digit: usize, value: usize) -> u32 {
        self.mark_empty(digit, value);
        std::mem::replace(&mut buckets(&mut self.buckets)[digit][value], END)
    }

    #[inline]
    fn mark_empty(&mut self, digit: usize, value: usize) {
        self.occupied_values[digit] &= !(1 << value);
        if self.occupied_values[digit] == 0 {
            self.occupied_digits &= !(1 << digit);
        }
    }

    /// Returns the slot of the next item, with the floor raised to its clock; [`END`] if no item waits.
    #[inline(always)]
    fn next_slot(&mut self) -> u32 {
        let slot = self.slot_at_floor();
        if slot != END {
            return slot;
        }
        self.raise_floor();
        self.slot_at_floor()
    }

    /// Returns the slot of the first item whose clock is the floor; [`END`] if there is none.
    #[inline]
    fn slot_at_floor(&self) -> u32 {
        if self.pieces_at_floor != END {
            return self.pieces_at_floor;
        }
        let buckets = self.buckets.as_ref();
        buckets.map_or(END, |buckets| buckets[0][digit_value(self.floor, 0)])
    }

    /// Raises the floor to the least clock: the items of the lowest bucket move to lower ones.
    #[inline(never)]
    fn raise_floor(&mut self) {
        let Some((digit, value)) = self.lowest_bucket() else {
            return;
        };
        let newest = self.take_bucket(digit, value);
        let link = self.links[newest as usize];
        if link.next == END {
            self.floor = link.clock_bits;
            self.insert(newest, link.clock_bits, link.rank);
        } else {
            self.redistribute(newest);
        }
    }

    /// Raises the floor to the least clock of a list that begins with the newest item, and adds its items.
    fn redistribute(&mut self, newest: u32) {
        let (oldest, least) = self.reverse(newest);
        self.floor = least;
        self.insert_list(oldest);
    }

    /// Reverses a list, and returns it with its least clock.
    #[inline]
    fn reverse(&mut self, mut list: u32) -> (u32, u64) {
        let (mut reversed, mut least) = (END, u64::MAX);
        while let Some(link) = self.links.get_mut(list as usize) {
            least = lesser(least, link.clock_bits);
            let next = std::mem::replace(&mut link.next, reversed);
            (reversed, list) = (list, next);
        }
        (reversed, least)
    }

    /// Adds the items of a list that begins with the oldest, one after the other.
    #[inline]
    fn insert_list(&mut self, mut list: u32) {
        while let Some(&link) = self.links.get(list as usize) {
            self.insert(list, link.clock_bits, link.rank);
            list = link.next;
        }
    }

    /// Sorts all items into buckets again, for a clock before all others.
    #[cold]
    fn lower_floor(&mut self, floor: u64) {
        let mut lists = vec![std::mem::replace(&mut self.pieces_at_floor, END)];
        while let Some((digit, value)) = self.lowest_bucket() {
            lists.push(self.take_bucket(digit, value));
        }
        self.floor = floor;
        for newest in lists {
            let (oldest, _) = self.reverse(newest);
            self.insert_list(oldest);
        }
    }

    /// Takes the next item out of its list, and returns its slot and rank; `None` if no item waits.
    #[inline]
    fn take_next(&mut self) -> Option<(u32, Rank)> {
        let slot = self.next_slot();
        let Link { next, rank, .. } = *self.links.get(slot as usize)?;
        if self.pieces_at_floor != END {
            self.pieces_at_floor = next;
        } else {
            let value = digit_value(self.floor, 0);
            buckets(&mut self.buckets)[0][value] = next;
            if next == END {
                self.mark_empty(0, value);
            }
        }
        Some((slot, rank))
    }
}

/// Returns the lists, which are empty at first.
#[inline]
fn buckets(buckets: &mut Option<Box<Buckets>>) -> &mut Buckets {
    buckets.get_or_insert_with(|| Box::new([[END; RADIX]; DIGIT_COUNT]))
}

/// Returns the value of a digit of a clock's bits.
#[inline]
fn digit_value(clock_bits: u64, digit: usize) -> usize {
    (clock_bits >> (DIGIT_BITS * digit)) as usize % RADIX
}

impl<T> Worklist<T> for Queue<T> {
    // The item is made in its place, not moved there.
    #[inline(always)]
    fn push(&mut self, clock: f64, rank: Rank, item: T) -> Result<(), QueueFull> {
        let slot = self.vacant;
        let slot = if let Some(link) = self.links.get(slot as usize) {
            self.vacant = link.next;
            self.items[slot as usize] = item;
            slot
        } else {
            if self.items.len() >= END as usize {
                return Err(QueueFull);
            }
            self.items.push(item);
            self.links.push(Link {
                clock_bits: 0,
                next: END,
                rank,
            });
            (self.items.len() - 1) as u32
        };
        self.insert_any(slot, clock, rank);
        Ok(())
    }

    #[inline]
    fn peek_next(&mut self) -> Option<(f64, &mut T)> {
        let slot = self.next_slot();
        let item = self.items.get_mut(slot as usize)?;
        Some((f64::from_bits(self.floor), item))
    }

    #[inline]
    fn postpone(&mut self, clock: f64) {
        let (slot, rank) = self.take_next().expect("an item waits");
        self.insert_any(slot, clock, rank);
    }

    #[inline]
    fn replace_next(&mut self, clock: f64, rank: Rank, item: T) {
        let (slot, _) = self.take_next().expect("an item waits");
        self.items[slot as usize] = item;
        self.insert_any(slot, clock, rank);
    }

    #[inline]
    fn remove_next(&mut self) {
        if let Some((slot, _)) = self.take_next() {
            self.links[slot as usize].next = self.vacant;
            self.vacant = slot;
        }
    }
}

/// A collection of waiting items, from which a search takes the next one.
pub(crate) trait Worklist<T> {
    /// Adds an item with its clock, which is at least 0.
    fn push(&mut self, clock: f64, rank: Rank, item: T) -> Result<(), QueueFull>;

    /// Returns the next item and its clock.
    fn peek_next(&mut self) -> Option<(f64, &mut T)>;

    /// Changes the clock of the next item to a later one. The item is then the newest with that clock.
    ///
    /// # Panics
    /// When no item waits.
    fn postpone(&mut self, clock: f64);

    /// Replaces the next item by a new item with a clock of its own.
    ///
    /// # Panics
    /// When no item waits.
    fn replace_next(&mut self, clock: f64, rank: Rank, item: T);

    /// Removes the next item, if there is one.
    fn remove_next(&mut self);
}

/// The order of items with equal clocks: pieces before nodes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Rank {
    PiecePair = 0,
    Siblings = 1,
}

/// The collection is full: it holds as many items as its indices allow.
#[derive(Clone, Copy, Debug)]
pub(crate) struct QueueFull;

#[cfg(test)]
mod tests;
