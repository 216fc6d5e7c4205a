//! A priority queue of pairs, ordered by clock.

use super::capacity::clear_and_shrink;
use crate::math::order::greater;

/// A priority queue of items by their clocks. Among equal clocks pairs of pieces come first, then the newest item, for
/// a depth-first search.
#[derive(Debug)]
pub(crate) struct Queue<T> {
    items: Vec<T>,
    vacant_slots: Vec<u32>,
    /// The key of the next item; `VACANT_KEY` if the queue is empty.
    least_key: Key,
    /// A tournament tree: the keys of the items, then the least of every four keys of the level before, up to a single
    /// four. The steps are the same for every change, so that no branch is mispredicted. In a heap, each step down has
    /// an unpredictable branch.
    tournament_levels: Vec<Vec<[Key; 4]>>,
    /// The number of levels in use.
    level_count: usize,
    last_serial: u32,
}

/// The sort key of an item: its clock, rank, age and index, from the highest bits to the lowest. It has 64 bits of
/// clock (clocks are not negative, so their bits have the order of the numbers), 1 bit of rank, 31 bits of age, 32 bits
/// of index.
type Key = u128;

/// The key of an empty slot, greater than all others.
const VACANT_KEY: Key = Key::MAX;

/// The largest number of items that can wait at once.
const MAX_ITEMS: usize = u32::MAX as usize;

impl<T> Default for Queue<T> {
    fn default() -> Self {
        Queue {
            items: Vec::new(),
            vacant_slots: Vec::new(),
            least_key: VACANT_KEY,
            tournament_levels: Vec::new(),
            level_count: 0,
            last_serial: 0,
        }
    }
}

impl<T> Queue<T> {
    /// Removes all items, and keeps [some of the memory](clear_and_shrink).
    pub(crate) fn clear(&mut self) {
        clear_and_shrink(&mut self.items);
        clear_and_shrink(&mut self.vacant_slots);
        self.least_key = VACANT_KEY;
        self.tournament_levels.iter_mut().for_each(clear_and_shrink);
        self.level_count = 0;
        self.last_serial = 0;
    }

    /// Returns the largest number of items that waited at once.
    pub(crate) fn peak_length(&self) -> u64 {
        self.items.len() as u64
    }

    fn least_slot(&self) -> u32 {
        assert!(self.least_key != VACANT_KEY, "no item waits");
        slot(self.least_key)
    }

    fn make_newest_key(&mut self, clock: f64, rank: Rank, place: u32) -> Key {
        self.last_serial = self.last_serial.wrapping_add(1);
        key(clock, rank, self.last_serial, place)
    }

    /// Sets the key of a slot, and updates the least keys on all levels above it.
    #[inline]
    fn set_key(&mut self, place: u32, key: Key) {
        let (mut at, mut least) = (place as usize, key);
        for level in &mut self.tournament_levels[..self.level_count] {
            let four = &mut level[at / 4];
            four[at % 4] = least;
            least = least_of_four(four);
            at /= 4;
        }
        self.least_key = least;
    }

    /// Adds a slot for the key of the last item.
    #[inline]
    fn add_slot(&mut self) {
        let mut last = self.items.len() - 1;
        if last == 0 || last == 1 << (2 * self.level_count) {
            self.add_level();
        }
        for level in &mut self.tournament_levels[..self.level_count] {
            if !last.is_multiple_of(4) {
                break;
            }
            last /= 4;
            if level.len() == last {
                level.push([VACANT_KEY; 4]);
            }
        }
    }

    #[cold]
    fn add_level(&mut self) {
        if self.tournament_levels.len() == self.level_count {
            self.tournament_levels.push(Vec::new());
        }
        self.tournament_levels[self.level_count].push([
            self.least_key,
            VACANT_KEY,
            VACANT_KEY,
            VACANT_KEY,
        ]);
        self.level_count += 1;
    }
}

impl<T> Worklist<T> for Queue<T> {
    #[inline]
    fn push(&mut self, clock: f64, rank: Rank, item: T) -> Result<(), QueueFull> {
        let place = match self.vacant_slots.pop() {
            Some(place) => {
                self.items[place as usize] = item;
                place
            }
            None if self.items.len() < MAX_ITEMS => {
                self.items.push(item);
                self.add_slot();
                (self.items.len() - 1) as u32
            }
            None => return Err(QueueFull),
        };
        let key = self.make_newest_key(clock, rank, place);
        self.set_key(place, key);
        Ok(())
    }

    #[inline]
    fn peek_next(&mut self) -> Option<(f64, &mut T)> {
        let item = self.items.get_mut(slot(self.least_key) as usize)?;
        Some((clock_of_key(self.least_key), item))
    }

    #[inline]
    fn postpone(&mut self, clock: f64) {
        let place = self.least_slot();
        let low = self.least_key as u64;
        self.set_key(place, Key::from(clock.to_bits()) << 64 | Key::from(low));
    }

    #[inline]
    fn postpone_as_newest(&mut self, clock: f64, rank: Rank) {
        let place = self.least_slot();
        let key = self.make_newest_key(clock, rank, place);
        self.set_key(place, key);
    }

    #[inline]
    fn replace_next(&mut self, clock: f64, rank: Rank, item: T) {
        let place = self.least_slot();
        self.items[place as usize] = item;
        self.postpone_as_newest(clock, rank);
    }

    #[inline]
    fn remove_next(&mut self) {
        if self.least_key != VACANT_KEY {
            let place = slot(self.least_key);
            self.vacant_slots.push(place);
            self.set_key(place, VACANT_KEY);
        }
    }
}

/// Returns the least of four keys, without a branch.
#[inline]
fn least_of_four(&[a, b, c, d]: &[Key; 4]) -> Key {
    let lower = if b < a { b } else { a };
    let upper = if d < c { d } else { c };
    if upper < lower { upper } else { lower }
}

fn clock_of_key(key: Key) -> f64 {
    f64::from_bits((key >> 64) as u64)
}

fn slot(key: Key) -> u32 {
    key as u32
}

fn key(clock: f64, rank: Rank, serial: u32, place: u32) -> Key {
    let age = u64::from(!serial & (u32::MAX >> 1));
    let low = (rank as u64) << 63 | age << 32 | u64::from(place);
    // `max` also turns a negative zero into a zero, whose bits come first in the order.
    u128::from(greater(0.0, clock).to_bits()) << 64 | u128::from(low)
}

/// A collection of waiting items, from which a search takes the next one.
pub(crate) trait Worklist<T> {
    /// Adds an item with its clock, which is at least 0.
    fn push(&mut self, clock: f64, rank: Rank, item: T) -> Result<(), QueueFull>;

    /// Returns the next item and its clock.
    fn peek_next(&mut self) -> Option<(f64, &mut T)>;

    /// Changes the clock of the next item to a later one.
    ///
    /// # Panics
    /// When no item waits.
    fn postpone(&mut self, clock: f64);

    /// Changes the clock of the next item, and makes it the newest of all items.
    ///
    /// # Panics
    /// When no item waits.
    fn postpone_as_newest(&mut self, clock: f64, rank: Rank);

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
