//! The interface of collections of waiting pairs.

/// A collection of waiting items, from which a search takes the next one.
pub(crate) trait Waiting<T> {
    /// Adds an item that waits until a clock ≥ 0.
    fn push(&mut self, clock: f64, rank: Rank, item: T) -> Result<(), QueueFull>;

    /// Returns the next item and its clock.
    fn next(&mut self) -> Option<(f64, &mut T)>;

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

    /// Replaces the next item by a new one.
    ///
    /// # Panics
    /// When no item waits.
    fn replace(&mut self, clock: f64, rank: Rank, item: T);

    /// Removes the next item, if there is one.
    fn remove(&mut self);
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
