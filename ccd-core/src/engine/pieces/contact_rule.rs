//! The rule by which a pair of pieces counts as in contact, and how far it advances by that rule.

use super::level::TouchingPlaneState;
use super::placed_pair::PlacedPair;
use crate::answer::Contact;
use crate::body::facing::Facing;
use crate::distance::oracle::DistanceOracle;
use crate::distance::overlap::{self, Intersection};
use crate::distance::separation::CheckedClaim;
use crate::distance::separation::sharp::improve_axis;
use crate::engine::meter::Meter;
use crate::motion::free_time::FreeTime;
use crate::rounding::MIN_APPROACH_PER_ROUNDING;
use crate::settings::StartPolicy;
use crate::tuning::RESTING_SLACK_PER_ROUNDING;
use glam::DVec3;
use std::ops::ControlFlow::{self, Break, Continue};

/// The rule by which a pair counts as in contact, and the gap that it is proven to keep until its clock.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum ContactRule {
    /// The pair counts as in contact once it is within margin + tolerance. It keeps `Problem::kept_gap` until its
    /// clock.
    ApartAtStart,
    /// Like `ApartAtStart`, for a pair that was in contact at the start and has separated since.
    SeparatedAfterStart,
    /// The pair was in contact at the start, up to rounding. It is in contact again once its gap cannot be proven to be
    /// above `floor`.
    InContactAtStart { floor: f64 },
    /// The pair touches, but the plane of the contact at the start keeps its pieces apart. The pair is in contact once
    /// it approaches along the normal of that plane.
    TouchingPlane(TouchingPlaneState),
}

/// The result of one advance of a pair.
#[derive(Clone, Copy, Debug)]
pub(crate) enum PairStep {
    /// The pair is certified apart for this time, which leads to a later clock.
    Free(FreeTime),
    /// The pair is within the tolerance. At the start it may intersect, which the search for the nearest pieces
    /// decides.
    Contact(Contact),
    /// The pair intersects at the start.
    Overlap(Contact),
    /// The pair is not in contact, but its clock cannot advance.
    Stalled,
    /// The oracle gave up on the pair.
    GaveUp,
}

/// Two pieces at one clock, with the checked claim about their distance there.
#[derive(Clone, Copy)]
pub(super) struct ExaminedPair<'e, 'p> {
    pub(super) placed: &'e PlacedPair<'p>,
    /// The indices of the pieces in the problem.
    pub(super) ids: [u32; 2],
    pub(super) checked: &'e CheckedClaim,
}

impl ContactRule {
    /// Changes to the rule of the pair at its present distance. Breaks off if the pair is in contact by it.
    pub(super) fn choose<O: DistanceOracle>(
        &mut self,
        pair: ExaminedPair<'_, '_>,
        oracle: &mut O,
        meter: &mut Meter,
    ) -> ControlFlow<PairStep> {
        let (placed, checked) = (pair.placed, pair.checked);
        let apart = placed.problem.contact_distance();
        // Written so that NaN is no contact: without a gap, it has no free time either.
        if !(checked.upper <= apart) {
            if checked.lower > apart && *self != ContactRule::ApartAtStart {
                *self = ContactRule::SeparatedAfterStart;
            }
            return Continue(());
        }
        if placed.clock == 0.0 {
            pair.check_overlap_at_start(meter)?;
        }
        let rule = match *self {
            ContactRule::ApartAtStart => match pair.rule_ignoring_start_contact(oracle, meter) {
                Some(rule) => Some(rule),
                None => pair.touching_plane(placed).map(ContactRule::TouchingPlane),
            },
            ContactRule::SeparatedAfterStart => {
                pair.touching_plane(placed).map(ContactRule::TouchingPlane)
            }
            rule @ (ContactRule::InContactAtStart { .. } | ContactRule::TouchingPlane(_)) => {
                Some(rule)
            }
        };
        let Some(rule) = rule else {
            return Break(pair.contact());
        };
        *self = rule;
        Continue(())
    }

