//! Chooses the pair from which a march starts: the last pair of features, or extremal vertices `[SWIFT01]`.

use crate::feature::{Feature, Pair};
use crate::placed::{PlacedPair, PlacedPolytope};
use crate::polytope::Polytope;
use ccd_core::glam::DVec3;

/// The nearest features of the last call and their axis, from which the next call starts.
///
/// Features are valid for their own polytope only. For any other one, such as a part of it, the
/// axis determines the start. A cache only affects the start of a march.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Cache(Option<LastMarchEnd>);

/// The pair of features and the axis at which the last march ended, and the polytopes that it was about.
#[derive(Clone, Copy, Debug, PartialEq)]
struct LastMarchEnd {
    pair: Pair,
    /// Fingerprints that identify both polytopes.
    fingerprints: [u64; 2],
    axis: DVec3,
}

impl Cache {
    /// Stores the nearest pair of features, and the axis from A to B.
    #[inline]
    pub(crate) fn store(&mut self, placed: &PlacedPair<'_>, pair: Pair, axis: DVec3) {
        self.0 = Some(LastMarchEnd {
            pair,
            fingerprints: fingerprints(placed),
            axis,
        });
    }

    /// Returns the pair of features to start from. For each polytope this is its last feature if it is the same polytope,
    /// or else its extremal vertex along the last axis. Without an axis, the vector between the origins replaces it.
    #[inline]
    pub(crate) fn start_features(self, placed: &PlacedPair<'_>) -> Pair {
        let Some(last) = self.0 else {
            return extremal_pair(placed, placed.b.to_a.translation);
        };
        // The last feature of an unchanged polytope is nearer than an extremal vertex.
        let fingerprints = fingerprints(placed);
        let start = Pair {
            a: if fingerprints[0] == last.fingerprints[0] {
                last.pair.a
            } else {
                extremal_vertex_of_a(placed, last.axis)
            },
            b: if fingerprints[1] == last.fingerprints[1] {
                last.pair.b
            } else {
                extremal_vertex_of_b(placed, last.axis)
            },
        };
        if is_valid_start(placed, start) {
            start
        } else {
            extremal_pair(placed, last.axis)
        }
    }
}

/// Computes fingerprints that identify both polytopes.
#[inline]
fn fingerprints(placed: &PlacedPair<'_>) -> [u64; 2] {
    let fingerprint = |polytope: &Polytope| {
        let DVec3 { x, y, z } = polytope.origin_in_piece;
        let coordinates = [polytope.reach, x, y, z].map(f64::to_bits);
        coordinates.into_iter().fold(0, |fingerprint: u64, bits| {
            fingerprint.rotate_left(16) ^ bits
        })
    };
    [fingerprint(placed.a.shape()), fingerprint(placed.b.shape())]
}

/// Returns whether a march can start at a pair: both features must exist, and must not both be faces.
#[inline]
fn is_valid_start(placed: &PlacedPair<'_>, pair: Pair) -> bool {
    let two_faces = matches!((pair.a, pair.b), (Feature::Face(_), Feature::Face(_)));
    !two_faces && placed.a.shape().has_feature(pair.a) && placed.b.shape().has_feature(pair.b)
}

/// Returns the vertices that are extremal along an axis from A to B.
pub(crate) fn extremal_pair(placed: &PlacedPair<'_>, axis: DVec3) -> Pair {
    Pair {
        a: extremal_vertex_of_a(placed, axis),
        b: extremal_vertex_of_b(placed, axis),
    }
}

fn extremal_vertex_of_a(placed: &PlacedPair<'_>, axis: DVec3) -> Feature {
    Feature::Vertex(placed.a.shape().extremal_vertex(axis))
}

fn extremal_vertex_of_b(placed: &PlacedPair<'_>, axis: DVec3) -> Feature {
    let own = placed.b.to_a.inverse_transform_vector(axis);
    Feature::Vertex(placed.b.shape().extremal_vertex(-own))
}

#[cfg(test)]
mod tests;
