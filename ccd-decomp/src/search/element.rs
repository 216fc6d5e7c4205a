//! The elements that box trees are built over.

use crate::bounds::BoundingBox;
use ccd_core::glam::DVec3;

/// An element of a box tree: a whole face, or one edge of it, as a triangle with a repeated corner.
#[derive(Clone, Copy, Debug)]
pub(super) struct Element {
    pub(super) corners: [DVec3; 3],
    pub(super) face: u32,
}

impl Element {
    pub(super) fn center(&self) -> DVec3 {
        let bounds = BoundingBox::enclosing(self.corners);
        0.5 * bounds.lo + 0.5 * bounds.hi
    }
}
