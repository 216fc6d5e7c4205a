//! What is found at the start: touching, overlapping, or one inside the other.

use crate::containment;
use crate::outcome::{Contact, Outcome, Overlap};
use crate::problem::Problem;

/// Collects what pairs of pieces are like at the start, until the first clock past it.
#[derive(Debug, Default)]
pub(crate) struct Start {
    touching: Option<Contact>,
    over: bool,
}

impl Start {
    /// A pair touches at the start; another one may overlap still.
    pub(crate) fn touch(&mut self, contact: Contact) {
        self.touching.get_or_insert(contact);
    }

    /// A pair overlaps.
    pub(crate) fn overlapping(contact: Contact) -> Outcome {
        Outcome::Overlapping {
            overlap: Overlap::Pieces(contact),
        }
    }

    /// The answer as far as it is known.
    pub(crate) fn touching(&self) -> Option<Outcome> {
        self.touching.map(|contact| Outcome::Touching { contact })
    }

    /// All pairs are past the start and none overlaps: the answer, if it lies there.
    pub(crate) fn end(&mut self, problem: &Problem<'_>) -> Option<Outcome> {
        if std::mem::replace(&mut self.over, true) {
            return None;
        }
        match containment::at_start(problem) {
            Some(overlap) => Some(Outcome::Overlapping { overlap }),
            None => self.touching(),
        }
    }
}
