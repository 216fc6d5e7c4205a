//! Computes the first and the last contact along trajectories.

use super::contacts::first_contact;
use crate::answer::{Answer, Hit, Outcome, Unresolved};
use crate::distance::oracle::DistanceOracle;
use crate::engine::best_first::BestFirst;
use crate::error::InputError;
use crate::math::order::{greater, lesser};
use crate::math::vector::length;
use crate::motion::Motion;
use crate::motion::trajectory::{DeviationBound, Stretch, Trajectory};
use crate::query::{Movement, Query};
use crate::rounding::UNIT_ROUNDOFF_F64;
use std::time::Instant;

impl<O: DistanceOracle> BestFirst<O> {
    /// Finds when the bodies first and last touch along their trajectories. The last contact is the first contact of
    /// the reversed trajectories.
    ///
    /// # Guarantee
    /// The guarantee of [`Outcome`], for the trajectories themselves; ends on every input.
    ///
    /// # Errors
    /// An [`InputError`] if a trajectory has no motion at some time, or one out of range.
    pub fn contact_interval(
        &mut self,
        query: &Query<'_>,
        oracle: &mut O,
    ) -> Result<Answer, InputError> {
        let duration = query.duration;
        let begun = query.settings.deadline.map(|_| Instant::now());
        let first = first_contact(self, query, oracle)?;
        let answer = |outcome, of: &Answer| Answer {
            outcome,
            tolerance: greater(first.tolerance, of.tolerance),
            stats: of.stats,
        };
        let begins = match first.outcome.hit() {
            Ok(Some(hit)) => hit,
            Ok(None) => return Ok(first),
            Err(known) => {
                let unresolved = Outcome::Unresolved(Unresolved {
                    safe_from: duration,
                    ..known
                });
                return Ok(answer(unresolved, &first));
            }
        };
        let [a, b] = [&query.a, &query.b].map(|moving| ReversedTrajectory {
            original: moving.movement,
            duration,
        });
        let mut back = Query {
            a: (query.a.body, Movement::Trajectory(&a)).into(),
            b: (query.b.body, Movement::Trajectory(&b)).into(),
            constant_velocity_problem: None,
            ..*query
        };
        if let (Some(deadline), Some(begun)) = (&mut back.settings.deadline, begun) {
            *deadline = deadline.saturating_sub(begun.elapsed());
        }
        let mut last = first_contact(self, &back, oracle)?;
        last.stats.add(&first.stats);
        // Rounded so that it is never early.
        let time = |time: f64| lesser((duration - time).next_up(), duration);
        let outcome = match last.outcome.hit() {
            Ok(Some(hit)) if time(hit.time) > begins.time => Outcome::Interval {
                first: begins,
                last: Hit {
                    time: time(hit.time),
                    ..hit
                },
            },
            // A contact that is found in only one direction of time is a near miss.
            Ok(_) => Outcome::Interval {
                first: begins,
                last: begins,
            },
            Err(known) => Outcome::Unresolved(Unresolved {
                safe_until: begins.time,
                safe_from: time(known.safe_until),
                ..known
            }),
        };
        Ok(answer(outcome, &last))
    }
}

/// A trajectory that runs backward in time, from its end to its start.
struct ReversedTrajectory<'t> {
    original: Movement<'t>,
    duration: f64,
}

impl ReversedTrajectory<'_> {
    fn reversed_time(&self, time: f64) -> f64 {
        greater(0.0, self.duration - time)
    }
}

impl Trajectory for ReversedTrajectory<'_> {
    fn stretch_between(&self, from: f64, to: f64) -> Result<Stretch, InputError> {
        let (first, last) = (self.reversed_time(to), self.reversed_time(from));
        let stretch = self.original.stretch_between(first, last)?;
        let end = stretch.with_time_origin(last - first)?;
        // Times are rounded. The shift is the distance that the body moves in the rounding of a time.
        let off = 2.0 * UNIT_ROUNDOFF_F64 * self.duration;
        let [before, after] = [stretch, end].map(|stretch| length(stretch.motion.velocity()));
        let moved = DeviationBound {
            // The speed is largest at an end.
            center_deviation: greater(before, after) * off,
            max_deviation_angle: length(stretch.motion.angular_velocity()) * off,
        };
        let rounding = end.rounding_of_moved_start(last - first);
        let Stretch { motion, .. } = end;
        let [velocity, spin] = [-motion.velocity(), -motion.angular_velocity()];
        Ok(Stretch {
            motion: Motion::about(motion.start(), velocity, spin, motion.center())?,
            deviation_bound: end.deviation_bound + moved + rounding,
            ..end
        })
    }

    fn velocity_jump_time(&self, from: f64, to: f64) -> Option<f64> {
        let corner = self
            .original
            .velocity_jump_time(self.reversed_time(to), self.reversed_time(from))?;
        Some(self.duration - corner)
    }
}