    /// Advances the pair by its rule. A pair that is apart stays so for `free_time` of its claim and the gap that it
    /// keeps.
    pub(super) fn step(
        &mut self,
        pair: ExaminedPair<'_, '_>,
        free_time: impl FnOnce(&PlacedPair<'_>, &CheckedClaim, f64) -> FreeTime,
    ) -> PairStep {
        let ExaminedPair {
            placed, checked, ..
        } = pair;
        let (problem, clock) = (placed.problem, placed.clock);
        match *self {
            ContactRule::ApartAtStart | ContactRule::SeparatedAfterStart => {
                let kept = problem.kept_gap();
                // The axis of the claim may lose all of the gap that is left to advance by. Written so that NaN counts
                // as such a loss.
                let checked = if checked.lower > kept + problem.rounding {
                    checked
                } else {
                    &improve_axis(&placed.pieces, checked, problem.rounding)
                };
                let free = free_time(placed, checked, kept);
                step_from_free_time(clock, free)
                    .or_else(|| self.step_beside_plane(pair.with_claim(checked), placed))
                    .unwrap_or(PairStep::Stalled)
            }
            ContactRule::InContactAtStart { floor } => {
                let checked = &improve_axis(&placed.pieces, checked, problem.rounding);
                let pair = pair.with_claim(checked);
                let free = placed.free_time_when_touching(checked, floor, pair.ids);
                step_from_free_time(clock, free)
                    .or_else(|| self.step_beside_plane(pair, &pair.at_start()))
                    .unwrap_or_else(|| pair.contact())
            }
            ContactRule::TouchingPlane(plane) => {
                let free = placed.touching_plane_free_time(&plane, checked.witness_a);
                step_from_free_time(clock, free).unwrap_or_else(|| pair.contact())
            }
        }
    }

    /// Advances a pair that the plane of the contact at the start keeps apart, with the body that is chosen at the
    /// poses of `chosen_at`; `None` if it does not.
    fn step_beside_plane(
        &mut self,
        pair: ExaminedPair<'_, '_>,
        chosen_at: &PlacedPair<'_>,
    ) -> Option<PairStep> {
        let plane = pair.touching_plane(chosen_at)?;
        *self = ContactRule::TouchingPlane(plane);
        let free = pair
            .placed
            .touching_plane_free_time(&plane, pair.checked.witness_a);
        step_from_free_time(pair.placed.clock, free)
    }
}

impl<'e, 'p> ExaminedPair<'e, 'p> {
    fn with_claim(self, checked: &'e CheckedClaim) -> Self {
        ExaminedPair { checked, ..self }
    }

    fn contact(self) -> PairStep {
        PairStep::Contact(self.placed.contact(self.ids, self.checked))
    }

    /// Returns the pieces at the start of the query.
    fn at_start(self) -> PlacedPair<'p> {
        PlacedPair::new(self.placed.problem, self.ids, 0.0)
    }

    /// Breaks off if the pieces intersect at the start, or if that is undecided.
    fn check_overlap_at_start(self, meter: &mut Meter) -> ControlFlow<PairStep> {
        let memory = &mut meter.scratch_memory().expanding_polytope;
        let PlacedPair {
            problem, pieces, ..
        } = self.placed;
        match overlap::decide_intersection(pieces, self.checked, problem.rounding, memory) {
            Intersection::Certain => {
                let contact = self.placed.contact(self.ids, self.checked);
                Break(PairStep::Overlap(contact))
            }
            // The search for the nearest pieces decides this.
            Intersection::Undecided => Break(self.contact()),
            Intersection::None => Continue(()),
        }
    }

