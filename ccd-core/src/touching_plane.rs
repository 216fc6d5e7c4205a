//! The plane in which bodies that are let go touch at the start.

use glam::DVec3;

/// The plane between two bodies that touch at the start.
#[derive(Clone, Copy, Debug)]
pub(crate) struct TouchingPlane {
    /// The unit normal from A to B, in A's frame and in B's: the plane may move with either body.
    pub(crate) normals: [DVec3; 2],
    /// The least gap along the normal that pieces have to keep: that of the contact, minus the rounding of resting.
    pub(crate) floor: f64,
}
