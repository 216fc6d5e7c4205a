//! The search: climbs from random attempts toward a failure, and shrinks what it finds.

use super::aim::{Aim, FAILURE};
use super::attempt::Attempt;
use super::examiner::{Examined, Examiner, scene};
use super::shrink::shrink;
use super::space::{draw, neighbour};
use crate::method::Method;
use crate::method::guarded::Programs;
use ccd_core::order::{greater, lesser};
use ccd_decomp::TriangleMesh;
use rand::SeedableRng;
use rand_pcg::Pcg64;
use rigid_ccd::command::Progress;
use rigid_ccd::table::motions::Query;
use std::collections::BTreeMap;
use std::io;
use std::time::Duration;

/// A search for one kind of failure of one method.
#[derive(Clone, Copy, Debug)]
pub struct Hunt {
    /// The method.
    pub method: Method,
    /// The kind of failure.
    pub aim: Aim,
    /// The attempts, besides those that shrink a failure.
    pub tries: usize,
    /// The failures that are shrunk; the smallest is kept.
    pub finds: usize,
    /// The seed of the draws.
    pub seed: u64,
    /// The time for a query.
    pub patience: Duration,
}

/// What a search found.
#[derive(Clone, Debug)]
pub struct Report {
    /// The search.
    pub hunt: Hunt,
    /// The answers that were judged, by verdict.
    pub verdicts: BTreeMap<String, usize>,
    /// The attempts that were not judged: invalid, refused, or without a known answer.
    pub skipped: usize,
    /// The score that came nearest to a failure.
    pub nearest: f64,
    /// The smallest failure.
    pub smallest: Option<Failure>,
}

/// A failure.
#[derive(Clone, Debug)]
pub struct Failure {
    /// The bodies and their motions.
    pub attempt: Attempt,
    /// The answer, and the exact one.
    pub(super) examined: Examined,
    /// The query, along the motion that the method takes.
    pub(super) query: Query,
    pub(super) meshes: [TriangleMesh; 2],
}

/// The neighbours in a row that are no better before the search starts anew.
const STUCK: usize = 40;

/// The attempts to shrink a failure, and one that takes all its time at each attempt.
const SHRINKING: usize = 4_000;
const SHRINKING_STUCK: usize = 200;

/// A smaller failure is at least that bad, or as bad as the one that it is made of: late by a tenth of the
/// duration, early by a tenth of the tolerance.
const STILL_BAD: f64 = 0.1;

impl Hunt {
    /// Searches.
    ///
    /// # Errors
    /// If the method's process cannot be started.
    pub fn run(self, programs: &Programs, progress: &Progress) -> io::Result<Report> {
        let mut examiner = Examiner::new(programs.clone(), self.method, self.patience);
        let mut rng = Pcg64::seed_from_u64(self.seed);
        let mut report = Report {
            hunt: self,
            verdicts: BTreeMap::new(),
            skipped: 0,
            nearest: f64::NEG_INFINITY,
            smallest: None,
        };
        let mut finds = 0;
        let mut left = self.tries;
        while left > 0 && finds < self.finds {
            let Ok(mut best) = draw(&mut rng) else {
                left -= 1;
                continue;
            };
            let (mut score, mut rejected) = (f64::NEG_INFINITY, 0);
            let mut worst = None;
            let mut next = best.clone();
            // A failure is made worse, too.
            while left > 0 && rejected < STUCK && score < f64::INFINITY {
                left -= 1;
                progress.step();
                rejected += 1;
                let examined = examiner.examine(&next)?;
                report.count(examined.as_ref());
                if let Some(examined) = examined {
                    let met = self.aim.score(&examined);
                    report.nearest = greater(report.nearest, met);
                    let is_better = met > score;
                    if met >= score {
                        (best, score) = (next, met);
                    }
                    if is_better {
                        rejected = 0;
                        if self.is_failure(&mut examiner, &best, &examined)? {
                            worst = Some((best.clone(), examined));
                        }
                    }
                }
                next = neighbour(&mut rng, &best);
            }
            if let Some((attempt, examined)) = worst {
                finds += 1;
                report.keep(self.smaller(&mut examiner, attempt, examined)?);
            }
        }
        Ok(report)
    }

    /// Returns true for a failure. One that took too long is asked again: the machine may have been busy.
    fn is_failure(
        self,
        examiner: &mut Examiner,
        attempt: &Attempt,
        examined: &Examined,
    ) -> io::Result<bool> {
        let is_met = |examined: &Examined| self.aim.is_met(examined);
        if self.aim != Aim::Stuck || !is_met(examined) {
            return Ok(is_met(examined));
        }
        Ok(examiner.examine(attempt)?.as_ref().is_some_and(is_met))
    }

    /// Returns the failure as small as it gets.
    fn smaller(
        self,
        examiner: &mut Examiner,
        attempt: Attempt,
        examined: Examined,
    ) -> io::Result<Failure> {
        let least = FAILURE + lesser(STILL_BAD, self.aim.score(&examined) - FAILURE);
        let mut smallest = examined;
        let most = match self.aim {
            Aim::Late | Aim::Early => SHRINKING,
            Aim::Stuck => SHRINKING_STUCK,
        };
        let attempt = shrink(attempt, most, |smaller| {
            let Some(examined) = examiner.examine(smaller)? else {
                return Ok(false);
            };
            let fails = self.aim.is_met(&examined) && self.aim.score(&examined) >= least;
            if fails {
                smallest = examined;
            }
            Ok(fails)
        })?;
        let valid = || io::Error::other("a judged attempt is valid");
        let (meshes, query) = scene(self.method, &attempt).ok_or_else(valid)?;
        Ok(Failure {
            attempt,
            examined: smallest,
            query,
            meshes,
        })
    }
}

impl Report {
    fn count(&mut self, examined: Option<&Examined>) {
        match examined {
            Some(examined) => {
                let verdict = examined.judged.verdict.to_string();
                *self.verdicts.entry(verdict).or_default() += 1;
            }
            None => self.skipped += 1,
        }
    }

    /// Keeps a failure if it is the smallest.
    fn keep(&mut self, failure: Failure) {
        let size = |failure: &Failure| (failure.attempt.triangles(), failure.attempt.complexity());
        if self
            .smallest
            .as_ref()
            .is_none_or(|smallest| size(&failure) < size(smallest))
        {
            self.smallest = Some(failure);
        }
    }

    /// Returns the number of answers that were judged.
    pub fn judged(&self) -> usize {
        self.verdicts.values().sum()
    }
}
