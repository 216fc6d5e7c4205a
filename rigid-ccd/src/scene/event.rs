//! The result for one pair of bodies of a scene: a contact or an error.

use crate::Error;
use ccd_core::order::greater;
use ccd_core::{Answer, Hit, HitKind, InputError, Limit, Unresolved};
use std::cmp::Ordering;

/// The first contact of two bodies of a scene.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Impact {
    /// The indices of the two bodies, the lower one first.
    pub bodies: [usize; 2],
    /// The first contact, in which A is the first of the two bodies and B the second.
    pub hit: Hit,
}

/// The error of a pair of bodies of a scene.
#[derive(Debug, thiserror::Error)]
#[error("bodies {} and {}: {error}", bodies[0], bodies[1])]
pub struct PairError {
    /// The indices of the two bodies, the lower one first.
    pub bodies: [usize; 2],
    /// The error of the pair's query; `Unresolved` has a time before which the bodies do not touch.
    #[source]
    pub error: Error,
}

/// A contact of two bodies, or the error that ended the search for their contact.
#[derive(Clone, Debug)]
pub(super) struct Event {
    /// The time before which the bodies do not touch.
    pub(super) time: f64,
    pub(super) bodies: [usize; 2],
    what: EventKind,
}

#[allow(clippy::large_enum_variant, reason = "most events are hits")]
#[derive(Clone, Debug)]
enum EventKind {
    Hit(Hit),
    Unresolved(Unresolved),
    Refused(InputError),
}

impl Event {
    /// Returns the event for the answer to a pair's query; `None` for bodies that stay apart.
    pub(super) fn from_answer(bodies: [usize; 2], answer: &Answer) -> Option<Self> {
        let (time, what) = match answer.hit() {
            Ok(hit) => hit.map(|hit| (hit.time, EventKind::Hit(hit)))?,
            Err(known) => (known.safe_until, EventKind::Unresolved(known)),
        };
        Some(Event {
            // Times are compared by their bits, so that a negative zero must not occur.
            time: time + 0.0,
            bodies,
            what,
        })
    }

    pub(super) fn from_error(bodies: [usize; 2], error: InputError) -> Self {
        Event::at_start(bodies, EventKind::Refused(error))
    }

    /// Returns the event of a pair whose query is out of range: it is unresolved from time 0 on.
    pub(super) fn unexamined_pair(bodies: [usize; 2]) -> Self {
        let known = Unresolved::from_safe_until(0.0, Limit::OverlapUndecided);
        Event::at_start(bodies, EventKind::Unresolved(known))
    }

    fn at_start(bodies: [usize; 2], what: EventKind) -> Self {
        let time = 0.0;
        Event { time, bodies, what }
    }

    /// Returns the event with `from`, the start of its query, added to its times. The sums are rounded down.
    pub(super) fn shifted_in_time(mut self, from: f64) -> Self {
        if from > 0.0 {
            let later = |time: f64| greater(from, (from + time).next_down());
            self.time = later(self.time);
            if let EventKind::Hit(hit) = &mut self.what {
                hit.time = later(hit.time);
            }
        }
        self
    }

    /// Returns whether the bodies are in contact, and not proven to be at least `distance` apart.
    pub(super) fn contact_may_be_nearer_than(&self, distance: f64) -> bool {
        let EventKind::Hit(hit) = &self.what else {
            return false;
        };
        // The comparison treats NaN as nearer.
        (hit.contact()).is_some_and(|contact| !(contact.separation.lower >= distance))
    }

    /// Returns whether the event is an overlap at the start.
    pub(super) fn is_start_overlap(&self) -> bool {
        matches!(&self.what, EventKind::Hit(hit) if matches!(hit.kind, HitKind::Overlapping(_)))
    }

    /// Returns whether the event is the error of an invalid query.
    pub(super) fn is_refused(&self) -> bool {
        matches!(self.what, EventKind::Refused(_))
    }

    /// Compares two events by time, and at equal times by the bodies' indices.
    pub(super) fn order(&self, other: &Event) -> Ordering {
        (self.time.total_cmp(&other.time)).then(self.bodies.cmp(&other.bodies))
    }

    pub(super) fn impact(&self) -> Result<Impact, PairError> {
        let bodies = self.bodies;
        let error = match &self.what {
            EventKind::Hit(hit) => return Ok(Impact { bodies, hit: *hit }),
            EventKind::Refused(error) => error.clone().into(),
            EventKind::Unresolved(known) => Error::Unresolved(Unresolved {
                safe_until: self.time,
                ..*known
            }),
        };
        Err(PairError { bodies, error })
    }
}
