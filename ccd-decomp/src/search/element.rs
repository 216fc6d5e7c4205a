//! What is searched of a face.

use crate::bounds::Bounds;
use ccd_core::glam::DVec3;

/// What is searched of a face: all of it, or one edge, of which an end is there twice.
#[derive(Clone, Copy, Debug)]
pub(super) struct Element {
    pub(super) corners: [DVec3; 3],
    pub(super) face: u32,
}

impl Element {
    pub(super) fn middle(&self) -> DVec3 {
        let bounds = Bounds::of(self.corners);
        0.5 * bounds.lo + 0.5 * bounds.hi
    }
}
