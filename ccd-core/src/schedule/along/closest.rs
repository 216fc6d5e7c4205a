//! The search for the closest approach along trajectories.

mod found;

use super::leg::Leg;
use super::stretches::Stretches;
use crate::answer::{Answer, Limit, Outcome};
use crate::distance::oracle::DistanceOracle;
use crate::error::InputError;
use crate::math::order::{greater, lesser};
use crate::query::Query;
use crate::schedule::DepthFirst;
use crate::schedule::closest_approach::ladder::Ladder;
use crate::schedule::closest_approach::required::Required;
use crate::schedule::closest_approach::{Beyond, meets_later};
use crate::tuning::{COARSE, STRAY_SHARE};
use found::{Found, Seen};
use std::time::Instant;

impl<O: DistanceOracle> DepthFirst<O> {
    /// Brackets the least distance of the bodies along their trajectories, or answers whether they keep a required
    /// clearance.
    pub(in crate::schedule) fn closest_approach_along(
        &mut self,
        query: &Query<'_>,
        oracle: &mut O,
    ) -> Result<Answer, InputError> {
        let answer = match query.terms.clearance {
            Some(distance) => self.keeps_along(query, distance, oracle)?,
            None => self.approach_of_bodies_along(&query.measuring(), oracle)?,
        };
        Ok(answer.of_shapes(query.excess()))
    }

    /// Brackets the least distance of the bodies themselves, whatever their shapes are.
    fn approach_of_bodies_along(
        &mut self,
        query: &Query<'_>,
        oracle: &mut O,
    ) -> Result<Answer, InputError> {
        let mut stretches = Stretches::new(query);
        let ladder = Ladder::new(0.0, query.terms.budget);
        let mut found = Found {
            lower: f64::INFINITY,
            best: None,
            ladder: if query.terms.deadline.is_some() || query.terms.stop.is_some() {
                ladder.timed()
            } else {
                ladder
            },
        };
        while let Some(span) = {
            self.climb_along(&mut found, &mut stretches, oracle)?;
            stretches.next()
        } {
            let (leg, terms) = match stretches.leg(span, true)? {
                Ok(leg) => leg,
                Err(reason) => return Ok(found.unresolved(query, &stretches, span, reason)),
            };
            if let Some(time) = stretches.looks_too_long(&leg)
                && let Some(doubt) = self.doubt(oracle, time, &mut found, &mut stretches)?
                && doubt.rises_into(&leg, time)
            {
                let length = doubt.length(&leg);
                if leg.is_worth_a_cut(length) && stretches.cut_about(leg.span, time, 2.0 * length) {
                    continue;
                }
            }
            let problem = leg.problem(query, &terms)?;
            // Distances of the motions beyond this are of no interest: the deviation and twice the tolerance are added
            // to the upper bound.
            let beyond = found.upper() + leg.stray + 2.0 * problem.tolerance();
            let answer = self.approach_below(&problem, beyond, oracle);
            stretches.add(&answer.stats);
            let seen = match answer.found {
                Err(Beyond { lower }) => Seen {
                    lower,
                    upper: lower,
                    // Bodies whose motions are farther apart than the least distance found so far are so despite
                    // their deviations.
                    blur: 0.0,
                    time: 0.0,
                    approach: 0.0,
                },
                Ok(Outcome::Overlapping { .. }) if stretches.look_at_start(&leg)? => {
                    continue;
                }
                Ok(outcome @ Outcome::Overlapping { .. }) if stretches.begins_at_start(&leg)? => {
                    return Ok(found.answer(query, &stretches, outcome));
                }
                Ok(outcome) => match found.see(&leg, &outcome) {
                    Ok(seen) => seen,
                    Err(reason) => {
                        return Ok(found.unresolved(query, &stretches, leg.span, reason));
                    }
                },
            };
            let lower = greater(0.0, leg.at_least(seen.lower));
            let (upper, tolerance) = (found.upper(), query.terms.tolerance);
            let is_loose = seen.is_loose(tolerance);
            if lower >= upper - tolerance || is_loose || stretches.is_fine(&leg)? {
                found.lower = lesser(found.lower, lower);
                stretches.prove(&leg);
            } else {
                if !self.cut_where_nearest(oracle, &leg, &seen, &mut found, &mut stretches)? {
                    return Ok(found.unresolved(query, &stretches, leg.span, Limit::Stalled));
                }
            }
            if found.upper() <= tolerance {
                found.lower = 0.0;
                break;
            }
        }
        let nearest = found.nearest(query, &stretches);
        if meets_later(&nearest.outcome, nearest.tolerance) {
            self.or_overlap_along(query, oracle, nearest, &mut stretches)
        } else {
            Ok(nearest)
        }
    }

