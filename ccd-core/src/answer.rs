//! The answer to a query: the outcome, the accuracy of its numbers, and the work that the query took.

mod contact;
mod effort;
mod hit;
mod unresolved;

use crate::body::excess::ExcessSum;
use crate::math::order::{greater, lesser};
use crate::tuning::EVALUATIONS_WORTH_A_VISIT;

pub use contact::{Contact, Overlap, Separation};
pub use effort::Effort;
pub use hit::{Hit, HitKind};
pub use unresolved::{Limit, Unresolved};

/// The outcome of a query, with the accuracy of its numbers and the cost of computing them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Answer {
    /// What the query found: contact, no contact, a distance, or the limit that stopped it.
    pub outcome: Outcome,
    /// The distance beyond the margin within which a contact is reported. It is the requested tolerance, unless only a
    /// larger one can be certified at the coordinates of the scene, or the bodies were [let
    /// go](crate::StartPolicy::Leave) with a smaller one. For bounds of a distance it is at least their width, which
    /// includes the [excess](crate::Body::with_excess) of the bodies.
    pub tolerance: f64,
    /// The number of steps that the query took, by kind.
    pub stats: Stats,
}

/// What a query found out about two bodies.
///
/// | question | outcomes |
/// |---|---|
/// | first contact | free, contact, touching, overlapping, unresolved |
/// | any contact | free, contact, overlapping, unresolved |
/// | contact interval | free, interval, unresolved |
/// | closest approach, distance | measured, overlapping, unresolved; with a required [clearance](crate::Settings::clearance) also free and contact |
///
/// # Guarantee
/// All times and bounds hold in floating point: nothing touches before a first contact. Contacts and their distances
/// are those of the bodies, also if the bodies [exceed](crate::Body::with_excess) their shapes. The shapes then touch
/// no earlier, and may be farther apart by the excess of both. Bounds of a requested distance hold for the shapes:
/// the excess is added to the upper bounds, those of contacts included.
///
/// ```
/// use ccd_core::Outcome;
/// /// The part of a motion that is safe to make.
/// fn safe_share(outcome: &Outcome, duration: f64) -> f64 {
///     match *outcome {
///         Outcome::Free { .. } => 1.0,
///         Outcome::Contact { time, .. } => time / duration,
///         Outcome::Unresolved(known) => known.safe_until / duration,
///         _ => 0.0,
///     }
/// }
/// assert_eq!(safe_share(&Outcome::Free { proven_gap: 0.1 }, 2.0), 1.0);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Outcome {
    /// The bodies stay apart over the whole duration.
    Free {
        /// A lower bound of the distance at all times: the margin plus half the tolerance, even if the bodies are
        /// farther apart. It is less, down to 0, if a contact at the start was [let go](crate::StartPolicy::Leave).
        /// With a required [clearance](crate::Settings::clearance) it is at least that.
        proven_gap: f64,
    },
    /// The bodies are in contact at `time`: within margin + tolerance, or nearer than a required
    /// [clearance](crate::Settings::clearance). There is no contact before a first contact.
    Contact {
        /// The time of the contact, in the motions' unit.
        time: f64,
        /// The separation at that time: `lower` and `upper` bound the distance of the bodies.
        contact: Contact,
    },
    /// The bodies are within margin + tolerance at the start, without overlapping.
    Touching {
        /// The separation at the start: `lower` and `upper` bound the distance of the bodies.
        contact: Contact,
    },
    /// The bodies overlap at the start.
    Overlapping {
        /// The proof that the bodies overlap at the start.
        overlap: Overlap,
        /// An upper bound of the distance at the start: 0, or the [excess](crate::Body::with_excess) of both bodies
        /// if the query was about the distance.
        upper: f64,
    },
    /// The first and the last time of contact were found; the bodies may part in between. They do not touch before the
    /// first or after the last.
    Interval {
        /// The first time of contact, and its kind.
        first: Hit,
        /// The last time of contact, and its kind.
        last: Hit,
    },
    /// The least distance over the duration is at least `lower`, and at most the distance of the nearest pieces.
    LeastDistance {
        /// A lower bound of the least distance.
        lower: f64,
        /// The time of the smallest distance that was found, in the motions' unit.
        time: f64,
        /// The nearest pieces at that time. Their distance is an upper bound of the least distance.
        contact: Contact,
    },
    /// A limit, such as the budget, was reached before the answer was known.
    Unresolved(Unresolved),
}

