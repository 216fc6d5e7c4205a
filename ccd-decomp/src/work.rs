//! Budgets of work, counted in predicates.

use std::cell::Cell;

/// A budget: the number of steps that are left, each about an exact predicate.
#[derive(Debug)]
pub(crate) struct Work {
    left: Cell<u64>,
}

impl Work {
    /// A budget without a limit.
    pub(crate) fn unbounded() -> Self {
        Work::of(u64::MAX)
    }

    /// A budget of a number of steps.
    pub(crate) fn of(steps: u64) -> Self {
        Work {
            left: Cell::new(steps),
        }
    }

    /// Takes some steps, and returns whether there were more than these. Where there were fewer, none are left.
    pub(crate) fn spend(&self, steps: usize) -> bool {
        let rest = self.left.get().checked_sub(steps as u64);
        self.left.set(rest.unwrap_or(0));
        rest.is_some_and(|rest| rest > 0)
    }

    /// The number of steps that were taken from a budget without a limit.
    pub(crate) fn taken(&self) -> u64 {
        u64::MAX - self.left.get()
    }

    /// Checks that some steps are left.
    ///
    /// # Errors
    /// [`OutOfWork`] when none are.
    pub(crate) fn check(&self) -> Result<(), OutOfWork> {
        match self.left.get() {
            0 => Err(OutOfWork),
            _ => Ok(()),
        }
    }
}

/// The budget is spent.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct OutOfWork;
