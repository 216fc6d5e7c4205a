//! How much may be spent on a mesh.

use std::cell::Cell;

/// Steps that are left: about so many exact predicates.
#[derive(Debug)]
pub(crate) struct Work {
    left: Cell<u64>,
}

impl Work {
    /// As much as it takes.
    pub(crate) fn unbounded() -> Self {
        Work::of(u64::MAX)
    }

    /// So many steps.
    pub(crate) fn of(steps: u64) -> Self {
        Work {
            left: Cell::new(steps),
        }
    }

    /// Takes some steps; whether there were so many. Once there were not, there are none.
    pub(crate) fn spend(&self, steps: usize) -> bool {
        let rest = self.left.get().checked_sub(steps as u64);
        self.left.set(rest.unwrap_or(0));
        rest.is_some_and(|rest| rest > 0)
    }

    /// How many steps it took so far, of as much as it takes.
    pub(crate) fn taken(&self) -> u64 {
        u64::MAX - self.left.get()
    }

    /// # Errors
    /// [`OutOfWork`] when all is spent.
    pub(crate) fn check(&self) -> Result<(), OutOfWork> {
        match self.left.get() {
            0 => Err(OutOfWork),
            _ => Ok(()),
        }
    }
}

/// All that could be spent is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct OutOfWork;
