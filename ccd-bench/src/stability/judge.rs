//! Judges a method's answer to a query against the exact answer of the family.

use super::family::{ExactCase, FamilyStep};
use crate::method::guarded::QueryOutcome;
use crate::method::solver::{ContactClaim, Reply};
use crate::run::contest::{self, Judgement, Verdict, is_within_tolerance, judge_contact};
use crate::truth::{Referee, Truth};

/// The latest reported contact time that is judged right for bodies in contact at the start, as a fraction of the
/// duration.
const MAX_START_CONTACT_TIME: f64 = 1e-12;

/// Judges a method's answer within the tolerance of the step, or within a larger tolerance that the method states. The
/// referee measures distances; it is not asked for the answer.
pub fn judge(
    step: &FamilyStep,
    case: &ExactCase,
    referee: &Referee<'_>,
    outcome: &QueryOutcome,
) -> Judgement {
    contest::judge_outcome(outcome, |reply| judge_reply(step, case, referee, reply))
}

fn judge_reply(
    step: &FamilyStep,
    case: &ExactCase,
    referee: &Referee<'_>,
    reply: &Reply,
) -> Judgement {
    let claim = reply.claim;
    let query = &case.query;
    let within = step.margin + reply.judging_tolerance(step.tolerance);
    match case.expected_truth {
        _ if claim == ContactClaim::Refused => Judgement::without_time_error(Verdict::Refused),
        Truth::Hit { lo, hi } => judge_contact(query.duration, [lo, hi], claim, |time| {
            is_within_tolerance(referee, query, time, within)
        }),
        Truth::ContactAtStart => {
            Judgement::without_time_error(judge_contact_from_start(claim, query.duration))
        }
        truth => contest::judge(referee, query, truth, claim, within),
    }
}

/// Judges a method's claim about bodies that are in contact at the start.
fn judge_contact_from_start(claim: ContactClaim, duration: f64) -> Verdict {
    match claim {
        ContactClaim::Contact { time } if time <= MAX_START_CONTACT_TIME * duration => {
            Verdict::Right
        }
        ContactClaim::Unresolved { safe_until }
            if safe_until <= MAX_START_CONTACT_TIME * duration =>
        {
            Verdict::Unresolved
        }
        ContactClaim::Contact { .. } | ContactClaim::Unresolved { .. } => Verdict::Late,
        ContactClaim::NoContact => Verdict::Missed,
        ContactClaim::Refused => Verdict::Refused,
        ContactClaim::OtherMeasurement => Verdict::NotJudged,
    }
}

#[cfg(test)]
mod tests;