    /// Returns the plane of the contact at the start with the body that it moves with, if it keeps the pair apart. The
    /// body is chosen at the poses of `chosen_at`.
    fn touching_plane(self, chosen_at: &PlacedPair<'_>) -> Option<TouchingPlaneState> {
        let plane = chosen_at.problem.touching_plane.as_ref()?;
        chosen_at.choose_plane_state(plane, self.ids, self.checked.witness_a)
    }

    /// Returns the rule for a pair that is in contact at the start, if that contact is to be ignored; `None` if it
    /// counts.
    fn rule_ignoring_start_contact<O: DistanceOracle>(
        self,
        oracle: &mut O,
        meter: &mut Meter,
    ) -> Option<ContactRule> {
        let problem = self.placed.problem;
        if problem.start_policy == StartPolicy::Report {
            return None;
        }
        let placed = self.at_start();
        let start = placed.query_oracle(oracle, &mut O::Cache::default(), meter)?;
        let start = improve_axis(&placed.pieces, &start, problem.rounding);
        // Written so that NaN is a contact, as is a pair without a separating axis.
        let resting = start.upper <= problem.contact_distance()
            && start.lower >= -MIN_APPROACH_PER_ROUNDING * problem.rounding;
        if !resting {
            return None;
        }
        Some(ContactRule::InContactAtStart {
            floor: start.lower - MIN_APPROACH_PER_ROUNDING * problem.rounding,
        })
    }
}

impl PlacedPair<'_> {
    /// Like [`PlacedPair::free_time`], for two pieces with these indices that rest on each other.
    ///
    /// A plane keeps triangles in it apart on either side, though they may be about to pass into each other. If one
    /// of them bounds a solid, the plane keeps them apart on the outside only.
    pub(crate) fn free_time_when_touching(
        &self,
        checked: &CheckedClaim,
        kept: f64,
        [a, b]: [u32; 2],
    ) -> FreeTime {
        let rounding = self.problem.rounding;
        let slack = |axis| self.gap_along(axis, checked.witness_a) - kept;
        // Written so that NaN counts as no slack.
        let is_left = |slack: f64| slack > RESTING_SLACK_PER_ROUNDING * rounding;
        let anyhow = || {
            if is_left(checked.lower - kept) {
                self.free_time(checked, kept)
            } else {
                FreeTime::NONE
            }
        };
        // This includes pieces that have passed the plane by the rounding of resting.
        let in_one_plane = slack(-checked.axis) >= -MIN_APPROACH_PER_ROUNDING * rounding;
        if !in_one_plane {
            return anyhow();
        }
        let turn = self.pieces.b_to_a.rotation;
        let along = |axis: DVec3| match slack(axis) {
            slack if is_left(slack) => {
                self.fixed_plane_free_time(self.frames[0].rotation * axis, slack)
            }
            _ => FreeTime::NONE,
        };
        match (self.problem.a.body.facing(a), self.problem.b.body.facing(b)) {
            // The side to keep to is unknown, and the pieces are not let go.
            (Facing::Unclear, _) | (_, Facing::Unclear) => FreeTime::NONE,
            (Facing::OutwardNormal(n), Facing::OutwardNormal(m)) => match -(turn * m) {
                // The solids are on the same side of the plane: their faces slide, and cannot meet.
                into_b if n.dot(into_b) < 0.0 => {
                    let other = along(into_b);
                    along(n).or_longer(|_| other)
                }
                _ => along(n),
            },
            (Facing::OutwardNormal(n), Facing::NoOutwardSide) => along(n),
            (Facing::NoOutwardSide, Facing::OutwardNormal(m)) => along(-(turn * m)),
            (Facing::NoOutwardSide, Facing::NoOutwardSide) => anyhow(),
        }
    }
}

/// Converts a free time at clock `s` to a step; `None` if the time is too short for the clock to advance.
fn step_from_free_time(s: f64, free: FreeTime) -> Option<PairStep> {
    (free.clock_after(s) > s).then_some(PairStep::Free(free))
}

#[cfg(test)]
mod tests;
