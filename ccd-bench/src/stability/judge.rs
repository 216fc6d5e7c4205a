//! Judges a method's answer to a query against the exact answer of the family.

use super::family::{ExactCase, FamilyScene};
use crate::method::guarded::QueryOutcome;
use crate::run::contest::{self, Judgement};
use crate::truth::{Truth, TruthSolver};

/// Judges a method's answer within the tolerance of one scene of a family, or within a larger one that the method
/// states. The referee measures distances; it is not asked for the answer.
pub fn judge(
    scene: &FamilyScene,
    case: &ExactCase,
    referee: &TruthSolver<'_>,
    outcome: &QueryOutcome,
) -> Judgement {
    // The families know a contact at the start, such as of a body inside another one; the referee cannot prove it.
    let truth = match case.expected_truth {
        Truth::ContactAtStart => Truth::Hit { lo: 0.0, hi: 0.0 },
        truth => truth,
    };
    contest::judge_outcome(outcome, |reply| {
        let within = scene.margin + reply.judging_tolerance(scene.tolerance);
        contest::judge(referee, &case.query, truth, reply.claim, within)
    })
}

#[cfg(test)]
mod tests;
