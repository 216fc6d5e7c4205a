//! Searches one period of the motions instead of all periods, for bodies that turn many times. A *round* is a number of
//! periods that are searched together.
//!
//! The distances in each period of a round differ from those in the first by at most a known
//! change, see `motion/period.rs`. Bodies that keep that change beyond the margin in the first period keep the margin
//! in all of them. If they come nearer, but are not in contact, the next round has fewer periods. If even two periods
//! differ by too much, some are searched in full, ever more of them in a row. The work therefore depends on how much
//! the distances change, and not on the number of turns.

use crate::answer::{Contact, Limit, Outcome, Separation};
use crate::engine::meter::Meter;
use crate::engine::shortcuts::bounding_volumes::free_outcome_by_bounding_volumes;
use crate::math::order::{greater, lesser};
use crate::math::vector::length;
use crate::motion::period::{PathWithRadius, Period};
use crate::problem::{BodyWithPath, Problem};
use crate::rounding::{TURN_COUNT_WIDENING, least_tolerance, position_rounding};
use crate::settings::{Shortcut, StartPolicy};
use crate::tuning::{
    MAX_PERIOD_DISTANCE_CHANGE_SHARE, MAX_SCREW_DRIFT, MAX_SEARCHED_DURATION_SHARE,
};
use std::ops::ControlFlow;

/// The progress of a search over the periods of a problem, the *whole* problem: the time until which the bodies are
/// proven apart, and the periods that are searched next.
#[derive(Debug)]
pub(crate) struct PeriodicSearch {
    period: Period,
    /// The error of distances in a single period, in addition to the error of distances in the whole problem.
    rounding: f64,
    /// The clock until which the bodies are proven apart.
    proven_until: f64,
    round: PeriodBatch,
    /// The number of periods of the next round that is searched in full, because its periods differ too much.
    full_round_period_count: f64,
    /// A lower bound of the distance of the bodies up to the clock `from`.
    proven_gap: f64,
}

/// The number of periods of a round, and the way they are searched.
#[derive(Clone, Copy, Debug)]
enum PeriodBatch {
    /// Only the first of this number of periods is searched; it represents the others.
    FirstPeriod(f64),
    /// All of this number of periods are searched.
    AllPeriods(f64),
}

impl PeriodicSearch {
    /// Creates the rounds of a problem; `None` if the motions are not periodic, or the periods are too long to save
    /// work.
    #[inline]
    pub(crate) fn for_problem(problem: &Problem<'_>) -> Option<Self> {
        if problem.turns_at_least_twice() && free_outcome_by_bounding_volumes(problem).is_none() {
            PeriodicSearch::for_many_turns(problem)
        } else {
            None
        }
    }

    #[cold]
    fn for_many_turns(problem: &Problem<'_>) -> Option<Self> {
        if !problem.uses_shortcut(Shortcut::Rounds) {
            return None;
        }
        // Bodies that rest on each other are let go pair by pair, from the start on.
        if problem.start_policy == StartPolicy::Leave {
            return None;
        }
        let tolerance = problem.tolerance;
        let bodies = [&problem.a, &problem.b].map(path_with_radius);
        let [a, b] = bodies.map(|PathWithRadius { path, reach }| {
            let way = length(path.center_at(0.0)) + path.speed_bound();
            position_rounding(reach, path.angular_speed, way)
        });
        let rounding = a + b;
        let known = MAX_PERIOD_DISTANCE_CHANGE_SHARE * tolerance;
        // Written so that NaN is too much.
        if !(rounding + least_tolerance(problem.rounding) <= 0.5 * known) {
            return None;
        }
        let [a, b] = [&problem.a, &problem.b].map(|side| f64::from(side.body.tree().radius()));
        let size = lesser(a, b);
        let period = period_with_least_work(bodies, known)
            .or_else(|| period_with_least_work(bodies, MAX_SCREW_DRIFT * size))?;
        let mut rounds = PeriodicSearch {
            period,
            rounding,
            proven_until: 0.0,
            round: PeriodBatch::AllPeriods(1.0),
            full_round_period_count: 1.0,
            proven_gap: f64::INFINITY,
        };
        rounds.begin_round(f64::INFINITY);
        Some(rounds)
    }

