//! Work budgets, counted in exact predicates.

use std::cell::Cell;

/// A budget of remaining steps. A step costs about as much as an exact predicate.
#[derive(Debug)]
pub(crate) struct WorkBudget {
    remaining_steps: Cell<u64>,
}

impl WorkBudget {
    /// Creates a budget without a limit, which only counts steps.
    pub(crate) fn unbounded() -> Self {
        WorkBudget::with_steps(u64::MAX)
    }

    /// Creates a budget that is exhausted after `steps` steps.
    pub(crate) fn with_steps(steps: u64) -> Self {
        WorkBudget {
            remaining_steps: Cell::new(steps),
        }
    }

    /// Spends steps from the budget, and returns whether any are left.
    pub(crate) fn spend(&self, steps: usize) -> bool {
        let rest = self.remaining_steps.get().checked_sub(steps as u64);
        self.remaining_steps.set(rest.unwrap_or(0));
        rest.is_some_and(|rest| rest > 0)
    }

    /// Returns the number of steps spent from a budget without a limit.
    pub(crate) fn steps_spent(&self) -> u64 {
        u64::MAX - self.remaining_steps.get()
    }

    /// Returns an error if no steps are left.
    ///
    /// # Errors
    /// [`WorkBudgetExhausted`] if none are left.
    pub(crate) fn check(&self) -> Result<(), WorkBudgetExhausted> {
        self.check_exceeds(0)
    }

    /// Returns an error if at most `steps` steps are left, so that they cannot be [spent](WorkBudget::spend).
    ///
    /// # Errors
    /// [`WorkBudgetExhausted`] if no more are left.
    pub(crate) fn check_exceeds(&self, steps: usize) -> Result<(), WorkBudgetExhausted> {
        if self.remaining_steps.get() > steps as u64 {
            Ok(())
        } else {
            Err(WorkBudgetExhausted)
        }
    }
}

/// The error of a computation that has used all steps it was allowed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct WorkBudgetExhausted;
