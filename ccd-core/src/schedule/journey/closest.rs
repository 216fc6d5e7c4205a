//! The closest approach along trajectories.

use super::Journey;
use super::leg::{Leg, Span};
use super::stretches::Stretches;
use crate::distance::oracle::DistanceOracle;
use crate::error::InputError;
use crate::math::order::{greater, lesser};
use crate::outcome::{Answer, Contact, Limit, Overlap};
use crate::schedule::DepthFirst;
use crate::schedule::closest_approach::{Beyond, ClosestApproach};
use crate::tolerance::{COARSE, LEAST_CUT, STRAY_SHARE};

impl<O: DistanceOracle> DepthFirst<O> {
    /// Brackets the least distance of the bodies along their trajectories, to within the tolerance.
    ///
    /// # Guarantee
    /// That of [`ClosestApproach`], for the trajectories themselves; ends on every input.
    ///
    /// # Errors
    /// An [`InputError`] if a trajectory has no motion at some time, or one out of range.
    pub fn closest_approach_along(
        &mut self,
        journey: &Journey<'_>,
        oracle: &mut O,
    ) -> Result<Answer<ClosestApproach>, InputError> {
        let journey = &journey.measuring();
        let mut stretches = Stretches::new(journey);
        let mut found = Found {
            lower: f64::INFINITY,
            best: None,
        };
        while let Some(span) = stretches.next() {
            let (leg, config) = match stretches.leg(span)? {
                Ok(leg) => leg,
                Err(reason) => return Ok(found.unresolved(journey, &stretches, reason)),
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
            let problem = leg.problem(journey, &config)?;
            // As much farther as the motions' distance is not known.
            let beyond = found.upper() + leg.stray + 2.0 * problem.tolerance();
            let answer = self.approach_below(&problem, beyond, oracle);
            stretches.add(&answer.stats);
            let seen = match answer.outcome {
                Err(Beyond { lower }) => Seen {
                    lower,
                    upper: lower,
                    // Bodies beyond the least distance so far are so with their strays.
                    blur: 0.0,
                    time: 0.0,
                    approach: 0.0,
                },
                Ok(ClosestApproach::Overlapping { .. }) if stretches.look_at_start(&leg)? => {
                    continue;
                }
                Ok(outcome @ ClosestApproach::Overlapping { .. })
                    if stretches.begins_at_start(&leg)? =>
                {
                    return Ok(found.answer(journey, &stretches, outcome));
                }
                Ok(outcome) => match found.see(&leg, &outcome) {
                    Ok(seen) => seen,
                    Err(reason) => return Ok(found.unresolved(journey, &stretches, reason)),
                },
            };
            let lower = greater(0.0, leg.at_least(seen.lower));
            let (upper, tolerance) = (found.upper(), journey.config.tolerance);
            let is_loose = seen.is_loose(tolerance);
            if lower >= upper - tolerance || is_loose || stretches.is_fine(&leg)? {
                found.lower = lesser(found.lower, lower);
                stretches.prove(&leg);
            } else {
                if !self.cut_where_nearest(oracle, &leg, &seen, &mut found, &mut stretches)? {
                    return Ok(found.unresolved(journey, &stretches, Limit::Stalled));
                }
            }
            if found.upper() <= tolerance {
                found.lower = 0.0;
                break;
            }
        }
        let nearest = found.nearest(journey, &stretches);
        match nearest.outcome.meets_later(nearest.tolerance) {
            true => self.or_overlap_along(journey, oracle, nearest, &mut stretches),
            false => Ok(nearest),
        }
    }

    /// Returns the answer for bodies that meet, unless they overlap at the start as well.
    fn or_overlap_along(
        &mut self,
        journey: &Journey<'_>,
        oracle: &mut O,
        nearest: Answer<ClosestApproach>,
        stretches: &mut Stretches<'_, '_>,
    ) -> Result<Answer<ClosestApproach>, InputError> {
        let Some((pose, config)) = stretches.pose(0.0)? else {
            return Ok(nearest);
        };
        let start = self.closest_approach(&pose.problem(journey, &config)?, oracle);
        stretches.add(&start.stats);
        Ok(Answer {
            outcome: match start.outcome {
                overlapping @ ClosestApproach::Overlapping { .. } => overlapping,
                _ => nearest.outcome,
            },
            stats: stretches.stats,
            ..nearest
        })
    }

    /// Cuts a stretch where its motions are nearest; returns false if it cannot be cut.
    fn cut_where_nearest(
        &mut self,
        oracle: &mut O,
        leg: &Leg,
        seen: &Seen,
        found: &mut Found,
        stretches: &mut Stretches<'_, '_>,
    ) -> Result<bool, InputError> {
        let time = leg.time(seen.time);
        let Journey {
            config, duration, ..
        } = stretches.journey();
        // Halves will do, mostly, and cost less than a look.
        if leg.span.length() > COARSE * duration {
            return Ok(stretches.cut_about(leg.span, time, f64::INFINITY));
        }
        // Where they are nearest at an end, and still approach, they get nearer beyond it.
        if let Some(end) = seen.falls_beyond(leg)
            && let Some(beyond) = stretches.take_beside(end)
        {
            let is_cut = stretches.cut_about(leg.span, time, f64::INFINITY);
            stretches.push(beyond);
            return Ok(is_cut);
        }
        let length = match self.doubt(oracle, time, found, stretches)? {
            Some(doubt) => greater(doubt.length(leg), leg.length_for_rate(doubt.rate.abs())),
            None => leg.length_for(STRAY_SHARE * config.tolerance),
        };
        Ok(stretches.cut_about(leg.span, time, length))
    }

    /// Measures the bodies at a time; none if they overlap, or no work is left.
    fn doubt(
        &mut self,
        oracle: &mut O,
        time: f64,
        found: &mut Found,
        stretches: &mut Stretches<'_, '_>,
    ) -> Result<Option<Doubt>, InputError> {
        let Some((pose, config)) = stretches.pose(time)? else {
            return Ok(None);
        };
        let answer = self.closest_approach(&pose.problem(stretches.journey(), &config)?, oracle);
        stretches.stats.add(&answer.stats);
        let ClosestApproach::Nearest { contact, .. } = answer.outcome else {
            return Ok(None);
        };
        found.take(time, pose.contact(contact));
        let rounding = 2.0 * pose.stray;
        let least = greater(config.tolerance, rounding);
        Ok(Some(Doubt {
            stray: greater(least, contact.separation.upper - found.upper()),
            rate: -pose.approach(0.0, &contact),
        }))
    }
}

/// What the bodies' distance at a time says of stretches there.
struct Doubt {
    /// Strays below that leave none.
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
        match end > leg.span.from {
            true => self.rate <= 0.0,
            false => self.rate >= 0.0,
        }
    }
}

