//! Advances one pair of pieces: checks the oracle's claim, and computes a new clock.

use super::level::TouchingPlaneState;
use super::snapshot::Snapshot;
use crate::answer::{Contact, Separation};
use crate::body::piece::ConvexCombination;
use crate::distance::oracle::DistanceOracle;
use crate::distance::overlap::{self, Intersection};
use crate::distance::separation::CheckedClaim;
use crate::distance::separation::sharp::improve_axis;
use crate::engine::meter::Meter;
use crate::math::vector::unit;
use crate::motion::free_time::FreeTime;
use crate::problem::{BodyWithPath, Problem};
use crate::rounding::MIN_APPROACH_PER_ROUNDING;
use crate::settings::StartPolicy;
use glam::DVec3;
use std::ops::ControlFlow::{self, Break, Continue};

/// A pair of pieces with a clock of its own.
#[derive(Clone, Debug)]
pub(crate) struct Pair<C> {
    pub(crate) a: u32,
    pub(crate) b: u32,
    contact_rule: ContactRule,
    /// Whether the pair has been advanced before. The first time uses [`Snapshot::first_visit_free_time`].
    was_advanced: bool,
    /// What the oracle remembers for its next call on this pair.
    cache: C,
}

/// The rule by which a pair counts as in contact, and the gap that it is proven to keep until its clock.
#[derive(Clone, Copy, Debug, PartialEq)]
enum ContactRule {
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
    /// The pair is certified apart until this clock, which is later than before. A clock beyond 1 means forever.
    FreeUntil(f64),
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

impl<C: Default + Clone> Pair<C> {
    pub(crate) fn new(a: u32, b: u32) -> Self {
        Pair {
            a,
            b,
            contact_rule: ContactRule::ApartAtStart,
            was_advanced: false,
            cache: C::default(),
        }
    }

    /// Examines the pair at clock `s`, up to which it is certified apart, and certifies it further.
    pub(crate) fn advance<O: DistanceOracle<Cache = C>>(
        &mut self,
        problem: &Problem<'_>,
        oracle: &mut O,
        meter: &mut Meter,
        s: f64,
    ) -> PairStep {
        let snapshot = Snapshot::new(problem, self.a, self.b, s);
        let known = std::mem::replace(&mut self.was_advanced, true);
        self.advance_with_free_time(&snapshot, oracle, meter, |snapshot, checked, kept| {
            if known {
                snapshot.free_time(checked, kept)
            } else {
                snapshot.first_visit_free_time(checked, kept)
            }
        })
    }

