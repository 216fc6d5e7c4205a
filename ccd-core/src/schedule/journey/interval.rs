//! The first and the last contact along trajectories.

use super::Journey;
use super::first::contact_of;
use crate::distance::oracle::DistanceOracle;
use crate::error::InputError;
use crate::math::order::{greater, lesser};
use crate::math::vector::length;
use crate::motion::Motion;
use crate::motion::trajectory::{Stray, Stretch, Trajectory};
use crate::outcome::{Answer, Contact, Limit, Outcome, Overlap};
use crate::schedule::BestFirst;
use crate::tolerance::U64;
use std::time::Instant;

/// The answer to "from when until when are they in contact?".
///
/// # Guarantee
/// The bodies do not touch before the first time nor after the last, in floating point as well.
#[derive(Clone, Copy, Debug, PartialEq)]
#[allow(
    clippy::large_enum_variant,
    reason = "one answer at a time: a box would cost more than the bytes"
)]
pub enum ContactInterval {
    /// The bodies stay apart over the whole duration.
    Free {
        /// As in [`Outcome::Free`].
        proven_gap: f64,
    },
    /// The bodies are within margin + tolerance at the first time and at the last. In between they may part.
    Within {
        /// The first contact.
        first: Touch,
        /// The last contact.
        last: Touch,
    },
    /// A limit was reached before an answer.
    Unresolved {
        /// The bodies do not touch before this time, certified.
        safe_until: f64,
        /// The bodies do not touch after this time, certified.
        safe_from: f64,
        /// The limit.
        reason: Limit,
    },
}

/// A contact at a time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Touch {
    /// The time.
    pub time: f64,
    /// The pieces in contact; none if one body is inside the other without two pieces that intersect.
    pub contact: Option<Contact>,
    /// The proof, if the bodies overlap: of a first contact at the start, of a last one at the end.
    pub overlap: Option<Overlap>,
}

impl<O: DistanceOracle> BestFirst<O> {
    /// Answers when the bodies first and last touch along their trajectories: the last contact is the first one
    /// of the trajectories in reverse.
    ///
    /// # Guarantee
    /// That of [`ContactInterval`], for the trajectories themselves; ends on every input.
    ///
    /// # Errors
    /// An [`InputError`] if a trajectory has no motion at some time, or one out of range.
    pub fn contact_interval_along(
        &mut self,
        journey: &Journey<'_>,
        oracle: &mut O,
    ) -> Result<Answer<ContactInterval>, InputError> {
        let duration = journey.duration;
        let begun = journey.config.deadline.map(|_| Instant::now());
        let first = self.first_contact_along(journey, oracle)?;
        let answer = |outcome, of: &Answer| Answer {
            outcome,
            tolerance: greater(first.tolerance, of.tolerance),
            stats: of.stats,
        };
        let begins = match touch(&first.outcome) {
            Seen::At(touch) => touch,
            Seen::Never { proven_gap } => {
                return Ok(answer(ContactInterval::Free { proven_gap }, &first));
            }
            Seen::Unknown { safe_until, reason } => {
                let unresolved = ContactInterval::Unresolved {
                    safe_until,
                    safe_from: duration,
                    reason,
                };
                return Ok(answer(unresolved, &first));
            }
        };
        let [a, b] = [&journey.a, &journey.b].map(|travelling| Reversed {
            of: travelling.trajectory,
            duration,
        });
        let mut back = journey.clone();
        back.a.trajectory = &a;
        back.b.trajectory = &b;
        if let (Some(deadline), Some(begun)) = (&mut back.config.deadline, begun) {
            *deadline = deadline.saturating_sub(begun.elapsed());
        }
        let mut last = self.first_contact_along(&back, oracle)?;
        last.stats.add(&first.stats);
        // Rounded so that it is never early.
        let time = |time: f64| lesser((duration - time).next_up(), duration);
        let outcome = match touch(&last.outcome) {
            Seen::At(touch) if time(touch.time) > begins.time => ContactInterval::Within {
                first: begins,
                last: Touch {
                    time: time(touch.time),
                    ..touch
                },
            },
            // What was seen the one way, and not the other, is a near miss.
            Seen::At(_) | Seen::Never { .. } => ContactInterval::Within {
                first: begins,
                last: begins,
            },
            Seen::Unknown { safe_until, reason } => ContactInterval::Unresolved {
                safe_until: begins.time,
                safe_from: time(safe_until),
                reason,
            },
        };
        Ok(answer(outcome, &last))
    }
}

/// What an outcome says of the first contact.
#[allow(
    clippy::large_enum_variant,
    reason = "one at a time: a box would cost more than the bytes"
)]
enum Seen {
    At(Touch),
    Never { proven_gap: f64 },
    Unknown { safe_until: f64, reason: Limit },
}

fn touch(outcome: &Outcome) -> Seen {
    let at = |time, contact| {
        Seen::At(Touch {
            time,
            contact: Some(contact),
            overlap: None,
        })
    };
    match *outcome {
        Outcome::Contact { time, contact } => at(time, contact),
        Outcome::Touching { contact } => at(0.0, contact),
        Outcome::Overlapping { overlap } => Seen::At(Touch {
            time: 0.0,
            contact: contact_of(&overlap),
            overlap: Some(overlap),
        }),
        Outcome::Free { proven_gap } => Seen::Never { proven_gap },
        Outcome::Unresolved { safe_until, reason } => Seen::Unknown { safe_until, reason },
    }
}

/// A trajectory from its end to its start.
struct Reversed<'t> {
    of: &'t dyn Trajectory,
    duration: f64,
}

impl Reversed<'_> {
    fn time(&self, time: f64) -> f64 {
        greater(0.0, self.duration - time)
    }
}

impl Trajectory for Reversed<'_> {
    fn stretch(&self, from: f64, to: f64) -> Result<Stretch, InputError> {
        let (first, last) = (self.time(to), self.time(from));
        let stretch = self.of.stretch(first, last)?;
        let end = stretch.started(last - first)?;
        // Times are rounded, by as much as the bodies move in that.
        let off = 2.0 * U64 * self.duration;
        let [before, after] = [stretch, end].map(|stretch| length(stretch.motion.velocity()));
        let moved = Stray {
            // The speed is largest at an end.
            shift: greater(before, after) * off,
            turn: length(stretch.motion.spin()) * off,
        };
        let rounding = end.rounding_of_start(last - first);
        let Stretch { motion, .. } = end;
        let [velocity, spin] = [-motion.velocity(), -motion.spin()];
        Ok(Stretch {
            motion: Motion::about(motion.start(), velocity, spin, motion.centre())?,
            stray: end.stray + moved + rounding,
            ..end
        })
    }

    fn corner(&self, from: f64, to: f64) -> Option<f64> {
        let corner = self.of.corner(self.time(to), self.time(from))?;
        Some(self.duration - corner)
    }
}