impl Journey<'_> {
    /// Returns the journey that asks for distances: the margin plays no role.
    fn measuring(&self) -> Self {
        let mut measuring = self.clone();
        measuring.config.margin = 0.0;
        measuring
    }
}

/// What a stretch shows: bounds of the distance of its motions.
struct Seen {
    lower: f64,
    upper: f64,
    /// By how much strays widen these bounds.
    blur: f64,
    /// The time in the stretch at which they are nearest.
    time: f64,
    /// The rate at which they approach then.
    approach: f64,
}

impl Seen {
    /// Returns true if f64 does not certify the tolerance for the motions: then cutting does not help.
    fn is_loose(&self, tolerance: f64) -> bool {
        let width = self.upper - self.lower;
        width > tolerance && self.blur <= width
    }

    /// Returns the end of the leg beyond which they get nearer by more than they stray.
    fn falls_beyond(&self, leg: &Leg) -> Option<f64> {
        let Span { from, to, .. } = leg.span;
        let (near, falls) = (
            LEAST_CUT * leg.span.length(),
            self.approach * leg.span.length(),
        );
        let time = leg.time(self.time);
        if time - from <= near && -falls > leg.stray {
            Some(from)
        } else if to - time <= near && falls > leg.stray {
            Some(to)
        } else {
            None
        }
    }
}

/// The least distance found so far.
struct Found {
    /// A lower bound on all stretches that are done.
    lower: f64,
    best: Option<(f64, Contact)>,
}

impl Found {
    fn upper(&self) -> f64 {
        let upper = |(_, contact): (f64, Contact)| contact.separation.upper;
        self.best.map_or(f64::INFINITY, upper)
    }

    /// Takes what the motions of a leg show.
    ///
    /// # Errors
    /// The limit that was reached.
    fn see(&mut self, leg: &Leg, outcome: &ClosestApproach) -> Result<Seen, Limit> {
        let mut seen = Seen {
            lower: 0.0,
            upper: 0.0,
            blur: leg.stray,
            time: 0.0,
            approach: 0.0,
        };
        match *outcome {
            ClosestApproach::Nearest {
                lower,
                time,
                contact,
            } => {
                self.take(leg.time(time), leg.contact(contact));
                seen.lower = lower;
                seen.upper = contact.separation.upper;
                seen.time = time;
                seen.approach = leg.approach(time, &contact);
            }
            ClosestApproach::Overlapping { overlap } => {
                if let Overlap::Pieces(contact) = overlap {
                    self.take(leg.span.from, leg.contact(contact));
                }
            }
            ClosestApproach::Unresolved { nearest, reason } => {
                if let Some((time, contact)) = nearest {
                    self.take(leg.time(time), leg.contact(contact));
                }
                return Err(reason);
            }
        }
        Ok(seen)
    }

    fn take(&mut self, time: f64, contact: Contact) {
        if contact.separation.upper < self.upper() {
            self.best = Some((time, contact));
        }
    }

    fn nearest(
        &self,
        journey: &Journey<'_>,
        stretches: &Stretches<'_, '_>,
    ) -> Answer<ClosestApproach> {
        let Some((time, contact)) = self.best else {
            return self.unresolved(journey, stretches, Limit::OracleGaveUp);
        };
        let lower = lesser(self.lower, contact.separation.upper);
        let nearest = ClosestApproach::Nearest {
            lower,
            time,
            contact: contact.no_nearer_than(lower),
        };
        self.answer(journey, stretches, nearest)
    }

    fn unresolved(
        &self,
        journey: &Journey<'_>,
        stretches: &Stretches<'_, '_>,
        reason: Limit,
    ) -> Answer<ClosestApproach> {
        let nearest = self
            .best
            .map(|(time, contact)| (time, contact.no_nearer_than(0.0)));
        let unresolved = ClosestApproach::Unresolved { nearest, reason };
        self.answer(journey, stretches, unresolved)
    }

    fn answer(
        &self,
        journey: &Journey<'_>,
        stretches: &Stretches<'_, '_>,
        outcome: ClosestApproach,
    ) -> Answer<ClosestApproach> {
        Answer {
            tolerance: greater(journey.config.tolerance, outcome.width()),
            outcome,
            stats: stretches.stats,
        }
    }
}
