//! Decides whether a required distance is kept, by two queries for any contact.

use super::ladder::{LAST_RUNGS, Ladder, Rung};
use crate::answer::{Answer, Contact, Limit, Outcome, Stats, Unresolved};
use crate::body::excess::Excess;
use crate::limits::LEAST_TOLERANCE;
use crate::math::order::{greater, lesser};

/// A required distance, and the limits of the search for a violation.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Required {
    pub(crate) distance: f64,
    pub(crate) tolerance: f64,
    pub(crate) budget: u64,
    /// The amounts by which the bodies may exceed their shapes: the distance is violated only by bodies that are
    /// nearer by as much.
    pub(crate) excess: Excess,
}

impl Required {
    /// Decides whether bodies keep the distance. The first query is whether they come near it. If they do, the second
    /// is whether they come nearer by the excess. In between, neither answer is certain for their shapes.
    ///
    /// # Errors
    /// The errors of the query for any contact.
    pub(crate) fn decide<E>(
        &self,
        any_contact: impl FnMut(Rung) -> Result<Answer, E>,
    ) -> Result<Answer, E> {
        let mut asking = Asking {
            required: *self,
            any_contact,
            stats: Stats::default(),
            half: 0.5 * self.tolerance,
        };
        // A part of the budget is left for the proof of a smaller distance.
        let most = self.budget - self.budget / 4;
        let near = asking.ask(self.distance, asking.half, most)?;
        // A finer tolerance may not be certified in f64.
        asking.half = greater(asking.half, near.tolerance);
        let outcome = match self.of(near.outcome) {
            Outcome::Measured {
                at: Some((time, contact)),
                ..
            } if self.certain() > 0.0 => asking.nearer(time, contact)?,
            found => found,
        };
        let outcome = match outcome {
            Outcome::Unresolved(known) => Outcome::Unresolved(Unresolved {
                lower: asking.lower(known.limit)?,
                ..known
            }),
            found => found,
        };
        Ok(Answer {
            tolerance: greater(self.tolerance, outcome.width()),
            outcome,
            stats: asking.stats,
        })
    }

    /// Returns the distance below which the bodies' shapes are certainly nearer than the required one; not above 0 if
    /// there is none.
    fn certain(&self) -> f64 {
        self.excess.below(self.distance)
    }

    /// Returns the outcome that a query's outcome implies, if the query had the distance as its margin.
    fn of(&self, found: Outcome) -> Outcome {
        match found {
            Outcome::Free { proven_gap } => Outcome::Free {
                proven_gap: greater(proven_gap, self.distance),
            },
            Outcome::Contact { time, contact }
                if !(self.excess.above(contact.separation.upper) < self.distance) =>
            {
                bracket(0.0, time, contact)
            }
            Outcome::Unresolved(known) => {
                Outcome::Unresolved(Unresolved::least(0.0, None, known.limit))
            }
            found => found,
        }
    }
}

/// The state of a decision about a required distance.
struct Asking<F> {
    required: Required,
    any_contact: F,
    stats: Stats,
    /// The tolerance of the queries: half the tolerance of the answer.
    half: f64,
}

impl<E, F: FnMut(Rung) -> Result<Answer, E>> Asking<F> {
    fn ask(&mut self, margin: f64, tolerance: f64, budget: u64) -> Result<Answer, E> {
        let answer = (self.any_contact)(Rung {
            margin,
            tolerance: greater(LEAST_TOLERANCE, tolerance),
            budget,
        })?;
        self.stats.add(&answer.stats);
        Ok(answer)
    }

    /// Returns the work that is left.
    fn left(&self) -> u64 {
        self.required.budget.saturating_sub(self.stats.work())
    }

    /// Decides whether shapes come nearer than the distance, after the bodies came within the tolerance of it, or
    /// nearer by less than the excess.
    fn nearer(&mut self, time: f64, contact: Contact) -> Result<Outcome, E> {
        let (distance, half) = (self.required.certain(), self.half);
        // Bodies in contact with this margin are nearer. Bodies that are not keep the distance up to the tolerance
        // and the excess.
        let margin = greater(0.0, distance - 1.5 * half);
        let finer = if margin > 0.0 {
            half
        } else {
            lesser(half, 0.5 * distance)
        };
        let found = self.ask(margin, finer, self.left())?.outcome;
        Ok(match (found, self.required.of(found)) {
            (Outcome::Free { proven_gap }, _) => bracket(proven_gap, time, contact),
            (_, Outcome::Unresolved(known)) => Outcome::Unresolved(Unresolved::least(
                known.lower,
                Some((time, contact)),
                known.limit,
            )),
            (_, found) => found,
        })
    }

    /// Returns the best lower bound that can be proven with the rest of the work.
    fn lower(&mut self, reason: Limit) -> Result<f64, E> {
        let mut ladder = Ladder::new(0.0, self.required.budget);
        if matches!(reason, Limit::Deadline | Limit::Stopped) {
            return Ok(ladder.lower);
        }
        for _ in 0..LAST_RUNGS {
            let Some(rung) = ladder.rung(self.required.distance, self.left() / 2) else {
                break;
            };
            let found = self.ask(rung.margin, rung.tolerance, rung.budget)?.outcome;
            ladder.climb(match found {
                Outcome::Free { proven_gap } => Some(proven_gap),
                _ => None,
            });
        }
        Ok(ladder.lower)
    }
}

fn bracket(lower: f64, time: f64, contact: Contact) -> Outcome {
    let lower = lesser(lower, contact.separation.upper);
    Outcome::least(lower, time, contact.no_nearer_than(lower))
}
