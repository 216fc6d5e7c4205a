//! Judges a solver's claim against the exact first contact.

use crate::method::guarded::QueryOutcome;
use crate::method::solver::{ContactClaim, Reply};
use crate::names::name_of;
use crate::truth::{Truth, TruthSolver};
use ccd_core::order::greater;
use ccd_tables::motions::Motions;
use clap::ValueEnum;
use std::fmt;

/// The judgement of a claim about a query, from good to bad.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, ValueEnum)]
pub enum Verdict {
    /// The claim agrees with the exact answer, to within the tolerance.
    Right,
    /// The claim is a contact while the bodies are still farther apart than the tolerance.
    Early,
    /// The exact answer is not known well enough to judge the claim.
    Undecided,
    /// The method does not support the query or its bodies.
    Refused,
    /// The claim is only a time before which there is no contact.
    Unresolved,
    /// The claim is a contact, but there is none, and the bodies are farther apart than the tolerance.
    #[value(name = "false")]
    FalseContact,
    /// The claim is a contact after the exact first one.
    Late,
    /// The claim is that there is no contact, but there is one.
    Missed,
    /// The process of the method ended instead of answering.
    #[value(name = "died")]
    Crashed,
    /// The query exceeded the time limit and was stopped.
    #[value(name = "cut off")]
    CutOff,
    /// The reply is no answer to the query, such as a single distance measured for comparison.
    #[value(name = "not judged")]
    NotJudged,
}

/// The verdict on a claim, with the error of the claimed time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Judgement {
    /// How the claim compares with the exact answer.
    pub verdict: Verdict,
    /// The distance of the reported time of contact from the bracket of the exact one, as a fraction of the duration;
    /// `None` if either time is missing.
    pub time_error: Option<f64>,
}

/// The lateness above which a reported contact is judged late, as a fraction of the duration. Poses by two formulas of
/// one motion differ by about 1e-15 of the coordinates, and the slowest scene moves by a hundredth of these during its
/// duration; the value is ten times that.
const MAX_LATENESS: f64 = 1e-12;

/// The widest bracket that counts as an exact time, as a fraction of the duration.
const MAX_BRACKET_WIDTH: f64 = 1e-9;

/// The allowed excess of the bodies' distance over the tolerance due to rounding, as a fraction of the tolerance.
const DISTANCE_ROUNDING_IN_TOLERANCES: f64 = 1e-6;

impl Judgement {
    /// Returns a judgement without a time error, for a claim whose time is not compared with the exact one.
    pub fn without_time_error(verdict: Verdict) -> Self {
        Judgement {
            verdict,
            time_error: None,
        }
    }
}

/// Judges the outcome of a query: a reply by the function `judge`, and a stopped or crashed process without it.
pub fn judge_outcome(outcome: &QueryOutcome, judge: impl FnOnce(&Reply) -> Judgement) -> Judgement {
    match outcome {
        QueryOutcome::Answered(timed) => judge(&timed.reply),
        QueryOutcome::CutOff => Judgement::without_time_error(Verdict::CutOff),
        QueryOutcome::Crashed => Judgement::without_time_error(Verdict::Crashed),
    }
}

/// Judges a claim about a query by the exact answer and the tolerance.
pub fn judge(
    referee: &TruthSolver<'_>,
    query: &Motions,
    truth: Truth,
    claim: ContactClaim,
    tolerance: f64,
) -> Judgement {
    let near = |time: f64| {
        let distance = referee.distance_bounds(query, time).distance_lower_bound;
        distance <= tolerance * (1.0 + DISTANCE_ROUNDING_IN_TOLERANCES)
    };
    let lateness = MAX_LATENESS * query.duration;
    let verdict = match (truth, claim) {
        (_, ContactClaim::OtherMeasurement) => Verdict::NotJudged,
        (_, ContactClaim::Refused) => Verdict::Refused,
        (Truth::ContactAtStart | Truth::Graze { .. } | Truth::Undecided { .. }, _) => {
            Verdict::Undecided
        }
        (Truth::Hit { lo, hi }, _) if hi - lo > MAX_BRACKET_WIDTH * query.duration => {
            Verdict::Undecided
        }
        (Truth::Hit { lo, hi }, ContactClaim::Contact { time }) => {
            let off = greater(0.0, greater(lo - time, time - hi)) / query.duration;
            // The comparison treats NaN as late.
            let verdict = if !(time <= hi + lateness) {
                Verdict::Late
            } else if time < lo && !near(time) {
                Verdict::Early
            } else {
                Verdict::Right
            };
            return Judgement {
                verdict,
                // An invalid time has no error: `greater` has dropped the NaN.
                time_error: Some(off).filter(|_| !time.is_nan()),
            };
        }
        (Truth::Hit { .. }, ContactClaim::NoContact) => Verdict::Missed,
        // This claim is a proof too, and may be wrong.
        (Truth::Hit { hi, .. }, ContactClaim::Unresolved { safe_until })
            if !(safe_until <= hi + lateness) =>
        {
            Verdict::Late
        }
        (_, ContactClaim::Unresolved { .. }) => Verdict::Unresolved,
        (Truth::Free, ContactClaim::Contact { time }) if !near(time) => Verdict::FalseContact,
        (Truth::Free, _) => Verdict::Right,
    };
    Judgement::without_time_error(verdict)
}

impl fmt::Display for Verdict {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(&name_of(self))
    }
}
