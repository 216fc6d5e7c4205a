//! Computes the closest approach of two bodies on trajectories.

mod found;

use super::drive::{Question, search_stretches};
use super::motions::StretchMotions;
use super::stretches::WaitingStretches;
use crate::answer::{Answer, Limit, Outcome};
use crate::distance::oracle::DistanceOracle;
use crate::engine::scratch::Scratch;
use crate::error::InputError;
use crate::math::order::{greater, lesser};
use crate::motion::span::Span;
use crate::problem::Problem;
use crate::query::Query;
use crate::questions::closest::required::RequiredClearance;
use crate::questions::closest::{FartherThanCutoff, is_contact_after_start};
use crate::questions::depth_first::DepthFirst;
use crate::tuning::{MAX_DEVIATION_SHARE, MIN_UNMEASURED_HALVING_LENGTH_SHARE};
use found::{LeastDistanceBounds, StretchDistanceBounds};
use std::ops::ControlFlow;

impl<O: DistanceOracle> DepthFirst<O> {
    /// Computes bounds of the least distance of the bodies along their trajectories, or decides whether the bodies keep
    /// a required clearance.
    pub(crate) fn closest_approach_along(
        &mut self,
        query: &Query<'_>,
        oracle: &mut O,
    ) -> Result<Answer, InputError> {
        let answer = match query.settings.clearance {
            Some(distance) => self.decide_clearance_along(query, distance, oracle)?,
            None => {
                self.search_least_distance_of_bodies_along(&query.query_without_margin(), oracle)?
            }
        };
        Ok(answer.widened_by_excess(query.excess()))
    }

    /// Computes bounds of the least distance of the bodies, without a correction for their excess over the shapes.
    fn search_least_distance_of_bodies_along(
        &mut self,
        query: &Query<'_>,
        oracle: &mut O,
    ) -> Result<Answer, InputError> {
        let mut closest = ClosestApproachSearch {
            depth_first_search: self,
            least_distance_so_far: LeastDistanceBounds::new(query),
        };
        search_stretches(&mut closest, query, oracle)
    }

    /// Decides whether the bodies stay at least `distance` apart, or their shapes come nearer than `distance`.
    fn decide_clearance_along(
        &mut self,
        query: &Query<'_>,
        distance: f64,
        oracle: &mut O,
    ) -> Result<Answer, InputError> {
        let required = RequiredClearance {
            distance,
            tolerance: query.settings.tolerance,
            budget: query.settings.budget,
            deadline: query.settings.deadline,
            body_excess: query.excess(),
        };
        required.decide(|rung, deadline| {
            let mut query = query.contact_query(rung);
            query.settings.deadline = deadline;
            self.any_contact_along(&query, oracle)
        })
    }
}

struct ClosestApproachSearch<'s, O: DistanceOracle> {
    depth_first_search: &'s mut DepthFirst<O>,
    least_distance_so_far: LeastDistanceBounds,
}