    /// Answers whether the bodies keep a distance, or whether their shapes come nearer.
    fn keeps_along(
        &mut self,
        query: &Query<'_>,
        distance: f64,
        oracle: &mut O,
    ) -> Result<Answer, InputError> {
        let required = Required {
            distance,
            tolerance: query.terms.tolerance,
            budget: query.terms.budget,
            excess: query.excess(),
        };
        let begun = query.terms.deadline.map(|_| Instant::now());
        required.decide(|rung| {
            let mut query = query.asking(rung);
            query.terms.deadline = begun.and_then(|begun| {
                let deadline = query.terms.deadline;
                deadline.map(|deadline| deadline.saturating_sub(begun.elapsed()))
            });
            self.any_contact_along(&query, oracle)
        })
    }

    /// Proves a lower bound of the whole query's least distance, as a part of the least distance seen, if one is due.
    fn climb_along(
        &mut self,
        found: &mut Found,
        stretches: &mut Stretches<'_, '_>,
        oracle: &mut O,
    ) -> Result<(), InputError> {
        let work = stretches.stats.work();
        let (Some(rung), Ok(left)) = (found.ladder.due(work, found.upper()), stretches.terms())
        else {
            return Ok(());
        };
        let mut query = stretches.query().asking(rung);
        query.terms.budget = rung.budget;
        query.terms.deadline = left.deadline;
        let answer = self.any_contact_along(&query, oracle)?;
        stretches.add_for_no_part(&answer.stats);
        let proven = match answer.outcome {
            Outcome::Free { proven_gap } => Some(proven_gap),
            Outcome::Contact { time, contact } => {
                found.take(time, contact);
                None
            }
            _ => None,
        };
        found.ladder.climb(proven);
        Ok(())
    }

    /// Returns the answer for bodies that meet, unless they overlap at the start as well.
    fn or_overlap_along(
        &mut self,
        query: &Query<'_>,
        oracle: &mut O,
        nearest: Answer,
        stretches: &mut Stretches<'_, '_>,
    ) -> Result<Answer, InputError> {
        let Ok((pose, terms)) = stretches.pose(0.0)? else {
            return Ok(nearest);
        };
        let start = self.approach_of_bodies(&pose.problem(query, &terms)?, oracle);
        stretches.add(&start.stats);
        Ok(Answer {
            outcome: match start.outcome {
                overlapping @ Outcome::Overlapping { .. } => overlapping,
                _ => nearest.outcome,
            },
            stats: stretches.stats,
            ..nearest
        })
    }

    /// Cuts a stretch at the time at which its motions are nearest. Returns false if it cannot be cut.
    fn cut_where_nearest(
        &mut self,
        oracle: &mut O,
        leg: &Leg,
        seen: &Seen,
        found: &mut Found,
        stretches: &mut Stretches<'_, '_>,
    ) -> Result<bool, InputError> {
        let time = leg.time(seen.time);
        let Query {
            terms, duration, ..
        } = stretches.query();
        // Halves mostly suffice, and cost less than measuring the distance.
        if leg.span.length() > COARSE * duration {
            return Ok(stretches.cut_about(leg.span, time, f64::INFINITY));
        }
        // If they are nearest at an end, and still approach there, they get nearer beyond it.
        if let Some(end) = seen.falls_beyond(leg)
            && let Some(beyond) = stretches.take_beside(end)
        {
            let is_cut = stretches.cut_about(leg.span, time, f64::INFINITY);
            stretches.push(beyond);
            return Ok(is_cut);
        }
        let length = match self.doubt(oracle, time, found, stretches)? {
            Some(doubt) => greater(doubt.length(leg), leg.length_for_rate(doubt.rate.abs())),
            None => leg.length_for(STRAY_SHARE * terms.tolerance),
        };
        Ok(stretches.cut_about(leg.span, time, length))
    }

    /// Measures the bodies at a time. Returns `None` if they overlap, or a limit is reached.
    fn doubt(
        &mut self,
        oracle: &mut O,
        time: f64,
        found: &mut Found,
        stretches: &mut Stretches<'_, '_>,
    ) -> Result<Option<Doubt>, InputError> {
        let Ok((pose, terms)) = stretches.pose(time)? else {
            return Ok(None);
        };
        let answer = self.approach_of_bodies(&pose.problem(stretches.query(), &terms)?, oracle);
        stretches.stats.add(&answer.stats);
        let Outcome::Measured {
            at: Some((_, contact)),
            ..
        } = answer.outcome
        else {
            return Ok(None);
        };
        found.take(time, pose.contact(contact));
        let rounding = 2.0 * pose.stray;
        let least = greater(terms.tolerance, rounding);
        Ok(Some(Doubt {
            stray: greater(least, contact.separation.upper - found.upper()),
            rate: -pose.approach(0.0, &contact),
        }))
    }
}

/// The limits that the bodies' distance at a time sets for stretches near that time.
struct Doubt {
    /// Deviations below this leave no doubt.
    stray: f64,
    /// The rate at which the distance grows.
    rate: f64,
}

impl Doubt {
    fn length(&self, leg: &Leg) -> f64 {
        leg.length_for(STRAY_SHARE * self.stray)
    }

    /// Returns true if the distance grows from an end of a leg on.
    fn rises_into(&self, leg: &Leg, end: f64) -> bool {
        if end > leg.span.from {
            self.rate <= 0.0
        } else {
            self.rate >= 0.0
        }
    }
}
