//! Measures the distance of bodies that touch at the start: nearest pairs first.

mod containment;

use super::memory::empty;
use super::meter::Meter;
use super::nodes::common::Common;
use super::nodes::expand::measure;
use super::nodes::siblings::{Next, Siblings};
use super::pieces::pair::contact;
use super::pieces::snapshot::Snapshot;
use super::queue::{Full, Queue, Rank};
use crate::distance::oracle::DistanceOracle;
use crate::distance::overlap::{self, Intersection};
use crate::math::order::lesser;
use crate::outcome::{Contact, Limit, Outcome, Overlap};
use crate::problem::Problem;
use crate::tolerance::NEAREST_SHARE;
use containment::Containment;
use std::ops::ControlFlow;

/// Returns the answer for bodies with two pieces seen in contact at the start: the distance of the
/// bodies, or that they overlap.
///
/// # Guarantee
/// Touching bodies are at least the contact's lower bound apart, and its pieces show the upper one.
/// If the oracle is honest, the answer does not depend on which pieces were `seen`.
///
/// # Complexity
/// One distance of the bodies, for any margin, and a look at every pair of pieces that may
/// intersect.
pub(super) fn touching<O: DistanceOracle>(
    problem: &Problem<'_>,
    oracle: &mut O,
    meter: &mut Meter,
    seen: Contact,
) -> Outcome {
    let mut lists = std::mem::take(&mut meter.memory().start);
    let mut search = Nearest {
        problem,
        common: Common::new(problem),
        lists: &mut lists,
        nearest: None,
        lower: f64::INFINITY,
        undecided: false,
    };
    let outcome = match search.run(oracle, meter) {
        ControlFlow::Break(outcome) => outcome,
        ControlFlow::Continue(()) if search.undecided => unresolved(Limit::Undecided),
        ControlFlow::Continue(()) => {
            let contact = search.contact(seen);
            let Lists {
                touching, pieces, ..
            } = &mut lists;
            contained(problem, touching, pieces).unwrap_or(Outcome::Touching { contact })
        }
    };
    lists.clear();
    meter.memory().start = lists;
    outcome
}

/// The lists of a search, which keep their memory.
#[derive(Debug, Default)]
pub(crate) struct Lists {
    /// Pairs of nodes, ordered by lower bounds of their distances.
    waiting: Queue<Siblings>,
    /// All pairs of pieces without a separating axis; none of them has a distance.
    touching: Vec<[u32; 2]>,
    /// For the search for one body inside the other.
    pieces: Vec<u32>,
}

impl Lists {
    fn clear(&mut self) {
        self.waiting.clear();
        empty(&mut self.touching);
        empty(&mut self.pieces);
    }
}

/// Splits the pair of nodes that may contain the nearest pieces, until no waiting pair can contain
/// any that are nearer than those found.
///
/// Pairs that may intersect have no lower bound of their distance, and therefore come before all
/// others.
struct Nearest<'p> {
    problem: &'p Problem<'p>,
    common: Common<'p>,
    lists: &'p mut Lists,
    /// The pieces of least upper bound.
    nearest: Option<Contact>,
    /// Bounds the distance of all pieces that were measured or given up.
    lower: f64,
    /// True if some pair could not be shown to intersect or not.
    undecided: bool,
}

