//! The start of a march: the last pair of features, or corners that face each other `[SWIFT01]`.

use crate::feature::{Feature, Pair};
use crate::placed::{Placed, PlacedPair};
use crate::polytope::Polytope;
use ccd_core::glam::DVec3;

/// The features that were nearest, and their axis, for the next call to start from.
///
/// Features serve the polytope that they are of; for any other one, such as a part of that, the axis
/// says where to start. Whatever a cache holds, it only decides where a march begins.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Cache(Option<Last>);

/// The end of the last march.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Last {
    pair: Pair,
    /// The names of both polytopes.
    names: [u64; 2],
    axis: DVec3,
}

impl Cache {
    /// Keeps a pair, with the axis from A to B.
    #[inline]
    pub(crate) fn keep(&mut self, placed: &PlacedPair<'_>, pair: Pair, axis: DVec3) {
        self.0 = Some(Last {
            pair,
            names: names(placed),
            axis,
        });
    }

    /// The pair to start from: the last one; or corners that are extremal along the last axis, or along
    /// the way from one middle to the other where there is none.
    #[inline]
    pub(crate) fn start(self, placed: &PlacedPair<'_>) -> Pair {
        let Some(last) = self.0 else {
            return extremal(placed, placed.b.origin());
        };
        let names = names(placed);
        if names == last.names && is_state(placed, last.pair) {
            return last.pair;
        }
        let corners = extremal(placed, last.axis);
        // What one polytope has kept is nearer than a corner.
        let kept = Pair {
            a: if names[0] == last.names[0] {
                last.pair.a
            } else {
                corners.a
            },
            b: if names[1] == last.names[1] {
                last.pair.b
            } else {
                corners.b
            },
        };
        if is_state(placed, kept) {
            kept
        } else {
            corners
        }
    }
}

/// Numbers that hardly any two polytopes have in common.
#[inline]
fn names(placed: &PlacedPair<'_>) -> [u64; 2] {
    let name = |polytope: &Polytope| {
        let DVec3 { x, y, z } = polytope.origin;
        let coordinates = [polytope.reach, x, y, z].map(f64::to_bits);
        coordinates
            .into_iter()
            .fold(0, |name: u64, bits| name.rotate_left(16) ^ bits)
    };
    [name(placed.a.shape()), name(placed.b.shape())]
}

/// Whether a march can begin there: never at two faces.
#[inline]
fn is_state(placed: &PlacedPair<'_>, pair: Pair) -> bool {
    let two_faces = matches!((pair.a, pair.b), (Feature::Face(_), Feature::Face(_)));
    !two_faces && placed.a.shape().has(pair.a) && placed.b.shape().has(pair.b)
}

/// The corners that face each other along an axis from A to B.
pub(crate) fn extremal(placed: &PlacedPair<'_>, axis: DVec3) -> Pair {
    let a = placed.a.shape().extremal(axis);
    let b = placed.b.shape().extremal(-placed.b.own_vector(axis));
    Pair {
        a: Feature::Vertex(a),
        b: Feature::Vertex(b),
    }
}

#[cfg(test)]
mod tests;