impl<O: DistanceOracle> Question<O> for ClosestApproachSearch<'_, O> {
    fn scratch(&mut self) -> &mut Scratch {
        &mut self.depth_first_search.scratch
    }

    /// Tries to prove a lower bound of the least distance over the whole query, if the next such attempt is due.
    fn on_before_each_stretch(
        &mut self,
        stretches: &mut WaitingStretches<'_, '_>,
        oracle: &mut O,
    ) -> Result<(), InputError> {
        let found = &mut self.least_distance_so_far;
        let work = stretches.stats.budgeted_work();
        let (Some(rung), Ok(left)) = (
            found
                .lower_bound_prover
                .next_attempt_if_due(work, found.upper()),
            stretches.remaining_settings(),
        ) else {
            return Ok(());
        };
        let mut query = stretches.query.contact_query(rung);
        query.settings.deadline = left.deadline;
        let answer = self.depth_first_search.any_contact_along(&query, oracle)?;
        stretches.add_uncharged_work(&answer.stats);
        let proven = match answer.outcome {
            Outcome::Free { proven_gap } => Some(proven_gap),
            Outcome::Contact { time, contact } => {
                found.record_contact(time, contact);
                None
            }
            _ => None,
        };
        found.lower_bound_prover.record_attempt(proven);
        Ok(())
    }

    fn suitable_length_by_measurement(
        &mut self,
        stretches: &mut WaitingStretches<'_, '_>,
        motions: &StretchMotions,
        time: f64,
        oracle: &mut O,
    ) -> Result<Option<f64>, InputError> {
        let measured = self.measure_at_time(stretches, oracle, time)?;
        let increasing = measured.filter(|seen| seen.distance_increases_from_end(motions, time));
        Ok(increasing.map(|seen| seen.suitable_stretch_length(motions)))
    }

    fn search_stretch(
        &mut self,
        stretches: &mut WaitingStretches<'_, '_>,
        motions: &StretchMotions,
        problem: &Problem<'_>,
        oracle: &mut O,
    ) -> Result<ControlFlow<Answer>, InputError> {
        let found = &mut self.least_distance_so_far;
        // Distances of the motions beyond this are of no interest: the deviation and twice the tolerance are added to
        // the upper bound.
        let beyond = found.upper() + motions.total_deviation_bound + 2.0 * problem.tolerance;
        let answer = self
            .depth_first_search
            .search_least_distance_below(problem, beyond, oracle);
        stretches.add(&answer.stats);
        let seen = match answer.result {
            Err(FartherThanCutoff { lower }) => StretchDistanceBounds::for_distant_motions(lower),
            Ok(Outcome::Overlapping { .. }) if stretches.schedule_start_examination(motions)? => {
                return Ok(ControlFlow::Continue(()));
            }
            Ok(outcome @ Outcome::Overlapping { .. })
                if stretches.starts_at_initial_poses(motions)? =>
            {
                return Ok(ControlFlow::Break(found.answer(stretches, outcome)));
            }
            Ok(outcome) => match found.record_stretch_outcome(motions, &outcome) {
                Ok(seen) => seen,
                Err(limit) => {
                    let stopped = found.unresolved(stretches, motions.span, limit);
                    return Ok(ControlFlow::Break(stopped));
                }
            },
        };
        let lower = greater(0.0, motions.lower_bound_for_bodies(seen.lower));
        let tolerance = stretches.query.settings.tolerance;
        let is_near_enough =
            lower >= found.upper() - tolerance || seen.is_limited_by_rounding(tolerance);
        if is_near_enough || stretches.accepts_contact(motions)? {
            found.lower = lesser(found.lower, lower);
            stretches.record_proven_stretch(motions);
        } else if !self.cut_where_nearest(stretches, oracle, motions, &seen)? {
            let stalled =
                self.least_distance_so_far
                    .unresolved(stretches, motions.span, Limit::Stalled);
            return Ok(ControlFlow::Break(stalled));
        }
        if self.least_distance_so_far.upper() > tolerance {
            return Ok(ControlFlow::Continue(()));
        }
        self.least_distance_so_far.lower = 0.0;
        self.on_end(stretches, oracle).map(ControlFlow::Break)
    }

    fn on_limit(
        &mut self,
        stretches: &WaitingStretches<'_, '_>,
        span: Span,
        limit: Limit,
    ) -> Answer {
        self.least_distance_so_far
            .unresolved(stretches, span, limit)
    }

    fn on_end(
        &mut self,
        stretches: &mut WaitingStretches<'_, '_>,
        oracle: &mut O,
    ) -> Result<Answer, InputError> {
        let nearest = self.least_distance_so_far.least_distance_answer(stretches);
        if is_contact_after_start(&nearest.outcome, nearest.tolerance) {
            self.overlap_or_nearest_answer(stretches, oracle, nearest)
        } else {
            Ok(nearest)
        }
    }
}