impl Nearest<'_> {
    /// Finds the nearest pieces. Breaks with the answer when two overlap, or a limit is reached.
    fn run<O: DistanceOracle>(
        &mut self,
        oracle: &mut O,
        meter: &mut Meter,
    ) -> ControlFlow<Outcome> {
        let mut next = Some(Next::roots(self.problem));
        while let Some(pair) = next {
            if let Err(limit) = meter.visit() {
                return ControlFlow::Break(unresolved(limit));
            }
            match pair {
                Next::Split(split) => {
                    let expansion = measure(&self.common, &split);
                    self.wait(Siblings::new(&expansion, split, 0.0))?;
                }
                Next::Ask(a, b) => self.look([a, b], oracle, meter)?,
            }
            next = self.next();
        }
        ControlFlow::Continue(())
    }

    fn wait(&mut self, siblings: Siblings) -> ControlFlow<Outcome> {
        let distance = siblings.clock();
        if !(distance < self.upper()) {
            return ControlFlow::Continue(());
        }
        match self.lists.waiting.push(distance, Rank::Siblings, siblings) {
            Ok(()) => ControlFlow::Continue(()),
            Err(Full) => ControlFlow::Break(unresolved(Limit::Budget)),
        }
    }

    /// Returns the pair that may be the nearest; none when no pair can be nearer than the one
    /// found.
    fn next(&mut self) -> Option<Next> {
        let (upper, near_enough) = (self.upper(), self.near_enough());
        let (distance, siblings) = self.lists.waiting.least()?;
        // Pairs without a distance may intersect.
        if distance > 0.0 && distance >= near_enough {
            self.lower = lesser(self.lower, distance);
            return None;
        }
        let next = siblings.take_least(self.problem, distance);
        match siblings.clock() {
            distance if distance < upper => self.lists.waiting.postpone(distance),
            _ => self.lists.waiting.remove(),
        }
        Some(next)
    }

    /// Measures two pieces.
    fn look<O: DistanceOracle>(
        &mut self,
        ids: [u32; 2],
        oracle: &mut O,
        meter: &mut Meter,
    ) -> ControlFlow<Outcome> {
        let problem = self.problem;
        let snapshot = Snapshot::new(problem, ids[0], ids[1], 0.0);
        let Some(checked) = snapshot.ask(oracle, &mut O::Cache::default(), meter) else {
            return ControlFlow::Break(unresolved(Limit::OracleGaveUp));
        };
        let inner = &mut meter.memory().inner;
        match overlap::intersects(&snapshot.pieces, &checked, problem.rounding, inner) {
            Intersection::Certain => {
                return ControlFlow::Break(overlapping(contact(&snapshot, ids, &checked)));
            }
            Intersection::Undecided => self.undecided = true,
            Intersection::None => {}
        }
        // Written so that NaN is not apart.
        if !(checked.lower > 0.0) {
            self.lists.touching.push(ids);
        }
        self.lower = lesser(self.lower, checked.lower);
        if checked.upper < self.upper() {
            self.nearest = Some(contact(&snapshot, ids, &checked));
        }
        ControlFlow::Continue(())
    }

    /// Bounds the distance of the bodies from above.
    fn upper(&self) -> f64 {
        let upper = |contact: Contact| contact.separation.upper;
        self.nearest.map_or(f64::INFINITY, upper)
    }

    /// Pairs at least this far apart are not examined.
    fn near_enough(&self) -> f64 {
        let upper = self.upper();
        match upper <= self.problem.contact_distance() {
            true => upper * (1.0 - NEAREST_SHARE),
            false => upper,
        }
    }

    /// Returns the nearest pieces, with a lower bound that holds for all.
    fn contact(&self, seen: Contact) -> Contact {
        let nearest = self.nearest.unwrap_or(seen);
        // A later claim of an oracle may contradict an earlier one.
        let contact = match nearest.separation.upper <= self.problem.contact_distance() {
            true => nearest,
            false => seen,
        };
        contact.no_nearer_than(self.lower)
    }
}

/// Returns the answer if one body is inside the other, or if that is undecided. No two pieces
/// intersect; `touching` are those without a separating axis, and `pieces` is a list for use within.
pub(super) fn contained(
    problem: &Problem<'_>,
    touching: &[[u32; 2]],
    pieces: &mut Vec<u32>,
) -> Option<Outcome> {
    match containment::at_start(problem, touching, pieces) {
        Containment::Inside(overlap) => Some(Outcome::Overlapping { overlap }),
        Containment::Outside => None,
        Containment::Undecided => Some(Outcome::Unresolved {
            safe_until: 0.0,
            reason: Limit::Undecided,
        }),
    }
}

/// Returns the outcome for two pieces that overlap.
pub(super) fn overlapping(contact: Contact) -> Outcome {
    Outcome::Overlapping {
        overlap: Overlap::Pieces(contact),
    }
}

fn unresolved(reason: Limit) -> Outcome {
    Outcome::Unresolved {
        safe_until: 0.0,
        reason,
    }
}

#[cfg(test)]
mod tests;
