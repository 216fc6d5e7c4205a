//! How close do two bodies come, and when?

mod follow;
mod guess;

use super::answer::{contact_of_given, metered};
use super::depth_first::DepthFirst;
use super::meter::Meter;
use super::nodes::closer_look::CloserLook;
use super::nodes::common::Common;
use super::pieces::pair::Step;
use super::proven::Proven;
use super::search::{Question, Search};
use super::start::at_start;
use crate::distance::oracle::DistanceOracle;
use crate::math::order::greater;
use crate::outcome::{Answer, Contact, Limit, Outcome, Overlap};
use crate::problem::Problem;
use follow::follow;
use guess::guess;
use std::ops::ControlFlow;

/// The answer to "how close do they come, and when?".
///
/// # Guarantee
/// The bodies are never nearer than [`lower`](ClosestApproach::lower), in floating point as well.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ClosestApproach {
    /// The bodies are nearest at about `time`: then they are at most the contact's upper bound apart,
    /// and at no time nearer than `lower`.
    Nearest {
        /// A lower bound of the distance at all times, within the tolerance of the contact's upper
        /// bound.
        lower: f64,
        /// The time, in the motions' unit.
        time: f64,
        /// The nearest pieces at that time.
        contact: Contact,
    },
    /// The bodies overlap at the start.
    Overlapping {
        /// The proof.
        overlap: Overlap,
    },
    /// A limit was reached before an answer.
    Unresolved {
        /// The least distance that was seen: its time, and the nearest pieces then. None if a limit
        /// was reached before any was measured.
        nearest: Option<(f64, Contact)>,
        /// The limit.
        reason: Limit,
    },
}

impl ClosestApproach {
    /// A lower bound of the distance at all times; 0 if none is known.
    pub fn lower(&self) -> f64 {
        match *self {
            ClosestApproach::Nearest { lower, .. } => lower,
            ClosestApproach::Overlapping { .. } | ClosestApproach::Unresolved { .. } => 0.0,
        }
    }

    /// An upper bound of the least distance; infinite if none is known.
    pub fn upper(&self) -> f64 {
        match self {
            ClosestApproach::Nearest { contact, .. } => contact.separation.upper,
            ClosestApproach::Overlapping { .. } => 0.0,
            ClosestApproach::Unresolved { nearest, .. } => {
                nearest.map_or(f64::INFINITY, |(_, contact)| contact.separation.upper)
            }
        }
    }

    /// Compares the least distance to one that is required.
    pub fn clearance(&self, required: f64) -> Clearance {
        if self.lower() >= required {
            Clearance::Kept
        } else if self.upper() < required {
            Clearance::Violated
        } else {
            Clearance::Unverified
        }
    }
}

/// The comparison of the least distance of two bodies to one that is required.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Clearance {
    /// The bodies are never nearer, certainly.
    Kept,
    /// The bodies are nearer at some time, certainly.
    Violated,
    /// The least distance is not known well enough.
    Unverified,
}

impl<O: DistanceOracle> DepthFirst<O> {
    /// Brackets the least distance of the bodies over the duration, to within the tolerance.
    ///
    /// The margin and the [policy](crate::StartPolicy) for the start play no role.
    ///
    /// # Guarantee
    /// That of [`ClosestApproach`]; ends on every input; the same call gives the same bits, unless a
    /// [deadline](crate::Config::deadline) ends it.
    pub fn closest_approach(
        &mut self,
        problem: &Problem<'_>,
        oracle: &mut O,
    ) -> Answer<ClosestApproach> {
        let mut kept = self.kept.take();
        let answer = metered(problem, oracle, &mut kept, |oracle, meter| {
            self.stack.clear();
            let problem = problem.measuring();
            let found = self.approach(&problem, oracle, meter);
            meter.stats.peak_front = self.stack.peak();
            let told = told(&problem, oracle, meter, found);
            (told, tolerance(&problem, &told))
        });
        self.stack.clear();
        self.kept = kept;
        answer
    }

    fn approach(
        &mut self,
        problem: &Problem<'_>,
        oracle: &mut O,
        meter: &mut Meter,
    ) -> ClosestApproach {
        if !problem.a.path.moves() && !problem.b.path.moves() {
            return at_one_pose(problem, oracle, meter);
        }
        let best = match guess(problem, oracle, meter) {
            ControlFlow::Continue(best) => best,
            ControlFlow::Break(found) => return found,
        };
        let mut nearing = Nearing {
            best,
            proven: Proven::default(),
            stuck: None,
        };
        let mut search = Search {
            waiting: &mut self.stack,
            oracle,
            meter,
        };
        if search.open(problem).is_err() {
            return nearing.unresolved(problem, Limit::Budget);
        }
        // Pairs that keep apart by more than the least distance do so by more than a lesser one.
        loop {
            let upper = nearing.upper();
            let below = problem.below(upper);
            // Written so that NaN is the end.
            if !(upper > problem.tolerance && upper > below.contact_distance()) {
                return nearing.found(problem, 0.0);
            }
            let common = Common::new(&below);
            let mut look = CloserLook::new(&below);
            while nearing.upper() == upper {
                if let ControlFlow::Break(found) = search.visit(&common, &mut look, &mut nearing) {
                    return found;
                }
            }
        }
    }
}

