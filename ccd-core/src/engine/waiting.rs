//! The interface of collections of waiting pairs.

/// A collection of waiting items, from which a search takes one after another.
pub(crate) trait Waiting<T> {
    /// Adds an item that waits for its clock, which is not negative.
    fn push(&mut self, clock: f64, rank: Rank, item: T) -> Result<(), Full>;

    /// Returns the next item and its clock.
    fn next(&mut self) -> Option<(f64, &mut T)>;

    /// Lets the next item wait for a later clock.
    ///
    /// # Panics
    /// When no item waits.
    fn postpone(&mut self, clock: f64);

    /// Lets the next item wait for a later clock, as the newest of all.
    ///
    /// # Panics
    /// When no item waits.
    fn renew(&mut self, clock: f64, rank: Rank);

    /// Puts a new item in the place of the next one.
    ///
    /// # Panics
    /// When no item waits.
    fn replace(&mut self, clock: f64, rank: Rank, item: T);

    /// Removes the next item, if there is one.
    fn remove(&mut self);
}

/// The order of items with equal clocks.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Rank {
    PiecePair = 0,
    Siblings = 1,
}

/// The error of a collection that holds as many items as its indices allow.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Full;
