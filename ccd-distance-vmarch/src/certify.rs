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
use crate::tolerance::{CYCLE_LOOK, FAR, RESTARTS, ROUNDS};
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
    for _ in 0..ROUNDS {
        why = match end {
            End::Cycle(_) => GiveUp::Cycle,
            End::Cap(_) => GiveUp::StepCap,
            End::Nearest(..) | End::Common(..) | End::Unclear(_) => why,
        };
        let from = match examine(placed, end, counters) {
            Finding::Certified(answer) => return Ok(answer),
            Finding::Nearer(pair) => pair,
            Finding::Doubtful(_) if restarts == RESTARTS => break,
            Finding::Doubtful(axis) => {
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
enum Finding {
    Certified(Certified),
    /// A neighbouring pair of features is nearer.
    Nearer(Pair),
    /// The end is not certified; with the best axis found.
    Doubtful(DVec3),
}

fn examine(placed: &PlacedPair<'_>, end: End, counters: &mut Counters) -> Finding {
    match end {
        End::Nearest(pair, certainty) => examine_stop(placed, pair, certainty),
        End::Common(pair, which, crossing) => {
            counters.penetrations += 1;
            let claim = touching::common(placed, which, &crossing);
            Finding::Certified(Certified { pair, claim })
        }
        End::Unclear(pair) => match search_common_point(placed, pair, counters) {
            Some(answer) => Finding::Certified(answer),
            None => examine_cycle(placed, pair),
        },
        End::Cycle(pair) | End::Cap(pair) => examine_cycle(placed, pair),
    }
}

/// Certifies a pair at which a march stopped, if that is not certain already.
fn examine_stop(placed: &PlacedPair<'_>, pair: Pair, certainty: Certainty) -> Finding {
    let witness = Witness::new(placed, pair);
    if certainty == Certainty::Sure || witness.distance() >= FAR * placed.scale.size {
        return certified(placed, pair, &witness, witness.axis);
    }
    certify_tie(placed, pair)
}

/// Certifies the nearest pair of a cycle.
fn examine_cycle(placed: &PlacedPair<'_>, start: Pair) -> Finding {
    let (mut pair, mut nearest) = (start, start);
    let mut least = Witness::new(placed, start).distance();
    for _ in 0..CYCLE_LOOK {
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
fn certify_tie(placed: &PlacedPair<'_>, start: Pair) -> Finding {
    let mut pair = start;
    for _ in 0..ROUNDS {
        let witness = Witness::new(placed, pair);
        let distance = witness.distance();
        let axis = best_axis(placed, pair, &witness);
        if axis.certifies(distance, placed) || distance <= placed.scale.rounding() {
            return certified(placed, pair, &witness, axis.direction);
        }
        match neighbourhood::nearer(placed, pair, distance) {
            Some(nearer) => pair = nearer,
            // No pair is nearer: only the axis is uncertain.
            None if axis.gap >= 0.5 * distance => {
                return certified(placed, pair, &witness, axis.direction);
            }
            None => return Finding::Doubtful(axis.direction),
        }
    }
    Finding::Nearer(pair)
}

fn certified(placed: &PlacedPair<'_>, pair: Pair, witness: &Witness, axis: DVec3) -> Finding {
    let claim = Claim {
        axis,
        ..witness.claim(placed)
    };
    Finding::Certified(Certified { pair, claim })
}

/// Searches all edges and faces for a common point of the polytopes.
fn search_common_point(
    placed: &PlacedPair<'_>,
    pair: Pair,
    counters: &mut Counters,
) -> Option<Certified> {
    let PlacedPair { a, b, scale } = placed;
    let of = |which| move |crossing| (which, crossing);
    let found = penetration::searched(a, b, *scale).map(of(Which::X));
    let found = found.or_else(|| penetration::searched(b, a, *scale).map(of(Which::Y)));
    let (which, crossing) = found?;
    counters.penetrations += 1;
    let claim = touching::common(placed, which, &crossing);
    Some(Certified { pair, claim })
}

#[cfg(test)]
mod tests;