    /// Like [`Pair::advance`], with a given snapshot and another function for the free time. Pairs in contact at the
    /// start use the usual free time.
    pub(crate) fn advance_with_free_time<O: DistanceOracle<Cache = C>>(
        &mut self,
        snapshot: &Snapshot<'_>,
        oracle: &mut O,
        meter: &mut Meter,
        free_time: impl FnOnce(&Snapshot<'_>, &CheckedClaim, f64) -> FreeTime,
    ) -> PairStep {
        let Some(checked) = snapshot.query_oracle(oracle, &mut self.cache, meter) else {
            return PairStep::GaveUp;
        };
        if let Break(found) = self.choose_rule(snapshot, &checked, oracle, meter) {
            return found;
        }
        let step = match self.contact_rule {
            ContactRule::ApartAtStart | ContactRule::SeparatedAfterStart => {
                self.step_apart(snapshot, &checked, free_time)
            }
            ContactRule::InContactAtStart { floor } => {
                self.step_in_contact_at_start(snapshot, &checked, floor)
            }
            ContactRule::TouchingPlane(plane) => {
                let free = snapshot.touching_plane_free_time(&plane, checked.witness_a);
                step_from_free_time(snapshot.clock, free)
                    .unwrap_or_else(|| self.contact(snapshot, &checked))
            }
        };
        meter.stats.point_evaluations += snapshot.evaluations();
        step
    }

    /// Chooses the rule of the pair at its present distance. Breaks off if the pair is in contact by it.
    fn choose_rule<O: DistanceOracle<Cache = C>>(
        &mut self,
        snapshot: &Snapshot<'_>,
        checked: &CheckedClaim,
        oracle: &mut O,
        meter: &mut Meter,
    ) -> ControlFlow<PairStep> {
        let problem = snapshot.problem;
        let apart = problem.contact_distance();
        // Written so that NaN is no contact: without a gap, it has no free time either.
        if !(checked.upper <= apart) {
            if checked.lower > apart && self.contact_rule != ContactRule::ApartAtStart {
                self.contact_rule = ContactRule::SeparatedAfterStart;
            }
            return Continue(());
        }
        if snapshot.clock == 0.0 {
            self.check_overlap_at_start(snapshot, checked, meter)?;
        }
        let beside_plane = || {
            let plane = self.touching_plane_state(snapshot, checked.witness_a)?;
            Some(ContactRule::TouchingPlane(plane))
        };
        let rule = match self.contact_rule {
            ContactRule::ApartAtStart => self
                .rule_ignoring_start_contact(problem, oracle, meter)
                .or_else(beside_plane),
            ContactRule::SeparatedAfterStart => beside_plane(),
            ContactRule::InContactAtStart { .. } | ContactRule::TouchingPlane(_) => {
                Some(self.contact_rule)
            }
        };
        match rule {
            Some(rule) => {
                self.contact_rule = rule;
                Continue(())
            }
            None => Break(self.contact(snapshot, checked)),
        }
    }

    /// Breaks off if the pieces intersect at the start, or if that is undecided.
    fn check_overlap_at_start(
        &self,
        snapshot: &Snapshot<'_>,
        checked: &CheckedClaim,
        meter: &mut Meter,
    ) -> ControlFlow<PairStep> {
        let memory = &mut meter.scratch_memory().expanding_polytope;
        let rounding = snapshot.problem.rounding;
        match overlap::decide_intersection(&snapshot.pieces, checked, rounding, memory) {
            Intersection::Certain => {
                Break(PairStep::Overlap(contact(snapshot, self.pieces(), checked)))
            }
            // The search for the nearest pieces decides this.
            Intersection::Undecided => Break(self.contact(snapshot, checked)),
            Intersection::None => Continue(()),
        }
    }

    /// Advances a pair that was apart.
    fn step_apart(
        &mut self,
        snapshot: &Snapshot<'_>,
        checked: &CheckedClaim,
        free_time: impl FnOnce(&Snapshot<'_>, &CheckedClaim, f64) -> FreeTime,
    ) -> PairStep {
        let problem = snapshot.problem;
        let kept = problem.kept_gap();
        // The axis of the claim may lose all of the gap that is left to advance by. Written so that NaN counts as
        // such a loss.
        let checked = if checked.lower > kept + problem.rounding {
            *checked
        } else {
            improve_axis(&snapshot.pieces, checked, problem.rounding)
        };
        let free = free_time(snapshot, &checked, kept);
        step_from_free_time(snapshot.clock, free)
            .or_else(|| self.step_beside_plane(snapshot, snapshot, &checked))
            .unwrap_or(PairStep::Stalled)
    }

    /// Advances a pair that was in contact at the start, and keeps the gap `floor`.
    fn step_in_contact_at_start(
        &mut self,
        snapshot: &Snapshot<'_>,
        checked: &CheckedClaim,
        floor: f64,
    ) -> PairStep {
        let problem = snapshot.problem;
        let checked = improve_axis(&snapshot.pieces, checked, problem.rounding);
        let free = snapshot.free_time_when_touching(&checked, floor, self.pieces());
        step_from_free_time(snapshot.clock, free)
            .or_else(|| {
                let start = Snapshot::new(problem, self.a, self.b, 0.0);
                self.step_beside_plane(&start, snapshot, &checked)
            })
            .unwrap_or_else(|| self.contact(snapshot, &checked))
    }

    /// Advances a pair that the plane of the contact at the start keeps apart, with the body that is chosen at the
    /// snapshot `chosen_at`; `None` if it does not.
    fn step_beside_plane(
        &mut self,
        chosen_at: &Snapshot<'_>,
        snapshot: &Snapshot<'_>,
        checked: &CheckedClaim,
    ) -> Option<PairStep> {
        let plane = self.touching_plane_state(chosen_at, checked.witness_a)?;
        self.contact_rule = ContactRule::TouchingPlane(plane);
        let free = snapshot.touching_plane_free_time(&plane, checked.witness_a);
        step_from_free_time(snapshot.clock, free)
    }

    /// Returns the plane of the contact at the start with the body that it moves with, if it keeps the pair apart.
    fn touching_plane_state(
        &self,
        snapshot: &Snapshot<'_>,
        from: DVec3,
    ) -> Option<TouchingPlaneState> {
        let plane = snapshot.problem.touching_plane.as_ref()?;
        snapshot.choose_plane_state(plane, self.pieces(), from)
    }

    fn pieces(&self) -> [u32; 2] {
        [self.a, self.b]
    }

    fn contact(&self, snapshot: &Snapshot<'_>, checked: &CheckedClaim) -> PairStep {
        PairStep::Contact(contact(snapshot, self.pieces(), checked))
    }

    /// Returns the rule for a pair that is in contact at the start, if that contact is to be ignored; `None` if it
    /// counts.
    fn rule_ignoring_start_contact<O: DistanceOracle<Cache = C>>(
        &self,
        problem: &Problem<'_>,
        oracle: &mut O,
        meter: &mut Meter,
    ) -> Option<ContactRule> {
        if problem.start_policy == StartPolicy::Report {
            return None;
        }
        let snapshot = Snapshot::new(problem, self.a, self.b, 0.0);
        let start = snapshot.query_oracle(oracle, &mut C::default(), meter)?;
        let start = improve_axis(&snapshot.pieces, &start, problem.rounding);
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

/// Converts a free time at clock `s` to a step; `None` if the time is too short for the clock to advance.
fn step_from_free_time(s: f64, free: FreeTime) -> Option<PairStep> {
    match free {
        FreeTime::ToEnd => Some(PairStep::FreeUntil(f64::INFINITY)),
        FreeTime::AtLeast(tau) => {
            let next = (s + tau).next_down();
            (next > s).then_some(PairStep::FreeUntil(next))
        }
    }
}

/// Converts a checked pair to a contact in world coordinates, with its features.
pub(crate) fn contact(
    snapshot: &Snapshot<'_>,
    [a, b]: [u32; 2],
    checked: &CheckedClaim,
) -> Contact {
    let (problem, a_to_world) = (snapshot.problem, &snapshot.frames[0]);
    let world = |x: DVec3| problem.to_world_point(a_to_world.transform_point(x));
    let feature = |side: &BodyWithPath<'_>, piece: u32, point: &ConvexCombination| {
        side.body.feature(piece, point)
    };
    Contact {
        separation: Separation {
            lower: checked.lower,
            upper: checked.upper,
            normal: unit(a_to_world.rotation * checked.axis).unwrap_or(checked.axis),
            witness_a: world(checked.witness_a),
            witness_b: world(checked.witness_b),
        },
        feature_a: feature(&problem.a, a, &checked.claim.a),
        feature_b: feature(&problem.b, b, &checked.claim.b),
        piece_a: problem.a.index_in_given_body(a),
        piece_b: problem.b.index_in_given_body(b),
    }
}

#[cfg(test)]
mod tests;
