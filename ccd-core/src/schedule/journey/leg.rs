//! One stretch of both trajectories, as a problem about motions.

use super::Journey;
use super::Travelling;
use crate::config::{Config, StartPolicy};
use crate::error::InputError;
use crate::limits::LEAST_TOLERANCE;
use crate::math::order::{greater, lesser};
use crate::motion::trajectory::Stretch;
use crate::outcome::{Contact, Separation};
use crate::problem::Problem;
use crate::tolerance::STRAY_SHARE;

/// A stretch of time.
#[derive(Clone, Copy, Debug)]
pub(super) struct Span {
    pub(super) from: f64,
    pub(super) to: f64,
}

/// The motions of both bodies in a stretch of time, and how far the bodies stray from them.
#[derive(Debug)]
pub(super) struct Leg {
    motions: [Stretch; 2],
    /// The sum of both strays.
    pub(super) stray: f64,
    pub(super) span: Span,
}

impl Leg {
    pub(super) fn new(journey: &Journey<'_>, span: Span) -> Result<Self, InputError> {
        let bodies = [&journey.a, &journey.b];
        let [a, b] = bodies.map(|body| body.trajectory.stretch(span.from, span.to));
        let motions = [a?, b?];
        let stray = |k: usize| motions[k].stray.at(reach(bodies[k], &motions[k]));
        Ok(Leg {
            stray: sum(stray(0), stray(1)),
            motions,
            span,
        })
    }

    /// Poses the problem of the motions: bodies that keep `margin` apart do so wherever they stray.
    pub(super) fn problem<'a>(
        &self,
        journey: &Journey<'a>,
        config: &Config,
    ) -> Result<Problem<'a>, InputError> {
        // A contact of the motions is one of the bodies where both stray towards each other.
        let least = (1.0 - 2.0 * STRAY_SHARE) * config.tolerance;
        let tolerance = match self.stray > 0.0 {
            true => greater(
                config.tolerance - 2.0 * self.stray,
                greater(least, LEAST_TOLERANCE),
            ),
            false => config.tolerance,
        };
        let config = Config {
            margin: config.margin + self.stray,
            tolerance,
            start: StartPolicy::Report,
            ..*config
        };
        let [a, b] = &self.motions;
        let problem = Problem::new(
            (journey.a.body, a.motion),
            (journey.b.body, b.motion),
            self.span.to - self.span.from,
            &config,
        )?;
        Ok(match &journey.stop {
            Some(stop) => problem.stopped_by(stop),
            None => problem,
        })
    }

    /// Returns what a distance of the motions says of the bodies where they stray.
    pub(super) fn at_least(&self, distance: f64) -> f64 {
        match self.stray > 0.0 {
            true => (distance - self.stray).next_down(),
            false => distance,
        }
    }

    /// Returns a time of the journey, rounded so that it is never late.
    pub(super) fn time(&self, time: f64) -> f64 {
        let Span { from, to } = self.span;
        match from > 0.0 {
            true => lesser(greater(from, (from + time).next_down()), to),
            false => time,
        }
    }

    /// Returns the contact with bounds that hold for the bodies where they stray.
    pub(super) fn contact(&self, contact: Contact) -> Contact {
        let Separation { lower, upper, .. } = contact.separation;
        Contact {
            separation: Separation {
                lower: self.at_least(lower),
                upper: sum(upper, self.stray),
                ..contact.separation
            },
            ..contact
        }
    }
}

/// Bounds the distance of a body's points from the centre of a stretch's motion.
fn reach(travelling: &Travelling<'_>, stretch: &Stretch) -> f64 {
    let (centre, radius) = travelling.body.tree().ball();
    centre.distance(stretch.motion.centre()) * (1.0 + f64::EPSILON) + radius
}

/// Returns a sum, rounded up; nothing added is exact.
fn sum(a: f64, b: f64) -> f64 {
    match b > 0.0 && a != 0.0 {
        true => (a + b).next_up(),
        false => a + b,
    }
}
