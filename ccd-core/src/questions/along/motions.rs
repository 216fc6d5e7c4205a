//! The approximate motions of both bodies in a stretch of time, and the problem that a search of the stretch solves.

use crate::answer::{Contact, Separation};
use crate::error::InputError;
use crate::limits::{LEAST_TOLERANCE, MAX_COORDINATE};
use crate::math::order::{greater, lesser};
use crate::math::vector::length;
use crate::motion::span::Span;
use crate::motion::trajectory::{Stretch, Trajectory};
use crate::problem::Problem;
use crate::query::Query;
use crate::rounding::RETIMED_POSE_ERROR_F64;
use crate::settings::{QuerySettings, StartPolicy};
use crate::tuning::{MAX_CUT_LENGTH_SHARE, MAX_DEVIATION_SHARE, MIN_TOLERANCE_PER_DEVIATION};
use glam::DVec3;

/// The approximate motions of both bodies in a stretch of time, with their deviations.
#[derive(Debug)]
pub(super) struct StretchMotions {
    pub(super) stretches: [Stretch; 2],
    /// The sum of the deviations of both bodies.
    pub(super) total_deviation_bound: f64,
    pub(super) span: Span,
}

impl StretchMotions {
    pub(super) fn new(query: &Query<'_>, span: Span) -> Result<Self, InputError> {
        let bodies = [&query.a, &query.b];
        let [a, b] = bodies.map(|body| body.movement.stretch_between(span.from, span.end));
        let stretches = [a?, b?];
        let stray = |k: usize| {
            let center = stretches[k].motion.center();
            let reach = bodies[k].body.tree().max_distance_from(center);
            stretches[k].deviation_bound.at_reach(reach)
        };
        Ok(StretchMotions {
            total_deviation_bound: rounded_up_sum(stray(0), stray(1)),
            stretches,
            span,
        })
    }

    /// Removes the accelerations, and increases the deviations by the displacements that the accelerations cause.
    pub(super) fn without_accelerations(mut self) -> Self {
        let time = self.span.length();
        for stretch in &mut self.stretches {
            let far = 0.5 * (time * (time * length(stretch.acceleration)));
            self.total_deviation_bound = rounded_up_sum(
                self.total_deviation_bound,
                far * (1.0 + RETIMED_POSE_ERROR_F64),
            );
            stretch.acceleration = DVec3::ZERO;
        }
        self
    }

    /// Returns whether the deviations, and bounds of the displacements by acceleration, are each at most
    /// `MAX_COORDINATE` minus the margin.
    pub(super) fn is_in_coordinate_range(&self, query: &Query<'_>) -> bool {
        let time = self.span.length();
        let far = |stretch: &Stretch| time * (time * length(stretch.acceleration));
        let [a, b] = &self.stretches;
        let most = MAX_COORDINATE - query.settings.margin;
        // Written so that NaN is too much.
        self.total_deviation_bound >= 0.0
            && self.total_deviation_bound <= most
            && far(a) <= most
            && far(b) <= most
    }

    /// Estimates how long a stretch of time may be for its motions to deviate so far from the trajectories. Deviations shrink with a power of the length.
    pub(super) fn stretch_length_for_deviation(&self, stray: f64) -> f64 {
        self.span.length()
            * (stray / self.total_deviation_bound).powf(1.0 / self.deviation_exponent())
    }

    /// Estimates the length of the stretch whose deviation is `MAX_DEVIATION_SHARE` times its change of distance, if the
    /// distance changes at `rate`.
    pub(super) fn stretch_length_for_rate(&self, rate: f64) -> f64 {
        let whole = self.span.length();
        whole
            * (MAX_DEVIATION_SHARE * rate * whole / self.total_deviation_bound)
                .powf(1.0 / (self.deviation_exponent() - 1.0))
    }

    /// Returns the exponent `p` such that deviations grow like the `p`-th power of a stretch's length.
    fn deviation_exponent(&self) -> f64 {
        let accelerates = |stretch: &Stretch| stretch.acceleration != DVec3::ZERO;
        if self.stretches.iter().any(accelerates) {
            3.0
        } else {
            2.0
        }
    }

