//! Certifies the result of a march, also after ties, cycles and restarts.

use crate::certificate::best_axis;
use crate::counters::Counters;
use crate::feature::{Certainty, MarchStep, Pair, WhichPolytope};
use crate::march::{march, step};
use crate::neighbourhood;
use crate::penetration;
use crate::placed::PlacedPair;
use crate::start::extremal_pair;
use crate::termination::MarchEnd;
use crate::tolerance::{MAX_CYCLE_PAIRS, MAX_RESTARTS, MAX_TIE_MOVES, MIN_CERTAIN_DISTANCE_RATIO};
use crate::touching;
use crate::witness::Witness;
use ccd_core::glam::DVec3;
use ccd_core::{Claim, GiveUpReason};

/// The pair of features from which the next call starts, and a claim.
type CertifiedClaim = (Pair, Claim);

/// Certifies the result of a march that ended in a tie, in a cycle, at a common point or at the step limit.
///
/// If a neighbouring pair of features is nearer, the march resumes there. If the end cannot be certified, the march
/// restarts at the corners that are extremal along the best axis.
///
/// # Errors
/// If no restart succeeds: [`GiveUpReason::Cycle`] or [`GiveUpReason::StepCap`] after the last march that ended so, or
/// [`GiveUpReason::Uncertified`] if none did.
#[cold]
#[inline(never)]
pub(crate) fn certify_march_end(
    placed: &PlacedPair<'_>,
    first: MarchEnd,
    counters: &mut Counters,
) -> Result<CertifiedClaim, GiveUpReason> {
    let (mut end, mut restarts) = (first, 0);
    let mut why = GiveUpReason::Uncertified;
    for _ in 0..MAX_TIE_MOVES {
        why = match end {
            MarchEnd::Cycle(_) => GiveUpReason::Cycle,
            MarchEnd::StepLimit(_) => GiveUpReason::StepCap,
            MarchEnd::Nearest(..) | MarchEnd::CommonPoint(..) | MarchEnd::Unclear(_) => why,
        };
        let from = match certify_end(placed, end, counters) {
            CertificationResult::Certified(answer) => return Ok(answer),
            CertificationResult::NearerPair(pair) => pair,
            CertificationResult::Uncertified(_) if restarts == MAX_RESTARTS => break,
            CertificationResult::Uncertified(axis) => {
                counters.restarts += 1;
                restarts += 1;
                extremal_pair(placed, axis)
            }
        };
        end = march(placed, from, counters);
    }
    let found = search_common_point(
        placed,
        extremal_pair(placed, placed.b.to_a.translation),
        counters,
    );
    found.ok_or(why)
}

/// The result of checking the end of a march: certified, or how to continue.
enum CertificationResult {
    Certified(CertifiedClaim),
    /// The end is not certified: a neighbouring pair of features is nearer.
    NearerPair(Pair),
    /// The end is not certified, and no neighbouring pair is nearer. The vector is the best axis found.
    Uncertified(DVec3),
}

fn certify_end(
    placed: &PlacedPair<'_>,
    end: MarchEnd,
    counters: &mut Counters,
) -> CertificationResult {
    match end {
        MarchEnd::Nearest(pair, certainty) => certify_stop(placed, pair, certainty),
        MarchEnd::CommonPoint(pair, which, crossing) => {
            counters.penetrations += 1;
            CertificationResult::Certified((
                pair,
                touching::common_point_claim(placed, which, &crossing),
            ))
        }
        MarchEnd::Unclear(pair) => match search_common_point(placed, pair, counters) {
            Some(answer) => CertificationResult::Certified(answer),
            None => certify_cycle(placed, pair),
        },
        MarchEnd::Cycle(pair) | MarchEnd::StepLimit(pair) => certify_cycle(placed, pair),
    }
}

/// Certifies the pair of features at which a march stopped, unless the pair is certain already.
fn certify_stop(placed: &PlacedPair<'_>, pair: Pair, certainty: Certainty) -> CertificationResult {
    let witness = Witness::new(placed, pair);
    if certainty == Certainty::Sure
        || witness.distance() >= MIN_CERTAIN_DISTANCE_RATIO * placed.scale.size
    {
        return CertificationResult::Certified((pair, witness.claim));
    }
    certify_tie(placed, pair)
}

/// Certifies the pair of features with the least distance among the pairs of a cycle.
fn certify_cycle(placed: &PlacedPair<'_>, start: Pair) -> CertificationResult {
    let (mut pair, mut nearest) = (start, start);
    let mut least = Witness::new(placed, start).distance();
    for _ in 0..MAX_CYCLE_PAIRS {
        match step(placed, pair) {
            MarchStep::Continue(a, b) => pair = Pair { a, b },
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

/// Certifies a pair of features by the best axis of the features around it. If that fails, it tries nearer neighbouring
/// pairs. A new march might end at the same tie.
fn certify_tie(placed: &PlacedPair<'_>, start: Pair) -> CertificationResult {
    let mut pair = start;
    for _ in 0..MAX_TIE_MOVES {
        let witness = Witness::new(placed, pair);
        let distance = witness.distance();
        let axis = best_axis(placed, pair, &witness);
        if axis.certifies(distance, placed) || distance <= placed.scale.rounding() {
            return certified_with_axis(pair, &witness, axis.direction);
        }
        match neighbourhood::nearer_neighbour_pair(placed, pair, distance) {
            Some(nearer) => pair = nearer,
            // No pair is nearer: only the axis is uncertain.
            None if axis.gap >= 0.5 * distance => {
                return certified_with_axis(pair, &witness, axis.direction);
            }
            None => return CertificationResult::Uncertified(axis.direction),
        }
    }
    CertificationResult::NearerPair(pair)
}

/// Returns the certified claim with the points of a witness and the given axis.
fn certified_with_axis(pair: Pair, witness: &Witness, axis: DVec3) -> CertificationResult {
    let claim = Claim {
        axis,
        ..witness.claim
    };
    CertificationResult::Certified((pair, claim))
}

/// Searches all edges and faces for a point where the polytopes cross; `None` if there is no such point.
fn search_common_point(
    placed: &PlacedPair<'_>,
    pair: Pair,
    counters: &mut Counters,
) -> Option<CertifiedClaim> {
    let PlacedPair { a, b, .. } = placed;
    let of = |which| move |crossing| (which, crossing);
    let found = penetration::find_edge_face_crossing(a, b).map(of(WhichPolytope::PolytopeX));
    let found = found
        .or_else(|| penetration::find_edge_face_crossing(b, a).map(of(WhichPolytope::PolytopeY)));
    let (which, crossing) = found?;
    counters.penetrations += 1;
    Some((pair, touching::common_point_claim(placed, which, &crossing)))
}

#[cfg(test)]
mod tests;
