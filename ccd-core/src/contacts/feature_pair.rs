//! The result type for features in contact: a vertex, edge or face of A, and one of B.

use crate::answer::Separation;
use crate::body::feature::Feature;

/// A feature of A and a feature of B that are in contact, and their distance.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FeaturePair {
    /// The vertex, edge or face of body A that is in contact with body B.
    pub feature_a: Feature,
    /// The vertex, edge or face of body B that is in contact with body A.
    pub feature_b: Feature,
    /// The index in [`Body::pieces`](crate::Body::pieces) of a piece of body A with this feature.
    pub piece_a: u32,
    /// The index in [`Body::pieces`](crate::Body::pieces) of a piece of body B with this feature.
    pub piece_b: u32,
    /// The bounds of the features' distance and their nearest points, in world coordinates.
    pub separation: Separation,
}