    /// Returns whether it is worthwhile to cut the stretch down to a length, which has to be much shorter.
    pub(super) fn is_worth_a_cut(&self, length: f64) -> bool {
        length < MAX_CUT_LENGTH_SHARE * self.span.length()
    }

    /// Returns the rate at which the bodies approach each other at a contact of the motions.
    pub(super) fn approach_rate(&self, time: f64, contact: &Contact) -> f64 {
        let (seen, [a, b]) = (contact.separation, &self.stretches);
        seen.normal
            .dot(a.velocity_at(seen.witness_a, time) - b.velocity_at(seen.witness_b, time))
    }

    /// Creates the problem that a search of the stretch solves: the approximate motions, with a larger margin and a
    /// smaller tolerance. Whatever the deviations are, the bodies keep the gap that a query about one motion proves:
    /// half the tolerance beyond the margin.
    pub(super) fn problem<'a>(
        &self,
        query: &Query<'a>,
        terms: &QuerySettings<'a>,
    ) -> Result<Problem<'a>, InputError> {
        let tolerance = self.motion_tolerance(terms.tolerance);
        // Both tolerances have the same middle: the gap that is proven.
        let beyond = 0.5 * greater(terms.tolerance - tolerance, 0.0);
        let terms = QuerySettings {
            margin: terms.margin + beyond + self.total_deviation_bound,
            tolerance,
            start: StartPolicy::Report,
            ..*terms
        };
        let [a, b] = &self.stretches;
        Problem::with_accelerations(
            [(query.a.body, a.motion), (query.b.body, b.motion)],
            [a.acceleration, b.acceleration],
            self.span.length(),
            &terms,
        )
    }

    /// Returns the tolerance for the motions: the tolerance for the bodies minus four times the deviations, or a least
    /// tolerance if too little is left. Two deviations are lost on either side of its middle: for the gap that the
    /// motions keep, and for the contact that they show.
    fn motion_tolerance(&self, whole: f64) -> f64 {
        // Written so that without deviations the result is the whole tolerance, to the last bit.
        let left = whole - 4.0 * self.total_deviation_bound;
        if self.total_deviation_bound == 0.0 || left >= (1.0 - 4.0 * MAX_DEVIATION_SHARE) * whole {
            return left;
        }
        // Too little is left for a contact. Distances blurred by deviations need not be known better.
        let least = greater(
            (1.0 - 4.0 * MAX_DEVIATION_SHARE) * whole,
            MIN_TOLERANCE_PER_DEVIATION * self.total_deviation_bound,
        );
        greater(least, LEAST_TOLERANCE)
    }

    /// Converts a distance between the approximate motions to a lower bound of the bodies' distance: subtracts the
    /// deviations.
    pub(super) fn lower_bound_for_bodies(&self, distance: f64) -> f64 {
        if self.total_deviation_bound > 0.0 {
            (distance - self.total_deviation_bound).next_down()
        } else {
            distance
        }
    }

    /// Converts a time of the stretch to a time of the query, rounded so that it is never late.
    pub(super) fn query_time(&self, time: f64) -> f64 {
        let Span { from, end: to, .. } = self.span;
        if from > 0.0 {
            lesser(greater(from, (from + time).next_down()), to)
        } else {
            time
        }
    }

    /// Widens the bounds of a contact of the motions so that they hold for the bodies.
    pub(super) fn widen_separation_bounds(&self, contact: Contact) -> Contact {
        let Separation { lower, upper, .. } = contact.separation;
        let upper = rounded_up_sum(upper, self.total_deviation_bound);
        contact.with_bounds(self.lower_bound_for_bodies(lower), upper)
    }
}

/// Returns the sum of two numbers, rounded up; it is exact if either number is zero.
fn rounded_up_sum(a: f64, b: f64) -> f64 {
    if b > 0.0 && a != 0.0 {
        (a + b).next_up()
    } else {
        a + b
    }
}
