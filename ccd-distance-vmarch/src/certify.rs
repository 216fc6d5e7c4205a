//! From marches to an answer: ties are certified, cycles settled, marches taken up again.

use crate::around;
use crate::certificate::best_axis;
use crate::feature::{Certainty, Next, Pair, Whose};
use crate::march::{End, march, step};
use crate::oracle::Counters;
use crate::penetration;
use crate::place::Places;
use crate::start::extremal;
use crate::tolerance::{CYCLE_LOOK, FAR, RESTARTS, ROUNDS};
use crate::touching;
use crate::witness::Witness;
use ccd_core::glam::DVec3;
use ccd_core::{Claim, GiveUp};

/// What is claimed, and the pair to start from the next time.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Answer {
    pub(crate) pair: Pair,
    pub(crate) claim: Claim,
}

/// From the end of a march that is not certain by itself to an answer that is certified, or proven.
///
/// # Errors
/// When, from several starts, none is: [`GiveUp::Cycle`] or [`GiveUp::StepCap`] where a march ended so,
/// [`GiveUp::Uncertified`] where none did.
#[cold]
#[inline(never)]
pub(crate) fn settle(
    places: &Places<'_>,
    first: End,
    counters: &mut Counters,
) -> Result<Answer, GiveUp> {
    let (mut end, mut restarts) = (first, 0);
    let mut why = GiveUp::Uncertified;
    for _ in 0..ROUNDS {
        why = match end {
            End::Cycle(_) => GiveUp::Cycle,
            End::Cap(_) => GiveUp::StepCap,
            End::Nearest(..) | End::Common(..) | End::Unclear(_) => why,
        };
        let from = match judge(places, end, counters) {
            Verdict::Settled(answer) => return Ok(answer),
            Verdict::Nearer(pair) => pair,
            Verdict::Doubtful(_) if restarts == RESTARTS => break,
            Verdict::Doubtful(axis) => {
                counters.restarts += 1;
                restarts += 1;
                extremal(places, axis)
            }
        };
        end = march(places, from, counters);
    }
    let found = search(places, extremal(places, places.b.origin()), counters);
    found.ok_or(why)
}

/// What an end is worth.
enum Verdict {
    Settled(Answer),
    /// There is a pair around it that is nearer.
    Nearer(Pair),
    /// It is not certified; this is the best axis so far.
    Doubtful(DVec3),
}

fn judge(places: &Places<'_>, end: End, counters: &mut Counters) -> Verdict {
    match end {
        End::Nearest(pair, certainty) => weigh(places, pair, certainty),
        End::Common(pair, whose, crossing) => {
            counters.penetrations += 1;
            let claim = touching::common(places, whose, &crossing);
            Verdict::Settled(Answer { pair, claim })
        }
        End::Unclear(pair) => match search(places, pair, counters) {
            Some(answer) => Verdict::Settled(answer),
            None => weigh_cycle(places, pair),
        },
        End::Cycle(pair) | End::Cap(pair) => weigh_cycle(places, pair),
    }
}

/// A stop, certified where it has to be.
fn weigh(places: &Places<'_>, pair: Pair, certainty: Certainty) -> Verdict {
    let witness = Witness::of(places, pair);
    if certainty == Certainty::Sure || witness.distance() >= FAR * places.scale.size {
        return settled(places, pair, &witness, witness.axis);
    }
    certify(places, pair)
}

/// The best pair of a cycle.
fn weigh_cycle(places: &Places<'_>, start: Pair) -> Verdict {
    let (mut pair, mut nearest) = (start, start);
    let mut least = Witness::of(places, start).distance();
    for _ in 0..CYCLE_LOOK {
        match step(places, pair) {
            Next::To(a, b) => pair = Pair { a, b },
            _ => break,
        }
        let distance = Witness::of(places, pair).distance();
        if distance < least {
            (nearest, least) = (pair, distance);
        }
        if pair == start {
            break;
        }
    }
    certify(places, nearest)
}

/// Certifies a pair, or one that is nearer around it: a march back from there might end at the same
/// tie.
fn certify(places: &Places<'_>, start: Pair) -> Verdict {
    let mut pair = start;
    for _ in 0..ROUNDS {
        let witness = Witness::of(places, pair);
        let distance = witness.distance();
        let axis = best_axis(places, pair, &witness);
        if axis.certifies(distance, places) || distance <= places.scale.rounding() {
            return settled(places, pair, &witness, axis.direction);
        }
        match around::nearer(places, pair, distance) {
            Some(nearer) => pair = nearer,
            // As near as it gets: what is left of doubt is the axis'.
            None if axis.gap >= 0.5 * distance => {
                return settled(places, pair, &witness, axis.direction);
            }
            None => return Verdict::Doubtful(axis.direction),
        }
    }
    Verdict::Nearer(pair)
}

fn settled(places: &Places<'_>, pair: Pair, witness: &Witness, axis: DVec3) -> Verdict {
    let claim = Claim {
        axis,
        ..witness.claim(places)
    };
    Verdict::Settled(Answer { pair, claim })
}

/// Looks for a common point among all edges and faces.
fn search(places: &Places<'_>, pair: Pair, counters: &mut Counters) -> Option<Answer> {
    let Places { a, b, scale } = places;
    let of = |whose| move |crossing| (whose, crossing);
    let found = penetration::searched(a, b, *scale).map(of(Whose::X));
    let found = found.or_else(|| penetration::searched(b, a, *scale).map(of(Whose::Y)));
    let (whose, crossing) = found?;
    counters.penetrations += 1;
    let claim = touching::common(places, whose, &crossing);
    Some(Answer { pair, claim })
}

#[cfg(test)]
mod tests;
