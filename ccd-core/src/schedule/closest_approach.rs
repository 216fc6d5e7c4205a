//! How close do two bodies come, and when?

mod follow;
mod guess;
mod nearing;

use super::answer::{contact_of_given, metered};
use super::depth_first::DepthFirst;
use super::meter::Meter;
use super::nodes::closer_look::CloserLook;
use super::nodes::common::Common;
use super::proven::Proven;
use super::rounds::Sample;
use super::search::Search;
use super::start::at_start;
use crate::distance::oracle::DistanceOracle;
use crate::math::order::greater;
use crate::outcome::{Answer, Contact, Limit, Outcome, Overlap};
use crate::problem::Problem;
use guess::guess;
use nearing::Nearing;
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

    /// Returns true if the bodies come to no distance after the start.
    pub(super) fn meets_later(&self, tolerance: f64) -> bool {
        match *self {
            ClosestApproach::Nearest { time, contact, .. } => {
                time > 0.0 && contact.separation.upper <= tolerance
            }
            ClosestApproach::Overlapping { .. } | ClosestApproach::Unresolved { .. } => false,
        }
    }

    /// The width of the bracket; 0 if there is none.
    pub(super) fn width(&self) -> f64 {
        match self {
            ClosestApproach::Nearest { .. } => self.upper() - self.lower(),
            ClosestApproach::Overlapping { .. } | ClosestApproach::Unresolved { .. } => 0.0,
        }
    }

    /// Compares the least distance to one that is required.
    ///
    /// Bodies that may touch keep no clearance, not even one of 0.
    pub fn clearance(&self, required: f64) -> Clearance {
        let (lower, upper) = (self.lower(), self.upper());
        if lower >= required && lower > 0.0 {
            Clearance::Kept
        } else if upper < required || upper <= 0.0 {
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
        let answer = self.measured(problem, f64::INFINITY, oracle, or_overlap);
        answer.map(|found| found.unwrap_or_else(|Beyond { .. }| unresolved(Limit::OracleGaveUp)))
    }

    /// Like [`DepthFirst::closest_approach`], if the bodies come nearer than `beyond`; where they meet, it does
    /// not tell whether they overlap at the start.
    pub(super) fn approach_below(
        &mut self,
        problem: &Problem<'_>,
        beyond: f64,
        oracle: &mut O,
    ) -> Answer<Result<ClosestApproach, Beyond>> {
        self.measured(problem, beyond, oracle, |_, _, _, found| found)
    }

    /// Searches for distances below `beyond`, and takes a last look at what it finds.
    fn measured(
        &mut self,
        problem: &Problem<'_>,
        beyond: f64,
        oracle: &mut O,
        last_look: impl FnOnce(&Problem<'_>, &mut O, &mut Meter, ClosestApproach) -> ClosestApproach,
    ) -> Answer<Result<ClosestApproach, Beyond>> {
        let mut kept = self.kept.take();
        let answer = metered(problem, oracle, &mut kept, |oracle, meter| {
            let problem = problem.measuring();
            let found = match Sample::of(&problem) {
                Some(sample) => {
                    let found = self.approach(&sample.part, beyond, oracle, meter);
                    at_all_times(&sample, found)
                }
                None => self.approach(&problem, beyond, oracle, meter),
            };
            let told = found.map(|found| {
                let found = last_look(&problem, oracle, meter, found);
                told(&problem, oracle, meter, found)
            });
            let width = told.as_ref().map_or(0.0, ClosestApproach::width);
            // Distances may not be known to the tolerance that is requested.
            (told, greater(problem.tolerance, width))
        });
        self.kept = kept;
        answer
    }

    fn approach(
        &mut self,
        problem: &Problem<'_>,
        beyond: f64,
        oracle: &mut O,
        meter: &mut Meter,
    ) -> Result<ClosestApproach, Beyond> {
        self.stack.clear();
        let found = self.search(problem, beyond, oracle, meter);
        let stats = &mut meter.stats;
        stats.peak_front = stats.peak_front.max(self.stack.peak());
        self.stack.clear();
        found
    }

    fn search(
        &mut self,
        problem: &Problem<'_>,
        beyond: f64,
        oracle: &mut O,
        meter: &mut Meter,
    ) -> Result<ClosestApproach, Beyond> {
        if !problem.a.path.moves() && !problem.b.path.moves() {
            return at_one_pose(problem, beyond, oracle, meter);
        }
        let best = match guess(problem, beyond, oracle, meter) {
            ControlFlow::Continue(best) => best,
            ControlFlow::Break(found) => return Ok(found),
        };
        let mut nearing = Nearing {
            best,
            beyond,
            proven: Proven::default(),
            stuck: None,
        };
        let mut search = Search {
            waiting: &mut self.stack,
            oracle,
            meter,
        };
        if search.open(problem).is_err() {
            return Ok(nearing.unresolved(problem, Limit::Budget));
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

/// Returns what is found in a period that stands for the whole time as an answer for all of it.
fn at_all_times(
    sample: &Sample<'_>,
    found: Result<ClosestApproach, Beyond>,
) -> Result<ClosestApproach, Beyond> {
    let contact = |contact| sample.contact(contact);
    match found {
        Ok(ClosestApproach::Nearest {
            lower,
            time,
            contact: nearest,
        }) => Ok(ClosestApproach::Nearest {
            lower: sample.lower(lower),
            time,
            contact: contact(nearest),
        }),
        Ok(ClosestApproach::Unresolved { nearest, reason }) => Ok(ClosestApproach::Unresolved {
            nearest: nearest.map(|(time, nearest)| (time, contact(nearest))),
            reason,
        }),
        Ok(overlapping @ ClosestApproach::Overlapping { .. }) => Ok(overlapping),
        Err(Beyond { lower }) => Err(Beyond {
            lower: sample.lower(lower),
        }),
    }
}

/// Returns the answer for bodies that meet, unless they overlap at the start as well.
fn or_overlap<O: DistanceOracle>(
    problem: &Problem<'_>,
    oracle: &mut O,
    meter: &mut Meter,
    found: ClosestApproach,
) -> ClosestApproach {
    if !found.meets_later(problem.tolerance) {
        return found;
    }
    match at_start(problem, f64::MIN_POSITIVE, oracle, meter) {
        Some(Outcome::Overlapping { overlap }) => ClosestApproach::Overlapping { overlap },
        _ => found,
    }
}

/// Measures bodies that do not move.
fn at_one_pose<O: DistanceOracle>(
    problem: &Problem<'_>,
    beyond: f64,
    oracle: &mut O,
    meter: &mut Meter,
) -> Result<ClosestApproach, Beyond> {
    Ok(match at_start(problem, beyond, oracle, meter) {
        Some(Outcome::Touching { contact }) => ClosestApproach::Nearest {
            lower: greater(0.0, contact.separation.lower),
            time: 0.0,
            contact,
        },
        Some(Outcome::Overlapping { overlap }) => ClosestApproach::Overlapping { overlap },
        Some(Outcome::Unresolved { reason, .. }) => unresolved(reason),
        _ => return Err(Beyond { lower: beyond }),
    })
}

/// The bodies are at least as far apart as is of interest.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Beyond {
    /// A lower bound of the distance at all times.
    pub(super) lower: f64,
}

fn unresolved(reason: Limit) -> ClosestApproach {
    ClosestApproach::Unresolved {
        nearest: None,
        reason,
    }
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
    /// The pieces, as the problem numbers them.
    pieces: [u32; 2],
    contact: Contact,
}

#[cfg(test)]
mod tests;
