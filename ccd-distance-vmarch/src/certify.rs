//! Certifies the result of a march, also after ties, cycles and restarts.

use crate::certificate::best_axis;
use crate::counters::Counters;
use crate::feature::{Certainty, Next, Pair, Which};
use crate::march::{march, step};
use crate::neighbourhood;
use crate::penetration;
use crate::placed::PlacedPair;
use crate::start::extremal;
use crate::termination::End;
use crate::tolerance::{CERTAIN_DISTANCE, MAX_CYCLE_PAIRS, MAX_RESTARTS, MAX_TIE_MOVES};
use crate::touching;
use crate::witness::Witness;
use ccd_core::glam::DVec3;
use ccd_core::{Claim, GiveUp};

/// A claim, with the pair of features from which the next call starts.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Certified {
    pub(crate) pair: Pair,
    pub(crate) claim: Claim,
}

/// Certifies the result of a march that ended in a tie, a cycle or a common point.
///
/// # Errors
/// If no restart succeeds: [`GiveUp::Cycle`] or [`GiveUp::StepCap`] if the last march ended so, else
/// [`GiveUp::Uncertified`].
#[cold]
#[inline(never)]
pub(crate) fn certify(
    placed: &PlacedPair<'_>,
    first: End,
    counters: &mut Counters,
) -> Result<Certified, GiveUp> {
    let (mut end, mut restarts) = (first, 0);
    let mut why = GiveUp::Uncertified;
    for _ in 0..MAX_TIE_MOVES {
        why = match end {
            End::Cycle(_) => GiveUp::Cycle,
            End::Cap(_) => GiveUp::StepCap,
            End::Nearest(..) | End::Common(..) | End::Unclear(_) => why,
        };
        let from = match check(placed, end, counters) {
            CheckResult::Certified(answer) => return Ok(answer),
            CheckResult::Nearer(pair) => pair,
            CheckResult::Doubtful(_) if restarts == MAX_RESTARTS => break,
            CheckResult::Doubtful(axis) => {
                counters.restarts += 1;
                restarts += 1;
                extremal(placed, axis)
            }
        };
        end = march(placed, from, counters);
    }
    let found = search_common_point(placed, extremal(placed, placed.b.origin()), counters);
    found.ok_or(why)
}

/// What a check of a march's end found out.
enum CheckResult {
    Certified(Certified),
    /// A neighbouring pair of features is nearer.
    Nearer(Pair),
    /// The end is not certified; with the best axis found.
    Doubtful(DVec3),
}

fn check(placed: &PlacedPair<'_>, end: End, counters: &mut Counters) -> CheckResult {
    match end {
        End::Nearest(pair, certainty) => check_stop(placed, pair, certainty),
        End::Common(pair, which, crossing) => {
            counters.penetrations += 1;
            let claim = touching::common(placed, which, &crossing);
            CheckResult::Certified(Certified { pair, claim })
        }
        End::Unclear(pair) => match search_common_point(placed, pair, counters) {
            Some(answer) => CheckResult::Certified(answer),
            None => check_cycle(placed, pair),
        },
        End::Cycle(pair) | End::Cap(pair) => check_cycle(placed, pair),
    }
}

/// Certifies a pair at which a march stopped, if that is not certain already.
fn check_stop(placed: &PlacedPair<'_>, pair: Pair, certainty: Certainty) -> CheckResult {
    let witness = Witness::new(placed, pair);
    if certainty == Certainty::Sure || witness.distance() >= CERTAIN_DISTANCE * placed.scale.size {
        return try_certify(placed, pair, &witness, witness.axis);
    }
    certify_tie(placed, pair)
}

/// Certifies the nearest pair of a cycle.
fn check_cycle(placed: &PlacedPair<'_>, start: Pair) -> CheckResult {
    let (mut pair, mut nearest) = (start, start);
    let mut least = Witness::new(placed, start).distance();
    for _ in 0..MAX_CYCLE_PAIRS {
        match step(placed, pair) {
            Next::To(a, b) => pair = Pair { a, b },
            _ => break,
        }
        let distance = Witness::new(placed, pair).distance();
        if distance < least {
            (nearest, least) = (pair, distance);
        }
        if pair == start {
            break;
        }
    }
    certify_tie(placed, nearest)
}

/// Certifies a pair, or a nearer neighbouring pair, because a new march might end at the same tie.
fn certify_tie(placed: &PlacedPair<'_>, start: Pair) -> CheckResult {
    let mut pair = start;
    for _ in 0..MAX_TIE_MOVES {
        let witness = Witness::new(placed, pair);
        let distance = witness.distance();
        let axis = best_axis(placed, pair, &witness);
        if axis.certifies(distance, placed) || distance <= placed.scale.rounding() {
            return try_certify(placed, pair, &witness, axis.direction);
        }
        match neighbourhood::nearer_pair(placed, pair, distance) {
            Some(nearer) => pair = nearer,
            // No pair is nearer: only the axis is uncertain.
            None if axis.gap >= 0.5 * distance => {
                return try_certify(placed, pair, &witness, axis.direction);
            }
            None => return CheckResult::Doubtful(axis.direction),
        }
    }
    CheckResult::Nearer(pair)
}

fn try_certify(placed: &PlacedPair<'_>, pair: Pair, witness: &Witness, axis: DVec3) -> CheckResult {
    let claim = Claim {
        axis,
        ..witness.claim(placed)
    };
    CheckResult::Certified(Certified { pair, claim })
}

/// Searches all edges and faces for a common point of the polytopes.
fn search_common_point(
    placed: &PlacedPair<'_>,
    pair: Pair,
    counters: &mut Counters,
) -> Option<Certified> {
    let PlacedPair { a, b, scale } = placed;
    let of = |which| move |crossing| (which, crossing);
    let found = penetration::search_crossing(a, b, *scale).map(of(Which::X));
    let found = found.or_else(|| penetration::search_crossing(b, a, *scale).map(of(Which::Y)));
    let (which, crossing) = found?;
    counters.penetrations += 1;
    let claim = touching::common(placed, which, &crossing);
    Some(Certified { pair, claim })
}

#[cfg(test)]
mod tests;
