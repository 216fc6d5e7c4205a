//! Nearest points of two faces that may become a pair of features.

use glam::DVec3;

/// The nearest points of two faces, in A's frame, and the faces.
#[derive(Clone, Copy)]
pub(super) struct Candidate {
    pub(super) points: [DVec3; 2],
    pub(super) faces: [u32; 2],
    /// The sum of both faces' rounding radii. They may differ for faces that share an edge or a corner.
    pub(super) radii: f64,
}

impl Candidate {
    pub(super) fn distance(&self) -> f64 {
        self.points[0].distance(self.points[1])
    }

    pub(super) fn gap(&self) -> f64 {
        self.distance() - self.radii
    }
}
