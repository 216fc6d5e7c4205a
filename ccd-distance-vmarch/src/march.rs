//! Marches from one pair of features to a nearer pair, until no pair is nearer `[VCLIP98 §3]`.

use crate::counters::Counters;
use crate::escape::escape_local_minimum;
use crate::feature::{Feature, LocalMinimum, MarchStep, Pair, WhichPolytope};
use crate::placed::{PlacedPair, PlacedPolytope};
use crate::termination::{BrentCycleDetector, MarchEnd};
use crate::tolerance::MAX_STEPS_PER_FEATURE;
use crate::{edge_edge, edge_face, vertex_edge, vertex_face, vertex_vertex};

/// Marches from a pair of features towards the nearest pair, and returns how the march ended.
///
/// In exact arithmetic every step leads to features that are nearer, or as near and of a lower dimension, so that no
/// pair occurs twice. In floating point one may, which [`BrentCycleDetector`] detects.
pub(crate) fn march(placed: &PlacedPair<'_>, start: Pair, counters: &mut Counters) -> MarchEnd {
    let features = placed.a.shape().feature_count() + placed.b.shape().feature_count();
    let mut pair = start;
    let mut brent = BrentCycleDetector::new(start);
    for _ in 0..MAX_STEPS_PER_FEATURE * features {
        counters.steps += 1;
        let mut next = step(placed, pair);
        if let MarchStep::LocalMinimum(which, minimum) = next {
            counters.local_minima += 1;
            next = escape(placed, which, minimum);
        }
        pair = match next {
            MarchStep::Continue(a, b) => Pair { a, b },
            MarchStep::Stop(certainty) => return MarchEnd::Nearest(pair, certainty),
            MarchStep::CommonPoint(which, crossing) => {
                return MarchEnd::CommonPoint(pair, which, crossing);
            }
            MarchStep::LocalMinimum(..) => return MarchEnd::Unclear(pair),
        };
        if brent.record_and_detect(pair) {
            counters.detected_cycles += 1;
            return MarchEnd::Cycle(pair);
        }
    }
    MarchEnd::StepLimit(pair)
}

/// Finds how the march continues from a local minimum; `which` is the polytope of its feature, X for A and Y for B.
#[cold]
fn escape(placed: &PlacedPair<'_>, which: WhichPolytope, minimum: LocalMinimum) -> MarchStep {
    let PlacedPair { a, b, scale } = placed;
    match which {
        WhichPolytope::PolytopeX => escape_local_minimum(a, minimum, b, *scale),
        WhichPolytope::PolytopeY => escape_local_minimum(b, minimum, a, *scale).swapped(),
    }
}

/// Tests one pair of features of A and B, and returns the step that follows. Two faces are never tested: an edge of one
/// replaces it.
#[inline]
pub(crate) fn step(placed: &PlacedPair<'_>, pair: Pair) -> MarchStep {
    let PlacedPair { a, b, scale } = placed;
    match (pair.a, pair.b) {
        (Feature::Vertex(v), Feature::Vertex(w)) => vertex_vertex::next(a, v, b, w, *scale),
        (Feature::Vertex(v), Feature::Edge(e)) => vertex_edge::next(a, v, b, e, *scale),
        (Feature::Edge(e), Feature::Vertex(v)) => vertex_edge::next(b, v, a, e, *scale).swapped(),
        (Feature::Edge(e), Feature::Edge(f)) => edge_edge::next(a, e, b, f, *scale),
        (Feature::Vertex(v), Feature::Face(f)) => vertex_face::next(a, v, b, f, *scale),
        (Feature::Face(f), Feature::Vertex(v)) => vertex_face::next(b, v, a, f, *scale).swapped(),
        (Feature::Edge(e), Feature::Face(f)) => edge_face::next(a, e, b, f, *scale),
        (Feature::Face(f), Feature::Edge(e)) => edge_face::next(b, e, a, f, *scale).swapped(),
        (Feature::Face(f), Feature::Face(_)) => {
            let edge = a.shape().sides_of(f).first().map_or(0, |side| side.edge);
            MarchStep::Continue(Feature::Edge(edge), pair.b)
        }
    }
}

#[cfg(test)]
mod tests;
