//! Contacts at the start of a path that are let go: the pairs may part, but not come nearer or sink.
//!
//! A pair with a gap at the start keeps half of it from then on. A pair without one is first followed over a short interval in which
//! the joints move it almost as a constant motion does, which the engine decides under [`StartPolicy::Leave`]. At the end of the
//! interval there is a gap, or the next interval follows.

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

/// How far pairs that touch at the start may sink unseen while the path is taken as constant motions, as a share of the tolerance,
/// and at least as a multiple of the rounding of poses.
const SINKING_PER_TOLERANCE: f64 = 1e-6;
const SINKING_PER_ROUNDING: f64 = 1024.0;

/// The least gap from which a pair is searched as others are, as a multiple of the rounding of poses.
const LEAST_GAP_PER_ROUNDING: f64 = 64.0;

/// A pair of bodies that is let go from its contact at the start.
#[derive(Clone, Copy, Debug)]
pub(crate) struct StartContact {
    /// A pair of parts of both.
    pair: PartPair,
    bodies: [usize; 2],
    /// The point up to which the pair is known not to come nearer; infinite for the whole path.
    from: f64,
    /// The distance at which the pair counts as touching after that point, and the tolerance of that.
    margin: f64,
    tolerance: f64,
}

/// The distance of two bodies, whether they overlap, and the limit that left this open.
struct Gap {
    lower: f64,
    overlaps: bool,
    limit: Option<Limit>,
}

impl PathSearch<'_> {
    /// Answers a question about contacts on the whole path; pairs in contact at the start are let go.
    pub(crate) fn answer_leaving_start(&mut self, goal: Goal) -> Result<(), Error> {
        let whole = self.whole_path_interval();
        self.begin_question(goal, &whole);
        self.start_contacts.clear();
        let leaves = self.find_start_contacts()?;
        if leaves.is_break() || self.follow_start_contacts()?.is_break() {
            return Ok(());
        }
        let least_from = |search: &Self, first: usize| {
            let froms = search.start_contacts[first..].iter();
            froms
                .map(|contact| contact.from)
                .fold(f64::INFINITY, lesser)
        };
        self.candidates.clear();
        let step = self.search(whole, None)?;
        if step.is_continue() {
            self.decide_engine_candidates()?;
        }
        for number in 0..self.start_contacts.len() {
            if self.result.limit_reached.is_some() || self.is_decided() {
                // The pairs that remain are known as far as they were followed.
                let until = least_from(self, number);
                if let Some((_, known)) = &mut self.result.limit_reached {
                    *known = lesser(*known, until);
                }
                return Ok(());
            }
            let contact = self.start_contacts[number];
            let (tolerance, periods) = (self.tolerance, std::mem::take(&mut self.periods));
            // A period may drift by more than this tolerance.
            self.tolerance = contact.tolerance;
            let searched = self.search_after_start(&contact);
            (self.tolerance, self.periods) = (tolerance, periods);
            searched?;
        }
        Ok(())
    }

    /// Returns whether a pair is let go from its contact at the start, and is searched by itself.
    #[inline(always)]
    pub(super) fn is_start_contact(&self, pair: &PartPair) -> bool {
        let bodies = pair.body_indices(self.cell.parts());
        self.start_contacts
            .iter()
            .any(|contact| contact.bodies == bodies)
    }

    /// Returns whether a question about any contact has its answer.
    fn is_decided(&self) -> bool {
        self.goal == Goal::AnyContact && self.result.nearest.is_some()
    }

    /// Finds the pairs in contact at the start. One that overlaps is the answer.
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
            if self.is_start_contact(pair) || self.is_apart_at_start(pair) {
                continue;
            }
            if self.check_limit(&start).is_break() {
                return Ok(Break(()));
            }
            let bodies = pair.body_indices(self.cell.parts());
            let gap = self.gap_at(bodies, 0.0)?;
            // Whether bodies that touch overlap is decided as they move.
            let rests = self.path.segment_count() == 0;
            if let Some(limit) = gap.limit
                && (rests || limit != Limit::OverlapUndecided)
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
            let beyond = 0.5 * (gap.lower - pair.margin);
            let mut contact = StartContact {
                pair: *pair,
                bodies,
                from: f64::INFINITY,
                margin: pair.margin,
                tolerance: lesser(beyond, self.tolerance),
            };
            if self.is_useful(beyond) {
                contact.from = 0.0;
            } else {
                contact.margin = lesser(pair.margin, gap.lower);
                contact.tolerance = 0.0;
            }
            self.start_contacts.push(contact);
        }
        Ok(Continue(()))
    }

    /// Returns whether a pair is farther apart at the start than a contact is, as far as its hulls tell.
    fn is_apart_at_start(&self, pair: &mut PartPair) -> bool {
        let beyond = pair.margin + self.tolerance;
        let thresholds = Thresholds {
            free_distance_threshold: beyond,
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
        for number in 0..self.start_contacts.len() {
            let mut contact = self.start_contacts[number];
            if contact.tolerance > 0.0 {
                continue;
            }
            if self.follow(&mut contact)?.is_break() {
                return Ok(Break(()));
            }
            self.start_contacts[number] = contact;
        }
        Ok(Continue(()))
    }

    fn follow(&mut self, contact: &mut StartContact) -> StepResult {
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
                // No other pair was searched yet.
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
            let beyond = 0.5 * (gap.lower - contact.margin);
            if !gap.overlaps && self.is_useful(beyond) {
                contact.from = at;
                contact.tolerance = lesser(beyond, self.tolerance);
                return Ok(Continue(()));
            }
        }
        if at < end {
            return Ok(self.end_with_contact(&contact.pair, at));
        }
        Ok(Continue(()))
    }

    /// Keeps a contact of a pair that is let go, which is the answer unless an earlier one is looked for.
    fn end_with_contact(&mut self, pair: &PartPair, at: f64) -> ControlFlow<()> {
        let step = self.record_contact(pair, at, 0.0);
        // Nothing is before the start.
        if at > 0.0 { step } else { Break(()) }
    }

    fn discard_search_progress(&mut self) {
        if let Some((_, until)) = &mut self.result.limit_reached {
            *until = 0.0;
        }
        self.result.nearest = None;
    }

    /// Returns whether a pair with this room beyond its margin can be searched as others are. Written so that NaN cannot.
    fn is_useful(&self, beyond: f64) -> bool {
        beyond > LEAST_GAP_PER_ROUNDING * self.placement.rounding
    }

    /// Searches the path from where a pair has a gap.
    fn search_after_start(&mut self, contact: &StartContact) -> Result<(), Error> {
        let end = self.path.segment_count() as f64;
        self.engine_candidates.clear();
        let middle = lesser(contact.from.floor() + 1.0, end);
        for (from, to) in [(contact.from, middle), (middle, end)] {
            // Written so that an infinite start is none.
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

    /// Returns the distance of two bodies at a point of the path.
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

    /// Returns the longest step, of halvings of a section of a segment, in which the first body of a pair moves almost as a
    /// constant motion does; `None` if there is none.
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
        // At least half of what is left stays for the steps that follow.
        let find = |_: &mut Solver, link: &dyn Trajectory, a: &Body, _: (&Body, Motion)| {
            ConstantStep::longest(link, a, (from, to), 0.5 * sinking)
        };
        self.exact_chains
            .with_link(&mut self.solver, bodies, &section, find)
    }

    /// Asks the engine whether a pair that rests comes nearer in a step.
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
