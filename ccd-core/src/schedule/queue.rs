//! Pairs that wait for their clocks, least clock first.

use crate::math::order::greater;

/// Items ordered by their clocks. Among equal clocks pairs of pieces come first, then the newest,
/// for a depth-first search.
#[derive(Debug)]
pub(crate) struct Queue<T> {
    /// A heap with four children to each key: half as many steps as with two.
    heap: Vec<Key>,
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
            heap: Vec::new(),
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
        let key = self.newest(clock, rank, index);
        self.heap.push(key);
        self.peak = self.peak.max(self.heap.len());
        self.rise(key);
        Ok(())
    }

    /// Returns the least clock and its item.
    #[inline]
    pub(crate) fn least(&mut self) -> Option<(f64, &mut T)> {
        let key = *self.heap.first()?;
        Some((clock(key), &mut self.items[index(key)]))
    }

    /// Lets the least item wait for a later clock.
    ///
    /// # Panics
    /// When the queue is empty.
    pub(crate) fn postpone(&mut self, clock: f64) {
        let low = self.heap[0] as u64;
        self.sink(Key::from(clock.to_bits()) << 64 | Key::from(low));
    }

    /// Lets the least item wait for a later clock, as the newest of all.
    ///
    /// # Panics
    /// When the queue is empty.
    pub(crate) fn renew(&mut self, clock: f64, rank: Rank) {
        let key = self.newest(clock, rank, self.heap[0] as u32);
        self.sink(key);
    }

    /// Puts a new item in the place of the least one.
    ///
    /// # Panics
    /// When the queue is empty.
    pub(crate) fn replace(&mut self, clock: f64, rank: Rank, item: T) {
        let place = index(self.heap[0]);
        self.items[place] = item;
        self.renew(clock, rank);
    }

    /// Takes out the least item, if there is one.
    pub(crate) fn remove(&mut self) {
        if let Some(last) = self.heap.pop() {
            let removed = self.heap.first().copied().unwrap_or(last);
            self.vacant.push(removed as u32);
            if !self.heap.is_empty() {
                self.sink(last);
            }
        }
    }

    /// Returns the largest number of items that waited at once.
    pub(crate) fn peak(&self) -> u64 {
        self.peak as u64
    }

    fn newest(&mut self, clock: f64, rank: Rank, index: u32) -> Key {
        self.serial = self.serial.wrapping_add(1);
        key(clock, rank, self.serial, index)
    }

    /// Moves the last key, which is this one, up to its place.
    fn rise(&mut self, key: Key) {
        let mut hole = self.heap.len() - 1;
        while hole > 0 {
            let parent = (hole - 1) / CHILDREN;
            if self.heap[parent] <= key {
                break;
            }
            self.heap[hole] = self.heap[parent];
            hole = parent;
        }
        self.heap[hole] = key;
    }

    /// Puts a key in the place of the least one, and moves it down to where it belongs.
    fn sink(&mut self, key: Key) {
        let mut hole = 0;
        loop {
            let first = CHILDREN * hole + 1;
            let children = self.heap.get(first..).unwrap_or_default();
            let least = match children.first_chunk() {
                Some(all) => least_of(all),
                None => (0..children.len())
                    .min_by_key(|&k| children[k])
                    .unwrap_or(0),
            };
            match children.get(least) {
                Some(&child) if child < key => self.heap[hole] = child,
                _ => break,
            }
            hole = first + least;
        }
        self.heap[hole] = key;
    }
}

/// The number of keys below each one in the heap.
const CHILDREN: usize = 4;

/// Returns the index of the least key, without a branch.
#[inline]
fn least_of(keys: &[Key; CHILDREN]) -> usize {
    let lower = usize::from(keys[1] < keys[0]);
    let upper = 2 + usize::from(keys[3] < keys[2]);
    if keys[upper] < keys[lower] {
        upper
    } else {
        lower
    }
}

fn clock(key: Key) -> f64 {
    f64::from_bits((key >> 64) as u64)
}

fn index(key: Key) -> usize {
    key as u32 as usize
}

fn key(clock: f64, rank: Rank, serial: u32, index: u32) -> Key {
    let age = u64::from(!serial & (u32::MAX >> 1));
    let low = (rank as u64) << 63 | age << 32 | u64::from(index);
    // `max` also turns a negative zero into a zero, whose bits order first.
    u128::from(greater(0.0, clock).to_bits()) << 64 | u128::from(low)
}

#[cfg(test)]
mod tests;
