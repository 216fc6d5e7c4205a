//! Two features that are in contact.

use crate::answer::Separation;
use crate::body::feature::Feature;

/// A feature of A and one of B that are in contact, and their distance.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FeaturePair {
    /// The feature of body A.
    pub feature_a: Feature,
    /// The feature of body B.
    pub feature_b: Feature,
    /// A piece of body A that has it, as an index into [`Body::pieces`](crate::Body::pieces).
    pub piece_a: u32,
    /// A piece of body B that has it.
    pub piece_b: u32,
    /// The separation of the two features, not of the pieces, in world coordinates.
    pub separation: Separation,
}
