//! Checks answers to questions other than that of the first contact.

use super::{CheckResult, Judge, check_contact};
use crate::law;
use crate::query::Bodies;
use crate::referee::Finding;
use ccd_core::order::lesser;
use ccd_core::{Answer, ClearanceVerdict, Contact, Outcome};

impl Judge<'_> {
    /// Checks an answer to whether the bodies touch at all: no contact is missed or false, and the contact is as
    /// claimed.
    ///
    /// # Errors
    /// Describes how the answer is wrong.
    pub fn check_any_contact(&self, answer: &Answer, bodies: &Bodies) -> CheckResult {
        match answer.outcome {
            Outcome::Contact { time, contact } => {
                self.check_near_contact(time, answer.tolerance, &contact)?;
                check_contact(
                    self.query,
                    time,
                    &contact,
                    bodies,
                    self.contact_distance_bound(time, answer.tolerance, &contact),
                )
            }
            Outcome::Free { .. } | Outcome::Overlapping { .. } => self.check(answer, bodies),
            Outcome::Unresolved(_) => Err("unresolved".into()),
            other => Err(format!("no outcome of any contact: {other:?}")),
        }
    }

    /// Checks the bounds of the least distance against the referee. The lower bound is not above the true least
    /// distance, the upper bound not below the distance at the given time, and they differ by at most the tolerance.
    ///
    /// # Errors
    /// Describes how the answer is wrong.
    pub fn check_closest_approach(&self, answer: &Answer, bodies: &Bodies) -> CheckResult {
        let rounding = self.query.rounding();
        let (lower, upper) = (answer.outcome.lower(), answer.outcome.upper());
        match answer.outcome {
            Outcome::LeastDistance { time, contact, .. } => {
                let least = self.least_found_distance();
                law!(
                    lower <= least + rounding,
                    "lower {lower} is above the least distance {least}"
                );
                let gap = self.referee.gap(time);
                law!(
                    gap <= upper + rounding || self.may_overlap(time, &contact),
                    "upper {upper} is below the distance {gap} at {time}"
                );
                law!(
                    upper - lower <= answer.tolerance,
                    "{lower} and {upper} are more than {} apart",
                    answer.tolerance
                );
                law!(
                    !self.are_nested || lower <= rounding,
                    "lower {lower}, but one body is inside the other"
                );
                check_contact(self.query, time, &contact, bodies, f64::INFINITY)
            }
            Outcome::Overlapping { .. } => self.check(answer, bodies),
            Outcome::Free { .. } | Outcome::Contact { .. } => {
                Err("compared with a clearance, without one".into())
            }
            Outcome::Unresolved(_) => Err("unresolved".into()),
            other => Err(format!("no outcome of a least distance: {other:?}")),
        }
    }

    /// Checks an answer about a required distance: its bounds are true, and it is undecided only within the tolerance
    /// of the least distance.
    ///
    /// # Errors
    /// Describes how the answer is wrong.
    pub fn check_clearance(
        &self,
        (required, answer): &(f64, Answer),
        bodies: &Bodies,
    ) -> CheckResult {
        let required = *required;
        let rounding = self.query.rounding();
        let outcome = &answer.outcome;
        let least = self.least_found_distance();
        let (lower, upper) = (outcome.lower(), outcome.upper());
        law!(
            lower <= least + rounding,
            "lower {lower} is above the least distance {least}"
        );
        law!(
            !self.are_nested || lower <= rounding,
            "lower {lower}, but one body is inside the other"
        );
        match outcome {
            Outcome::Unresolved(_) => return Err("unresolved".into()),
            Outcome::Overlapping { .. } => return self.check(answer, bodies),
            _ => {}
        }
        if let Some((time, contact)) = outcome.nearest_contact() {
            let gap = self.referee.gap(time);
            law!(
                gap <= upper + rounding || self.may_overlap(time, &contact),
                "upper {upper} is below the distance {gap} at {time}"
            );
        }
        law!(
            outcome.clearance_verdict(required) != ClearanceVerdict::Unverified
                || upper - lower <= answer.tolerance && upper <= required + answer.tolerance,
            "{required} is not verified within {lower} and {upper}"
        );
        Ok(())
    }

    /// Checks the first and the last contact: no contact is before the first or after the last one, and both are within
    /// the tolerance.
    ///
    /// # Errors
    /// Describes how the answer is wrong.
    pub fn check_contact_interval(&self, answer: &Answer, bodies: &Bodies) -> CheckResult {
        match answer.outcome {
            Outcome::Interval { first, last } => {
                self.check_not_late(first.time)?;
                let reach = self.config.margin;
                let after = |&&(time, gap): &&(f64, f64)| time > last.time && gap < reach;
                let late = self.samples.iter().find(after);
                law!(
                    late.is_none(),
                    "in contact at {late:?}, after the last contact"
                );
                if let Finding::Hit { hi, .. } = self.finding {
                    law!(
                        hi <= last.time,
                        "in contact at {hi}, after the last contact"
                    );
                }
                for hit in [first, last] {
                    // Otherwise one body is inside the other.
                    if let Some(contact) = hit.contact() {
                        self.check_near_contact(hit.time, answer.tolerance, &contact)?;
                    }
                }
                law!(
                    first.time <= last.time,
                    "the last contact is before the first"
                );
                Ok(())
            }
            Outcome::Free { .. } => self.check(answer, bodies),
            Outcome::Unresolved(_) => Err("unresolved".into()),
            other => Err(format!("no outcome of an interval: {other:?}")),
        }
    }

    /// Checks that the distance at a time is at most the sum of margin, tolerance and rounding, unless the bodies overlap.
    fn check_near_contact(&self, time: f64, tolerance: f64, contact: &Contact) -> CheckResult {
        let reach = self.config.margin + tolerance + self.query.rounding();
        let in_range = (0.0..=self.query.duration).contains(&time);
        law!(in_range, "the time {time} is not within the duration");
        let gap = self.referee.gap(time);
        law!(
            gap <= reach || self.may_overlap(time, contact),
            "false: the distance at {time} is {gap}"
        );
        Ok(())
    }

    /// Returns an upper bound on the distance of two pieces in contact at a time. It is infinite if the bodies may
    /// overlap, because their pieces may then be anywhere in a solid.
    fn contact_distance_bound(&self, time: f64, tolerance: f64, contact: &Contact) -> f64 {
        if !self.may_overlap(time, contact) {
            self.config.margin + tolerance + self.query.rounding()
        } else {
            f64::INFINITY
        }
    }

    /// Returns true if two pieces overlap, or if the bodies may have touched before, so that their surfaces may be far
    /// apart.
    fn may_overlap(&self, time: f64, contact: &Contact) -> bool {
        let touched = match self.finding {
            Finding::Hit { lo, .. } | Finding::Graze { lo } => time >= lo,
            Finding::ContactAtStart => true,
            Finding::Free { .. } | Finding::Undecided { .. } => false,
        };
        touched || self.are_nested || contact.separation.lower < -self.query.rounding()
    }

    /// Returns the least distance that the referee has found at any time; 0 if it has found a contact.
    fn least_found_distance(&self) -> f64 {
        let sampled = self.samples.iter().map(|sample| sample.1);
        let least = sampled.fold(f64::INFINITY, lesser);
        match self.finding {
            Finding::Hit { .. } => 0.0,
            Finding::Free { gap } => lesser(gap, least),
            Finding::ContactAtStart | Finding::Graze { .. } | Finding::Undecided { .. } => least,
        }
    }
}
