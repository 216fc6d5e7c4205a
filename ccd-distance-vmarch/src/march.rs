//! The march from pair to nearer pair of features, until none is nearer `[VCLIP98 §3]`.

use crate::counters::Counters;
use crate::escape::{self, Escape};
use crate::feature::{Behind, Feature, Next, Pair, Which};
use crate::placed::{Placed, PlacedPair};
use crate::termination::{Brent, End};
use crate::tolerance::MAX_STEPS_PER_FEATURE;
use crate::{edge_edge, edge_face, vertex_edge, vertex_face, vertex_vertex};

/// Marches from a pair of features to the nearest pair.
///
/// In exact arithmetic every step leads to features that are nearer, or as near and of a lower dimension, so that no
/// pair occurs twice. In floating point one may, which [`Brent`] detects.
pub(crate) fn march(placed: &PlacedPair<'_>, start: Pair, counters: &mut Counters) -> End {
    let features = placed.a.shape().features() + placed.b.shape().features();
    let mut pair = start;
    let mut brent = Brent::new(start);
    for _ in 0..MAX_STEPS_PER_FEATURE * features {
        counters.steps += 1;
        pair = match step(placed, pair) {
            Next::To(a, b) => Pair { a, b },
            Next::Stop(certainty) => return End::Nearest(pair, certainty),
            Next::Pierced(which, crossing) => return End::Common(pair, which, crossing),
            Next::Behind(which, behind) => {
                counters.local_minima += 1;
                match escape_from(placed, which, behind) {
                    Escape::Face(feature, face) => in_order(which, feature, Feature::Face(face)),
                    Escape::Inside(crossing) => return End::Common(pair, which, crossing),
                    Escape::Unclear => return End::Unclear(pair),
                }
            }
        };
        if brent.is_repeated(pair) {
            counters.cycles += 1;
            return End::Cycle(pair);
        }
    }
    End::Cap(pair)
}

#[cold]
fn escape_from(placed: &PlacedPair<'_>, which: Which, behind: Behind) -> Escape {
    let PlacedPair { a, b, scale } = placed;
    match which {
        Which::X => escape::escape(a, behind, b, *scale),
        Which::Y => escape::escape(b, behind, a, *scale),
    }
}

/// Tests one pair of features of A and B, and returns the next one. Two faces are never tested: an edge of one replaces
/// it.
#[inline]
pub(crate) fn step(placed: &PlacedPair<'_>, pair: Pair) -> Next {
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
            Next::To(Feature::Edge(edge), pair.b)
        }
    }
}

/// Returns a pair of features in the order A, B.
fn in_order(which: Which, of_it: Feature, of_other: Feature) -> Pair {
    match which {
        Which::X => Pair {
            a: of_it,
            b: of_other,
        },
        Which::Y => Pair {
            a: of_other,
            b: of_it,
        },
    }
}

#[cfg(test)]
mod tests;