    /// Returns the problem to search in the present round: its first period or all periods, with a raised margin.
    #[cold]
    pub(crate) fn problem_of_round<'a>(&self, whole: &Problem<'a>) -> Problem<'a> {
        let tolerance = whole.tolerance;
        // Both tolerances have the same middle: the gap that is proven. On either side of it, twice the difference of
        // distances is lost.
        let room = (tolerance - 2.0 * self.max_distance_drift()) - 4.0 * self.rounding;
        let left = greater(room, MAX_PERIOD_DISTANCE_CHANGE_SHARE * tolerance);
        let to = match self.round {
            PeriodBatch::FirstPeriod(_) => {
                lesser(1.0, self.proven_until + self.period.length_rounded_up())
            }
            PeriodBatch::AllPeriods(_) => self.round_end_clock(),
        };
        whole.between_clocks(
            [self.proven_until, to],
            self.margin_increase() + 0.5 * (tolerance - left),
            left,
        )
    }

    /// Processes the outcome of a round: starts the next round, or breaks with the outcome of the whole problem.
    pub(crate) fn start_next_round_or_finish(
        &mut self,
        whole: &Problem<'_>,
        outcome: &Outcome,
        meter: &mut Meter,
    ) -> ControlFlow<Outcome> {
        let unresolved = |rounds: &Self, reason| {
            Outcome::unresolved(whole.time_of_clock(rounds.proven_until), reason)
        };
        match *outcome {
            Outcome::Free { proven_gap } => self.record_gap(whole, proven_gap)?,
            Outcome::Contact { time, contact } => {
                self.confirm_contact_or_shorten_round(whole, time, contact)?;
            }
            Outcome::Touching { contact } => {
                let time = whole.time_of_clock(self.proven_until);
                self.confirm_contact_or_shorten_round(whole, time, contact)?;
            }
            Outcome::Unresolved(_) => return ControlFlow::Break(*outcome),
            Outcome::Interval { .. } | Outcome::LeastDistance { .. } => {
                unreachable!("no outcome of a search for contacts")
            }
            Outcome::Overlapping { .. } if self.proven_until == 0.0 => {
                return ControlFlow::Break(*outcome);
            }
            // The bodies were proven apart until then, so an oracle contradicts itself.
            Outcome::Overlapping { .. } => {
                return ControlFlow::Break(unresolved(self, Limit::OverlapUndecided));
            }
        }
        // A round counts as a visit, even if bounding balls prove the bodies apart at once.
        match meter.count_visit_and_check_limits(whole) {
            Ok(()) => ControlFlow::Continue(()),
            Err(limit) => ControlFlow::Break(unresolved(self, limit)),
        }
    }

    /// Records that the bodies keep a gap in the present round, and starts the next round or ends the search.
    fn record_gap(&mut self, whole: &Problem<'_>, gap: f64) -> ControlFlow<Outcome> {
        self.proven_gap = lesser(self.proven_gap, (gap - self.margin_increase()).next_down());
        self.proven_until = self.round_end_clock();
        if self.proven_until >= 1.0 {
            let proven_gap = greater(self.proven_gap, whole.margin);
            return ControlFlow::Break(Outcome::Free { proven_gap });
        }
        match self.round {
            PeriodBatch::FirstPeriod(count) => {
                self.full_round_period_count = 1.0;
                self.begin_round(2.0 * count);
            }
            PeriodBatch::AllPeriods(count) => {
                self.full_round_period_count = 2.0 * count;
                self.begin_round(2.0);
            }
        }
        ControlFlow::Continue(())
    }

    /// Processes a contact in the present round: returns it if the bodies are in contact, or else shortens the round.
    fn confirm_contact_or_shorten_round(
        &mut self,
        whole: &Problem<'_>,
        time: f64,
        contact: Contact,
    ) -> ControlFlow<Outcome> {
        let within = whole.contact_distance();
        let contact = widen_distance_bounds(contact, self.rounding);
        let Separation { upper, .. } = contact.separation;
        match self.round {
            PeriodBatch::FirstPeriod(count) if !(upper <= within) => {
                // More periods than this would give the same contact.
                let fewer = (upper - within) / self.period.max_distance_change;
                match lesser(0.5 * count, fewer).floor() {
                    fewer if fewer >= 2.0 => self.begin_round(fewer),
                    _ => self.round = PeriodBatch::AllPeriods(self.full_round_period_count),
                }
                ControlFlow::Continue(())
            }
            _ => ControlFlow::Break(Outcome::from_contact(time, contact)),
        }
    }

    /// Starts a round of `count` periods, or of the remaining periods if fewer are left.
    fn begin_round(&mut self, count: f64) {
        let left = ((1.0 - self.proven_until) / self.period.length).ceil();
        self.round = match lesser(count, left) {
            count if count >= 2.0 => PeriodBatch::FirstPeriod(count),
            _ => PeriodBatch::AllPeriods(self.full_round_period_count),
        };
    }

    /// Returns the clock at which the round ends.
    fn round_end_clock(&self) -> f64 {
        let (PeriodBatch::FirstPeriod(count) | PeriodBatch::AllPeriods(count)) = self.round;
        let end = self.proven_until + count * self.period.length;
        // A rest of the time that is only rounding is covered, too.
        if end + 0.5 * TURN_COUNT_WIDENING * self.period.length < 1.0 {
            end
        } else {
            1.0
        }
    }

    /// Returns a bound of the difference between distances in the searched part of the round and at the same phase of
    /// its other periods.
    fn max_distance_drift(&self) -> f64 {
        match self.round {
            PeriodBatch::FirstPeriod(count) => count * self.period.max_distance_change,
            PeriodBatch::AllPeriods(_) => 0.0,
        }
    }

    /// Returns the distance that the bodies have to keep beyond the margin in the searched part of the round.
    fn margin_increase(&self) -> f64 {
        self.max_distance_drift() + self.rounding
    }
}

