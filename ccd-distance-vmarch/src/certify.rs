//! Certifies the result of a march, also after ties, cycles and restarts.

use crate::certificate::best_axis;
use crate::counters::Counters;
use crate::feature::{Certainty, Pair, WhichPolytope};
use crate::march::march;
use crate::penetration;
use crate::placed::PlacedPair;
use crate::start::extremal;
use crate::termination::End;
use crate::tolerance::{CERTAIN_DISTANCE, MAX_RESTARTS};
use crate::touching;
use crate::witness::Witness;
use ccd_core::glam::DVec3;
use ccd_core::{Claim, GiveUpReason};

/// A claim, after the pair of features from which the next call starts.
type Certified = (Pair, Claim);

/// Certifies the result of a march that ended in a tie, a cycle or a common point. If that is in vain, the march
/// restarts at the corners that are extremal along the best axis.
///
/// # Errors
/// If no restart succeeds: [`GiveUpReason::Cycle`] or [`GiveUpReason::StepCap`] if the last march ended so, else
/// [`GiveUpReason::Uncertified`].
#[cold]
#[inline(never)]
pub(crate) fn certify_march_end(
    placed: &PlacedPair<'_>,
    first: End,
    counters: &mut Counters,
) -> Result<Certified, GiveUpReason> {
    let mut end = first;
    for restarts in 0..=MAX_RESTARTS {
        let axis = match check(placed, end, counters) {
            Ok(answer) => return Ok(answer),
            Err(UncertifiedEnd(axis)) => axis,
        };
        if restarts < MAX_RESTARTS {
            counters.restarts += 1;
            end = march(placed, extremal(placed, axis), counters);
        }
    }
    let found = search_common_point(placed, extremal(placed, placed.b.origin()), counters);
    found.ok_or(match end {
        End::Cycle(_) => GiveUpReason::Cycle,
        End::StepLimit(_) => GiveUpReason::StepCap,
        End::Nearest(..) | End::CommonPoint(..) | End::Unclear(_) => GiveUpReason::Uncertified,
    })
}

/// The end of a march is not certified; with the best axis found.
struct UncertifiedEnd(DVec3);

fn check(
    placed: &PlacedPair<'_>,
    end: End,
    counters: &mut Counters,
) -> Result<Certified, UncertifiedEnd> {
    match end {
        End::Nearest(pair, certainty) => check_stop(placed, pair, certainty),
        End::CommonPoint(pair, which, crossing) => {
            counters.penetrations += 1;
            Ok((pair, touching::common(placed, which, &crossing)))
        }
        End::Unclear(pair) => match search_common_point(placed, pair, counters) {
            Some(answer) => Ok(answer),
            None => certify_tie(placed, pair),
        },
        End::Cycle(pair) | End::StepLimit(pair) => certify_tie(placed, pair),
    }
}

/// Certifies a pair at which a march stopped, if that is not certain already.
fn check_stop(
    placed: &PlacedPair<'_>,
    pair: Pair,
    certainty: Certainty,
) -> Result<Certified, UncertifiedEnd> {
    let witness = Witness::new(placed, pair);
    if certainty == Certainty::Sure || witness.distance() >= CERTAIN_DISTANCE * placed.scale.size {
        return Ok((pair, witness.claim));
    }
    certify_tie(placed, pair)
}

/// Certifies a pair by the best axis of the features around.
fn certify_tie(placed: &PlacedPair<'_>, pair: Pair) -> Result<Certified, UncertifiedEnd> {
    let witness = Witness::new(placed, pair);
    let distance = witness.distance();
    let axis = best_axis(placed, pair, &witness);
    if axis.certifies(distance, placed) || distance <= placed.scale.rounding() {
        let claim = Claim {
            axis: axis.direction,
            ..witness.claim
        };
        return Ok((pair, claim));
    }
    Err(UncertifiedEnd(axis.direction))
}

/// Searches all edges and faces for a common point of the polytopes.
fn search_common_point(
    placed: &PlacedPair<'_>,
    pair: Pair,
    counters: &mut Counters,
) -> Option<Certified> {
    let PlacedPair { a, b, .. } = placed;
    let of = |which| move |crossing| (which, crossing);
    let found = penetration::search_crossing(a, b).map(of(WhichPolytope::X));
    let found = found.or_else(|| penetration::search_crossing(b, a).map(of(WhichPolytope::Y)));
    let (which, crossing) = found?;
    counters.penetrations += 1;
    Some((pair, touching::common(placed, which, &crossing)))
}

#[cfg(test)]
mod tests;
