//! The start policy [`StartPolicy::Leave`]: pairs in contact at the start are ignored as long as they do not come
//! nearer.
//!
//! A pair with a gap at the start must keep half of its gap. A pair without a gap is first followed in short steps, so
//! short that its relative motion is almost a motion at constant velocities. The engine decides each step under the same
//! policy. If there is a gap after a step, the rest of the path is searched for this pair as for all others.

use super::PathSearch;
use crate::path::interval::{PathInterval, StepResult};
use crate::solver::Goal;
use crate::solver::constant_step::ConstantStep;
use crate::solver::curved_link::PathSection;
use crate::solver::measure::{DistanceVerdict, Thresholds, measure};
use crate::solver::part_pairs::PartPair;
use crate::tuning::MAX_START_STEPS;
use ccd_core::order::{greater, lesser};
use rigid_ccd::answer::Limit;
use rigid_ccd::trajectory::Trajectory;
use rigid_ccd::{
    Answer, Body, ContactNormals, Error, Motion, Outcome, Settings, Solver, StartPolicy,
};
use std::ops::ControlFlow::{self, Break, Continue};

/// The distance by which a pair without a gap may approach in all steps together, because motions at constant velocities
/// approximate the steps: a fraction of the tolerance, and at least a multiple of the rounding error of poses.
const SINKING_PER_TOLERANCE: f64 = 1e-6;
const SINKING_PER_ROUNDING: f64 = 1024.0;

/// The smallest usable gap, as a multiple of the rounding error of poses. A pair with a larger gap is searched like the
/// other pairs.
const LEAST_GAP_PER_ROUNDING: f64 = 64.0;

/// A pair of bodies in contact at the start that is ignored while it separates.
#[derive(Clone, Copy, Debug)]
pub(crate) struct StartContact {
    /// Any pair of parts of both bodies.
    pair: PartPair,
    bodies: [usize; 2],
    /// The point up to which the pair is proven not to come nearer; infinity for the whole path.
    from: f64,
    /// After that point, the distance at which the pair counts as touching, and its tolerance.
    margin: f64,
    tolerance: f64,
}

/// The result of measuring two bodies: a lower bound of their distance, whether they overlap, and the limit that was
/// reached before this was decided.
struct Gap {
    lower: f64,
    overlaps: bool,
    limit: Option<Limit>,
}