/// Measures bodies that do not move.
fn at_one_pose<O: DistanceOracle>(
    problem: &Problem<'_>,
    oracle: &mut O,
    meter: &mut Meter,
) -> ClosestApproach {
    let nearest = None;
    match at_start(problem, f64::INFINITY, oracle, meter) {
        Some(Outcome::Touching { contact }) => ClosestApproach::Nearest {
            lower: greater(0.0, contact.separation.lower),
            time: 0.0,
            contact,
        },
        Some(Outcome::Overlapping { overlap }) => ClosestApproach::Overlapping { overlap },
        Some(Outcome::Unresolved { reason, .. }) => ClosestApproach::Unresolved { nearest, reason },
        // Every distance is NaN: an oracle without an answer.
        _ => ClosestApproach::Unresolved {
            nearest,
            reason: Limit::OracleGaveUp,
        },
    }
}

/// Returns the tolerance that an answer keeps: the requested one, unless distances are not known that
/// well.
fn tolerance(problem: &Problem<'_>, found: &ClosestApproach) -> f64 {
    let width = match found {
        ClosestApproach::Nearest { lower, contact, .. } => contact.separation.upper - lower,
        _ => 0.0,
    };
    greater(problem.tolerance, width)
}

/// Returns the answer for the given bodies, if surfaces replaced them.
fn told<O: DistanceOracle>(
    problem: &Problem<'_>,
    oracle: &mut O,
    meter: &mut Meter,
    found: ClosestApproach,
) -> ClosestApproach {
    let mut told = |contact: Contact, time| {
        let within = contact.separation.upper;
        contact_of_given(problem, oracle, meter, contact, within, time)
    };
    match found {
        ClosestApproach::Nearest {
            lower,
            time,
            contact,
        } => ClosestApproach::Nearest {
            lower,
            time,
            contact: told(contact, time),
        },
        ClosestApproach::Overlapping {
            overlap: Overlap::Pieces(contact),
        } => ClosestApproach::Overlapping {
            overlap: Overlap::Pieces(told(contact, 0.0)),
        },
        ClosestApproach::Unresolved { nearest, reason } => ClosestApproach::Unresolved {
            nearest: nearest.map(|(time, contact)| (time, told(contact, time))),
            reason,
        },
        ClosestApproach::Overlapping { .. } => found,
    }
}

/// Two pieces at the clock at which they are the nearest so far.
#[derive(Clone, Copy, Debug)]
struct Best {
    clock: f64,
    contact: Contact,
}

/// How close do they come? Pairs are proven to keep the least distance found so far.
struct Nearing {
    best: Best,
    proven: Proven,
    /// The reason why some pair could not be proven to the end.
    stuck: Option<Limit>,
}

impl Nearing {
    fn upper(&self) -> f64 {
        self.best.contact.separation.upper
    }

    fn found(&self, problem: &Problem<'_>, lower: f64) -> ClosestApproach {
        ClosestApproach::Nearest {
            lower,
            time: problem.time(self.best.clock),
            contact: self.best.contact.no_nearer_than(lower),
        }
    }

    fn unresolved(&self, problem: &Problem<'_>, reason: Limit) -> ClosestApproach {
        ClosestApproach::Unresolved {
            nearest: Some((
                problem.time(self.best.clock),
                self.best.contact.no_nearer_than(0.0),
            )),
            reason,
        }
    }
}

impl<O: DistanceOracle> Question<O> for Nearing {
    type Found = ClosestApproach;

    fn arrive(&mut self, _: &Problem<'_>, _: f64) -> ControlFlow<ClosestApproach> {
        ControlFlow::Continue(())
    }

    #[inline]
    fn keep(&mut self, gap: f64) {
        self.proven.keep(gap);
    }

    fn conclude(
        &mut self,
        problem: &Problem<'_>,
        oracle: &mut O,
        meter: &mut Meter,
        step: Step,
        s: f64,
    ) -> ControlFlow<ClosestApproach, f64> {
        match step {
            Step::FreeUntil(clock) => ControlFlow::Continue(clock),
            Step::Contact(contact) => {
                let seen = Best { clock: s, contact };
                self.best = follow(problem, oracle, meter, seen);
                // The pair is looked at again: it keeps a lesser distance.
                ControlFlow::Continue(s)
            }
            Step::Overlap(contact) => ControlFlow::Break(ClosestApproach::Overlapping {
                overlap: Overlap::Pieces(contact),
            }),
            Step::Stalled => {
                self.stuck = Some(Limit::Stalled);
                ControlFlow::Continue(f64::INFINITY)
            }
            Step::GaveUp => {
                self.stuck = Some(Limit::OracleGaveUp);
                ControlFlow::Continue(f64::INFINITY)
            }
        }
    }

    fn stopped(&mut self, problem: &Problem<'_>, _: f64, limit: Limit) -> ClosestApproach {
        self.unresolved(problem, limit)
    }

    fn done(&mut self, problem: &Problem<'_>) -> ClosestApproach {
        if let Some(limit) = self.stuck {
            return self.unresolved(problem, limit);
        }
        match self.proven.end(problem) {
            Outcome::Overlapping { overlap } => ClosestApproach::Overlapping { overlap },
            Outcome::Free { proven_gap } => self.found(problem, proven_gap),
            Outcome::Unresolved { reason, .. } => self.unresolved(problem, reason),
            Outcome::Contact { .. } | Outcome::Touching { .. } => {
                unreachable!("pairs that waited are in no contact")
            }
        }
    }
}

#[cfg(test)]
mod tests;
