//! A candidate for a pair of features in contact: the nearest points of two faces.

use glam::DVec3;

/// The nearest points of a face of A and a face of B, in A's frame, with the indices of both faces.
#[derive(Clone, Copy)]
pub(super) struct ContactCandidate {
    pub(super) points: [DVec3; 2],
    pub(super) faces: [u32; 2],
    /// The sum of both faces' rounding radii. The radii of faces that share an edge or a corner may differ.
    pub(super) radius_sum: f64,
}

impl ContactCandidate {
    pub(super) fn distance(&self) -> f64 {
        self.points[0].distance(self.points[1])
    }

    pub(super) fn gap(&self) -> f64 {
        self.distance() - self.radius_sum
    }
}