/// Counters for the work that a query took.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Stats {
    /// The number of pairs of nodes that were bounded or split, pairs of pieces included.
    pub iterations: u64,
    /// The approximate number of times that a point was projected onto a direction, by the oracle or for bounds of how
    /// long a gap lasts.
    pub point_evaluations: u64,
    /// The number of calls of the oracle, each for one pair of pieces; calls that returned no result are included.
    pub oracle_calls: u64,
    /// The number of oracle calls that returned no result.
    pub give_ups: u64,
    /// The largest number of pairs that waited in the queue at one time.
    pub peak_front: u64,
    /// The number of steps in which all pairs advanced together; the first computation of the distance counts as a
    /// step. These are the steps of conservative advancement. It is 0 for schedules with a clock for every pair.
    pub advancements: u64,
    /// The work of the oracle, counted in the steps of its own algorithm.
    pub oracle_effort: Effort,
}

/// Whether two bodies stay at least a required distance apart over the whole duration.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ClearanceVerdict {
    /// The bodies are certainly at least the required distance apart at all times.
    Kept,
    /// The bodies are certainly nearer than the required distance at some time.
    Violated,
    /// The bounds of the least distance are too far apart to decide.
    Unverified,
}

impl ClearanceVerdict {
    /// Compares a required distance with a lower and an upper bound of the least distance.
    ///
    /// Bodies that may touch keep no clearance, not even a clearance of 0.
    pub fn from_bounds([lower, upper]: [f64; 2], required: f64) -> Self {
        if lower >= required && lower > 0.0 {
            ClearanceVerdict::Kept
        } else if upper < required || upper <= 0.0 {
            ClearanceVerdict::Violated
        } else {
            ClearanceVerdict::Unverified
        }
    }
}

impl Answer {
    /// Returns the first contact; `None` if the bodies stay apart.
    ///
    /// # Errors
    /// [`Unresolved`] if a limit was reached first.
    pub fn hit(&self) -> Result<Option<Hit>, Unresolved> {
        self.outcome.hit()
    }

    /// Converts an answer about enclosing bodies to an answer about the enclosed shapes. It is called once for each
    /// query about a distance.
    pub(crate) fn widened_by_excess(self, excess: ExcessSum) -> Self {
        let outcome = self.outcome.widened_by_excess(excess);
        Answer {
            outcome,
            tolerance: greater(self.tolerance, outcome.least_distance_bracket_width()),
            ..self
        }
    }
}

impl Outcome {
    /// Returns the first contact; `None` if the bodies stay apart.
    ///
    /// # Errors
    /// [`Unresolved`] if a limit was reached first.
    pub fn hit(&self) -> Result<Option<Hit>, Unresolved> {
        let at = |time, kind| Ok(Some(Hit { time, kind }));
        match *self {
            Outcome::Free { .. } => Ok(None),
            Outcome::Contact { time, contact } => at(time, HitKind::Contact(contact)),
            Outcome::Touching { contact } => at(0.0, HitKind::Touching(contact)),
            Outcome::Overlapping { overlap, .. } => at(0.0, HitKind::Overlapping(overlap)),
            Outcome::Interval { first, .. } => Ok(Some(first)),
            Outcome::LeastDistance { lower, .. } if lower > 0.0 => Ok(None),
            // Bodies that may touch count as in contact, and a lower bound that is NaN excludes no contact.
            Outcome::LeastDistance { time, contact, .. } => at(time, HitKind::Contact(contact)),
            Outcome::Unresolved(known) => Err(known),
        }
    }

    /// Returns a lower bound of the requested distance; for a query about contacts, a lower bound of the distance at
    /// all times. It is 0 if no better one is known.
    pub fn lower(&self) -> f64 {
        match *self {
            Outcome::Free { proven_gap } => proven_gap,
            Outcome::LeastDistance { lower, .. } => lower,
            Outcome::Unresolved(known) => known.lower,
            Outcome::Contact { .. }
            | Outcome::Touching { .. }
            | Outcome::Overlapping { .. }
            | Outcome::Interval { .. } => 0.0,
        }
    }

    /// Returns an upper bound of the requested distance; for a query about contacts, an upper bound of the least
    /// distance. It is infinite if none is known.
    pub fn upper(&self) -> f64 {
        match *self {
            Outcome::Free { .. } => f64::INFINITY,
            Outcome::Contact { contact, .. }
            | Outcome::Touching { contact }
            | Outcome::LeastDistance { contact, .. } => contact.separation.upper,
            Outcome::Overlapping { upper, .. } => upper,
            Outcome::Interval { first, .. } => first
                .contact()
                .map_or(0.0, |contact| contact.separation.upper),
            Outcome::Unresolved(known) => known.upper,
        }
    }

    /// Returns the time of the contact, or of the measured distance, in the motions' unit; `None` if nothing was found
    /// or measured.
    pub fn time(&self) -> Option<f64> {
        match *self {
            Outcome::Overlapping { .. } => Some(0.0),
            Outcome::Interval { first, .. } => Some(first.time),
            _ => self.nearest_contact().map(|(time, _)| time),
        }
    }