impl<O: DistanceOracle> ClosestApproachSearch<'_, O> {
    /// Returns `nearest`, or the answer that the bodies overlap if they overlap at the start.
    fn overlap_or_nearest_answer(
        &mut self,
        stretches: &mut WaitingStretches<'_, '_>,
        oracle: &mut O,
        nearest: Answer,
    ) -> Result<Answer, InputError> {
        let Ok((pose, terms)) = stretches.motions_and_settings_at(0.0)? else {
            return Ok(nearest);
        };
        let problem = pose.problem(stretches.query, &terms)?;
        let start = self
            .depth_first_search
            .search_least_distance_of_bodies(&problem, oracle);
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

    /// Cuts a stretch near the time at which its motions are nearest. Returns whether the stretch could be cut.
    fn cut_where_nearest(
        &mut self,
        stretches: &mut WaitingStretches<'_, '_>,
        oracle: &mut O,
        motions: &StretchMotions,
        seen: &StretchDistanceBounds,
    ) -> Result<bool, InputError> {
        let time = motions.query_time(seen.time);
        let query = stretches.query;
        // Halves mostly suffice, and cost less than measuring the distance.
        if motions.span.length() > MIN_UNMEASURED_HALVING_LENGTH_SHARE * query.duration {
            return Ok(stretches.cut_out_around(motions.span, time, f64::INFINITY));
        }
        // If they are nearest at an end, and still approach there, they get nearer beyond it.
        if let Some(end) = seen.stretch_end_nearer_beyond(motions)
            && let Some(beyond) = stretches.take_adjacent_stretch(end)
        {
            let is_cut = stretches.cut_out_around(motions.span, time, f64::INFINITY);
            stretches.push(beyond);
            return Ok(is_cut);
        }
        let length = match self.measure_at_time(stretches, oracle, time)? {
            Some(distance_at_time) => greater(
                distance_at_time.suitable_stretch_length(motions),
                motions.stretch_length_for_rate(distance_at_time.distance_growth_rate.abs()),
            ),
            None => {
                motions.stretch_length_for_deviation(MAX_DEVIATION_SHARE * query.settings.tolerance)
            }
        };
        Ok(stretches.cut_out_around(motions.span, time, length))
    }

    /// Measures the distance of the bodies at one time, and records it if it is the least so far. Returns `None` if the
    /// bodies overlap, or if a limit is reached.
    fn measure_at_time(
        &mut self,
        stretches: &mut WaitingStretches<'_, '_>,
        oracle: &mut O,
        time: f64,
    ) -> Result<Option<DeviationLimitAndRate>, InputError> {
        let Ok((pose, terms)) = stretches.motions_and_settings_at(time)? else {
            return Ok(None);
        };
        let problem = pose.problem(stretches.query, &terms)?;
        let answer = self
            .depth_first_search
            .search_least_distance_of_bodies(&problem, oracle);
        stretches.stats.add(&answer.stats);
        let Outcome::LeastDistance { contact, .. } = answer.outcome else {
            return Ok(None);
        };
        let found = &mut self.least_distance_so_far;
        found.record_contact(time, pose.widen_separation_bounds(contact));
        let rounding = 2.0 * pose.total_deviation_bound;
        let least = greater(terms.tolerance, rounding);
        Ok(Some(DeviationLimitAndRate {
            deviation_limit: greater(least, contact.separation.upper - found.upper()),
            distance_growth_rate: -pose.approach_rate(0.0, &contact),
        }))
    }
}

/// A measurement of the bodies at one time, from which the length of stretches near that time is chosen.
struct DeviationLimitAndRate {
    /// The deviation limit for stretches near that time: the excess of the measured distance over the least distance
    /// found, but at least the tolerance. Stretches are made so short that their deviations are a share of it.
    deviation_limit: f64,
    /// The rate at which the distance increases at the time of the measurement.
    distance_growth_rate: f64,
}

impl DeviationLimitAndRate {
    fn suitable_stretch_length(&self, motions: &StretchMotions) -> f64 {
        motions.stretch_length_for_deviation(MAX_DEVIATION_SHARE * self.deviation_limit)
    }

    /// Returns whether the distance increases from the given end of the stretch towards its middle.
    fn distance_increases_from_end(&self, motions: &StretchMotions, end: f64) -> bool {
        if end > motions.span.from {
            self.distance_growth_rate <= 0.0
        } else {
            self.distance_growth_rate >= 0.0
        }
    }
}