impl PathSearch<'_> {
    /// Answers a question about contacts on the whole path. Ignores pairs in contact at the start while they separate.
    pub(crate) fn answer_leaving_start(&mut self, goal: Goal) -> Result<(), Error> {
        let whole = self.whole_path_interval();
        self.begin_question(goal, &whole);
        let step = self.find_start_contacts()?;
        if step.is_break() || self.follow_start_contacts()?.is_break() {
            return Ok(());
        }
        let earliest_start = |search: &Self, first: usize| {
            let starts = search.start_contacts[first..].iter();
            starts
                .map(|contact| contact.from)
                .fold(f64::INFINITY, lesser)
        };
        let step = self.search_all_pairs(whole)?;
        if step.is_continue() {
            self.decide_engine_candidates()?;
        }
        for index in 0..self.start_contacts.len() {
            if self.result.limit_reached.is_some() || self.is_decided() {
                // The remaining pairs are proven not to touch up to the points to which they were followed.
                let until = earliest_start(self, index);
                if let Some((_, known)) = &mut self.result.limit_reached {
                    *known = lesser(*known, until);
                }
                return Ok(());
            }
            let contact = self.start_contacts[index];
            let (tolerance, periods) = (self.tolerance, std::mem::take(&mut self.periods));
            // The drift of periods may exceed this tolerance.
            self.tolerance = contact.tolerance;
            let searched = self.search_after_start(&contact);
            (self.tolerance, self.periods) = (tolerance, periods);
            searched?;
        }
        Ok(())
    }

    /// Returns whether a question about any contact is answered.
    fn is_decided(&self) -> bool {
        self.goal == Goal::AnyContact && self.result.nearest.is_some()
    }

    /// Finds the pairs in contact at the start. An overlapping pair is the answer.
    fn find_start_contacts(&mut self) -> StepResult {
        let start = PathInterval {
            to: 0.0,
            ..self.whole_path_interval()
        };
        self.placement.place(self.cell, &self.path, &start);
        self.candidates.clear();
        self.append_candidates();
        let mut pairs = std::mem::take(&mut self.candidates);
        let step = self.record_start_contacts(&mut pairs);
        self.candidates = pairs;
        step
    }

    fn record_start_contacts(&mut self, pairs: &mut [PartPair]) -> StepResult {
        let start = PathInterval {
            to: 0.0,
            ..self.whole_path_interval()
        };
        for pair in pairs {
            if self.pairs.is_ignored(pair.body_indices(self.cell.parts()))
                || self.is_apart_at_start(pair)
            {
                continue;
            }
            if self.check_limit(&start).is_break() {
                return Ok(Break(()));
            }
            let bodies = pair.body_indices(self.cell.parts());
            let gap = self.gap_at(bodies, 0.0)?;
            // Whether touching bodies overlap may stay undecided here: following them decides it.
            let is_single_point = self.path.segment_count() == 0;
            if let Some(limit) = gap.limit
                && (is_single_point || limit != Limit::OverlapUndecided)
            {
                self.result.limit_reached = Some((limit, 0.0));
                return Ok(Break(()));
            }
            if gap.overlaps {
                return Ok(self.end_with_contact(pair, 0.0));
            }
            // Written so that NaN is a contact.
            if gap.lower > pair.margin + self.tolerance {
                continue;
            }
            let usable_gap = 0.5 * (gap.lower - pair.margin);
            let mut contact = StartContact {
                pair: *pair,
                bodies,
                from: f64::INFINITY,
                margin: pair.margin,
                tolerance: lesser(usable_gap, self.tolerance),
            };
            if self.is_gap_usable(usable_gap) {
                contact.from = 0.0;
            } else {
                contact.margin = lesser(pair.margin, gap.lower);
                contact.tolerance = 0.0;
            }
            self.start_contacts.push(contact);
            self.pairs.ignored.push(contact.bodies);
        }
        Ok(Continue(()))
    }

    /// Returns whether the hulls of a pair prove that it is not in contact at the start.
    fn is_apart_at_start(&self, pair: &mut PartPair) -> bool {
        let usable_gap = pair.margin + self.tolerance;
        let thresholds = Thresholds {
            free_distance_threshold: usable_gap,
            near_distance: 0.0,
        };
        let found = measure(self.cell, &self.placement, pair, thresholds, false);
        matches!(found, DistanceVerdict::Free)
    }

    /// Follows the pairs without a gap until they have one, or to the end of the path.
    fn follow_start_contacts(&mut self) -> StepResult {
        if self.path.segment_count() == 0 {
            return Ok(Continue(()));
        }
        for index in 0..self.start_contacts.len() {
            let mut contact = self.start_contacts[index];
            if contact.tolerance > 0.0 {
                continue;
            }
            if self.follow_start_contact(&mut contact)?.is_break() {
                return Ok(Break(()));
            }
            self.start_contacts[index] = contact;
        }
        Ok(Continue(()))
    }

    fn follow_start_contact(&mut self, contact: &mut StartContact) -> StepResult {
        let end = lesser(self.path.segment_count() as f64, self.result.end);
        let rounding = 2.0 * self.placement.rounding;
        let mut sinking = greater(
            SINKING_PER_TOLERANCE * self.tolerance,
            SINKING_PER_ROUNDING * rounding,
        );
        let (mut at, mut steps_of_segment) = (0.0, 0);
        while at < end && steps_of_segment < MAX_START_STEPS {
            steps_of_segment = if at.fract() == 0.0 {
                1
            } else {
                steps_of_segment + 1
            };
            let here = PathInterval {
                from: at,
                to: at,
                halvings: 0,
            };
            if self.check_limit(&here).is_break() {
                // No other pair has been searched yet.
                self.discard_search_progress();
                return Ok(Break(()));
            }
            let (segment, open_end) = (at as usize, lesser(at.floor() + 1.0, end));
            let Some(step) =
                self.constant_step(contact.bodies, (segment, at, open_end), sinking)?
            else {
                return Ok(self.end_with_contact(&contact.pair, at));
            };
            sinking -= step.deviation;
            let answer = self.query_step(contact, &step)?;
            match answer.outcome.hit() {
                Ok(None) => at = step.to,
                Ok(Some(hit)) => {
                    let time = at + hit.time;
                    return Ok(self.end_with_contact(&contact.pair, greater(time.next_down(), at)));
                }
                Err(known) => {
                    self.result.limit_reached = Some((known.limit, at));
                    self.discard_search_progress();
                    return Ok(Break(()));
                }
            }
            let gap = self.gap_at(contact.bodies, at)?;
            let usable_gap = 0.5 * (gap.lower - contact.margin);
            if !gap.overlaps && self.is_gap_usable(usable_gap) {
                contact.from = at;
                contact.tolerance = lesser(usable_gap, self.tolerance);
                return Ok(Continue(()));
            }
        }
        if at < end {
            return Ok(self.end_with_contact(&contact.pair, at));
        }
        Ok(Continue(()))
    }

    /// Records a contact of a pair that was in contact at the start. Ends the search, unless an earlier contact is
    /// possible.
    fn end_with_contact(&mut self, pair: &PartPair, at: f64) -> ControlFlow<()> {
        let step = self.record_contact(pair, at, 0.0);
        // No contact is earlier than the start.
        if at > 0.0 { step } else { Break(()) }
    }

    fn discard_search_progress(&mut self) {
        if let Some((_, until)) = &mut self.result.limit_reached {
            *until = 0.0;
        }
        self.result.nearest = None;
    }

    /// Returns whether a pair with this gap beyond its margin can be searched like the other pairs. Written so that the
    /// result is false for NaN.
    fn is_gap_usable(&self, usable_gap: f64) -> bool {
        usable_gap > LEAST_GAP_PER_ROUNDING * self.placement.rounding
    }

    /// Searches the path for a pair, from the point where it has a gap.
    fn search_after_start(&mut self, contact: &StartContact) -> Result<(), Error> {
        let end = self.path.segment_count() as f64;
        self.engine_candidates.clear();
        let middle = lesser(contact.from.floor() + 1.0, end);
        for (from, to) in [(contact.from, middle), (middle, end)] {
            // Written so that nothing is searched from infinity.
            if !(from < to) {
                continue;
            }
            self.candidates.clear();
            let (bodies, margin) = (contact.bodies, contact.margin);
            self.pairs.append_pairs_of_bodies(
                &self.placement,
                bodies,
                margin,
                &mut self.candidates,
            );
            let interval = PathInterval {
                from,
                to,
                halvings: 0,
            };
            let all = 0..self.candidates.len();
            if self.search(interval, Some(all))?.is_break() {
                return Ok(());
            }
        }
        self.decide_engine_candidates()
    }

    /// Measures the distance of two bodies at a point of the path.
    fn gap_at(&mut self, bodies: [usize; 2], at: f64) -> Result<Gap, Error> {
        self.placement.place_frames(self.cell, &self.path, at);
        let a = self.placement.body(self.cell, bodies[0])?;
        let b = self.placement.body(self.cell, bodies[1])?;
        self.solver.set_settings(Settings {
            tolerance: self.tolerance,
            budget: self.stop_condition.budget_of_query(),
            deadline: self.stop_condition.remaining(),
            contact_normals: ContactNormals::OfPieces,
            start_policy: StartPolicy::Report,
            ..self.settings.clone()
        });
        let answer = self.solver.distance(a, b)?;
        self.stop_condition
            .add_work(1 + answer.stats.budgeted_work());
        let outcome = answer.outcome;
        Ok(Gap {
            lower: outcome.lower(),
            overlaps: matches!(outcome, Outcome::Overlapping { .. }),
            limit: outcome.limit(),
        })
    }

    /// Returns the longest step, by halving a section of a segment, in which the first body of a pair moves almost
    /// like a constant motion; `None` if there is none.
    fn constant_step(
        &mut self,
        bodies: [usize; 2],
        (segment, from, to): (usize, f64, f64),
        sinking: f64,
    ) -> Result<Option<ConstantStep>, Error> {
        let section = PathSection {
            path: &self.path,
            segment,
            from,
            to,
        };
        // Leaves at least half of the remaining approach to the steps that follow.
        let find = |_: &mut Solver, link: &dyn Trajectory, a: &Body, _: (&Body, Motion)| {
            ConstantStep::longest(link, a, (from, to), 0.5 * sinking)
        };
        self.exact_chains
            .with_trajectory(&mut self.solver, bodies, &section, find)
    }

    /// Queries the engine whether a touching pair comes nearer within a step.
    fn query_step(&mut self, contact: &StartContact, step: &ConstantStep) -> Result<Answer, Error> {
        self.solver.set_settings(Settings {
            tolerance: self.tolerance,
            margin: contact.margin + 2.0 * self.placement.rounding,
            budget: self.stop_condition.budget_of_query(),
            start_policy: StartPolicy::Leave,
            deadline: self.stop_condition.remaining(),
            contact_normals: ContactNormals::OfPieces,
            ..self.settings.clone()
        });
        let (a, b) = self.exact_chains.bodies(contact.bodies);
        let answer = self
            .solver
            .first_contact((a, step.motion), b, step.to - step.from)?;
        self.stop_condition
            .add_work(1 + answer.stats.budgeted_work());
        Ok(answer)
    }
}