    /// Returns the time of the contact or of the measured distance, and the nearest pieces at that time.
    pub fn nearest_contact(&self) -> Option<(f64, Contact)> {
        match *self {
            Outcome::Contact { time, contact } | Outcome::LeastDistance { time, contact, .. } => {
                Some((time, contact))
            }
            Outcome::Touching { contact } => Some((0.0, contact)),
            Outcome::Interval { first, .. } => first.contact().map(|contact| (first.time, contact)),
            Outcome::Unresolved(known) => known.nearest_contact,
            Outcome::Free { .. } | Outcome::Overlapping { .. } => None,
        }
    }

    /// Returns the limit that ended the query; `None` if the query was answered.
    pub fn limit(&self) -> Option<Limit> {
        match self {
            Outcome::Unresolved(known) => Some(known.limit),
            _ => None,
        }
    }

    /// Returns whether the bodies stay at least the required distance apart, as far as the bounds of the least distance
    /// tell.
    ///
    /// Bodies that may touch keep no clearance, not even a clearance of 0.
    pub fn clearance_verdict(&self, required: f64) -> ClearanceVerdict {
        ClearanceVerdict::from_bounds([self.lower(), self.upper()], required)
    }

    /// Creates the outcome for a contact at a time: [`Outcome::Touching`] at time 0, else [`Outcome::Contact`].
    pub(crate) fn from_contact(time: f64, contact: Contact) -> Self {
        if time > 0.0 {
            Outcome::Contact { time, contact }
        } else {
            Outcome::Touching { contact }
        }
    }

    /// Creates the outcome for two bodies that overlap at the start.
    pub(crate) fn from_overlap(overlap: Overlap) -> Self {
        Outcome::Overlapping {
            overlap,
            upper: 0.0,
        }
    }

    /// Creates the outcome for bodies whose distance is least at a contact, with a lower bound that is at most the upper
    /// bound.
    pub(crate) fn from_least_distance(lower: f64, time: f64, contact: Contact) -> Self {
        let lower = lesser(lower, contact.separation.upper);
        Outcome::LeastDistance {
            lower,
            time,
            contact: contact.cap_lower_bound(lower),
        }
    }

    /// Creates the outcome of a query about contacts that a limit ended.
    pub(crate) fn unresolved(safe_until: f64, limit: Limit) -> Self {
        Outcome::Unresolved(Unresolved::from_safe_until(safe_until, limit))
    }

    /// Returns the difference between the bounds of the least distance; 0 if the outcome is no least distance.
    pub(crate) fn least_distance_bracket_width(&self) -> f64 {
        match *self {
            Outcome::LeastDistance { lower, contact, .. } => contact.separation.upper - lower,
            _ => 0.0,
        }
    }

    /// Replaces each contact by `map(contact, time)`, and takes the upper bounds of the least distance from the new
    /// contacts.
    pub(crate) fn map_contacts(mut self, mut map: impl FnMut(Contact, f64) -> Contact) -> Self {
        match &mut self {
            Outcome::Contact { time, contact } | Outcome::LeastDistance { time, contact, .. } => {
                *contact = map(*contact, *time);
            }
            Outcome::Touching { contact }
            | Outcome::Overlapping {
                overlap: Overlap::Pieces(contact),
                ..
            } => *contact = map(*contact, 0.0),
            Outcome::Unresolved(known) => {
                let nearest = known.nearest_contact;
                known.nearest_contact = nearest.map(|(time, contact)| (time, map(contact, time)));
                *known = known.with_measured_upper_bound();
            }
            // The contacts of an interval are those of two first contacts, which have already been mapped.
            Outcome::Free { .. } | Outcome::Overlapping { .. } | Outcome::Interval { .. } => {}
        }
        self
    }

    /// Converts an outcome about enclosing bodies to an outcome about the enclosed shapes.
    fn widened_by_excess(self, excess: ExcessSum) -> Self {
        let mut outcome = self.map_contacts(|contact, _| contact.widened_by_excess(excess));
        if let Outcome::Overlapping { upper, .. } = &mut outcome {
            *upper = excess.shape_distance_bound_at_overlap();
        }
        outcome
    }
}

impl Stats {
    /// Returns the work that the [budget](crate::Settings::budget) limits: iterations, plus one for every
    /// `EVALUATIONS_WORTH_A_VISIT` evaluations of points.
    #[inline]
    pub fn budgeted_work(&self) -> u64 {
        self.iterations + self.point_evaluations / EVALUATIONS_WORTH_A_VISIT
    }

    /// Adds the counters of another query; the peak of the front is the larger one of both.
    pub(crate) fn add(&mut self, other: &Stats) {
        self.iterations += other.iterations;
        self.point_evaluations += other.point_evaluations;
        self.oracle_calls += other.oracle_calls;
        self.give_ups += other.give_ups;
        self.peak_front = self.peak_front.max(other.peak_front);
        self.advancements += other.advancements;
        self.oracle_effort = self.oracle_effort + other.oracle_effort;
    }
}