/// One period that represents the whole duration, for queries for the closest approach.
#[derive(Debug)]
pub(crate) struct RepresentativePeriod<'a> {
    /// The problem restricted to this period, with a tolerance that leaves room for `max_distance_change` and
    /// `rounding`.
    pub(crate) period_subproblem: Problem<'a>,
    /// An upper bound of how much the bodies' distance differs between this period and the same moment of any other.
    pub(crate) max_distance_change: f64,
    /// The rounding of distances that comes on top of the problem's own `rounding`, because one period stands for all.
    pub(crate) rounding: f64,
}

impl<'a> RepresentativePeriod<'a> {
    /// Returns the first period if its distances differ from those in all other periods by at most a part of the
    /// tolerance; `None` otherwise.
    #[inline]
    pub(crate) fn for_problem(problem: &Problem<'a>) -> Option<Self> {
        if problem.turns_at_least_twice() {
            RepresentativePeriod::for_many_turns(problem)
        } else {
            None
        }
    }

    #[cold]
    fn for_many_turns(problem: &Problem<'a>) -> Option<Self> {
        let rounds = PeriodicSearch::for_many_turns(problem)?;
        let (change, rounding) = (rounds.max_distance_drift(), rounds.rounding);
        // Written so that NaN is too much.
        let stands_for_all =
            matches!(rounds.round, PeriodBatch::FirstPeriod(_)) && rounds.round_end_clock() >= 1.0;
        (stands_for_all && change <= MAX_PERIOD_DISTANCE_CHANGE_SHARE * problem.tolerance).then(
            || RepresentativePeriod {
                period_subproblem: rounds.problem_of_round(problem).for_distances(),
                max_distance_change: change,
                rounding,
            },
        )
    }

    /// Converts a lower bound of the distance in this period to a lower bound for the whole duration.
    pub(crate) fn whole_duration_lower_bound(&self, distance: f64) -> f64 {
        greater(
            0.0,
            (distance - (self.max_distance_change + self.rounding)).next_down(),
        )
    }

    /// Widens the bounds of a contact in the period so that they hold for the whole problem.
    pub(crate) fn widen_distance_bounds(&self, contact: Contact) -> Contact {
        widen_distance_bounds(contact, self.rounding)
    }
}

/// Widens the bounds of a contact's distance by `rounding` on either side.
fn widen_distance_bounds(contact: Contact, rounding: f64) -> Contact {
    let Separation { lower, upper, .. } = contact.separation;
    contact.with_bounds((lower - rounding).next_down(), (upper + rounding).next_up())
}

fn path_with_radius<'p>(side: &'p BodyWithPath<'_>) -> PathWithRadius<'p> {
    PathWithRadius {
        path: &side.path,
        reach: side.body.tree().max_distance_from(side.path.center),
    }
}

/// Returns the period with the least total time to search, if each round lasts until distances have changed by
/// `change`; `None` if no period saves enough time.
fn period_with_least_work(bodies: [PathWithRadius<'_>; 2], change: f64) -> Option<Period> {
    let searched = |period: &Period| {
        let rounds = greater(1.0, period.max_distance_change / (period.length * change));
        lesser(1.0, period.length * rounds)
    };
    Period::periods_up_to_half_duration(bodies)
        .map(|period| (searched(&period), period))
        .reduce(|best, next| if next.0 < best.0 { next } else { best })
        .filter(|(searched, _)| *searched <= MAX_SEARCHED_DURATION_SHARE)
        .map(|(_, period)| period)
}

#[cfg(test)]
mod tests;
