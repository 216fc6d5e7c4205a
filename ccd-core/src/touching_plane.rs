//! The plane in which bodies that are let go touch at the start.

use glam::DVec3;

/// The plane between two bodies that touch at the start.
#[derive(Clone, Copy, Debug)]
pub(crate) struct TouchingPlane {
    /// Its unit normal from A to B, in A's frame and in B's: it may stay with either body.
    pub(crate) normals: [DVec3; 2],
    /// The gap along it that pieces have to keep at least: that of the contact, but for the rounding of resting.
    pub(crate) floor: f64,
}
